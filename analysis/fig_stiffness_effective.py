"""Share of the stated stiffness that a run has: its own estimate compared with its strip."""
import right_python  # noqa: F401  (first: it may hand over to another Python)
import matplotlib.pyplot as plt
import numpy as np

from bendlab.results import registry
import strips
import style
from bendlab.results.load import by_model, group
from report import Check, Section, Table, figure_main

TOLERANCE = 0.2  # relative error of the estimate
CHECKED = 0.01  # smaller shares are shown but not checked: whether 0.1 or 0.2 % does not matter


def main(results, out):
    section = Section("Share of the stated stiffness that the solver gives", "effective")
    runs = strips.experiment_runs(results, section, "effective")
    section.text = ("Without convergence of the solver the cloth is softer than stated. Every run with a "
                    "compliance or a physical stiffness estimates by how much: effective_bending_stiffness "
                    "is the share of the stated stiffness, computed from the multipliers of the last second, "
                    "without another run. Here each estimate is compared with the measured share: the "
                    "stiffness of the run's strip (B or C from H/W) over that of the static equilibrium of "
                    "the same energies. " + doubling_text(shares(runs)))
    rows = shares(runs)
    for row in rows:
        if row["measured"] >= CHECKED:
            section.checks.append(Check(f"effective bending stiffness, {row['solver']}", row["model"],
                                        row["mesh"], row["measured"], row["estimate"], TOLERANCE,
                                        "the strip's droop over that in static equilibrium"))
    if rows:
        section.pictures.append((_picture(rows, out), "Left: estimate over measurement, one point per run; "
                                 f"between the dotted lines they differ by at most {100 * TOLERANCE:g} %. "
                                 "Right: measured share (solid) and estimate (dashed) over substeps of one "
                                 "iteration."))
    section.tables.append(Table("Effective bending stiffness",
                                ["model", "solver", "measured", "estimate", "difference (%)",
                                 "substeps for 90 %"],
                                [[row["model"], row["solver"], style.number(row["measured"], 3),
                                  style.number(row["estimate"], 3),
                                  f"{100 * (row['estimate'] / row['measured'] - 1):+.0f}",
                                  f"{row['promised']:.0f}" if np.isfinite(row["promised"]) else ""]
                                 for row in rows]))
    return section


def shares(runs):
    """A dict per run that has an estimate and a static run of the same model."""
    rows = []
    for model, some in by_model(runs).items():
        static = [run for run in some if run.get("/solver/method") == "equilibrium"]
        for run in some if static else []:
            estimate = strips.number(run, "effective_bending_stiffness")
            measured = strips.measured(run) / strips.measured(static[0])
            if run in static or not np.isfinite(estimate) or not np.isfinite(measured):
                continue
            substeps, iterations = run.get("/solver/substeps"), run.get("/solver/iterations")
            rows.append({"model": model, "mesh": strips.mesh_name(run), "substeps": substeps,
                         "iterations": iterations, "solver": f"{substeps} × {iterations}",
                         "measured": measured, "estimate": estimate,
                         "promised": strips.number(run, "substeps_for_90_percent_bending")})
    return sorted(rows, key=lambda row: (registry.model_place(row["model"]), -row["iterations"],
                                         row["substeps"]))


def doubling_text(rows):
    """How much of 1 / share - 1 one doubling of the substeps removes, for hinges and springs."""
    removed = {"hinges": [], "springs": []}
    for model, some in group([row for row in rows if row["iterations"] == 1],
                             lambda row: row["model"]).items():
        for coarse, fine in zip(some, some[1:]):
            doublings = np.log2(fine["substeps"] / coarse["substeps"])
            left = [1 / row["measured"] - 1 for row in (coarse, fine)]
            if min(left) > 0:
                removed["springs" if registry.made_of(model) == "springs"
                        else "hinges"].append(1 - (left[1] / left[0]) ** (1 / doublings))
    ends = {kind: [f"{100 * pick(some):.0f}" for pick in (min, max)] for kind, some in removed.items()
            if some}
    parts = [f"for {kind} it removes {' to '.join(dict.fromkeys(pair))} %" for kind, pair in ends.items()]
    if not parts:
        return ""
    text = "Each doubling of the substeps reduces the missing stiffness 1 / share − 1: " + ", ".join(
        parts) + "."
    if all(removed.values()) and np.median(removed["springs"]) < np.median(removed["hinges"]):
        text += " It removes less for springs because the membrane has to converge as well."
    return text


def _picture(rows, out):
    figure, (left, right) = plt.subplots(1, 2, figsize=(10.4, 4.2), layout="constrained")
    shown = [row for row in rows if row["estimate"] > 0]
    least = 0.5 * min(min(row["measured"], row["estimate"]) for row in shown)
    ends = np.array([least, 1.5])
    left.plot(ends, ends, color=style.INK, linewidth=0.8)
    for factor in (1 - TOLERANCE, 1 + TOLERANCE):
        left.plot(ends, factor * ends, ":", color=style.GREY, linewidth=0.8)
    for model, some in group(shown, lambda row: row["model"]).items():
        left.plot([row["measured"] for row in some], [row["estimate"] for row in some],
                  label=style.model_name(model), **style.look(model, linestyle=""))
        once = [row for row in some if row["iterations"] == 1]
        right.plot([row["substeps"] for row in once], [row["measured"] for row in once],
                   label=style.model_name(model), **style.look(model, linestyle="-"))
        right.plot([row["substeps"] for row in once], [row["estimate"] for row in once], "--",
                   color=style.colour(model), linewidth=1)
    left.set_xscale("log"), left.set_yscale("log"), left.set_xlim(ends), left.set_ylim(ends)
    left.set_xlabel("share measured on the strip"), left.set_ylabel("share estimated")
    left.legend(loc="upper left")
    right.axhline(0.9, color=style.GREY, linewidth=0.8)
    right.set_xscale("log", base=4), right.xaxis.set_major_formatter("{x:.0f}")
    right.set_yscale("log")
    right.set_xlabel("substeps of 1/60 s"), right.set_ylabel("share of the stated stiffness")
    checked = [abs(row["estimate"] / row["measured"] - 1) for row in rows if row["measured"] >= CHECKED]
    title = "Share of the stated stiffness"
    if checked:
        title += (f": estimated within {style.number(100 * max(checked), 2)} % for the {len(checked)} runs "
                  f"with at least {100 * CHECKED:.0f} % of it")
    figure.suptitle(title, x=0.01, ha="left", fontsize=11.5)
    style.label_ends(right)
    return style.save(figure, out, "fig_stiffness_effective")


if __name__ == "__main__":
    figure_main(main)
