"""The share of the stated stiffness that a run has: the program's estimate against the measured share."""
import numpy as np

from bendlab.results import registry
from bendlab.results.load import by_model, group, select
from runs import strips
from tables.numbers import number, percents

TOLERANCE = 0.2  # relative error of the estimate
CHECKED = 0.01  # smaller shares are shown but not checked: whether 0.1 or 0.2 % does not matter


def main(results, out, section):
    rows = shares(strips.experiment_runs(results, section, "effective"))
    section.text += " " + doubling_text(rows)
    checked = [row for row in rows if row["measured"] >= CHECKED]
    for row in checked:
        section.add_check(f"effective bending stiffness, {row['solver']}", row["model"], row["mesh"],
                          row["measured"], row["estimate"], TOLERANCE,
                          "stiffness of the strip over its stiffness in static equilibrium")
    section.add_table("effective", "Effective bending stiffness", [
        "model", "solver", ("substeps", "substeps", "", "", "", False),
        ("measured", "share, measured on the strip"), ("estimate", "share that the program estimates"),
        ("off", "difference", "+.0f", "%"), ("promised", "substeps for 90 %", ".0f")], rows)
    section.add_table("once", "", [("substeps", "substeps of 1/60 s, each with one iteration"),
                                   ("share", "share of the stated stiffness"), "what"], [
        {"model": row["model"], "what": what, "substeps": row["substeps"], "share": row[what]}
        for row in rows if row["iterations"] == 1 for what in ("measured", "estimate")])
    least = min((row["measured"] for row in rows if row["estimate"] > 0), default=1)
    section.add_table("equal", "", ["model", "measured", "estimate"], [
        {"model": "equal", "measured": share, "estimate": share} for share in (least, 1)])
    title = "Share of the stated stiffness"
    if checked:
        title += (f", estimated within {number(max(abs(row['off']) for row in checked), 2)} % in "
                  f"{len(checked)} runs with a share of at least {100 * CHECKED:.0f} %")
    section.add_chart("effective", title, "measured", ["estimate"], joined=False, y_scale="log",
                      theory="equal", note="On the line, the estimate is equal to the measured share. The "
                                           f"checks allow a difference of {100 * TOLERANCE:g} %.")
    section.add_chart("once", "The share of the stated stiffness over substeps", "substeps", ["share"],
                      ["model", "what"], id="substeps_effective", scale="log2", y_scale="log",
                      limits=[("share", 0.9, "90 %")])


def shares(runs):
    """A row for each run with an estimate, if the model also has a run of static equilibrium."""
    rows = []
    for model, own_runs in by_model(runs).items():
        static = select(own_runs, solver__method="equilibrium")
        for run in own_runs if static else []:
            estimate = strips.number(run, "effective_bending_stiffness")
            measured = strips.measured(run) / strips.measured(static[0])
            if run not in static and np.isfinite([estimate, measured]).all():
                substeps, iterations = run.get("/solver/substeps"), run.get("/solver/iterations")
                rows.append({"model": model, "mesh": strips.mesh_name(run), "substeps": substeps,
                             "iterations": iterations, "solver": f"{substeps} × {iterations}",
                             "measured": measured, "estimate": estimate,
                             "off": 100 * (estimate / measured - 1),
                             "promised": strips.number(run, "substeps_for_90_percent_bending")})
    place = lambda row: (registry.model_place(row["model"]), -row["iterations"], row["substeps"])
    return sorted(rows, key=place)


def doubling_text(rows):
    """Text: by how much each doubling of the substeps reduces 1 / share - 1, for hinges and for springs."""
    removed = {"hinges": [], "springs": []}
    once = [row for row in rows if row["iterations"] == 1]
    for model, own_rows in group(once, lambda row: row["model"]).items():
        kind = "springs" if registry.made_of(model) == "springs" else "hinges"
        for coarse, fine in zip(own_rows, own_rows[1:]):
            before, after = (1 / row["measured"] - 1 for row in (coarse, fine))
            if min(before, after) > 0:
                doublings = np.log2(fine["substeps"] / coarse["substeps"])
                removed[kind].append(1 - (after / before)**(1 / doublings))
    parts = [f"by {percents(values)} % for {kind}" for kind, values in removed.items() if values]
    if not parts:
        return ""
    text = ("Each doubling of the substeps reduces 1 / share − 1, a measure of the missing stiffness, "
            f"{', '.join(parts)}.")
    if all(removed.values()) and np.median(removed["springs"]) < np.median(removed["hinges"]):
        text += " The reduction is smaller for springs because the membrane must converge as well."
    return text
