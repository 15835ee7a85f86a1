"""Stiffness and solver: XPBD against static equilibrium, and k against iterations and time step."""
import numpy as np

from bendlab.results.load import by_model, group, select
from runs import strips
from tables.numbers import span

# Config → (setting of a run, its first and last value, label, name of the check, end of the chart's title)
SETTINGS = {"iterations": (lambda run: run.get("/solver/iterations"), (1, 100),
                           "iterations per step of 1/60 s", "B at {1} iterations over B at {0}",
                           "with more iterations"),
            "time_step": (lambda run: round(1 / run.get("/solver/dt")), (30, 480),
                          "steps per second, 10 iterations each", "B at 1/{1} s over B at 1/{0} s",
                          "with shorter steps")}


def main(results, out, section):
    _add_approach(section, strips.experiment_runs(results, section, "xpbd", "xpbd_slow", "xpbd_48_slow",
                                                  "xpbd_full"))
    cheap = by_model(strips.experiment_runs(results, section, "cheap"))
    section.add_table("cheap", "Stiffness with cheap settings", [
        "model", ("substeps", "substeps of 1/60 s"), ("share", "stiffness, measured over stated")],
        [{"model": model, "substeps": substeps(run), "share": strips.share_of_droop(run)}
         for model, own_runs in cheap.items() for run in sorted(own_runs, key=substeps)])
    section.add_chart("cheap", "Cheap settings give only a part of the stated stiffness", "substeps",
                      ["share"], scale="log2", limits=strips.as_stated("share"), note="24 cells.")
    for id, (setting, ends, label, check, how) in SETTINGS.items():
        models = {model: sorted(own_runs, key=setting) for model, own_runs in
                  by_model(strips.experiment_runs(results, section, id)).items()}
        growth = {model: strips.rigidity(own_runs[-1]) / strips.rigidity(own_runs[0])
                  for model, own_runs in models.items() if model != "none"
                  and (setting(own_runs[0]), setting(own_runs[-1])) == ends}
        growth = {model: ratio for model, ratio in growth.items() if np.isfinite(ratio)}
        factor = f"{span(growth.values(), 2)} times as stiff" if growth else "stiffer"
        most = max(growth, key=growth.get, default="any")
        section.add_check(check.format(*ends), most, "equilateral, 24 cells", 1.15, growth.get(most, np.nan),
                          0, "stiffness should not depend on solver settings", "most",
                          note="the largest ratio of all models")
        section.add_table(id, f"B against {label}", [
            ("name", "model"), ("x", label), ("B", "B from H/W", "", "N m")],
            [{"model": model, "name": strips.model_name(run), "x": setting(run), "B": strips.rigidity(run)}
             for model, own_runs in models.items() for run in own_runs])
        section.add_chart(
            id, f"One k: models are {factor} {how}", "x", ["B"], y_scale="log",
            note="Every model has k = 0.5 on one strip (equilateral lattice, 24 cells), under a tenth of "
                 "gravity. For springs, B is valid only at the curvature of this strip.")


def _add_approach(section, runs):
    """Adds the checks, the table and the chart that compare runs of XPBD with the static equilibrium."""
    rows, last = [], []
    for (model, cells), own_runs in sorted(group(runs, lambda run: (run.model, strips.cells(run))).items()):
        static = select(own_runs, solver__method="equilibrium")
        moving = sorted((run for run in own_runs if run.get("/solver/method") != "equilibrium"), key=substeps)
        if not static or not moving:
            continue
        equal, finest = strips.droop(static[0]), moving[-1]
        section.checks.append(strips.check(
            finest, f"H/W, XPBD with {substeps(finest)} substeps", equal, strips.droop(finest), 0.02,
            "static equilibrium of the same energies",
            note="springs stretch the membrane" if model == "lod" else ""))
        rows += [{"model": model, "cells": cells, "substeps": substeps(run), "droop": strips.droop(run),
                  "static": equal, "over": strips.droop(run) / equal,
                  "off": 100 * abs(strips.droop(run) / equal - 1)} for run in moving]
        last.append(rows[-1]["off"])
    section.add_table("approach", "Approach to the equilibrium", [
        "model", ("cells", "cells"), ("substeps", "substeps of 1/60 s"), ("droop", "H/W", ".4f"),
        ("static", "H/W in equilibrium", ".4f"), ("over", "H/W over that of the equilibrium", ".3f"),
        ("off", "difference of H/W from the equilibrium", "", "%")], rows)
    title = (f"With the most substeps the error of H/W is {span(last, 2)} %" if last
             else "H/W of the strip over H/W in equilibrium")
    section.add_chart("approach", title, "substeps", ["over", "off"], id="substeps", held=["cells"],
                      scale="log2", limits=[("over", 1, "equilibrium"), ("off", 1, "1 %")])


def substeps(run):
    return run.get("/solver/substeps", 1)
