"""Rounding errors of single precision in short substeps: of a fall, a hanging strip and a soft strip."""
from itertools import takewhile

from bendlab.results.load import select
from figures.accuracy.measures import experiment_runs, substeps
from tables.table import Table

GRAVITY, DENSITY, COMPLIANCE = 9.81, 0.2, 0.01  # m/s², kg/m², m/N, as in the configs


def fall_error(run):
    """Relative error of a fall. In substeps of h the exact fall is g t (t + h) / 2."""
    time = float(run.metrics["time"][-1])
    exact = GRAVITY * time * (time + run.get("/solver/dt") / substeps(run)) / 2
    return abs(run.summary["drop_last"] / exact - 1)


def length_error(run):
    """Relative error of the length of a strip. The exact length is 1 m."""
    return abs(run.summary["drop_last"] - 1)


def elongation_error(run):
    """Relative error of the elongation of a strip. The exact elongation is ρ g L² / 2Y with L = 1 m."""
    return abs((run.summary["drop_last"] - 1) / (DENSITY * GRAVITY * COMPLIANCE / 2) - 1)


# config → (scene, error, bound for single precision)
SCENES = {"rounding_fall": ("free fall of 0.5 s", fall_error, 1e-4),
          "rounding_strip": ("length of a hanging strip", length_error, 1e-3),
          "rounding_membrane": ("elongation of a soft strip", elongation_error, 1e-2)}


def main(results, out, section):
    panels = [(*scene, experiment_runs(results, section, name)) for name, scene in SCENES.items()]
    if not all(runs for *_, runs in panels):
        return
    rows = [{"scene": scene, "precision": run.get("/solver/precision"), "substeps": substeps(run),
             "error": error(run), "of_bound": error(run) / bound}
            for scene, error, bound, runs in panels for run in runs]
    finest = max(row["substeps"] for row in rows)
    last = [row["of_bound"] for row in rows if row["precision"] == "single" and row["substeps"] == finest]
    alike = [f"{until} ({scene})" for scene, error, _, runs in panels if (until := alike_until(error, runs))]
    section.add_chart(
        Table.of("rounding", "Errors relative to closed forms", [
            "scene", "precision", ("substeps", "substeps of 1/60 s"), ("error", "relative error"),
            ("of_bound", "error over the bound for single precision")], rows),
        f"With {finest} substeps single precision stays within {sum(share <= 1 for share in last)} of "
        f"{len(last)} bounds", "substeps", ["of_bound", "error"], ["precision"], held=["scene"], scale="log2",
        y_scale="log", look="", limits=[("of_bound", 1, "the bound")],
        note=f"Up to {' and '.join(alike)} substeps the errors of both precisions differ by less than 10 %: "
             "these errors come from the solver, not from rounding." if alike else "")


def alike_until(error, runs):
    """The most substeps up to which the errors of both precisions differ by less than a tenth."""
    single, double = ({substeps(run): error(run) for run in select(runs, solver__precision=precision)}
                      for precision in ("single", "double"))
    alike = takewhile(lambda count: abs(single[count] - double[count]) <= 0.1 * double[count],
                      sorted(single.keys() & double.keys()))
    return max(alike, default=0)
