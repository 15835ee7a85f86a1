"""What the figures of accuracy share: what a run costs, how far it is off, and which runs nobody beats in both."""
import numpy as np

import style
from load import group, load_experiment
from report import rounded

LEVELS = (0.20, 0.05, 0.01)  # errors that the tables ask the time for
FRONTS = (("front", "front_slow", "front_work_slow"),  # configs that sweep one scene between them: the curtain, the cantilever
          ("front_cantilever", "front_cantilever_slow", "front_cantilever_work_slow"))
FRAMES_PER_SECOND = 60  # a frame is 1/60 s of simulated time
NAMES = {**style.MODEL_NAMES, "k_ring": "k-ring, k = 2"}  # as configs/accuracy has it
UNBALANCED = 1e-3  # of the loads: a reference with more has found no equilibrium
MEANING = {
    "rms": "root mean square distance of the points from the reference's, in diagonals of the rest box",
    "hausdorff": "farthest that either surface is from the other, in diagonals of the rest box",
    "strain": "root mean square of the Green strain's difference over the cloth; of the strain itself where the reference is the stated cloth",
    "energy": "of a motion: difference to the reference in what kinetic, elastic and weight's energy gained since the start, mean over the frames, "
              "over the scene's scale: kinetic and elastic energy at the start, and weight times size",
}


def experiment_runs(results, section, *names):
    """The runs of configs/accuracy/<name>.json, finished or diverged; the section notes commands and what is missing."""
    runs = []
    for name in names:
        runs += [run for run in section.uses(load_experiment(results, f"accuracy/{name}")) if run.over]
    return runs


def cost(run):
    """CPU time of the steps per frame, ms."""
    return 1e3 * run.step_cpu_s / (FRAMES_PER_SECOND * simulated(run))


def projections(run):
    """Per frame."""
    return run.summary.get("projections", np.nan) / (FRAMES_PER_SECOND * simulated(run))


def simulated(run):
    """How long the cloth was simulated for, s."""
    return float(run.metrics["time"][-1])


def error(run, measure="rms", against="physical"):
    """Infinite for a run that diverged, NaN where it was not compared, or with an equilibrium that was not found."""
    if run.summary.get(f"error_{against}_unbalanced", 0) > UNBALANCED:
        return np.nan
    return run.summary.get(f"error_{against}_{measure}", np.inf if run.status == "diverged" else np.nan)


def gap(runs, against="physical"):
    """Distance of the reference from one that is coarser, the largest of these runs: nothing is known nearer than that. NaN where
    there is no coarser one."""
    return max((run.summary.get(f"error_{against}_reference_gap", np.nan) for run in runs), default=np.nan)


def percent(error, gap):
    """An error for a reader, %; below the gap of its reference no more is known than that."""
    return f"below {style.number(100 * gap, 2)}" if error < gap else style.number(100 * error)


def known_levels(runs, against="physical"):
    """The levels that the reference of these runs can tell."""
    return [level for level in LEVELS if not level < gap(runs, against)]


def work(run):
    """Rounds over the constraints per frame."""
    rounds = run.get("/solver/iterations") * (2 if run.get("/solver/sweep") == "symmetric" else 1)
    return rounds * run.get("/solver/substeps") / FRAMES_PER_SECOND / run.get("/solver/dt")


def settings(run):
    """Solver settings for a reader."""
    flight = f", flight limit {run.get('/solver/flight_limit'):g}" if run.get("/solver/flight_limit") else ""
    stiffness = f", k = {run.get('/bending/k'):g}" if run.get("/bending/stiffness") == "k" and run.model != "none" else ""
    return (f"{run.get('/solver/substeps')} × {run.get('/solver/iterations')}"
            f"{' symmetric' if run.get('/solver/sweep') == 'symmetric' else ''}, {run.get('/solver/precision')}{flight}{stiffness}")


def front(runs, measure="rms", against="physical"):
    """Those that no other run beats in cost and error, cheapest first."""
    best, found = np.inf, []
    for run in sorted(runs, key=lambda run: (cost(run), error(run, measure, against))):
        if error(run, measure, against) < best:
            best = error(run, measure, against)
            found.append(run)
    return found


def reaching(runs, level, measure="rms", against="physical"):
    """The cheapest run whose error is at most a level; None where there is none."""
    return min((run for run in runs if error(run, measure, against) <= level), key=cost, default=None)


def by_model(runs):
    """Model → runs, in the order of the colours."""
    found = group(runs, lambda run: run.model)
    return {model: found[model] for model in style.MODEL_COLOURS if model in found}


def slope(x, y):
    """Exponent p of y ∝ x^p by least squares of the logarithms; NaN for fewer than two points."""
    x, y = np.asarray(x, float), np.asarray(y, float)
    known = np.isfinite(x) & np.isfinite(y) & (x > 0) & (y > 0)
    return float(np.polyfit(np.log(x[known]), np.log(y[known]), 1)[0]) if known.sum() > 1 else np.nan


def as_json(run, on_front):
    """One object of summary.json."""
    errors = {name: value for name, value in run.summary.items() if name.startswith("error_")}
    numbers = {**errors, "cpu_s": run.cpu_s, "ms_per_frame": cost(run), "projections": run.summary.get("projections"),
               "memory_bytes": run.summary.get("memory_bytes")}
    return {"experiment": run.name, "model": run.model, "settings": run.get("/solver"), "cells": run.get("/mesh/cells"),
            "stiffness": run.get("/bending/stiffness"), "status": run.status, **rounded(numbers), "on_front": on_front}
