"""Errors at equal work (substeps × iterations), and the influence of time step, order of constraints and
precision."""
import numpy as np

from bendlab.results.load import by_model, group
from figures.accuracy.measures import (FRONTS, complete_runs, cost, experiment_runs, name_of, row,
                                       solver_error, substeps, table, work)
from tables.numbers import number

EQUAL = (16, 64, 256)  # substeps × iterations
ORDERS = {"colour": "colour", "mesh": "list", "pins": "from the pins"}


def main(results, out, section):
    stated = complete_runs(results, section, *FRONTS[0])
    time_step, precision, order = (experiment_runs(results, section, name)
                                   for name in ("time_step", "precision_slow", "order_slow"))
    models = by_model(stated)
    gains = {(model, equal): value for model, own_runs in models.items() for equal in EQUAL
             if np.isfinite(value := gain(own_runs, equal))}
    between = {(model, equal): best_between(along(models[model], equal)) for model, equal in gains}
    section.add_chart(
        table("work", "Equal work in substeps and iterations", [
            "name", ("work", "substeps × iterations"), ("substeps", "substeps"), "error_solver", "ms"],
            [row(run) | {"work": projections(run)} for run in stated
             if projections(run) in EQUAL and np.isfinite(solver_error(run))]),
        "Substeps or iterations, at equal work", "substeps", ["error_solver", "ms"], ["name"], held=["work"],
        scale="log2", y_scale="log",
        note=f"{message(gains, between)}. Left: all iterations in a substep. Right: one iteration per "
             "substep. Single precision. dihedral, bridson and discrete_shells are the same hinge with three "
             "stiffnesses; their curves coincide.")
    section.add_chart(
        table("steps", "64 iterations per 1/60 s in time steps of different length", [
            "name", ("rate", "time steps per second, 3840 iterations in all"), "error_solver", "ms"],
            [row(run) | {"rate": round(1 / run.get("/solver/dt"))} for run in time_step]),
        f"At equal work the smallest time step has the smallest error for {finest_best(time_step)} models",
        "rate", ["error_solver"], ["name"], scale="log2", y_scale="log")
    section.add_chart(
        table("precision", "Single and double precision", [
            "name", "precision", ("substeps", "substeps of one symmetric iteration"), "error_solver", "ms"],
            map(row, precision)),
        f"The error in single precision is up to × {number(worst_of_single(precision), 2)} the error in "
        "double", "substeps", ["error_solver"], ["name", "precision"], scale="log2", y_scale="log")
    rows = {}
    for run in order:
        settings = f"{work(run)} {run.get('/solver/sweep')}"
        place = run.get("/solver/order")
        own_row = rows.setdefault((run.model, settings), {"name": name_of(run.model), "settings": settings})
        own_row |= {f"error_{place}": 100 * solver_error(run), f"ms_{place}": cost(run)}
    section.add_table("order", "Order of the constraints at equal work", [
        ("name", "model"), ("settings", "substeps × iterations"),
        *(column for place, label in ORDERS.items() for column in (
            (f"error_{place}", f"error, {label}", "", "%"), (f"ms_{place}", "time", "", "ms")))],
        rows.values())


def projections(run):
    return substeps(run) * run.get("/solver/iterations")


def errors_at(runs, equal):
    """Substeps → error of the runs with this work."""
    return {substeps(run): solver_error(run) for run in runs if projections(run) == equal}


def gain(runs, equal):
    """Error with one substep divided by the error with one iteration per substep, if substeps × iterations
    are `equal`. NaN if unknown."""
    errors = errors_at(runs, equal)
    return errors.get(1, np.nan) / errors.get(equal, np.nan)


def along(runs, equal):
    """(substeps, error) of all runs with `equal` substeps × iterations and a finite error, by substeps."""
    return sorted(point for point in errors_at(runs, equal).items() if np.isfinite(point[1]))


def best_between(line):
    """Whether an inner point of a line has the smallest error. None for a line of two points."""
    return min(line, key=lambda point: point[1]) not in (line[0], line[-1]) if len(line) > 2 else None


def message(gains, between):
    """Text: how often and how much many substeps are better than many iterations; when a mixture is best."""
    if not gains:
        return "Substeps against iterations"
    least, most = (f"{number(gains[model, equal], 2)} ({name_of(model)}, work {equal})"
                   for model, equal in (min(gains, key=gains.get), max(gains, key=gains.get)))
    answers = {equal: [best for (_, at), best in between.items() if at == equal and best is not None]
               for equal in EQUAL}
    mixed = ", ".join(f"{sum(known)} of {len(known)} at work {equal}"
                      for equal, known in answers.items() if known)
    return (f"In {sum(value > 1 for value in gains.values())} of {len(gains)} comparisons one iteration per "
            "substep has a smaller error than one substep with all iterations: × "
            f"{number(np.median(list(gains.values())), 2)} (median), from × {least} to × {most}. Several "
            f"iterations in each of several substeps are best in {mixed or 'none'}")


def finest_best(runs):
    """Text like '3 of 4': for how many models the smallest time step has the smallest error."""
    known = [run for run in runs if np.isfinite(solver_error(run))]
    best = [min(own_runs, key=solver_error).get("/solver/dt") for own_runs in by_model(known).values()]
    return f"{best.count(min((run.get('/solver/dt') for run in runs), default=None))} of {len(best)}"


def worst_of_single(runs):
    """The largest ratio of the errors in single and in double precision, at equal settings."""
    worst = 1.0
    for pair in group(runs, lambda run: (run.model, substeps(run))).values():
        errors = {run.get("/solver/precision"): solver_error(run) for run in pair}
        worst = np.fmax(worst, errors.get("single", np.nan) / errors.get("double", np.nan))
    return worst
