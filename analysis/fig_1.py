"""Fig. 1: with strain constraints and one pinned vertex, triangles at the pin get the wrong stretch."""
import right_python  # noqa: F401  (first: it may hand over to another Python)
import matplotlib.pyplot as plt
import numpy as np

import style
from bendlab.results.load import select, spread, summary_spread
from report import Claim, Section, Table, figure_main
from sweeps import load_experiment

MODELS = ["none", "crossover"]
CELLS = [32, 64]
WRONG = 1.0  # stretch - 1; above it a triangle is wrong: more than twice its length at rest


def main(results, out):
    """Draws the sheet and its pin at the first failure of the pin, and the course over time."""
    section = Section("One pinned vertex", "1")
    runs = section.uses(load_experiment(results, "paper/fig1"))
    groups = {(model, n): select(runs, bending__model=model, mesh__cells=n) for model in MODELS
              for n in CELLS}
    if runs:
        section.pictures.append((_pictures(groups, out), "The first frame by which each sheet has had a "
                                 "triangle at the pin (dot) that is more than twice its length at rest: the "
                                 "whole sheet, and the pin."))
        section.pictures.append((_curves(groups, out), "The same runs over time: median and range over "
                                 "seeds. Without bending springs the failure spreads from the pin over the "
                                 "whole sheet."))
    pin = {key: summary_spread(group, "pin_max_stretch") - 1 for key, group in groups.items()}
    anywhere = {key: summary_spread(group, "max_stretch") - 1 for key, group in groups.items()}
    mean = {key: summary_spread(group, "mean_strain") for key, group in groups.items()}
    onset = {key: spread([run.metrics["time"][_onset(run)] for run in group])
             for key, group in groups.items()}
    section.tables.append(Table("Time of the first failure (median over seeds); other columns: medians over "
                                "the last second and over seeds",
                                ["model", "N", "pin fails at (s)", "stretch − 1 at the pin",
                                 "largest anywhere", "mean strain"],
                                [[style.model_name(model), n,
                                  *(style.number(s[model, n].median) for s in (onset, pin, anywhere, mean))]
                                 for model, n in groups]))
    section.claims.append(Claim("1", "With strain constraints and one pinned corner, the strain at the pin "
                                "is wrong.", "without bending springs and with crossover springs, at every "
                                "N, the median stretch − 1 at the pin over the last second is above 1: a "
                                "triangle is more than twice its length at rest",
                                {f"stretch − 1 at the pin, {style.model_name(model)}, N = {n}": pin[
                                model, n].median for model, n in groups}
                                | {f"mean strain, {style.model_name(model)}, N = {n}": mean[model, n].median
                                   for model, n in groups}, all(s.median > WRONG for s in pin.values())
                                if all(s.known for s in pin.values()) else None,
                                setting="one substep of 10 iterations, without damping"))
    return section


def _onset(run):
    """Number of the first frame with wrong stretch at the pin; of the last frame if there is none."""
    wrong = np.flatnonzero(run.metrics["pin_max_stretch"] - 1 > WRONG)
    return int(wrong[0]) if len(wrong) else run.frames - 1


def _pictures(groups, out):
    onset = max(_onset(group[0]) for group in groups.values() if group)  # all panels show the same time
    samples = {key: (group[0], min(onset, group[0].frames - 1)) if group else None
               for key, group in groups.items()}
    camera = style.camera_of(samples.values(), elevation=20, aspect=None)
    close = style.camera_of(samples.values(), zoom=0.1, aspect=camera.aspect, elevation=20)
    figure, axes = plt.subplots(len(MODELS), 2 * len(CELLS), figsize=(10.4, 6.4), layout="compressed")
    for row, model in enumerate(MODELS):
        for column, n in enumerate(CELLS):
            whole, pin = axes[row, 2 * column], axes[row, 2 * column + 1]
            sample = samples[model, n]
            style.draw_cloth(whole, sample, camera)
            style.draw_cloth(pin, sample, close, whole=False)
            if sample:
                run, frame = sample
                stretch = style.number(run.metrics["pin_max_stretch"][frame] - 1)
                style.caption(pin, f"at the pin:\nσ₁ − 1 = {stretch}", style.RIGHT)
            whole.set_title(f"{style.model_name(model)}, N = {n}")
    style.stretch_bar(figure, axes, shrink=0.7, pad=0.01)
    return style.save(figure, out, "fig_1")


def _curves(groups, out):
    figure, axes = plt.subplots(1, 2, figsize=(11.4, 3.6), layout="constrained")
    columns = [("pin_max_stretch", 1, "stretch − 1 at the pin"), ("mean_strain", 0, "mean strain")]
    for panel, (metric, offset, label) in zip(axes, columns):
        for (model, n), group in groups.items():
            length = min((run.frames for run in group), default=0)
            if not length:
                continue
            curves = np.array([run.metrics[metric][1:length] - offset for run in group])
            time = group[0].metrics["time"][1:length]
            colour = style.colour(model)
            panel.plot(time, np.median(curves, axis=0), label=f"{style.model_name(model)}, N = {n}",
                       color=colour, linestyle="-" if n == CELLS[-1] else "--")
            panel.fill_between(time, curves.min(axis=0), curves.max(axis=0), color=colour, alpha=0.15,
                               linewidth=0)
        panel.set_ylim(bottom=1e-3)
        style.plain_log(panel)
        panel.set_title(label)
        panel.set_xlabel("time (s)")
    axes[0].axhline(WRONG, color=style.GREY, linewidth=0.8, zorder=0)
    for panel in axes:
        style.label_ends(panel)
    return style.save(figure, out, "fig_1_time")


if __name__ == "__main__":
    figure_main(main)
