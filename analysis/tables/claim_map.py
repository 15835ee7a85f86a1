"""The verdict map of a claim: for which settings it holds, with a measured number for each.

A map is a grid over everything that the paper leaves open. A dimension is one open question; a cell is one
answer to each of them. The sentence under a map is derived from its cells.
"""
import itertools
from dataclasses import dataclass, field, fields, replace

import numpy as np

from bendlab.results.load import group

PINS = {"the corner alone": {"vertices": ["upper_right"], "ring": 0, "distance": 0},
        "the corner and its 1-ring": {"vertices": ["upper_right"], "ring": 1, "distance": 0},
        "a patch of 5 cm": {"vertices": ["upper_right"], "ring": 0, "distance": 0.05}}
# By 256 substeps the strain has converged. Bending has not: with k each projection makes it stiffer.
SOLVERS = {(1, 10): "1 × 10", (4, 10): "4 × 10", (16, 10): "16 × 10", (256, 1): "256 × 1 (strain converged)"}
DAMPINGS = {0: "no damping", 1: "viscous drag"}
ROUNDINGS = {"floor": "rounded down", "round": "rounded"}

# The open questions, as the beginnings of sentences that their answers complete. The order is that of rows
# and columns; the paper answers the pins for its own springs.
DIMENSIONS = {"rounding": "m is", "damping": "there is", "solver": "substeps × iterations are",
              "pins": "what is pinned is", "cells": "N is"}


@dataclass(frozen=True, order=True)
class Place:
    """One answer to each open question. `rounding` is "" for springs without levels."""

    rounding: str
    damping: str
    solver: str
    pins: str
    cells: int | str  # text where a cell combines several N

    def at(self, cells):
        """The same answers at another N."""
        return replace(self, cells=cells)


@dataclass
class Cell:
    text: str  # the measured number, or why there is none
    holds: bool | None  # None: no verdict
    command: str = ""  # repeats it, one command per line
    seeds: tuple = ()  # of the runs that it was measured on
    open: bool = False  # there is no verdict because runs are missing

    @property
    def seeds_text(self):
        return f"seed{'s' if len(self.seeds) > 1 else ''} {', '.join(map(str, self.seeds))}"


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
    of_torn: bool = False  # where the claim holds, the cloth is torn
    # cells of --full are left out: their runs are missing, and could change the verdict
    left_out: bool = False

    @property
    def judged(self):
        """The cells that hold or fail."""
        return [cell for cell in self.cells.values() if cell.holds is not None]

    @property
    def open(self):
        """How many cells have no verdict because runs are missing."""
        return sum(cell.open for cell in self.cells.values())

    @property
    def holds(self):
        """True: the claim holds in every cell. False: in no cell. None: missing runs could still decide.
        Otherwise the share of judged cells in which it holds."""
        if not self.judged:
            return None
        share = np.mean([cell.holds for cell in self.judged])
        if share in (0, 1):
            return None if self.open or self.left_out else bool(share)
        return float(share)

    @property
    def sentence(self):
        """holds | holds in some cells, and where | does not hold | open; how many cells are not judged"""
        good, count = sum(cell.holds for cell in self.judged), len(self.judged)
        if not count:
            return "open: no box has anything to judge" if self.cells and not self.open else "open: not run"
        if self.holds is None:
            text = f"open: {'holds' if good else 'fails'} in all {count} boxes whose runs are there"
        elif self.holds in (True, False):
            text = "holds in every box" if self.holds else "does not hold in any box"
        else:
            text = self._where(good, count) + self._at_least_work()
        not_judged = len(self.cells) - count - self.open
        return (text + (f"; {_cells(self.open, 'are')} open, because their runs are not there"
                        if self.open else "")
                + ("; those of --full are not run" if self.left_out else "")
                + (f"; {_cells(not_judged, 'have')} nothing to compare" if not_judged else ""))

    def _at_least_work(self):
        """In how many cells it holds with the work of the page's other figures (the paper states no work)."""
        work = next(iter(SOLVERS.values()))
        verdicts = [cell.holds for place, cell in self.cells.items()
                    if place.solver == work and cell.holds is not None]
        return f"; at {work} alone in {sum(verdicts)} of {len(verdicts)}" if verdicts else ""

    def _where(self, good, count):
        """The sentence of a claim that holds in some cells."""
        best = region(self.cells)
        if best is None:
            return f"holds in {good} of {count} boxes; no one or two answers decide where"
        text, covered = best[0], len(best[1])
        where = f"wherever {text} ({covered}), and in {good - covered} beside these" if good > covered \
            else f"exactly where {text}"
        return f"holds in {good} of {count} boxes: {where}"

    def as_json(self):
        return {"figure": self.figure, "claim": self.english, "rule": self.rule, "number": self.number,
                "verdict": self.sentence,
                "cells": [{**place.__dict__, "text": cell.text, "holds": cell.holds,
                           "seeds": list(cell.seeds)}
                          for place, cell in sorted(self.cells.items())]}

    def kept(self):
        """All fields as JSON, from which a page can be laid out again."""
        cells = [{**place.__dict__, **cell.__dict__, "seeds": list(cell.seeds)}
                 for place, cell in sorted(self.cells.items())]
        return {entry.name: getattr(self, entry.name) for entry in fields(self)} | {"cells": cells}

    @classmethod
    def of_kept(cls, kept):
        """The map of which kept() made this JSON."""
        pick = lambda kind, entry: {name.name: entry[name.name] for name in fields(kind)}
        cells = {Place(**pick(Place, entry)):
                 Cell(**pick(Cell, entry) | {"seeds": tuple(entry["seeds"])}) for entry in kept["cells"]}
        return cls(**kept | {"cells": cells})


def region(cells):
    """The largest set of cells that all hold and that answers to at most two questions describe.

    Returns (text, places), or None. A set with fewer than a twelfth of all cells does not count, nor does a
    set with an open cell. Cells without anything to judge are ignored.
    """
    cells = {place: cell for place, cell in cells.items() if cell.holds is not None or cell.open}
    values = {name: sorted({getattr(place, name) for place in cells}, key=answer_rank(name))
              for name in DIMENSIONS}
    varied = [name for name in DIMENSIONS if len(values[name]) > 1]
    best = None
    for count in (1, 2):
        for names in itertools.combinations(varied, count):
            subsets = [list(_parts_of(values[name])) for name in names]
            for chosen in itertools.product(*subsets):
                inside = [place for place in cells
                          if all(getattr(place, name) in answers for name, answers in zip(names, chosen))]
                if not inside or not all(cells[place].holds for place in inside):
                    continue
                if best is None or len(inside) > len(best[1]):
                    text = " and ".join(f"{DIMENSIONS[name]} {_listed(answers)}"
                                        for name, answers in zip(names, chosen))
                    best = text, inside
    return best if best and len(best[1]) >= max(len(cells) / 12, 2) else None


def answer_rank(name):
    """The order of the answers to a question, as a key for sorting."""
    orders = {"rounding": list(ROUNDINGS.values()), "damping": list(DAMPINGS.values()),
              "solver": list(SOLVERS.values()), "pins": list(PINS)}
    if name not in orders:
        return lambda value: value
    return lambda value: orders[name].index(value) if value in orders[name] else -1


def _parts_of(values):
    """Every contiguous part of a list except the whole list."""
    for start in range(len(values)):
        for end in range(start + 1, len(values) + 1):
            if end - start < len(values):
                yield values[start:end]


def _cells(count, verb=""):
    if count == 1:
        return f"1 box {dict(are='is', have='has').get(verb, '')}".strip()
    return f"{count} boxes {verb}".strip()


def _listed(values):
    texts = [str(value) for value in values]
    return texts[0] if len(texts) == 1 else f"{', '.join(texts[:-1])} or {texts[-1]}"


def solver_of(run):
    """The answer to how much the solver works, or None."""
    return SOLVERS.get((run.get("/solver/substeps"), run.get("/solver/iterations")))


def rounding_of(run):
    """The answer to how m becomes an integer, "" for springs without levels."""
    return ROUNDINGS.get(run.get(f"/bending/{run.model}/m_rounding"), "")


def place_of(run):
    """The run's place on the map of hanging sheets, or None where it has none."""
    held = {"ring": run.get("/pins/ring"), "distance": run.get("/pins/distance")}
    pins = next((name for name, section in PINS.items()
                 if all(section[key] == held[key] for key in held)), None)
    damping = DAMPINGS.get(run.get("/effects/1/coefficient"))
    if None in (solver_of(run), pins, damping):
        return None
    return Place(rounding_of(run), damping, solver_of(run), pins, int(run.get("/mesh/cells")))


def places(runs):
    """Place → runs that differ in their seeds alone."""
    by_place = group(runs, place_of)
    by_place.pop(None, None)
    return by_place
