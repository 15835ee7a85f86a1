"""Invented runs of real configs, and the runs that a command would compute."""
import json
import shlex
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "analysis"))

import numpy as np  # noqa: E402

from runs.sweeps import missing_run, planned_points, point_key, read_config  # noqa: E402


def facts(config, metrics=("time",), **more):
    """/facts of a run file, for h5py. `metrics`: names of the columns. `more` replaces these defaults."""
    entries = {"id": "0", "name": "made up", "status": "complete", "metrics": metrics,
               "units": ["s"] * len(metrics), "meanings": metrics, "cell_fields": {}, "constraints": {},
               "hashes": {}, "inputs": [], "passes": [], "summary": {}, "wall_s": 0, "cpu_s": 0,
               "step_cpu_s": 0, "provenance": {}, "config": config, **more}
    return np.frombuffer(json.dumps(entries).encode(), "u1")


def made_up(configs, summary, status=lambda run: "complete"):
    """Every run of these configs, with the summary and the status that these functions return."""
    runs = []
    for config in configs:
        settings = read_config(config)
        for point in planned_points(settings, settings["sweep"]):
            run = missing_run(config, point)
            run.status = status(run)
            if run.status != "missing":
                run.summary = summary(run)
            runs.append(run)
    return runs


def points_of(runs):
    """Config and point of every run, sorted."""
    return sorted((run.experiment, point_key(run.point)) for run in runs)


def planned_by(commands):
    """Config and point of every run that these commands compute with `bendlab run`, sorted."""
    return sorted(point for command in commands for point in _planned(command))


def _planned(command):
    program, run, path, *options = shlex.split(command)
    assert (program, run) == ("./bendlab", "run") and options[::2] == ["--set"] * (len(options) // 2)
    config = path.removeprefix("configs/").removesuffix(".json")
    settings = read_config(config)
    axes = dict(settings["sweep"])
    for pointer, text in (option.split("=", 1) for option in options[1::2]):
        value = json.loads(text) if text[0] in "[{0123456789" else text
        axes[pointer] = value if isinstance(value, list) else [value]
    return [(config, point_key(point)) for point in planned_points(settings, axes)]
