"""Compares the paper's adaptive model at its default setting (the run `star`) with models that have the
stated stiffness. Which run takes less time for the same error? Which run is more exact in the same time?

The control: the paper's setting on coarser meshes. How much does a coarser mesh alone gain?
"""
import numpy as np

from bendlab.results.load import by_model, group
from figures.accuracy import measures
from tables.chart import Chart
from tables.numbers import number
from tables.section import Check

TENTH = 0.1  # limit of the checks, relative to the time and the error of the paper's default
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
        "beat", "The front (the best runs) of each model, and the paper's setting",
        [("curve", "model"), "cells", "settings", "ms", "error_physical", "strain"], rows)]
    section.charts = [Chart("beat", "The paper's setting, and models with the stated stiffness", "beat", "ms",
                            ["error_physical"], ["curve"],
                            y_scale="log", limits=[("error_physical", 100 * measures.error(star),
                                                    f"the paper's default on {cells(star)} cells")],
                            note=message(rest, line, star) + ". Meshes have 8 to 32 cells with the "
                                                             "stated stiffness, and 8 to 64 cells with the "
                                                             "paper's setting.")]


def cells(run):
    return run.get("/mesh/cells")


def chosen(runs, star):
    """(cheapest run with at most the star's error, most accurate run in at most the star's time), or None."""
    return (measures.reaching(runs, measures.error(star)),
            min((run for run in runs if measures.cost(run) <= measures.cost(star)), key=measures.error,
                default=None))


def ratios(runs, star):
    """(time of the first run of chosen(), error of the second run), relative to the star; or NaN."""
    faster, nearer = chosen(runs, star)
    return (measures.cost(faster) / measures.cost(star) if faster else np.nan,
            measures.error(nearer) / measures.error(star) if nearer else np.nan)


def text(rest, line, star):
    """The answer as text, with the control."""
    best = min(line, key=measures.error)
    asked, mesh, control = (ratios(runs, against)
                            for runs, against in ((rest, star), (line, star), (rest, best)))
    nearest = min(rest, key=measures.error)
    finer = (" With the stated stiffness the error decreases on finer meshes, to "
             f"{measures.percent(measures.error(nearest))} on {cells(nearest)} cells. With the paper's "
             "setting the error does not decrease." if cells(nearest) > cells(best)
             and measures.error(nearest) < measures.error(best)
             else "")
    return (f"The paper's default, on {cells(star)} cells, has an error of "
            f"{measures.percent(measures.error(star))}, its distance from the stated cloth. Models with the "
            f"stiffness of that cloth need {part(asked[0], 'the time')} for the same error, and have "
            f"{part(asked[1], 'the error')} in the same time. A coarser mesh alone explains much of this "
            f"gain: on a coarser mesh the paper's setting needs {part(mesh[0], 'the time')} for the same "
            f"error. Its error is smallest, {measures.percent(measures.error(best))}, on {cells(best)} "
            f"cells. Compared with this run, models with the stated stiffness need "
            f"{part(control[0], 'the time')} for the same error, and have {part(control[1], 'the error')} "
            f"in the same time.{finer}")


def part(ratio, of):
    """A ratio as text: '0.33 % of the time' below 1, otherwise '2.0 times the time'."""
    if ratio < 1:
        return f"{measures.percent(ratio)} of {of}"
    return f"{number(ratio, 2)} times {of}"


def _check(name, rest, star, which):
    run = chosen(rest, star)[which]
    return Check(name, run.model if run else "any", f"{cells(run)} cells" if run else "–", TENTH,
                 ratios(rest, star)[which], 0, SOURCE, "most", note=f"{measures.settings(run)}; strain "
                 f"{measures.percent(measures.error(run, 'strain'))} RMS" if run else "")


def _control_table(rest, line):
    """For every mesh: the run with the paper's setting, and the best runs with the stated stiffness."""
    given, rows = group(rest, cells), []
    for star in (run for run in line if cells(run) in given):
        same = given[cells(star)]
        for what, run, ratio in zip(("time for the same error", "error in the same time"), chosen(same, star),
                                    ratios(same, star)):
            of_star = {f"paper_{name}": value for name, value in measures.row(star).items()}
            rows.append(of_star | {"what": what, "ratio": ratio} | (measures.row(run) if run else {}))
    return measures.table("control", "On equal meshes: the paper's adaptive model, and models with the "
                                     "stated stiffness", [
                              ("paper_cells", "cells"), ("paper_ms", "ms per frame"),
                              ("paper_error_physical", "error", "", "%"), ("what", "compared"), "ratio",
                              ("name", "best model"), "settings", "ms", "error_physical", "strain"], rows)


def message(rest, line, star):
    """The ratios as text, compared with the paper's default and with the paper's setting on its best mesh."""
    best = min(line, key=measures.error)
    (time, error), (control_time, control_error) = ratios(rest, star), ratios(rest, best)
    return (f"Compared with the paper's default on {cells(star)} cells, models with the stated stiffness "
            f"need {part(time, 'the time')} for the same error, and have {part(error, 'the error')} in the "
            f"same time. Compared with the paper's setting on {cells(best)} cells, where its error is "
            f"smallest, these models need {part(control_time, 'the time')} for the same error, and have "
            f"{part(control_error, 'the error')} in the same time")
