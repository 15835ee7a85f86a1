"""What accuracy costs: error and CPU time of every bending model for one stated cloth. The front of a model
consists of the runs for which no other run of the model has less time and a smaller error.
"""
import numpy as np

from bendlab.results.load import by_model
from figures.accuracy.measures import (FRONTS, LEVELS, cells, complete_runs, cost, error, experiment_runs,
                                       front, front_rows, gap, known_levels, levels_rows, levels_table,
                                       name_of, percent, reaching, row, table)
from tables.numbers import number

PHYSICAL = "the stated cloth"
STATED = 5e-5  # B of the cloth in N m, as in configs/accuracy
CANTILEVER, CURTAIN = "cantilever, 12 cells", "curtain on two pins, 24 cells"
# Scene → configs of the stated cloth, config of the paper's setting (10 iterations, 1/60 s, k = 0.5)
SCENES = {CURTAIN: (FRONTS[0], "paper"), CANTILEVER: (FRONTS[1], "paper_cantilever")}
# Scenes with many equilibria
BASINS = {"drape, 20 cells": "front_drape_slow", "sheet on one pin, 20 cells": "front_one_pin_slow"}


def main(results, out, section):
    scenes = {scene: (experiment_runs(results, section, *stated), experiment_runs(results, section, paper))
              for scene, (stated, paper) in SCENES.items()}
    scenes[CURTAIN][0].extend(run for run in experiment_runs(results, section, "beat") if cells(run) == 24)
    scenes |= {scene: (complete_runs(results, section, config), []) for scene, config in BASINS.items()}
    scenes = {scene: runs for scene, runs in scenes.items() if runs[0]}
    if not scenes:
        return
    levels, fronts, best, uncertain = [], [], [], []
    for scene, (stated, paper) in scenes.items():
        levels += levels_rows(stated, scene, "physical", PHYSICAL)
        for model, own_runs in by_model(stated).items():
            for method in sorted({run.method for run in own_runs}):
                curve = name_of(model) if method == "pbd" else f"{name_of(model)}, {method}"
                fronts += front_rows([run for run in own_runs if run.method == method],
                                     scene=scene, curve=curve)
        fronts += [row(run) | {"scene": scene, "curve": f"{name_of(run.model)}, the paper's setting"}
                   for run in paper if np.isfinite(error(run))]
        if scene in SCENES:
            levels += levels_rows(stated, scene, "solver", "its own equilibrium")
            best += front_rows(stated + paper, scene=scene)
            if np.isfinite(gap(stated)):
                uncertain.append(f"{scene} {percent(gap(stated))}")
    # A row for each model and target error, with the least time to this error
    within = [{name: of_model[name] for name in ("scene", "name", "model")}
              | {"within": f"within {level} %", "ms": of_model[f"ms_{level}"],
                 "runs": [of_model[f"run_{level}"]]}
              for of_model in levels if of_model["against"] == PHYSICAL for level in LEVELS
              if of_model[f"run_{level}"]]
    section.tables = [
        levels_table(levels), table("within", "", ["scene", "name", "within", "ms"], within),
        table("fronts", "The front (the best runs) of each model", [
            "scene", ("curve", "model"), "settings", "ms", "projections", "error_physical", "error_solver"],
            fronts),
        table("best", "The front over all models", [
            "scene", "name", "settings", "ms", "projections", "error_physical"], best)]
    if CANTILEVER in scenes:
        rows = [row(run) | {"B": run.summary.get("stiffness_flexural_rigidity", np.nan) / STATED}
                for own_runs in by_model(sum(scenes[CANTILEVER], [])).values() for run in front(own_runs)]
        section.tables.append(table("stiffness", "Cantilever: the error of the stiffness", [
            "name", "settings", "ms", ("B", "B measured over B stated"), "error_physical"], rows))
    section.add_chart(
        "fronts", "Error against time", "ms", ["error_physical", "error_solver"], ["curve"], held=["scene"],
        at=list(scenes)[0], y_scale="log", on_top=True,
        note="Each curve is the front of a model: the runs for which no other run of the model has less time "
             "and a smaller error. "
             + (f"Smaller errors than these are not known, because the reference is not exact: "
                f"{', '.join(uncertain)}. " if uncertain else "") + "Click a point to open its run.")
    messages = ". ".join(message(scene, stated) for scene, (stated, _) in scenes.items())
    section.add_chart(
        "within", "Models near the stated cloth", "name", ["ms"], ["within"], id="levels", held=["scene"],
        at=list(scenes)[0], scale="band", look="", y_scale="log",
        note="CPU time per frame of the cheapest run of each model within an error from the stated cloth. A "
             f"model without a mark has no run with so small an error. {messages}.")


def message(scene, stated):
    """Text: which models reach errors of 5 % and 1 % in the least time in a scene."""
    parts = []
    for level in LEVELS[1:]:
        run = reaching(stated, level)
        if level not in known_levels(stated):
            parts.append(f"errors of {level} % are not known")
        elif run:
            parts.append(f"{name_of(run.model)} reaches {level} % in the least time, "
                         f"{number(cost(run), 2)} ms")
        else:
            parts.append(f"none of the {len(stated)} runs reaches {level} %")
    return f"{scene[:1].upper()}{scene[1:]}: {', '.join(parts)}"
