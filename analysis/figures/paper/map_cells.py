"""Makes the cells of a verdict map (tables/claim_map.py) from runs, and chooses the runs to compare."""
from dataclasses import replace

import numpy as np

from bendlab.results.load import group
from runs.repeat import commands
from tables.claim_map import Cell


class NotMeasured(Exception):
    """A verdict needs a number that is missing or not finite."""


def cell(judge, *groups):
    """The cell of these groups of runs. judge(*groups) returns the text of the cell, and whether the claim
    holds there. If a run or a number is missing, the cell is open. If a run diverged, the cell fails, for
    every claim."""
    runs = sum(groups, [])
    made = Cell("not run", None, "\n".join(commands(runs)), seeds(runs), open=True)
    if not runs or not all(run.over for run in runs):
        return made
    if any(run.status == "diverged" for run in runs):
        return replace(made, text="diverged", holds=False, open=False)
    try:
        text, holds = judge(*groups)
    except NotMeasured:
        return replace(made, text="not measured")
    return replace(made, text=text, holds=None if holds is None else bool(holds), open=False)


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
    exist in every row. If a row lacks an N, it has no runs there. All places of a row have the same seeds.
    """
    by_row = group(groups, lambda place: place.at(0)).values()
    shared = set.intersection(*({place.cells for place in row} for row in by_row)) if by_row else set()
    compared = sorted({*needed, *(n for n in shared if n > max(needed))})
    made = []
    for places in by_row:
        by_cells = {place.cells: groups[place] for place in places if place.cells in compared}
        equal = dict(zip(by_cells, same_seeds(by_cells.values())))
        made.append({places[0].at(n): equal.get(n, []) for n in compared})
    return made


def row_cells(groups, needed, number, show, verdict):
    """The cells of all rows. Each cell has its own number, but all cells of a row have one verdict.

    number(runs) measures the number of a cell, show(number) is its text, and verdict(numbers) judges all
    numbers of a row, from coarse to fine meshes. For `groups` and `needed` see rows().
    """
    def judge(*row):
        if not all(row):
            raise NotMeasured("a mesh that other rows have")
        return "", verdict(list(map(number, row)))

    made = {}
    for row in rows(groups, needed):
        whole = cell(judge, *row.values())
        for place, runs in row.items():
            own = cell(lambda runs: (show(number(runs)), True), runs)
            made[place] = noted(replace(whole, text=own.text, seeds=own.seeds), groups.get(place, []))
    return made
