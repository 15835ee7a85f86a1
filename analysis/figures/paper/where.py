"""Where the cloth fails: stretch against distance from the pin, per model and N.

If triangles at the pin no longer fail, triangles elsewhere may fail instead. For adaptive springs the paper
also pins the 1-ring. So crossover springs are also shown with a pinned 1-ring: then only the springs differ.
"""
import numpy as np

from bendlab.results.load import group, select
from figures.paper import fig_5, medians
from figures.paper.fig_6 import damping_rate
from runs.stretch import NEAR, WRONG, Group
from runs.sweeps import used_runs
from tables.numbers import number
from tables.section import Chart, Claim, Table

COMPARED = 64  # cells of the meshes that the title compares
CROSSOVER, MENDED, ADAPTIVE = ("crossover, pin alone", "crossover, pin + 1-ring", "adaptive, pin + 1-ring")
BARE, OURS = "adaptive, pin alone", "recommended, pin alone"
FALLING = {case: {"bending__model": model, "pins__ring": ring} for case, model, ring in (
    (CROSSOVER, "crossover", 0), (BARE, "adaptive", 0), (MENDED, "crossover", 1), (ADAPTIVE, "adaptive", 1))}
REST = {CROSSOVER: ("paper/fig5_rest",), ADAPTIVE: ("paper/promise", "paper/promise_full"),
        OURS: ("recommended", "paper/recommended_full")}
KEY = ("Largest stretch of the triangles at each distance from the nearest pinned vertex: median over the "
       "last second and the seeds (bars: smallest and largest seed). A triangle with more than 1 is more "
       "than twice as long as at rest, and counts as failed. ")


def main(results, out, section):
    runs = used_runs(section, results, *fig_5.CONFIGS)
    falling = {case: _measured(fig_5.with_rounding(select(runs, **kind), "floor"))
               for case, kind in FALLING.items()}
    rounded = _measured(fig_5.with_rounding(select(runs, **FALLING[ADAPTIVE]), "round"))
    scaled = _measured([run for run in used_runs(section, results, "paper/fig7") if not damping_rate(run)],
                       "/bending/adaptive/n_multiplier")
    rest = {case: used_runs(section, results, *configs) for case, configs in REST.items()}
    rest = {case: _measured(fig_5.with_rounding(select(runs, pins__vertices=["upper_right"]), "floor"))
            for case, runs in rest.items()}
    known = [*falling[ADAPTIVE].values(), *rounded.values(), *(sheet for k, sheet in scaled.items() if k > 1)]
    failed = [sheet for sheet in known if sheet.failed]
    section.text = _text([*falling.values(), rounded, scaled, *rest.values()])
    ends = sorted({sheet.reach for sheet in known if np.isfinite(sheet.reach)})
    section.tables += [
        _table("falling", falling, "Falling, without damping: median over the last second and over seeds "
               "(smallest – largest seed)"),
        _table("scaled", {"m to the nearest": rounded, "n × 1, 2, 4": scaled},
               "Falling, without damping: adaptive springs, pin + 1-ring, with other n"),
        _table("rest", rest, "At rest in a medium: median over the last second, one seed"),
        _bins("falling_bins", falling), _bins("scaled_bins", {"": scaled}), _bins("rest_bins", rest),
        _rings(known), Table.of("rings_end", "", ["n", "ring", "N", "state"], [
            *((n, n, "n", "") for n in ends), *((n, n + 1, "n + 1", "") for n in ends)])]
    curves = dict(x="distance", ys=["worst", "usual"], y_scale="log", look="",
                  limits=[("worst", WRONG, "twice as long as at rest")])
    section.charts = [
        Chart("where", falling_title(falling), "falling_bins", curve=["N"], held=["case"], at=ADAPTIVE,
              note=KEY + "No damping, as in Fig. 5.", **curves),
        Chart("where_scaled", "With longer springs of the pin the failure lies farther from the pin",
              "scaled_bins", curve=["n"], note=KEY + "The runs of Fig. 7: n × 1, 2 and 4.", **curves),
        Chart("where_cause", f"{sum(map(_at_end, failed))} of {len(failed)} failed settings fail where the "
              "springs of the pin end", "rings", "n", ["ring"], ["N", "state"], theory="rings_end", look="",
              joined=False, y_scale="log",
              note="Adaptive springs with the 1-ring pinned, no damping: every N, both roundings of m, and "
              "the three n of Fig. 7. Bars contain the middle four fifths of all frames and seeds. The lines "
              "are n and n + 1, where the pin's springs end (eq. 7)."),
        Chart("where_rest", rest_title(rest), "rest_bins", curve=["N"], held=["case"], at=OURS,
              note=KEY + "In a medium with about the drag of air, one seed.", **curves)]
    section.claims += _claims(falling[ADAPTIVE], falling[MENDED], [*rounded.values(), *scaled.values()])


def _measured(runs, pointer="/mesh/cells"):
    """{value of a setting: Group}"""
    groups = group(runs, lambda run: run.get(pointer))
    return {value: Group(own_runs) for value, own_runs in sorted(groups.items())}


def falling_title(cases):
    """The stretches at COMPARED cells with the 1-ring pinned, as text."""
    crossover, adaptive = (cases[case].get(COMPARED) for case in (MENDED, ADAPTIVE))
    if not crossover or not adaptive:
        return "The largest stretch over the distance from the pin"
    two = lambda s: number(s.median, 2)
    return (f"With the 1-ring pinned, N = {COMPARED}: at the pin (within {NEAR:g} cells) adaptive springs "
            f"have a stretch − 1 of {two(adaptive.near)}, crossover springs {two(crossover.near)}. Farther "
            f"away, adaptive springs have {two(adaptive.far)} and crossover springs {two(crossover.far)}. "
            f"The largest stretch is {adaptive.in_cells:.1f} cells from the pin with adaptive springs, and "
            f"{crossover.in_cells:.1f} cells with crossover springs.")


def rest_title(cases):
    """Text: for each case at rest, the largest stretch with any N."""
    worst = {case: max(groups.values(), key=lambda sheet: sheet.whole.median)
             for case, groups in cases.items() if groups}
    texts = [f"{case}: {number(sheet.whole.median, 2)} at {sheet.in_cells:.1f} cells"
             for case, sheet in worst.items()]
    return f"At rest: the largest stretch − 1 with any N, and its distance from the pin: {'; '.join(texts)}"


def _bins(id, cases):
    """A table for a chart: the stretch in each bin of distances."""
    rows = [{"case": case, "N": sheet.n, "n": sheet.reach, "distance": middle, "worst": worst.median,
             "worst_low": worst.low, "worst_high": worst.high, "usual": usual}
            for case, groups in cases.items() for sheet in groups.values()
            for middle, worst, usual in zip(sheet.middles, sheet.worst, sheet.usual) if worst.known]
    distance = ("distance", "distance at rest from the nearest pinned vertex", "", "m")
    return Table.of(id, "", [
        "case", "N", ("n", "n", "g"), distance, ("worst", "largest stretch σ₁ − 1"),
        ("usual", "stretch below which nine of ten triangles are")], rows)


def _rings(known):
    """A table for a chart: the ring of the farthest corner of the most stretched triangle, over n."""
    rows = [{"n": sheet.reach, "N": sheet.n, "state": "" if sheet.failed else "does not fail",
             "ring": sheet.ring, "ring_low": sheet.rings[0], "ring_high": sheet.rings[1]} for sheet in known]
    return Table.of("rings", "", [("n", "n: rings that a pinned vertex has springs to"), "N", "state",
                                  ("ring", "ring of the most stretched triangle (farthest corner)")], rows)


def _text(cases):
    known = [sheet for groups in cases for sheet in groups.values()]
    check = (" In every frame the largest σ₁ differs from the program's own metric max_stretch by at most "
             f"{number(max(sheet.disagreement for sheet in known), 2)} of its value." if known else "")
    return ("The verdicts of Fig. 5 only consider the pin. But cloth has also failed if it is torn "
            "elsewhere. This section computes σ₁ of every triangle from its positions, and shows σ₁ over the "
            "distance at rest from the nearest pinned vertex. Triangles with three pinned corners are left "
            "out, because they cannot stretch." + check)


def _table(id, cases, caption):
    parts = [("near", 0, f"largest stretch − 1 within {NEAR:g} cells"), ("far", 0, "largest farther away"),
             ("whole", 0, "largest anywhere")]
    rows = [{"case": case, "N": sheet.n, "place": sheet.place.median, "cells": sheet.in_cells,
             "ring": sheet.ring, "wander": tuple(end / sheet.cell for end in sheet.range), "n": sheet.reach,
             "status": medians.status_text(sheet.status)} | medians.cells("near", sheet.near)
            | medians.cells("far", sheet.far) | medians.cells("whole", sheet.whole)
            for case, groups in cases.items() for sheet in groups.values()]
    return Table.of(id, f"{caption}. Distances are at rest, from the nearest pinned vertex.", [
        "case", "N", *medians.columns(parts), ("place", "distance of the largest", "", "m"),
        ("cells", "distance", ".1f", "cells"), ("wander", "distance varies over", ".1f", "cells"),
        ("ring", "ring of its farthest corner", "g"), ("n", "n", "g"), ("status", "runs")], rows)


def _claims(adaptive, crossover, more):
    """Claims: whether cloth fails away from the pin, where it fails, and whether crossover springs are worse.

    `more`: further Groups of adaptive springs, with other n.
    """
    failed = [sheet for sheet in [*adaptive.values(), *more] if sheet.failed]
    less = [getattr(adaptive[n], part).median < getattr(crossover[n], part).median
            for n in adaptive if n in crossover for part in ("near", "far")]
    at_pin = [f"N = {sheet.n}, n = {sheet.reach:g} ({number(sheet.near.median, 2)})" for sheet in failed
              if sheet.near.median > WRONG]
    both = f"within {NEAR:g} cells, farther away"
    numbers = lambda groups, case="": {
        f"{case}N = {sheet.n}: {both}": [sheet.near.median, sheet.far.median] for sheet in groups.values()}
    moved = {f"N = {sheet.n}, n = {sheet.reach:g}: ring, {both}":
             [sheet.ring, sheet.near.median, sheet.far.median] for sheet in failed}
    return [Claim("5b", "Adaptive springs keep the whole cloth from failing, and not only the pin.",
                  "with the 1-ring pinned, the median of the largest stretch − 1 anywhere stays below 1 "
                  "(twice as long) at every N", numbers(adaptive),
                  not any(sheet.failed for sheet in adaptive.values()) if adaptive else None,
                  setting=fig_5.SETTING),
            Claim("5b", "Our question: does the cloth fail where the springs of the pin end, not at the pin?",
                  "if adaptive springs with the 1-ring fail (any N, both readings of eq. 6, n × 1, 2 or 4), "
                  f"the largest stretch within {NEAR:g} cells of the pinned vertices is smaller than the "
                  "largest stretch farther away. The farthest corner of the most stretched triangle then is "
                  "in ring n of the pinned vertices (the last ring with springs) or in ring n + 1", moved,
                  all(_at_end(sheet) and sheet.near.median < sheet.far.median for sheet in failed)
                  if failed else None,
                  f"The cloth has also failed at the pin for {'; '.join(at_pin)}." if at_pin else "",
                  setting=fig_5.SETTING),
            Claim("5", "Our question: with the same pins, does cloth stretch less with adaptive springs than "
                  "with crossover springs, both at the pin and farther away?", "with the 1-ring pinned in "
                  "both, at every N the median of the largest stretch − 1 is smaller with adaptive springs, "
                  f"both within {NEAR:g} cells of the pinned vertices and farther away",
                  numbers(crossover, f"{MENDED}, ") | numbers(adaptive, f"{ADAPTIVE}, "),
                  all(less) if less else None, setting=fig_5.SETTING)]


def _at_end(sheet):
    """Whether the most stretched triangle lies at the end of the pin's springs."""
    return sheet.reach <= sheet.ring <= sheet.reach + 1
