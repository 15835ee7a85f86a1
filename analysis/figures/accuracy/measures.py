"""Costs and errors of the runs of configs/accuracy, and their rows in tables. The front of several runs
consists of the runs for which no other run has less cost and a smaller error.
"""
import numpy as np

from bendlab.results.load import by_model
from runs import accuracy_runs, sweeps
from runs.strips import cells
from runs.sweeps import load_experiment
from tables import looks
from tables.numbers import finite, number, rounded
from tables.table import Column, Table

LEVELS = (20, 5, 1)  # target errors in %; tables state the least time to reach each of these
# Configs of the curtain, and configs of the cantilever
FRONTS = (("front", "front_slow", "front_work_slow", "front_quasi_newton_slow"),
          ("front_cantilever", "front_cantilever_slow", "front_cantilever_work_slow",
           "front_cantilever_quasi_newton_slow"))
FRAMES_PER_SECOND = 60  # a frame is 1/60 s of simulated time
UNBALANCED = 1e-3  # of the loads; a reference with larger unbalanced forces is no equilibrium
MEANING = {
    "rms": "root mean square distance between the points of the run and of its reference, in diagonals of "
           "the rest box",
    "hausdorff": "largest distance from a point of one surface to the other surface, in diagonals of the "
                 "rest box",
    "strain": "root mean square over the cloth of the difference in Green strain; if the reference is the "
              "stated cloth, root mean square of the strain itself",
    "energy": "for motions only: how far the energy (kinetic, elastic, of weight) gained since the start "
              "differs from that of the reference. This is a mean over the frames, divided by the kinetic "
              "and elastic energy at the start plus weight times size"}
# Columns of tables with a row per run; see row().
COLUMNS = {column.id: column for column in (
    Column("name", "model"), Column("cells", "cells"), Column("settings", "substeps × iterations"),
    Column("ms", "CPU time per frame of 1/60 s", "", "ms"), Column("projections", "projections per frame"),
    Column("error_physical", "error from the stated cloth", "", "%",
           "root mean square distance to the stated cloth, in % of the diagonal at rest", least="gap"),
    Column("error_solver", "error from its own equilibrium", "", "%",
           "root mean square distance to the equilibrium of the model's own energies on its mesh"),
    Column("strain", "strain, root mean square", "", "%"), Column("memory", "memory", "", "MB"))}
# Two columns for each target error; see level_cells().
LEVEL_COLUMNS = [column for level in LEVELS for column in (
    (f"ms_{level}", f"time to {level} %", "", "ms per frame"),
    (f"settings_{level}", "substeps × iterations"))]


def experiment_runs(results, section, *names):
    """Complete and diverged runs of configs/accuracy/<name>.json. `section` gets the commands and the missing
    points of the sweeps."""
    return [run for name in names for run in section.uses(load_experiment(results, f"accuracy/{name}"))
            if run.over]


def complete_runs(results, section, *names):
    return [run for name in names
            for run in sweeps.complete_runs(section, load_experiment(results, f"accuracy/{name}"))]


def with_error(section, runs):
    """The runs of one config whose error is known. The section gets the other runs."""
    sweeps.leave_out(section, [run for run in runs if not np.isfinite(error(run))], "error not known")
    return [run for run in runs if np.isfinite(error(run))]


def substeps(run):
    return run.get("/solver/substeps")


def row(run):
    """The row of a run in tables. Errors are in %."""
    return {"model": run.model, "name": name_of(run.model), "cells": cells(run),
            "settings": settings(run), "substeps": substeps(run),
            "precision": run.get("/solver/precision"), "ms": cost(run), "projections": projections(run),
            "error_physical": 100 * error(run), "gap": 100 * gap([run]),
            "error_solver": 100 * solver_error(run),
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
    """CPU time of the steps per frame, in ms; infinite for a run that ended at its start."""
    return 1e3 * run.step_cpu_s / frames(run) if frames(run) else np.inf


def projections(run):
    return run.summary.get("projections", np.nan) / (frames(run) or np.nan)


def frames(run):
    """The number of frames of 1/60 s, not rounded."""
    return FRAMES_PER_SECOND * float(run.metrics["time"][-1])


def error(run, measure="rms", against="physical"):
    """Error of a run. Infinite if the run diverged, NaN without a reference in balance."""
    if run.summary.get(f"error_{against}_unbalanced", 0) > UNBALANCED:
        return np.nan
    return run.summary.get(f"error_{against}_{measure}", np.inf if run.status == "diverged" else np.nan)


def solver_error(run):
    """The distance of a run from the equilibrium (or motion) of its own energies."""
    return error(run, against="solver")


def gap(runs, against="physical"):
    """The smallest error that the references of these runs can measure: the largest distance of a reference
    from a coarser reference. NaN without coarser references."""
    return max(finite(run.summary.get(f"error_{against}_reference_gap", np.nan) for run in runs),
               default=np.nan)


def known_levels(runs, against="physical"):
    """The target errors that the references can measure."""
    return [level for level in LEVELS if not level < 100 * gap(runs, against)]


def work(run):
    """Substeps and iterations as text."""
    return f"{substeps(run)} × {run.get('/solver/iterations')}"


def settings(run):
    """Solver settings as text."""
    if not substeps(run):
        return run.method
    sweep = " symmetric" if run.get("/solver/sweep") == "symmetric" else ""
    precision = run.get("/solver/precision")  # newton has no choice
    text = f"{work(run)}{sweep}" + (f", {precision}" if precision else "")
    if run.method != "pbd":
        text = f"{run.method} {text}"
    if flight_limit := run.get("/solver/flight_limit"):
        text += f", flight_limit {flight_limit:g}"
    by_k = run.get("/bending/stiffness") == "k" and run.model != "none"
    return text + (f", k = {run.get('/bending/k'):g}" if by_k else "")


def front(runs, against="physical"):
    """The front of these runs, cheapest run first."""
    return accuracy_runs.front(runs, cost, lambda run: error(run, against=against))


def front_rows(runs, against="physical", **cells):
    """The rows of the front of these runs, with these further cells in every row."""
    return [row(run) | cells for run in front(runs, against)]


def reaching(runs, level, against="physical"):
    """The cheapest run whose error is at most `level` (in %). None if there is no such run."""
    return min((run for run in runs if error(run, against=against) <= level / 100), key=cost, default=None)


def level_cells(level, run, text):
    """The cells of LEVEL_COLUMNS for a target error: the cost of the cheapest run, and a text."""
    return {f"ms_{level}": cost(run) if run else None, f"settings_{level}": text}


def levels_rows(runs, scene, against, meaning):
    """A row for each model: time and settings of the cheapest run for each target error, and the least error
    of all runs."""
    known, rows = known_levels(runs, against), []
    for model, own_runs in by_model(runs).items():
        rows.append({"scene": scene, "against": meaning, "name": name_of(model), "model": model,
                     "least": 100 * min(finite(error(run, against=against) for run in own_runs),
                                        default=np.nan),
                     "not_known": 100 * gap(runs, against)})
        for level in LEVELS:
            run = reaching(own_runs, level, against) if level in known else None
            unmet = "" if level in known else "not known"
            rows[-1] |= level_cells(level, run, settings(run) if run else unmet)
            rows[-1][f"run_{level}"] = run.id if run else ""
    return rows


def levels_table(rows):
    return table("levels", "CPU time per frame of the cheapest run of each model for three target errors", [
        "scene", ("against", "error from"), "name", *LEVEL_COLUMNS,
        Column("least", "least error", unit="%", least="not_known"),
        ("not_known", "smallest measurable error", "", "%")], rows)


def as_json(run, on_front):
    """The object of a run in summary.json."""
    errors = {name: value for name, value in run.summary.items() if name.startswith("error_")}
    numbers = {**errors, "cpu_s": run.cpu_s, "ms_per_frame": cost(run),
               "projections": run.summary.get("projections"), "memory_bytes": run.summary.get("memory_bytes")}
    return {"id": run.id, "experiment": run.name, "point": run.point, "model": run.model,
            "settings": run.get("/solver"), "cells": cells(run),
            "stiffness": run.get("/bending/stiffness"), "status": run.status, **rounded(numbers),
            "on_front": on_front}


def percent(error):
    return f"{number(100 * error, 2)} %"
