"""Why a cell is not green: causes that are known, each with the number that shows it in the run at hand."""
from dataclasses import dataclass

import numpy as np

SPRINGS = ("crossover", "k_ring", "adaptive", "lod", "sparse_lod")
SIGNLESS = ("none", *SPRINGS, "choi_ko", "isometric")  # their energy is the same for a shape and its mirror image
HINGES = ("dihedral", "bridson", "discrete_shells")


@dataclass(frozen=True)
class Reason:
    """A cause: for which cases (beginnings of their names) and models it may hold, and what the run's numbers then have to be."""

    cases: tuple
    models: tuple  # empty: all
    shows: object  # numbers of the summary → bool
    text: str


def _number(numbers, name):
    return numbers.get(f"stability_{name}", np.nan)


def _unstrained(numbers, below=0.05):
    return numbers.get("mean_strain", np.nan) < below


def _folded(numbers):
    return _unstrained(numbers) and _number(numbers, "shut_hinges") > 0.01


def _bent(numbers):
    return _unstrained(numbers) and _number(numbers, "rest_distance") > 0.01


def _strained(numbers):
    return numbers.get("mean_strain", np.nan) > 0.02


REASONS = [
    Reason(("curved: mirrored", "curved: inverted"), SIGNLESS, _bent,
           "a mirror image has the same lengths and unsigned angles: it is as much at rest as the rest shape"),
    Reason(("curved: mirrored", "curved: inverted"), HINGES, _bent,
           "a tube turned inside out has to pass through shapes that are strained more: it stays in another equilibrium"),
    Reason(("",), ("none",), _folded, "strain alone does not see a fold: nothing opens it"),
    Reason(("",), ("isometric",), _folded, "its moment goes with sin θ and vanishes at 180°: a shut fold stays shut"),
    Reason(("",), (*SPRINGS, "choi_ko"), _folded,
           "a shut fold brings the ends of springs together, which push along the sheet: nothing opens it until it is off the line"),
    Reason(("",), ("none",), _bent, "without bending any pose without strain is at rest"),
    Reason(("published",), (), _strained,
           "the gradient of the published shear vanishes as warp and weft become parallel: a projection throws the triangle"),
    Reason(("mass_hanging",), (), _strained,
           "a projection moves the light end alone: in ten rounds a few rows give way, and the heavy half falls almost freely"),
    Reason(("iterations: one", "time_step"), (), _strained,
           "a correction gets a row farther in each round: far from the pins the sheet still falls freely"),
    Reason(("gust", "pulled", "pins", "falling"), (), _strained, "ten rounds a step do not reach through the sheet: the load is not carried yet"),
    Reason(("",), SPRINGS, _bent, "springs between vertices resist bending as κ³ only: nearly flat they are limp"),
    Reason(("",), (), _bent, "it has no strain left and still bends back: slowly, because a projection bends a ring at a time"),
]


def reason(cell):
    """The first known cause whose number is there, or nothing."""
    if cell.run.status != "complete":
        return ""
    for one in REASONS:
        if cell.case.name.startswith(one.cases) and (not one.models or cell.model in one.models) and one.shows(cell.run.summary):
            return one.text
    return ""
