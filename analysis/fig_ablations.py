"""One row per question that the paper leaves open: the effect of each answer on the sheet."""
import right_python  # noqa: F401  (first: it may hand over to another Python)
import re

import matplotlib.pyplot as plt
import numpy as np

import style
from bendlab.results.load import at, group, summary_spread
from report import Section, Table, figure_main
from sweeps import CONFIGS, load_experiment

METRICS = [("pin_max_stretch", 1, "stretch − 1 at the pin"), ("mean_strain", 0, "mean strain"),
           ("drop", 0, "drop (m)")]


def main(results, out):
    """Draws and tabulates every ablation of configs/ablations."""
    section = Section("Where the paper is silent", "ablations")
    section.text = ("Each question that the paper leaves open, with several answers. All other settings are "
                    "those of Fig. 5 without damping, on as many cells per side as the figure says.")
    rows, experiments = [], []
    for config in sorted(CONFIGS.glob("ablations/*.json")):
        experiment = load_experiment(results, f"ablations/{config.stem}")
        if config.stem.endswith("_full") and not experiment.runs:
            continue
        if experiment.missing_text:
            section.missing.append(f"configs/ablations/{config.name}: {experiment.missing_text}")
        if experiment.runs:
            experiments.append(config.stem)
            rows += _rows(config.stem, experiment)
    section.commands.append("./bendlab run configs/ablations/*.json")
    if rows:
        section.pictures.append((_picture(rows, out), "Median over the last second and over three seeds; "
                                 "bars: smallest and largest seed. Filled: our default."))
    columns = ["question", "choice", "N", *(label for *_, label in METRICS), "springs"]
    section.tables.append(Table("Median (smallest – largest seed)", columns,
                                [[row["question"] if row["first"] else "", row["choice"], row["cells"],
                                  *(_text(s) for s in row["spreads"]), f"{row['springs']:,.0f}"]
                                 for row in rows]))
    return section


def _rows(question, experiment):
    """One row per answer, in the config's order."""
    pointer = next(p for p in experiment.sweep if p != "/initial/seed")
    answers = experiment.sweep[pointer]
    default = at(experiment.settings, pointer, answers[0])
    groups = group(experiment.runs, lambda run: answers.index(run.get(pointer)))
    rows = []
    for i in sorted(groups):
        some = groups[i]
        rows.append({"question": re.sub(r"_\d\d+(_full)?$", "", question).replace("_", " "),
                     "choice": _choice(pointer, answers[i], some[0]),
                     "default": answers[i] == default, "first": i == min(groups),
                     # A mesh file has no /mesh/cells
                     "cells": round((some[0].summary["triangles"] / 2) ** 0.5),
                     "springs": summary_spread(some, "springs").median,
                     "spreads": [summary_spread(some, metric) - offset for metric, offset, _ in METRICS]})
    return rows


def _choice(pointer, value, run):
    if pointer == "/solver/dt":
        return f"1/{1 / value:.0f} s"
    if pointer == "/initial/tilt":
        return f"{value:g}°"
    if pointer == "/bending/lod/t":
        return f"t = {value}" if value else "t = m and n"
    if pointer == "/pins/vertices":
        count = np.isin(run.triangles, np.flatnonzero(run.pinned)).any(axis=1).sum()
        return f"{count:d} triangle{'s' * (count > 1)}"
    if isinstance(value, list):
        return f"{np.degrees(np.arctan2(value[1], value[0])):g}°"
    unit = {"/effects/1/rate": " s⁻¹", "/material/density": " kg/m²"}.get(pointer, "")
    return {True: "yes",
            False: "no"}[value] if isinstance(value, bool) else f"{value}{unit}".replace("_", " ")


def _picture(rows, out):
    heights = np.cumsum([1.0 + (0.55 if row["first"] else 0) for row in rows])
    figure, axes = plt.subplots(1, len(METRICS), figsize=(10.4, 0.225 * heights[-1] + 0.9), sharey=True,
                                layout="constrained")
    for panel, (index, (_, _, label)) in zip(axes, enumerate(METRICS)):
        for row, y in zip(rows, heights):
            s = row["spreads"][index]
            if not s.known:
                continue
            colour = style.SEQUENCE[0] if row["default"] else style.SEQUENCE[1]
            high = s.high if np.isfinite(s.high) else s.median * 100
            panel.plot([s.low, high], [y, y], color=colour, linewidth=1.4, solid_capstyle="butt")
            panel.plot(s.median, y, "o", color=colour, markerfacecolor=colour if row["default"] else "white")
        if METRICS[index][0] == "drop":
            panel.set_xlim(left=0)
        else:
            style.plain_log(panel, "x")
        panel.set_title(label)
        panel.grid(axis="y", visible=False)
        panel.tick_params(axis="y", length=0)
        panel.tick_params(axis="x", top=True, labeltop=True)
        for row, y in zip(rows, heights):
            if row["first"]:
                panel.axhline(y - 0.8, color=style.GRID, linewidth=0.8)
    axes[0].set_yticks(heights, labels=[row["choice"] for row in rows])
    axes[0].set_ylim(heights[-1] + 0.8, heights[0] - 0.9)
    for row, y in zip(rows, heights):
        if row["first"]:
            place = dict(transform=axes[0].get_yaxis_transform(), ha="left", va="center")
            axes[0].text(-0.8, y, row["question"], fontweight="bold", fontsize=8.5, **place)
            axes[0].text(-0.8, y + 0.95, f"N = {row['cells']}", fontsize=7.5, color=style.GREY, **place)
    return style.save(figure, out, "fig_ablations")


def _text(s):
    return f"{style.number(s.median)} ({style.number(s.low)} – {style.number(s.high)})" if s.known else "–"


if __name__ == "__main__":
    figure_main(main)
