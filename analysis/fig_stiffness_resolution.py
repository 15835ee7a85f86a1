"""Stiffness over resolution with the paper's settings: every model on four kinds of mesh."""
import right_python  # noqa: F401  (first: it may hand over to another Python)
import matplotlib.pyplot as plt
import numpy as np

import strips
import style
from bendlab.results.load import by_model, group
from report import Check, Section, Table, figure_main

FAMILY_LOOKS = {"equilateral": ("#0072b2", "o-"), "same": ("#d55e00", "s-"), "alternating": ("#e69f00", "^-"),
                "delaunay": ("#009e73", "D-")}
CLAIMED = ("adaptive", "lod")  # the paper's own models


def main(results, out):
    section = Section("Stiffness against resolution, by the paper's rule", "resolution")
    runs = strips.experiment_runs(results, section, "resolution", "resolution_slow")
    section.text = ("The paper states that the stiffness of its adaptive springs stays the same when the "
                    "resolution changes. Here every model has the paper's settings: k = 0.5, 1/60 s, 10 "
                    "iterations, levels from eq. 6. Gravity is a tenth, so that the finest strips still have "
                    "a measurable shape. The number is B from H/W, for springs a rigidity at the curvature "
                    "of this load; below about 10⁻⁶ N m the fold at the clamp is narrower than three rows, "
                    "so that B also depends on the mesh.")
    for (model, family), some in group(runs, lambda run: (run.model, strips.family(run))).items():
        if model in CLAIMED:
            section.checks.append(Check("largest ratio of B between two resolutions", model,
                                        _range(some, family), 1.15, ratio(some), 0,
                                        "the paper: the stiffness does not change with resolution", "most",
                                        note=f"level m {_levels(some)}"))
    if runs:
        section.pictures.append((_picture(runs, out), "Grey, dotted: the same meshes without bending (no "
                                 "point where they hang straight down)."))
        section.tables.append(_table(runs))
    return section


def ratio(runs):
    """Largest over smallest B of runs of one model and kind of mesh."""
    return strips.largest_ratio([strips.rigidity(run) for run in runs])


def _levels(runs):
    """Level m of eq. 6 from coarse to fine, as text; – for models without."""
    levels = [strips.number(run, "model_m") for run in sorted(runs, key=strips.cells)]
    return ", ".join(f"{level:.0f}" for level in levels if np.isfinite(level)) or "–"


def _range(runs, family):
    counts = sorted({strips.cells(run) for run in runs})
    return f"{strips.MESH_NAMES[family]}, {counts[0]} to {counts[-1]} cells"


def _picture(runs, out):
    models = [model for model in by_model(runs) if model != "none"]
    columns = 4
    rows = len(models) // columns + 1  # with room for the legend
    figure, axes = plt.subplots(rows, columns, figsize=(11.2, 0.2 + 2.4 * rows), layout="constrained",
                                sharex=True, sharey=True, squeeze=False)
    by_place = group(runs, lambda run: (run.model, strips.family(run)))
    counts = sorted({strips.cells(run) for run in runs})
    for panel, model in zip(axes.flat, models):
        worst = []
        for family, (colour, look) in FAMILY_LOOKS.items():
            for name in ("none", model):
                some = sorted(by_place.get((name, family), []), key=strips.cells)
                x, y = [strips.cells(run) for run in some], [strips.rigidity(run) for run in some]
                if name == "none":
                    panel.plot(x, y, ":", color=style.GREY, linewidth=0.9)
                else:
                    panel.plot(x, y, look, color=colour, markersize=4, label=strips.MESH_NAMES[family])
                    worst.append(ratio(some))
        panel.set_title(
            f"{strips.model_name(by_place[model, next(f for m, f in by_place if m == model)][0])}: up to "
            f"{style.number(np.nanmax(worst), 2)} ×")
        panel.set_yscale("log")
        style.resolution_axis(panel, counts)
        panel.set_xlabel("")
    for panel in axes.flat[len(models):]:
        panel.set_axis_off()
    axes.flat[len(models)].legend(*axes.flat[0].get_legend_handles_labels(), loc="center")
    for row in axes:
        row[0].set_ylabel("B from H/W (N m)")
    for panel in axes[-1]:
        panel.set_xlabel("cells along the strip")
    paper = [ratio(some) for (model, _), some in by_place.items() if model in CLAIMED]
    others = [ratio(some) for (model, _), some in by_place.items() if model not in (*CLAIMED, "none")]
    figure.suptitle(f"From {counts[0]} to {counts[-1]} cells the stiffness of the paper's models changes by "
                    f"factors of {style.number(np.nanmin(paper), 2)} to {style.number(np.nanmax(paper), 2)}, "
                    f"that of the others by {style.number(np.nanmin(others), 2)} to "
                    f"{style.number(np.nanmax(others), 2)}", x=0.01, ha="left", fontsize=11.5)
    return style.save(figure, out, "fig_stiffness_resolution")


def _table(runs):
    counts = sorted({strips.cells(run) for run in runs})
    rows = []
    for (model, family), some in group(sorted(runs, key=lambda run: run.model),
                                       lambda run: (run.model, strips.family(run))).items():
        values = {strips.cells(run): strips.rigidity(run) for run in some}
        rows.append([model, strips.MESH_NAMES[family], *(style.number(values.get(n, np.nan)) for n in counts),
                     style.number(ratio(some)),
                     _levels(some)])
    return Table("B from H/W (N m)", ["model", "mesh", *(f"{n} cells" for n in counts), "largest ratio",
                                      "level m"], rows)


if __name__ == "__main__":
    figure_main(main)
