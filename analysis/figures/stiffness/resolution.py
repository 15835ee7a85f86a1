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
        measured = [run for run in own_runs if np.isfinite(strips.rigidity(run))]
        ratios.append({"model": model, "mesh": strips.MESH_NAMES[family], "whole": ratio,
                       "ratio": strips.largest_ratio(map(strips.rigidity, measured)),
                       "cells": strips.cells_range(measured)})
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
    section.add_table("ratios", "Largest over smallest B of a strip at all resolutions with a B", [
        "model", "mesh", "cells", ("ratio", "largest ratio")], sorted(ratios, key=lambda row: row["model"]))
    section.add_chart(
        "resolution", _title(runs, ratios), "cells", ["B"], held=["mesh"], scale="log2", y_scale="log",
        note="The model none does not resist bending. A strip that hangs straight down has no point.")


def _title(runs, ratios):
    """The title: the factors of the models that have a B at every resolution."""
    coarsest, finest = strips.cells_range(runs)
    of_others = {row["model"] for row in ratios} - {*CLAIMED, "none"}
    parts = []
    for whose, models in (("the paper's models", CLAIMED), ("other models", of_others)):
        factors = [row["whole"] for row in ratios if row["model"] in models and np.isfinite(row["whole"])]
        parts += [f"the stiffness of {whose} changes by factors of {span(factors, 2)}"] if factors else []
    return f"From {coarsest} to {finest} cells {', '.join(parts)}" if parts else "Stiffness over resolution"


def _levels(runs):
    """The levels m (eq. 6) from the coarsest to the finest mesh, as text; – for a model without levels."""
    levels = [strips.number(run, "model_m") for run in sorted(runs, key=strips.cells)]
    return ", ".join(f"{level:.0f}" for level in levels if np.isfinite(level)) or "–"
