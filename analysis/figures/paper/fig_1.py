"""Fig. 1: with strain constraints and one pinned vertex, triangles at the pin are stretched too much."""
import numpy as np

from draw import cloth
from tables.numbers import number
from tables import looks
from bendlab.results.load import select, spread, summary_spread
from tables.chart import Chart
from tables.section import Claim
from tables.table import Table
from runs.sweeps import load_experiment

MODELS = ["none", "crossover"]
CELLS = [32, 64]
WRONG = 1.0  # stretch - 1; a larger stretch is a failure: the triangle is more than twice as long


def main(results, out, section):
    runs = section.uses(load_experiment(results, "paper/fig1"))
    groups = {(model, n): select(runs, bending__model=model, mesh__cells=n) for model in MODELS
              for n in CELLS}
    if runs:
        section.pictures.append((_pictures(groups, out), "Whole sheets, and their pins (dot). The time is "
                                 "the first at which every sheet has had a triangle at the pin that is more "
                                 "than twice its length at rest."))
    pin = {key: summary_spread(group, "pin_max_stretch") - 1 for key, group in groups.items()}
    anywhere = {key: summary_spread(group, "max_stretch") - 1 for key, group in groups.items()}
    mean = {key: summary_spread(group, "mean_strain") for key, group in groups.items()}
    onset = {key: spread([run.metrics["time"][_onset(run)] for run in group])
             for key, group in groups.items()}
    section.tables += [Table.of(
        "fig_1", "Time of the first failure (median over seeds). The other columns are medians over the last "
                 "second and over seeds", ["model", "N", ("onset", "pin fails at", "", "s"),
                                    ("pin", "stretch − 1 at the pin"),
                  ("anywhere", "largest anywhere"), ("mean", "mean strain")],
        [{"model": model, "N": n, "onset": onset[model, n].median, "pin": pin[model, n].median,
          "anywhere": anywhere[model, n].median, "mean": mean[model, n].median} for model, n in groups]),
        _over_time(groups)]
    section.charts.append(Chart(
        "fig_1_time", "Without bending springs the failure spreads from the pin over the whole "
                      "sheet", "fig_1_time",
        "time", ["pin_max_stretch", "mean_strain"], ["model", "N"], scale="linear", y_scale="log",
        limits=[("pin_max_stretch", WRONG, "twice as long")], note="Median over seeds at each time."))
    section.claims.append(Claim("1", "With strain constraints and one pinned corner, the strain at the pin "
                                "is wrong.", "without bending springs and with crossover springs, at every "
                                "N, the median stretch − 1 at the pin over the last second is above 1: a "
                                "triangle is more than twice its length at rest",
                                {f"stretch − 1 at the pin, {looks.model_name(model)}, N = {n}": pin[
                                model, n].median for model, n in groups}
                                | {f"mean strain, {looks.model_name(model)}, N = {n}": mean[model, n].median
                                   for model, n in groups}, all(s.median > WRONG for s in pin.values())
                                if all(s.known for s in pin.values()) else None,
                                setting="one substep of 10 iterations, without damping"))


def _onset(run):
    """Index of the first frame with a failure at the pin, or of the last frame."""
    wrong = np.flatnonzero(run.metrics["pin_max_stretch"] - 1 > WRONG)
    return int(wrong[0]) if len(wrong) else run.frames - 1


def _pictures(groups, out):
    onset = max(_onset(group[0]) for group in groups.values() if group)  # all panels show the same time
    samples = {key: (group[0], min(onset, group[0].frames - 1)) if group else None
               for key, group in groups.items()}
    camera = cloth.camera_of(samples.values(), elevation=20, aspect=None)
    close = cloth.camera_of(samples.values(), zoom=0.1, aspect=camera.aspect, elevation=20)
    rows = {looks.model_name(model): [panel for n in CELLS for panel in (
        cloth.Panel(samples[model, n], camera, f"N = {n}"),
        cloth.Panel(samples[model, n], close, f"N = {n}, the pin", _pin_text(samples[model, n]), False,
                    cloth.RIGHT))] for model in MODELS}
    return cloth.sheet(rows, out, "fig_1", inches=2.4, shrink=0.7)


def _pin_text(sample):
    if not sample:
        return ""
    run, frame = sample
    return f"at the pin:\nσ₁ − 1 = {number(run.metrics['pin_max_stretch'][frame] - 1)}"


def _over_time(groups):
    """The medians over seeds, for every frame."""
    rows = []
    for (model, n), own_runs in groups.items():
        length = min((run.frames for run in own_runs), default=0)
        over = {name: np.median([run.metrics[name][:length] - offset for run in own_runs], axis=0)
                for name, offset in (("pin_max_stretch", 1), ("mean_strain", 0))} if length else {}
        rows += [{"model": model, "N": n, "time": own_runs[0].metrics["time"][frame]}
                 | {name: max(values[frame], 1e-3) for name, values in over.items()}
                 for frame in range(1, length)]
    return Table.of("fig_1_time", "", ["model", "N", ("time", "time", "", "s"),
                                       ("pin_max_stretch", "stretch − 1 at the pin"),
                                       ("mean_strain", "mean strain")],
                    rows)
