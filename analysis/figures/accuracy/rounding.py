"""Rounding errors of single precision in short substeps: of a fall, a hanging strip and a soft strip."""
import numpy as np

from figures.accuracy import measures
from tables.chart import Chart
from tables.table import Table

GRAVITY, DENSITY, COMPLIANCE = 9.81, 0.2, 0.01  # m/s², kg/m², m/N, as in the configs


def fall_error(run):
    """Relative error of a fall. In substeps of h the exact fall is g t (t + h) / 2."""
    time = float(run.metrics["time"][-1])
    substep = run.get("/solver/dt") / run.get("/solver/substeps")
    expected = GRAVITY * time * (time + substep) / 2
    return abs(run.summary["drop_last"] / expected - 1)


def length_error(run):
    """Relative error of the length of a strip. The exact length is 1 m."""
    return abs(run.summary["drop_last"] - 1)


def elongation_error(run):
    """Relative error of the elongation of a strip. The exact elongation is ρ g L² / 2Y with L = 1 m."""
    expected = DENSITY * GRAVITY * COMPLIANCE / 2
    return abs((run.summary["drop_last"] - 1) / expected - 1)


# config → (scene, error, bound for single precision)
SCENES = {"rounding_fall": ("free fall of 0.5 s", fall_error, 1e-4),
          "rounding_strip": ("length of a hanging strip", length_error, 1e-3),
          "rounding_membrane": ("elongation of a soft strip", elongation_error, 1e-2)}


def main(results, out, section):
    panels = [(scene, error, bound, measures.experiment_runs(results, section, name))
              for name, (scene, error, bound) in SCENES.items()]
    if not all(runs for *_, runs in panels):
        return
    rows = [{"scene": scene, "precision": run.get("/solver/precision"),
             "substeps": run.get("/solver/substeps"),
             "error": max(error(run), 1e-9), "of_bound": max(error(run), 1e-9) / bound}
            for scene, error, bound, runs in panels for run in runs]
    finest = max(row["substeps"] for row in rows)
    last = [row["of_bound"] for row in rows if row["precision"] == "single" and row["substeps"] == finest]
    section.tables.append(Table.of("rounding", "Errors relative to closed forms", [
        "scene", "precision", ("substeps", "substeps of 1/60 s"), ("error", "relative error"),
        ("of_bound", "error over the bound for single precision")], rows))
    section.charts.append(Chart(
        "rounding", f"With {finest} substeps single precision stays within "
                    f"{sum(share <= 1 for share in last)} of {len(last)} bounds", "rounding", "substeps",
        ["of_bound", "error"], ["precision"], held=["scene"],
        scale="log2", y_scale="log", look="", limits=[("of_bound", 1, "the bound")],
        note=f"Up to {alike_until(panels)} substeps the errors of both precisions differ by less than 10 %: "
             "these errors come from the solver, not from rounding."))


def alike_until(panels):
    """The largest number of substeps up to which, in all panels, the errors of both precisions differ by less
    than a tenth."""
    ends = []
    for _, error, _, runs in panels:
        errors = {(run.get("/solver/precision"), run.get("/solver/substeps")): error(run) for run in runs}
        end = 0
        for substeps in sorted({substeps for _, substeps in errors}):
            single, double = (errors.get((precision, substeps), np.nan) for precision in ("single", "double"))
            if not abs(single - double) <= 0.1 * double:
                break
            end = substeps
        ends.append(end)
    return min(ends)
