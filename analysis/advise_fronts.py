#!/usr/bin/env python3
"""Writes the table of settings that `bendlab advise` tries first: the best settings of measured scenes.

Reads results/accuracy/summary.json, writes experiments/advise/fronts.def. Each scene and mesh has runs of one
cloth with different models and solvers. The script goes through these runs from the fastest to the slowest,
and keeps a run if its error is at least a fifth smaller than the smallest error of the faster runs.
"""

import json
import textwrap
from collections import defaultdict
from itertools import groupby
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SUMMARY, TABLE = ROOT / "results/accuracy/summary.json", ROOT / "experiments/advise/fronts.def"
LARGEST_ERROR, LARGEST_STRAIN = 0.2, 0.1  # experiments/advise/trial.hpp
BETTER = 0.8
# Settings of solver methods → usual values. The table states only unusual values.
OF_KIND = {"levels": 0, "membrane": None, "integrator": None, "sweep": "forward"}
HEAD = """\
// The best settings of measured scenes: model, solver method, further settings of the method, {substeps,
// iterations}.
// Made by analysis/advise_fronts.py from results/accuracy/summary.json.
"""


def error_of(run):
    """The distance of a run from the stated cloth. Runs of dihedral hinges may state the distance from their
    own equilibrium instead. None if the error is unknown or too large."""
    error = run.get("error_physical_rms")
    strain = run.get("error_physical_strain", run.get("error_solver_strain"))
    if error is None and run["model"] == "dihedral":
        error = run.get("error_solver_rms")
    fits = error is not None and error <= LARGEST_ERROR and strain is not None and strain <= LARGEST_STRAIN
    return error if fits and run["stiffness"] == "physical" and run["status"] == "complete" else None


def scene_of(run):
    """A text that runs of the same scene and mesh share: experiment, cells, swept settings of the scene."""
    name = run["experiment"].replace("_slow", "").replace("_work", "")
    swept = {k: v for k, v in run["point"].items() if not k.startswith(("/bending", "/solver"))}
    return f'{name} {run["cells"]} {json.dumps(swept, sort_keys=True)}'


def setting_of(run):
    solver = run["settings"]
    kind = {k: solver[k] for k, usual in OF_KIND.items() if solver.get(k, usual) != usual}
    return (solver["method"], json.dumps(kind, sort_keys=True, separators=(",", ":")), run["model"],
            solver["substeps"], solver["iterations"])


def best_settings(runs):
    scenes = defaultdict(list)
    for run in runs:
        if error_of(run) is not None and "substeps" in run["settings"]:
            scenes[scene_of(run)].append(run)
    best = set()
    for compared in scenes.values():
        least = LARGEST_ERROR / BETTER
        for run in sorted(compared, key=lambda run: run["ms_per_frame"]):
            if error_of(run) <= BETTER * least:
                least = error_of(run)
                best.add(setting_of(run))
    return sorted(best)


def table(settings):
    """The table as text. Settings that differ only in substeps and iterations share a line."""
    text = HEAD
    for (method, kind, model), alike in groupby(settings, key=lambda setting: setting[:3]):
        works = ", ".join(f"{{{substeps},{iterations}}}" for *_, substeps, iterations in alike)
        line = f'{{{{"{model}", "{method}", R"({kind})"}}, {{{works}}}}},'
        text += textwrap.fill(line, 110, subsequent_indent=" ") + "\n"
    return text


if __name__ == "__main__":
    found = best_settings(json.loads(SUMMARY.read_text()))
    TABLE.write_text(table(found))
    print(f"{TABLE}: {len(found)} settings")
