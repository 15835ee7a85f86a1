"""The scenes of configs/scenes with several bending models: wind, obstacles, moving pins, self-contact."""
from collections import namedtuple
from dataclasses import replace

import matplotlib.pyplot as plt
import numpy as np

from bendlab.results.load import group
from draw import cloth, render, style
from runs import obstacles
from runs.sweeps import load_experiment
from tables.looks import model_name
from tables.numbers import evenly, number
from tables.table import Table

# The picture of a scene: time in s, colour of the fabric (sRGB), and direction of the eye in degrees.
View = namedtuple("View", "time colour azimuth elevation")
SCENES = {
    "flag": View(2.0, (0.74, 0.22, 0.20), -70, 8),
    "tablecloth": View(4.0, (0.90, 0.87, 0.80), -60, 22),
    "sphere_drape": View(4.0, (0.28, 0.45, 0.62), -60, 20),
    "curtain": View(3.0, (0.42, 0.55, 0.45), -75, 8),
    "skirt": View(2.9, (0.62, 0.34, 0.48), -60, 16),
    "folded_stack": View(1.2, (0.86, 0.66, 0.32), -72, 16),
    "chair": View(4.0, (0.80, 0.50, 0.36), -56, 22),
}
LOOKS = 40  # most frames in which the distance of a cloth from its obstacles is measured
ASPECT, WIDTH = 1.15, 460  # of a picture; the width in pixels
DPI = 125  # so that the picture has less than 900 kB


def main(results, out, section):
    experiments = {name: load_experiment(results, f"scenes/{name}") for name in SCENES}
    drawn = {name: experiment for name, experiment in experiments.items() if section.uses(experiment)}
    if drawn:
        section.pictures.append((_sheet(drawn, out), " ".join(f"{name}: {experiment.settings['description']}"
                                                              for name, experiment in drawn.items())))
        section.tables.append(_table(drawn))


def frame_at(run, time):
    """Index of the recorded frame nearest to a time (the last frame if the run ended earlier)."""
    return int(np.argmin(np.abs(run.metrics["time"] - time)))


def clearance(run, frames):
    """Smallest distance of the cloth from obstacles in these frames: negative inside an obstacle, infinite
    without obstacles. Measured at vertices and at the centres of edges and triangles."""
    triangles = run.triangles
    sides = np.stack([triangles, np.roll(triangles, 1, axis=1)], axis=-1).reshape(-1, 2)
    edges, least = np.unique(np.sort(sides), axis=0), np.inf
    for frame in frames:
        positions = run.positions(frame)
        centres = [positions[corners].mean(axis=1) for corners in (edges, triangles)]
        points = np.concatenate([positions, *centres])
        least = min(least, obstacles.clearance(run, run.metrics["time"][frame], points))
    return least


def _camera(samples, view):
    """A camera that shows all samples (run, frame) of a scene, with the obstacles."""
    run, frame = samples[0]
    solid = obstacles.surfaces(run, run.metrics["time"][frame])[0]
    cloths = [run.positions(frame) for run, frame in samples]
    middle = np.concatenate([np.median(cloths, axis=0), solid]).mean(axis=0)
    camera = render.camera_for([*cloths, solid], middle, run.size, view.azimuth, view.elevation, ASPECT)
    floor = obstacles.floor_of(run.config)
    if floor is None and len(solid) and solid[:, 2].min() <= min(cloth[:, 2].min() for cloth in cloths):
        floor = solid[:, 2].min()  # the lowest obstacle stands on the floor
    return camera if floor is None else replace(camera, floor=floor)


def _sheet(experiments, out):
    models = list(dict.fromkeys(model for e in experiments.values() for model in e.sweep["/bending/model"]))
    figure, axes = plt.subplots(len(experiments), len(models), squeeze=False, layout="constrained",
                                figsize=(3.0 * len(models), 3.0 / ASPECT * len(experiments) + 0.6))
    for row, (name, experiment) in zip(axes, experiments.items()):
        view = SCENES[name]
        runs = {model: first for model, (first, *_) in group(experiment.runs, lambda run: run.model).items()}
        samples = {model: (run, frame_at(run, view.time)) for model, run in runs.items()}
        camera = _camera(list(samples.values()), view)
        row[0].text(-0.03, 0.5, name.replace("_", " "), transform=row[0].transAxes, rotation=90,
                    ha="right", va="center", fontsize=10.5, fontweight="bold")
        for panel, model in zip(row, models):
            _draw(panel, samples.get(model), camera, view.colour)
    for panel, model in zip(axes[0], models):
        panel.set_title(model_name(model), fontweight="bold")
    figure.suptitle(title(experiments), x=0.01, ha="left", fontsize=12.5)
    return style.save(figure, out, "fig_scenes", palette=False, dpi=DPI)


def _draw(panel, sample, camera, colour):
    """Draws the cloth of a sample (run, frame) with its obstacles, or "no run"."""
    panel.set_axis_off()
    if sample is None:
        panel.text(0.5, 0.5, "no run", ha="center", va="center", color=style.GREY, transform=panel.transAxes)
        return
    run, frame = sample
    solid = obstacles.surfaces(run, run.metrics["time"][frame])
    colours = np.tile(colour, (len(run.triangles), 1))
    panel.imshow(render.render(run.positions(frame), run.triangles, colours, camera, WIDTH, mesh_lines=False,
                               obstacles=solid), interpolation="lanczos")
    cloth.stamp(panel, run, frame, cloth.RIGHT)
    cloth.caption(panel, _caption(run, frame))


def _caption(run, frame):
    """The text in a picture: the largest stretch in the frame, or the verdict."""
    text = f"σ₁ up to {number(run.metrics['max_stretch'][frame])}"
    if run.status == "implausible":
        text += ", implausible"
    return text if run.complete else f"{run.status} at {run.metrics['time'][-1]:.1f} s"


def title(experiments):
    """The title: numbers of complete and faulty runs, and the largest stretch."""
    runs = [(name, run) for name, experiment in experiments.items() for run in experiment.runs]
    complete = [(name, run) for name, run in runs if run.complete]
    if not complete:
        return f"None of {len(runs)} runs is complete"
    needles = [run.summary["degenerate_triangles"] > 0 for _, run in complete
               if "degenerate_triangles" in run.summary]
    entered = sum(clearance(run, [run.frames - 1]) < 0 for _, run in complete)
    name, worst = max(complete, key=lambda entry: entry[1].summary["max_stretch"])
    return (f"{len(experiments)} scenes, only the bending model differs: {len(complete)} of {len(runs)} runs "
            f"are complete\nLast frame: degenerate triangles in {sum(needles)} of {len(needles)} runs, cloth "
            f"inside obstacles in {entered} of {len(complete)}\nLargest stretch, median of the last second: "
            f"{number(worst.summary['max_stretch'])} ({name.replace('_', ' ')}, {model_name(worst.model)})")


def _table(experiments):
    metrics = [("mean_strain", "mean strain"), ("max_stretch", "max σ₁"),
               ("worst_stretch", "worst σ₁ of all frames")]
    rows = [{"scene": name, "model": run.model, "status": run.status,
             "clearance": 1e3 * clearance(run, evenly(run.frames, LOOKS)),
             "cpu": run.cpu_s, "degenerate": run.summary.get("degenerate_triangles")}
            | {metric: run.summary.get(metric) for metric, _ in metrics}
            for name, experiment in experiments.items() for run in experiment.runs]
    return Table.of("scenes", "Every run", [
        "scene", "model", ("status", "verdict"), *metrics, ("degenerate", "degenerate triangles", ".0f"),
        ("clearance", f"smallest distance from an obstacle, at most {LOOKS} frames", ".1f", "mm"),
        ("cpu", "processor time", ".1f", "s")], rows)
