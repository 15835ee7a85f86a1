"""Equal work in substeps or iterations; effects of time step, constraint order and precision."""
import right_python  # noqa: F401  (first: it may hand over to another Python)
import matplotlib.pyplot as plt
import numpy as np

import accuracy
import style
from bendlab.results.load import by_model, group
from report import Section, Table, figure_main

EQUAL = (16, 64, 256)  # substeps × iterations


def main(results, out):
    section = Section("The same work, spent differently", "accuracy_solver")
    stated = [run for run in accuracy.experiment_runs(results, section, *accuracy.FRONTS[0]) if run.complete]
    time_step = accuracy.experiment_runs(results, section, "time_step")
    precision = accuracy.experiment_runs(results, section, "precision_slow")
    order = accuracy.experiment_runs(results, section, "order_slow")
    section.text = ("Work is substeps times iterations; each iteration projects all constraints once. Errors "
                    "are distances from the equilibrium of the run's own energies, so that they are the "
                    "solver's alone.")
    if stated:
        section.pictures.append((_substeps(stated, out), "Equal work, from all iterations in one substep "
                                 "(left) to one iteration per substep (right), in single precision. The "
                                 "title compares the two ends of each line, and counts the lines whose "
                                 "smallest error lies between them: very short substeps have rounding "
                                 "errors. dihedral, bridson and discrete_shells are one hinge with three "
                                 "stiffnesses; their lines coincide."))
    if time_step or precision:
        section.pictures.append((_steps_and_precision(time_step, precision, out),
                                 "Left: 64 iterations per 1/60 s in time steps of different length. Right: "
                                 "the same runs in single and double precision."))
    if order:
        section.tables.append(_order_table(order))
    return section


def split(run):
    return run.get("/solver/substeps"), run.get("/solver/iterations")


def gain(runs, work):
    """Error with all work in iterations over error with all work in substeps; NaN if one is missing."""
    found = {split(run): accuracy.error(run, against="solver") for run in runs}
    return found.get((1, work), np.nan) / found.get((work, 1), np.nan)


def along(runs, work):
    """(substeps, error) of every split of the same work, from all in iterations to all in substeps."""
    line = {split(run)[0]: accuracy.error(run, against="solver") for run in runs
            if np.prod(split(run)) == work}
    return [(substeps, error) for substeps, error in sorted(line.items()) if np.isfinite(error)]


def best_between(line):
    """Whether the smallest error is at neither end of a line; None for a line of two points."""
    return min(line, key=lambda point: point[1]) not in (line[0], line[-1]) if len(line) > 2 else None


def _substeps(stated, out):
    figure, axes = plt.subplots(1, len(EQUAL), figsize=(10.4, 4.3), layout="constrained", sharey=True)
    gains, between = {}, {}
    for panel, work in zip(axes, EQUAL):
        for model, some in by_model(stated).items():
            line = along(some, work)
            if len(line) > 1:
                panel.plot([s for s, _ in line], [100 * e for _, e in line], label=accuracy.name_of(model),
                           **style.look(model))
            if np.isfinite(gain(some, work)):
                gains[model, work], between[model, work] = gain(some, work), best_between(line)
        panel.set_xscale("log", base=4), panel.set_yscale("log")
        panel.xaxis.set_major_formatter("{x:.0f}")
        panel.set_xlabel(f"substeps; times iterations: {work}")
    axes[0].set_ylabel("distance from its equilibrium (% of size)")
    figure.suptitle(message(gains, between), x=0.01, ha="left", fontsize=11.5)
    style.label_ends(axes[-1])
    return style.save(figure, out, "fig_accuracy_substeps")


def message(gains, between):
    """The title: how often and by how much substeps beat iterations, and how often a mixture beats both."""
    if not gains:
        return "Substeps against iterations"
    wins = sum(value > 1 for value in gains.values())
    (best, most), (worst, least) = (pick(gains, key=gains.get) for pick in (max, min))
    mixed = ", ".join(f"{sum(some)} of {len(some)} at work {work}" for work in EQUAL
                      if (some := [best for (_, at), best in between.items() if at == work
                                   and best is not None]))
    return (f"In {wins} of {len(gains)} comparisons the error is smaller with all work in substeps than with "
            f"all in iterations:\nby × {style.number(np.median(list(gains.values())), 2)} (median), from × "
            f"{style.number(gains[worst, least], 2)} ({accuracy.name_of(worst)}, work {least}) to × "
            f"{style.number(gains[best, most], 2)} ({accuracy.name_of(best)}, work {most}).\n"
            f"A mixture of both is best in {mixed or 'none'}")


def finest_best(runs):
    """For how many models the smallest time step has the smallest error: '3 of 4'."""
    models = by_model(runs).values()
    best = [min(some, key=lambda run: accuracy.error(run, against="solver")) for some in models]
    finest = min((run.get("/solver/dt") for run in runs), default=None)
    return f"{sum(run.get('/solver/dt') == finest for run in best)} of {len(best)}"


def _steps_and_precision(time_step, precision, out):
    figure, (left, right) = plt.subplots(1, 2, figsize=(10.4, 4.1), layout="constrained")
    for model, some in by_model(time_step).items():
        some = sorted(some, key=lambda run: -run.get("/solver/dt"))
        left.plot([1 / run.get("/solver/dt") for run in some],
                  [100 * accuracy.error(run, against="solver") for run in some],
                  label=accuracy.name_of(model), **style.look(model))
    left.set_xscale("log"), left.set_yscale("log")
    rates = sorted({round(1 / run.get("/solver/dt")) for run in time_step})
    left.set_xticks(rates, labels=rates), left.minorticks_off()
    left.set_xlabel("time steps per second, 3840 iterations in all")
    left.set_ylabel("distance from its equilibrium (% of size)")
    worst = 1.0
    for model, some in by_model(precision).items():
        found = {(run.get("/solver/precision"),
                  run.get("/solver/substeps")): accuracy.error(run, against="solver") for run in some}
        substeps = sorted({s for _, s in found})
        for kind, line in (("single", "-"), ("double", ":")):
            right.plot(substeps, [100 * found.get((kind, s), np.nan) for s in substeps],
                       label=f"{accuracy.name_of(model)}, {kind}", **style.look(model, linestyle=line))
        worst = max([worst, *(found[("single", s)] / found[("double", s)] for s in substeps
                              if ("single", s) in found and ("double", s) in found)])
    right.set_xscale("log", base=4), right.set_yscale("log")
    right.xaxis.set_major_formatter("{x:.0f}")
    right.set_xlabel("substeps of one symmetric iteration")
    figure.suptitle("At equal work the smallest time step has the smallest error for "
                    f"{finest_best(time_step)} models; the error in single precision is up to × "
                    f"{style.number(worst, 2)} that in double", x=0.01, ha="left", fontsize=11.5)
    style.label_ends(left), style.label_ends(right)
    return style.save(figure, out, "fig_accuracy_precision")


def _order_table(runs):
    rows = []
    for (model, substeps, sweep), some in group(runs,
                                                lambda run: (run.model, run.get("/solver/substeps"),
                                                             run.get("/solver/sweep"))).items():
        found = {run.get("/solver/order"): run for run in some}
        row = [accuracy.name_of(model), f"{substeps} × {some[0].get('/solver/iterations')} {sweep}"]
        for order in ("colour", "mesh", "pins"):
            run = found.get(order)
            row += [style.number(100 * accuracy.error(run, against="solver")),
                    style.number(accuracy.cost(run))] if run else ["–", "–"]
        rows.append(row)
    columns = [part for order in ("colour", "list", "from the pins")
               for part in (f"error, {order} (%)", "ms")]
    return Table("Order of the constraints at equal work", ["model", "substeps × iterations", *columns], rows)


if __name__ == "__main__":
    figure_main(main)
