"""What accuracy costs: error and CPU time of every bending model on one stated cloth."""
import right_python  # noqa: F401  (first: it may hand over to another Python)
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.lines import Line2D

import accuracy
from bendlab.results import registry
import style
from bendlab.results.load import by_model
from report import Section, Table, figure_main

PAPER = "10 iterations, 1/60 s, k = 0.5"  # the paper's own setting
MEASURES = (("physical", "from the stated cloth"), ("solver", "from its own equilibrium"))
STATED = 5e-5  # B of the cloth in N m, as in configs/accuracy
SCENES = {"curtain on two pins": (accuracy.FRONTS[0], "paper"),
          "cantilever": (accuracy.FRONTS[1], "paper_cantilever")}
STAR = Line2D([], [], marker="*", markersize=10, color="white", markeredgecolor=style.INK, linestyle="",
              label="the paper's setting, in the model's colour")
GAP = Line2D([], [], color=style.GREY, linewidth=1, linestyle=":", label="uncertainty of the reference")
# Scenes with many equilibria
BASINS = {"drape": "front_drape_slow", "sheet on one pin": "front_one_pin_slow"}
TEXT = ("A sheet of 40 cm hangs at two pins, and a strip of 8 cm is clamped at one end. Every "
        "model is given the same cloth (B = 5·10⁻⁵ N m, 0.2 kg/m²). The physical error is the "
        "distance to that cloth. Its reference is a static equilibrium of calibrated hinges on "
        "finer cells: 96 for the curtain, 194 for the cantilever, clamped where the strip of 12 "
        "cells is. Errors below the distance between this reference and one on half as many "
        "cells are not known. The solver error is the distance to the equilibrium of the model's "
        "own energies on the same mesh. Distances are root mean squares over the sheet, in "
        "diagonals of its rest shape. Time is the CPU time of the steps for a frame of 1/60 s. "
        "Gravity gives the curtain most of its shape, bending little; the strip is held up by "
        "bending alone.")


def main(results, out):
    section = Section("Error against time", "accuracy")
    section.text = TEXT
    scenes = {}
    for scene, (stated, paper) in SCENES.items():
        runs = (accuracy.experiment_runs(results, section, *stated),
                accuracy.experiment_runs(results, section, paper))
        if runs[0]:
            scenes[scene] = runs
    if scenes:
        gaps = ", ".join(f"{scene} {style.number(100 * accuracy.gap(stated), 2)} %"
                         for scene, (stated, _) in scenes.items())
        section.pictures.append((_fronts(scenes, out), "Every run is a mark. The line is the front: no run "
                                 f"is both cheaper and nearer. Stars are the paper's setting ({PAPER}), "
                                 "which states no cloth and has no solver error. The dotted line is the "
                                 f"distance between the reference and one on half as many cells ({gaps}); "
                                 "marks below it are hollow, because their order is not known. Models "
                                 "without an equilibrium from Newton's method (choi_ko) have no solver "
                                 "error."))
        section.pictures.append((_levels(scenes, out), "CPU time per frame of each model's cheapest run "
                                 "within an error from the stated cloth. A model without a mark has no such "
                                 "run in the sweep. Levels below the uncertainty of the reference are left "
                                 "out."))
    for scene, (stated, paper) in scenes.items():
        section.tables += [levels_table(stated, scene, against, meaning) for against, meaning in MEASURES]
        section.tables.append(_front_table(stated + paper, scene, accuracy.gap(stated)))
    basins = {scene: runs for scene, config in BASINS.items()
              if (runs := [run for run in accuracy.experiment_runs(results, section, config)
                           if run.complete])}
    if basins:
        section.pictures.append((_basins(basins, out), "Scenes with many equilibria. Newton's method starts "
                                 "at each run's end and finds an equilibrium of the stated cloth on the same "
                                 "mesh. The error is the distance to it after the best rotation about the "
                                 "vertical. Runs may end in different folds."))
        section.tables += [levels_table(runs, scene, *MEASURES[0]) for scene, runs in basins.items()]
    if "cantilever" in scenes:
        section.tables.append(_stiffness_table(sum(scenes["cantilever"], [])))
    return section


def levels_table(runs, scene, against, meaning):
    """Table of the time of each model's cheapest run within each level that the reference can resolve."""
    rows, gap, known = [], accuracy.gap(runs, against), accuracy.known_levels(runs, against)
    for model, some in by_model(runs).items():
        row = [accuracy.name_of(model)]
        for level in accuracy.LEVELS:
            run = accuracy.reaching(some, level, against=against) if level in known else None
            row += [style.number(accuracy.cost(run)) if run else "–", accuracy.settings(run) if run else ""
                    if level in known else "not known"]
        best = min((accuracy.error(run, against=against) for run in some), default=np.nan)
        rows.append([*row, accuracy.percent(best, gap)])
    columns = [part for level in accuracy.LEVELS
               for part in (f"ms to {100 * level:g} %", "substeps × iterations")]
    return Table(f"{scene}: CPU time per frame of the cheapest run within an error, {meaning}",
                 ["model", *columns, "least error (%)"], rows)


def _levels(scenes, out):
    figure, axes = plt.subplots(1, len(scenes), figsize=(10.4, 4.2), layout="constrained", squeeze=False,
                                sharey=True)
    models = list(by_model(sum((stated for stated, _ in scenes.values()), [])))[::-1]
    titles = []
    for panel, (scene, (stated, _)) in zip(axes[0], scenes.items()):
        reached = {level: {} for level in accuracy.known_levels(stated)}
        for model, some in by_model(stated).items():
            for level in reached:
                run = accuracy.reaching(some, level)
                if run:
                    reached[level][model] = accuracy.cost(run)
        for (level, _), marker, colour in zip(reached.items(), "os^", style.SEQUENCE):
            panel.plot(list(reached[level].values()), [models.index(model) for model in reached[level]],
                       marker, color=colour, label=f"{100 * level:g} %")
        panel.set_xscale("log")
        panel.set_xlabel("CPU time per frame of 1/60 s (ms)")
        panel.set_title(scene)
        nearest = min(reached, default=np.nan)
        titles.append(f"{scene} {len(reached.get(nearest, {}))} of {len(by_model(stated))} within "
                      f"{100 * nearest:g} %")
    axes[0, 0].set_yticks(range(len(models)), [accuracy.name_of(model) for model in models])
    max(axes[0],
        key=lambda panel: len(panel.get_legend_handles_labels()[0])).legend(title="within", loc="lower left",
                                                                            frameon=True, framealpha=0.9)
    figure.suptitle(f"Models near the stated cloth: {', '.join(titles)}", x=0.01, ha="left", fontsize=11.5)
    return style.save(figure, out, "fig_accuracy_levels")


def _front_table(runs, scene, gap):
    return Table(f"{scene}: the front of the physical error",
                 ["model", "substeps × iterations", "ms per frame", "projections per frame", "error (%)"],
                 [[accuracy.name_of(run.model), accuracy.settings(run), style.number(accuracy.cost(run)),
                   f"{accuracy.projections(run):.3g}", accuracy.percent(accuracy.error(run), gap)]
                  for run in accuracy.front(runs)])


def _stiffness_table(runs):
    """Table of the measured over the stated stiffness of each front run of the cantilever."""
    gap = accuracy.gap(runs)
    return Table("cantilever: stiffness error",
                 ["model", "substeps × iterations", "ms per frame", "B measured over B stated", "error (%)"],
                 [[accuracy.name_of(run.model), accuracy.settings(run), style.number(accuracy.cost(run)),
                   style.number(run.summary.get("stiffness_flexural_rigidity", np.nan) / STATED),
                   accuracy.percent(accuracy.error(run), gap)] for some in by_model(runs).values()
                  for run in accuracy.front(some)])


def _fronts(scenes, out):
    figure, axes = plt.subplots(len(scenes), 2, figsize=(10.4, 0.6 + 4.1 * len(scenes)), layout="constrained",
                                squeeze=False)
    titles = []
    for row, (scene, (stated, paper)) in zip(axes, scenes.items()):
        for panel, (against, meaning) in zip(row, MEASURES):
            _front(panel, stated, against)
            panel.set_ylabel(f"distance {meaning} (% of size)")
            panel.set_title(
                f"{scene}: {'the stated cloth' if against == 'physical' else 'its own equilibrium'}")
        for run in paper:
            if np.isfinite(accuracy.error(run)):
                row[0].scatter(accuracy.cost(run), 100 * accuracy.error(run), marker="*", s=110,
                               color=style.colour(run.model), edgecolors=style.INK, linewidths=0.6,
                               zorder=3)
        titles.append(f"{scene}: {message(stated, paper)}")
    for panel in axes[-1]:
        panel.set_xlabel("CPU time per frame of 1/60 s (ms)")
    _legend(figure, axes.flat, [STAR, GAP])
    figure.suptitle("\n".join(titles), x=0.01, ha="left", fontsize=10.5)
    return style.save(figure, out, "fig_accuracy")


def _basins(basins, out):
    figure, axes = plt.subplots(1, len(basins), figsize=(10.4, 4.4), layout="constrained", squeeze=False)
    for panel, (scene, runs) in zip(axes[0], basins.items()):
        _front(panel, runs, "physical")
        panel.set_title(scene)
        panel.set_xlabel("CPU time per frame of 1/60 s (ms)")
        panel.set_ylabel("distance from the stated cloth (% of size)")
    _legend(figure, axes.flat)
    figure.suptitle("\n".join(f"{scene}: {message(runs, [])}" for scene, runs in basins.items()), x=0.01,
                    ha="left", fontsize=10.5)
    return style.save(figure, out, "fig_accuracy_basins")


def _legend(figure, panels, others=()):
    """Draws the legend below all panels: every model with a dot in one of them, then `others`."""
    found = {label: handle for panel in panels for handle, label in zip(*panel.get_legend_handles_labels())}
    known = [found[name] for name in map(accuracy.name_of, registry.models()) if name in found]
    figure.legend(handles=[*known, *others], loc="upper center", bbox_to_anchor=(0.5, -0.01), ncol=7)


def _front(panel, stated, against):
    gap = accuracy.gap(stated, against)
    for model, some in by_model(stated).items():
        points = [(accuracy.cost(run), 100 * accuracy.error(run, against=against)) for run in some]
        points = [point for point in points if np.isfinite(point).all()]
        if points:
            colour = style.colour(model)
            panel.scatter(*zip(*points), s=17, marker=style.marker(model),
                          color=["white" if error < 100 * gap else colour for _, error in points],
                          edgecolors=colour, linewidths=0.8)
            panel.scatter([], [], s=17, marker=style.marker(model), color=colour,
                          label=accuracy.name_of(model))
    best = accuracy.front(stated, against=against)
    panel.step([accuracy.cost(run) for run in best],
               [100 * accuracy.error(run, against=against) for run in best], where="post", color=style.INK,
               linewidth=1, zorder=0)
    least = min((100 * accuracy.error(run, against=against) for run in stated), default=np.nan)
    if 100 * gap < least / 5:  # a line far below all dots would squeeze them
        panel.text(0.02, 0.02, f"uncertainty of the reference {style.number(100 * gap, 2)} %",
                   transform=panel.transAxes, fontsize=8, color=style.GREY)
    elif np.isfinite(gap):
        panel.axhline(100 * gap, color=style.GREY, linewidth=1, linestyle=":", zorder=0)
    panel.set_xscale("log"), panel.set_yscale("log")


def message(stated, paper):
    """The title of a scene, computed from its runs."""
    parts = []
    for level in (0.05, 0.01):
        if level < accuracy.gap(stated):
            parts.append(f"errors of {100 * level:g} % are not known")
            continue
        run = accuracy.reaching(stated, level)
        parts.append(f"{accuracy.name_of(run.model)} is within {100 * level:g} % in "
                     f"{style.number(accuracy.cost(run), 2)} ms" if run
                     else f"none is within {100 * level:g} %")
    star = next((run for run in paper if run.model == "adaptive"), None)
    if star:
        parts.append("the paper's adaptive model has an error of "
                     f"{style.number(100 * accuracy.error(star), 2)} % in "
                     f"{style.number(accuracy.cost(star), 2)} ms")
    return ", ".join(parts)


if __name__ == "__main__":
    figure_main(main)
