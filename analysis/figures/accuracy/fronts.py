"""What accuracy costs: error and CPU time of every bending model for one stated cloth. The front of a model
consists of the runs for which no other run of the model has less time and a smaller error.
"""
import numpy as np

from bendlab.results.load import by_model
from figures.accuracy import measures
from tables.chart import Chart
from tables.numbers import number

MEASURES = (("physical", "the stated cloth"), ("solver", "its own equilibrium"))
STATED = 5e-5  # B of the cloth in N m, as in configs/accuracy
SCENES = {"curtain on two pins, 24 cells": (measures.FRONTS[0], "paper"),
          "cantilever, 12 cells": (measures.FRONTS[1], "paper_cantilever")}
# Scenes with many equilibria
BASINS = {"drape, 20 cells": "front_drape_slow", "sheet on one pin, 20 cells": "front_one_pin_slow"}
PAPER = "the paper's setting"  # 10 iterations, 1/60 s, k = 0.5


def main(results, out, section):
    scenes = {scene: (measures.experiment_runs(results, section, *stated),
                      measures.experiment_runs(results, section, paper))
              for scene, (stated, paper) in SCENES.items()}
    scenes |= {scene: ([run for run in measures.experiment_runs(results, section, config) if run.complete],
                       [])
               for scene, config in BASINS.items()}
    scenes = {scene: runs for scene, runs in scenes.items() if runs[0]}
    if not scenes:
        return
    gaps = {scene: measures.gap(stated) for scene, (stated, _) in scenes.items() if scene in SCENES}
    levels = [row for scene, (stated, _) in scenes.items()
              for against, meaning in (MEASURES if scene in SCENES else MEASURES[:1])
              for row in measures.levels_rows(stated, scene, against, meaning)]
    section.tables = [measures.levels_table(levels), _within(levels), _fronts(scenes), _best(scenes),
                      *([_stiffness(sum(scenes["cantilever, 12 cells"], []))]
                        if "cantilever, 12 cells" in scenes
                        else [])]
    uncertain = ", ".join(f"{scene} {number(100 * gap, 2)} %" for scene, gap in gaps.items()
                          if np.isfinite(gap))
    section.charts = [
        Chart("fronts", "Error against time", "fronts", "ms", ["error_physical", "error_solver"], ["curve"],
              held=["scene"], at=list(scenes)[0], y_scale="log", on_top=True,
              note="Each curve is the front of a model: the runs for which no other run of the model has "
                   f"less time and a smaller error. Smaller errors than these are not known, because the "
                   f"reference is not exact: {uncertain}. Click a point to open its run."),
        Chart("levels", "Models near the stated cloth", "within", "name", ["ms"], ["within"], held=["scene"],
              scale="band", look="", y_scale="log",
              at=list(scenes)[0],
              note="CPU time per frame of the cheapest run of each model within an error from the stated "
                   "cloth. A model without a mark has no run with so small an error. "
              + ". ".join(message(scene, stated) for scene, (stated, _) in scenes.items()) + ".")]


def message(scene, stated):
    """Text: which models reach errors of 5 % and 1 % in the least time in a scene."""
    parts = []
    for level in (0.05, 0.01):
        if level < measures.gap(stated):
            parts.append(f"errors of {100 * level:g} % are not known")
            continue
        run = measures.reaching(stated, level)
        parts.append(f"{measures.name_of(run.model)} reaches {100 * level:g} % in the least time, "
                     f"{number(measures.cost(run), 2)} ms" if run else
                     f"no model reaches {100 * level:g} %")
    return f"{scene}: {', '.join(parts)}"


def _within(levels):
    """One row per model and target error, with the least time to this error."""
    rows = [{"scene": row["scene"], "name": row["name"], "model": row["model"],
             "within": f"within {100 * level:g} %",
             "ms": row[f"ms_{100 * level:g}"], "runs": [row[f"run_{100 * level:g}"]]}
            for row in levels if row["against"] == MEASURES[0][1] for level in measures.LEVELS
            if row[f"ms_{100 * level:g}"] is not None]
    return measures.table("within", "", ["scene", "name", "within", "ms"], rows)


def _fronts(scenes):
    rows = []
    for scene, (stated, paper) in scenes.items():
        for model, own_runs in by_model(stated).items():
            rows += [measures.row(run) | {"scene": scene, "curve": measures.name_of(model)}
                     for run in measures.front(own_runs)]
        rows += [measures.row(run) | {"scene": scene, "curve": f"{measures.name_of(run.model)}, {PAPER}"}
                 for run in paper if np.isfinite(measures.error(run))]
    return measures.table("fronts", "The front (the best runs) of each model", [
        "scene", ("curve", "model"), "settings", "ms", "projections", "error_physical", "error_solver"], rows)


def _best(scenes):
    rows = [measures.row(run) | {"scene": scene} for scene, (stated, paper) in scenes.items()
            if scene in SCENES
            for run in measures.front(stated + paper)]
    return measures.table("best", "The front over all models", [
        "scene", "name", "settings", "ms", "projections", "error_physical"], rows)


def _stiffness(runs):
    """For the runs in the fronts of the cantilever: measured stiffness over stated stiffness."""
    rows = [measures.row(run) | {"B": run.summary.get("stiffness_flexural_rigidity", np.nan) / STATED}
            for own_runs in by_model(runs).values() for run in measures.front(own_runs)]
    return measures.table("stiffness", "Cantilever: the error of the stiffness", [
        "name", "settings", "ms", ("B", "B measured over B stated"), "error_physical"], rows)
