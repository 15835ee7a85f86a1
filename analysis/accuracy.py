"""Measures that the figures of accuracy share: cost and error of a run, the front of several."""
import numpy as np

import style
from report import rounded
from sweeps import load_experiment

LEVELS = (0.20, 0.05, 0.01)  # errors; the tables state the time to reach each
FRONTS = (("front", "front_slow", "front_work_slow"),  # configs that share a scene: curtain, cantilever
          ("front_cantilever", "front_cantilever_slow", "front_cantilever_work_slow"))
FRAMES_PER_SECOND = 60  # a frame is 1/60 s of simulated time
UNBALANCED = 1e-3  # share of the loads: a reference with more is no equilibrium
MEANING = {"rms": "root mean square distance between the points of the run and of its reference, in "
           "diagonals of the rest box", "hausdorff": "largest distance of either surface from the other, in "
           "diagonals of the rest box", "strain": "root mean square over the cloth of the difference in "
           "Green strain; if the reference is the stated cloth, of the strain itself",
           "energy": "for motions only: energy (kinetic, elastic, of weight) gained since the start, "
           "difference to the reference, mean over the frames, divided by the scene's scale. The scale is "
           "kinetic and elastic energy at the start, plus weight times size",}


def name_of(model):
    """Label of a model; configs/accuracy have k_ring with k = 2."""
    return style.model_name(model, 2)


def experiment_runs(results, section, *names):
    """Runs of configs/accuracy/<name>.json, complete or diverged. The section gets commands and missing
    points."""
    runs = []
    for name in names:
        runs += [run for run in section.uses(load_experiment(results, f"accuracy/{name}")) if run.over]
    return runs


def cost(run):
    """CPU time of the steps per frame, in ms."""
    return 1e3 * run.step_cpu_s / (FRAMES_PER_SECOND * simulated(run))


def projections(run):
    """Projections per frame."""
    return run.summary.get("projections", np.nan) / (FRAMES_PER_SECOND * simulated(run))


def simulated(run):
    """Simulated time, in s."""
    return float(run.metrics["time"][-1])


def error(run, measure="rms", against="physical"):
    """Error of a run; infinite if it diverged, NaN if it was not compared or its reference is unbalanced."""
    if run.summary.get(f"error_{against}_unbalanced", 0) > UNBALANCED:
        return np.nan
    return run.summary.get(f"error_{against}_{measure}", np.inf if run.status == "diverged" else np.nan)


def gap(runs, against="physical"):
    """Distance of the reference from a coarser one: smaller errors are not known. The largest of these runs;
    NaN if there is no coarser reference."""
    return max((run.summary.get(f"error_{against}_reference_gap", np.nan) for run in runs), default=np.nan)


def percent(error, gap):
    """An error in % as text; an error below the gap of its reference is not known."""
    return f"below {style.number(100 * gap, 2)}" if error < gap else style.number(100 * error)


def known_levels(runs, against="physical"):
    """The levels that are not below the gap of the reference."""
    return [level for level in LEVELS if not level < gap(runs, against)]


def work(run):
    """Iterations over all constraints per frame, all substeps together; a symmetric one counts twice."""
    rounds = run.get("/solver/iterations") * (2 if run.get("/solver/sweep") == "symmetric" else 1)
    return rounds * run.get("/solver/substeps") / FRAMES_PER_SECOND / run.get("/solver/dt")


def settings(run):
    """Solver settings as text."""
    flight = f", flight_limit {run.get('/solver/flight_limit'):g}" if run.get("/solver/flight_limit") else ""
    stiffness = f", k = {run.get('/bending/k'):g}" if run.get(
        "/bending/stiffness") == "k" and run.model != "none" else ""
    sweep = " symmetric" if run.get("/solver/sweep") == "symmetric" else ""
    return (f"{run.get('/solver/substeps')} × {run.get('/solver/iterations')}{sweep}, "
            f"{run.get('/solver/precision')}{flight}{stiffness}")


def front(runs, measure="rms", against="physical"):
    """Runs that no other run beats in both cost and error, cheapest first."""
    best, found = np.inf, []
    for run in sorted(runs, key=lambda run: (cost(run), error(run, measure, against))):
        if error(run, measure, against) < best:
            best = error(run, measure, against)
            found.append(run)
    return found


def reaching(runs, level, measure="rms", against="physical"):
    """The cheapest run whose error is at most a level; None if there is none."""
    return min((run for run in runs if error(run, measure, against) <= level), key=cost, default=None)


def slope(x, y):
    """Exponent p of y ∝ x^p by least squares of the logarithms; NaN for fewer than two points."""
    x, y = np.asarray(x, float), np.asarray(y, float)
    known = np.isfinite(x) & np.isfinite(y) & (x > 0) & (y > 0)
    return float(np.polyfit(np.log(x[known]), np.log(y[known]), 1)[0]) if known.sum() > 1 else np.nan


def as_json(run, on_front):
    """The object of a run in summary.json."""
    errors = {name: value for name, value in run.summary.items() if name.startswith("error_")}
    numbers = {**errors, "cpu_s": run.cpu_s, "ms_per_frame": cost(run),
               "projections": run.summary.get("projections"), "memory_bytes": run.summary.get("memory_bytes")}
    return {"experiment": run.name, "point": run.point, "model": run.model, "settings": run.get("/solver"),
            "cells": run.get("/mesh/cells"), "stiffness": run.get("/bending/stiffness"), "status": run.status,
            **rounded(numbers), "on_front": on_front}
