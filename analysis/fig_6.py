"""Fig. 6: one ring of springs (LOD) and all rings up to m and n (full): number of springs, and difference of
the cloths.

The sheets are chaotic, so no two cloths are alike. The yardstick is the distance between two runs of the same
full model that differ only in the seed of a perturbation of 10⁻⁶ of the size.
"""
import right_python  # noqa: F401  (first: it may hand over to another Python)
import matplotlib.pyplot as plt

import style
from distance import between_runs
from bendlab.results.load import group, select, summary_spread, typical_run
from report import Claim, Section, Table, figure_main
from sweeps import load_experiment

CLAIMED = 0.20  # share of springs that the paper saves
EXPERIMENTS = {64: "paper/fig6_64", 128: "paper/fig6_128_full"}
COLOURS = {64: "#d55e00", 128: "#0072b2"}


def main(results, out):
    """Draws full and LOD cloths, and numbers of springs and distances over t."""
    section = Section("All rings against one ring (LOD)", "6")
    cases = {}
    for n, config in EXPERIMENTS.items():
        experiment = load_experiment(results, config)
        if config.endswith("_full") and not experiment.runs:
            continue
        runs = section.uses(experiment)
        for rate, some in sorted(group(runs, damping_rate).items()):
            case = Case(n, rate, some)
            if case.levels and case.full:
                cases[n, rate] = case
    if cases:
        section.pictures.append((_pictures(cases, out), "The full structure and two levels of LOD: the "
                                 "default (ring m of free vertices, ring n of pinned ones), and the t whose "
                                 "number of springs is nearest to the paper's 20 % fewer."))
        section.pictures.append((_numbers(cases, out), "Springs over t, and distances to the full cloth. "
                                 "Grey (full): distance between two runs of the full model that differ only "
                                 "in their seed."))
    section.tables.append(_table(cases))
    section.claims += _claims(cases)
    return section


def damping_rate(run):
    return next((effect["rate"] for effect in run.get("/effects", []) if effect["type"] == "rigid_damping"),
                0)


class Case:
    """One resolution and damping: the full runs, the LOD runs of every t, and their distances."""

    def __init__(self, n, rate, runs):
        self.n, self.rate = n, rate
        runs = [run for run in runs if run.complete]
        self.full = select(runs, bending__model="adaptive")
        self.lod = dict(sorted(group(select(runs, bending__model="lod"),
                                     lambda run: run.get("/bending/lod/t")).items()))
        self.levels = list(self.lod)
        self.fewer = {t: 1 - summary_spread(some, "springs").median
                      / summary_spread(self.full, "springs").median for t, some in self.lod.items()
                      if self.full}
        self.yardstick = between_runs(self.full, self.full)
        self.distance = {t: between_runs(self.full, some) for t, some in self.lod.items()}

    def nearest_to_claim(self):
        """The t > 0 whose number of springs is nearest to 20 % below the full model's, or None."""
        single = [t for t in self.levels if t > 0]
        return min(single, key=lambda t: abs(self.fewer[t] - CLAIMED)) if single else None

    @property
    def name(self):
        return f"N = {self.n}, " + (f"damping {self.rate:g} s⁻¹" if self.rate else "no damping")


def level_name(t):
    return f"t = {t}" if t else "t = m, n"


def _pictures(cases, out):
    rows = [cases[key] for key in sorted(cases) if key[1] == min(rate for n, rate in cases if n == key[0])]
    samples = []
    for case in rows:
        t = case.nearest_to_claim()
        samples.append([(f"full, N = {case.n}", case.full, 0.0),
                        (f"LOD, {level_name(0)}", case.lod.get(0, []), case.fewer.get(0)),
                        (f"LOD, {level_name(t)}", case.lod.get(t, []), case.fewer.get(t))])
    frames = [[typical_run(some, "mean_strain") if some else None for _, some, _ in row] for row in samples]
    cameras = iter(style.cameras_of([frame for row in frames for frame in row]))
    figure, axes = plt.subplots(len(rows), 3, figsize=(8.6, 3.5 * len(rows)), squeeze=False,
                                layout="compressed")
    for row in range(len(rows)):
        for panel, (title, some, fewer), frame in zip(axes[row], samples[row], frames[row]):
            style.draw_cloth(panel, frame, next(cameras))
            if some:
                change = f" ({-100 * fewer:+.0f} %)" if fewer else ""
                style.caption(panel, f"{summary_spread(some, 'springs').median:,.0f} springs{change}")
            panel.set_title(title)
    style.stretch_bar(figure, axes, shrink=0.75, pad=0.01)
    return style.save(figure, out, "fig_6")


def _numbers(cases, out):
    figure, axes = plt.subplots(1, 3, figsize=(11.4, 3.9), layout="constrained")
    for (n, rate), case in sorted(cases.items()):
        x = [t if t else 1 for t in case.levels]
        look = dict(color=COLOURS[n], marker="o" if rate == 0 else "s", linestyle="none",
                    markerfacecolor=COLOURS[n] if rate == 0 else "white")
        single = [i for i, t in enumerate(case.levels) if t]
        if rate == min(r for m, r in cases if m == n):
            axes[0].plot([x[i] for i in single], [-100 * case.fewer[case.levels[i]] for i in single],
                         color=COLOURS[n])
            axes[0].plot(x, [-100 * case.fewer[t] for t in case.levels], "o", color=COLOURS[n],
                         label=f"N = {n}")
        for panel, index in ((axes[1], 0), (axes[2], 1)):
            shift = (0.06 if n == 128 else -0.06) + (0.12 if rate else -0.12)
            style.with_range(panel, [at + shift for at in x], [case.distance[t][index] for t in case.levels],
                             label=case.name, **look)
            same = case.yardstick[index]
            grey = {"color": style.GREY, "markerfacecolor": "white" if rate else style.GREY}
            style.with_range(panel, [shift], [same], **(look | grey))
    axes[0].axhline(-100 * CLAIMED, color=style.GREY, linewidth=1, linestyle="--")
    axes[0].annotate("the paper's −20 %", (0.72, -100 * CLAIMED), xycoords=axes[0].get_yaxis_transform(),
                     ha="right", xytext=(0, 3), textcoords="offset points", fontsize=8, color=style.GREY)
    axes[0].set_title("springs, difference to the full structure (%)")
    axes[1].set_title("RMS distance to the full cloth / size")
    axes[2].set_title("Hausdorff distance to the full cloth / size")
    levels = sorted({t for case in cases.values() for t in case.levels if t})
    for panel in axes:
        shown = ([] if panel is axes[0] else [0]) + [1, *levels]
        names = {0: "full", 1: "m, n"}
        panel.set_xticks(shown, labels=[names.get(t, str(t)) for t in shown])
        panel.set_xlabel("level t of the LOD springs")
    for panel in axes[1:]:
        panel.set_ylim(bottom=0)
    axes[0].legend()
    style.legend_below(figure, axes[1], 4)
    return style.save(figure, out, "fig_6_numbers")


def _table(cases):
    rows = []
    for (n, rate), case in sorted(cases.items()):
        full = summary_spread(case.full, "springs").median
        rows.append([n, f"{rate:g}", "full, other seed", f"{full:,.0f}", "0 %", *map(_share, case.yardstick),
                     style.number(summary_spread(case.full, "pin_max_stretch").median - 1)])
        for t, some in case.lod.items():
            rows.append([n, f"{rate:g}", level_name(t), f"{summary_spread(some, 'springs').median:,.0f}",
                         f"{-100 * case.fewer[t]:+.1f} %", *map(_share, case.distance[t]),
                         style.number(summary_spread(some, "pin_max_stretch").median - 1)])
    return Table("Distances relative to the sheet's size, median over pairs of runs with different seeds "
                 "(smallest – largest)", ["N", "damping (1/s)", "springs of", "springs", "difference to full",
                                          "RMS distance", "Hausdorff distance", "stretch − 1 at the pin"],
                 rows)


def _share(s):
    return f"{100 * s.median:.1f} % ({100 * s.low:.1f} – {100 * s.high:.1f})" if s.known else "–"


def _claims(cases):
    counted, alike, verdicts = {}, {}, []
    for case in (cases[key] for key in sorted(cases)):
        t = case.nearest_to_claim()
        if t is None or not case.yardstick[0].known or not case.distance[t][0].known:
            continue
        counted[f"N = {case.n}, nearest to 20 % fewer"] = f"t = {t}: {-100 * case.fewer[t]:+.1f} %"
        pin = summary_spread(case.full, "pin_max_stretch").median - 1
        alike[f"{case.name}, two seeds of the full model: RMS / size, stretch − 1 at the pin"] = [
            case.yardstick[0].median, pin]
        for level in dict.fromkeys((0, t)):
            if level in case.lod:
                distance = case.distance[level][0].median
                pin_of_lod = summary_spread(case.lod[level], "pin_max_stretch").median - 1
                alike[f"{case.name}, full and LOD {level_name(level)}"] = [distance, pin_of_lod]
                verdicts.append(distance <= 1.25 * case.yardstick[0].median and pin_of_lod <= 2 * pin)
    nearest = [case.fewer[case.nearest_to_claim()] for case in cases.values() if case.nearest_to_claim()]
    found = any(abs(fewer - CLAIMED) <= 0.05 for fewer in nearest)
    every_n = {case.n for case in cases.values()} == set(EXPERIMENTS)  # another N could have such a level
    return [Claim("6", "LOD needs 20 % fewer springs.", "at some N, some level t in [m, n] has 15 to 25 % "
                  "fewer springs than the full structure (the paper states neither N nor t)", counted,
                  True if found else False if every_n else None),
            Claim("6", "LOD looks almost the same as the full structure.", "at the default t and at the t "
                  "nearest to 20 % fewer, the RMS distance to the full cloth is at most 1.25 times that "
                  "between two seeds of the full model, and stretch − 1 at the pin is at most twice the full "
                  "model's", alike, all(verdicts) if verdicts else None,
                  setting="one substep of 10 iterations, as the sheets swing")]


if __name__ == "__main__":
    figure_main(main)
