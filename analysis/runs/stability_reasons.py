"""Why a cell of the matrix is not green: measured causes, with the metrics of a run that show the cause.

In a text, <quantity|case|models|change> stands for numbers of runs in double precision. Without a change, the
numbers are from runs of this page. With a change of a setting, the numbers are from apart.json, which
experiments/measure_remedies.py writes, and the page adds the commands that repeat these runs. Distances and
motions are root mean squares after alignment, in sizes (diagonals of the rest box).
"""
import json
import re
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np

from bendlab.results.load import group
from runs.distance import rms_distance, turned_onto
from runs.stability_cases import CASES
from runs.stretch import areas
from tables.numbers import span

PLACE = re.compile(r"<(\w+)(?:\|([^|>]*))?(?:\|([^|>]*))?(?:\|([^|>]*))?>")
# Name of a change → changed settings.
CHANGES = {**{str(n): {"/solver/iterations": n} for n in (10, 20, 100, 1000)}, "minute": {"/duration": 60},
           "flight": {"/solver/flight_limit": 0.01}, "angle": {"/material/strain/form": "angle"},
           **{f"ratio {n}": {"/mesh/cells": 32, "/material/density_ratio": n} for n in (1, 10, 100, 1000)},
           "32 cells": {"/mesh/cells": 32}, "32 cells, 1000": {"/mesh/cells": 32, "/solver/iterations": 1000}}
APART = Path(__file__).resolve().parents[2] / "results/stability/apart.json"


@dataclass(frozen=True)
class Reason:
    """A cause, with the possible cases (beginnings of names) and models, and a test of a run's metrics."""

    cases: tuple
    models: tuple  # empty: all
    shows: object  # summary → bool
    text: str

    @property
    def apart(self):
        """[(config, name of a change)] of the runs in the text that are not from this page."""
        found = [(case or beginning, change) for _, case, _, change in PLACE.findall(self.text) if change
                 for beginning in ([case] if case else self.cases)]
        return list(dict.fromkeys((case.config, change) for beginning, change in found for case in CASES
                                  if case.name.startswith(beginning)))


def flawed_triangles(run):
    """(T) whether a triangle is a needle or a cap: its height at rest is below 0.01 of its longest edge."""
    corners = run.rest_positions[run.triangles]
    longest = np.linalg.norm(np.roll(corners, -1, axis=1) - corners, axis=2).max(axis=1)
    return 2 * areas(run.rest_positions, run.triangles) < 0.01 * longest**2


def flawed_strain(run):
    """Share of the flawed triangles in the sum of σ₁ - 1 over all triangles in the last frame, in %."""
    stretch = np.abs(run.cell("max_stretch", -1) - 1)
    return 100 * stretch[flawed_triangles(run)].sum() / stretch.sum()


def moved(run):
    """How far the cloth moved in the last 10 s of a run, after a turn about the vertical, in sizes."""
    times = run.metrics["time"]
    frames = run.trajectory([int(np.argmin(np.abs(times - (times[-1] - 10)))), run.frames - 1])
    before, after = frames - frames.mean(axis=1, keepdims=True)
    return rms_distance(turned_onto(before, after, np.zeros(3)), after) / run.size


# Numbers of a summary, and conditions of reasons on a summary.
strain = lambda summary: summary.get("mean_strain", np.nan)
rest_distance = lambda summary: summary.get("stability_rest_distance", np.nan)
shut_hinges = lambda summary: summary.get("stability_shut_hinges", np.nan)
folded = lambda summary: shut_hinges(summary) > 0.01
away = lambda summary: rest_distance(summary) > 0.01
rests_elsewhere = lambda summary: away(summary) and strain(summary) < 0.001
strained = lambda summary: strain(summary) > 0.02
drawn_out = lambda summary: strain(summary) > 1
drift = lambda summary: summary.get("stability_momentum_drift", np.nan)
drifts = lambda summary: drift(summary) > 0.01  # m/s
slow = lambda summary: strain(summary) < 0.03 and rest_distance(summary) < 0.01
QUANTITIES = {"strain": lambda run: strain(run.summary), "away": lambda run: rest_distance(run.summary),
              "drift": lambda run: drift(run.summary),
              "reach": lambda run: run.summary.get("stability_reach", np.nan),
              "back": lambda run: run.summary.get("stability_recovered_at", np.nan), "moved": moved,
              "shut": lambda run: 100 * shut_hinges(run.summary),
              "flawed": lambda run: 100 * flawed_triangles(run).mean(), "flawed_strain": flawed_strain}


def _pairs(quantity, change, *models, case=""):
    """Text with placeholders, for each model: number of this page → number with the change (model)."""
    return ", ".join(f"<{quantity}|{case}|{model}> → <{quantity}|{case}|{model}|{change}> ({model})"
                     for model in models)


def _rounds(*models, case=""):
    return SPREAD + "Mean strain with 10 → 100 iterations: " + _pairs("strain", "100", *models, case=case)


FREE = "meshes; order; units; rings; flaws"  # sheets stretched by half, without pins
SPREAD = "Ten iterations per step do not spread corrections through the whole sheet. "
CUT = "Mean strain if a step's forces may deform a triangle by at most 5 % → 1 % (/solver/flight_limit): "
IN_PARTS = "Ten iterations per part of a step do not spread corrections through the whole sheet. " + CUT
UNFELT = ("Without bending, no energy depends on a fold, so no force opens the fold. From 50 s to 60 s a "
          "creased sheet moves <moved|start: creased|none|minute> sizes")
STILL_MOVES = ("The distance from the rest shape is <away> sizes after 6 s and <away|||minute> sizes after "
               "60 s. From 50 s to 60 s the cloth moves <moved|||minute> sizes")
# The first reason that fits is taken.
REASONS = [Reason(tuple(cases.split("; ")), models, shows, text)
           for cases, models, shows, text in (
    ("pins: one bare", ("isometric",), strained, SPREAD + "Largest reach with 10 → 100 iterations: "
     "<reach||isometric> → <reach||isometric|100> sizes"),
    ("pins: one bare", (), strained, _rounds("crossover", "adaptive")),
    ("pins: one", (), strained, _rounds("dihedral", "adaptive", case="pins: one")),
    ("pins: two", (), strained, _rounds("dihedral", "none")),
    ("pins: side", (), strained, _rounds("dihedral", "none")),
    ("published", (), drawn_out, "Ten iterations leave triangles stretched, and then the projection of the "
     "published shear moves vertices too far. Mean strain of dihedral on two corners: <strain|published: "
     "two|dihedral>; <strain|published: two|dihedral|angle> with the shear as an angle; <strain|published: "
     "two|dihedral|100> with a hundred iterations"),
    ("published", (), strained, _rounds() + "<strain|published: two|dihedral> → <strain|published: "
     "two|dihedral|100> (dihedral, two corners), <strain|published: one|dihedral> → <strain|published: "
     "one|dihedral|100> (dihedral, one corner)"),
    ("pulled", (), strained, _rounds("dihedral", "none")),
    ("gust: ", (), strained, _rounds("dihedral", "none", "adaptive")),
    ("stiff", (), strained, _rounds("dihedral", "none")),
    ("falling: spinning", (), strained, _rounds("choi_ko")),
    ("falling: tumbling", (), strained, _rounds("choi_ko")),
    ("falling: tumbling", ("mid_edge",), drifts, "In single precision, rounding errors of the projections "
     "add up to a momentum. In double precision the sheet gains <drift|falling: tumbling|mid_edge> m/s"),
    ("mass_hanging", (), strained, "A projection moves only the light end of an edge, and the heavy half "
     "falls freely. The ratio of masses matters, not the number of iterations. Mean strain at ratios of 1, "
     "10, 100 and 1000: <strain||none|ratio 1>, <strain||none|ratio 10>, <strain||none|ratio 100>, "
     "<strain||none|ratio 1000>; at 10⁶: <strain||none|32 cells> with ten iterations, <strain||none|32 "
     "cells, 1000> with a thousand (model none, 32 × 32 cells)"),
    ("time_step_cut: 1 s", (), strained, IN_PARTS + _pairs("strain", "flight", "dihedral", "adaptive")),
    ("gust_cut", (), strained, IN_PARTS + _pairs("strain", "flight", "dihedral", "adaptive")),
    ("iterations_cut", (), strained, "One iteration per part of a step does not spread corrections through "
     "the whole sheet. " + CUT + _pairs("strain", "flight", "dihedral", "crossover", "adaptive")),
    ("iterations: one", (), strained, "One iteration per step does not spread corrections through the whole "
     "sheet. Mean strain with 1 → 10 iterations: " + _pairs("strain", "10", "dihedral", "adaptive")),
    ("time_step: 0.1 s", (), strained, "In a step the sheet falls 36 times as far as in 1/60 s, and ten "
     "iterations do not pull it back. Mean strain with 10 → 100 iterations: "
     + _pairs("strain", "100", "dihedral", "adaptive")),
    ("time_step: 1 s", (), strained, "In a step the sheet falls 10 m, and ten iterations do not pull it "
     "back. Mean strain with 10 → 1000 iterations: " + _pairs("strain", "1000", "none", "adaptive")),
    ("flaws: needles; flaws: caps", (), strained, "<flawed> % of all triangles are flawed and have "
     "<flawed_strain> % of the sum of σ₁ − 1 in the last frame: a displacement that strains other triangles "
     "by 0.001 strains a flawed triangle by 1"),
    ("curved: mirrored", (), rests_elsewhere, "The mirror image of a tube has the same lengths and unsigned "
     "angles, and is also at rest. After 60 s the strain is <strain|||minute>. From 50 s to 60 s the tube "
     "moves <moved|||minute> sizes"),
    ("curved: mirrored", (), away, "The tube is turned inside out, in another equilibrium. After 60 s the "
     "tube is <away|||minute> sizes from its rest shape (after 6 s <away>), with a strain of "
     "<strain|||minute>. From 50 s to 60 s the tube moves <moved|||minute> sizes"),
    ("curved", ("isometric",), away, "The tube unfolds inside out, into its mirror image, which is also at "
     "rest. After 60 s the tube is <away|||minute> sizes from its rest shape, with a strain of "
     "<strain|||minute>"),
    ("curved", ("none",), folded, UNFELT),
    ("curved", (), folded, "Shut folds (above 170°) hardly open. In the tube scaled by −0.1, <shut|curved: "
     "inverted|adaptive> % of the hinges are shut after 6 s, <shut|curved: inverted|adaptive|minute> % after "
     "60 s (adaptive)"),
    ("curved", (), away, "The tube comes to rest in another shape. The distance from the rest shape is "
     "<away||crossover dihedral> sizes after 6 s and <away||crossover dihedral|minute> sizes after 60 s "
     "(crossover and dihedral). From 50 s to 60 s the tube moves <moved||crossover dihedral|minute> sizes"),
    ("start: stretched", ("isometric",), strained, "The sheet is still returning to its rest shape. The "
     "distance from the rest shape is <away|start: stretched|isometric> sizes after 6 s, and below 0.01 "
     "sizes after <back|start: stretched|isometric|minute> s"),
    ("start: stretched", (), drawn_out, SPREAD + "With twenty iterations, the sheet has recovered after "
     "<back|start: stretched|dihedral none|20> s. Mean strain with 10 → 20 iterations: "
     + _pairs("strain", "20", "dihedral", "none", case="start: stretched")),
    ("start: stretched", (), slow, "The sheet is still returning to its rest shape: mean strain "
     "<strain|start: stretched|adaptive> after 6 s, <strain|start: stretched|adaptive|minute> after 60 s "
     "(adaptive)"),
    ("start", ("none",), folded, UNFELT),
    ("start: random", (), folded, "Shut folds (above 170°) do not open. In a sheet that starts at random in "
     "a box of its size, <shut|start: random|adaptive> % of the hinges are shut after 6 s, <shut|start: "
     "random|adaptive|minute> % after 60 s (adaptive)"),
    ("start", ("isometric",), folded, "The bending moment is proportional to sin θ, which is zero at 180°, "
     "so that shut folds stay shut. From 50 s to 60 s a collapsed sheet moves <moved|start: "
     "point|isometric|minute> sizes"),
    ("start", (), folded, "Shut folds (above 170°) do not open. From 50 s to 60 s a collapsed sheet moves "
     "<moved|start: point|crossover|minute> sizes (crossover). A hundred iterations per step do not open "
     "creases. Distance from the rest shape with 10 → 100 iterations, in sizes: "
     + _pairs("away", "100", "crossover", case="start: creased")),
    ("start: random 10", (), away, "The sheet swings, because nothing damps it. " + STILL_MOVES),
    ("start: random", ("isometric",), away, "The sheet is still returning to its rest shape. The distance "
     "from the rest shape is <away> sizes after 6 s and <away|||minute> sizes after 60 s"),
    ("start: random", (), away, "The sheet stays crumpled. The distance from the rest shape is <away> sizes "
     "after 6 s, <away|||minute> sizes after 60 s, and <away|||100> sizes with a hundred iterations"),
    ("start", (), away, "The folds open, but the sheet comes to rest crumpled. " + STILL_MOVES),
    ("meshes: ball; rings_across: ball", (), away, "Dents stay, because the dented ball is in another "
     "equilibrium. " + STILL_MOVES),
    ("mass: free", (), away, "The sheet swings, because nothing damps it. " + STILL_MOVES),
    ("meshes: strip", (), away, "The strip swings, because nothing damps it. " + STILL_MOVES),
    (FREE, ("isometric",), away, "The sheet swings while it returns to its rest shape. The plain grid is "
     "nearer to the rest shape than 0.01 sizes after <back|meshes: grid|isometric|minute> s"),
    (FREE, ("crossover", "k_ring", "sparse_lod"), away, "The sheet swings, because nothing damps it. The "
     "plain grid is <away|meshes: grid|crossover k_ring sparse_lod> sizes from its rest shape after 6 s and "
     "<away|meshes: grid|crossover k_ring sparse_lod|minute> sizes after 60 s. From 50 s to 60 s the grid "
     "moves <moved|meshes: grid|crossover k_ring sparse_lod|minute> sizes"),
    (FREE, (), away, "The sheet comes to rest in another shape. Distance of the plain grid from its rest "
     "shape after 6 → 60 s, in sizes: "
     + _pairs("away", "minute", "dihedral", "adaptive", case="meshes: grid") + ". From 50 s to 60 s the grid "
     "moves <moved|meshes: grid|dihedral adaptive|minute> sizes"),
)]


def reason(cell):
    """The first known cause that the run's metrics show, or None."""
    fits = (one for one in REASONS if cell.case.name.startswith(one.cases)
            and (not one.models or cell.model in one.models) and one.shows(cell.run.summary))
    return next(fits, None) if cell.run.complete else None


def explain(cells):
    """Writes a reason to `why` of every cell that is not green. `cells`: (case, model, precision) → cell."""
    keys = [key for key, cell in cells.items() if cell.verdict != "green"]
    for one, own in group(keys, lambda key: reason(cells[key])).items():
        if one:
            text = filled(one, {key: cells[key] for key in own}, cells) + repeat_text(one)
            for key in own:
                cells[key].why = text


@cache
def apart():
    """{config: {change: {case: {model: {quantity: number}}}}} in apart.json; empty without this file."""
    return json.loads(APART.read_text(encoding="utf-8")) if APART.exists() else {}


def filled(one, explained, cells):
    """The text of a reason with numbers for its placeholders. `explained`: the cells with this reason."""
    names = {name for name, _, _ in cells}
    own_names, own_models, _ = map(set, zip(*explained))

    def numbers(place):
        quantity, case, models, change = place.groups(default="")
        wanted = set(models.split())
        fits = lambda name: name == case if case in names else name.startswith(case or one.cases)
        if change:
            return range_text([found[quantity] for config, changed in one.apart if changed == change
                               for name, of_model in apart().get(config, {}).get(change, {}).items()
                               if fits(name) and (case or models or name in own_names)
                               for model, found in of_model.items() if model in (wanted or own_models)])
        pool = cells if models and (case or not wanted & own_models) else explained
        return range_text([QUANTITIES[quantity](cell.run) for (name, model, precision), cell in pool.items()
                           if precision == "double" and fits(name) and (not models or model in wanted)])
    return PLACE.sub(numbers, one.text)


def range_text(values):
    """The range as text, '0.17 to 0.26'; one number if the rounded ends are equal; – without numbers."""
    known = [value for value in values if value is not None and np.isfinite(value)]
    return span(known, 2) if known else "–"


def repeat_text(one):
    """Text: the commands that repeat the runs of a reason that are not from this page."""
    if not one.apart:
        return ""
    sets = lambda change: " ".join(f"--set {pointer}={value}" for pointer, value in CHANGES[change].items())
    commands = [f"./bendlab run configs/stability/{config}.json {sets(change)} --out /tmp/apart"
                for config, change in one.apart]
    return (". Numbers with changed settings or longer times are from runs apart from this page, in double "
            "precision: " + "; ".join(commands))
