"""Effect of the solver on stiffness: XPBD and static equilibrium; k over iterations and time step."""
import right_python  # noqa: F401  (first: it may hand over to another Python)
import matplotlib.pyplot as plt
import numpy as np

import strips
import style
from bendlab.results.load import by_model, group
from report import Check, Section, Table, figure_main


def main(results, out):
    section = Section("XPBD against its equilibrium; k against iterations and time step", "convergence")
    dynamic = strips.experiment_runs(results, section, "xpbd", "xpbd_slow", "xpbd_48_slow", "xpbd_full")
    cheap = strips.experiment_runs(results, section, "cheap")
    iterations = strips.experiment_runs(results, section, "iterations")
    time_step = strips.experiment_runs(results, section, "time_step")
    section.text = ("Compliance (XPBD) states an energy. Thus there is one answer, the static equilibrium, "
                    "and more substeps approach it. Springs compete with the membrane and need more substeps "
                    "than hinges. The membrane of the left picture is soft (10⁻⁵ m/N): with a stiff one, "
                    "springs that fall from the flat state can come to rest in creases, another equilibrium. "
                    "k states no energy: more iterations or a smaller time step only make the sheet stiffer.")
    series = static_and_dynamic(dynamic)
    for (model, cells), (static, some) in sorted(series.items()):
        finest = max(some, key=substeps)
        section.checks.append(Check(f"H/W, XPBD with {substeps(finest)} substeps", model,
                                    strips.mesh_name(finest), strips.droop(static), strips.droop(finest),
                                    0.02, "static equilibrium of the same energies",
                                    note="springs and membrane compete" if model == "lod" else ""))
    section.checks += [_growth("B at 100 iterations over B at 1", iterations,
                               lambda run: run.get("/solver/iterations")),
                       _growth("B at 1/480 s over B at 1/30 s", time_step,
                               lambda run: -run.get("/solver/dt"))]
    if series or cheap:
        section.pictures.append((_approach(series, cheap, out), "Left: difference of H/W to the static "
                                 "equilibrium of the same energies. Right: measured (from H/W) over stated "
                                 "stiffness, 24 cells. Substeps per 1/60 s, each with one symmetric "
                                 "iteration."))
    if iterations or time_step:
        section.pictures.append((_pbd(iterations, time_step, out), "Every model with k = 0.5 on the same "
                                 "strip (equilateral lattice, 24 cells): B from H/W, with a tenth of "
                                 "gravity. For springs this B holds at this curvature only."))
    section.tables.append(Table("Approach to the equilibrium",
                                ["model", "cells", "substeps", "H/W", "H/W static"],
                                [[model, cells, substeps(run), f"{strips.droop(run):.4f}",
                                  f"{strips.droop(static):.4f}"]
                                 for (model, cells), (static, some) in sorted(series.items())
                                 for run in sorted(some, key=substeps)]))
    return section


def substeps(run):
    return run.get("/solver/substeps", 1)


def static_and_dynamic(runs):
    """(model, cells) → (static run, dynamic runs), if there are both."""
    series = {}
    for key, some in group(runs, lambda run: (run.model, strips.cells(run))).items():
        static = [run for run in some if run.get("/solver/method") == "equilibrium"]
        moving = [run for run in some if run.get("/solver/method") != "equilibrium"]
        if static and moving:
            series[key] = static[0], moving
    return series


def _growth(check, runs, setting):
    """Checks the ratio of stiffness between finest and coarsest setting, the largest of all models."""
    ratios = {}
    for model, some in by_model(runs).items():
        ends = [strips.rigidity(pick(some, key=setting)) for pick in (min, max)]
        if model != "none" and np.isfinite(ends).all():
            ratios[model] = ends[1] / ends[0]
    model = max(ratios, key=ratios.get, default="any")
    return Check(check, model, "equilateral, 24 cells", 1.15, ratios.get(model, np.nan), 0,
                 "stiffness should not depend on solver settings", "most",
                 note="the largest ratio of all models")


def _approach(series, cheap, out):
    figure, (left, right) = plt.subplots(1, 2, figsize=(10.4, 4.1), layout="constrained")
    looks = {12: ":", 24: "--", 48: "-"}
    last = []
    for (model, cells), (static, some) in sorted(series.items()):
        some = sorted(some, key=substeps)
        error = [abs(strips.droop(run) / strips.droop(static) - 1) for run in some]
        left.plot([substeps(run) for run in some], [100 * e for e in error],
                  label=f"{style.model_name(model)}, {cells} cells",
                  **style.look(model, linestyle=looks.get(cells, "-")))
        last.append(error[-1])
    left.axhline(1, color=style.GREY, linewidth=0.8)
    for panel in (left, right):
        panel.set_xscale("log", base=4)
        panel.xaxis.set_major_formatter("{x:.0f}")
        panel.set_xlabel("substeps of 1/60 s")
        panel.set_yscale("log")
    left.set_ylabel("|H/W − static| (%)")
    for model, some in by_model(cheap).items():
        some = sorted(some, key=substeps)
        share = [strips.measured(run) / strips.stated(run) for run in some]
        right.plot([substeps(run) for run in some], share, label=style.model_name(model),
                   **style.look(model))
    right.axhline(1, color=style.INK, linewidth=0.8)
    right.set_ylabel("stiffness, measured / stated")
    title = "Cheap settings give a part of the stated stiffness"
    if last:
        low, high = (style.number(100 * pick(last), 2) for pick in (min, max))
        title += f"; with the most substeps the error of H/W is {low} to {high} %"
    figure.suptitle(title, x=0.01, ha="left", fontsize=11.5)
    style.label_ends(left), style.label_ends(right)
    return style.save(figure, out, "fig_stiffness_xpbd")


def _pbd(iterations, time_step, out):
    figure, axes = plt.subplots(1, 2, figsize=(10.4, 4.3), layout="constrained", sharey=True)
    growth = []
    sides = ((iterations, lambda run: run.get("/solver/iterations"), "iterations per step of 1/60 s"),
             (time_step, lambda run: 1 / run.get("/solver/dt"), "steps per second, 10 iterations each"))
    for panel, (runs, x, label) in zip(axes, sides):
        for model, some in by_model(runs).items():
            some = sorted(some, key=x)
            values = np.array([strips.rigidity(run) for run in some])
            panel.plot([x(run) for run in some], values, label=strips.model_name(some[0]),
                       **style.look(model))
            if model != "none" and np.isfinite(values[[0, -1]]).all():
                growth.append(values[-1] / values[0])
        panel.set_xscale("log"), panel.set_yscale("log")
        panel.set_xticks(sorted({round(x(run)) for run in runs}),
                         labels=sorted({round(x(run)) for run in runs}))
        panel.minorticks_off()
        panel.set_xlabel(label)
    axes[0].set_ylabel("B from H/W (N m)")
    title = "iterations and time step"
    if growth:
        title = f"{min(growth):.0f} to {max(growth):.0f} times as stiff with the finer setting"
    figure.suptitle(f"One k: {title}", x=0.01, ha="left", fontsize=11.5)
    style.label_ends(axes[1])
    return style.save(figure, out, "fig_stiffness_solver")


if __name__ == "__main__":
    figure_main(main)
