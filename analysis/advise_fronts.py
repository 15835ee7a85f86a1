#!/usr/bin/env python3
"""Writes the best settings of the measured scenes: the table that `bendlab advise` starts from.

Reads results/accuracy/summary.json, writes experiments/advise/fronts.def. For each scene and mesh in which
models and solvers are compared on one stated cloth, it keeps the settings that no other setting beats in both
error and time, and whose error is a fifth smaller than that of the next faster kept setting.
"""

import argparse
import json
import textwrap
from collections import defaultdict
from itertools import groupby
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
LARGEST_ERROR, LARGEST_STRAIN = 0.2, 0.1  # experiments/advise/trial.hpp
BETTER = 0.8
# Settings that make another kind of solver → their values if they are not stated.
OF_KIND = {"levels": 0, "membrane": None, "integrator": None, "sweep": "forward"}
HEAD = """\
// Settings that were the best of a measured scene: model, method, its further settings, then substeps and
// iterations.
// Made by analysis/advise_fronts.py from results/accuracy/summary.json.
"""


def error_of(run):
    """Distance of a run from the stated cloth; for dihedral hinges it may be that from their own equilibrium,
    a pose of that cloth. None if it is unknown or too large."""
    error = run.get("error_physical_rms")
    strain = run.get("error_physical_strain", run.get("error_solver_strain"))
    if error is None and run["model"] == "dihedral":
        error = run.get("error_solver_rms")
    fits = error is not None and error <= LARGEST_ERROR and strain is not None and strain <= LARGEST_STRAIN
    return error if fits and run["stiffness"] == "physical" and run["status"] == "complete" else None


def scene_of(run):
    """The key of runs that are compared: experiment without its suffixes, cells, other swept settings."""
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
    """The table as text: a line for the settings that differ in substeps and iterations only."""
    text = HEAD
    for (method, kind, model), alike in groupby(settings, key=lambda setting: setting[:3]):
        works = ", ".join(f"{{{substeps},{iterations}}}" for *_, substeps, iterations in alike)
        line = f'{{{{"{model}", "{method}", R"({kind})"}}, {{{works}}}}},'
        text += textwrap.fill(line, 110, subsequent_indent=" ") + "\n"
    return text


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--summary", type=Path, default=ROOT / "results/accuracy/summary.json")
    parser.add_argument("--out", type=Path, default=ROOT / "experiments/advise/fronts.def")
    arguments = parser.parse_args()
    best = best_settings(json.loads(arguments.summary.read_text()))
    arguments.out.write_text(table(best))
    print(f"{arguments.out}: {len(best)} settings")


if __name__ == "__main__":
    main()
