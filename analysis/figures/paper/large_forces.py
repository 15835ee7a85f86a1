"""Large external forces, a storm and pins that move abruptly: the paper's springs and our defaults."""
import numpy as np

from draw import cloth
from figures.accuracy.measures import cost
from figures.paper.scenes import frame_at
from runs.strips import number as metric_of
from runs.sweeps import used_runs
from tables.looks import model_name
from tables.numbers import number
from tables.section import Claim, Table

SCENES = {"storm": 2.0, "snatch": 0.6}  # scene → time of the picture, s
MOST = 1.15  # largest allowed stretch; this number was chosen before the first run
WHOSE = {"paper": "the paper’s", "recommended": "our defaults"}
SPRINGS = ["crossover", "adaptive", "lod"]
OURS = ("recommended", "discrete_shells")
ROWS = [*(("paper", model) for model in SPRINGS), OURS]


def main(results, out, section):
    scenes = {name: {(run.point["/defaults"], run.model): run
                     for run in used_runs(section, results, f"scenes/{name}")} for name in SCENES}
    scenes = {name: runs for name, runs in scenes.items() if runs}
    if scenes:
        section.pictures.append((_picture(scenes, out), "The cloth at the time in the upper corner. All "
                                 "panels of a row have one camera. The number in the lower corner is the "
                                 "largest stretch σ₁ at any time. σ₁ is the length of a triangle over its "
                                 "length at rest, in the most stretched direction."))
    metrics = [("worst_stretch", "largest σ₁ at any time"),
               ("max_stretch", "max σ₁, median of the last second"),
               ("mean_strain", "mean strain, median of the last second")]
    section.add_table(
        "large_forces", "Every run",
        ["scene", "settings", "model", ("status", "verdict"), *metrics,
         ("ms", "CPU time per step of 1/60 s", "", "ms")],
        [{"scene": name, "settings": defaults, "model": model, "status": run.status, "ms": cost(run)}
         | {metric: run.summary.get(metric) for metric, _ in metrics}
         for name, runs in scenes.items() for (defaults, model), run in runs.items()])
    over_time = Table.of(
        "stretch_over_time", "", ["scene", "settings", "model", ("time", "time", "", "s"),
                                  ("max_stretch", "largest stretch σ₁")],
        [(name, WHOSE[key[0]], key[1], time, stretch)
         for name, runs in scenes.items() for key, run in runs.items() if key in ROWS
         for time, stretch in zip(run.metrics["time"], run.metrics["max_stretch"])])
    worst = {name: {key: metric_of(run, "worst_stretch") for key, run in runs.items()}
             for name, runs in scenes.items()}
    section.add_chart(over_time, _title(worst), "time", ["max_stretch"], ["settings", "model"],
                      id="large_forces", held=["scene"], scale="linear", y_scale="log",
                      note="The largest stretch of each recorded frame.")
    section.claims.append(_claim(worst))


def _picture(scenes, out):
    rows = {}
    for name, runs in scenes.items():
        samples = {key: (runs[key], frame_at(runs[key], SCENES[name])) for key in ROWS if key in runs}
        camera = cloth.camera_of([samples[OURS]] if OURS in samples else samples.values(), aspect=0.85)
        rows[name] = [cloth.Panel(samples.get(key), camera, f"{model_name(key[1])}\n({WHOSE[key[0]]})",
                                  f"largest σ₁ = {number(metric_of(runs[key], 'worst_stretch'))}"
                                  if key in runs else "") for key in ROWS]
    return cloth.sheet(rows, out, "fig_large_forces", inches=2.7)


def _title(worst):
    said = []
    for name, stretches in worst.items():
        paper = [stretches[key] for key in stretches if key in ROWS and key != OURS]
        ours = [stretches[key] for key in stretches if key[0] == OURS[0]]
        parts = [f"at least {number(np.min(paper), 2)} times with the paper's springs"] if paper else []
        if ours:
            parts.append(f"at most {number(np.max(ours), 3)} times with our defaults ({len(ours)} models)")
        said += [f"{name}: {', '.join(parts)}"] if parts else []
    return ". ".join(["How far large forces stretch a triangle", *filter(None, ["; ".join(said)])])


def _claim(worst):
    said = "largest stretch at any time"
    ours = {name: stretches.get(OURS, np.nan) for name, stretches in worst.items()}
    numbers = {f"{name}, our defaults: {said}": most for name, most in ours.items()}
    numbers |= {f"{name}, the paper's {model}: {said}": stretches.get(("paper", model), np.nan)
                for name, stretches in worst.items() for model in SPRINGS}
    whole = len(ours) == len(SCENES) and np.isfinite(list(ours.values())).all()
    return Claim("ours", "Large external forces do not tear the cloth (our defaults).",
                 f"no triangle is ever stretched to more than {MOST} times its length at rest", numbers,
                 max(ours.values()) <= MOST if whole else None,
                 "When pins move abruptly, inertia alone stretches the triangle at a corner beyond the "
                 "limit. configs/scenes/snatch.json states how far.")
