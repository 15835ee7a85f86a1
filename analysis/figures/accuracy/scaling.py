"""How the cost for a given error grows with the mesh, and how accurate motions are."""
import numpy as np

from bendlab.results.load import by_model, group
from figures.accuracy.measures import (cells, complete_runs, cost, error, front_rows, gap, name_of, row,
                                       settings, solver_error, table)
from tables.numbers import finite, number, shortened, slope

LEVEL, MOTION = 0.01, 0.05  # largest errors from the model's own equilibrium and own motion, in sizes
ERROR = f"an error of {100 * LEVEL:g} %"


def main(results, out, section):
    sizes = complete_runs(results, section, "resolution", "resolution_slow")
    swing = complete_runs(results, section, "swing_slow")
    growth = growth_rows(sizes)
    motion = [row(run) | {
        "worst": 100 * error(run, "rms_worst", "solver"),
        "known": gap([run], "solver") <= 0.1 * solver_error(run),
        "energy": 100 * error(run, "energy", "solver"), "gap": 100 * gap([run], "solver")}
        for own_runs in by_model(swing).values() for run in sorted(own_runs, key=cost)]
    most = max(finite(moved["energy"] / 100 for moved in motion), default=np.nan)
    section.tables = [
        table("sizes", "Error over substeps, in single precision", [
            "name", "cells", ("substeps", "substeps of one symmetric iteration"), "error_solver", "ms"],
            map(row, sizes)),
        table("growth", f"Time for {ERROR}", [
            "name", "cells", ("vertices", "vertices", ".0f"), "ms",
            ("power", "power p of time ∝ verticesᵖ", ".2f")], growth),
        table("motion", "Motion of each model, compared with its own motion in 4096 substeps. Energy: how "
                        "far the energy gained since the start differs from that of the reference, divided "
                        "by weight times size. The energy of a membrane is squared strain over compliance. "
                        "With too few iterations the cloth is stretched to a multiple of its length, and the "
                        f"energy is up to {number(shortened(most, 2), 2)} times weight times size. The "
                        "energy then shows the stretch, not the motion.", [
            "name", "settings", "ms", ("error_solver", "distance from its motion", "", "%"),
            ("worst", "worst frame", "", "%"), ("energy", "energy", "", "%"),
            ("gap", "uncertainty of the reference", "", "%"), ("known", "at most a tenth of the distance")],
            motion),
        table("swing", "", ["name", "settings", "ms", "error_solver"], [
            best for own_runs in by_model(swing).values() for best in front_rows(own_runs, "solver")])]
    section.add_chart(
        "growth", _growth_title(growth), "vertices", ["ms"], ["name"], y_scale="log",
        note=f"CPU time per frame for {ERROR}: logarithmic interpolation between measured runs.")
    section.add_chart("sizes", "Finer meshes need more substeps", "substeps", ["error_solver"], ["name"],
                      held=["cells"], scale="log2", y_scale="log",
                      limits=[("error_solver", 100 * LEVEL, f"{100 * LEVEL:g} %")],
                      note="Rounding errors grow in very short substeps.")
    section.add_chart(
        "swing", motion_message(swing), "ms", ["error_solver"], ["name"], id="motion", y_scale="log",
        note="A horizontal sheet is released and swings for 1 s with a damping rate of 1/s. The error is a "
             "mean over 20 frames. The reference of each model is the motion of the same model with 4096 "
             "substeps, so these errors do not say which model is right. Each curve has the runs of a model "
             "with the least time for their error.")


def cost_at(runs, level):
    """CPU time per frame (ms) for an error of `level`, interpolated linearly in logarithms between two runs.
    NaN if `level` is not between the errors of two runs."""
    points = [(cost(run), solver_error(run)) for run in sorted(runs, key=cost)]
    for (ms, error_before), (next_ms, error_after) in zip(points, points[1:]):
        if error_after <= level < error_before:
            share = np.log(error_before / level) / np.log(error_before / error_after)
            return float(np.exp(np.log(ms) + share * np.log(next_ms / ms)))
    return np.nan


def growth_rows(runs):
    """For every model and mesh, the time for an error of LEVEL, and the power with which it grows."""
    rows = []
    for model, own_runs in by_model(runs).items():
        own = [{"model": model, "name": name_of(model), "cells": count,
                "vertices": of_size[0].summary["vertices"], "ms": cost_at(of_size, LEVEL)}
               for count, of_size in sorted(group(own_runs, cells).items())]
        power = slope([size["vertices"] for size in own], [size["ms"] for size in own])
        rows += [size | {"power": power} for size in own]
    return rows


def _growth_title(rows):
    powers = {size["name"]: size["power"] for size in rows if np.isfinite(size["power"])}
    if not powers:
        return f"Time to {ERROR} for several sizes of the mesh"
    text = ", ".join(f"{name} V^{power:.1f}" for name, power in powers.items())
    how = "grows faster than" if min(powers.values()) > 1 else "over"
    return f"Time for {ERROR} {how} the number V of vertices: {text}"


def motion_message(runs):
    """Text: the setting with which most models stay near their own motions, and its cost."""
    kept = group([run for run in runs if solver_error(run) <= MOTION], settings)
    if not kept:
        return f"With no setting a model stays within {100 * MOTION:g} % of its own motion"
    middle = {setting: np.median(list(map(cost, same))) for setting, same in kept.items()}
    models = {setting: len(by_model(same)) for setting, same in kept.items()}
    best = min(kept, key=lambda setting: (-models[setting], middle[setting]))
    return (f"{best}: {models[best]} of {len(by_model(runs))} models stay within {100 * MOTION:g} % of their "
            f"own motion, and take {number(middle[best], 2)} ms (median)")
