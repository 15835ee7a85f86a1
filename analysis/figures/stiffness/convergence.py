"""Stiffness and solver: XPBD against static equilibrium, and k against iterations and time step."""
import numpy as np

from tables.numbers import number
from runs import strips
from bendlab.results.load import by_model, group
from tables.chart import Chart
from tables.section import Check
from tables.table import Table

ITERATIONS = (lambda run: run.get("/solver/iterations"))
TIME_STEP = (lambda run: round(1 / run.get("/solver/dt")))
SETTINGS = {"iterations": "iterations per step of 1/60 s",
            "time_step": "steps per second, 10 iterations each"}
STRIP = ("Every model has k = 0.5 on one strip (equilateral lattice, 24 cells), under a tenth of gravity. "
         "For springs, B is valid only at the curvature of this strip.")


def main(results, out, section):
    dynamic = strips.experiment_runs(results, section, "xpbd", "xpbd_slow", "xpbd_48_slow", "xpbd_full")
    cheap = strips.experiment_runs(results, section, "cheap")
    iterations = strips.experiment_runs(results, section, "iterations")
    time_step = strips.experiment_runs(results, section, "time_step")
    series = static_and_dynamic(dynamic)
    for (model, cells), (static, moving) in sorted(series.items()):
        finest = max(moving, key=substeps)
        section.checks.append(Check(f"H/W, XPBD with {substeps(finest)} substeps", model,
                                    strips.mesh_name(finest), strips.droop(static), strips.droop(finest),
                                    0.02, "static equilibrium of the same energies",
                                    note="springs stretch the membrane" if model == "lod" else ""))
    section.checks += [_growth("B at 100 iterations over B at 1", iterations, ITERATIONS),
                       _growth("B at 1/480 s over B at 1/30 s", time_step, TIME_STEP)]
    section.tables += [_approach(series), _cheap(cheap), _settings("iterations", iterations, ITERATIONS),
                       _settings("time_step", time_step, TIME_STEP)]
    off = [own_rows[-1]["off"] for own_rows in group(section.table("approach"), lambda row: (
        row["model"], row["cells"])).values()]
    title = "H/W of the strip over H/W in equilibrium"
    if off:
        title = f"With the most substeps the error of H/W is {number(min(off), 2)} to {number(max(off), 2)} %"
    section.charts = [
        Chart("substeps", title, "approach", "substeps", ["over", "off"], held=["cells"], scale="log2",
              limits=[("over", 1, "equilibrium"), ("off", 1, "1 %")]),
        Chart("cheap", "Cheap settings give only a part of the stated stiffness", "cheap", "substeps",
              ["share"],
              scale="log2", limits=strips.as_stated("share"), note="24 cells."),
        Chart("iterations", f"One k: models are {_growth_text(iterations, ITERATIONS)} with more iterations",
              "iterations", "x", ["B"], y_scale="log", note=STRIP),
        Chart("time_step", f"One k: models are {_growth_text(time_step, TIME_STEP)} with shorter steps",
              "time_step", "x", ["B"], y_scale="log", note=STRIP)]


def substeps(run):
    return run.get("/solver/substeps", 1)


def static_and_dynamic(runs):
    """(model, cells) → (static run, dynamic runs), if both kinds of runs exist."""
    series = {}
    for key, own_runs in group(runs, lambda run: (run.model, strips.cells(run))).items():
        static = [run for run in own_runs if run.get("/solver/method") == "equilibrium"]
        moving = [run for run in own_runs if run.get("/solver/method") != "equilibrium"]
        if static and moving:
            series[key] = static[0], moving
    return series


def _growth(check, runs, setting):
    """Checks stiffness with the finest setting over stiffness with the coarsest, the largest of all
    models."""
    ratios = {}
    for model, own_runs in by_model(runs).items():
        ends = [strips.rigidity(pick(own_runs, key=setting)) for pick in (min, max)]
        if model != "none" and np.isfinite(ends).all():
            ratios[model] = ends[1] / ends[0]
    model = max(ratios, key=ratios.get, default="any")
    return Check(check, model, "equilateral, 24 cells", 1.15, ratios.get(model, np.nan), 0,
                 "stiffness should not depend on solver settings", "most",
                 note="the largest ratio of all models")


def _growth_text(runs, setting):
    """Text: stiffness with the finest setting over stiffness with the coarsest setting, range over models."""
    growth = []
    for model, own_runs in by_model(runs).items():
        ends = [strips.rigidity(pick(own_runs, key=setting)) for pick in (min, max)]
        if model != "none" and np.isfinite(ends).all():
            growth.append(ends[1] / ends[0])
    return f"{min(growth):.0f} to {max(growth):.0f} times as stiff" if growth else "stiffer"


def _approach(series):
    rows = [{"model": model, "cells": cells, "substeps": substeps(run), "droop": strips.droop(run),
             "static": strips.droop(static), "over": strips.droop(run) / strips.droop(static),
             "off": 100 * abs(strips.droop(run) / strips.droop(static) - 1)}
            for (model, cells), (static, moving) in sorted(series.items())
            for run in sorted(moving, key=substeps)]
    return Table.of("approach", "Approach to the equilibrium", [
        "model", ("cells", "cells"), ("substeps", "substeps of 1/60 s"), ("droop", "H/W", ".4f"),
        ("static", "H/W in equilibrium", ".4f"), ("over", "H/W over that of the equilibrium", ".3f"),
        ("off", "difference of H/W from the equilibrium", "", "%")], rows)


def _cheap(runs):
    rows = [{"model": model, "substeps": substeps(run), "share": strips.measured(run) / strips.stated(run)}
            for model, own_runs in by_model(runs).items() for run in sorted(own_runs, key=substeps)]
    return Table.of("cheap", "Stiffness with cheap settings", [
        "model", ("substeps", "substeps of 1/60 s"), ("share", "stiffness, measured over stated")], rows)


def _settings(id, runs, setting):
    rows = [{"model": model, "name": strips.model_name(run), "x": setting(run), "B": strips.rigidity(run)}
            for model, own_runs in by_model(runs).items() for run in sorted(own_runs, key=setting)]
    return Table.of(id, f"B against {SETTINGS[id]}", [("name", "model"), ("x", SETTINGS[id]),
                                                      ("B", "B from H/W", "", "N m")], rows)
