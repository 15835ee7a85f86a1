"""Why a cell is not green: measured causes, each with the number that shows it in the run at hand.

A place <quantity|case|models|change> in a text is filled in with numbers of runs in double precision: of this
page, or with a changed setting those in apart.json, which experiments/measure_remedies.py measures; the page
prints the command that repeats them behind the text. Distances and motions are root mean squares after
alignment, in sizes.
"""
import json
import re
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np

from tables.numbers import number
from runs.distance import rms_distance, turned_onto
from runs.stability_cases import CASES


FREE = ("meshes", "order", "units", "rings", "flaws")  # sheets stretched by half, without pins

ROUNDS = ("Ten iterations per step do not spread corrections through the whole sheet. Mean strain with 10 → "
          "100 iterations: ")
CUT = "Mean strain if a step's forces may deform a triangle by 5 % → 1 % (/solver/flight_limit): "
IN_PARTS = "Ten iterations per part of a step do not spread corrections through the whole sheet. " + CUT
UNFELT = ("The strain does not depend on a fold, so nothing opens it. After 60 s a creased sheet moves "
          "<moved|start: creased|none|minute> sizes in 10 s")
PLACE = re.compile(r"<(\w+)(?:\|([^|>]*))?(?:\|([^|>]*))?(?:\|([^|>]*))?>")
# The changed settings that a place names.
CHANGES = {**{str(n): {"/solver/iterations": n} for n in (10, 20, 100, 1000)}, "minute": {"/duration": 60},
           "flight": {"/solver/flight_limit": 0.01}, "angle": {"/material/strain/form": "angle"},
           **{f"ratio {n}": {"/mesh/cells": 32, "/material/density_ratio": n} for n in (1, 10, 100, 1000)},
           "32 cells": {"/mesh/cells": 32}, "32 cells, 1000": {"/mesh/cells": 32, "/solver/iterations": 1000}}
APART = Path(__file__).resolve().parents[2] / "results/stability/apart.json"


@dataclass(frozen=True)
class Reason:
    """A cause: cases (beginnings of names) and models it may hold for, and what a run's numbers must show."""

    cases: tuple
    models: tuple  # empty: all
    shows: object  # summary → bool
    text: str

    @property
    def apart(self):
        """[(config, name of a change)] of the numbers in the text that are not from this page."""
        found = [(case or beginning, change) for _, case, _, change in PLACE.findall(self.text) if change
                 for beginning in ([case] if case else self.cases)]
        return list(dict.fromkeys((case.config, change) for beginning, change in found for case in CASES
                                  if case.name.startswith(beginning)))


def _number(numbers, name):
    return numbers.get(f"stability_{name}", np.nan)


def _folded(numbers):
    return _number(numbers, "shut_hinges") > 0.01


def _away(numbers):
    return _number(numbers, "rest_distance") > 0.01


def _rests_elsewhere(numbers):
    return _away(numbers) and numbers.get("mean_strain", np.nan) < 0.001


def _strained(numbers):
    return numbers.get("mean_strain", np.nan) > 0.02


def _drawn_out(numbers):
    return numbers.get("mean_strain", np.nan) > 1


def _slow(numbers):
    return numbers.get("mean_strain", np.nan) < 0.03 and _number(numbers, "rest_distance") < 0.01


def flawed_triangles(run):
    """(T) whether a triangle is a needle or a cap: its height at rest is below 0.01 of its longest edge."""
    corners = run.rest_positions[run.triangles]
    longest = np.linalg.norm(np.roll(corners, -1, axis=1) - corners, axis=2).max(axis=1)
    area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    return area < 0.01 * longest**2


def flawed_strain(run):
    """Share of the flawed triangles in the sum of σ₁ - 1 over all triangles in the last frame, in %."""
    stretch = np.abs(run.cell("max_stretch", -1) - 1)
    return 100 * stretch[flawed_triangles(run)].sum() / stretch.sum()


def moved(run):
    """How far the cloth moved in the last 10 s, after a turn about the vertical, in sizes."""
    times = run.metrics["time"]
    before = run.positions(int(np.argmin(np.abs(times - (times[-1] - 10)))))
    middle = lambda cloth: cloth - cloth.mean(axis=0)
    after, before = middle(run.positions(-1)), middle(before)
    return rms_distance(turned_onto(before, after, np.zeros(3)), after) / run.size


def _pairs(quantity, change, *models, case=""):
    """'page → changed (model)' of several models, as places."""
    return ", ".join(f"<{quantity}|{case}|{model}> → <{quantity}|{case}|{model}|{change}> ({model})"
                     for model in models)


QUANTITIES = {"strain": lambda run: run.summary.get("mean_strain", np.nan),
              "away": lambda run: _number(run.summary, "rest_distance"),
              "reach": lambda run: _number(run.summary, "reach"),
              "back": lambda run: _number(run.summary, "recovered_at"), "moved": moved,
              "shut": lambda run: 100 * _number(run.summary, "shut_hinges"),
              "flawed": lambda run: 100 * flawed_triangles(run).mean(),
              "flawed_strain": flawed_strain}

LOADS = [
    Reason(("pins: one bare",), ("isometric",), _strained,
           "Ten iterations per step do not spread corrections through the whole sheet. Largest reach with "
           "10 → 100 iterations: <reach||isometric> → <reach||isometric|100> sizes"),
    Reason(("pins: one bare",), (), _strained, ROUNDS + _pairs("strain", "100", "crossover", "adaptive")),
    Reason(("pins: one",), (), _strained,
           ROUNDS + _pairs("strain", "100", "dihedral", "adaptive", case="pins: one")),
    Reason(("pins: two",), (), _strained, ROUNDS + _pairs("strain", "100", "dihedral", "none")),
    Reason(("pins: side",), (), _strained, ROUNDS + _pairs("strain", "100", "dihedral", "none")),
    Reason(("published",), (), _drawn_out,
           "The projection of the published shear throws triangles that ten iterations leave stretched. "
           "Mean strain of dihedral on two corners: <strain|published: two|dihedral>; "
           "<strain|published: two|dihedral|angle> with the shear as an angle; "
           "<strain|published: two|dihedral|100> with a hundred iterations"),
    Reason(("published",), (), _strained,
           ROUNDS + "<strain|published: two|dihedral> → <strain|published: two|dihedral|100> (dihedral, two "
           "corners), <strain|published: one|dihedral> → <strain|published: one|dihedral|100> (dihedral, one "
           "corner)"),
    Reason(("pulled",), (), _strained, ROUNDS + _pairs("strain", "100", "dihedral", "none")),
    Reason(("gust: ",), (), _strained, ROUNDS + _pairs("strain", "100", "dihedral", "none", "adaptive")),
    Reason(("stiff",), (), _strained, ROUNDS + _pairs("strain", "100", "dihedral", "none")),
    Reason(("falling: spinning",), (), _strained, ROUNDS + _pairs("strain", "100", "choi_ko")),
    Reason(("falling: tumbling",), (), _strained, ROUNDS + _pairs("strain", "100", "choi_ko")),
    Reason(("mass_hanging",), (), _strained,
           "A projection moves only the light end of an edge, and the heavy half falls freely. The ratio of "
           "masses matters, not the number of iterations. Mean strain at ratios of 1, 10, 100 and 1000: "
           "<strain||none|ratio 1>, <strain||none|ratio 10>, <strain||none|ratio 100>, "
           "<strain||none|ratio 1000>; at 10⁶: <strain||none|32 cells> with ten iterations, "
           "<strain||none|32 cells, 1000> with a thousand (none, 32 × 32 cells)"),
]

STEPS = [
    Reason(("time_step_cut: 1 s",), (), _strained, IN_PARTS
           + _pairs("strain", "flight", "dihedral", "adaptive")),
    Reason(("gust_cut",), (), _strained, IN_PARTS + _pairs("strain", "flight", "dihedral", "adaptive")),
    Reason(("iterations_cut",), (), _strained,
           "One iteration per part of a step does not spread corrections through the whole sheet. " + CUT
           + _pairs("strain", "flight", "dihedral", "crossover", "adaptive")),
    Reason(("iterations: one",), (), _strained,
           "One iteration per step does not spread corrections through the whole sheet. Mean strain with 1 "
           "→ 10 iterations: " + _pairs("strain", "10", "dihedral", "adaptive")),
    Reason(("time_step: 0.1 s",), (), _strained,
           "In a step the sheet falls 36 times as far as in 1/60 s, and ten iterations do not pull it back. "
           "Mean strain with 10 → 100 iterations: " + _pairs("strain", "100", "dihedral", "adaptive")),
    Reason(("time_step: 1 s",), (), _strained,
           "In a step the sheet falls 10 m, and ten iterations do not pull it back. Mean strain with 10 → "
           "1000 iterations: " + _pairs("strain", "1000", "none", "adaptive")),
]

SHAPES = [
    Reason(("flaws: needles", "flaws: caps"), (), _strained,
           "The flawed triangles, <flawed> % of all, have <flawed_strain> % of the sum of σ₁ − 1 in the "
           "last frame: a displacement that strains the other triangles by 0.001 strains these by 1"),
    Reason(("curved: mirrored",), (), _rests_elsewhere,
           "A mirror image has the same lengths and unsigned angles and is also at rest. After 60 s its "
           "strain is <strain|||minute>, and in 10 s it moves <moved|||minute> sizes"),
    Reason(("curved: mirrored",), (), _away,
           "The tube turned inside out is in another equilibrium. After 60 s it is <away|||minute> sizes "
           "from rest, after 6 s <away>, with a strain of <strain|||minute>; in 10 s it moves "
           "<moved|||minute> sizes"),
    Reason(("curved",), ("isometric",), _away,
           "The tube unfolds inside out, into its mirror image, which is also at rest. After 60 s it is "
           "<away|||minute> sizes from rest, with a strain of <strain|||minute>"),
    Reason(("curved",), ("none",), _folded, UNFELT),
    Reason(("curved",), (), _folded,
           "Shut folds hardly open. Of the tube scaled by −0.1, <shut|curved: inverted|adaptive> % of the "
           "hinges are shut after 6 s, <shut|curved: inverted|adaptive|minute> % after 60 s (adaptive)"),
    Reason(("curved",), (), _away,
           "The tube comes to rest in another shape. After 6 s it is <away||crossover dihedral> sizes from "
           "rest, after 60 s <away||crossover dihedral|minute> (crossover and dihedral), and in 10 s it "
           "moves <moved||crossover dihedral|minute> sizes"),
]

STARTS = [
    Reason(("start: stretched",), ("isometric",), _strained,
           "The sheet is on its way back. It is <away|start: stretched|isometric> sizes from rest after 6 s, "
           "and below 0.01 from <back|start: stretched|isometric|minute> s on"),
    Reason(("start: stretched",), (), _drawn_out,
           "Ten iterations per step do not spread corrections through the whole sheet. With twenty it is "
           "back after <back|start: stretched|dihedral none|20> s. Mean strain with 10 → 20 iterations: "
           + _pairs("strain", "20", "dihedral", "none", case="start: stretched")),
    Reason(("start: stretched",), (), _slow,
           "The sheet is on its way back: mean strain <strain|start: stretched|adaptive> after 6 s, "
           "<strain|start: stretched|adaptive|minute> after 60 s (adaptive)"),
    Reason(("start",), ("none",), _folded, UNFELT),
    Reason(("start: random",), (), _folded,
           "Shut folds do not open. From a box of the sheet's size, <shut|start: random|adaptive> % of the "
           "hinges are shut after 6 s, <shut|start: random|adaptive|minute> % after 60 s (adaptive)"),
    Reason(("start",), ("isometric",), _folded,
           "The moment is proportional to sin θ and vanishes at 180°, so that shut folds stay. After 60 s a "
           "collapsed sheet moves <moved|start: point|isometric|minute> sizes in 10 s"),
    Reason(("start",), (), _folded,
           "Shut folds lock. After 60 s a collapsed sheet moves <moved|start: point|crossover|minute> sizes "
           "in 10 s (crossover). A hundred iterations per step do not open creases: "
           + _pairs("away", "100", "crossover", case="start: creased") + ", in sizes from rest"),
    Reason(("start: random 10",), (), _away,
           "The sheet swings, and nothing damps it. After 6 s it is <away> sizes from rest, after 60 s "
           "<away|||minute>, and then it moves <moved|||minute> sizes in 10 s"),
    Reason(("start: random",), ("isometric",), _away,
           "The sheet is on its way back: <away> sizes from rest after 6 s, <away|||minute> after 60 s"),
    Reason(("start: random",), (), _away,
           "The sheet stays crumpled. After 6 s it is <away> sizes from rest, after 60 s <away|||minute>, "
           "with a hundred iterations <away|||100>"),
    Reason(("start",), (), _away,
           "The folds open, but the sheet comes to rest crumpled. After 6 s it is <away> sizes from rest, "
           "after 60 s <away|||minute>, and in 10 s it moves <moved|||minute> sizes"),
]

SHEETS = [
    Reason(("meshes: ball", "rings_across: ball"), (), _away,
           "Dents stay: the dented ball is another equilibrium. After 6 s it is <away> sizes from rest, "
           "after 60 s <away|||minute>, and in 10 s it moves <moved|||minute> sizes"),
    Reason(("mass: free",), (), _away,
           "The sheet swings, and nothing damps it. After 6 s it is <away> sizes from rest, after 60 s "
           "<away|||minute>, and then it moves <moved|||minute> sizes in 10 s"),
    Reason(("meshes: strip",), (), _away,
           "The strip swings, and nothing damps it. After 6 s it is <away> sizes from rest, after 60 s "
           "<away|||minute>, and then it moves <moved|||minute> sizes in 10 s"),
    Reason(FREE, ("isometric",), _away,
           "The sheet swings on its way back. The plain grid is below 0.01 from "
           "<back|meshes: grid|isometric|minute> s on"),
    Reason(FREE, ("crossover", "k_ring", "sparse_lod"), _away,
           "The sheet swings, and nothing damps it. The plain grid is "
           "<away|meshes: grid|crossover k_ring sparse_lod> sizes from rest after 6 s, "
           "<away|meshes: grid|crossover k_ring sparse_lod|minute> after 60 s, and then it moves "
           "<moved|meshes: grid|crossover k_ring sparse_lod|minute> sizes in 10 s"),
    Reason(FREE, (), _away,
           "The sheet comes to rest in another shape. After 6 → 60 s the plain grid is so many sizes from "
           "rest: " + _pairs("away", "minute", "dihedral", "adaptive", case="meshes: grid")
           + ". In 10 s it moves "
           "<moved|meshes: grid|dihedral adaptive|minute> sizes"),
]

REASONS = [*LOADS, *STEPS, *SHAPES, *STARTS, *SHEETS]  # the first that fits is taken


def reason(cell):
    """The first known cause that the run's numbers show, None without one."""
    if not cell.run.complete:
        return None
    for one in REASONS:
        fits = cell.case.name.startswith(one.cases) and (not one.models or cell.model in one.models)
        if fits and one.shows(cell.run.summary):
            return one
    return None


def explain(cells):
    """Writes the reason of every cell that is not green into its `why`; cells by (case, model, precision)."""
    explained = {}
    for key, cell in cells.items():
        if cell.verdict != "green" and (found := reason(cell)):
            explained.setdefault(found, {})[key] = cell
    for one, some in explained.items():
        text = filled(one, some, cells) + repeat_text(one)
        for cell in some.values():
            cell.why = text


@cache
def apart():
    """{config: {change: {case: {model: {quantity: number}}}}}; empty before it was measured."""
    return json.loads(APART.read_text(encoding="utf-8")) if APART.exists() else {}


def filled(one, explained, cells):
    """The text of a reason with its numbers; `explained` are its own cells."""
    def numbers(place):
        quantity, case, models, change = place.groups(default="")
        exact = case in {name for name, _, _ in cells}
        fits = lambda name: name == case if exact else name.startswith(case or one.cases)
        if change:
            wanted = models.split() or {model for _, model, _ in explained}
            return range_text([found[quantity] for config, changed in one.apart if changed == change
                               for name, of_model in apart().get(config, {}).get(change, {}).items()
                               if fits(name) and (case or models or any(key[0] == name for key in explained))
                               for model, found in of_model.items() if model in wanted])
        own = {key: cell for key, cell in explained.items() if key[1] in models.split()}
        pool = (own if own and not case else cells) if models else explained
        runs = [cell.run for (name, model, precision), cell in pool.items()
                if precision == "double" and fits(name) and (not models or model in models.split())]
        return range_text([QUANTITIES[quantity](run) for run in runs])
    return PLACE.sub(numbers, one.text)


def range_text(values):
    """'0.17 to 0.26', one number if both ends read alike, – without numbers."""
    values = [value for value in values if value is not None and np.isfinite(value)]
    if not values:
        return "–"
    low, high = number(min(values), 2), number(max(values), 2)
    return low if low == high else f"{low} to {high}"


def repeat_text(one):
    """Which numbers of a reason are not from this page, and the commands that repeat them."""
    if not one.apart:
        return ""
    sets = lambda change: " ".join(f"--set {pointer}={value}" for pointer, value in CHANGES[change].items())
    commands = [f"./bendlab run configs/stability/{config}.json {sets(change)} --out /tmp/apart"
                for config, change in one.apart]
    return (". The changed settings and longer times were measured apart from this page, in double "
            "precision: " + "; ".join(commands))
