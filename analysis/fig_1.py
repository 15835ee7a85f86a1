"""Fig. 1: strain constraints with one pinned vertex stretch in a wrong direction at the pin."""
import matplotlib.pyplot as plt

import style
from load import load_experiment, select, summary_spread, typical_frame
from report import Claim, Section, Table, figure_main

MODELS = ["none", "crossover"]
CELLS = [32, 64]


def main(results, out):
    """Draws the sheet pinned at one vertex, whole and at the pin."""
    section = Section("One pinned vertex", "1")
    runs = section.uses(load_experiment(results, "paper/fig1"))
    groups = {(model, n): select(runs, bending__model=model, mesh__cells=n) for model in MODELS for n in CELLS}
    if runs:
        section.pictures.append((_pictures(groups, out), "The typical frame of the last second, whole and at the pin "
                                 "(black dot; colour: stretch)."))
    pin = {key: summary_spread(group, "pin_max_stretch") - 1 for key, group in groups.items()}
    everywhere = {key: summary_spread(group, "max_stretch") - 1 for key, group in groups.items()}
    mean = {key: summary_spread(group, "mean_strain") for key, group in groups.items()}
    section.tables.append(Table(
        "Medians over the last second and over seeds",
        ["model", "N", "stretch − 1 at the pin", "largest anywhere", "mean strain", "pin / mean"],
        [[style.MODEL_NAMES[model], n, *(style.number(s[model, n].median) for s in (pin, everywhere, mean)),
          style.number(pin[model, n].median / mean[model, n].median) if mean[model, n].known else "–"]
         for model, n in groups]))
    known = all(pin["none", n].known for n in CELLS)
    section.claims.append(Claim(
        "1", "With strain constraints and one pinned corner, the strain at the pin is wrong.",
        "without bending springs and at every N, the median stretch − 1 at the pin is above 1 (a triangle more than twice "
        "as long as it should be) and at least 5 times the mean strain",
        {f"stretch − 1 at the pin, N = {n}": pin["none", n].median for n in CELLS}
        | {f"mean strain, N = {n}": mean["none", n].median for n in CELLS},
        all(pin["none", n].median > max(1, 5 * mean["none", n].median) for n in CELLS) if known else None))
    return section


def _pictures(groups, out):
    samples = {key: typical_frame(group) for key, group in groups.items()}
    camera = style.camera_of(samples.values())
    close = style.camera_of(samples.values(), zoom=0.11, aspect=camera.aspect)
    figure, axes = plt.subplots(len(MODELS), 2 * len(CELLS), figsize=(10.4, 6.6), layout="compressed")
    for row, model in enumerate(MODELS):
        for column, n in enumerate(CELLS):
            whole, pin = axes[row, 2 * column], axes[row, 2 * column + 1]
            sample = samples[model, n]
            excess = style.number(sample[0].metrics["pin_max_stretch"][sample[1]] - 1) if sample else ""
            style.draw_cloth(whole, sample, camera)
            style.draw_cloth(pin, sample, close, caption=f"at the pin: σ₁ − 1 = {excess}" if sample else None, whole=False)
            whole.set_title(f"{style.MODEL_NAMES[model]}, N = {n}")
            pin.set_title("at the pin")
    style.stretch_bar(figure, axes, shrink=0.7, pad=0.01)
    return style.save(figure, out, "fig_1")


if __name__ == "__main__":
    figure_main(main)
