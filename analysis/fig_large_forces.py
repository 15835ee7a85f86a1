"""Large external forces, a storm and pins that are snatched away: the paper's springs and our defaults."""
import right_python  # noqa: F401  (first: it may hand over to another Python)
import matplotlib.pyplot as plt
import numpy as np

import style
from report import Claim, Section, Table, figure_main
from sweeps import load_experiment

# Scene → time of its picture in s.
SCENES = {"storm": 2.0, "snatch": 0.6}
MOST = 1.15  # stated before anything was run
SPRINGS = ["crossover", "adaptive", "lod"]
ROWS = [*(("paper", model) for model in SPRINGS), ("recommended", "discrete_shells")]


def main(results, out):
    """Draws both scenes with the paper's springs and with our defaults, and the stretch over time."""
    section = Section("Large external forces", "ours")
    scenes = {name: {(run.point["/defaults"], run.model): run for run in
                     section.uses(load_experiment(results, f"scenes/{name}"))} for name in SCENES}
    section.text = (
        "The author of the paper later named large external forces as what makes strain-based cloth fail. In "
        "a storm (a wind of 21 m/s, turbulence intensity 0.5) and where pins are snatched away "
        "(0.85 m in 0.1 s, 52 times the acceleration of gravity) we compare the paper's springs, with the "
        "paper's settings, and our defaults with the same models and with hinges. Sheets of 1 m on 48 "
        "cells.")
    scenes = {name: runs for name, runs in scenes.items() if runs}
    if scenes:
        section.pictures.append((_picture(scenes, out), "Left: the cloth at the given time, all panels of a "
                                 "row with the same camera; the number is the largest stretch at any time. "
                                 "σ₁ is length over length at rest in the direction that is stretched most. "
                                 "Right: the largest stretch of each recorded frame."))
    section.tables.append(_table(scenes))
    section.claims.append(_claim(scenes))
    return section


def _label(defaults, model):
    return f"{style.model_name(model)}\n({'the paper’s' if defaults == 'paper' else 'our defaults'})"


def _frame(run, time):
    return int(np.argmin(np.abs(run.metrics["time"] - time)))


def _picture(scenes, out):
    figure, axes = plt.subplots(len(scenes), len(ROWS) + 1, figsize=(15, 3.0 * len(scenes)), squeeze=False,
                                layout="constrained", width_ratios=[1] * len(ROWS) + [1.5])
    for row, (name, runs) in zip(axes, scenes.items()):
        samples = {key: (runs[key], _frame(runs[key], SCENES[name])) for key in ROWS if key in runs}
        camera = style.camera_of([sample for key, sample in samples.items() if key[0] == "recommended"]
                                 or samples.values(), aspect=0.85)
        for panel, key in zip(row, ROWS):
            sample = samples.get(key)
            worst = sample and sample[0].summary.get("worst_stretch", np.nan)
            style.draw_cloth(panel, sample, camera, width=360,
                             text=sample and f"largest σ₁ = {style.number(worst, 3)}")
        row[0].text(-0.03, 0.5, name, transform=row[0].transAxes, rotation=90, ha="right", va="center",
                    fontsize=10.5, fontweight="bold")
        chart = row[-1]
        for key in ROWS:
            if key in runs:
                run = runs[key]
                chart.plot(run.metrics["time"], run.metrics["max_stretch"], **style.look(key[1], marker=""),
                           label=_label(*key).replace("\n", " "))
        chart.set_yscale("log")
        chart.set_xlabel("time (s)")
        chart.set_ylabel("largest stretch σ₁")
        style.plain_log(chart)
        style.label_ends(chart)
    for panel, key in zip(axes[0], ROWS):
        panel.set_title(_label(*key), fontsize=10)
    style.stretch_bar(figure, axes[:, :len(ROWS)], shrink=0.6, pad=0.01, aspect=30)
    figure.suptitle(_title(scenes), x=0.01, ha="left", fontsize=12.5)
    return style.save(figure, out, "fig_large_forces")


def _worst(scenes, chosen):
    """The largest stretch at any time of the runs that `chosen` (defaults, model) says, in each scene."""
    return {name: max((run.summary.get("worst_stretch", np.nan) for key, run in runs.items() if chosen(*key)),
                      default=np.nan) for name, runs in scenes.items()}


def _title(scenes):
    paper = {name: min((run.summary.get("worst_stretch", np.nan) for (defaults, model), run in runs.items()
                        if defaults == "paper" and model in SPRINGS), default=np.nan)
             for name, runs in scenes.items()}
    ours = _worst(scenes, lambda defaults, _: defaults == "recommended")
    said = [f"{name}: at least {style.number(paper[name], 2)} times with the paper's springs, at most "
            f"{style.number(ours[name], 3)} with our defaults and each of four models" for name in scenes]
    return "How far large forces stretch a triangle\n" + "\n".join(said)


def _table(scenes):
    rows = [[name, defaults, model, run.status, *(style.number(run.summary.get(metric, np.nan)) for metric in
                                                  ("worst_stretch", "max_stretch", "mean_strain")),
             style.number(1e3 * run.step_cpu_s / (60 * run.metrics["time"][-1]))]
            for name, runs in scenes.items() for (defaults, model), run in runs.items()]
    return Table("Every run", ["scene", "settings", "model", "verdict", "largest σ₁ at any time",
                               "max σ₁, median of the last second", "mean strain, median of the last second",
                               "CPU ms per step of 1/60 s"], rows)


def _claim(scenes):
    ours = _worst(scenes, lambda defaults, model: (defaults, model) == ("recommended", "discrete_shells"))
    numbers = {f"{name}, our defaults: largest stretch at any time": value for name, value in ours.items()}
    numbers |= {f"{name}, the paper's {model}: largest stretch at any time":
                _worst(scenes, lambda *key, model=model: key == ("paper", model))[name]
                for name in scenes for model in SPRINGS}
    whole = len(ours) == len(SCENES) and not any(np.isnan(list(ours.values())))
    return Claim("ours", "Large external forces do not tear the cloth (our defaults).",
                 f"no triangle is ever more than {MOST} times as long as at rest",
                 numbers, all(ours[name] <= MOST for name in SCENES) if whole else None,
                 note="Where pins are snatched away, inertia alone stretches the triangle at a corner to "
                 "1.245 times its length, so that this membrane cannot keep to the bound.")


if __name__ == "__main__":
    figure_main(main)
