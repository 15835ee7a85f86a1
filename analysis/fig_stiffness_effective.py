"""What the solver makes of the told stiffness: each run's own estimate against its strip."""
import matplotlib.pyplot as plt
import numpy as np

import strips
import style
from load import group
from report import Check, Section, Table, figure_main

SPRINGS = ("adaptive", "lod", "sparse_lod")  # their stiffness is C of m = C κ³
TOLERANCE = 0.2  # relative, of the estimate
CHECKED = 0.01  # a share below this is told, but no one asks whether it is 0.1 or 0.2 %


def main(results, out):
    section = Section("What the solver makes of the told stiffness", "effective")
    runs = strips.experiment_runs(results, section, "effective")
    section.text = ("A solver that has not converged leaves the cloth softer than it was told. Every run with a compliance "
                    "or a physical stiffness says by how much, as effective_bending_stiffness: the share of the told "
                    "stiffness, estimated from the multipliers of its last second, without another run. Here each estimate "
                    "stands against the stiffness that the run's strip shows (B or C from H/W), as a share of what the static "
                    "equilibrium of the same energies shows. Of 1 / share − 1 three quarters or more go with every doubling "
                    "of the substeps for hinges, and less for springs, because the membrane has to converge as well.")
    rows = shares(runs)
    for row in rows:
        if row["measured"] >= CHECKED:
            section.checks.append(Check(f"effective bending stiffness, {row['solver']}", row["model"], row["mesh"],
                                        row["measured"], row["estimate"], TOLERANCE,
                                        "the strip's droop against its static equilibrium"))
    if rows:
        section.pictures.append((_picture(rows, out),
                                 "Left: estimate against measurement, a point per run; between the dotted lines they differ by "
                                 "at most 20 %. Right: the measured share (solid) and the estimate (dashed) against the "
                                 "substeps, one iteration each."))
    section.tables.append(Table("Effective bending stiffness", ["model", "solver", "measured", "estimate", "off by (%)",
                                                                "substeps for 90 %"],
                                [[row["model"], row["solver"], style.number(row["measured"], 3),
                                  style.number(row["estimate"], 3),
                                  f"{100 * (row['estimate'] / row['measured'] - 1):+.0f}",
                                  f"{row['promised']:.0f}" if np.isfinite(row["promised"]) else ""] for row in rows]))
    return section


def shares(runs):
    """A dict per run that has an estimate and a static equilibrium beside it."""
    rows = []
    for model, some in strips.by_model(runs).items():
        name = "stiffness_quartic" if model in SPRINGS else "stiffness_flexural_rigidity"
        static = [run for run in some if run.get("/solver/method") == "equilibrium"]
        for run in some if static else []:
            estimate = strips.number(run, "effective_bending_stiffness")
            measured = strips.number(run, name) / strips.number(static[0], name)
            if run in static or not np.isfinite(estimate) or not np.isfinite(measured):
                continue
            substeps, iterations = run.get("/solver/substeps"), run.get("/solver/iterations")
            rows.append({"model": model, "mesh": strips.mesh_name(run), "substeps": substeps, "iterations": iterations,
                         "solver": f"{substeps} × {iterations}", "measured": measured, "estimate": estimate,
                         "promised": strips.number(run, "substeps_for_90_percent_bending")})
    return sorted(rows, key=lambda row: (list(style.MODEL_COLOURS).index(row["model"]), -row["iterations"], row["substeps"]))


def _picture(rows, out):
    figure, (left, right) = plt.subplots(1, 2, figsize=(10.4, 4.2), layout="constrained")
    shown = [row for row in rows if row["estimate"] > 0]
    least = 0.5 * min(min(row["measured"], row["estimate"]) for row in shown)
    ends = np.array([least, 1.5])
    left.plot(ends, ends, color=style.INK, linewidth=0.8)
    for factor in (1 - TOLERANCE, 1 + TOLERANCE):
        left.plot(ends, factor * ends, ":", color=style.GREY, linewidth=0.8)
    for model, some in group(shown, lambda row: row["model"]).items():
        look = {"color": style.MODEL_COLOURS[model], "marker": "s" if model in SPRINGS else "o"}
        left.plot([row["measured"] for row in some], [row["estimate"] for row in some], linestyle="", markersize=6,
                  alpha=0.8, label=style.MODEL_NAMES[model], **look)
        once = [row for row in some if row["iterations"] == 1]
        right.plot([row["substeps"] for row in once], [row["measured"] for row in once], "-", markersize=4, **look)
        right.plot([row["substeps"] for row in once], [row["estimate"] for row in once], "--", color=look["color"],
                   linewidth=1)
    left.set_xscale("log"), left.set_yscale("log"), left.set_xlim(ends), left.set_ylim(ends)
    left.set_xlabel("share measured on the strip"), left.set_ylabel("share estimated")
    left.legend(loc="upper left")
    right.axhline(0.9, color=style.GREY, linewidth=0.8)
    right.set_xscale("log", base=4), right.xaxis.set_major_formatter("{x:.0f}")
    right.set_yscale("log")
    right.set_xlabel("substeps of 1/60 s"), right.set_ylabel("share of the told stiffness")
    checked = [abs(row["estimate"] / row["measured"] - 1) for row in rows if row["measured"] >= CHECKED]
    title = "What is left of the told stiffness"
    if checked:
        title += (f": estimated within {style.number(100 * max(checked), 2)} % on {len(checked)} runs with more than "
                  f"{100 * CHECKED:.0f} % of it")
    figure.suptitle(title, x=0.01, ha="left", fontsize=11.5)
    return style.save(figure, out, "fig_stiffness_effective")


if __name__ == "__main__":
    figure_main(main)
