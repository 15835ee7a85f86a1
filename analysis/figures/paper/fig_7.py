"""Fig. 7: pinned vertices with springs to more rings (n times 1, 2 and 4), to control the material."""
from bendlab.results.load import group, summary_spread
from draw import cloth
from figures.paper import medians
from figures.paper.fig_6 import damping_rate, damping_text
from runs.distance import between_runs
from runs.sweeps import used_runs
from tables.section import Claim

MULTIPLIERS = [1, 2, 4]
METRICS = [("drop", 0, "drop below the pin (m)"), ("mean_strain", 0, "mean strain"),
           ("pin_max_stretch", 1, "stretch − 1 at the pin"),
           ("max_stretch", 1, "largest stretch − 1 anywhere")]


def main(results, out, section):
    runs = used_runs(section, results, "paper/fig7")
    cases = group(runs, lambda run: (damping_rate(run), run.get("/bending/adaptive/n_multiplier")))
    rates = sorted({rate for rate, _ in cases})
    if runs:
        section.pictures.append((_pictures(cases, rates, out), "n × 1, 2 and 4. Each picture shows the last "
                                 "frame of the seed nearest to the median. All pictures have one scale."))
    rows = [{"damping": damping_text(rate), "k": k}
            | medians.row(own_runs, [*METRICS, ("model_n", 0, ""), ("springs", 0, "")])
            for (rate, k), own_runs in sorted(cases.items())]
    section.add_table("fig_7", "Median over the last second and over seeds", [
        "damping", ("k", "multiplier of n"), ("model_n", "n", ".0f"), ("springs", "springs", ",.0f"),
        *medians.columns(METRICS), ("status", "runs")], rows)
    section.add_chart(
        "fig_7", "If the pins have springs to 1, 2 or 4 times as many rings n", "k", medians.names(METRICS),
        ["damping"], id="fig_7_numbers", scale="log2", y_scale="linear", look="",
        note="Medians over the last second and over seeds. Bars go from the smallest to the largest seed.")
    section.claims += _claims(cases, rates)


def _pictures(cases, rates, out):
    groups = {(rate, k): cases.get((rate, k), []) for rate in rates for k in MULTIPLIERS}
    panels = medians.panels([(f"n × {k}", runs, f"n = {summary_spread(runs, 'model_n').median:g}")
                             for (_, k), runs in groups.items()])
    rows = {damping_text(rate): panels[3 * i:3 * i + 3] for i, rate in enumerate(rates)}
    return cloth.sheet(rows, out, "fig_7", inches=2.9)


def _claims(cases, rates):
    shapes, stretches, changed, normal = {}, {}, [], []
    for rate in rates:
        of_k = {k: cases.get((rate, k), []) for k in MULTIPLIERS}
        if not all(summary_spread(runs, "drop").known for runs in of_k.values()):
            continue
        same = max(between_runs(runs, runs)[0].median for runs in of_k.values())
        shapes[f"two seeds of the same n, damping {rate:g}: RMS / size"] = same
        for a, b in ((1, 2), (2, 4), (1, 4)):
            apart = between_runs(of_k[a], of_k[b])[0].median
            shapes[f"n × {a} and × {b}, damping {rate:g}: RMS / size"] = apart
            changed.append(apart > 2 * same)
        pin, most = ([summary_spread(runs, metric).median - 1 for runs in of_k.values()]
                     for metric in ("pin_max_stretch", "max_stretch"))
        for k, *both in zip(MULTIPLIERS, pin, most):
            stretches[f"n × {k}, damping {rate:g}: at the pin, anywhere"] = both
        normal.append(all(stretch < 1 for stretch in pin + most) and max(pin[1:]) <= 1.25 * pin[0])
    return [Claim("7", "Scaling n changes the material.", "with and without damping, the cloths of n × 1, × "
                  "2 and × 4 are more than twice as far apart (RMS) as two cloths with one n and two seeds",
                  shapes, all(changed) if changed else None,
                  setting="one substep of 10 iterations, while the sheets swing"),
            Claim("7", "Scaling n does not cause abnormal deformation.", "with and without damping, the "
                  "median stretch − 1 is below 1 everywhere with n × 1, × 2 and × 4, and stretch − 1 at the "
                  "pin with × 2 and × 4 is at most 1.25 times that with × 1", stretches,
                  all(normal) if normal else None, setting="one substep of 10 iterations")]
