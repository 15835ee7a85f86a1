"""Where the cloth fails: stretch against distance from the pin, per model and N.

If triangles at the pin no longer fail, triangles elsewhere may fail instead. For adaptive springs the paper
also pins the 1-ring. So crossover springs are also shown with a pinned 1-ring: then only the springs differ.
"""
import numpy as np

from tables.numbers import number
from tables.chart import Chart
from figures.paper.fig_6 import damping_rate
from bendlab.results.load import group
from figures.paper import medians
from tables.section import Claim
from tables.table import Table
from runs.stretch import NEAR, WRONG, measure
from runs.sweeps import load_experiment

COMPARED = 64  # cells of the meshes that the title compares
CROSSOVER, MENDED, ADAPTIVE = ("crossover, pin alone", "crossover, pin + 1-ring", "adaptive, pin + 1-ring")
BARE, OURS = "adaptive, pin alone", "recommended, pin alone"
FALLING = {CROSSOVER: ("crossover", 0), BARE: ("adaptive", 0), MENDED: ("crossover", 1),
           ADAPTIVE: ("adaptive", 1)}
KEY = ("Largest stretch of the triangles at each distance from the nearest pinned vertex: median over the "
       "last second and the seeds (bars: smallest and largest seed). A triangle with more than 1 is more "
       "than twice as long as at rest, and counts as failed. ")


def main(results, out, section):
    runs = [run for config in ("paper/fig5", "paper/fig5_128")
            for run in section.uses(load_experiment(results, config))]
    runs = runs + load_experiment(results, "paper/fig5_full").runs
    falling = {case: _by_cells(_of_kind(runs, *kind, "floor")) for case, kind in FALLING.items()}
    rounded = _by_cells(_of_kind(runs, *FALLING[ADAPTIVE], "round"))
    scaled, rest = _scaled(section, results), _at_rest(section, results)
    known = [*falling[ADAPTIVE].values(), *rounded.values(), *(sheet for k, sheet in scaled.items() if k > 1)]
    failed = [sheet for sheet in known if sheet.failed]
    section.text = _text([*falling.values(), rounded, scaled, *rest.values()])
    section.tables += [_table("falling", falling, "Falling, without damping: median over the last second and "
                                                  "over seeds (smallest – largest seed)"),
                       _table("scaled", {"m to the nearest": rounded, "n × 1, 2, 4": scaled},
                              "Falling, without damping: adaptive springs, pin + 1-ring, with other n"),
                       _table("rest", rest, "At rest in a medium: median over the last second, one seed"),
                       _bins("falling_bins", falling), _bins("scaled_bins", {"": scaled}),
                       _bins("rest_bins", rest), _rings(known)]
    curves = dict(x="distance", ys=["worst", "usual"], y_scale="log", look="")
    limits = [("worst", WRONG, "twice as long as at rest")]
    section.charts = [
        Chart("where", falling_title(falling), "falling_bins", curve=["N"], held=["case"], at=ADAPTIVE,
              limits=limits, note=KEY + "No damping, as in Fig. 5.", **curves),
        Chart("where_scaled", "With longer springs of the pin the failure lies farther from the pin",
              "scaled_bins", curve=["n"], limits=limits, note=KEY + "The runs of Fig. 7: n × 1, 2 and 4.",
              **curves),
        Chart("where_cause", f"{sum(map(_at_end, failed))} of {len(failed)} failed settings fail where the "
                             "springs of the pin end", "rings", "n", ["ring"], ["N", "state"],
              theory="rings_end",
              look="",
              joined=False, y_scale="log",
              note="Adaptive springs with the 1-ring pinned, no damping: every N, both roundings of m, and "
              "the three n of Fig. 7. Bars contain the middle four fifths of all frames and seeds. The lines "
              "are n and n + 1, where the pin's springs end (eq. 7)."),
        Chart("where_rest", rest_title(rest), "rest_bins", curve=["N"], held=["case"], at=OURS,
              limits=limits, note=KEY + "In a medium with about the drag of air, one seed.", **curves)]
    section.tables.append(Table.of("rings_end", "", ["n", "ring", "N", "state"], [
        {"n": n, "ring": n + more, "N": f"n + {more}" if more else "n", "state": ""}
        for more in (0, 1) for n in sorted({sheet.reach for sheet in known if np.isfinite(sheet.reach)})]))
    section.claims += _claims(falling[ADAPTIVE], falling[MENDED], [*rounded.values(), *scaled.values()])


def _of_kind(runs, model, ring, rounding):
    return [run for run in runs if (run.model, run.get("/pins/ring")) == (model, ring)
            and run.get("/bending/adaptive/m_rounding", rounding) == rounding]


def _by_cells(runs):
    """{N: Group}"""
    cells = lambda run: run.get("/mesh/cells")
    return {n: measure(own_runs) for n, own_runs in sorted(group(runs, cells).items())}


def _scaled(section, results):
    """{multiplier of n: Group} of the sheets of Fig. 7 without damping."""
    runs = [run for run in section.uses(load_experiment(results, "paper/fig7")) if not damping_rate(run)]
    factor = lambda run: run.get("/bending/adaptive/n_multiplier")
    return {k: measure(own_runs) for k, own_runs in sorted(group(runs, factor).items())}


def _at_rest(section, results):
    """{case: {N: Group}} of sheets that hang from one corner in the medium of the recommended settings."""
    kinds = {CROSSOVER: ("paper/fig5_rest",), ADAPTIVE: ("paper/promise", "paper/promise_full"),
             OURS: ("recommended", "paper/recommended_full")}
    cases = {}
    for case, configs in kinds.items():
        runs = section.uses(load_experiment(results, configs[0]))
        runs = runs + [run for config in configs[1:] for run in load_experiment(results, config).runs]
        cases[case] = _by_cells([run for run in runs if run.get("/pins/vertices") == ["upper_right"]
                                 and run.get("/bending/adaptive/m_rounding", "floor") == "floor"])
    return cases


def falling_title(cases):
    """The stretches at COMPARED cells with the 1-ring pinned, as text."""
    crossover, adaptive = (cases[case].get(COMPARED) for case in (MENDED, ADAPTIVE))
    if not crossover or not adaptive:
        return ""
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
    return "At rest: the largest stretch − 1 with any N, and its distance from the pin: " + "; ".join(
        f"{case}: {number(sheet.whole.median, 2)} at {sheet.in_cells:.1f} cells"
        for case, sheet in worst.items())


def _bins(id, cases):
    """A table for a chart: the stretch in each bin of distances."""
    rows = [{"case": case, "N": sheet.n, "n": sheet.reach, "distance": middle, "worst": worst.median,
             "worst_low": worst.low, "worst_high": worst.high, "usual": usual}
            for case, groups in cases.items() for sheet in groups.values()
            for middle, worst, usual in zip(sheet.middles, sheet.worst, sheet.usual) if worst.known]
    return Table.of(id, "", ["case", "N", ("n", "n", "g"), (
        "distance", "distance at rest from the nearest pinned vertex", "", "m"),
        ("worst", "largest stretch σ₁ − 1"), ("usual", "stretch below which nine of ten "
                                                       "triangles are")], rows)


def _rings(known):
    """A table for a chart: the ring of the farthest corner of the most stretched triangle, over n."""
    rows = [{"n": sheet.reach, "N": sheet.n, "state": "" if sheet.failed else "does not fail",
             "ring": sheet.ring, "ring_low": sheet.rings[0], "ring_high": sheet.rings[1]} for sheet in known]
    return Table.of("rings", "", [("n", "n: rings that a pinned vertex has springs to"), "N", "state",
                                  ("ring", "ring of the most stretched triangle (farthest corner)")], rows)


def _text(cases):
    known = [sheet for groups in cases for sheet in groups.values()]
    check = (" In every frame the largest σ₁ differs from the program's own metric max_stretch by at most "
             f"{number(max(sheet.disagreement for sheet in known), 2)} of its value."
             if known else "")
    return ("The verdicts of Fig. 5 only consider the pin. But cloth has also failed if it is torn "
            "elsewhere. This section computes σ₁ of every triangle from its positions, and shows σ₁ over the "
            "distance at rest from the nearest pinned vertex. Triangles with three pinned corners are left "
            "out, because they cannot stretch." + check)


def _table(id, cases, caption):
    rows = [{"case": case, "N": sheet.n, "place": sheet.place.median, "cells": sheet.in_cells,
             "ring": sheet.ring, "wander": tuple(end / sheet.cell for end in sheet.range), "n": sheet.reach,
             "status": ", ".join(f"{count} {status}" for status, count in sheet.status.items())}
            | medians.cells("near", sheet.near) | medians.cells("far", sheet.far)
            | medians.cells("whole", sheet.whole)
            for case, groups in cases.items() for sheet in groups.values()]
    return Table.of(id, f"{caption}. Distances are at rest, from the nearest pinned vertex.", [
        "case", "N", *medians.columns([("near", 0, f"largest stretch − 1 within {NEAR:g} "
                                                   f"cells"), ("far", 0, "largest farther away"),
                                       ("whole", 0, "largest anywhere")]),
        ("place", "distance of the largest", "", "m"), ("cells", "distance", ".1f", "cells"),
        ("wander", "distance varies over", ".1f", "cells"), ("ring", "ring of its farthest "
                                                                "corner", "g"), ("n", "n", "g"),
        ("status", "runs")], rows)


def _claims(adaptive, crossover, more):
    """Claims: whether cloth fails away from the pin, where it fails, and whether crossover springs are worse.

    `more`: further Groups of adaptive springs, with other n.
    """
    both = [n for n in adaptive if n in crossover]
    failed = [sheet for sheet in [*adaptive.values(), *more] if sheet.failed]
    setting = "one substep of 10 iterations, without damping"
    less = [getattr(adaptive[n], part).median < getattr(crossover[n], part).median
            for n in both for part in ("near", "far")]
    return [Claim("5b", "Adaptive springs keep the whole cloth from failing, and not only the pin.",
                  "with the 1-ring pinned, the median of the largest stretch − 1 anywhere stays below 1 "
                  "(twice as long) at every N", _numbers(adaptive),
                  not any(sheet.failed for sheet in adaptive.values()) if adaptive else None,
                  setting=setting),
            Claim("5b", "Our question: does the cloth fail where the springs of the pin end, not at the pin?",
                  "if adaptive springs with the 1-ring fail (any N, both readings of eq. 6, n × 1, 2 or 4), "
                  f"the largest stretch within {NEAR:g} cells of the pinned vertices is smaller than the "
                  "largest stretch farther away. The farthest corner of the most stretched triangle then is "
                  "in ring n of the pinned vertices (the last ring with springs) or in ring n + 1",
                  {f"N = {sheet.n}, n = {sheet.reach:g}: ring, within {NEAR:g} cells, farther away": [
                      sheet.ring, sheet.near.median, sheet.far.median] for sheet in failed},
                  all(map(_moved, failed)) if failed else None, _pin_note(failed), setting=setting),
            Claim("5", "Our question: with the same pins, does cloth stretch less with adaptive springs than "
                  "with crossover springs, both at the pin and farther away?",
                  "with the 1-ring pinned in both, at every N the median of the largest stretch − 1 is "
                  f"smaller with adaptive springs, both within {NEAR:g} cells of the pinned vertices and "
                  "farther away",
                  {f"{case}, {name}": value for case, groups in ((MENDED, crossover), (ADAPTIVE, adaptive))
                   for name, value in _numbers(groups).items()},
                  all(less) if less else None, setting=setting)]


def _numbers(groups):
    """For each N, the medians at the pin and farther away."""
    return {f"N = {sheet.n}: within {NEAR:g} cells, farther away": [sheet.near.median, sheet.far.median]
            for sheet in groups.values()}


def _at_end(sheet):
    """Whether the most stretched triangle lies at the end of the pin's springs."""
    return sheet.reach <= sheet.ring <= sheet.reach + 1


def _moved(sheet):
    """Whether the largest stretch is at the end of the pin's springs, and not at the pin."""
    return _at_end(sheet) and sheet.near.median < sheet.far.median


def _pin_note(failed):
    """A sentence about sheets that have also failed at the pin, or ""."""
    still = [f"N = {sheet.n}, n = {sheet.reach:g} ({number(sheet.near.median, 2)})" for sheet in failed
             if sheet.near.median > WRONG]
    return f"The cloth has also failed at the pin for {'; '.join(still)}." if still else ""
