"""Fig. 5: crossover and adaptive springs at several resolutions.

The paper's adaptive runs have other springs, and they also pin the 1-ring of the pinned vertex. To separate
these two effects, this figure adds runs with only one of the changes, and edge springs as a control.
"""
import itertools

import numpy as np

from bendlab.results.load import group, summary_spread
from draw import cloth
from figures.paper import medians
from runs.sweeps import used_runs
from tables.looks import model_name
from tables.section import Claim, Table

CONFIGS = ("paper/fig5", "paper/fig5_128", "paper/fig5_full")
PAPER = [("crossover", 0), ("adaptive", 1)]  # (model, pinned rings) of Fig. 5a and 5b
CONTROLS = [("crossover", 1), ("adaptive", 0), ("k_ring", 0), ("k_ring", 1)]
PINS = {0: "pin alone", 1: "pin + 1-ring"}
PIN, NEAR = ("pin_max_stretch", 1), ("pin_region_stretch", 1)  # metric and offset
METRICS = [(*PIN, "stretch − 1 at the pin"), (*NEAR, "stretch − 1 near the pin (0.1 of size)"),
           ("mean_strain", 0, "mean strain"), ("drop", 0, "drop below the pin (m)")]
ROUNDED = [(*PIN, "stretch − 1 at the pin"), ("mean_strain", 0, "mean strain"),
           ("springs_beyond_ring_1", 0, "springs beyond ring 1")]
LEVELS = [("model_m", 0, "m"), ("model_n", 0, "n"), ("springs", 0, "springs")]
PARTS = {"whole": "both (the paper's comparison)", "model": "springs: adaptive instead of crossover",
         "ring": "pins: 1-ring pinned too", "interaction": "interaction"}
N_COLUMN = ("N", "resolution N (cells per side)")
SETTING = "one substep of 10 iterations, without damping"


def main(results, out, section):
    undamped = used_runs(section, results, *CONFIGS)
    damped = used_runs(section, results, "paper/fig5_damped")
    floor = Grid(undamped, "floor")
    if floor.cells:
        section.pictures += _pictures(floor, out)
    scales = {"scale": "log2", "y_scale": "log"}
    section.add_chart(
        _table({"no damping": floor, "rigid-mode damping, 1 per second": Grid(damped, "floor")}),
        "Crossover and adaptive springs at several resolutions", "N", medians.names(METRICS),
        ["model", "pinned"], id="fig_5_numbers", held=["damping"], at="no damping", **scales,
        limits=[(name, 1, "twice as long") for name, offset, _ in METRICS if offset],
        note="Medians over the last second and over seeds, whose number is in the table. Bars go from the "
        "smallest to the largest seed.")
    section.add_chart(
        _factor_table(floor), "How much each of the two changes reduces the stretch", "N", ["factor"],
        ["what"], held=["metric"], look="", limits=[("factor", 1, "no change")], **scales,
        note="The factor by which a change reduces stretch − 1. The product of both factors is the factor of "
        "the paper's comparison: crossover springs with the pin alone against adaptive springs with the pin "
        "and its 1-ring.")
    section.add_chart(
        _rounding_table(undamped), "Two readings of eq. 6: m is rounded down (floor), or to the nearest "
        "integer (round)", "N", medians.names(ROUNDED), ["rounding"], look="", **scales)
    section.claims += [*_resolution_claims(floor), _cause_claim(floor)]


def with_rounding(runs, rounding):
    """The runs with one rounding of m, and the runs of models that do not round."""
    return [run for run in runs if run.get("/bending/adaptive/m_rounding", rounding) == rounding]


class Grid:
    """The runs with one rounding of m, by (model, pinned rings, cells)."""

    def __init__(self, runs, rounding):
        self.runs = group(with_rounding(runs, rounding),
                          lambda run: (run.model, run.get("/pins/ring"), run.get("/mesh/cells")))
        self.cells = sorted({n for _, _, n in self.runs})

    def spread(self, model, ring, n, metric, offset=0):
        return summary_spread(self.runs.get((model, ring, n), []), metric) - offset

    def over_cells(self, model, ring, metric, offset=0):
        return [self.spread(model, ring, n, metric, offset) for n in self.cells]


def factors(grid, n, metric, offset=1):
    """By how many powers of ten each change reduces a metric at N = n.

    `model`: adaptive instead of crossover springs, as mean over both kinds of pins. `ring`: the 1-ring pinned
    too, as mean over both models. `whole`: both changes; the sum of `model` and `ring`. `interaction`: how
    much smaller the effect of the pinned 1-ring is with adaptive springs than with crossover springs.
    """
    def level(model, ring):
        s = grid.spread(model, ring, n, metric, offset)
        return np.log10(s.median) if s.known and s.median > 0 else np.nan
    c0, c1, a0, a1 = (level(model, ring) for model in ("crossover", "adaptive") for ring in (0, 1))
    return {"whole": c0 - a1, "model": ((c0 - a0) + (c1 - a1)) / 2, "ring": ((c0 - c1) + (a0 - a1)) / 2,
            "interaction": (c0 - c1) - (a0 - a1)}


def _pictures(grid, out):
    keys = [(*case, n) for case in PAPER + CONTROLS for n in grid.cells]
    panels = dict(zip(keys, medians.panels([(f"N = {key[2]}", grid.runs.get(key, []), "") for key in keys],
                                           aspect=0.7)))
    for panel in panels.values():
        panel.text = medians.pin_text(panel.sample)
    sheet = lambda cases, name: cloth.sheet(
        {f"{model_name(model)}, {PINS[ring]}": [panels[model, ring, n] for n in grid.cells]
         for model, ring in cases}, out, name)
    return [(sheet(PAPER, "fig_5"), "Crossover springs with one pinned vertex (Fig. 5a), and adaptive "
             "springs with its 1-ring pinned too (Fig. 5b). Each picture shows the last frame of the seed "
             "nearest to the median. All pictures have one scale."),
            (sheet(CONTROLS, "fig_5_controls"), "Not in the paper: crossover springs with the 1-ring pinned, "
             "adaptive springs with the pin alone, and springs along the edges of the mesh only.")]


def _table(grids):
    rows = [{"damping": damping, "model": model, "pinned": PINS[ring], "N": n}
            | medians.row(grid.runs[model, ring, n], [*METRICS, ("springs", 0, "")])
            for damping, grid in grids.items() for model, ring in PAPER + CONTROLS for n in grid.cells
            if (model, ring, n) in grid.runs]
    return Table.of("fig_5", "Median over the last second and over seeds, m rounded down", [
        "damping", "model", "pinned", N_COLUMN, ("springs", "springs", ",.0f"), *medians.columns(METRICS),
        ("status", "runs")], rows)


def _factor_table(grid):
    rows = []
    for (metric, offset, label), n in itertools.product(METRICS[:2], grid.cells):
        e = factors(grid, n, metric, offset)
        share = lambda part: 100 * e[part] / e["whole"] if abs(e["whole"]) > 0.05 else None
        rows += [(label, n, what, 10 ** e[part], share(part)) for part, what in PARTS.items()]
    return Table.of(
        "fig_5_factors", "By which factor each change reduces stretch − 1. Both changes together: from "
        "crossover springs with the pin alone to adaptive springs with the 1-ring pinned. This factor is the "
        "product of the factors of the springs and of the pins. Shares refer to the logarithm of this "
        "factor. Interaction: the factor of the pins with crossover springs, divided by the factor of the "
        "pins with adaptive springs.", [("metric", "metric"), N_COLUMN, ("what", "change"), "factor",
                                        ("share", "share of both", ".0f", "%")], rows)


def _rounding_table(runs):
    grids = {rounding: Grid(runs, rounding).runs for rounding in ("floor", "round")}
    rows = [{"rounding": f"m by {rounding}", "N": n} | medians.row(own_runs, ROUNDED + LEVELS)
            for rounding, groups in grids.items() for (model, ring, n), own_runs in sorted(groups.items())
            if (model, ring) == ("adaptive", 1)]
    return Table.of("fig_5_rounding", "Adaptive springs with the 1-ring pinned: two readings of eq. 6", [
        ("rounding", "reading"), N_COLUMN, *((name, label, ".0f") for name, _, label in LEVELS),
        *medians.columns(ROUNDED), ("status", "runs")], rows)


def _resolution_claims(grid):
    """The claims of Figs. 5a and 5b about stretch and drop at several resolutions."""
    low, high = (grid.cells[0], grid.cells[-1]) if grid.cells else (0, 0)
    crossover, adaptive = grid.over_cells("crossover", 0, *PIN), grid.over_cells("adaptive", 1, *PIN)
    drops = [s.median for s in grid.over_cells("adaptive", 1, "drop")]
    numbers = lambda values, what="": {f"{what}N = {n}": value for n, value in zip(grid.cells, values)}
    rises = stays = equal = None
    change = np.nan
    if len(grid.cells) > 1 and all(s.known for s in crossover + adaptive):
        before, after = [s.median for s in crossover], [s.median for s in adaptive]
        rises = crossover[-1].low > crossover[0].high and before[-1] > 1 and before == sorted(before)
        stays = max(after) < 1 and after[-1] < 2 * after[0]
        change = max(drops) / min(drops) - 1
        equal = bool(change < 0.1)
    return [Claim("5a", "Crossover springs look right at low resolution and fail around the pin as "
                  "resolution rises.", f"with the pin alone, stretch − 1 at the pin at N = {high} is larger "
                  f"for every seed than for any seed at N = {low}, the median at N = {high} is above 1 "
                  "(twice as long), and the median never falls when N doubles",
                  numbers(s.median for s in crossover), rises, setting=SETTING),
            Claim("5b", "Adaptive springs don't degrade with resolution: normal cloth at every resolution.",
                  "with the 1-ring pinned, the median stretch − 1 at the pin stays below 1 at every N, and "
                  f"changes by less than a factor of 2 between N = {low} and {high}",
                  numbers(s.median for s in adaptive), stays, setting=SETTING),
            Claim("5b", "Adaptive springs are equally stiff at every resolution.",
                  "the median drop of the sheet differs by less than 10 % between resolutions",
                  numbers(drops, "drop (m), ") | {"largest over smallest − 1": change}, equal,
                  "A stretched sheet also hangs lower, so the drop does not measure the stiffness. The drop "
                  "only limits how much the stiffness can differ.", setting=SETTING)]


def _cause_claim(grid):
    """The claim about the cause of the improvement: the springs or the pins."""
    high = grid.cells[-1] if grid.cells else 0
    effect, near = factors(grid, high, *PIN), factors(grid, high, *NEAR)
    c0, c1, a0, a1 = (grid.spread(model, ring, high, *PIN).median
                      for model in ("crossover", "adaptive") for ring in (0, 1))
    numbers = {"reduction by both (factor)": 10 ** effect["whole"],
               "the springs' part (factor)": 10 ** effect["model"],
               "the 1-ring's part (factor)": 10 ** effect["ring"],
               "the springs' share": effect["model"] / effect["whole"],
               "the springs' share, near the pin (0.1 of size)": near["model"] / near["whole"],
               "adaptive instead of crossover, pin alone (factor)": c0 / a0,
               "1-ring pinned too, crossover (factor)": c0 / c1,
               "adaptive instead of crossover, 1-ring pinned (factor)": c1 / a1,
               "1-ring pinned too, adaptive (factor)": a0 / a1}
    holds = all(e["model"] > 2 * e["ring"] for e in (effect, near)) if np.isfinite(effect["whole"]) else None
    return Claim("5", "Our question: do the adaptive springs cause the improvement?",
                 "the springs, and not the pinned 1-ring, cause more than two thirds of the reduction of "
                 f"stretch − 1 at N = {high} (in logarithms), both at the pin and near it", numbers, holds,
                 setting=SETTING)
