"""Why a cell is not green: measured causes, each with the number that shows it in the run at hand.

Numbers come from two sources. A place <quantity|case|models> in a text is filled in from this page's runs in
double precision. Other numbers were measured apart from the page; `apart` is the command that repeats them,
and the page prints it behind the text. An arrow joins the number on this page and the number with the changed
setting. Distances and motions are root mean squares after alignment, in sizes.
"""
import re
from dataclasses import dataclass

import numpy as np

import style

FREE = ("meshes", "order", "units", "rings", "flaws")  # sheets stretched by half, without pins

ROUNDS = ("Ten iterations per step do not spread corrections through the whole sheet. Mean strain with 10 → "
          "100 iterations: ")
CUT = "Mean strain if a step's forces may deform a triangle by 5 % → 1 % (/solver/flight_limit): "
IN_PARTS = "Ten iterations per part of a step do not spread corrections through the whole sheet. " + CUT
HUNDRED = "--set /solver/iterations=100"
MINUTE = "--set /duration=60"
UNFELT = ("The strain does not depend on a fold, so nothing opens it. A creased sheet does not move in 60 "
          "s")
PLACE = re.compile(r"<(\w+)(?:\|([^|>]*))?(?:\|([^|>]*))?>")


@dataclass(frozen=True)
class Reason:
    """A cause: cases (beginnings of names) and models it may hold for, and what a run's numbers must show."""

    cases: tuple
    models: tuple  # empty: all
    shows: object  # summary → bool
    text: str
    apart: str = ""  # "CONFIG OPTIONS; …" of configs/stability, for the numbers that are not from this page


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


QUANTITIES = {"strain": lambda run: run.summary.get("mean_strain", np.nan),
              "away": lambda run: _number(run.summary, "rest_distance"),
              "reach": lambda run: _number(run.summary, "reach"),
              "shut": lambda run: 100 * _number(run.summary, "shut_hinges"),
              "flawed": lambda run: 100 * flawed_triangles(run).mean(),
              "flawed_strain": flawed_strain}

LOADS = [
    Reason(("pins: one bare",), ("isometric",), _strained,
           "Ten iterations per step do not spread corrections through the whole sheet. Largest reach with "
           "10 → 100 iterations: <reach||isometric> → 1.1 sizes", f"pins {HUNDRED}"),
    Reason(("pins: one bare",), (), _strained,
           ROUNDS + "<strain||crossover> → 0.052 (crossover), <strain||adaptive> → 0.025 (adaptive)",
           f"pins {HUNDRED}"),
    Reason(("pins: one",), (), _strained,
           ROUNDS + "<strain|pins: one|dihedral> → 0.065 (dihedral), <strain|pins: one|adaptive> → 0.018 "
           "(adaptive)", f"pins {HUNDRED}"),
    Reason(("pins: two",), (), _strained,
           ROUNDS + "<strain||dihedral> → 0.064 (dihedral), <strain||none> → 0.059 (none)",
           f"pins {HUNDRED}"),
    Reason(("pins: side",), (), _strained,
           ROUNDS + "<strain||dihedral> → 0.061 (dihedral), <strain||none> → 0.057 (none)",
           f"pins {HUNDRED}"),
    Reason(("published",), (), _drawn_out,
           "The projection of the published shear throws triangles that ten iterations leave stretched. "
           "Mean strain of dihedral on two corners: <strain|published: two|dihedral>; below 1 with the "
           "shear as an angle; 0.064 with a hundred iterations",
           f"published_slow --set /material/strain/form=angle; published_slow {HUNDRED}"),
    Reason(("published",), (), _strained,
           ROUNDS + "<strain|published: two|dihedral> → 0.064 (dihedral, two corners), "
           "<strain|published: one|dihedral> → 0.063 (dihedral, one corner)", f"published_slow {HUNDRED}"),
    Reason(("pulled",), (), _strained,
           ROUNDS + "<strain||dihedral> → 0.070 (dihedral), <strain||none> → 0.074 (none)",
           f"pulled {HUNDRED}"),
    Reason(("gust: ",), (), _strained,
           ROUNDS + "<strain||dihedral> → 0.081 (dihedral), <strain||none> → 0.18 (none), "
           "<strain||adaptive> → 0.027 (adaptive)", f"gust {HUNDRED}"),
    Reason(("stiff",), (), _strained,
           ROUNDS + "<strain||dihedral> → 0.067 (dihedral), <strain||none> → 0.059 (none)",
           f"stiff {HUNDRED}"),
    Reason(("falling: spinning",), (), _strained,
           ROUNDS + "<strain||choi_ko> → 0.0012 (choi_ko)", f"falling {HUNDRED}"),
    Reason(("falling: tumbling",), (), _strained,
           ROUNDS + "<strain||choi_ko> → 0.006 (choi_ko)", f"falling {HUNDRED}"),
    Reason(("mass_hanging",), (), _strained,
           "A projection moves only the light end of an edge, and the heavy half falls freely, 56 sizes in "
           "4 s. The ratio of masses matters, not the number of iterations. Mean strain at ratios of 1, 10, "
           "100 and 1000: 0.11, 0.60, 6.4, 69; at 10⁶: 85 with ten iterations, 83 with a thousand (none, "
           "32 × 32 cells)",
           "mass_hanging --set /mesh/cells=32 --set /material/density_ratio=100; "
           "mass_hanging --set /mesh/cells=32 --set /solver/iterations=1000"),
]

STEPS = [
    Reason(("time_step_cut: 1 s",), (), _strained,
           IN_PARTS + "<strain||dihedral> → 0.033 (dihedral), "
           "<strain||adaptive> → 0.013 (adaptive)", "time_step_cut_slow --set /solver/flight_limit=0.01"),
    Reason(("gust_cut",), (), _strained,
           IN_PARTS + "<strain||dihedral> → 0.030 (dihedral), "
           "<strain||adaptive> → 0.0025 (adaptive)", "gust_cut_slow --set /solver/flight_limit=0.01"),
    Reason(("iterations_cut",), (), _strained,
           "One iteration per part of a step does not spread corrections through the whole sheet. " + CUT
           + "<strain||dihedral> → 0.44 (dihedral), "
           "<strain||crossover> → 0.15 (crossover), <strain||adaptive> → 0.089 (adaptive)",
           "iterations_cut_slow --set /solver/flight_limit=0.01"),
    Reason(("iterations: one",), (), _strained,
           "One iteration per step does not spread corrections through the whole sheet. Mean strain with 1 "
           "→ 10 iterations: <strain||dihedral> → 0.95 (dihedral), <strain||adaptive> → 0.17 (adaptive)",
           "iterations --set /solver/iterations=10"),
    Reason(("time_step: 0.1 s",), (), _strained,
           "In a step the sheet falls 36 times as far as in 1/60 s, and ten iterations do not pull it back. "
           "Mean strain with 10 → 100 iterations: <strain||dihedral> → 3.0 (dihedral), <strain||adaptive> → "
           "0.56 (adaptive)", f"time_step {HUNDRED}"),
    Reason(("time_step: 1 s",), (), _strained,
           "In a step the sheet falls 10 m, and ten iterations do not pull it back. Mean strain with 10 → "
           "1000 iterations: <strain||none> → 20 (none), <strain||adaptive> → 2.2 (adaptive)",
           "time_step --set /solver/iterations=1000"),
]

SHAPES = [
    Reason(("flaws: needles", "flaws: caps"), (), _strained,
           "The flawed triangles, <flawed> % of all, have <flawed_strain> % of the sum of σ₁ − 1 in the "
           "last frame: a displacement that strains the other triangles by 0.001 strains these by 1"),
    Reason(("curved: mirrored",), (), _rests_elsewhere,
           "A mirror image has the same lengths and unsigned angles and is also at rest. After 60 s its "
           "strain is below 10⁻¹², and it moves less than 10⁻⁷ in 10 s", f"curved_slow {MINUTE}"),
    Reason(("curved: mirrored",), (), _away,
           "The tube turned inside out is in another equilibrium. After 60 s it is as far from rest as "
           "after 6 s (<away>), with a strain of 0.006 (prestressed 0.022), and it moves less than 0.001 in "
           "10 s", f"curved_slow {MINUTE}"),
    Reason(("curved",), ("isometric",), _away,
           "The tube unfolds inside out, into its mirror image, which is also at rest. After 60 s it is "
           "0.322 from rest, with a strain of 6·10⁻⁵", f"curved_slow {MINUTE}"),
    Reason(("curved",), ("none",), _folded, UNFELT, f"start {MINUTE}"),
    Reason(("curved",), (), _folded,
           "Shut folds hardly open. Of the tube scaled by −0.1, <shut|curved: inverted|adaptive> % of the "
           "hinges are shut after 6 s, 26 % after 60 s (adaptive)", f"curved_slow {MINUTE}"),
    Reason(("curved",), (), _away,
           "The tube comes to rest in another shape. After 6 s it is <away||crossover dihedral> from rest, "
           "after 60 s 0.16 to 0.24 (crossover and dihedral), and it moves at most 0.003 in 10 s",
           f"curved_slow {MINUTE}"),
]

STARTS = [
    Reason(("start: stretched",), ("isometric",), _strained,
           "The sheet is on its way back. It is <away|start: stretched|isometric> from rest after 6 s, and "
           "below 0.01 from 11 s on", f"start {MINUTE}"),
    Reason(("start: stretched",), (), _drawn_out,
           "Ten iterations per step do not spread corrections through the whole sheet. With twenty it is "
           "back after 3.6 s. Mean strain with 10 → 20 iterations: <strain|start: stretched|dihedral> → "
           "0.015 (dihedral), <strain|start: stretched|none> → 0.015 (none)",
           "start --set /solver/iterations=20"),
    Reason(("start: stretched",), (), _slow,
           "The sheet is on its way back: mean strain <strain|start: stretched|adaptive> after 6 s, 0.0012 "
           "after 60 s (adaptive)", f"start {MINUTE}"),
    Reason(("start",), ("none",), _folded, UNFELT, f"start {MINUTE}"),
    Reason(("start: random",), (), _folded,
           "Shut folds do not open. From a box of the sheet's size, <shut|start: random|adaptive> % of the "
           "hinges are shut after 6 s, 2.8 % after 60 s (adaptive)", f"start {MINUTE}"),
    Reason(("start",), ("isometric",), _folded,
           "The moment is proportional to sin θ and vanishes at 180°, so that shut folds stay. After 60 s a "
           "collapsed sheet moves less than 10⁻⁸ in 10 s", f"start {MINUTE}"),
    Reason(("start",), (), _folded,
           "Shut folds lock. After 60 s a collapsed sheet is where it was after 6 s and moves less than "
           "10⁻⁶ in 10 s. A hundred iterations per step do not open creases: "
           "<away|start: creased|crossover> → 0.199 from rest (crossover)",
           f"start {MINUTE}; start {HUNDRED}"),
    Reason(("start: random 10",), (), _away,
           "The sheet swings, and nothing damps it. After 6 s it is <away> from rest, after 60 s 0.01 to "
           "0.14, and then it moves 0.008 to 0.07 in 10 s", f"start {MINUTE}"),
    Reason(("start: random",), ("isometric",), _away,
           "The sheet is on its way back: <away> from rest after 6 s, 0.021 after 60 s", f"start {MINUTE}"),
    Reason(("start: random",), (), _away,
           "The sheet stays crumpled. After 6 s it is <away> from rest, after 60 s 0.11 to 0.21, with a "
           "hundred iterations 0.12 to 0.26", f"start {MINUTE}; start {HUNDRED}"),
    Reason(("start",), (), _away,
           "The folds open, but the sheet comes to rest crumpled. After 6 s it is <away> from rest, after "
           "60 s 0.10 to 0.19, and it moves at most 0.02 in 10 s. A creased sheet stays at 0.141 (moves "
           "3·10⁻⁵, bridson)", f"start {MINUTE}"),
]

SHEETS = [
    Reason(("meshes: ball", "rings_across: ball"), (), _away,
           "Dents stay: the dented ball is another equilibrium. After 6 s it is <away> from rest, after 60 "
           "s 0.10 to 0.26, and it moves less than 0.002 in 10 s",
           f"meshes {MINUTE}; rings_across {MINUTE}"),
    Reason(("mass: free",), (), _away,
           "The sheet swings, and nothing damps it. After 6 s it is <away> from rest, after 60 s 0.01 to "
           "0.16, and then it moves 0.02 to 0.10 in 10 s", f"mass {MINUTE}"),
    Reason(("meshes: strip",), (), _away,
           "The strip swings, and nothing damps it. After 6 s it is <away> from rest, after 60 s 0.06 to "
           "0.13, and then it moves 0.03 to 0.08 in 10 s", f"meshes {MINUTE}"),
    Reason(FREE, ("isometric",), _away,
           "The sheet swings on its way back. The plain grid is below 0.01 from 34 s on",
           f"meshes {MINUTE}"),
    Reason(FREE, ("crossover", "k_ring", "sparse_lod"), _away,
           "The sheet swings, and nothing damps it. The plain grid is "
           "<away|meshes: grid|crossover k_ring sparse_lod> from rest after 6 s, 0.10 to 0.13 after 60 s, "
           "and then it moves 0.05 to 0.17 in 10 s; flawed and irregular meshes 0.01 to 0.16 (crossover)",
           f"meshes {MINUTE}; flaws {MINUTE}"),
    Reason(FREE, (), _away,
           "The sheet comes to rest in another shape. After 60 s the plain grid is 0.03 to 0.20 from rest. "
           "After 6 → 60 s: dihedral <away|meshes: grid|dihedral> → 0.131, adaptive "
           "<away|meshes: grid|adaptive> → 0.051. It moves less than 0.01 in 10 s; flawed and irregular "
           "meshes less than 0.05", f"meshes {MINUTE}; flaws {MINUTE}"),
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


def filled(one, explained, cells):
    """The text of a reason with the numbers of the page's runs; `explained` are its own cells."""
    def numbers(place):
        quantity, case, models = place.groups(default="")
        own = {key: cell for key, cell in explained.items() if key[1] in models.split()}
        pool = (own if own and not case else cells) if models else explained
        exact = case in {name for name, _, _ in cells}
        fits = lambda name: name == case if exact else name.startswith(case or one.cases)
        runs = [cell.run for (name, model, precision), cell in pool.items()
                if precision == "double" and fits(name) and (not models or model in models.split())]
        return range_text([QUANTITIES[quantity](run) for run in runs])
    return PLACE.sub(numbers, one.text)


def range_text(values):
    """'0.17 to 0.26', one number if both ends read alike, – without numbers."""
    values = [value for value in values if np.isfinite(value)]
    if not values:
        return "–"
    low, high = style.number(min(values), 2), style.number(max(values), 2)
    return low if low == high else f"{low} to {high}"


def repeat_text(one):
    """Which numbers of a reason are not from this page, and the commands that repeat them."""
    if not one.apart:
        return ""
    commands = []
    for part in one.apart.split("; "):
        config, _, options = part.partition(" ")
        commands.append(f"./bendlab run configs/stability/{config}.json {options} --out /tmp/apart")
    return (". The changed settings and longer times were measured apart from this page, in double "
            "precision: " + "; ".join(commands))
