"""What accuracy costs: error against CPU time of every bending model told the same cloth, and who gets how near for how much."""
import matplotlib.pyplot as plt
import numpy as np

import accuracy
import style
from report import Section, Table, figure_main

PAPER = "10 rounds, 1/60 s, k = 0.5"  # the paper's own setting
MEASURES = (("physical", "from the stated cloth"), ("solver", "from its own equilibrium"))
SCENES = {"curtain on two pins": (accuracy.FRONTS[0], "paper"), "cantilever": (accuracy.FRONTS[1], "paper_cantilever")}
BASINS = {"drape": "front_drape_slow", "sheet on one pin": "front_one_pin_slow"}  # of many equilibria


def main(results, out):
    section = Section("Error against time", "accuracy")
    section.text = ("A sheet of 40 cm hangs at two pins, and a strip of 8 cm is clamped at one end; every model is told the same cloth (B = 5·10⁻⁵ N m, "
                    "0.2 kg/m²). The physical error is the distance to that cloth: calibrated hinges on finer cells (curtain 96, cantilever 48) in static "
                    "equilibrium. The solver error is that to the equilibrium of the model's own energies on the same mesh. Distances are root "
                    "mean squares over the sheet, in diagonals of its rest shape; time is the CPU time of the steps for a frame of 1/60 s. The curtain "
                    "hangs by its weight, and hardly asks for bending; nothing else holds up the strip.")
    scenes = {}
    for scene, (told, paper) in SCENES.items():
        runs = accuracy.experiment_runs(results, section, *told), accuracy.experiment_runs(results, section, paper)
        if runs[0]:
            scenes[scene] = runs
    if scenes:
        gaps = ", ".join(f"{scene} {style.number(100 * gap(told), 2)} %" for scene, (told, _) in scenes.items())
        section.pictures.append((_fronts(scenes, out), f"Every run is a dot, the line is the front: no run is cheaper and nearer. Stars are the paper's setting ({PAPER}), "
                                 f"which names no cloth and has no solver error. The stated cloth differs by this from that on half as many cells: {gaps}. Models whose "
                                 "equilibrium Newton's method does not find (Choi-Ko) have no solver error."))
        section.pictures.append((_levels(scenes, out), "CPU time per frame of the cheapest run of each model that is as near to the stated cloth; a model without a mark came no "
                                 "nearer in any run of the sweep."))
    for scene, (told, paper) in scenes.items():
        section.tables += [levels_table(told, scene, against, meaning) for against, meaning in MEASURES]
        section.tables.append(_front_table(told + paper, scene))
    basins = {scene: runs for scene, config in BASINS.items() if (runs := [run for run in accuracy.experiment_runs(results, section, config) if run.complete])}
    if basins:
        section.pictures.append((_basins(basins, out), "Scenes of many equilibria: each run against the equilibrium of the stated cloth that Newton's method finds from where the "
                                 "run ends, on the same mesh, after the best turn about the vertical. Another run may end in another fold."))
        section.tables += [levels_table(runs, scene, *MEASURES[0]) for scene, runs in basins.items()]
    if "cantilever" in scenes:
        section.tables.append(_stiffness_table(sum(scenes["cantilever"], [])))
    return section


def gap(runs):
    """Distance of the physical reference from one on coarser cells."""
    return max((run.summary.get("error_physical_reference_gap", np.nan) for run in runs), default=np.nan)


def levels_table(runs, scene, against, meaning):
    """Model × the time that its cheapest run within each level takes."""
    rows = []
    for model, some in accuracy.by_model(runs).items():
        row = [accuracy.NAMES[model]]
        for level in accuracy.LEVELS:
            run = accuracy.reaching(some, level, against=against)
            row += [style.number(accuracy.cost(run)) if run else "–", accuracy.settings(run) if run else ""]
        best = min((accuracy.error(run, against=against) for run in some), default=np.nan)
        rows.append([*row, style.number(100 * best)])
    columns = [part for level in accuracy.LEVELS for part in (f"ms to {100 * level:g} %", "substeps × iterations")]
    return Table(f"{scene}: CPU time per frame of the cheapest run within an error, {meaning}", ["model", *columns, "least error (%)"], rows)


def _levels(scenes, out):
    figure, axes = plt.subplots(1, len(scenes), figsize=(10.4, 4.2), layout="constrained", squeeze=False, sharey=True)
    models = list(accuracy.by_model(sum((told for told, _ in scenes.values()), [])))[::-1]
    titles = []
    for panel, (scene, (told, _)) in zip(axes[0], scenes.items()):
        reached = {level: {} for level in accuracy.LEVELS}
        for model, some in accuracy.by_model(told).items():
            for level in accuracy.LEVELS:
                run = accuracy.reaching(some, level)
                if run:
                    reached[level][model] = accuracy.cost(run)
        for level, marker, colour in zip(accuracy.LEVELS, "os^", style.SEQUENCE):
            panel.plot(list(reached[level].values()), [models.index(model) for model in reached[level]], marker, color=colour, label=f"{100 * level:g} %")
        panel.set_xscale("log")
        panel.set_xlabel("CPU time per frame of 1/60 s (ms)")
        panel.set_title(scene)
        titles.append(f"{scene} {len(reached[accuracy.LEVELS[-1]])} of {len(accuracy.by_model(told))}")
    axes[0, 0].set_yticks(range(len(models)), [accuracy.NAMES[model] for model in models])
    axes[0, 0].legend(title="within")
    figure.suptitle(f"Models that come within {100 * accuracy.LEVELS[-1]:g} % of the stated cloth: {', '.join(titles)}", x=0.01, ha="left", fontsize=11.5)
    return style.save(figure, out, "fig_accuracy_levels")


def _front_table(runs, scene):
    return Table(f"{scene}: the front of the physical error", ["model", "substeps × iterations", "ms per frame", "projections per frame", "error (%)"],
                 [[accuracy.NAMES[run.model], accuracy.settings(run), style.number(accuracy.cost(run)),
                   f"{accuracy.projections(run):.3g}", style.number(100 * accuracy.error(run))] for run in accuracy.front(runs)])


def _stiffness_table(runs):
    """How stiff each front run of the cantilever is, against what it was told."""
    told = 5e-5
    return Table("cantilever: stiffness error", ["model", "substeps × iterations", "ms per frame", "B measured over B told", "error (%)"],
                 [[accuracy.NAMES[run.model], accuracy.settings(run), style.number(accuracy.cost(run)),
                   style.number(run.summary.get("stiffness_flexural_rigidity", np.nan) / told), style.number(100 * accuracy.error(run))]
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
    style.legend_below(figure, axes[0, 1], 6)
    figure.suptitle("\n".join(titles), x=0.01, ha="left", fontsize=10.5)
    return style.save(figure, out, "fig_accuracy")


def _basins(basins, out):
    figure, axes = plt.subplots(1, len(basins), figsize=(10.4, 4.4), layout="constrained", squeeze=False)
    for panel, (scene, runs) in zip(axes[0], basins.items()):
        _front(panel, runs, "physical")
        panel.set_title(scene)
        panel.set_xlabel("CPU time per frame of 1/60 s (ms)")
        panel.set_ylabel("distance from the stated cloth (% of size)")
    style.legend_below(figure, axes[0, 0], 6)
    figure.suptitle("\n".join(f"{scene}: {message(runs, [])}" for scene, runs in basins.items()), x=0.01, ha="left", fontsize=10.5)
    return style.save(figure, out, "fig_accuracy_basins")


def _front(panel, told, against):
    for model, some in accuracy.by_model(told).items():
        points = [(accuracy.cost(run), 100 * accuracy.error(run, against=against)) for run in some]
        points = [point for point in points if np.isfinite(point).all()]
        if points:
            panel.scatter(*zip(*points), s=15, color=style.MODEL_COLOURS[model], label=accuracy.NAMES[model], alpha=0.85, linewidths=0)
    best = accuracy.front(told, against=against)
    panel.step([accuracy.cost(run) for run in best], [100 * accuracy.error(run, against=against) for run in best], where="post", color=style.INK,
               linewidth=1, zorder=0)
    panel.set_xscale("log"), panel.set_yscale("log")


def message(told, paper):
    """What the picture says of a scene, from its numbers."""
    parts = []
    for level in (0.05, 0.01):
        run = accuracy.reaching(told, level)
        parts.append(f"{accuracy.NAMES[run.model]} is within {100 * level:g} % in {style.number(accuracy.cost(run), 2)} ms" if run else f"none is within {100 * level:g} %")
    star = next((run for run in paper if run.model == "adaptive"), None)
    if star:
        parts.append(f"the paper's adaptive {style.number(100 * accuracy.error(star), 2)} % off in {style.number(accuracy.cost(star), 2)} ms")
    return ", ".join(parts)


if __name__ == "__main__":
    figure_main(main)
