"""How the cost for a given error grows with the mesh, and how accurate motions are."""
import numpy as np

from bendlab.results.load import by_model, group
from figures.accuracy import measures
from tables.chart import Chart
from tables.numbers import number

LEVEL, MOTION = 0.01, 0.05  # largest errors from the model's own equilibrium and own motion, in sizes


def main(results, out, section):
    sizes = [run for run in measures.experiment_runs(results, section, "resolution", "resolution_slow")
             if run.complete]
    swing = [run for run in measures.experiment_runs(results, section, "swing_slow") if run.complete]
    if sizes:
        section.tables += [measures.table("sizes", "Error over substeps, in single precision", [
            "name", "cells", ("substeps", "substeps of one symmetric iteration"), "error_solver", "ms"],
            [measures.row(run) for run in sizes]), _growth_table(sizes)]
        section.charts += [
            Chart("growth", _growth_title(section.table("growth")), "growth", "vertices", ["ms"], ["name"],
                  y_scale="log", note=f"CPU time per frame for an error of {100 * LEVEL:g} %: logarithmic "
                                      "interpolation between measured runs."),
            Chart("sizes", "Finer meshes need more substeps", "sizes", "substeps", ["error_solver"], ["name"],
                  held=["cells"], scale="log2", y_scale="log",
                  limits=[("error_solver", 100 * LEVEL, f"{100 * LEVEL:g} %")],
                  note="Rounding errors grow in very short substeps.")]
    if swing:
        section.tables += [_motion_table(swing),
                           measures.table("swing", "", ["name", "settings", "ms", "error_solver"], [
            measures.row(run) for own_runs in by_model(swing).values()
                               for run in measures.front(own_runs, against="solver")])]
        section.charts.append(Chart(
            "motion", motion_message(swing), "swing", "ms", ["error_solver"], ["name"], y_scale="log",
            note="A horizontal sheet is released and swings for 1 s with a damping rate of 1/s. The error is "
                 "a mean over 20 frames. The reference of each model is the motion of the same model with "
                 "4096 substeps, so these errors do not say which model is right. Each curve has the runs "
                 "of a model with the least time for their error."))


def cost_at(runs, level):
    """CPU time per frame (ms) for an error of `level`, interpolated linearly in logarithms between two runs.
    NaN if `level` is not between the errors of two runs."""
    runs = sorted(runs, key=measures.cost)
    cost = np.array([measures.cost(run) for run in runs])
    error = np.array([measures.error(run, against="solver") for run in runs])
    for i in range(1, len(runs)):
        if error[i] <= level < error[i - 1]:
            share = np.log(error[i - 1] / level) / np.log(error[i - 1] / error[i])
            return float(np.exp(np.log(cost[i - 1]) + share * np.log(cost[i] / cost[i - 1])))
    return np.nan


def _growth_table(runs):
    rows = []
    for model, own_runs in by_model(runs).items():
        own = [{"model": model, "name": measures.name_of(model), "cells": cells,
                "vertices": of_size[0].summary["vertices"], "ms": cost_at(of_size, LEVEL)}
               for cells, of_size in sorted(group(own_runs, lambda run: run.get("/mesh/cells")).items())]
        power = measures.slope([row["vertices"] for row in own], [row["ms"] for row in own])
        rows += [row | {"power": power} for row in own]
    return measures.table("growth", f"Time for an error of {100 * LEVEL:g} %", [
        "name", "cells", ("vertices", "vertices", ".0f"), "ms",
        ("power", "power p of time ∝ verticesᵖ", ".2f")], rows)


def _growth_title(rows):
    powers = {row["name"]: row["power"] for row in rows if np.isfinite(row["power"])}
    text = ", ".join(f"{name} V^{power:.1f}" for name, power in powers.items())
    if not powers:
        return f"Time to an error of {100 * LEVEL:g} % for several sizes of the mesh"
    how = "grows faster than" if min(powers.values()) > 1 else "over"
    return f"Time for an error of {100 * LEVEL:g} % {how} the number V of vertices: {text}"


def known(run):
    """Whether the uncertainty of the reference is at most a tenth of the run's distance from it."""
    return measures.gap([run], "solver") <= 0.1 * measures.error(run, against="solver")


def motion_message(runs):
    """Text: the setting with which most models stay near their own motions, and its cost."""
    models = len(by_model(runs))
    kept = group([run for run in runs if measures.error(run, against="solver") <= MOTION], measures.settings)
    if not kept:
        return f"With no setting a model stays within {100 * MOTION:g} % of its own motion"
    middle = {setting: np.median([measures.cost(run) for run in same]) for setting, same in kept.items()}
    best = min(kept, key=lambda setting: (-len(by_model(kept[setting])), middle[setting]))
    return (f"{best}: {len(by_model(kept[best]))} of {models} models stay within {100 * MOTION:g} % "
            f"of their own motion, and take {number(middle[best], 2)} ms (median)")


def _motion_table(runs):
    rows = [measures.row(run) | {
        "worst": 100 * measures.error(run, "rms_worst", "solver"), "known": known(run),
        "energy": 100 * measures.error(run, "energy", "solver"), "gap": 100 * measures.gap([run], "solver")}
        for own_runs in by_model(runs).values() for run in sorted(own_runs, key=measures.cost)]
    return measures.table(
        "motion", "Motion of each model, compared with its own motion in 4096 substeps. Energy: "
                  "how far the energy gained since the start differs from that of the reference, divided by "
                  "weight times size. The energy of a membrane is squared strain over compliance. With "
                  "too few iterations the cloth is stretched to a multiple of its length, and the energy is "
                  "thousands of times weight times size. The energy then shows the stretch, not the motion.",
        ["name", "settings", "ms", ("error_solver", "distance from its motion", "", "%"),
         ("worst", "worst frame", "", "%"), ("energy", "energy", "", "%"),
         ("gap", "uncertainty of the reference", "", "%"), ("known", "at most a tenth of the "
                                                                     "distance")], rows)
