"""Stiffness over resolution with the paper's settings: every model on four kinds of mesh."""
import numpy as np

from tables.numbers import number
from runs import strips
from bendlab.results.load import group
from tables.chart import Chart
from tables.section import Check
from tables.table import Table

CLAIMED = ("adaptive", "lod")  # the paper's own models


def main(results, out, section):
    runs = strips.experiment_runs(results, section, "resolution", "resolution_slow")
    for (model, family), own_runs in group(runs, lambda run: (run.model, strips.family(run))).items():
        if model in CLAIMED:
            section.checks.append(Check("largest ratio of B between two resolutions", model,
                                        _range(own_runs, family), 1.15, ratio(own_runs), 0,
                                        "the paper: the stiffness does not change with resolution", "most",
                                        note=f"level m {_levels(own_runs)}"))
    if not runs:
        return
    section.tables += [_table(runs), _ratios(runs)]
    section.charts.append(Chart(
        "resolution", _title(section.table("ratios"), runs), "resolution", "cells", ["B"], held=["mesh"],
        scale="log2", y_scale="log",
        note="The model none does not resist bending. A strip that hangs straight down has no point."))


def ratio(runs):
    """Largest over smallest B of these runs, which have one model and one kind of mesh."""
    return strips.largest_ratio([strips.rigidity(run) for run in runs])


def _levels(runs):
    """The levels m (eq. 6) from the coarsest to the finest mesh, as text; – for a model without levels."""
    levels = [strips.number(run, "model_m") for run in sorted(runs, key=strips.cells)]
    return ", ".join(f"{level:.0f}" for level in levels if np.isfinite(level)) or "–"


def _range(runs, family):
    counts = sorted({strips.cells(run) for run in runs})
    return f"{strips.MESH_NAMES[family]}, {counts[0]} to {counts[-1]} cells"


def _title(ratios, runs):
    counts = sorted({strips.cells(run) for run in runs})
    ends = lambda models: " to ".join(number(pick(row["ratio"] for row in ratios if row["model"] in models
                                                  and np.isfinite(row["ratio"])), 2) for pick in (min, max))
    other_models = {row["model"] for row in ratios} - {*CLAIMED, "none"}
    return (f"From {counts[0]} to {counts[-1]} cells the stiffness of the paper's models changes by factors "
            f"of {ends(CLAIMED)}, the stiffness of other models by {ends(other_models)}")


def _table(runs):
    rows = [{"model": run.model, "mesh": strips.MESH_NAMES[strips.family(run)], "cells": strips.cells(run),
             "B": strips.rigidity(run), "m": strips.number(run, "model_m")}
            for run in sorted(runs, key=lambda run: (run.model, strips.family(run), strips.cells(run)))]
    return Table.of("resolution", "Flexural rigidity from H/W", [
        "model", "mesh", ("cells", "cells along the strip"), ("B", "B from H/W", "", "N m"),
        ("m", "level m of eq. 6", ".0f")], rows)


def _ratios(runs):
    rows = [{"model": model, "mesh": strips.MESH_NAMES[family], "ratio": ratio(own_runs),
             "cells": (min(map(strips.cells, own_runs)), max(map(strips.cells, own_runs)))}
            for (model, family), own_runs in group(sorted(runs, key=lambda run: run.model),
                                                   lambda run: (run.model, strips.family(run))).items()]
    return Table.of("ratios", "Largest over smallest B of a strip at all resolutions",
                    ["model", "mesh", "cells", ("ratio", "largest ratio")], rows)
