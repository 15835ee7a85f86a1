"""Where the failure went: stretch against distance from the pin, per model and N.

A model that mends the pin has not mended the cloth if the stretch is then elsewhere. The paper's adaptive
springs come with a pinned 1-ring, so crossover springs are shown with it too: only then do the two differ in
nothing but their springs.
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

COMPARED = 64  # cells; the title compares the two models here
CROSSOVER, MENDED, ADAPTIVE = ("crossover, pin alone", "crossover, pin + 1-ring", "adaptive, pin + 1-ring")
BARE, OURS = "adaptive, pin alone", "recommended, pin alone"
FALLING = {CROSSOVER: ("crossover", 0), BARE: ("adaptive", 0), MENDED: ("crossover", 1),
           ADAPTIVE: ("adaptive", 1)}
KEY = ("Largest stretch of the triangles at each distance from the nearest pinned vertex: median over the "
       "last second and the seeds (bars: smallest and largest seed). A triangle above 1 is more than twice "
       "as long as at rest, which counts as failed. ")


def main(results, out, section):
    """Shows stretch over distance from the pin: falling as in Fig. 5, with other n, and at rest."""
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
                              "Adaptive springs, pin + 1-ring, with another n; falling, without damping"),
                       _table("rest", rest, "At rest in a medium: median over the last second, one seed"),
                       _bins("falling_bins", falling), _bins("scaled_bins", {"": scaled}),
                       _bins("rest_bins", rest), _rings(known)]
    curves = dict(x="distance", ys=["worst", "usual"], y_scale="log", look="")
    limits = [("worst", WRONG, "twice as long as at rest")]
    section.charts = [
        Chart("where", falling_title(falling), "falling_bins", curve=["N"], held=["case"], at=ADAPTIVE,
              limits=limits, note=KEY + "No damping, as in Fig. 5.", **curves),
        Chart("where_scaled", "Longer springs of the pin carry the failure away from it", "scaled_bins",
              curve=["n"], limits=limits, note=KEY + "The runs of Fig. 7: n × 1, 2 and 4.", **curves),
        Chart("where_cause", f"{sum(map(_at_end, failed))} of {len(failed)} settings that fail do so where "
                             "the pin's springs end", "rings", "n", ["ring"], ["N", "state"],
              theory="rings_end",
              look="",
              joined=False, y_scale="log",
              note="Adaptive springs with the 1-ring pinned, no damping: every N, m rounded down and to the "
              "nearest, and the three n of Fig. 7. Bars are the middle four fifths over frames and seeds. "
              "The lines are n and n + 1: the end of the pin's springs (eq. 7)."),
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
    """N → Group."""
    cells = lambda run: run.get("/mesh/cells")
    return {n: measure(own_runs) for n, own_runs in sorted(group(runs, cells).items())}


def _scaled(section, results):
    """Multiplier of n → Group, of the sheets of Fig. 7 without damping."""
    runs = [run for run in section.uses(load_experiment(results, "paper/fig7")) if not damping_rate(run)]
    factor = lambda run: run.get("/bending/adaptive/n_multiplier")
    return {k: measure(own_runs) for k, own_runs in sorted(group(runs, factor).items())}


def _at_rest(section, results):
    """Case → N → Group, of sheets that hang from one corner in the medium of the recommended settings."""
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
    """What Fig. 5 shows at COMPARED cells with the 1-ring pinned, in numbers."""
    crossover, adaptive = (cases[case].get(COMPARED) for case in (MENDED, ADAPTIVE))
    if not crossover or not adaptive:
        return ""
    two = lambda s: number(s.median, 2)
    return (f"With the 1-ring pinned, N = {COMPARED}: at the pin (within {NEAR:g} cells) adaptive springs "
            f"have a stretch − 1 of {two(adaptive.near)}, crossover springs {two(crossover.near)}. Beyond, "
            f"adaptive springs have {two(adaptive.far)} and crossover springs {two(crossover.far)}: the "
            f"largest is now {adaptive.in_cells:.1f} cells from the pin instead of {crossover.in_cells:.1f}.")


def rest_title(cases):
    """The largest stretch on any N of each case at rest."""
    worst = {case: max(groups.values(), key=lambda sheet: sheet.whole.median)
             for case, groups in cases.items() if groups}
    return "At rest, the largest stretch − 1 on any N and its distance from the pin: " + "; ".join(
        f"{case}: {number(sheet.whole.median, 2)} at {sheet.in_cells:.1f} cells"
        for case, sheet in worst.items())


def _bins(id, cases):
    """The stretch in each bin of distance, for a chart."""
    rows = [{"case": case, "N": sheet.n, "n": sheet.reach, "distance": middle, "worst": worst.median,
             "worst_low": worst.low, "worst_high": worst.high, "usual": usual}
            for case, groups in cases.items() for sheet in groups.values()
            for middle, worst, usual in zip(sheet.middles, sheet.worst, sheet.usual) if worst.known]
    return Table.of(id, "", ["case", "N", ("n", "n", "g"), (
        "distance", "distance at rest from the nearest pinned vertex", "", "m"),
        ("worst", "largest stretch σ₁ − 1"), ("usual", "stretch that nine of ten triangles stay "
                                                       "below")], rows)


def _rings(known):
    """The ring of the most stretched triangle's farthest corner over n, for a chart."""
    rows = [{"n": sheet.reach, "N": sheet.n, "state": "" if sheet.failed else "does not fail",
             "ring": sheet.ring, "ring_low": sheet.rings[0], "ring_high": sheet.rings[1]} for sheet in known]
    return Table.of("rings", "", [("n", "n: rings that the springs of a pinned vertex reach"), "N", "state",
                                  ("ring", "ring of the most stretched triangle's farthest corner")], rows)


def _text(cases):
    known = [sheet for groups in cases for sheet in groups.values()]
    check = (" The largest σ₁ found here agrees with the program's own metric, max_stretch, to "
             f"{number(max(sheet.disagreement for sheet in known), 2)} of it in every frame."
             if known else "")
    return ("The verdicts of Fig. 5 look at the pin. A cloth whose pin is sound has still failed if it is "
            "torn elsewhere. Here σ₁ of every triangle is computed from its positions and shown over its "
            "distance at rest from the nearest pinned vertex. Triangles whose three corners are pinned are "
            "left out: they cannot stretch." + check)


def _table(id, cases, caption):
    rows = [{"case": case, "N": sheet.n, "place": sheet.place.median, "cells": sheet.in_cells,
             "ring": sheet.ring, "wander": tuple(end / sheet.cell for end in sheet.range), "n": sheet.reach,
             "status": ", ".join(f"{count} {status}" for status, count in sheet.status.items())}
            | medians.cells("near", sheet.near) | medians.cells("far", sheet.far)
            | medians.cells("whole", sheet.whole)
            for case, groups in cases.items() for sheet in groups.values()]
    return Table.of(id, f"{caption}. Distances are at rest, from the nearest pinned vertex.", [
        "case", "N", *medians.columns([("near", 0, f"largest stretch − 1 within {NEAR:g} "
                                                   f"cells"), ("far", 0, "beyond"),
                                       ("whole", 0, "anywhere")]),
        ("place", "where the largest is", "", "m"), ("cells", "the same", ".1f", "cells"),
        ("wander", "it wanders over", ".1f", "cells"), ("ring", "ring of its farthest "
                                                                "corner", "g"), ("n", "n", "g"),
        ("status", "runs")], rows)


def _claims(adaptive, crossover, more):
    """Whether cloth is sound beyond the pin too, where it fails, and whether crossover springs are worse.

    `more`: further adaptive Groups, with another n.
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
            Claim("5b", "Our question: has the failure moved, to where the springs of the pin end?",
                  "wherever adaptive springs with the 1-ring fail (at any N, either reading of eq. 6, n × 1, "
                  f"2 or 4), the largest within {NEAR:g} cells of the pinned vertices is smaller than the "
                  "largest beyond, and the most stretched triangle has its farthest corner in ring n of the "
                  "pinned vertices, the last that their springs reach, or in the next",
                  {f"N = {sheet.n}, n = {sheet.reach:g}: ring, within {NEAR:g} cells, beyond": [
                      sheet.ring, sheet.near.median, sheet.far.median] for sheet in failed},
                  all(map(_moved, failed)) if failed else None, _pin_note(failed), setting=setting),
            Claim("5", "Our question: with the same pins, does cloth stretch less with adaptive springs than "
                  "with crossover springs, at the pin and beyond?",
                  "with the 1-ring pinned in both, at every N the median of the largest stretch − 1 is "
                  f"smaller with adaptive springs, both within {NEAR:g} cells of the pinned vertices and "
                  "beyond",
                  {f"{case}, {name}": value for case, groups in ((MENDED, crossover), (ADAPTIVE, adaptive))
                   for name, value in _numbers(groups).items()},
                  all(less) if less else None, setting=setting)]


def _numbers(groups):
    """The medians at the pin and beyond, by N."""
    return {f"N = {sheet.n}: within {NEAR:g} cells, beyond": [sheet.near.median, sheet.far.median]
            for sheet in groups.values()}


def _at_end(sheet):
    """Whether the most stretched triangle lies where the pin's springs end."""
    return sheet.reach <= sheet.ring <= sheet.reach + 1


def _moved(sheet):
    """Whether the failure is where the pin's springs end, and larger than at the pin."""
    return _at_end(sheet) and sheet.near.median < sheet.far.median


def _pin_note(failed):
    """A sentence on the sheets whose pin has failed, too; "" if there are none."""
    still = [f"N = {sheet.n}, n = {sheet.reach:g} ({number(sheet.near.median, 2)})" for sheet in failed
             if sheet.near.median > WRONG]
    return f"The pin itself has failed too at {'; '.join(still)}." if still else ""
