"""Stiffness over resolution with the paper's settings: every model on four kinds of mesh."""
import numpy as np

from bendlab.results.load import group
from runs import strips
from tables.numbers import span

CLAIMED = ("adaptive", "lod")  # the paper's own models


def main(results, out, section):
    runs = strips.experiment_runs(results, section, "resolution", "resolution_slow")
    if not runs:
        return
    ratios = []
    for (model, family), own_runs in group(runs, lambda run: (run.model, strips.family(run))).items():
        ratio = strips.largest_ratio(map(strips.rigidity, own_runs))
        ratios.append({"model": model, "mesh": strips.MESH_NAMES[family], "ratio": ratio,
                       "cells": strips.cells_range(own_runs)})
        if model in CLAIMED:
            section.add_check("largest ratio of B between two resolutions", model,
                              strips.meshes_name(own_runs), 1.15, ratio, 0,
                              "the paper: the stiffness does not change with resolution", "most",
                              note=f"level m {_levels(own_runs)}")
    rows = [{"model": run.model, "mesh": strips.mesh_kind(run), "cells": strips.cells(run),
             "B": strips.rigidity(run), "m": strips.number(run, "model_m")}
            for run in sorted(runs, key=lambda run: (run.model, strips.family(run), strips.cells(run)))]
    section.add_table("resolution", "Flexural rigidity from H/W", [
        "model", "mesh", ("cells", "cells along the strip"), ("B", "B from H/W", "", "N m"),
        ("m", "level m of eq. 6", ".0f")], rows)
    section.add_table("ratios", "Largest over smallest B of a strip at all resolutions", [
        "model", "mesh", "cells", ("ratio", "largest ratio")], sorted(ratios, key=lambda row: row["model"]))
    coarsest, finest = strips.cells_range(runs)
    others = {row["model"] for row in ratios} - {*CLAIMED, "none"}
    factors = lambda models: span([row["ratio"] for row in ratios
                                   if row["model"] in models and np.isfinite(row["ratio"])], 2)
    section.add_chart(
        "resolution", f"From {coarsest} to {finest} cells the stiffness of the paper's models changes by "
        f"factors of {factors(CLAIMED)}, the stiffness of other models by {factors(others)}",
        "cells", ["B"], held=["mesh"], scale="log2", y_scale="log",
        note="The model none does not resist bending. A strip that hangs straight down has no point.")


def _levels(runs):
    """The levels m (eq. 6) from the coarsest to the finest mesh, as text; – for a model without levels."""
    levels = [strips.number(run, "model_m") for run in sorted(runs, key=strips.cells)]
    return ", ".join(f"{level:.0f}" for level in levels if np.isfinite(level)) or "–"
