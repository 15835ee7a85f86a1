"""The verdict map of a claim: for which settings the claim holds, with a measured number for each.

A map is a grid over the questions that the paper leaves open. A dimension of the grid is one question; a cell
is one answer to every question. The sentence below a map is computed from the cells. Pages call a cell a box,
because they also have cells of meshes.
"""
import itertools
from dataclasses import asdict, dataclass, field, fields, replace

from bendlab.results.load import group

PINS = {"the corner alone": {"vertices": ["upper_right"], "ring": 0, "distance": 0},
        "the corner and its 1-ring": {"vertices": ["upper_right"], "ring": 1, "distance": 0},
        "a patch of 5 cm": {"vertices": ["upper_right"], "ring": 0, "distance": 0.05}}
# With 256 substeps the strain has converged. Bending has not converged, because with k each projection makes
# bending stiffer.
SOLVERS = {(1, 10): "1 × 10", (4, 10): "4 × 10", (16, 10): "16 × 10", (256, 1): "256 × 1 (strain converged)"}
DAMPINGS = {0: "no damping", 1: "viscous drag"}
ROUNDINGS = {"floor": "rounded down", "round": "rounded"}

# The open questions in the order of rows and columns: the beginning of a sentence that an answer completes,
# and the answers in their order. The paper states what is pinned only for its own springs.
DIMENSIONS = {"rounding": ("m is", [*ROUNDINGS.values()]), "damping": ("there is", [*DAMPINGS.values()]),
              "solver": ("substeps × iterations are", [*SOLVERS.values()]),
              "pins": ("what is pinned is", [*PINS]), "cells": ("N is", [])}


@dataclass(frozen=True, order=True)
class Place:
    """One answer to each open question. `rounding` is "" for a model without the setting m_rounding."""

    rounding: str
    damping: str
    solver: str
    pins: str
    cells: int | str  # a text if the cell combines several N

    def at(self, cells):
        """The place that differs from this place only in N."""
        return replace(self, cells=cells)


@dataclass
class Cell:
    text: str  # the measured number, or why there is none
    holds: bool | None  # None: no verdict
    command: str = ""  # the commands that repeat the measurement, one per line
    seeds: tuple = ()  # of the measured runs
    open: bool = False  # there is no verdict because runs are missing

    @property
    def seeds_text(self):
        return f"seed{'s' if len(self.seeds) > 1 else ''} {', '.join(map(str, self.seeds))}"


@dataclass
class ClaimMap:
    """A claim of the paper, and the cells in which it holds."""

    figure: str
    korean: str  # the paper's sentence; "" if the question is ours
    english: str
    rule: str  # what makes a cell hold
    number: str  # what the number in a cell is
    cells: dict = field(default_factory=dict)  # Place → Cell
    note: str = ""
    of_torn: bool = False  # the claim states that cloth is torn
    left_out: bool = False  # the map lacks the cells of --full, which could change the verdict

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
        """True: the claim holds in every cell. False: the claim holds in no cell. None: the verdict depends
        on missing runs. A number: the share of judged cells in which the claim holds."""
        if not self.judged:
            return None
        share = sum(cell.holds for cell in self.judged) / len(self.judged)
        if share in (0, 1):
            return None if self.open or self.left_out else bool(share)
        return share

    @property
    def sentence(self):
        """The verdict in words: whether or where the claim holds, and how many cells are not judged."""
        good, count = sum(cell.holds for cell in self.judged), len(self.judged)
        if not count:
            return "open: no box has anything to judge" if self.cells and not self.open else "open: not run"
        if self.holds is None:
            text = f"open: {'holds' if good else 'fails'} in all {count} boxes that have runs"
        elif self.holds in (True, False):
            text = "holds in every box" if self.holds else "does not hold in any box"
        else:
            text = f"holds in {good} of {count} boxes{self._where(good)}"
        not_judged = len(self.cells) - count - self.open
        notes = {f"{_boxes(self.open, 'is', 'are')} open, because runs are missing": self.open,
                 "the boxes of --full are not computed": self.left_out,
                 f"{_boxes(not_judged, 'has', 'have')} no verdict": not_judged}
        return "; ".join([text, *(note for note, applies in notes.items() if applies)])

    def _where(self, good):
        """Where a claim holds that holds in `good` cells but not in all, and in how many cells it holds with
        the substeps and iterations of the page's other figures. The paper does not state these numbers."""
        best, where = region(self.cells), ", without a simple pattern"
        if best:
            text, covered = best[0], len(best[1])
            where = (f": wherever {text} ({covered} boxes), and in {good - covered} more" if good > covered
                     else f": exactly where {text}")
        work = next(iter(SOLVERS.values()))
        verdicts = [cell.holds for place, cell in self.cells.items()
                    if place.solver == work and cell.holds is not None]
        return where + (f"; in {sum(verdicts)} of the {len(verdicts)} boxes with {work} substeps × iterations"
                        if verdicts else "")

    def as_json(self):
        return {"figure": self.figure, "claim": self.english, "rule": self.rule, "number": self.number,
                "verdict": self.sentence,
                "cells": [asdict(place) | {"text": cell.text, "holds": cell.holds, "seeds": cell.seeds}
                          for place, cell in sorted(self.cells.items())]}

    def kept(self):
        """All fields as JSON, from which the HTML of the page can be made again."""
        cells = [asdict(place) | asdict(cell) for place, cell in sorted(self.cells.items())]
        return asdict(replace(self, cells={})) | {"cells": cells}

    @classmethod
    def of_kept(cls, kept):
        """The map from the JSON that kept() returned."""
        pick = lambda kind, cell: kind(**{part.name: cell[part.name] for part in fields(kind)})
        cells = {pick(Place, cell): pick(Cell, cell | {"seeds": tuple(cell["seeds"])})
                 for cell in kept["cells"]}
        return cls(**kept | {"cells": cells})


def region(cells):
    """The largest set of cells in which the claim holds and which answers to one or two questions describe.

    Returns (text, places), or None. A set has at least a twelfth of all cells, and no open cell. Cells with
    complete runs but without a verdict do not count.
    """
    cells = {place: cell for place, cell in cells.items() if cell.holds is not None or cell.open}
    values = {name: sorted({getattr(place, name) for place in cells}, key=answer_rank(name))
              for name in DIMENSIONS}
    varied = [name for name in DIMENSIONS if len(values[name]) > 1]
    found = []
    for names in [*itertools.combinations(varied, 1), *itertools.combinations(varied, 2)]:
        for chosen in itertools.product(*(_parts_of(values[name]) for name in names)):
            answers = dict(zip(names, chosen))
            inside = [place for place in cells
                      if all(getattr(place, name) in answers[name] for name in names)]
            if inside and all(cells[place].holds for place in inside):
                found.append((answers, inside))
    answers, inside = max(found, key=lambda entry: len(entry[1]), default=({}, []))
    if len(inside) < max(len(cells) / 12, 2):
        return None
    return " and ".join(f"{DIMENSIONS[name][0]} {_listed(answers[name])}" for name in answers), inside


def answer_rank(name):
    """The order of the answers to a question, as a key for sorting."""
    order = DIMENSIONS[name][1]
    return lambda value: value if not order else order.index(value) if value in order else -1


def _parts_of(values):
    """Every contiguous part of a list except the whole list."""
    return [values[start:end] for start, end in itertools.combinations(range(len(values) + 1), 2)
            if end - start < len(values)]


def _boxes(count, singular, plural):
    return f"1 box {singular}" if count == 1 else f"{count} boxes {plural}"


def _listed(values):
    *first, last = map(str, values)
    return f"{', '.join(first)} or {last}" if first else last


def solver_of(run):
    """The text in SOLVERS for the substeps and iterations of a run, or None."""
    return SOLVERS.get((run.get("/solver/substeps"), run.get("/solver/iterations")))


def rounding_of(run):
    """How a run makes m an integer; "" for a model without the setting m_rounding."""
    return ROUNDINGS.get(run.get(f"/bending/{run.model}/m_rounding"), "")


def place_of(run):
    """The place of a run on the map of hanging sheets, or None if the map has no such place."""
    held = {"ring": run.get("/pins/ring"), "distance": run.get("/pins/distance")}
    pins = next((name for name, section in PINS.items() if held.items() <= section.items()), None)
    damping = DAMPINGS.get(run.get("/effects/1/coefficient"))
    if None in (solver_of(run), pins, damping):
        return None
    return Place(rounding_of(run), damping, solver_of(run), pins, int(run.get("/mesh/cells")))


def places(runs):
    """Place → the runs with these answers, which differ only in their seeds."""
    by_place = group(runs, place_of)
    by_place.pop(None, None)
    return by_place
