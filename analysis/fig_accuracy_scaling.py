"""Cost over the size of the mesh at equal error, and accuracy of motion."""
import right_python  # noqa: F401  (first: it may hand over to another Python)
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.lines import Line2D

import accuracy
import style
from bendlab.results.load import by_model, group
from report import Section, Table, figure_main

LEVEL, MOTION = 0.01, 0.05  # sizes; distances from the model's own equilibrium and motion


def main(results, out):
    section = Section("Larger meshes, and motion", "accuracy_scaling")
    sizes = [run for run in accuracy.experiment_runs(results, section, "resolution", "resolution_slow")
             if run.complete]
    swing = [run for run in accuracy.experiment_runs(results, section, "swing_slow") if run.complete]
    section.text = ("A finer mesh has more constraints and needs more substeps for the same error, so that "
                    "cost is compared at equal error. Motion is compared frame by frame with the same scene "
                    "in 4096 substeps, the reference. A dotted line shows how far the reference is from one "
                    "in 2048 substeps. Errors below ten times that distance are not known; their dots are "
                    "hollow.")
    if sizes:
        section.pictures.append((_growth(sizes, out), "Left: error over substeps, in single precision; "
                                 "rounding errors grow in very short substeps. Right: CPU time per frame "
                                 f"for an error of {100 * LEVEL:g} %, interpolated between measured runs (on "
                                 "logarithms)."))
    if swing:
        section.pictures.append((_motion(swing, out), "A sheet is released from the horizontal and swings "
                                 "for 1 s with a damping rate of 1/s; mean over 20 frames. Each model is "
                                 "compared with its own motion, so that the models' errors do not rank them. "
                                 "Lines are each model's front."))
        section.tables.append(_motion_table(swing))
    return section


def cost_at(runs, level):
    """CPU time per frame (ms) at which the error falls to a level, by linear interpolation of logarithms
    between two runs.

    NaN if no two runs enclose the level.
    """
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
    for model, some in by_model(runs).items():
        line = []
        for cells, of_size in sorted(group(some, lambda run: run.get("/mesh/cells")).items()):
            of_size = sorted(of_size, key=lambda run: run.get("/solver/substeps"))
            left.plot([run.get("/solver/substeps") for run in of_size],
                      [100 * accuracy.error(run, against="solver") for run in of_size],
                      **style.look(model, linestyle=looks.get(cells, "-")))
            line.append((of_size[0].summary["vertices"], cost_at(of_size, LEVEL)))
        right.plot(*zip(*line), label=accuracy.name_of(model), **style.look(model))
        slopes[model] = accuracy.slope(*zip(*line))
    left.axhline(100 * LEVEL, color=style.GREY, linewidth=0.8)
    left.set_xscale("log", base=4), left.set_yscale("log")
    left.xaxis.set_major_formatter("{x:.0f}")
    left.set_xlabel("substeps of one symmetric iteration"), left.set_ylabel(
        "distance from its equilibrium (% of size)")
    right.set_xscale("log"), right.set_yscale("log")
    right.set_xlabel("vertices"), right.set_ylabel(f"CPU time per frame to {100 * LEVEL:g} % (ms)")
    left.legend(handles=[Line2D([], [], color=style.INK, linestyle=look, label=f"{cells} cells")
                         for cells, look in looks.items()])
    found = {model: p for model, p in slopes.items() if np.isfinite(p)}
    text = ", ".join(f"{accuracy.name_of(model)} V^{p:.1f}" for model, p in found.items())
    figure.suptitle(f"Time for an error of {100 * LEVEL:g} % "
                    f"{'grows faster than' if min(found.values()) > 1 else 'over'} the number V of vertices: "
                    f"{text}" if found else f"Time for an error of {100 * LEVEL:g} % over the size of the "
                    "mesh", x=0.01, ha="left", fontsize=11.5)
    style.label_ends(right)
    return style.save(figure, out, "fig_accuracy_scaling")


def known(run):
    """Whether the reference's gap is at most a tenth of the run's distance from it."""
    return accuracy.gap([run], "solver") <= 0.1 * accuracy.error(run, against="solver")


def _motion(runs, out):
    figure, axes = plt.subplots(figsize=(8.4, 4.4), layout="constrained")
    for model, some in by_model(runs).items():
        colour = style.colour(model)
        axes.scatter([accuracy.cost(run) for run in some],
                     [100 * accuracy.error(run, against="solver") for run in some], s=18,
                     marker=style.marker(model), edgecolors=colour, zorder=2,
                     color=[colour if known(run) else "white" for run in some])
        best = accuracy.front(some, against="solver")
        axes.plot([accuracy.cost(run) for run in best],
                  [100 * accuracy.error(run, against="solver") for run in best],
                  color=colour, linewidth=1, label=accuracy.name_of(model))
        axes.axhline(100 * accuracy.gap(some, "solver"), color=colour, linewidth=0.7, linestyle=":")
    axes.set_xscale("log"), axes.set_yscale("log")
    axes.set_xlabel("CPU time per frame of 1/60 s (ms)"), axes.set_ylabel(
        "distance from its motion (% of size)")
    figure.suptitle(motion_message(runs), x=0.01, ha="left", fontsize=11)
    style.label_ends(axes)
    return style.save(figure, out, "fig_accuracy_motion")


def motion_message(runs):
    """The cheapest setting that keeps most models near their own motions, as text."""
    models = len(by_model(runs))
    kept = group([run for run in runs if accuracy.error(run, against="solver") <= MOTION], accuracy.settings)
    if not kept:
        return f"No setting keeps a model within {100 * MOTION:g} % of its own motion"
    middle = {setting: np.median([accuracy.cost(run) for run in some]) for setting, some in kept.items()}
    best = min(kept, key=lambda setting: (-len(by_model(kept[setting])), middle[setting]))
    return (f"{best}: {len(by_model(kept[best]))} of {models} models stay within {100 * MOTION:g} % "
            f"of their own motion, at {style.number(middle[best], 2)} ms (median)")


def _motion_table(runs):
    return Table("Motion of each model compared with its own in 4096 substeps. Energy: difference in the "
                 "energy gained since the start, over the scene's scale (weight times size, as nothing moves "
                 "at the start). A membrane's energy is its squared strain over its compliance. Where few "
                 "iterations leave the cloth stretched to a multiple of its length, the energy is thousands "
                 "of times the scale; it then shows how stretched the cloth is, and not how it moves.",
                 ["model", "substeps × iterations", "ms per frame", "distance (%)", "worst frame (%)",
                  "energy (%)", "uncertainty of the reference (%)", "at most a tenth of the distance"],
                 [[accuracy.name_of(run.model), accuracy.settings(run), style.number(accuracy.cost(run)),
                   *(style.number(100 * accuracy.error(run, measure, "solver"))
                     for measure in ("rms", "rms_worst", "energy")),
                   style.number(100 * accuracy.gap([run], "solver")), "yes" if known(run) else "no"]
                  for some in by_model(runs).values() for run in sorted(some, key=accuracy.cost)])


if __name__ == "__main__":
    figure_main(main)
