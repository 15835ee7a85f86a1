"""Why a cell is not green: causes that were measured, each with the number that shows it in the run at hand.

The pairs of numbers in the texts are runs of the same scene with the one setting changed that is named (`bendlab run --set`),
in double precision, on the cells of the case unless others are named. Distances and motions are root mean squares after
alignment, in sizes.
"""
from dataclasses import dataclass

import numpy as np

SPRINGS = ("crossover", "k_ring", "adaptive", "lod", "sparse_lod")
SIGNLESS = ("none", *SPRINGS, "choi_ko", "isometric")  # their energy is the same for a shape and its mirror image
HINGES = ("dihedral", "bridson", "discrete_shells")
FREE = ("meshes", "order", "units", "rings", "flaws")  # sheets stretched by half

ROUNDS = "ten rounds a step do not reach through the sheet; with a hundred mean strain "


@dataclass(frozen=True)
class Reason:
    """A cause: for which cases (beginnings of their names) and models it may hold, and what the run's numbers then have to be."""

    cases: tuple
    models: tuple  # empty: all
    shows: object  # numbers of the summary → bool
    text: str


def _number(numbers, name):
    return numbers.get(f"stability_{name}", np.nan)


def _folded(numbers):
    return _number(numbers, "shut_hinges") > 0.01


def _away(numbers):
    return _number(numbers, "rest_distance") > 0.01


def _strained(numbers):
    return numbers.get("mean_strain", np.nan) > 0.02


def _drawn_out(numbers):
    return numbers.get("mean_strain", np.nan) > 1


def _slow(numbers):
    return numbers.get("mean_strain", np.nan) < 0.03 and _number(numbers, "rest_distance") < 0.01


REASONS = [
    # Loads: iterations 100, or as the text says.
    Reason(("pins: one bare",), ("isometric",), _strained,
           "ten rounds a step do not reach through the sheet; with a hundred it reaches 1.1 sizes at most, not 5.1"),
    Reason(("pins: one bare",), (), _strained, ROUNDS + "0.61 → 0.052 (crossover), 0.24 → 0.025 (adaptive)"),
    Reason(("pins: one",), (), _strained, ROUNDS + "0.84 → 0.065 (dihedral), 0.22 → 0.018 (adaptive)"),
    Reason(("pins: two",), (), _strained, ROUNDS + "0.96 → 0.064 (dihedral), 0.94 → 0.059 (no bending)"),
    Reason(("pins: side",), (), _strained, ROUNDS + "0.52 → 0.061 (dihedral), 0.65 → 0.057 (no bending)"),
    Reason(("published",), (), _drawn_out,
           "the published shear throws the triangles that ten rounds leave stretched: mean strain 6.6 (dihedral, two corners), below 1 with "
           "the shear as an angle, 0.064 with a hundred rounds"),
    Reason(("published",), (), _strained, ROUNDS + "6.6 → 0.064 (dihedral, two corners), 18 → 0.063 (one corner)"),
    Reason(("pulled",), (), _strained, ROUNDS + "1.18 → 0.070 (dihedral), 1.06 → 0.074 (no bending)"),
    Reason(("gust: ",), (), _strained, ROUNDS + "26 → 0.081 (dihedral), 26 → 0.18 (no bending), 1.9 → 0.027 (adaptive)"),
    Reason(("stiff",), (), _strained, ROUNDS + "1.05 → 0.067 (dihedral), 0.94 → 0.059 (no bending)"),
    Reason(("falling: spinning",), (), _strained, ROUNDS + "0.024 → 0.0012 (Choi-Ko)"),
    Reason(("falling: tumbling",), (), _strained, ROUNDS + "0.021 → 0.006 (Choi-Ko)"),
    Reason(("time_step_cut: 1 s",), (), _strained, "ten rounds a part do not reach through the sheet; with a limit of 0.01 mean strain "
           "0.21 → 0.033 (dihedral), 0.049 → 0.013 (adaptive)"),
    Reason(("gust_cut",), (), _strained, "ten rounds a part do not reach through the sheet; with a limit of 0.01 mean strain "
           "0.063 → 0.030 (dihedral), 0.013 → 0.0025 (adaptive)"),
    Reason(("iterations_cut",), (), _strained, "one round a part does not reach through the sheet; with a limit of 0.01 mean strain "
           "1.5 → 0.44 (dihedral), 0.27 → 0.15 (crossover), 0.18 → 0.089 (adaptive)"),
    Reason(("iterations: one",), (), _strained,
           "one round a step does not reach through the sheet: with ten mean strain 14.6 → 0.95 (dihedral), 2.5 → 0.17 (adaptive)"),
    Reason(("time_step: 0.1 s",), (), _strained,
           "in a step the sheet falls 36 times as far, and ten rounds do not bring it back: with a hundred mean strain 20 → 3.0 (dihedral), "
           "2.7 → 0.56 (adaptive)"),
    Reason(("time_step: 1 s",), (), _strained,
           "in a step the sheet falls 10 m, and ten rounds do not bring it back: with a thousand mean strain 269 → 20 (no bending), "
           "387 → 2.2 (adaptive)"),
    Reason(("mass_hanging",), (), _strained,
           "a projection moves the light end of an edge alone, and the heavy half falls as if free, 56 sizes in 4 s; the ratio decides, not the "
           "rounds: mean strain 0.11 at 1 : 1, 0.60 at 10, 6.4 at 100, 69 at 1000; at 10⁶ 85 with ten rounds, 83 with a thousand (no "
           "bending, 32 × 32 cells)"),
    # Flaws: shares of the triangles' strains in the runs themselves.
    Reason(("flaws: needles", "flaws: caps"), (), _strained,
           "the flawed triangles, 3 to 6 % of all, carry 97 % and more of the mean strain: a slip that strains the others by 0.001 "
           "strains these by 1"),
    # Tubes: duration 60.
    Reason(("curved: mirrored",), SIGNLESS, _away,
           "a mirror image has the same lengths and unsigned angles and is as much at rest: after 60 s its strain is below 10⁻¹² and it "
           "moves less than 10⁻⁷ in 10 s"),
    Reason(("curved: mirrored",), (*HINGES, "prestressed"), _away,
           "inside out the tube is in another equilibrium: after 60 s as far away (0.323) at a strain of 0.006 (prestressed 0.022), and it "
           "moves less than 0.001 in 10 s"),
    Reason(("curved",), ("isometric",), _away,
           "it unfolds inside out, into the mirror image, which is as much at rest: after 60 s 0.322 away at a strain of 6·10⁻⁵"),
    Reason(("curved",), ("crossover", "k_ring", "adaptive", "lod", "sparse_lod"), _folded,
           "shut folds hardly open: of the tube scaled by −0.1 30 % of the hinges are shut after 6 s, 26 % after 60 s (adaptive)"),
    Reason(("curved",), (*HINGES, "prestressed", "choi_ko", "crossover", "k_ring", "sparse_lod"), _away,
           "it stands in another shape: after 60 s 0.16 to 0.24 away (crossover and dihedral; after 6 s 0.17 to 0.26), moving 0.003 and less "
           "in 10 s"),
    # Stretched 100×: iterations 20; duration 60.
    Reason(("start: stretched",), ("isometric",), _strained, "on its way: 0.43 from rest after 6 s, below 0.01 from 11 s on"),
    Reason(("start: stretched",), (), _drawn_out,
           "ten rounds a step do not reach through the sheet: with twenty it is back after 3.6 s (mean strain 9.2 → 0.015, dihedral; "
           "8.0 → 0.015, no bending)"),
    Reason(("start: stretched",), (), _slow, "on its way: mean strain 0.022 after 6 s, 0.0012 after 60 s (adaptive)"),
    # Shut folds: duration 60, and iterations 100, of collapsed and creased starts.
    Reason(("start", "curved"), ("none",), _folded, "strain alone does not see a fold, nothing opens it: a creased sheet does not move in 60 s"),
    Reason(("start: random",), (), _folded,
           "shut folds do not open: from a box of its size 3.6 % of the hinges are shut after 6 s, 2.8 % after 60 s (adaptive)"),
    Reason(("start",), ("isometric",), _folded,
           "its moment goes with sin θ and vanishes at 180°: shut folds stay, after 60 s a collapsed sheet moves less than 10⁻⁸ in 10 s"),
    Reason(("start",), (), _folded,
           "shut folds lock: after 60 s a collapsed sheet is where it was after 6 s and moves less than 10⁻⁶ in 10 s, and a hundred rounds "
           "a step do not open creases (0.207 → 0.199, crossover)"),
    # Crumpled, without shut folds: duration 60, iterations 100.
    Reason(("start: random 10",), (), _away,
           "it swings, and nothing damps it: 0.07 to 0.20 away after 6 s, 0.01 to 0.14 after 60 s, where it moves 0.008 to 0.07 in 10 s"),
    Reason(("start: random",), ("isometric",), _away, "on its way: 0.155 away after 6 s, 0.021 after 60 s"),
    Reason(("start: random",), (), _away,
           "it stays crumpled: after 60 s 0.11 to 0.21 away (after 6 s 0.16 to 0.21), with a hundred rounds 0.12 to 0.26"),
    Reason(("start",), HINGES, _away,
           "its folds open, but it settles crumpled: after 60 s 0.10 to 0.19 away (after 6 s 0.13 to 0.19), moving 0.02 and less in 10 s; a "
           "creased sheet stands at 0.141 (moves 3·10⁻⁵, Bridson)"),
    # Free sheets stretched by half: duration 60, with and without rigid damping.
    Reason(("meshes: ball", "rings_across: ball"), (), _away,
           "dents stay, the dented ball is another equilibrium: after 60 s 0.10 to 0.26 away (after 6 s 0.13 to 0.26), moving less than 0.002 "
           "in 10 s"),
    Reason(("mass: free",), (), _away,
           "it swings, and nothing damps it: 0.06 to 0.21 away after 6 s, 0.01 to 0.16 after 60 s, where it moves 0.02 to 0.10 in 10 s"),
    Reason(("meshes: strip",), (), _away,
           "it swings, and nothing damps it: 0.11 to 0.27 away after 6 s, 0.06 to 0.13 after 60 s, where it moves 0.03 to 0.08 in 10 s"),
    Reason(FREE, ("isometric",), _away, "on its way, swinging: the plain grid is back below 0.01 from 34 s on"),
    Reason(FREE, ("crossover", "k_ring", "sparse_lod"), _away,
           "it swings, and nothing damps it: after 60 s the plain grid is 0.10 to 0.13 away (after 6 s 0.13 to 0.16) and moves 0.05 to 0.17 "
           "in 10 s, flawed and irregular meshes 0.01 to 0.16 (crossover)"),
    Reason(FREE, (), _away,
           "it stands in another shape: after 60 s the plain grid is 0.03 to 0.20 away (dihedral 0.131, after 6 s 0.144; adaptive 0.051 "
           "and 0.055) and moves less than 0.01 in 10 s, flawed and irregular meshes less than 0.05"),
]


def reason(cell):
    """The first known cause whose number is there, or nothing."""
    if not cell.run.complete:
        return ""
    for one in REASONS:
        if cell.case.name.startswith(one.cases) and (not one.models or cell.model in one.models) and one.shows(cell.run.summary):
            return one.text
    return ""
