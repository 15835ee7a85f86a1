"""The paper's adaptive model at its default setting, and runs that are cheaper at its error or better in its
time.

The control is the paper's setting on fewer cells: how much does the coarser mesh alone gain?
"""
import numpy as np

from bendlab.results.load import by_model, group
from figures.accuracy import measures
from tables.chart import Chart
from tables.numbers import number
from tables.section import Check

TENTH = 0.1  # the limit of the checks: a share of the paper's time, and of its error
SOURCE = "the paper's adaptive model: 64 cells, 10 iterations, 1/60 s, k = 0.5"


def main(results, out, section):
    paper, coarse, rest = ([run for run in measures.experiment_runs(results, section, name) if run.complete]
                           for name in ("paper_64", "paper_cells_slow", "beat"))
    star = next((run for run in paper if run.model == "adaptive"), None)
    if star is None or not rest:
        return
    line = sorted([*coarse, star], key=cells)
    section.text = text(rest, line, star)
    section.checks = [_check("time for the same error", rest, star, 0),
                      _check("error in the same time", rest, star, 1)]
    rows = [measures.row(run) | {"curve": measures.name_of(model)}
            for model, own_runs in by_model(rest).items() for run in measures.front(own_runs)]
    rows += [measures.row(run) | {"curve": f"{run.model}, the paper's setting"}
             for run in [*line, *(run for run in paper if run is not star)]]
    section.tables = [_control_table(rest, line), measures.table(
        "beat", "The front of each model, and the paper's setting",
        [("curve", "model"), "cells", "settings", "ms", "error_physical", "strain"], rows)]
    section.charts = [Chart("beat", "The paper's setting, and models whose cloth is stated", "beat", "ms",
                            ["error_physical"], ["curve"],
                            y_scale="log", limits=[("error_physical", 100 * measures.error(star),
                                                    f"the paper's default on {cells(star)} cells")],
                            note=message(rest, line, star) + ". Models whose cloth is stated, on 8 to 32 "
                                                             "cells; and the paper's setting, its adaptive "
                                                             "model on 8 to 64 cells.")]


def cells(run):
    return run.get("/mesh/cells")


def chosen(runs, star):
    """(cheapest run with at most the star's error, best run in at most the star's time), or None."""
    return (measures.reaching(runs, measures.error(star)),
            min((run for run in runs if measures.cost(run) <= measures.cost(star)), key=measures.error,
                default=None))


def ratios(runs, star):
    """(time for the star's error over its time, error in the star's time over its error), or NaN."""
    faster, nearer = chosen(runs, star)
    return (measures.cost(faster) / measures.cost(star) if faster else np.nan,
            measures.error(nearer) / measures.error(star) if nearer else np.nan)


def text(rest, line, star):
    """The answer and its control, computed from the runs."""
    best = min(line, key=measures.error)
    asked, mesh, control = (ratios(runs, against)
                            for runs, against in ((rest, star), (line, star), (rest, best)))
    nearest = min(rest, key=measures.error)
    finer = (" But with the stated cloth finer meshes have smaller errors still, "
             f"{measures.percent(measures.error(nearest))} on {cells(nearest)} cells; with the paper's "
             "setting they do not." if cells(nearest) > cells(best)
             and measures.error(nearest) < measures.error(best)
             else "")
    return (f"The paper's default, on {cells(star)} cells, is not given a cloth. Its error is its distance "
            f"from the stated cloth, {measures.percent(measures.error(star))}. Runs that are given that "
            f"cloth reach the same error in {part(asked[0], 'its time')}, and {part(asked[1], 'its error')} "
            "in the same time. Coarser cells alone do much of that: the paper's own setting reaches the same "
            f"error in {part(mesh[0], 'the time')}, and on {cells(best)} cells its error is "
            f"{measures.percent(measures.error(best))}. This is its best. Compared with it, runs that are "
            f"given the cloth reach the same error in {part(control[0], 'the time')}, and "
            f"{part(control[1], 'the error')} in the same time.{finer}")


def part(ratio, of):
    """'0.33 % of the time' of a ratio below 1, '2.0 times the time' above."""
    if ratio < 1:
        return f"{measures.percent(ratio)} of {of}"
    return f"{number(ratio, 2)} times {of}"


def _check(name, rest, star, which):
    run = chosen(rest, star)[which]
    return Check(name, run.model if run else "any", f"{cells(run)} cells" if run else "–", TENTH,
                 ratios(rest, star)[which], 0, SOURCE, "most", note=f"{measures.settings(run)}; strain "
                 f"{measures.percent(measures.error(run, 'strain'))} RMS" if run else "")


def _control_table(rest, line):
    """The paper's setting on every mesh, and runs that are given the cloth on the same mesh."""
    given, rows = group(rest, cells), []
    for star in (run for run in line if cells(run) in given):
        same = given[cells(star)]
        for what, run, ratio in zip(("time for its error", "error in its time"), chosen(same, star),
                                    ratios(same, star)):
            of_star = {f"paper_{name}": value for name, value in measures.row(star).items()}
            rows.append(of_star | {"what": what, "ratio": ratio} | (measures.row(run) if run else {}))
    return measures.table("control", "At equal cells: the paper's adaptive model, and models that are given "
                                     "the cloth on the same mesh", [
                              ("paper_cells", "cells"), ("paper_ms", "ms per frame"),
                              ("paper_error_physical", "error", "", "%"), ("what", "question"), "ratio",
                              ("name", "best model"), "settings", "ms", "error_physical", "strain"], rows)


def message(rest, line, star):
    """Both ratios, compared with the paper's default, and with its setting on its best mesh."""
    best = min(line, key=measures.error)
    (time, error), (control_time, control_error) = ratios(rest, star), ratios(rest, best)
    return (f"Compared with the paper's default on {cells(star)} cells: the same error in "
            f"{part(time, 'the time')}; {part(error, 'the error')} in the same time. Compared with its "
            f"setting on {cells(best)} cells, its best: the same error in {part(control_time, 'the time')}; "
            f"{part(control_error, 'the error')} in the same time")
