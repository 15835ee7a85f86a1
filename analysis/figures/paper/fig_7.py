"""Fig. 7: pinned vertices with springs to more rings (n times 1, 2 and 4), to control the material."""
from draw import cloth
from runs.distance import between_runs
from figures.paper.fig_6 import damping_rate
from bendlab.results.load import group, summary_spread, typical_run
from figures.paper import medians
from tables.chart import Chart
from tables.section import Claim
from tables.table import Table
from runs.sweeps import load_experiment

MULTIPLIERS = [1, 2, 4]
METRICS = [("drop", 0, "drop below the pin (m)"), ("mean_strain", 0, "mean strain"),
           ("pin_max_stretch", 1, "stretch − 1 at the pin"),
           ("max_stretch", 1, "largest stretch − 1 anywhere")]


def main(results, out, section):
    runs = section.uses(load_experiment(results, "paper/fig7"))
    cases = group(runs, lambda run: (damping_rate(run), run.get("/bending/adaptive/n_multiplier")))
    rates = sorted({rate for rate, _ in cases})
    if runs:
        section.pictures.append((_pictures(cases, rates, out),
                                 "n × 1, 2 and 4. Each picture shows the last frame of the seed nearest to "
                                 "the median. All pictures have one scale."))
    rows = [{"damping": f"damping {rate:g} s⁻¹" if rate else "no damping", "k": k}
            | medians.row(own_runs, [*METRICS, ("model_n", 0, ""), ("springs", 0, "")])
            for (rate, k), own_runs in sorted(cases.items())]
    section.tables.append(Table.of("fig_7", "Median over the last second and over seeds", [
        "damping", ("k", "multiplier of n"), ("model_n", "n", ".0f"), ("springs", "springs", ",.0f"),
        *medians.columns(METRICS)], rows))
    section.charts.append(Chart(
        "fig_7_numbers", "If the pins have springs to 1, 2 or 4 times as many rings n", "fig_7", "k",
        [name for name, *_ in METRICS],
        ["damping"], scale="log2", y_scale="linear", look="",
        note="Medians over the last second and over seeds. Bars go from the smallest to the largest seed."))
    section.claims += _claims(cases, rates)


def _pictures(cases, rates, out):
    samples = {key: typical_run(own_runs) for key, own_runs in cases.items()}
    cameras = dict(zip(samples, cloth.cameras_of(list(samples.values()))))
    rows = {f"damping {rate:g} s⁻¹" if rate else "no damping": [
        cloth.Panel(samples.get((rate, k)), cameras.get((rate, k)), f"n × {k}",
                    f"n = {summary_spread(cases.get((rate, k), []), 'model_n').median:g}")
        for k in MULTIPLIERS] for rate in rates}
    return cloth.sheet(rows, out, "fig_7", inches=2.9)


def _claims(cases, rates):
    whole = [rate for rate in rates if all(summary_spread(cases.get((rate, k), []), "drop").known
                                           for k in MULTIPLIERS)]
    shapes, stretches, changed, normal = {}, {}, [], []
    for rate in whole:
        same = max(between_runs(cases[rate, k], cases[rate, k])[0].median for k in MULTIPLIERS)
        shapes[f"two seeds of the same n, damping {rate:g}: RMS / size"] = same
        for a, b in ((1, 2), (2, 4), (1, 4)):
            apart = between_runs(cases[rate, a], cases[rate, b])[0].median
            shapes[f"n × {a} and × {b}, damping {rate:g}: RMS / size"] = apart
            changed.append(apart > 2 * same)
        pin, most = ([summary_spread(cases[rate, k], metric) - 1 for k in MULTIPLIERS]
                     for metric in ("pin_max_stretch", "max_stretch"))
        for k, p, m in zip(MULTIPLIERS, pin, most):
            stretches[f"n × {k}, damping {rate:g}: at the pin, anywhere"] = [p.median, m.median]
        normal.append(all(s.median < 1 for s in pin + most) and max(s.median for s in pin[1:]) <= 1.25
                      * pin[0].median)
    return [Claim("7", "Scaling n changes the material.", "with and without damping, the cloths of n × 1, × "
                  "2 and × 4 are more than twice as far apart (RMS) as two cloths with one n and two seeds",
                  shapes, all(changed) if changed else None,
                  setting="one substep of 10 iterations, while the sheets swing"),
            Claim("7", "Scaling n does not cause abnormal deformation.", "with and without damping, the "
                  "median stretch − 1 is below 1 everywhere with n × 1, × 2 and × 4, and stretch − 1 at the "
                  "pin with × 2 and × 4 is at most 1.25 times that with × 1", stretches,
                  all(normal) if normal else None,
                  setting="one substep of 10 iterations")]
