"""Fig. 7: the level n of pinned vertices times 1, 2 and 4, as a control of the material."""
import right_python  # noqa: F401  (first: it may hand over to another Python)
import matplotlib.pyplot as plt

import style
from distance import between_runs
from fig_6 import damping_rate
from bendlab.results.load import group, summary_spread, typical_run
from report import Claim, Section, Table, figure_main
from sweeps import load_experiment

MULTIPLIERS = [1, 2, 4]
METRICS = [("drop", 0, "drop below the pin (m)"), ("mean_strain", 0, "mean strain"),
           ("pin_max_stretch", 1, "stretch − 1 at the pin"),
           ("max_stretch", 1, "largest stretch − 1 anywhere")]


def main(results, out):
    """Draws the sheets with n × 1, 2 and 4 and their numbers."""
    section = Section("Another material by scaling n", "7")
    runs = section.uses(load_experiment(results, "paper/fig7"))
    cases = group(runs, lambda run: (damping_rate(run), run.get("/bending/adaptive/n_multiplier")))
    rates = sorted({rate for rate, _ in cases})
    if runs:
        section.pictures.append((_pictures(cases, rates, out),
                                 "n × 1, 2 and 4; the last frame of the seed nearest to the median, at one "
                                 "scale."))
        section.pictures.append((_numbers(cases, rates, out), "Medians over the last second and over seeds; "
                                 "bars: smallest and largest seed."))
    rows = [[f"{rate:g}", f"× {k:g}", style.number(summary_spread(some, "model_n").median),
             f"{summary_spread(some, 'springs').median:,.0f}",
             *(_text(summary_spread(some, metric) - offset) for metric, offset, _ in METRICS)]
            for (rate, k), some in sorted(cases.items())]
    section.tables.append(Table("Median over the last second and over seeds (smallest – largest seed)",
                                ["damping (1/s)", "n", "level n", "springs",
                                 *(label for *_, label in METRICS)], rows))
    section.claims += _claims(cases, rates)
    return section


def _pictures(cases, rates, out):
    samples = {key: typical_run(some) for key, some in cases.items()}
    cameras = dict(zip(samples, style.cameras_of(list(samples.values()))))
    figure, axes = plt.subplots(len(rates), 3, figsize=(8.6, 3.5 * len(rates)), squeeze=False,
                                layout="compressed")
    for row, rate in enumerate(rates):
        for panel, k in zip(axes[row], MULTIPLIERS):
            some = cases.get((rate, k), [])
            text = f"n = {summary_spread(some, 'model_n').median:g}" if some else None
            style.draw_cloth(panel, samples.get((rate, k)), cameras.get((rate, k)), text=text)
            panel.set_title(f"n × {k}, " + (f"damping {rate:g} s⁻¹" if rate else "no damping"))
    style.stretch_bar(figure, axes, shrink=0.75, pad=0.01)
    return style.save(figure, out, "fig_7")


def _numbers(cases, rates, out):
    figure, axes = plt.subplots(1, len(METRICS), figsize=(11.4, 3.2), layout="constrained")
    for panel, (metric, offset, label) in zip(axes, METRICS):
        for rate, colour in zip(rates, style.SEQUENCE):
            spreads = [summary_spread(cases.get((rate, k), []), metric) - offset for k in MULTIPLIERS]
            style.with_range(panel, MULTIPLIERS, spreads, label=f"damping {rate:g} s⁻¹" if rate
                             else "no damping", shift=1.03 if rate else 0.97, color=colour,
                             marker="s" if rate else "o")
        panel.set_xscale("log", base=2)
        panel.set_xticks(MULTIPLIERS, labels=[f"×{k}" for k in MULTIPLIERS])
        panel.minorticks_off()
        panel.set_xlabel("multiplier of n")
        panel.set_title(label)
        panel.set_ylim(bottom=0)
    axes[0].legend(loc="lower left")
    return style.save(figure, out, "fig_7_numbers")


def _text(s):
    return f"{style.number(s.median)} ({style.number(s.low)} – {style.number(s.high)})" if s.known else "–"


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
                  "2 and × 4 are more than twice as far apart (RMS) as two seeds of the same n", shapes,
                  all(changed) if changed else None,
                  setting="one substep of 10 iterations, as the sheets swing"),
            Claim("7", "It does so without abnormal deformation.", "with and without damping, every "
                  "multiplier has a median stretch − 1 below 1 everywhere, and stretch − 1 at the pin of × 2 "
                  "and × 4 is at most 1.25 times that of × 1", stretches, all(normal) if normal else None,
                  setting="one substep of 10 iterations")]


if __name__ == "__main__":
    figure_main(main)
