"""What accuracy costs: error against CPU time of every bending model told the same cloth, and who gets how near for how much."""
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.lines import Line2D

import accuracy
import style
from report import Section, Table, figure_main

PAPER = "10 rounds, 1/60 s, k = 0.5"  # the paper's own setting
MEASURES = (("physical", "from the stated cloth"), ("solver", "from its own equilibrium"))
SCENES = {"curtain on two pins": (accuracy.FRONTS[0], "paper"), "cantilever": (accuracy.FRONTS[1], "paper_cantilever")}
STAR = Line2D([], [], marker="*", markersize=10, color="white", markeredgecolor=style.INK, linestyle="", label="the paper's setting, in the model's colour")
GAP = Line2D([], [], color=style.GREY, linewidth=1, linestyle=":", label="reference known to")
BASINS = {"drape": "front_drape_slow", "sheet on one pin": "front_one_pin_slow"}  # of many equilibria


def main(results, out):
    section = Section("Error against time", "accuracy")
    section.text = ("A sheet of 40 cm hangs at two pins, and a strip of 8 cm is clamped at one end; every model is told the same cloth (B = 5·10⁻⁵ N m, "
                    "0.2 kg/m²). The physical error is the distance to that cloth: calibrated hinges on finer cells (curtain 96, cantilever 194, clamped where "
                    "the strip of 12 cells is) in static equilibrium. What is nearer than the reference on half as many cells is not known. The solver error is that "
                    "to the equilibrium of the model's own energies on the same mesh. Distances are root "
                    "mean squares over the sheet, in diagonals of its rest shape; time is the CPU time of the steps for a frame of 1/60 s. The curtain "
                    "hangs by its weight, and hardly asks for bending; nothing else holds up the strip.")
    scenes = {}
    for scene, (told, paper) in SCENES.items():
        runs = accuracy.experiment_runs(results, section, *told), accuracy.experiment_runs(results, section, paper)
        if runs[0]:
            scenes[scene] = runs
    if scenes:
        gaps = ", ".join(f"{scene} {style.number(100 * accuracy.gap(told), 2)} %" for scene, (told, _) in scenes.items())
        section.pictures.append((_fronts(scenes, out), f"Every run is a dot, the line is the front: no run is cheaper and nearer. Stars are the paper's setting ({PAPER}), "
                                 f"which names no cloth and has no solver error. The dotted line is the distance of the reference from that on half as many cells ({gaps}); below it "
                                 "dots are hollow: nothing is known of their order. Models whose "
                                 "equilibrium Newton's method does not find (Choi-Ko) have no solver error."))
        section.pictures.append((_levels(scenes, out), "CPU time per frame of the cheapest run of each model that is as near to the stated cloth; a model without a mark came no "
                                 "nearer in any run of the sweep. Levels below what the reference is known to are left out."))
    for scene, (told, paper) in scenes.items():
        section.tables += [levels_table(told, scene, against, meaning) for against, meaning in MEASURES]
        section.tables.append(_front_table(told + paper, scene, accuracy.gap(told)))
    basins = {scene: runs for scene, config in BASINS.items() if (runs := [run for run in accuracy.experiment_runs(results, section, config) if run.complete])}
    if basins:
        section.pictures.append((_basins(basins, out), "Scenes of many equilibria: each run against the equilibrium of the stated cloth that Newton's method finds from where the "
                                 "run ends, on the same mesh, after the best turn about the vertical. Another run may end in another fold."))
        section.tables += [levels_table(runs, scene, *MEASURES[0]) for scene, runs in basins.items()]
    if "cantilever" in scenes:
        section.tables.append(_stiffness_table(sum(scenes["cantilever"], [])))
    return section


def levels_table(runs, scene, against, meaning):
    """Model × the time that its cheapest run within each level takes; not known below the gap of the reference."""
    rows, gap, known = [], accuracy.gap(runs, against), accuracy.known_levels(runs, against)
    for model, some in accuracy.by_model(runs).items():
        row = [accuracy.NAMES[model]]
        for level in accuracy.LEVELS:
            run = accuracy.reaching(some, level, against=against) if level in known else None
            row += [style.number(accuracy.cost(run)) if run else "–", accuracy.settings(run) if run else "" if level in known else "not known"]
        best = min((accuracy.error(run, against=against) for run in some), default=np.nan)
        rows.append([*row, accuracy.percent(best, gap)])
    columns = [part for level in accuracy.LEVELS for part in (f"ms to {100 * level:g} %", "substeps × iterations")]
    return Table(f"{scene}: CPU time per frame of the cheapest run within an error, {meaning}", ["model", *columns, "least error (%)"], rows)


def _levels(scenes, out):
    figure, axes = plt.subplots(1, len(scenes), figsize=(10.4, 4.2), layout="constrained", squeeze=False, sharey=True)
    models = list(accuracy.by_model(sum((told for told, _ in scenes.values()), [])))[::-1]
    titles = []
    for panel, (scene, (told, _)) in zip(axes[0], scenes.items()):
        reached = {level: {} for level in accuracy.known_levels(told)}
        for model, some in accuracy.by_model(told).items():
            for level in reached:
                run = accuracy.reaching(some, level)
                if run:
                    reached[level][model] = accuracy.cost(run)
        for (level, _), marker, colour in zip(reached.items(), "os^", style.SEQUENCE):
            panel.plot(list(reached[level].values()), [models.index(model) for model in reached[level]], marker, color=colour, label=f"{100 * level:g} %")
        panel.set_xscale("log")
        panel.set_xlabel("CPU time per frame of 1/60 s (ms)")
        panel.set_title(scene)
        nearest = min(reached, default=np.nan)
        titles.append(f"{scene} {len(reached.get(nearest, {}))} of {len(accuracy.by_model(told))} within {100 * nearest:g} %")
    axes[0, 0].set_yticks(range(len(models)), [accuracy.NAMES[model] for model in models])
    max(axes[0], key=lambda panel: len(panel.get_legend_handles_labels()[0])).legend(title="within", loc="lower left", frameon=True, framealpha=0.9)
    figure.suptitle(f"Models that come near to the stated cloth: {', '.join(titles)}", x=0.01, ha="left", fontsize=11.5)
    return style.save(figure, out, "fig_accuracy_levels")


def _front_table(runs, scene, gap):
    return Table(f"{scene}: the front of the physical error", ["model", "substeps × iterations", "ms per frame", "projections per frame", "error (%)"],
                 [[accuracy.NAMES[run.model], accuracy.settings(run), style.number(accuracy.cost(run)),
                   f"{accuracy.projections(run):.3g}", accuracy.percent(accuracy.error(run), gap)] for run in accuracy.front(runs)])


def _stiffness_table(runs):
    """How stiff each front run of the cantilever is, against what it was told."""
    told, gap = 5e-5, accuracy.gap(runs)
    return Table("cantilever: stiffness error", ["model", "substeps × iterations", "ms per frame", "B measured over B told", "error (%)"],
                 [[accuracy.NAMES[run.model], accuracy.settings(run), style.number(accuracy.cost(run)),
                   style.number(run.summary.get("stiffness_flexural_rigidity", np.nan) / told), accuracy.percent(accuracy.error(run), gap)]
                  for some in accuracy.by_model(runs).values() for run in accuracy.front(some)])


def _fronts(scenes, out):
    figure, axes = plt.subplots(len(scenes), 2, figsize=(10.4, 0.6 + 4.1 * len(scenes)), layout="constrained", squeeze=False)
    titles = []
    for row, (scene, (told, paper)) in zip(axes, scenes.items()):
        for panel, (against, meaning) in zip(row, MEASURES):
            _front(panel, told, against)
            panel.set_ylabel(f"distance {meaning} (% of size)")
            panel.set_title(f"{scene}: {'the stated cloth' if against == 'physical' else 'its own equilibrium'}")
        for run in paper:
            if np.isfinite(accuracy.error(run)):
                row[0].scatter(accuracy.cost(run), 100 * accuracy.error(run), marker="*", s=110, color=style.MODEL_COLOURS[run.model],
                               edgecolors=style.INK, linewidths=0.6, zorder=3)
        titles.append(f"{scene}: {message(told, paper)}")
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
    figure.suptitle("\n".join(f"{scene}: {message(runs, [])}" for scene, runs in basins.items()), x=0.01, ha="left", fontsize=10.5)
    return style.save(figure, out, "fig_accuracy_basins")


def _legend(figure, panels, others=()):
    """Below all panels: every model that has a dot in one of them, in the order of the colours, then what else is drawn."""
    found = {label: handle for panel in panels for handle, label in zip(*panel.get_legend_handles_labels())}
    models = [found[name] for model, name in accuracy.NAMES.items() if name in found]
    figure.legend(handles=[*models, *others], loc="upper center", bbox_to_anchor=(0.5, -0.01), ncol=7)


def _front(panel, told, against):
    gap = accuracy.gap(told, against)
    for model, some in accuracy.by_model(told).items():
        points = [(accuracy.cost(run), 100 * accuracy.error(run, against=against)) for run in some]
        points = [point for point in points if np.isfinite(point).all()]
        if points:
            colour = style.MODEL_COLOURS[model]
            panel.scatter(*zip(*points), s=15, color=["white" if error < 100 * gap else colour for _, error in points], edgecolors=colour, linewidths=0.8)
            panel.scatter([], [], s=15, color=colour, label=accuracy.NAMES[model])
    best = accuracy.front(told, against=against)
    panel.step([accuracy.cost(run) for run in best], [100 * accuracy.error(run, against=against) for run in best], where="post", color=style.INK,
               linewidth=1, zorder=0)
    least = min((100 * accuracy.error(run, against=against) for run in told), default=np.nan)
    if 100 * gap < least / 5:  # a line that far below all dots would only shrink them
        panel.text(0.02, 0.02, f"reference known to {style.number(100 * gap, 2)} %", transform=panel.transAxes, fontsize=8, color=style.GREY)
    elif np.isfinite(gap):
        panel.axhline(100 * gap, color=style.GREY, linewidth=1, linestyle=":", zorder=0)
    panel.set_xscale("log"), panel.set_yscale("log")


def message(told, paper):
    """What the picture says of a scene, from its numbers."""
    parts = []
    for level in (0.05, 0.01):
        if level < accuracy.gap(told):
            parts.append(f"what is within {100 * level:g} % is not known")
            continue
        run = accuracy.reaching(told, level)
        parts.append(f"{accuracy.NAMES[run.model]} is within {100 * level:g} % in {style.number(accuracy.cost(run), 2)} ms" if run else f"none is within {100 * level:g} %")
    star = next((run for run in paper if run.model == "adaptive"), None)
    if star:
        parts.append(f"the paper's adaptive {style.number(100 * accuracy.error(star), 2)} % off in {style.number(accuracy.cost(star), 2)} ms")
    return ", ".join(parts)


if __name__ == "__main__":
    figure_main(main)
