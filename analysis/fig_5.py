"""Fig. 5: crossover and adaptive springs over resolutions; the effect is split into that of springs and that
of pins.

The paper's adaptive runs also pin the 1-ring of the pinned vertex: it changes two settings at once. This
figure adds the two runs that change one setting only, and edge springs as a control.
"""
import right_python  # noqa: F401  (first: it may hand over to another Python)
import matplotlib.pyplot as plt
import numpy as np

import style
from bendlab.results.load import statuses, summary_spread, typical_run
from report import Claim, Section, Table, figure_main
from sweeps import load_experiment

MODELS = ["crossover", "adaptive", "k_ring"]
PAPER = [("crossover", 0), ("adaptive", 1)]  # Fig. 5a and 5b
CONTROLS = [("crossover", 1), ("adaptive", 0), ("k_ring", 0), ("k_ring", 1)]
PIN = ("pin_max_stretch", 1)  # metric and offset
PINS = {0: "pin alone", 1: "pin + 1-ring"}
METRICS = [("pin_max_stretch", 1, "stretch − 1 at the pin"),
           ("pin_region_stretch", 1, "stretch − 1 near the pin (0.1 of size)"),
           ("mean_strain", 0, "mean strain"), ("drop", 0, "drop below the pin (m)")]

CONFIGS_OF_ALL = ("paper/fig5", "paper/fig5_128")


def main(results, out):
    """Draws the sheets and numbers of Fig. 5."""
    section = Section("Crossover against adaptive springs over resolutions", "5")
    undamped = [run for config in CONFIGS_OF_ALL for run in section.uses(load_experiment(results, config))]
    undamped += load_experiment(results, "paper/fig5_full").runs
    damped = section.uses(load_experiment(results, "paper/fig5_damped"))
    floor = Grid(undamped, "floor")
    if floor.cells:
        section.pictures += _pictures(floor, out)
        section.pictures.append((_numbers(floor, out, "fig_5_numbers"), "Medians over the last second and "
                                 "over seeds, five up to N = 64, then three; bars: smallest and largest "
                                 "seed. No damping."))
        section.pictures.append((_factors(floor, out), "The factor by which each of the two changes reduces "
                                 "the stretch. On this logarithmic scale the two bars add up to the paper's "
                                 "comparison: crossover springs with the pin alone, adaptive springs with "
                                 "the pin's 1-ring."))
        section.pictures.append((_rounding(undamped, out), "Two readings of eq. 6: level m rounded down "
                                 "(floor) or to the nearest (round)."))
    if damped:
        section.pictures.append((_numbers(Grid(damped, "floor"), out, "fig_5_damped"),
                                 "The same with weak rigid-mode damping (1 per second), three seeds."))
    section.tables += [_table(floor), _factor_table(floor), _rounding_table(undamped)]
    section.claims += _claims(floor)
    return section


class Grid:
    """Runs by (model, pinned rings, cells), for one rounding of m."""

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
        """Spreads at the coarsest and the finest resolution."""
        known = self.over_cells(model, ring, metric, offset)
        return (known[0], known[-1]) if known else (self.spread(model, ring, 0, metric),) * 2


def factors(grid, n, metric, offset=1):
    """Effects of the two changes on a metric at N = n, in decades (log10).

    `whole`: both changes. `model`, `ring`: one change, mean over the settings of the other; their sum is
    `whole`. `interaction`: how much smaller the ring's effect is with adaptive springs.
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
    cameras = dict(zip(samples, style.cameras_of(list(samples.values()), aspect=0.7)))
    paper = _sheets(samples, cameras, PAPER, grid.cells, out, "fig_5")
    controls = _sheets(samples, cameras, CONTROLS, grid.cells, out, "fig_5_controls")
    return [(paper, "Crossover springs with one pinned vertex (Fig. 5a), and adaptive springs with its "
             "1-ring pinned too (Fig. 5b). The last frame of the seed nearest to the median; one "
             "scale."),
            (controls, "Not in the paper: crossover springs with the 1-ring pinned, adaptive springs with "
             "the pin alone, and springs on the mesh's edges only.")]


def _sheets(samples, cameras, rows, cells, out, name):
    figure, axes = plt.subplots(len(rows), len(cells), figsize=(2.45 * len(cells) + 1, 3.05 * len(rows)),
                                squeeze=False, layout="compressed")
    for row, (model, ring) in enumerate(rows):
        for column, n in enumerate(cells):
            sample = samples[model, ring, n]
            style.draw_cloth(axes[row, column], sample, cameras[model, ring, n], width=360,
                             text=_pin_text(sample))
            axes[row, column].set_title(f"N = {n}")
        axes[row, 0].text(-0.03, 0.5, f"{style.model_name(model)}, {PINS[ring]}",
                          transform=axes[row, 0].transAxes, rotation=90, ha="right", va="center", fontsize=10)
    style.stretch_bar(figure, axes, shrink=min(1, 1.6 / len(rows)), pad=0.01, aspect=24)
    return style.save(figure, out, name)


def _pin_text(sample):
    if not sample:
        return None
    run, frame = sample
    return f"pin: σ₁ − 1 = {style.number(run.metrics['pin_max_stretch'][frame] - 1)}"


def _numbers(grid, out, name):
    figure, axes = plt.subplots(2, 2, figsize=(10.8, 6.6), layout="constrained")
    for panel, (metric, offset, label) in zip(axes.flat, METRICS):
        for i, model in enumerate(MODELS):
            for ring in (0, 1):
                style.with_range(panel, grid.cells, grid.over_cells(model, ring, metric, offset),
                                 label=f"{style.model_name(model)}, {PINS[ring]}",
                                 shift=1.02 ** (2 * i + ring - 2.5),
                                 **style.look(model, linestyle="-" if ring else "--",
                                              **{} if ring else {"markerfacecolor": "white"}))
        style.plain_log(panel)
        style.resolution_axis(panel, grid.cells)
        panel.set_title(label)
        if offset:
            panel.axhline(1, color=style.GREY, linewidth=0.8, zorder=0)
            panel.annotate("twice as long", (0.99, 1), xycoords=panel.get_yaxis_transform(), xytext=(0, -3),
                           va="top", ha="right", textcoords="offset points", fontsize=7.5, color=style.GREY)
    for panel in axes[:, 1]:
        style.label_ends(panel)
    return style.save(figure, out, name)


def _factors(grid, out):
    figure, axes = plt.subplots(1, 2, figsize=(9.6, 3.4), layout="constrained", sharey=True)
    parts = [("model", "springs: adaptive instead of crossover", "#0072b2"),
             ("ring", "pins: 1-ring pinned too", "#e69f00")]
    x = np.arange(len(grid.cells))
    for panel, (metric, offset, label) in zip(axes, METRICS[:2]):
        effects = [factors(grid, n, metric, offset) for n in grid.cells]
        for i, (part, name, colour) in enumerate(parts):
            heights = [e[part] for e in effects]
            panel.bar(x + 0.36 * (i - 0.5), heights, 0.34, color=colour, label=name)
            for at, e in zip(x, effects):
                if np.isfinite(e["whole"]):
                    panel.annotate(f"×{style.number(10 ** e[part], 2)}", (at + 0.36 * (i - 0.5), e[part]),
                                   ha="center", va="bottom" if e[part] >= 0 else "top", fontsize=8,
                                   xytext=(0, 1 if e[part] >= 0 else -1), textcoords="offset points")
        panel.plot(x, [e["whole"] for e in effects], "D", color=style.INK, markersize=5,
                   label="both (the paper's comparison)")
        panel.axhline(0, color=style.GREY, linewidth=0.8)
        panel.set_xticks(x, labels=[str(n) for n in grid.cells])
        panel.set_xlabel("resolution N (cells per side)")
        panel.set_title(label)
        panel.margins(y=0.12)
        panel.grid(axis="x", visible=False)
    axes[0].set_ylabel("reduction of stretch − 1\n(decades, log₁₀)")
    style.legend_below(figure, axes[0], 3)
    return style.save(figure, out, "fig_5_factors")


def _rounding(runs, out):
    grids = {rounding: Grid(runs, rounding) for rounding in ("floor", "round")}
    figure, axes = plt.subplots(1, 3, figsize=(9.6, 3.2), layout="constrained")
    columns = [("pin_max_stretch", 1, "stretch − 1 at the pin"), ("mean_strain", 0, "mean strain"),
               ("springs_beyond_ring_1", 0, "springs beyond ring 1")]
    for panel, (metric, offset, label) in zip(axes, columns):
        for (rounding, grid), colour, marker in zip(grids.items(), ("#0072b2", "#b0579b"), "os"):
            style.with_range(panel, grid.cells, grid.over_cells("adaptive", 1, metric, offset),
                             label=f"m by {rounding}", shift=0.97 if rounding == "floor" else 1.03,
                             color=colour, marker=marker)
        style.plain_log(panel)
        style.resolution_axis(panel, grids["floor"].cells)
        panel.set_title(label)
    axes[0].legend()
    return style.save(figure, out, "fig_5_rounding")


def _text(s):
    if not s.known:
        return "–"
    return f"{style.number(s.median)} ({style.number(s.low, 2)} – {style.number(s.high, 2)})"


def _table(grid):
    rows = []
    for model, ring in PAPER + CONTROLS:
        for n in grid.cells:
            runs = grid.runs.get((model, ring, n), [])
            springs = summary_spread(runs, "springs")
            state = statuses(runs)
            rows.append([style.model_name(model), PINS[ring], n, f"{springs.median:,.0f}" if springs.known
                         else "–", *(_text(grid.spread(model, ring, n, metric, offset))
                                     for metric, offset, _ in METRICS),
                         ", ".join(f"{count} {status}" for status, count in state.items()) or "missing"])
    return Table("Median over the last second and over seeds (smallest – largest seed), m by floor",
                 ["model", "pinned", "N", "springs", *(label for _, _, label in METRICS), "runs"], rows)


def _factor_table(grid):
    rows = []
    for metric, offset, label in METRICS[:2]:
        for n in grid.cells:
            e = factors(grid, n, metric, offset)
            share = lambda part: f"{100 * e[part] / e['whole']:.0f} %" if abs(e["whole"]) > 0.05 else "–"
            rows.append([label, n,
                         *("×" + style.number(10 ** e[part])
                           for part in ("whole", "model", "ring", "interaction")), share("model"),
                         share("ring")])
    return Table("Factor by which stretch − 1 is smaller with adaptive springs and the 1-ring pinned than "
                 "with crossover springs and the pin alone. The product of the springs' and the 1-ring's "
                 "factor is the whole factor; shares are of its logarithm. Interaction: the 1-ring's factor "
                 "with crossover springs over that with adaptive springs.",
                 ["", "N", "whole", "springs", "1-ring", "interaction", "springs' share", "1-ring's share"],
                 rows)


def _rounding_table(runs):
    rows = []
    for rounding in ("floor", "round"):
        grid = Grid(runs, rounding)
        for n in grid.cells:
            if ("adaptive", 1, n) in grid.runs:
                cell = lambda metric, offset=0: grid.spread("adaptive", 1, n, metric, offset)
                rows.append([rounding, n, style.number(cell("model_m").median),
                             style.number(cell("model_n").median), f"{cell('springs').median:,.0f}",
                             f"{cell('springs_beyond_ring_1').median:,.0f}",
                             _text(cell("pin_max_stretch", 1)), _text(cell("mean_strain"))])
    return Table("Adaptive springs with the 1-ring pinned: two readings of eq. 6",
                 ["m by", "N", "m", "n", "springs", "beyond ring 1", "stretch − 1 at the pin", "mean strain"],
                 rows)


def _claims(grid):
    return [*_resolution_claims(grid), _cause_claim(grid)]


def _resolution_claims(grid):
    """Figs. 5a and 5b: stretch and drop over resolutions."""
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
                  "resolution rises.", "with the pin alone, every seed's stretch − 1 at the pin at N = "
                  f"{high} is larger than any seed's at N = {low}, the median at N = {high} is above 1 "
                  "(twice as long), and the median never falls when N doubles", medians(crossover),
                  rises if known else None, setting=setting),
            Claim("5b", "Adaptive springs don't degrade with resolution: normal cloth at every resolution.",
                  "with the 1-ring pinned, the median stretch − 1 at the pin stays below 1 at every N, and "
                  f"changes by less than a factor of 2 between N = {low} and {high}", medians(adaptive),
                  stays if known else None, setting=setting),
            Claim("5b", "Adaptive springs are equally stiff at every resolution.",
                  "the median drop of the sheet differs by less than 10 % between resolutions",
                  {f"drop (m), {name}": s.median for name, s in zip(names, drops)}
                  | {"largest over smallest − 1": change}, bool(change < 0.1) if known else None,
                  "A stretched sheet hangs lower too: the drop is only a bound for stiffness, which this "
                  "figure does not measure.", setting=setting)]


def _cause_claim(grid):
    """Fig. 5: whether the springs or the pins improve the sheet."""
    high = grid.cells[-1] if grid.cells else 0
    effect, near = factors(grid, high, *PIN), factors(grid, high, "pin_region_stretch", 1)
    step = lambda a, b: grid.spread(*a, high, *PIN).median / grid.spread(*b, high, *PIN).median
    c0, c1, a0, a1 = ("crossover", 0), ("crossover", 1), ("adaptive", 0), ("adaptive", 1)
    numbers = {"whole reduction (factor)": 10 ** effect["whole"],
               "the springs' part (factor)": 10 ** effect["model"],
               "the 1-ring's part (factor)": 10 ** effect["ring"],
               "the springs' share": effect["model"] / effect["whole"],
               "the springs' share, near the pin (0.1 of size)": near["model"] / near["whole"],
               "adaptive instead of crossover, pin alone (factor)": step(c0, a0),
               "1-ring pinned too, crossover (factor)": step(c0, c1),
               "adaptive instead of crossover, 1-ring pinned (factor)": step(c1, a1),
               "1-ring pinned too, adaptive (factor)": step(a0, a1)}
    holds = all(e["model"] > 2 * e["ring"] for e in (effect, near)) if np.isfinite(effect["whole"]) else None
    return Claim("5", "Our question: is the improvement the work of the adaptive springs?",
                 "the springs, and not the pinned 1-ring, cause more than two thirds of the reduction of "
                 f"stretch − 1 at N = {high} (in logarithms), both at the pin and near it", numbers, holds,
                 setting="one substep of 10 iterations, without damping")


if __name__ == "__main__":
    figure_main(main)
