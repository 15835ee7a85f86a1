#!/usr/bin/env python3
"""Tries the remedies of warnings and failed runs, and measures the changes that the stability page names.

    ./bendlab python experiments/measure_remedies.py            # prints the trials; exit 1 if a remedy fails
    ./bendlab python experiments/measure_remedies.py --reasons  # results/stability/apart.json; half an hour

The scenes are small and fail on purpose. Runs are stored in results/own/remedies, and are computed
only if they are missing there.
"""
import copy
import json
import re
import sys
import warnings
from pathlib import Path

import numpy as np

import bendlab as bl
from bendlab.results.load import load_run

sys.path.append(str(Path(__file__).resolve().parent.parent / "analysis"))  # behind the package that was built
from runs.stability_cases import CASES, FOLDER  # noqa: E402
from runs.stability_reasons import APART, CHANGES, PLACE, QUANTITIES, REASONS  # noqa: E402

ROOT = Path(__file__).resolve().parent.parent
OUT = ROOT / "results/own/remedies"
GRAVITY, TETHERS = {"type": "gravity"}, {"type": "tethers"}

# A sheet that hangs from one corner, as in the paper: one step of 1/60 s has 10 iterations.
TORN = {"allow": ["implausible"], "duration": 2,
        "mesh": {"generator": "grid", "width": 1, "height": 1, "cells": 32, "diagonal": "same"},
        "pins": {"vertices": ["upper_right"], "ring": 0},
        "material": {"density": 0.2, "strain": {"form": "normalised", "stiffness": "k"}},
        "bending": {"model": "none", "stiffness": "k", "k": 0.5}, "effects": [GRAVITY],
        "solver": {"method": "pbd", "dt": 1 / 60, "substeps": 1, "iterations": 10, "levels": 0,
                   "sweep": "forward", "precision": "single"}}
# A sheet that is pinned at its centre, without bending.
CENTRE = TORN | {"mesh": TORN["mesh"] | {"cells": 24}, "pins": {"vertices": ["centre"], "ring": 0}}
# A free sheet of dihedral hinges without gravity, which starts at 100 times its rest size.
STRETCHED = TORN | {"mesh": TORN["mesh"] | {"cells": 16}, "pins": {"vertices": [], "ring": 0}, "effects": [],
                    "bending": {"model": "dihedral", "stiffness": "k", "k": 1},
                    "initial": {"scale": [100, 100, 1]}}
# A free sheet without forces, displaced from rest by a millionth of its size.
STILL = TORN | {"duration": 0.5, "mesh": TORN["mesh"] | {"cells": 16}, "pins": {"vertices": [], "ring": 0},
                "effects": [], "initial": {"perturbation": 1e-6},
                "solver": TORN["solver"] | {"substeps": 1024, "iterations": 1}}
PUSHED = TORN | {"mesh": TORN["mesh"] | {"cells": 16},
                 "bending": {"model": "prestressed", "stiffness": "k", "k": 1, "prestressed": {"excess": 1}}}
# A sheet with a stated membrane and hinges that hangs from two corners, for methods that step implicitly.
STATED = {"allow": ["implausible"], "duration": 2, "mesh": {"width": 1, "height": 1, "cells": 16},
          "pins": {"vertices": ["upper_left", "upper_right"]},
          "material": {"density": 0.2, "strain": {"stiffness": "compliance", "compliance": 1e-4}},
          "bending": {"model": "discrete_shells", "stiffness": "physical", "flexural_rigidity": 1e-5},
          "effects": [GRAVITY], "output": {"frames_per_second": 30}}
# The sheet of STATED, which falls on a ball that spins.
BALL = STATED | {"pins": {"vertices": []}, "effects": [
    GRAVITY, {"type": "sphere", "centre": [0.5, 0.5, -0.35], "radius": 0.3, "spin": 3}, {"type": "friction"}]}


def changed(config, changes):
    """A config with settings changed: {"/solver/substeps": 10}."""
    config = copy.deepcopy(config)
    for pointer, value in changes.items():
        *path, last = pointer.split("/")[1:]
        inner = config
        for key in path:
            inner = inner.setdefault(key, {})
        inner[last] = value
    return config


def with_solver(method, substeps, iterations, compliance=1e-4, **settings):
    return {"/material/strain/compliance": compliance,
            "/solver": {"method": method, "substeps": substeps, "iterations": iterations, **settings}}


# The table of experiments/run/remedies.cpp: code and remedy, a scene that needs the remedy, the metric that
# it lowers, and the changes.
TRIALS = [
    ("unconverged: 10 × 1 instead of 1 × 10", CENTRE, "max_stretch",
     {"/solver/substeps": 10, "/solver/iterations": 1}),
    ("unconverged: twice the substeps", changed(CENTRE, {"/solver/iterations": 1, "/solver/substeps": 10}),
     "mean_strain", {"/solver/substeps": 20}),
    ("unconverged: tethers", CENTRE, "max_stretch", {"/effects": [GRAVITY, TETHERS]}),
    *((f"lagging: iterations of {method}", changed(STATED, with_solver(method, 1, few, compliance)),
       "step_residual", {"/solver/iterations": more})
      for method, few, more, compliance in (("newton", 3, 10, 1e-5), ("quasi_newton", 2, 20, 1e-4),
                                            ("vbd", 5, 50, 1e-4))),
    ("lagging: membrane auto", changed(STATED, with_solver("quasi_newton", 1, 10, membrane="stated")),
     "step_residual", {"/solver/membrane": "auto"}),
    ("lagging on a ball: substeps and iterations", changed(BALL, with_solver("quasi_newton", 1, 10)),
     "step_residual", {"/solver/substeps": 8, "/solver/iterations": 30}),
    ("lagging on a ball: substeps of newton", changed(BALL, with_solver("newton", 1, 20)), "step_residual",
     {"/solver/substeps": 8}),
    ("apart: symmetric sweeps", STILL, "kinetic_energy", {"/solver/sweep": "symmetric"}),
    ("apart: k 0.1", PUSHED, "mean_strain", {"/bending/k": 0.1}),
    ("apart: isometric", PUSHED, "mean_strain",
     {"/bending": {"model": "isometric", "stiffness": "k", "k": 1}}),
    ("apart: tethers", TORN, "worst_stretch", {"/effects": [GRAVITY, TETHERS]}),
    ("apart: substeps", TORN, "worst_stretch", {"/solver/substeps": 10}),
    ("apart: flight limit", changed(TORN, {"/bending/model": "adaptive", "/solver/dt": 1 / 15}),
     "worst_stretch", {"/solver/flight_limit": 0.25}),
    ("apart: form angle", STRETCHED, "mean_strain", {"/material/strain/form": "angle"}),
]


def main():
    warnings.simplefilter("ignore")
    if "--reasons" in sys.argv:
        return reasons()
    failed = False
    for remedy, scene, metric, changes in TRIALS:
        before = measured(remedy, scene, metric)
        after = measured(remedy, changed(scene, changes), metric)
        helps = after < 0.75 * before
        failed |= not helps
        print(f"{remedy}: {metric} {before:.3g} → {after:.3g}", "" if helps else "DOES NOT HELP", flush=True)
    return 1 if failed else 0


def measured(name, config, metric):
    return float(bl.run(config, out=OUT, name=re.sub(r"\W+", "_", name))[metric].item())


def reasons():
    """Runs the hard cases in double precision, with the changed settings of stability_reasons.py."""
    found = {}
    for config, change in dict.fromkeys(pair for reason in REASONS for pair in reason.apart):
        settings = json.loads((ROOT / f"configs/{FOLDER}/{config}.json").read_text(encoding="utf-8"))
        sweep = settings.pop("sweep")
        own = [reason for reason in REASONS if (config, change) in reason.apart]
        named = [models for reason in own for _, _, models, other in PLACE.findall(reason.text)
                 if other == change]
        if all(named):
            sweep["/bending/model"] = sorted({model for models in named for model in models.split()})
        for pointer in CHANGES[change]:
            sweep.pop(pointer, None)
        sweep |= {"/solver/precision": ["double"]} if "/solver/precision" in sweep else {}
        table = bl.run(changed(settings, CHANGES[change]), sweep=sweep, out=OUT,
                       name=f"{config}-{change}".replace(" ", "_").replace(",", ""))
        runs = [load_run(file) for file in table["file"]]
        for case in (case for case in CASES if case.config == config):
            where = {pointer: sweep[pointer][value] if pointer == "/effects" else value
                     for pointer, value in case.where.items() if pointer in sweep}
            for run in runs:
                if run.complete and all(run.point.get(pointer) == value for pointer, value in where.items()):
                    numbers = {name: of(run) for name, of in QUANTITIES.items()}
                    of_case = found.setdefault(config, {}).setdefault(change, {}).setdefault(case.name, {})
                    of_case[run.model] = {name: float(f"{number:.4g}") for name, number in numbers.items()
                                          if np.isfinite(number)}
        print(config, change, len(runs), flush=True)
    APART.write_text(json.dumps(found, indent=1) + "\n", encoding="utf-8")
    print(APART)


if __name__ == "__main__":
    sys.exit(main())
