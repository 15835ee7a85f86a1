"""What accuracy costs: error against CPU time of every bending model told the same cloth, and who gets how near for how much."""
import matplotlib.pyplot as plt
import numpy as np

import accuracy
import style
from report import Section, Table, figure_main

PAPER = "10 rounds, 1/60 s, k = 0.5"  # the paper's own setting
MEASURES = (("physical", "from the stated cloth"), ("solver", "from the equilibrium of its own energies"))


def main(results, out):
    section = Section("Error against time", "accuracy")
    told = accuracy.experiment_runs(results, section, "front", "front_slow")
    paper = accuracy.experiment_runs(results, section, "paper")
    section.text = ("A sheet of 40 cm hangs at two pins, and every model is told the same cloth (B = 5·10⁻⁵ N m, 0.2 kg/m²). The physical "
                    "error is the distance to that cloth: calibrated hinges on twice the cells in static equilibrium. The solver error is that to "
                    "the equilibrium of the model's own energies on the same mesh. Distances are root mean squares over the sheet, in "
                    "diagonals of its rest shape; time is the CPU time of the steps for a frame of 1/60 s.")
    section.told = told
    if told:
        section.pictures.append((_fronts(told, paper, out), "Every run is a dot, the line is the front: no run is cheaper and nearer. Stars are "
                                 f"the paper's setting ({PAPER}), which names no cloth and has no solver error."))
        section.tables += [levels_table(told, against, meaning) for against, meaning in MEASURES]
        section.tables.append(_front_table(told + paper))
    return section


def levels_table(runs, against, meaning):
    """Model × the time that its cheapest run within each level takes."""
    rows = []
    for model, some in accuracy.by_model(runs).items():
        row = [style.MODEL_NAMES[model]]
        for level in accuracy.LEVELS:
            run = accuracy.reaching(some, level, against=against)
            row += [style.number(accuracy.cost(run)) if run else "–", accuracy.settings(run) if run else ""]
        best = min((accuracy.error(run, against=against) for run in some), default=np.nan)
        rows.append([*row, style.number(100 * best)])
    columns = [part for level in accuracy.LEVELS for part in (f"ms to {100 * level:g} %", "substeps × rounds")]
    return Table(f"CPU time per frame of the cheapest run within an error, {meaning}", ["model", *columns, "least error (%)"], rows)


def _front_table(runs):
    return Table("The front of the physical error", ["model", "substeps × rounds", "ms per frame", "projections per frame", "error (%)"],
                 [[style.MODEL_NAMES[run.model], accuracy.settings(run), style.number(accuracy.cost(run)),
                   f"{accuracy.projections(run):.3g}", style.number(100 * accuracy.error(run))] for run in accuracy.front(runs)])


def _fronts(told, paper, out):
    figure, axes = plt.subplots(1, 2, figsize=(10.4, 4.7), layout="constrained", sharex=True)
    for panel, (against, meaning) in zip(axes, MEASURES):
        for model, some in accuracy.by_model(told).items():
            points = [(accuracy.cost(run), 100 * accuracy.error(run, against=against)) for run in some]
            points = [point for point in points if np.isfinite(point).all()]
            if points:
                panel.scatter(*zip(*points), s=15, color=style.MODEL_COLOURS[model], label=style.MODEL_NAMES[model], alpha=0.85, linewidths=0)
        best = accuracy.front(told, against=against)
        panel.step([accuracy.cost(run) for run in best], [100 * accuracy.error(run, against=against) for run in best], where="post", color=style.INK,
                   linewidth=1, zorder=0)
        panel.set_xscale("log"), panel.set_yscale("log")
        panel.set_xlabel("CPU time per frame of 1/60 s (ms)")
        panel.set_ylabel(f"distance {meaning} (% of size)")
    for run in paper:
        if np.isfinite(accuracy.error(run)):
            axes[0].scatter(accuracy.cost(run), 100 * accuracy.error(run), marker="*", s=110, color=style.MODEL_COLOURS[run.model],
                            edgecolors=style.INK, linewidths=0.6, zorder=3)
    style.legend_below(figure, axes[1], 6)
    figure.suptitle(message(told, paper), x=0.01, ha="left", fontsize=11.5)
    return style.save(figure, out, "fig_accuracy")


def message(told, paper):
    """What the picture says, from its numbers."""
    parts = []
    for level in (0.05, 0.01):
        run = accuracy.reaching(told, level)
        parts.append(f"{100 * level:g} %: {style.MODEL_NAMES[run.model]}, {style.number(accuracy.cost(run), 2)} ms" if run else f"{100 * level:g} %: none")
    star = next((run for run in paper if run.model == "adaptive"), None)
    if star:
        parts.append(f"the paper's adaptive: {style.number(100 * accuracy.error(star), 2)} % in {style.number(accuracy.cost(star), 2)} ms")
    return "Cheapest within " + "; ".join(parts)


if __name__ == "__main__":
    figure_main(main)
