#!/usr/bin/env python3
"""Measures the numbers about changed settings that warnings, remedies and the stability page state.

    ./bendlab python experiments/measure_remedies.py            # lib/bendlab/solver/measured.hpp
    ./bendlab python experiments/measure_remedies.py --reasons  # results/stability/apart.json; half an hour

The scenes are small and fail on purpose. Runs are stored in results/own/remedies, and are computed
only if they are missing there. Texts state two significant digits.
"""
import copy
import json
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
FILE = ROOT / "lib/bendlab/solver/measured.hpp"
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
EXACT = '/solver={"method": "newton", "substeps": 12, "tolerance": 1e-7}'


def main():
    warnings.simplefilter("ignore")
    if "--reasons" in sys.argv:
        return reasons()
    numbers = {}
    for measure in (torn, centre, long_steps, stretched, still, pushed, implicit, lag, ball):
        numbers |= measure()
    FILE.write_text(header(numbers), encoding="utf-8")
    print(FILE)


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


def measured(name, config, changes, metric, sweep=None):
    """The values of a metric in the runs of a config with these changes, in order of the sweep."""
    table = bl.run(changed(config, changes), sweep=sweep or {}, out=OUT, name=name)
    return np.array(table[metric], float)


def torn():
    """The largest stretch in any frame, of three models: unchanged, with tethers, in 10 substeps."""
    def worst(**changes):
        return np.concatenate([
            measured("torn", TORN, changes | {"/mesh/cells": cells, "/bending/model": model}, "worst_stretch")
            for model, cells in (("crossover", 64), ("none", 32), ("k_ring", 64))])
    before, tethered = worst(), worst(**{"/effects": [GRAVITY, TETHERS]})
    substeps = worst(**{"/solver/substeps": 10})
    return {"torn_least": before.min(), "torn_most": before.max(), "torn_with_tethers": tethered.max(),
            "torn_in_10_substeps_least": substeps.min(), "torn_in_10_substeps_most": substeps.max()}


def centre():
    """The largest stretch of a triangle at the end."""
    def most(substeps, iterations, effects=(GRAVITY,)):
        return measured("centre", CENTRE, {"/solver/substeps": substeps, "/solver/iterations": iterations,
                                           "/effects": list(effects)}, "max_stretch").item()
    def strain(substeps):
        return measured("centre", CENTRE, {"/solver/substeps": substeps, "/solver/iterations": 1},
                        "mean_strain").item()
    return {"centre_1x10": most(1, 10), "centre_10x1": most(10, 1),
            "centre_1x10_with_tethers": most(1, 10, (GRAVITY, TETHERS)),
            "twice_the_substeps": strain(20) / strain(10)}


def long_steps():
    """The largest stretch in any frame of sheets in long steps, without and with /solver/flight_limit."""
    fifteenth = {"/bending/model": "adaptive", "/solver/dt": 1 / 15}
    second = {"/bending/model": "crossover", "/bending/k": 1, "/mesh/cells": 16, "/solver/dt": 1,
              "/pins/vertices": ["upper_left", "upper_right"], "/duration": 4}
    found = {}
    for name, changes in (("fifteenth", fifteenth), ("second", second)):
        for limit in (0, 0.25):
            found[f"steps_of_a_{name}{'_limited' if limit else ''}"] = measured(
                "long_steps", TORN, changes | {"/solver/flight_limit": limit}, "worst_stretch").item()
    return found


def stretched():
    return {f"stretched_{form}": measured("stretched", STRETCHED, {"/material/strain/form": form},
                                          "mean_strain").item() for form in ("normalised", "angle")}


def still():
    """The kinetic energy that a sheet at rest has after half a second, in J."""
    return {f"still_{sweep}": measured("still", STILL, {"/solver/sweep": sweep}, "kinetic_energy").item()
            for sweep in ("forward", "symmetric")}


def pushed():
    isometric = {"/bending": {"model": "isometric", "stiffness": "k", "k": 1}}
    return {name: measured("pushed", PUSHED, changes, "mean_strain").item() for name, changes in (
        ("pushed", {}), ("pushed_k_tenth", {"/bending/k": 0.1}), ("pushed_isometric", isometric))}


def implicit():
    """The unbalanced force at the end of a step, divided by the force of the effects."""
    def left(method, iterations, stiffness, **settings):
        solver = {"method": method, "substeps": 1, "iterations": iterations, **settings}
        return measured("implicit", STATED, {"/material/strain/compliance": 1 / stiffness, "/solver": solver},
                        "step_residual").item()
    return {"newton_3": left("newton", 3, 1e5), "newton_10": left("newton", 10, 1e5),
            "quasi_newton_auto_10": left("quasi_newton", 10, 1e4, membrane="auto"),
            "quasi_newton_stated_10": left("quasi_newton", 10, 1e4, membrane="stated"),
            "quasi_newton_stated_40": left("quasi_newton", 40, 1e4, membrane="stated"),
            "quasi_newton_auto_2": left("quasi_newton", 2, 1e4, membrane="auto"),
            "quasi_newton_auto_20": left("quasi_newton", 20, 1e4, membrane="auto")}


def lag():
    """Distances of cloth from its converged motion, in % of its size, by ranges of the unbalanced force."""
    points = []
    for stiffness in (1e3, 1e4, 1e5, 1e6):
        for method, membrane in (("quasi_newton", {"membrane": "stated"}), ("newton", {}), ("vbd", {})):
            solvers = [{"method": method, "substeps": 1, "iterations": iterations, **membrane}
                       for iterations in (1, 2, 5, 10, 20, 50)]
            config = changed(STATED, {"/material/strain/compliance": 1 / stiffness}) | {
                "accuracy": {"solver": [EXACT], "over_time": True}}
            table = bl.run(config, sweep={"/solver": solvers}, out=OUT, name="lag")
            points += zip(np.array(table["step_residual"], float), np.array(table["error_solver_rms"], float))
    found = {}
    for low, high in ((2, 5), (5, 20)):
        errors = [100 * error for residual, error in points if low <= residual < high and np.isfinite(error)]
        found |= {f"lag_of_{low}_to_{high}_least": min(errors), f"lag_of_{low}_to_{high}_most": max(errors)}
    return found


def ball():
    """The unbalanced force at the end of a step, divided by the force of the effects, for cloth on a ball."""
    def left(method, substeps, iterations):
        return measured("ball", BALL, {"/solver": {"method": method, "substeps": substeps,
                                                   "iterations": iterations}}, "step_residual").item()
    return {"ball_quasi_newton_1x10": left("quasi_newton", 1, 10),
            "ball_quasi_newton_8x30": left("quasi_newton", 8, 30),
            "ball_newton_1x20": left("newton", 1, 20), "ball_newton_8x20": left("newton", 8, 20)}


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


def header(numbers):
    lines = "\n".join(f"inline constexpr double {name} = {float(f'{value:.2g}'):g};"
                      for name, value in numbers.items())
    return ("// The numbers that warnings and remedies state, measured on small scenes that fail.\n// "
            "experiments/measure_remedies.py has the scenes, and made this file: do not edit it.\n#pragma "
            f"once\n\nnamespace bendlab::measured {{\n\n{lines}\n\n}}  // namespace bendlab::measured\n")


if __name__ == "__main__":
    main()
