"""The verdict map of a claim: for which settings it holds, with a measured number for each.

A map is a grid over everything that the paper leaves open. A dimension is one open question; a cell is one
answer to each of them. The sentence under a map is derived from its cells.
"""
import itertools
import json
from dataclasses import dataclass, field

import numpy as np

from load import group

PINS = {"alone": {"vertices": ["upper_right"], "ring": 0, "distance": 0},
        "its 1-ring": {"vertices": ["upper_right"], "ring": 1, "distance": 0},
        "a patch of 5 cm": {"vertices": ["upper_right"], "ring": 0, "distance": 0.05}}
CONVERGED = (256, 1)
SOLVERS = {(1, 10): "1 × 10", (4, 10): "4 × 10", (16, 10): "16 × 10", CONVERGED: "256 × 1"}
DAMPINGS = {0: "none", 1: "viscous"}
ROUNDINGS = {"floor": "rounded down", "round": "rounded"}

# The open questions. The order is that of rows and columns; the paper answers the pins for its own springs.
DIMENSIONS = {"rounding": "m is", "damping": "damping is", "solver": "substeps × iterations are",
              "pins": "what is pinned is", "cells": "N is"}


@dataclass(frozen=True, order=True)
class Place:
    """One answer to each open question. `rounding` is "" for springs without levels."""

    rounding: str
    damping: str
    solver: str
    pins: str
    cells: int


@dataclass
class Cell:
    text: str  # the measured number
    holds: bool
    command: str  # repeats it


@dataclass
class ClaimMap:
    """A claim of the paper, and where it holds."""

    figure: str
    korean: str  # the paper's sentence; "" if the question is ours
    english: str
    rule: str  # what makes a cell hold
    number: str  # what the number in a cell is
    cells: dict = field(default_factory=dict)  # Place → Cell
    note: str = ""

    @property
    def holds(self):
        """True: everywhere. False: nowhere. None: there are no runs. Otherwise the share of the cells."""
        if not self.cells:
            return None
        share = np.mean([cell.holds for cell in self.cells.values()])
        return bool(share) if share in (0, 1) else float(share)

    @property
    def sentence(self):
        """holds | holds where … | does not hold"""
        if self.holds is None:
            return "not measured"
        if self.holds is True:
            return "holds in every cell"
        if self.holds is False:
            return "does not hold in any cell"
        good = sum(cell.holds for cell in self.cells.values())
        counted = f"{good} of {len(self.cells)} cells"
        where = region(self.cells)
        if where is None:
            return f"holds in {counted}, for no answer to one or two of the open questions"
        text, covered = where
        others = f"; and in {good - covered} of the others" if good > covered else ""
        return f"holds where {text} ({covered} cells){others}; {counted} in all"

    def as_json(self):
        return {"figure": self.figure, "claim": self.english, "rule": self.rule, "number": self.number,
                "verdict": self.sentence,
                "cells": [{**place.__dict__, "text": cell.text, "holds": cell.holds}
                          for place, cell in sorted(self.cells.items())]}


def region(cells):
    """The largest set of cells that all hold and that answers to at most two questions describe.

    Returns (text, number of cells), or None. A set with fewer than a twelfth of all cells is no answer.
    """
    values = {name: sorted({getattr(place, name) for place in cells}, key=answer_rank(name))
              for name in DIMENSIONS}
    open_ones = [name for name in DIMENSIONS if len(values[name]) > 1]
    best = None
    for count in (1, 2):
        for names in itertools.combinations(open_ones, count):
            subsets = [list(_runs_of(values[name])) for name in names]
            for chosen in itertools.product(*subsets):
                inside = [cell for place, cell in cells.items()
                          if all(getattr(place, name) in some for name, some in zip(names, chosen))]
                if not inside or not all(cell.holds for cell in inside):
                    continue
                if best is None or len(inside) > best[1]:
                    text = " and ".join(f"{DIMENSIONS[name]} {_listed(some)}"
                                        for name, some in zip(names, chosen))
                    best = text, len(inside)
    return best if best and best[1] >= max(len(cells) / 12, 2) else None


def answer_rank(name):
    """The order of the answers to a question, as a key for sorting."""
    orders = {"rounding": list(ROUNDINGS.values()), "damping": list(DAMPINGS.values()),
              "solver": list(SOLVERS.values()), "pins": list(PINS)}
    if name not in orders:
        return lambda value: value
    return lambda value: orders[name].index(value) if value in orders[name] else -1


def _runs_of(values):
    """Every section of a list that is not the whole of it."""
    for start in range(len(values)):
        for end in range(start + 1, len(values) + 1):
            if end - start < len(values):
                yield values[start:end]


def _listed(values):
    texts = [str(value) for value in values]
    return texts[0] if len(texts) == 1 else f"{', '.join(texts[:-1])} or {texts[-1]}"


def place_of(run):
    """The run's place on the map, or None where it has none."""
    solver = SOLVERS.get((run.get("/solver/substeps"), run.get("/solver/iterations")))
    held = {"ring": run.get("/pins/ring"), "distance": run.get("/pins/distance")}
    pins = next((name for name, section in PINS.items()
                 if all(section[key] == held[key] for key in held)), None)
    damping = DAMPINGS.get(run.get("/effects/1/coefficient"))
    rounding = ROUNDINGS.get(run.get(f"/bending/{run.model}/m_rounding"), "")
    if None in (solver, pins, damping):
        return None
    return Place(rounding, damping, solver, pins, int(run.get("/mesh/cells")))


def places(runs):
    """Place → runs that differ in their seeds alone."""
    found = group(runs, place_of)
    found.pop(None, None)
    return found


def command(config, run):
    """The command that computes the runs of a cell again."""
    keep = ("/pins", "/mesh/cells", "/effects/1/coefficient", "/solver", "/bending", "/bending/model",
            f"/bending/{run.model}/m_rounding", "/bending/lod/t", "/bending/adaptive/n_multiplier")
    parts = [f"./bendlab run configs/{config}.json"]
    for pointer in keep:
        value = run.point.get(pointer)
        if value is not None and (run.get(pointer) is not None or pointer in ("/pins", "/solver")):
            text = value if isinstance(value, str) else json.dumps(value)
            parts.append(f"--set '{pointer}={text}'")
    return " ".join(parts)
