"""Large external forces, a storm and pins that move abruptly: the paper's springs and our defaults."""
import numpy as np

from draw import cloth
from tables.numbers import number
from tables import looks
from tables.chart import Chart
from tables.section import Claim
from tables.table import Table
from runs.sweeps import load_experiment

# Scene → time of the picture, s.
SCENES = {"storm": 2.0, "snatch": 0.6}
MOST = 1.15  # largest allowed stretch; this number was chosen before the first run
WHOSE = {"paper": "the paper’s", "recommended": "our defaults"}
SPRINGS = ["crossover", "adaptive", "lod"]
ROWS = [*(("paper", model) for model in SPRINGS), ("recommended", "discrete_shells")]


def main(results, out, section):
    scenes = {name: {(run.point["/defaults"], run.model): run for run in
                     section.uses(load_experiment(results, f"scenes/{name}"))} for name in SCENES}
    scenes = {name: runs for name, runs in scenes.items() if runs}
    if scenes:
        section.pictures.append((_picture(scenes, out), "The cloth at the time in the upper corner. All "
                                                        "panels of a row have one camera. The number in "
                                                        "the lower corner is the largest stretch σ₁ at any "
                                                        "time. σ₁ is the length of a triangle over its "
                                                        "length at rest, in the most stretched direction."))
    section.tables += [_table(scenes), _over_time(scenes)]
    section.charts.append(Chart("large_forces", _title(scenes), "stretch_over_time", "time", ["max_stretch"],
                                ["settings", "model"], held=["scene"], scale="linear", y_scale="log",
                                note="The largest stretch of each recorded frame."))
    section.claims.append(_claim(scenes))


def _frame(run, time):
    return int(np.argmin(np.abs(run.metrics["time"] - time)))


def _picture(scenes, out):
    rows = {}
    for name, runs in scenes.items():
        samples = {key: (runs[key], _frame(runs[key], SCENES[name])) for key in ROWS if key in runs}
        camera = cloth.camera_of([sample for key, sample in samples.items() if key[0] == "recommended"]
                                 or samples.values(), aspect=0.85)
        rows[name] = [cloth.Panel(samples.get(key), camera, f"{looks.model_name(key[1])}\n({WHOSE[key[0]]})",
                                  _worst_text(samples.get(key))) for key in ROWS]
    return cloth.sheet(rows, out, "fig_large_forces", inches=2.7)


def _worst_text(sample):
    return f"largest σ₁ = {number(sample[0].summary.get('worst_stretch', np.nan), 3)}" if sample else ""


def _over_time(scenes):
    rows = [{"scene": name, "settings": WHOSE[defaults], "model": model, "time": time, "max_stretch": stretch}
            for name, runs in scenes.items() for (defaults, model), run in runs.items()
            if (defaults, model) in ROWS
            for time, stretch in zip(run.metrics["time"], run.metrics["max_stretch"])]
    return Table.of("stretch_over_time", "", ["scene", "settings", "model", ("time", "time", "", "s"),
                                              ("max_stretch", "largest stretch σ₁")], rows)


def _worst(scenes, chosen):
    """Scene → largest stretch at any time, of all runs with chosen(defaults, model)."""
    return {name: max((run.summary.get("worst_stretch", np.nan) for key, run in runs.items() if chosen(*key)),
                      default=np.nan) for name, runs in scenes.items()}


def _title(scenes):
    paper = {name: min((run.summary.get("worst_stretch", np.nan) for (defaults, model), run in runs.items()
                        if defaults == "paper" and model in SPRINGS), default=np.nan)
             for name, runs in scenes.items()}
    ours = _worst(scenes, lambda defaults, _: defaults == "recommended")
    said = [f"{name}: at least {number(paper[name], 2)} times with the paper's springs, at most "
            f"{number(ours[name], 3)} with our defaults and any of four models" for name in scenes]
    return "How far large forces stretch a triangle. " + "; ".join(said)


def _table(scenes):
    rows = [{"scene": name, "settings": defaults, "model": model, "status": run.status,
             "ms": 1e3 * run.step_cpu_s / (60 * run.metrics["time"][-1])}
            | {metric: run.summary.get(metric) for metric in ("worst_stretch", "max_stretch", "mean_strain")}
            for name, runs in scenes.items() for (defaults, model), run in runs.items()]
    return Table.of("large_forces", "Every run", [
        "scene", "settings", "model", ("status", "verdict"), ("worst_stretch", "largest σ₁ at any time"),
        ("max_stretch", "max σ₁, median of the last second"),
        ("mean_strain", "mean strain, median of the last second"),
        ("ms", "CPU time per step of 1/60 s", "", "ms")], rows)


def _claim(scenes):
    ours = _worst(scenes, lambda defaults, model: (defaults, model) == ("recommended", "discrete_shells"))
    numbers = {f"{name}, our defaults: largest stretch at any time": value for name, value in ours.items()}
    numbers |= {f"{name}, the paper's {model}: largest stretch at any time":
                _worst(scenes, lambda *key, model=model: key == ("paper", model))[name]
                for name in scenes for model in SPRINGS}
    whole = len(ours) == len(SCENES) and not any(np.isnan(list(ours.values())))
    return Claim("ours", "Large external forces do not tear the cloth (our defaults).",
                 f"no triangle is ever stretched to more than {MOST} times its length at rest",
                 numbers, all(ours[name] <= MOST for name in SCENES) if whole else None,
                 note="When pins move abruptly, inertia alone stretches the triangle at a corner to 1.245 "
                 "times its length, so this membrane cannot keep within the limit.")
