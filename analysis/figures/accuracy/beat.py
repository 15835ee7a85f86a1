"""Compares the paper's adaptive model at its default setting (the run `star`) with models that have the
stated stiffness. Which run takes less time for the same error? Which run is more exact in the same time?

The control: the paper's setting on coarser meshes. How much does a coarser mesh alone gain?
"""
import numpy as np

from bendlab.results.load import by_model, group
from figures.accuracy.measures import (cells, complete_runs, cost, error, front_rows, name_of, percent, row,
                                       settings, table, with_error)
from tables.numbers import number

TENTH = 0.1  # limit of the checks, relative to the time and the error of the paper's default


def main(results, out, section):
    paper, coarse, rest = (with_error(section, complete_runs(results, section, name))
                           for name in ("paper_64", "paper_cells_slow", "beat"))
    star = next((run for run in paper if run.model == "adaptive"), None)
    if star is None or not rest:
        return
    line = sorted([*coarse, star], key=cells)
    section.text = text(rest, line, star)
    for what, run, ratio in answers(rest, star):
        section.add_check(what, run.model if run else "any", f"{cells(run)} cells" if run else "–", TENTH,
                          ratio, 0, "the paper's adaptive model: 64 cells, 10 iterations, 1/60 s, k = 0.5",
                          "most",
                          f"{settings(run)}; strain {percent(error(run, 'strain'))} RMS" if run else "")
    same_mesh = group(rest, cells)
    section.tables.append(table("control", "On equal meshes: the paper's adaptive model, and models with the "
                                           "stated stiffness", [
        ("paper_cells", "cells"), ("paper_ms", "ms per frame"), ("paper_error_physical", "error", "", "%"),
        ("what", "compared"), "ratio", ("name", "best model"), "settings", "ms", "error_physical", "strain"],
        [{f"paper_{name}": value for name, value in row(coarser).items()} | {"what": what, "ratio": ratio}
         | (row(run) if run else {}) for coarser in line if cells(coarser) in same_mesh
         for what, run, ratio in answers(same_mesh[cells(coarser)], coarser)]))
    rows = [front_row for model, own_runs in by_model(rest).items()
            for front_row in front_rows(own_runs, curve=name_of(model))]
    rows += [row(run) | {"curve": f"{run.model}, the paper's setting"}
             for run in [*line, *(run for run in paper if run is not star)]]
    section.add_chart(
        table("beat", "The front (the best runs) of each model, and the paper's setting", [
            ("curve", "model"), "cells", "settings", "ms", "error_physical", "strain"], rows),
        "The paper's setting, and models with the stated stiffness", "ms", ["error_physical"], ["curve"],
        y_scale="log",
        limits=[("error_physical", 100 * error(star), f"the paper's default on {cells(star)} cells")],
        note=f"{message(rest, line, star)}. Meshes have 8 to 32 cells with the stated stiffness, and 8 to 64 "
             "cells with the paper's setting.")


def answers(runs, star):
    """[(question, run that answers it or None, its time or error relative to the star)]: the cheapest run
    with at most the star's error, and the most accurate run in at most the star's time."""
    near = [run for run in runs if error(run) <= error(star)]
    fast = [run for run in runs if cost(run) <= cost(star)]
    best = (("time for the same error", min(near, key=cost, default=None), cost),
            ("error in the same time", min(fast, key=error, default=None), error))
    return [(what, run, of(run) / of(star) if run else np.nan) for what, run, of in best]


def ratios(runs, star):
    """The ratios of answers(): time, error."""
    return [ratio for *_, ratio in answers(runs, star)]


def comparison(runs, star):
    """The ratios as text."""
    time, of_error = ratios(runs, star)
    return (f"need {part(time, 'the time')} for the same error, and have {part(of_error, 'the error')} in "
            "the same time")


def text(rest, line, star):
    """The answer as text, with the control."""
    best, nearest = min(line, key=error), min(rest, key=error)
    finer = ""
    if cells(nearest) > cells(best) and error(nearest) < error(best):
        finer = (" With the stated stiffness the error decreases on finer meshes, to "
                 f"{percent(error(nearest))} on {cells(nearest)} cells. With the paper's setting the error "
                 "does not decrease.")
    return (f"The paper's default, on {cells(star)} cells, has an error of {percent(error(star))}, its "
            "distance from the stated cloth. Models with the stiffness of that cloth "
            f"{comparison(rest, star)}. A coarser mesh alone explains much of this gain: on a coarser mesh "
            f"the paper's setting needs {part(ratios(line, star)[0], 'the time')} for the same error. Its "
            f"error is smallest, {percent(error(best))}, on {cells(best)} cells. Compared with this run, "
            f"models with the stated stiffness {comparison(rest, best)}.{finer}")


def part(ratio, of):
    """A ratio as text: '0.33 % of the time' below 1, otherwise '2.0 times the time'."""
    return f"{percent(ratio)} of {of}" if ratio < 1 else f"{number(ratio, 2)} times {of}"


def message(rest, line, star):
    """The ratios as text, compared with the paper's default and with the paper's setting on its best mesh."""
    best = min(line, key=error)
    return (f"Compared with the paper's default on {cells(star)} cells, models with the stated stiffness "
            f"{comparison(rest, star)}. Compared with the paper's setting on {cells(best)} cells, where its "
            f"error is smallest, these models {comparison(rest, best)}")
