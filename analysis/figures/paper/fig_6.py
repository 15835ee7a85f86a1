"""Fig. 6: one ring of springs (LOD) compared with all rings up to m and n (the full model), by the number of
springs and by the distance of the cloths.

The motion is chaotic, so two runs never agree. Distances are compared with the distance between two runs of
the full model that differ only in the seed of a perturbation of 10⁻⁶ of the size (`yardstick`).
"""
from draw import cloth
from runs.distance import between_runs
from bendlab.results.load import group, select, summary_spread, typical_run
from figures.paper import medians
from tables.chart import Chart
from tables.section import Claim
from tables.table import Table
from runs.sweeps import load_experiment

CLAIMED = 0.20  # share of springs that the paper saves
EXPERIMENTS = {64: "paper/fig6_64", 128: "paper/fig6_128_full"}


def main(results, out, section):
    cases = {}
    for n, config in EXPERIMENTS.items():
        experiment = load_experiment(results, config)
        if config.endswith("_full") and not experiment.runs:
            continue
        runs = section.uses(experiment)
        for rate, own_runs in sorted(group(runs, damping_rate).items()):
            case = Case(n, rate, own_runs)
            if case.levels and case.full:
                cases[n, rate] = case
    if cases:
        section.pictures.append((_pictures(cases, out), "The full model and two LOD models: the default "
                                 "(ring m of free vertices, ring n of pinned vertices), and the ring t with "
                                 "which the saving of springs is nearest to the paper's 20 %."))
    section.tables.append(_table(cases))
    section.charts.append(Chart(
        "fig_6_numbers", "Number of springs, and distances to the full model, for each t", "fig_6", "t",
        ["fewer", "rms", "hausdorff"], ["case"], scale="band", y_scale="linear", look="",
        limits=[("fewer", -100 * CLAIMED, "the paper's −20 %")],
        note="'full, other seed' is the distance between two runs of the full model with different seeds."))
    section.claims += _claims(cases)


def damping_rate(run):
    return next((effect["rate"] for effect in run.get("/effects", []) if effect["type"] == "rigid_damping"),
                0)


class Case:
    """The runs with one resolution and damping: full runs, LOD runs of every t, and distances."""

    def __init__(self, n, rate, runs):
        self.n, self.rate = n, rate
        runs = [run for run in runs if run.complete]
        self.full = select(runs, bending__model="adaptive")
        self.lod = dict(sorted(group(select(runs, bending__model="lod"),
                                     lambda run: run.get("/bending/lod/t")).items()))
        self.levels = list(self.lod)
        self.fewer = {t: 1 - summary_spread(own_runs, "springs").median
                      / summary_spread(self.full, "springs").median for t, own_runs in self.lod.items()
                      if self.full}
        self.yardstick = between_runs(self.full, self.full)
        self.distance = {t: between_runs(self.full, own_runs) for t, own_runs in self.lod.items()}

    def nearest_to_claim(self):
        """The t > 0 with which the saving of springs is nearest to 20 %, or None."""
        single = [t for t in self.levels if t > 0]
        return min(single, key=lambda t: abs(self.fewer[t] - CLAIMED)) if single else None

    @property
    def name(self):
        return f"N = {self.n}, " + (f"damping {self.rate:g} s⁻¹" if self.rate else "no damping")


def level_name(t):
    return f"t = {t}" if t else "t = m, n"


def _pictures(cases, out):
    still = [cases[key] for key in sorted(cases) if key[1] == min(rate for n, rate in cases if n == key[0])]
    rows = {f"N = {case.n}": [("full", case.full, 0.0)] + [
        (f"LOD, {level_name(t)}", case.lod.get(t, []), case.fewer.get(t))
        for t in (0, case.nearest_to_claim())] for case in still}
    frames = {label: [typical_run(own_runs, "mean_strain") if own_runs else None for _, own_runs, _ in row]
              for label, row in rows.items()}
    cameras = iter(cloth.cameras_of(sum(frames.values(), [])))
    return cloth.sheet({label: [
        cloth.Panel(frame, next(cameras), title, _springs_text(own_runs, fewer))
        for frame, (title, own_runs, fewer) in zip(frames[label], row)] for label, row in rows.items()},
        out, "fig_6", inches=2.9)


def _springs_text(runs, fewer):
    if not runs:
        return ""
    change = f" ({-100 * fewer:+.0f} %)" if fewer else ""
    return f"{summary_spread(runs, 'springs').median:,.0f} springs{change}"


def _table(cases):
    rows = []
    for _, case in sorted(cases.items()):
        levels = {"full, other seed": (case.full, 0, case.yardstick)} | {
            level_name(t): (own_runs, case.fewer[t], case.distance[t]) for t, own_runs in case.lod.items()}
        for t, (own_runs, fewer, (rms, hausdorff)) in levels.items():
            rows.append({"case": case.name, "t": t, "fewer": -100 * fewer,
                         "springs": summary_spread(own_runs, "springs").median,
                         "pin": summary_spread(own_runs, "pin_max_stretch").median - 1}
                        | medians.cells("rms", rms) | medians.cells("hausdorff", hausdorff))
    return Table.of("fig_6", "Distances are divided by the size of the sheet, and are medians over pairs of "
                             "runs with different seeds", [
        ("case", "cells, damping"), ("t", "ring of springs"), ("springs", "springs", ",.0f"),
        ("fewer", "springs, compared with full", "+.1f", "%"),
        *medians.columns([("rms", 0, "RMS distance to the full cloth / size"),
                          ("hausdorff", 0, "Hausdorff distance to the full cloth / size")]),
        ("pin", "stretch − 1 at the pin")], rows)


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
    saved_enough = any(abs(fewer - CLAIMED) <= 0.05 for fewer in nearest)
    every_n = {case.n for case in cases.values()} == set(EXPERIMENTS)  # another N could have such a ring t
    return [Claim("6", "LOD needs 20 % fewer springs.", "at some N, a ring t in [m, n] has 15 to 25 % "
                  "fewer springs than the full model (the paper does not state N and t)", counted,
                  True if saved_enough else False if every_n else None),
            Claim("6", "LOD looks almost the same as the full model.", "at the default t and at the t "
                  "nearest to 20 % fewer, the RMS distance to the full cloth is at most 1.25 times the "
                  "distance between two seeds of the full model, and stretch − 1 at the pin is at most twice "
                  "that of the full model", alike, all(verdicts) if verdicts else None,
                  setting="one substep of 10 iterations, while the sheets swing")]
