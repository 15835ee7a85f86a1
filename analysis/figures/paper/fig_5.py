"""Fig. 5: crossover and adaptive springs at several resolutions.

The paper's adaptive runs have other springs, and they also pin the 1-ring of the pinned vertex. To separate
these two effects, this figure adds runs with only one of the changes, and edge springs as a control.
"""
import numpy as np

from draw import cloth
from tables.numbers import number
from tables import looks
from bendlab.results.load import summary_spread, typical_run
from figures.paper import medians
from tables.chart import Chart
from tables.section import Claim
from tables.table import Table
from runs.sweeps import load_experiment

PAPER = [("crossover", 0), ("adaptive", 1)]  # Fig. 5a and 5b
CONTROLS = [("crossover", 1), ("adaptive", 0), ("k_ring", 0), ("k_ring", 1)]
PIN = ("pin_max_stretch", 1)  # metric and offset
PINS = {0: "pin alone", 1: "pin + 1-ring"}
METRICS = [("pin_max_stretch", 1, "stretch − 1 at the pin"),
           ("pin_region_stretch", 1, "stretch − 1 near the pin (0.1 of size)"),
           ("mean_strain", 0, "mean strain"), ("drop", 0, "drop below the pin (m)")]
ROUNDED = [("pin_max_stretch", 1, "stretch − 1 at the pin"), ("mean_strain", 0, "mean strain"),
           ("springs_beyond_ring_1", 0, "springs beyond ring 1")]
LEVELS = [("model_m", 0, "m"), ("model_n", 0, "n"), ("springs", 0, "springs")]
PARTS = {"whole": "both (the paper's comparison)", "model": "springs: adaptive instead of crossover",
         "ring": "pins: 1-ring pinned too", "interaction": "interaction"}
CONFIGS_OF_ALL = ("paper/fig5", "paper/fig5_128")


def main(results, out, section):
    undamped = [run for config in CONFIGS_OF_ALL for run in section.uses(load_experiment(results, config))]
    undamped += load_experiment(results, "paper/fig5_full").runs
    damped = section.uses(load_experiment(results, "paper/fig5_damped"))
    floor = Grid(undamped, "floor")
    if floor.cells:
        section.pictures += _pictures(floor, out)
    grids = {"no damping": floor, "rigid-mode damping, 1 per second": Grid(damped, "floor")}
    section.tables += [_table(grids), _factor_table(floor), _rounding_table(undamped)]
    section.charts += [
        Chart("fig_5_numbers", "Crossover and adaptive springs at several resolutions", "fig_5", "N",
              [name for name, *_ in METRICS], ["model", "pinned"], held=["damping"], at="no damping",
              scale="log2",
              y_scale="log", limits=[(name, 1, "twice as long") for name, offset, _ in METRICS if offset],
              note="Medians over the last second and over seeds (five up to N = 64, then three). Bars go "
                   "from the smallest to the largest seed."),
        Chart("fig_5_factors", "How much each of the two changes reduces the stretch", "fig_5_factors", "N",
              ["factor"], ["what"], held=["metric"], scale="log2", y_scale="log", look="",
              limits=[("factor", 1, "no change")],
              note="The factor by which a change reduces stretch − 1. The product of both factors is the "
                   "factor of the paper's comparison: crossover springs with the pin alone against "
                   "adaptive springs with the pin and its 1-ring."),
        Chart("fig_5_rounding",
              "Two readings of eq. 6: m is rounded down (floor), or to the nearest integer (round)",
              "fig_5_rounding", "N", [name for name, *_ in ROUNDED], ["rounding"], scale="log2",
              y_scale="log", look="")]
    section.claims += _claims(floor)


class Grid:
    """The runs with one rounding of m, by (model, pinned rings, cells)."""

    def __init__(self, runs, rounding):
        self.runs = {}
        for run in runs:
            if run.get("/bending/adaptive/m_rounding", rounding) == rounding:
                self.runs.setdefault((run.model, run.get("/pins/ring"), run.get("/mesh/cells")),
                                     []).append(run)
        self.cells = sorted({n for _, _, n in self.runs})

    def spread(self, model, ring, n, metric, offset=0):
        return summary_spread(self.runs.get((model, ring, n), []), metric) - offset

    def over_cells(self, model, ring, metric, offset=0):
        return [self.spread(model, ring, n, metric, offset) for n in self.cells]

    def ends(self, model, ring, metric, offset=0):
        """The Spreads at the coarsest and at the finest resolution."""
        known = self.over_cells(model, ring, metric, offset)
        return (known[0], known[-1]) if known else (self.spread(model, ring, 0, metric),) * 2


def factors(grid, n, metric, offset=1):
    """By how many powers of ten each change reduces a metric at N = n.

    `model`: adaptive instead of crossover springs, as mean over both kinds of pins. `ring`: the 1-ring pinned
    too, as mean over both models. `whole`: both changes; the sum of `model` and `ring`. `interaction`: how
    much smaller the effect of the pinned 1-ring is with adaptive springs than with crossover springs.
    """
    def level(model, ring):
        s = grid.spread(model, ring, n, metric, offset)
        return np.log10(s.median) if s.known and s.median > 0 else np.nan
    c0, c1, a0, a1 = level("crossover", 0), level("crossover", 1), level("adaptive", 0), level("adaptive", 1)
    return {"whole": c0 - a1, "model": ((c0 - a0) + (c1 - a1)) / 2, "ring": ((c0 - c1) + (a0 - a1)) / 2,
            "interaction": (c0 - c1) - (a0 - a1)}


def _pictures(grid, out):
    samples = {(model, ring, n): typical_run(grid.runs.get((model, ring, n), []))
               for model, ring in PAPER + CONTROLS for n in grid.cells}
    cameras = dict(zip(samples, cloth.cameras_of(list(samples.values()), aspect=0.7)))
    paper = _sheets(samples, cameras, PAPER, grid.cells, out, "fig_5")
    controls = _sheets(samples, cameras, CONTROLS, grid.cells, out, "fig_5_controls")
    return [(paper, "Crossover springs with one pinned vertex (Fig. 5a), and adaptive springs with its "
             "1-ring pinned too (Fig. 5b). Each picture shows the last frame of the seed nearest to the "
             "median. All pictures have one scale."),
            (controls, "Not in the paper: crossover springs with the 1-ring pinned, adaptive springs with "
             "the pin alone, and springs along the edges of the mesh only.")]


def _sheets(samples, cameras, rows, cells, out, name):
    panels = {f"{looks.model_name(model)}, {PINS[ring]}": [
        cloth.Panel(samples[model, ring, n], cameras[model, ring, n], f"N = {n}",
                    _pin_text(samples[model, ring, n])) for n in cells] for model, ring in rows}
    return cloth.sheet(panels, out, name)


def _pin_text(sample):
    if not sample:
        return ""
    run, frame = sample
    return f"pin: σ₁ − 1 = {number(run.metrics['pin_max_stretch'][frame] - 1)}"


def _table(grids):
    rows = [{"damping": damping, "model": model, "pinned": PINS[ring], "N": n}
            | medians.row(runs, [*METRICS, ("springs", 0, "")])
            for damping, grid in grids.items() for model, ring in PAPER + CONTROLS for n in grid.cells
            if (runs := grid.runs.get((model, ring, n)))]
    return Table.of("fig_5", "Median over the last second and over seeds, m rounded down", [
        "damping", "model", "pinned", ("N", "resolution N (cells per side)"), ("springs", "springs", ",.0f"),
        *medians.columns(METRICS), ("status", "runs")], rows)


def _factor_table(grid):
    rows = []
    for metric, offset, label in METRICS[:2]:
        for n in grid.cells:
            e = factors(grid, n, metric, offset)
            rows += [{"metric": label, "N": n, "what": what, "factor": 10 ** e[part],
                      "share": 100 * e[part] / e["whole"] if abs(e["whole"]) > 0.05 else None}
                     for part, what in PARTS.items()]
    return Table.of(
        "fig_5_factors", "By which factor each change reduces stretch − 1. Both changes together: from "
                         "crossover springs with the pin alone to adaptive springs with the 1-ring pinned. "
                         "This factor is the product of the factors of the springs and of the pins. Shares "
                         "refer to the logarithm of this factor. Interaction: the factor of the pins with "
                         "crossover springs, divided by the factor of the pins with adaptive springs.",
        [("metric", "metric"), ("N", "resolution N (cells per side)"), ("what", "change"), "factor",
         ("share", "share of both", ".0f", "%")], rows)


def _rounding_table(runs):
    rows = []
    for rounding in ("floor", "round"):
        grid = Grid(runs, rounding)
        rows += [{"rounding": f"m by {rounding}", "N": n}
                 | medians.row(grid.runs["adaptive", 1, n], ROUNDED + LEVELS)
                 for n in grid.cells if ("adaptive", 1, n) in grid.runs]
    return Table.of("fig_5_rounding", "Adaptive springs with the 1-ring pinned: two readings of eq. 6", [
        ("rounding", "reading"), ("N", "resolution N (cells per side)"),
        *((name, label, ".0f") for name, _, label in LEVELS), *medians.columns(ROUNDED)], rows)


def _claims(grid):
    return [*_resolution_claims(grid), _cause_claim(grid)]


def _resolution_claims(grid):
    """The claims of Figs. 5a and 5b about stretch and drop at several resolutions."""
    cells = grid.cells or [0]
    low, high = cells[0], cells[-1]
    names = [f"N = {n}" for n in cells]
    crossover, adaptive = grid.over_cells("crossover", 0, *PIN), grid.over_cells("adaptive", 1, *PIN)
    known = len(grid.cells) > 1 and all(s.known for s in crossover + adaptive)
    medians = lambda spreads: dict(zip(names, (s.median for s in spreads)))
    drops = grid.over_cells("adaptive", 1, "drop")
    change = max(s.median for s in drops) / min(s.median for s in drops) - 1 if known else np.nan
    rises = known and (crossover[-1].low > crossover[0].high and crossover[-1].median > 1
                       and all(b.median >= a.median for a, b in zip(crossover, crossover[1:])))
    stays = known and all(s.median < 1 for s in adaptive) and adaptive[-1].median < 2 * adaptive[0].median
    setting = "one substep of 10 iterations, without damping"
    return [Claim("5a", "Crossover springs look right at low resolution and fail around the pin as "
                  "resolution rises.", "with the pin alone, stretch − 1 at the pin at N = "
                  f"{high} is larger for every seed than for any seed at N = {low}, the median at N = {high} "
                  "is above 1 (twice as long), and the median never falls when N doubles", medians(crossover),
                  rises if known else None, setting=setting),
            Claim("5b", "Adaptive springs don't degrade with resolution: normal cloth at every resolution.",
                  "with the 1-ring pinned, the median stretch − 1 at the pin stays below 1 at every N, and "
                  f"changes by less than a factor of 2 between N = {low} and {high}", medians(adaptive),
                  stays if known else None, setting=setting),
            Claim("5b", "Adaptive springs are equally stiff at every resolution.",
                  "the median drop of the sheet differs by less than 10 % between resolutions",
                  {f"drop (m), {name}": s.median for name, s in zip(names, drops)}
                  | {"largest over smallest − 1": change}, bool(change < 0.1) if known else None,
                  "A stretched sheet also hangs lower, so the drop does not measure the stiffness. The drop "
                  "only limits how much the stiffness can differ.", setting=setting)]


def _cause_claim(grid):
    """The claim about the cause of the improvement: the springs or the pins."""
    high = grid.cells[-1] if grid.cells else 0
    effect, near = factors(grid, high, *PIN), factors(grid, high, "pin_region_stretch", 1)
    step = lambda a, b: grid.spread(*a, high, *PIN).median / grid.spread(*b, high, *PIN).median
    c0, c1, a0, a1 = ("crossover", 0), ("crossover", 1), ("adaptive", 0), ("adaptive", 1)
    numbers = {"reduction by both (factor)": 10 ** effect["whole"],
               "the springs' part (factor)": 10 ** effect["model"],
               "the 1-ring's part (factor)": 10 ** effect["ring"],
               "the springs' share": effect["model"] / effect["whole"],
               "the springs' share, near the pin (0.1 of size)": near["model"] / near["whole"],
               "adaptive instead of crossover, pin alone (factor)": step(c0, a0),
               "1-ring pinned too, crossover (factor)": step(c0, c1),
               "adaptive instead of crossover, 1-ring pinned (factor)": step(c1, a1),
               "1-ring pinned too, adaptive (factor)": step(a0, a1)}
    holds = all(e["model"] > 2 * e["ring"] for e in (effect, near)) if np.isfinite(effect["whole"]) else None
    return Claim("5", "Our question: do the adaptive springs cause the improvement?",
                 "the springs, and not the pinned 1-ring, cause more than two thirds of the reduction of "
                 f"stretch − 1 at N = {high} (in logarithms), both at the pin and near it", numbers, holds,
                 setting="one substep of 10 iterations, without damping")
