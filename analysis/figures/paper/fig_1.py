"""Fig. 1: with strain constraints and one pinned vertex, triangles at the pin are stretched too much."""
import numpy as np

from bendlab.results.load import select, spread, statuses, summary_spread
from draw import cloth
from figures.paper import medians
from runs.sweeps import used_runs
from tables.looks import model_name
from tables.section import Claim, Table

MODELS, CELLS = ["none", "crossover"], [32, 64]
METRICS = [("pin_max_stretch", 1, "stretch − 1 at the pin"), ("mean_strain", 0, "mean strain")]
WRONG = 1.0  # stretch - 1; a larger stretch is a failure: the triangle is more than twice as long


def main(results, out, section):
    runs = used_runs(section, results, "paper/fig1")
    groups = {(model, n): select(runs, bending__model=model, mesh__cells=n)
              for model in MODELS for n in CELLS}
    if runs:
        section.pictures.append((_pictures(groups, out), "Whole sheets, and their pins (dot). The time is "
                                 "the first at which every sheet has had a triangle at the pin that is more "
                                 "than twice its length at rest."))
    median = lambda name, runs: summary_spread(runs, name).median
    onset = lambda runs: spread([_onset(run)[1] for run in runs]).median
    rows = [{"model": model, "N": n, "onset": onset(runs), "pin": median("pin_max_stretch", runs) - 1,
             "anywhere": median("max_stretch", runs) - 1, "mean": median("mean_strain", runs)}
            | {"status": medians.status_text(statuses(runs))} for (model, n), runs in groups.items()]
    section.add_table(
        "fig_1", "Time of the first failure (median over seeds). The other columns are medians over the last "
        "second and over seeds",
        ["model", "N", ("onset", "pin fails at", "", "s"), ("pin", "stretch − 1 at the pin"),
         ("anywhere", "largest anywhere"), ("mean", "mean strain"), ("status", "runs")], rows)
    section.add_chart(
        _over_time(groups), "Without bending springs the failure spreads from the pin over the whole sheet",
        "time", ["pin_max_stretch", "mean_strain"], ["model", "N"], scale="linear", y_scale="log",
        limits=[("pin_max_stretch", WRONG, "twice as long")], note="Median over seeds at each time.")
    section.claims.append(Claim(
        "1", "With strain constraints and one pinned corner, the strain at the pin is wrong.",
        "without bending springs and with crossover springs, at every N, the median stretch − 1 at the pin "
        "over the last second is above 1: a triangle is more than twice its length at rest",
        {f"{label}, {model_name(row['model'])}, N = {row['N']}": row[column]
         for column, label in (("pin", "stretch − 1 at the pin"), ("mean", "mean strain")) for row in rows},
        all(row["pin"] > WRONG for row in rows) if np.isfinite([row["pin"] for row in rows]).all() else None,
        setting="one substep of 10 iterations, without damping"))


def _onset(run):
    """(index, time) of the first frame with a failure at the pin; of the last frame, and ∞, without one."""
    wrong = np.flatnonzero(run.metrics["pin_max_stretch"] - 1 > WRONG)
    return (int(wrong[0]), run.metrics["time"][wrong[0]]) if len(wrong) else (run.frames - 1, np.inf)


def _pictures(groups, out):
    onset = max(_onset(group[0])[0] for group in groups.values() if group)  # all panels show the same time
    samples = {key: (group[0], min(onset, group[0].frames - 1)) if group else None
               for key, group in groups.items()}
    camera = cloth.camera_of(samples.values(), elevation=20, aspect=None)
    close = cloth.camera_of(samples.values(), zoom=0.1, aspect=camera.aspect, elevation=20)
    rows = {model_name(model): [panel for n in CELLS for panel in (
        cloth.Panel(samples[model, n], camera, f"N = {n}"),
        cloth.Panel(samples[model, n], close, f"N = {n}, the pin",
                    medians.pin_text(samples[model, n], "at the pin:\n"), False, cloth.RIGHT))]
            for model in MODELS}
    return cloth.sheet(rows, out, "fig_1", inches=2.4, shrink=0.7)


def _over_time(groups):
    """The medians over seeds, for every frame."""
    rows = []
    for (model, n), runs in groups.items():
        length = min((run.frames for run in runs), default=0)
        over = [np.median([run.metrics[name][:length] - offset for run in runs], axis=0)
                for name, offset, _ in METRICS if runs]
        rows += [(model, n, runs[0].metrics["time"][frame], *(max(values[frame], 0) for values in over))
                 for frame in range(1, length)]
    return Table.of("fig_1_time", "", ["model", "N", ("time", "time", "", "s"),
                                       *((name, label) for name, _, label in METRICS)], rows)
