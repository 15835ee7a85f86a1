"""The share of the stated stiffness that a run has: the program's estimate against the measured share."""
import numpy as np

from tables.numbers import number
from bendlab.results import registry
from runs import strips
from bendlab.results.load import by_model, group
from tables.chart import Chart
from tables.section import Check
from tables.table import Table

TOLERANCE = 0.2  # relative error of the estimate
CHECKED = 0.01  # smaller shares are shown but not checked: whether 0.1 or 0.2 % does not matter


def main(results, out, section):
    runs = strips.experiment_runs(results, section, "effective")
    rows = shares(runs)
    section.text += " " + doubling_text(rows)
    for row in rows:
        if row["measured"] >= CHECKED:
            section.checks.append(Check(f"effective bending stiffness, {row['solver']}", row["model"],
                                        row["mesh"], row["measured"], row["estimate"], TOLERANCE,
                                        "stiffness of the strip over its stiffness in static equilibrium"))
    section.tables.append(Table.of("effective", "Effective bending stiffness", [
        "model", "solver", ("substeps", "substeps", "", "", "", False),
        ("measured", "share, measured on the strip"),
        ("estimate", "share that the program estimates"), ("off", "difference", "+.0f", "%"),
        ("promised", "substeps for 90 %", ".0f")], rows))
    section.tables.append(Table.of("once", "", [("substeps", "substeps of 1/60 s, each with one iteration"),
                                                ("share", "share of the stated stiffness"), "what"],
                                   [{"model": row["model"], "what": what, "substeps": row["substeps"],
                                     "share": row[what]} for row in rows if row["iterations"] == 1
                                    for what in ("measured", "estimate")]))
    checked = [abs(row["off"]) for row in rows if row["measured"] >= CHECKED]
    title = "Share of the stated stiffness"
    if checked:
        title += (f", estimated within {number(max(checked), 2)} % in {len(checked)} runs with a share of at "
                  f"least {100 * CHECKED:.0f} %")
    section.charts = [
        Chart("effective", title, "effective", "measured", ["estimate"], joined=False, y_scale="log",
              theory="equal", note="On the line, the estimate is equal to the measured share. The checks "
                                   f"allow a difference of {100 * TOLERANCE:g} %."),
        Chart("substeps_effective", "The share of the stated stiffness over substeps", "once", "substeps",
              ["share"],
              ["model", "what"], scale="log2", y_scale="log", limits=[("share", 0.9, "90 %")])]
    least = min((row["measured"] for row in rows if row["estimate"] > 0), default=1)
    section.tables.append(Table.of("equal", "", ["model", "measured", "estimate"], [
        {"model": "equal", "measured": share, "estimate": share} for share in (least, 1)]))


def shares(runs):
    """A row for each run with an estimate, if the model also has a run of static equilibrium."""
    rows = []
    for model, own_runs in by_model(runs).items():
        static = [run for run in own_runs if run.get("/solver/method") == "equilibrium"]
        for run in own_runs if static else []:
            estimate = strips.number(run, "effective_bending_stiffness")
            measured = strips.measured(run) / strips.measured(static[0])
            if run in static or not np.isfinite(estimate) or not np.isfinite(measured):
                continue
            substeps, iterations = run.get("/solver/substeps"), run.get("/solver/iterations")
            rows.append({"model": model, "mesh": strips.mesh_name(run), "substeps": substeps,
                         "iterations": iterations, "solver": f"{substeps} × {iterations}",
                         "measured": measured, "estimate": estimate,
                         "off": 100 * (estimate / measured - 1),
                         "promised": strips.number(run, "substeps_for_90_percent_bending")})
    return sorted(rows, key=lambda row: (registry.model_place(row["model"]), -row["iterations"],
                                         row["substeps"]))


def doubling_text(rows):
    """Text: by how much each doubling of the substeps reduces 1 / share - 1, for hinges and for springs."""
    removed = {"hinges": [], "springs": []}
    for model, own_rows in group([row for row in rows if row["iterations"] == 1],
                                 lambda row: row["model"]).items():
        for coarse, fine in zip(own_rows, own_rows[1:]):
            doublings = np.log2(fine["substeps"] / coarse["substeps"])
            left = [1 / row["measured"] - 1 for row in (coarse, fine)]
            if min(left) > 0:
                removed["springs" if registry.made_of(model) == "springs"
                        else "hinges"].append(1 - (left[1] / left[0]) ** (1 / doublings))
    ends = {kind: [f"{100 * pick(own_rows):.0f}" for pick in (min, max)] for kind, own_rows in removed.items()
            if own_rows}
    parts = [f"by {' to '.join(dict.fromkeys(pair))} % for {kind}" for kind, pair in ends.items()]
    if not parts:
        return ""
    text = ("Each doubling of the substeps reduces 1 / share − 1, a measure of the missing stiffness, "
            + ", ".join(parts) + ".")
    if all(removed.values()) and np.median(removed["springs"]) < np.median(removed["hinges"]):
        text += " The reduction is smaller for springs because the membrane must converge as well."
    return text
