"""Makes the cells of a verdict map (tables/claim_map.py) from runs, and chooses the runs to compare."""
from dataclasses import replace

import numpy as np

from tables.claim_map import Cell
from bendlab.results.load import group
from runs.repeat import commands


class NotMeasured(Exception):
    """A verdict needs a number that is missing or not finite."""


def cell(runs, judge):
    """The cell of these runs. `judge` returns the text of the cell, and whether the claim holds there. If a
    run or a number is missing, the cell is open. If a run diverged, the cell fails, for every claim."""
    made = Cell("not run", None, "\n".join(commands(runs)), seeds(runs), open=True)
    if not runs or not all(run.over for run in runs):
        return made
    made.open = False
    if any(run.status == "diverged" for run in runs):
        made.text, made.holds = "diverged", False
        return made
    try:
        made.text, holds = judge()
        made.holds = None if holds is None else bool(holds)
    except NotMeasured:
        made.text, made.open = "not measured", True
    return made


def median(runs, name, offset=0):
    """Median of a metric over runs, minus `offset`. NotMeasured if a run lacks the metric."""
    values = [run.summary.get(name, np.nan) for run in runs]
    if not values or not np.isfinite(values).all():
        raise NotMeasured(name)
    return float(np.median(values)) - offset


def seeds(runs):
    return tuple(sorted({run.get("/initial/seed") for run in runs} - {None}))


def same_seeds(groups):
    """The groups, reduced to the seeds that occur in every group."""
    common = set.intersection(*(set(seeds(runs)) for runs in groups))
    return [[run for run in runs if run.get("/initial/seed") in common] for runs in groups]


def noted(made, runs):
    """Adds the seeds of a cell to its text, if `runs` contain other seeds, too."""
    if made.holds is not None and made.seeds != seeds(runs):
        made.text += f" ({made.seeds_text})"
    return made


def rows(groups, needed):
    """Rows [{place: runs}] of places that differ only in N, sorted by N. `groups`: place → runs.

    Verdicts of rows are comparable, because all rows have the same N: those of `needed`, and finer N that
    exist in every row. If a row lacks an N, the runs are None. All places of a row have the same seeds.
    """
    by_row = group(groups, lambda place: (place.rounding, place.damping, place.solver, place.pins)).values()
    shared = set.intersection(*({place.cells for place in row} for row in by_row)) if by_row else set()
    compared = sorted({*needed, *(n for n in shared if n > max(needed))})
    return [_row(groups, places, compared) for places in by_row]


def _row(groups, places, compared):
    by_cells = {place.cells: groups[place] for place in places if place.cells in compared}
    equal = dict(zip(by_cells, same_seeds(by_cells.values())))
    return {places[0].at(n): equal.get(n) for n in compared}


def row_cells(row, groups, number, show, verdict):
    """The cells of a row. Each cell has its own number, but all cells have one verdict.

    number(runs) measures the number of a cell, show(number) is its text, and verdict(numbers) judges all
    numbers of the row, from coarse to fine meshes. `groups` has the runs with all seeds.
    """
    def judge():
        if None in row.values():
            raise NotMeasured("a mesh that other rows have")
        return "", verdict([number(runs) for runs in row.values()])

    whole = cell([run for runs in row.values() for run in runs or []], judge)
    made = {}
    for place, runs in row.items():
        own = cell(runs or [], lambda: (show(number(runs)), True))
        made[place] = noted(replace(whole, text=own.text, seeds=own.seeds), groups.get(place, []))
    return made
