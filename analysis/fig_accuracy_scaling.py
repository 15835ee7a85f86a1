"""How cost grows with the mesh at equal error, and what motion asks for."""
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.lines import Line2D

import accuracy
import style
from load import group
from report import Section, Table, figure_main

LEVEL = 0.01  # of the size, from its own equilibrium


def main(results, out):
    section = Section("Larger meshes, and motion", "accuracy_scaling")
    sizes = [run for run in accuracy.experiment_runs(results, section, "resolution", "resolution_slow") if run.complete]
    swing = [run for run in accuracy.experiment_runs(results, section, "swing_slow") if run.complete]
    section.text = ("A finer mesh has more constraints, and needs more substeps for the same error: cost at equal error is the honest scaling. "
                    "Motion is compared frame by frame with the same run in 4096 substeps, whose own distance from 2048 is drawn as a line; an "
                    "error of less than ten times that is not known, and drawn hollow.")
    if sizes:
        section.pictures.append((_growth(sizes, out), "Left: error against substeps, in single precision, which loses the steps of gravity in very short "
                                 "substeps. Right: CPU time per frame to come "
                                 f"within {100 * LEVEL:g} %, along straight lines between the measured runs (on logarithms)."))
    if swing:
        section.pictures.append((_motion(swing, out), "A sheet released from the horizontal, swinging for 1 s in air that takes 1/s of its velocity: mean over 20 frames."))
        section.tables.append(_motion_table(swing))
    return section


def cost_at(runs, level):
    """CPU time per frame (ms) and vertices at which the error falls to a level, on the straight line of logarithms between the two runs
    that enclose it; NaN where none do."""
    runs = sorted(runs, key=accuracy.cost)
    cost = np.array([accuracy.cost(run) for run in runs])
    error = np.array([accuracy.error(run, against="solver") for run in runs])
    for i in range(1, len(runs)):
        if error[i] <= level < error[i - 1]:
            share = np.log(error[i - 1] / level) / np.log(error[i - 1] / error[i])
            return float(np.exp(np.log(cost[i - 1]) + share * np.log(cost[i] / cost[i - 1])))
    return np.nan


def _growth(runs, out):
    figure, (left, right) = plt.subplots(1, 2, figsize=(10.4, 4.3), layout="constrained")
    looks, slopes = {12: ":", 24: "--", 48: "-"}, {}
    for model, some in accuracy.by_model(runs).items():
        line = []
        for cells, of_size in sorted(group(some, lambda run: run.get("/mesh/cells")).items()):
            of_size = sorted(of_size, key=lambda run: run.get("/solver/substeps"))
            left.plot([run.get("/solver/substeps") for run in of_size], [100 * accuracy.error(run, against="solver") for run in of_size],
                      looks.get(cells, "-"), marker="o", markersize=4, color=style.MODEL_COLOURS[model])
            line.append((of_size[0].summary["vertices"], cost_at(of_size, LEVEL)))
        right.plot(*zip(*line), "o-", color=style.MODEL_COLOURS[model], label=accuracy.NAMES[model])
        slopes[model] = accuracy.slope(*zip(*line))
    left.axhline(100 * LEVEL, color=style.GREY, linewidth=0.8)
    left.set_xscale("log", base=4), left.set_yscale("log")
    left.xaxis.set_major_formatter("{x:.0f}")
    left.set_xlabel("substeps of one symmetric iteration"), left.set_ylabel("distance from its equilibrium (% of size)")
    right.set_xscale("log"), right.set_yscale("log")
    right.set_xlabel("vertices"), right.set_ylabel(f"CPU time per frame to {100 * LEVEL:g} % (ms)")
    left.legend(handles=[Line2D([], [], color=style.INK, linestyle=look, label=f"{cells} cells") for cells, look in looks.items()])
    right.legend()
    found = {model: p for model, p in slopes.items() if np.isfinite(p)}
    text = ", ".join(f"{accuracy.NAMES[model]} V^{p:.1f}" for model, p in found.items())
    figure.suptitle(f"Time for {100 * LEVEL:g} % grows faster than the mesh: {text}" if found else f"Time for {100 * LEVEL:g} % against the mesh",
                    x=0.01, ha="left", fontsize=11.5)
    return style.save(figure, out, "fig_accuracy_scaling")


def gap(runs):
    """Distance of the reference from one half as fine, the largest of these runs."""
    return max((run.summary.get("error_solver_reference_gap", np.nan) for run in runs), default=np.nan)


def known(run):
    """Whether the reference is known to a tenth of the run's distance from it."""
    return gap([run]) <= 0.1 * accuracy.error(run, against="solver")


def _motion(runs, out):
    figure, axes = plt.subplots(figsize=(8.4, 4.4), layout="constrained")
    for model, some in accuracy.by_model(runs).items():
        colour = style.MODEL_COLOURS[model]
        axes.scatter([accuracy.cost(run) for run in some], [100 * accuracy.error(run, against="solver") for run in some], s=18,
                     color=[colour if known(run) else "white" for run in some], edgecolors=colour, label=accuracy.NAMES[model], zorder=2)
        best = accuracy.front(some, against="solver")
        axes.plot([accuracy.cost(run) for run in best], [100 * accuracy.error(run, against="solver") for run in best], color=style.MODEL_COLOURS[model],
                  linewidth=1)
        axes.axhline(100 * gap(some), color=style.MODEL_COLOURS[model], linewidth=0.7, linestyle=":")
    axes.set_xscale("log"), axes.set_yscale("log")
    axes.set_xlabel("CPU time per frame of 1/60 s (ms)"), axes.set_ylabel("distance from its motion (% of size)")
    axes.legend()
    cheapest = accuracy.reaching(runs, 0.05, against="solver")
    title = (f"Motion within 5 %: {accuracy.NAMES[cheapest.model]} in {style.number(accuracy.cost(cheapest), 2)} ms "
             f"({accuracy.settings(cheapest)})") if cheapest else "No run keeps within 5 % of its motion"
    figure.suptitle(title, x=0.01, ha="left", fontsize=11.5)
    return style.save(figure, out, "fig_accuracy_motion")


def _motion_table(runs):
    return Table("Motion", ["model", "substeps × rounds", "ms per frame", "distance (%)", "worst frame (%)", "energy (%)", "reference known to (%)",
                            "known to a tenth"],
                 [[accuracy.NAMES[run.model], accuracy.settings(run), style.number(accuracy.cost(run)),
                   *(style.number(100 * accuracy.error(run, measure, "solver")) for measure in ("rms", "rms_worst", "energy")),
                   style.number(100 * gap([run])), "yes" if known(run) else "no"]
                  for some in accuracy.by_model(runs).values() for run in sorted(some, key=accuracy.cost)])


if __name__ == "__main__":
    figure_main(main)
