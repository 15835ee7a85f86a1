"""Errors at equal work (substeps × iterations), and the influence of time step, order of constraints and
precision."""
import numpy as np

from bendlab.results.load import by_model, group
from figures.accuracy import measures
from tables.chart import Chart
from tables.numbers import number
from tables.table import Table

EQUAL = (16, 64, 256)  # substeps × iterations


def main(results, out, section):
    stated = [run for run in measures.experiment_runs(results, section, *measures.FRONTS[0]) if run.complete]
    time_step = measures.experiment_runs(results, section, "time_step")
    precision = measures.experiment_runs(results, section, "precision_slow")
    order = measures.experiment_runs(results, section, "order_slow")
    by_work = [measures.row(run) | {"work": np.prod(split(run)).item()} for run in stated
               if np.prod(split(run)) in EQUAL and np.isfinite(measures.error(run, against="solver"))]
    steps = [measures.row(run) | {"rate": round(1 / run.get("/solver/dt"))} for run in time_step]
    section.tables = [
        measures.table("work", "Equal work in substeps and iterations", [
            "name", ("work", "substeps × iterations"), ("substeps", "substeps"), "error_solver", "ms"],
                       by_work),
        measures.table("steps", "64 iterations per 1/60 s in time steps of different length", [
            "name", ("rate", "time steps per second, 3840 iterations in all"), "error_solver", "ms"], steps),
        measures.table("precision", "Single and double precision", [
            "name", "precision", ("substeps", "substeps of one symmetric iteration"), "error_solver", "ms"],
            [measures.row(run) for run in precision]),
        *([_order_table(order)] if order else [])]
    gains = {(model, work): value for model, own_runs in by_model(stated).items() for work in EQUAL
             if np.isfinite(value := gain(own_runs, work))}
    between = {(model, work): best_between(along(by_model(stated)[model], work)) for model, work in gains}
    section.charts = [
        Chart("work", "Substeps or iterations, at equal work", "work", "substeps", ["error_solver", "ms"],
              ["name"], held=["work"],
              scale="log2", y_scale="log",
              note=message(gains, between) + ". Left: all iterations in a substep. Right: one iteration per "
                                             "substep. Single precision. dihedral, bridson and "
                                             "discrete_shells are the same hinge with three stiffnesses; "
                                             "their curves coincide."),
        Chart("steps", "At equal work the smallest time step has the smallest error for "
                       f"{finest_best(time_step)} models", "steps", "rate", ["error_solver"], ["name"],
              scale="log2", y_scale="log"),
        Chart("precision", "The error in single precision is up to × "
                           f"{number(worst_of_single(precision), 2)} the error in double", "precision",
              "substeps", ["error_solver"], ["name", "precision"],
              scale="log2",
              y_scale="log")]


def split(run):
    return run.get("/solver/substeps"), run.get("/solver/iterations")


def gain(runs, work):
    """Error with one substep over error with one iteration per substep, at equal work. NaN if unknown."""
    errors = {split(run): measures.error(run, against="solver") for run in runs}
    return errors.get((1, work), np.nan) / errors.get((work, 1), np.nan)


def along(runs, work):
    """(substeps, error) of all runs with this work, sorted by substeps."""
    line = {split(run)[0]: measures.error(run, against="solver") for run in runs
            if np.prod(split(run)) == work}
    return [(substeps, error) for substeps, error in sorted(line.items()) if np.isfinite(error)]


def best_between(line):
    """Whether an inner point of a line has the smallest error. None for a line of two points."""
    return min(line, key=lambda point: point[1]) not in (line[0], line[-1]) if len(line) > 2 else None


def message(gains, between):
    """Text: how often and how much many substeps are better than many iterations; when a mixture is best."""
    if not gains:
        return "Substeps against iterations"
    wins = sum(value > 1 for value in gains.values())
    (best, most), (worst, least) = (pick(gains, key=gains.get) for pick in (max, min))
    mixed = ", ".join(f"{sum(answers)} of {len(answers)} at work {work}" for work in EQUAL
                      if (answers := [best for (_, at), best in between.items() if at == work
                                      and best is not None]))
    return (f"In {wins} of {len(gains)} comparisons one iteration per substep has a smaller error than one "
            f"substep with all iterations: × {number(np.median(list(gains.values())), 2)} (median), from × "
            f"{number(gains[worst, least], 2)} ({measures.name_of(worst)}, work {least}) to × "
            f"{number(gains[best, most], 2)} ({measures.name_of(best)}, work {most}). "
            f"Several iterations in each of several substeps are best in {mixed or 'none'}")


def finest_best(runs):
    """Text like '3 of 4': for how many models the smallest time step has the smallest error."""
    models = by_model(runs).values()
    best = [min(own_runs, key=lambda run: measures.error(run, against="solver")) for own_runs in models]
    finest = min((run.get("/solver/dt") for run in runs), default=None)
    return f"{sum(run.get('/solver/dt') == finest for run in best)} of {len(best)}"


def worst_of_single(runs):
    """The largest ratio of the errors in single and in double precision, at equal settings."""
    worst = 1.0
    for pair in group(runs, lambda run: (run.model, run.get("/solver/substeps"))).values():
        errors = {run.get("/solver/precision"): measures.error(run, against="solver") for run in pair}
        worst = np.fmax(worst, errors.get("single", np.nan) / errors.get("double", np.nan))
    return worst


def _order_table(runs):
    rows = []
    for (model, substeps, sweep), own_runs in group(runs, lambda run: (run.model, run.get("/solver/substeps"),
                                                                       run.get("/solver/sweep"))).items():
        row = {"name": measures.name_of(model),
               "settings": f"{substeps} × {own_runs[0].get('/solver/iterations')} {sweep}"}
        for run in own_runs:
            order = run.get("/solver/order")
            row |= {f"error_{order}": 100 * measures.error(run, against="solver"),
                    f"ms_{order}": measures.cost(run)}
        rows.append(row)
    columns = [part for order, label in (("colour", "colour"), ("mesh", "list"), ("pins", "from the pins"))
               for part in ((f"error_{order}", f"error, {label}", "", "%"),
                            (f"ms_{order}", "time", "", "ms"))]
    return Table.of("order", "Order of the constraints at equal work",
                    [("name", "model"), ("settings", "substeps × iterations"), *columns], rows)
