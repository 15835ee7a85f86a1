"""Fig. 6: one ring of springs (LOD) compared with all rings up to m and n (the full model), by the number of
springs and by the distance of the cloths.

The motion is chaotic, so two runs never agree. Distances are compared with the distance between two runs of
the full model that differ only in the seed of a perturbation of 10⁻⁶ of the size (`yardstick`).
"""
from bendlab.results.load import group, select, summary_spread
from draw import cloth
from figures.paper import medians
from runs.distance import between_runs
from runs.sweeps import complete_runs, load_experiment
from tables.section import Claim, Table

CLAIMED = 0.20  # share of springs that the paper saves
EXPERIMENTS = {64: "paper/fig6_64", 128: "paper/fig6_128_full"}


def main(results, out, section):
    cases = []
    for n, config in EXPERIMENTS.items():
        experiment = load_experiment(results, config)
        if experiment.runs or not config.endswith("_full"):
            groups = group(complete_runs(section, experiment), damping_rate)
            cases += [Case(n, rate, runs) for rate, runs in sorted(groups.items())]
    cases = [case for case in cases if case.lod and case.full]
    if cases:
        section.pictures.append((_pictures(cases, out), "The full model and two LOD models: the default "
                                 "(ring m of free vertices, ring n of pinned vertices), and the ring t with "
                                 "which the saving of springs is nearest to the paper's 20 %."))
    section.add_chart(
        _table(cases), "Number of springs, and distances to the full model, for each t", "t",
        ["fewer", "rms", "hausdorff"], ["case"], id="fig_6_numbers", scale="band", y_scale="linear", look="",
        limits=[("fewer", -100 * CLAIMED, "the paper's −20 %")],
        note="'full, other seed' is the distance between two runs of the full model with different seeds.")
    section.claims += _claims(cases)


def damping_rate(run):
    return sum(effect["rate"] for effect in run.get("/effects", []) if effect["type"] == "rigid_damping")


def damping_text(rate):
    return f"damping {rate:g} s⁻¹" if rate else "no damping"


class Case:
    """The complete runs with one resolution and damping: full, LOD of every t, and distances."""

    def __init__(self, n, rate, runs):
        self.n, self.rate, self.name = n, rate, f"N = {n}, {damping_text(rate)}"
        self.full = select(runs, bending__model="adaptive")
        self.lod = dict(sorted(group(select(runs, bending__model="lod"),
                                     lambda run: run.get("/bending/lod/t")).items()))
        self.fewer = {t: 1 - _median(own_runs, "springs") / _median(self.full, "springs")
                      for t, own_runs in self.lod.items()}
        self.yardstick = between_runs(self.full, self.full)
        self.distance = {t: between_runs(self.full, own_runs) for t, own_runs in self.lod.items()}

    def nearest_to_claim(self):
        """The t > 0 with which the saving of springs is nearest to 20 %, or None."""
        return min((t for t in self.lod if t > 0), key=lambda t: abs(self.fewer[t] - CLAIMED), default=None)


def level_name(t):
    return f"t = {t}" if t else "t = m, n"


def _pictures(cases, out):
    still = {n: own_cases[0] for n, own_cases in group(cases, lambda case: case.n).items()}  # least damping
    pictures = []
    for case in still.values():
        levels = [("full", case.full, 0), *((f"LOD, {level_name(t)}", case.lod.get(t, []), case.fewer.get(t))
                                            for t in (0, case.nearest_to_claim()))]
        for title, runs, fewer in levels:
            change = f" ({-100 * fewer:+.0f} %)" if fewer else ""
            pictures.append((title, runs, f"{_median(runs, 'springs'):,.0f} springs{change}"))
    panels = medians.panels(pictures, "mean_strain")
    rows = {f"N = {n}": panels[3 * i:3 * i + 3] for i, n in enumerate(still)}
    return cloth.sheet(rows, out, "fig_6", inches=2.9)


def _median(runs, name):
    return summary_spread(runs, name).median


def _table(cases):
    levels = [entry for case in cases for entry in (
        (case, "full, other seed", case.full, 0, case.yardstick),
        *((case, level_name(t), runs, case.fewer[t], case.distance[t]) for t, runs in case.lod.items()))]
    rows = [{"case": case.name, "t": t, "fewer": -100 * fewer, "springs": _median(runs, "springs"),
             "pin": _median(runs, "pin_max_stretch") - 1}
            | medians.cells("rms", rms) | medians.cells("hausdorff", hausdorff)
            for case, t, runs, fewer, (rms, hausdorff) in levels]
    distances = [("rms", 0, "RMS distance to the full cloth / size"),
                 ("hausdorff", 0, "Hausdorff distance to the full cloth / size")]
    return Table.of(
        "fig_6", "Distances are divided by the size of the sheet, and are medians over pairs of runs with "
        "different seeds",
        [("case", "cells, damping"), ("t", "ring of springs"), ("springs", "springs", ",.0f"),
         ("fewer", "springs, compared with full", "+.1f", "%"), *medians.columns(distances),
         ("pin", "stretch − 1 at the pin")], rows)


def _claims(cases):
    counted, alike, verdicts = {}, {}, []
    for case in cases:
        t = case.nearest_to_claim()
        if t is None or not case.yardstick[0].known or not case.distance[t][0].known:
            continue
        counted[f"N = {case.n}, nearest to 20 % fewer"] = f"t = {t}: {-100 * case.fewer[t]:+.1f} %"
        same, pin = case.yardstick[0].median, _median(case.full, "pin_max_stretch") - 1
        alike[f"{case.name}, two seeds of the full model: RMS / size, stretch − 1 at the pin"] = [same, pin]
        for level in [level for level in (0, t) if level in case.lod]:
            numbers = [case.distance[level][0].median, _median(case.lod[level], "pin_max_stretch") - 1]
            alike[f"{case.name}, full and LOD {level_name(level)}"] = numbers
            verdicts.append(numbers[0] <= 1.25 * same and numbers[1] <= 2 * pin)
    nearest = [case.fewer[case.nearest_to_claim()] for case in cases if case.nearest_to_claim()]
    saved_enough = any(abs(fewer - CLAIMED) <= 0.05 for fewer in nearest)
    every_n = {case.n for case in cases} == set(EXPERIMENTS)  # another N could have such a ring t
    return [Claim("6", "LOD needs 20 % fewer springs.", "at some N, a ring t in [m, n] has 15 to 25 % fewer "
                  "springs than the full model (the paper does not state N and t)", counted,
                  True if saved_enough else False if every_n else None),
            Claim("6", "LOD looks almost the same as the full model.", "at the default t and at the t "
                  "nearest to 20 % fewer, the RMS distance to the full cloth is at most 1.25 times the "
                  "distance between two seeds of the full model, and stretch − 1 at the pin is at most twice "
                  "that of the full model", alike, all(verdicts) if verdicts else None,
                  setting="one substep of 10 iterations, while the sheets swing")]
