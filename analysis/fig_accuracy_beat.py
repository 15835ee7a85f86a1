"""The paper's adaptive model at its default setting, and runs that are cheaper at its error or better in its
time.

The control is the paper's setting on fewer cells: how much does the coarser mesh alone gain?
"""
import right_python  # noqa: F401  (first: it may hand over to another Python)
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.lines import Line2D

import accuracy
import style
from bendlab.results.load import by_model, group
from report import Check, Section, Table, figure_main

TENTH = 0.1  # the goal: share of the paper's time, and of its error
SOURCE = "the paper's adaptive model: 64 cells, 10 iterations, 1/60 s, k = 0.5"


def main(results, out):
    section = Section("Nearer than the paper, for less", "accuracy_beat")
    paper = [run for run in accuracy.experiment_runs(results, section, "paper_64") if run.complete]
    coarse = [run for run in accuracy.experiment_runs(results, section, "paper_cells_slow") if run.complete]
    rest = [run for run in accuracy.experiment_runs(results, section, "beat") if run.complete]
    star = next((run for run in paper if run.model == "adaptive"), None)
    if star is None or not rest:
        return section
    line = sorted([*coarse, star], key=cells)
    section.text = text(rest, line, star)
    section.checks = [_check("time for the same error", rest, star, "time"),
                      _check("error in the same time", rest, star, "error")]
    section.pictures.append((_picture(rest, paper, line, star, out), "Small marks: models that are given the "
                             "stated cloth. Stars: the paper's setting; a line joins its adaptive model on "
                             "8 to 64 cells. Numbers are cells along a side. The reference is the stated "
                             "cloth on 96 cells."))
    section.tables += [_control_table(rest, line),
                       Table("The front, and the paper's setting", ["model", "cells", *COLUMNS],
                             [[accuracy.name_of(run.model), cells(run), *_numbers(run)]
                              for run in accuracy.front(rest) + line
                              + [run for run in paper if run is not star]])]
    return section


def cells(run):
    return run.get("/mesh/cells")


def chosen(runs, star):
    """(cheapest run with at most the star's error, best run in at most the star's time), or None."""
    return (accuracy.reaching(runs, accuracy.error(star)),
            min((run for run in runs if accuracy.cost(run) <= accuracy.cost(star)), key=accuracy.error,
                default=None))


def ratios(runs, star):
    """(time for the star's error over its time, error in the star's time over its error), or NaN."""
    faster, nearer = chosen(runs, star)
    return (accuracy.cost(faster) / accuracy.cost(star) if faster else np.nan,
            accuracy.error(nearer) / accuracy.error(star) if nearer else np.nan)


def text(rest, line, star):
    """The answer and its control, computed from the runs."""
    best = min(line, key=accuracy.error)
    asked, mesh, control = (ratios(runs, against)
                            for runs, against in ((rest, star), (line, star), (rest, best)))
    number = lambda value: style.number(value, 2)
    nearest = min(rest, key=accuracy.error)
    finer = (" But with the stated cloth finer meshes have smaller errors still, "
             f"{number(100 * accuracy.error(nearest))} % on {cells(nearest)} cells; with the paper's setting "
             "they do not." if cells(nearest) > cells(best) and accuracy.error(nearest) < accuracy.error(best)
             else "")
    return (f"The paper's default, on {cells(star)} cells, is not given a cloth. Its error is its distance "
            f"from the stated cloth, {number(100 * accuracy.error(star))} %. Runs that are given that cloth "
            f"reach the same error in {part(asked[0], 'its time')}, and {part(asked[1], 'its error')} in the "
            "same time. Coarser cells alone do much of that: the paper's own setting reaches the same error "
            f"in {part(mesh[0], 'the time')}, and on {cells(best)} cells its error is "
            f"{number(100 * accuracy.error(best))} %. This is its best. Compared with it, runs that are "
            f"given the cloth reach the same error in {part(control[0], 'the time')}, and "
            f"{part(control[1], 'the error')} in the same time.{finer}")


def part(ratio, of):
    """'0.33 % of the time' of a ratio below 1, '2.0 times the time' above."""
    if ratio < 1:
        return f"{style.number(100 * ratio, 2)} % of {of}"
    return f"{style.number(ratio, 2)} times {of}"


def _check(name, rest, star, which):
    index = ("time", "error").index(which)
    run = chosen(rest, star)[index]
    return Check(name, run.model if run else "any", f"{cells(run)} cells" if run else "–", TENTH,
                 ratios(rest, star)[index], 0, SOURCE, "most", note=f"{accuracy.settings(run)}; strain "
                 f"{style.number(100 * accuracy.error(run, 'strain'), 2)} % RMS" if run else "")


COLUMNS = ["substeps × iterations", "ms per frame", "error (%)", "strain (RMS, %)"]


def _numbers(run):
    return [accuracy.settings(run), style.number(accuracy.cost(run)), style.number(100 * accuracy.error(run)),
            style.number(100 * accuracy.error(run, "strain"))]


def _control_table(rest, line):
    """The paper's setting on every mesh, and runs that are given the cloth on the same mesh."""
    given, rows = group(rest, cells), []
    for star in (run for run in line if cells(run) in given):
        same = given[cells(star)]
        for what, run, ratio in zip(("time for its error", "error in its time"), chosen(same, star),
                                    ratios(same, star)):
            rows.append([cells(star), *_numbers(star)[1:], what, style.number(ratio),
                         *([accuracy.name_of(run.model), *_numbers(run)] if run else ["–"] * 5)])
    return Table("At equal cells: the paper's adaptive model, and models that are given the cloth on the "
                 "same mesh", ["cells", *COLUMNS[1:], "question", "ratio", "best model", *COLUMNS], rows)


def _picture(rest, paper, line, star, out):
    figure, axes = plt.subplots(figsize=(8.4, 4.8), layout="constrained")
    for model, some in by_model(rest).items():
        axes.scatter([accuracy.cost(run) for run in some], [100 * accuracy.error(run) for run in some], s=16,
                     marker=style.marker(model), color=style.colour(model),
                     label=accuracy.name_of(model), linewidths=0)
    best = accuracy.front(rest)
    axes.step(*_places(best), where="post", color=style.INK, linewidth=1, zorder=0)
    axes.plot(*_places(line), "--", color=style.colour("adaptive"), linewidth=1, zorder=1)
    for run in {cells(run): run for run in best[::-1]}.values():  # the cheapest of each mesh
        _number(axes, run, (-12, -3))
    for run in line:
        _number(axes, run, (6, 6) if cells(run) > 8 else (-10, -10))
    for run in [*line, *(run for run in paper if run is not star)]:
        axes.scatter(*_places([run]), marker="*", s=130, color=style.colour(run.model),
                     edgecolors=style.INK, linewidths=0.6, zorder=3)
    axes.axhline(100 * accuracy.error(star), color=style.GREY, linewidth=0.7, linestyle=":")
    axes.axvline(accuracy.cost(star), color=style.GREY, linewidth=0.7, linestyle=":")
    axes.set_xscale("log"), axes.set_yscale("log")
    axes.set_xlabel("CPU time per frame of 1/60 s (ms)"), axes.set_ylabel(
        "distance from the stated cloth (% of size)")
    stars = [Line2D([], [], marker="*", markersize=10, color=style.colour(run.model),
                    markeredgecolor=style.INK, markeredgewidth=0.6, linestyle="--" if run is star else "",
                    linewidth=1,
                    label="the paper's "
                    f"{accuracy.name_of(run.model)}{', 8 to 64 cells' if run is star else ', 64 cells'}")
             for run in sorted(paper, key=lambda run: run is not star)]
    axes.legend(handles=[*axes.get_legend_handles_labels()[0], *stars], loc="upper left",
                bbox_to_anchor=(1, 1))
    figure.suptitle(message(rest, line, star), x=0.01, ha="left", fontsize=11.5)
    return style.save(figure, out, "fig_accuracy_beat")


def _places(runs):
    return [accuracy.cost(run) for run in runs], [100 * accuracy.error(run) for run in runs]


def _number(axes, run, away):
    axes.annotate(cells(run), (accuracy.cost(run), 100 * accuracy.error(run)), xytext=away,
                  textcoords="offset points", fontsize=7)


def message(rest, line, star):
    """Both ratios, compared with the paper's default, and with its setting on its best mesh."""
    best = min(line, key=accuracy.error)
    (time, error), (control_time, control_error) = ratios(rest, star), ratios(rest, best)
    return (f"Compared with the paper's default on {cells(star)} cells: the same error in "
            f"{part(time, 'the time')}; {part(error, 'the error')} in the same time.\nCompared with its "
            f"setting on {cells(best)} cells, its best: the same error in {part(control_time, 'the time')}; "
            f"{part(control_error, 'the error')} in the same time")


if __name__ == "__main__":
    figure_main(main)
