"""Costs and errors of the runs of configs/accuracy, and their rows in tables. The front of several runs
consists of the runs for which no other run has less cost and a smaller error.
"""
import numpy as np

from bendlab.results.load import by_model
from tables.numbers import number, rounded
from runs.sweeps import load_experiment
from tables import looks
from tables.table import Column, Table

LEVELS = (0.20, 0.05, 0.01)  # target errors; tables state the least time to reach each of these
FRONTS = (("front", "front_slow", "front_work_slow"),  # configs of the curtain, and configs of the cantilever
          ("front_cantilever", "front_cantilever_slow", "front_cantilever_work_slow"))
FRAMES_PER_SECOND = 60  # a frame is 1/60 s of simulated time
UNBALANCED = 1e-3  # of the loads; a reference with larger unbalanced forces is no equilibrium
MEANING = {"rms": "root mean square distance between the points of the run and of its reference, in "
           "diagonals of the rest box", "hausdorff": "largest distance from a point of one surface to the "
           "other surface, in diagonals of the rest box",
           "strain": "root mean square over the cloth of the difference in Green strain; if the reference "
           "is the stated cloth, root mean square of the strain itself",
           "energy": "for motions only: how far the energy (kinetic, elastic, of weight) gained since the "
           "start differs from that of the reference. This is a mean over the frames, divided by the kinetic "
           "and elastic energy at the start plus weight times size"}
# Columns of tables with a row per run; see row().
COLUMNS = {column.id: column for column in (
    Column("name", "model"), Column("cells", "cells"), Column("settings", "substeps × iterations"),
    Column("ms", "CPU time per frame of 1/60 s", "", "ms"), Column("projections", "projections per frame"),
    Column("error_physical", "error from the stated cloth", "", "%",
           "root mean square distance to the stated cloth, in % of the diagonal at rest"),
    Column("error_solver", "error from its own equilibrium", "", "%", "root mean square distance to the "
           "equilibrium of the model's own energies on its mesh"),
    Column("strain", "strain, root mean square", "", "%"), Column("memory", "memory", "", "MB"))}


def experiment_runs(results, section, *names):
    """Complete and diverged runs of configs/accuracy/<name>.json. `section` gets the commands and the missing
    points of the sweeps."""
    runs = []
    for name in names:
        runs += [run for run in section.uses(load_experiment(results, f"accuracy/{name}")) if run.over]
    return runs


def row(run):
    """The row of a run in tables. Errors are in %."""
    return {"model": run.model, "name": name_of(run.model), "cells": run.get("/mesh/cells"),
            "settings": settings(run), "substeps": run.get("/solver/substeps"),
            "precision": run.get("/solver/precision"), "ms": cost(run), "projections": projections(run),
            "error_physical": 100 * error(run), "error_solver": 100 * error(run, against="solver"),
            "strain": 100 * error(run, "strain"), "memory": run.summary.get("memory_bytes", np.nan) / 1e6,
            "runs": [run.id]}


def table(id, caption, columns, rows):
    """A table with a row per run. `columns`: ids of COLUMNS, or other columns in the form of Table.of()."""
    return Table.of(id, caption, [COLUMNS.get(column, column) if isinstance(column, str) else column
                                  for column in columns], rows)


def name_of(model):
    """Label of a model. The label of k_ring has k = 2, as in configs/accuracy."""
    return looks.model_name(model, 2)


def cost(run):
    """CPU time of the steps per frame, in ms."""
    return 1e3 * run.step_cpu_s / (FRAMES_PER_SECOND * simulated(run))


def projections(run):
    return run.summary.get("projections", np.nan) / (FRAMES_PER_SECOND * simulated(run))


def simulated(run):
    """Simulated time, in s."""
    return float(run.metrics["time"][-1])


def error(run, measure="rms", against="physical"):
    """Error of a run. Infinite if the run diverged, NaN without a reference in balance."""
    if run.summary.get(f"error_{against}_unbalanced", 0) > UNBALANCED:
        return np.nan
    return run.summary.get(f"error_{against}_{measure}", np.inf if run.status == "diverged" else np.nan)


def gap(runs, against="physical"):
    """The smallest error that the references of these runs can measure: the largest distance of a reference
    from a coarser reference. NaN without coarser references."""
    return max((run.summary.get(f"error_{against}_reference_gap", np.nan) for run in runs), default=np.nan)


def known_levels(runs, against="physical"):
    """The target errors that the references can measure."""
    return [level for level in LEVELS if not level < gap(runs, against)]


def settings(run):
    """Solver settings as text."""
    if not run.get("/solver/substeps"):
        return run.method
    flight = f", flight_limit {run.get('/solver/flight_limit'):g}" if run.get("/solver/flight_limit") else ""
    stiffness = f", k = {run.get('/bending/k'):g}" if run.get(
        "/bending/stiffness") == "k" and run.model != "none" else ""
    sweep = " symmetric" if run.get("/solver/sweep") == "symmetric" else ""
    return (f"{run.get('/solver/substeps')} × {run.get('/solver/iterations')}{sweep}, "
            f"{run.get('/solver/precision')}{flight}{stiffness}")


def front(runs, measure="rms", against="physical"):
    """The front of these runs, cheapest run first."""
    best, kept = np.inf, []
    for run in sorted(runs, key=lambda run: (cost(run), error(run, measure, against))):
        if error(run, measure, against) < best:
            best = error(run, measure, against)
            kept.append(run)
    return kept


def reaching(runs, level, measure="rms", against="physical"):
    """The cheapest run whose error is at most `level`. None if there is no such run."""
    return min((run for run in runs if error(run, measure, against) <= level), key=cost, default=None)


def levels_rows(runs, scene, against, meaning):
    """A row for each model: time and settings of the cheapest run for each target error, and the least error
    of all runs."""
    known, least, rows = known_levels(runs, against), gap(runs, against), []
    for model, own_runs in by_model(runs).items():
        entry = {"scene": scene, "against": meaning, "name": name_of(model), "model": model,
                 "least": 100 * min((error(run, against=against) for run in own_runs), default=np.nan),
                 "not_known": 100 * least}
        for level in LEVELS:
            run = reaching(own_runs, level, against=against) if level in known else None
            entry[f"ms_{100 * level:g}"] = cost(run) if run else None
            unmet = "" if level in known else "not known"
            entry[f"settings_{100 * level:g}"] = settings(run) if run else unmet
            entry[f"run_{100 * level:g}"] = run.id if run else ""
        rows.append(entry)
    return rows


def levels_table(rows):
    columns = [part for level in LEVELS for part in (
        (f"ms_{100 * level:g}", f"time to {100 * level:g} %", "", "ms per frame"),
        (f"settings_{100 * level:g}", "substeps × iterations"))]
    return table("levels", "CPU time per frame of the cheapest run of each model for three target errors", [
        "scene", ("against", "error from"), "name", *columns, ("least", "least error", "", "%"),
        ("not_known", "smallest measurable error", "", "%")], rows)


def slope(x, y):
    """Exponent p of y ∝ x^p, by least squares of the logarithms. NaN for fewer than two points."""
    x, y = np.asarray(x, float), np.asarray(y, float)
    known = np.isfinite(x) & np.isfinite(y) & (x > 0) & (y > 0)
    return float(np.polyfit(np.log(x[known]), np.log(y[known]), 1)[0]) if known.sum() > 1 else np.nan


def as_json(run, on_front):
    """The object of a run in summary.json."""
    errors = {name: value for name, value in run.summary.items() if name.startswith("error_")}
    numbers = {**errors, "cpu_s": run.cpu_s, "ms_per_frame": cost(run),
               "projections": run.summary.get("projections"), "memory_bytes": run.summary.get("memory_bytes")}
    return {"id": run.id, "experiment": run.name, "point": run.point, "model": run.model,
            "settings": run.get("/solver"), "cells": run.get("/mesh/cells"),
            "stiffness": run.get("/bending/stiffness"), "status": run.status, **rounded(numbers),
            "on_front": on_front}


def percent(error):
    return f"{number(100 * error, 2)} %"
