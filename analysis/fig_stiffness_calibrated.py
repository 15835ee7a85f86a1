"""Calibrated stiffness: measured over stated physical stiffness, and the paper's rule beside it."""
import right_python  # noqa: F401  (first: it may hand over to another Python)
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.lines import Line2D

from bendlab.results import registry
import strips
import style
from fig_stiffness_resolution import ratio
from bendlab.results.load import by_model, group
from report import Check, Section, Table, figure_main

GOALS = {"equilateral": 0.05, "delaunay": 0.15}
LOOKS = {"equilateral": "-", "delaunay": "--"}
STATED = "the stiffness in the config"
# Hinges that are calibrated at small deflection
SMALL_GOALS = {"equilateral": 0.03, "alternating": 0.03, "both": 0.05, "delaunay": 0.03}


def main(results, out):
    section = Section("Calibrated stiffness against resolution", "calibrated")
    runs = strips.experiment_runs(results, section, "calibrated", "calibrated_slow", "calibrated_96_slow",
                                  "calibrated_irregular", "calibrated_irregular_slow",
                                  "calibrated_irregular_full")
    membranes = strips.experiment_runs(results, section, "membrane")
    before = strips.experiment_runs(results, section, "resolution", "resolution_slow")
    small = strips.experiment_runs(results, section, "small_deflection")
    section.text = intro_text(runs)
    section.checks = [*_checks(runs), *_small_checks(small)]
    if small:
        section.text += " " + small_text(small)
        section.tables.append(_small_table(small))
    if runs:
        section.pictures.append((_picture(runs, before, out), "Left: B from H/W with k = 0.5 and levels from "
                                 "eq. 6, over that at 12 cells. Right: stiffness, measured over stated. "
                                 "Solid: equilateral lattice, dashed: Delaunay. The bands are 5 and 15 %."))
        section.tables += [_summary(runs, before), _table(runs)]
    if membranes:
        section.pictures.append((_membrane_picture(membranes, out), "Stiffness from the moment-curvature fit "
                                 "(lines) and from H/W (crosses), divided by the stated one, over the "
                                 "membrane's compliance α. Solid: 24 cells, dashed: 12."))
    return section


def intro_text(runs):
    """What is measured, with lengths and goals from runs and rules."""
    return ("From the mesh, each model computes compliances of its constraints that should give the "
            f"stated B (hinges) or C (springs at rest). {lengths_text(runs)} Springs that push in "
            "the flat sheet (prestressed) have a B, like hinges. All runs are static equilibria. "
            "The number is from the moment-curvature fit, or from H/W if springs reach too far for "
            f"a fit. Goal: the same stiffness within {100 * GOALS['equilateral']:g} % on the lattice "
            f"and {100 * GOALS['delaunay']:g} % on irregular meshes. Two effects prevent an exact "
            "result. A soft membrane yields to the springs. And an irregular mesh has no straight "
            "lines to fold along: a stiff membrane has to stretch before it bends, most of all at "
            "the ragged edge of the clamp; there H/W is more reliable than the fit, which leaves out "
            "the clamp. So the membrane's compliance is 10⁻⁷ m/N on the lattice and 10⁻⁶ m/N on the "
            "irregular mesh; the last picture shows both effects.")


def _checks(runs):
    checks = []
    for run in runs:
        goal = GOALS[strips.family(run)]
        checks.append(Check("stiffness, measured over stated", name(run), strips.mesh_name(run), 1,
                            share(run), goal, STATED, note=_note(run)))
    for (model, family), some in group(runs, lambda run: (name(run), strips.family(run))).items():
        cells = sorted(strips.cells(run) for run in some)
        mesh = f"{strips.MESH_NAMES[family]}, {cells[0]} to {cells[-1]} cells"
        checks.append(Check("largest ratio of stiffness between two resolutions", model, mesh,
                            1 + GOALS[family], strips.largest_ratio(map(share, some)), 0,
                            "calibration on every mesh", "most"))
    return checks


def _small_checks(small):
    checks = []
    for run in small:
        goal = SMALL_GOALS.get(strips.family(run))
        if run.get("/bending/deflection") == "small" and goal:
            checks.append(Check("stiffness at small deflection, measured over stated", run.model,
                                strips.mesh_name(run), 1, share_of_droop(run), goal, STATED))
    return checks


def lengths_text(runs):
    """The springs' length, and how many edges it is at every resolution, computed from the configs."""
    springs = [run for run in runs if run.get(f"/bending/{run.model}/radius")
               and registry.has_springs_at_rest(run.model) and strips.family(run) == "equilateral"]
    if not springs:
        return ""
    radius = max(run.get(f"/bending/{run.model}/radius") for run in springs)
    edges = {strips.cells(run): round(radius * strips.cells(run) / run.get("/mesh/width")) for run in springs}
    counts = [", ".join(map(str, numbers)) for numbers in (sorted(edges.values()), sorted(edges))]
    return (f"Springs have one length, {100 * radius:.3g} cm, at every resolution ({counts[0]} edges at "
            f"{counts[1]} cells).")


def small_text(runs):
    """What small deflections change, with the energy left on alternating diagonals computed from the runs."""
    left = [strips.number(run, "model_small_deflection") / strips.number(run, "model_large_deflection")
            for run in runs if strips.family(run) == "alternating"
            and run.get("/bending/deflection") == "large"]
    share = f"{left[0]:.2f}" if left else "–"
    return ("A sheet with small deflection finds shapes of lower energy than the cylinder that it was "
            "calibrated on. On alternating diagonals the heights of vertices with four and with eight "
            f"neighbours separate, and the bending energy is {share} of the cylinder's, in every "
            "direction. A stiff membrane prevents that above a curvature of about 4 √(B / Y) / h² (Y: its "
            "stiffness in N/m, h: an edge; an estimate, lib/bendlab/bending/sheet_response.hpp). So "
            "stiffness at small and large deflections differs by a factor that depends on the mesh; "
            "/bending/deflection chooses where the stated B holds.")


def name(run):
    """The model's name; says if pins have the paper's larger ring."""
    return f"{run.model}, n-ring at pins" if run.model == "adaptive" and run.get(
        "/bending/adaptive/pin_zone") else run.model


def _note(run):
    """Why a run is measured by H/W, if it is."""
    if np.isnan(strips.number(run, "stiffness_fit_C")):
        return "from H/W: the n-ring at the clamp reaches over most of the strip, no fit"
    return ""


def share_of_droop(run):
    """Stiffness from H/W, over the stated one."""
    return strips.measured(run) / strips.stated(run)


def share(run):
    """Stiffness from the moment-curvature fit, else from H/W, over the stated one."""
    kind = "C" if registry.has_springs_at_rest(run.model) else "B"
    fit = strips.number(run, f"stiffness_fit_{kind}") / strips.stated(run)
    return share_of_droop(run) if np.isnan(fit) else fit


def _picture(runs, before, out):
    figure, (left, right, zoom) = plt.subplots(1, 3, figsize=(12.6, 4.3), layout="constrained")
    models = by_model(runs)
    ratios = {"before": [], "after": []}
    for model in models:
        for family, look in LOOKS.items():
            some = sorted((run for run in before if run.model == model and strips.family(run) == family),
                          key=strips.cells)
            values = np.array([strips.rigidity(run) for run in some])
            if len(values):
                left.plot([strips.cells(run) for run in some], values / values[0],
                          **style.look(model, linestyle=look))
                ratios["before"].append(strips.largest_ratio(values))
            some = sorted((run for run in runs if name(run) == model and strips.family(run) == family),
                          key=strips.cells)
            if some:
                for panel in (right, zoom):
                    panel.plot([strips.cells(run) for run in some], [share(run) for run in some],
                               label=style.model_name(model) if family == "equilateral" else None,
                               **style.look(model, linestyle=look))
                ratios["after"].append(strips.largest_ratio(map(share, some)))
    for panel in (left, right, zoom):
        style.resolution_axis(panel, sorted({strips.cells(run) for run in [*runs, *before]}))
        panel.set_xlabel("cells along the strip")
    for panel in (left, right):
        panel.set_ylim(1e-4, 2)
        style.plain_log(panel)
    zoom.axhspan(0.85, 1.15, color="#f2f6f3", zorder=0), zoom.axhspan(0.95, 1.05, color="#dfece3", zorder=0)
    zoom.set_ylim(0.75, 1.25)
    left.set_ylabel("stiffness over that at 12 cells"), right.set_ylabel("stiffness, measured / stated")
    left.set_title("the paper's rule: k = 0.5, eq. 6"), right.set_title("calibrated"), zoom.set_title(
        "calibrated, enlarged")
    left.legend(handles=[Line2D([], [], linestyle=look, color=style.GREY, label=strips.MESH_NAMES[family])
                         for family, look in LOOKS.items()], loc="lower left")
    old, new = ([value for value in ratios[key] if np.isfinite(value)] for key in ("before", "after"))
    if old and new:
        figure.suptitle(f"Refinement changes the stiffness by factors of {style.number(min(old), 2)} to "
                        f"{style.number(max(old), 2)} with the paper's rule, of {min(new):.2f} to "
                        f"{max(new):.2f} if calibrated", x=0.01, ha="left", fontsize=11.5)
    style.label_ends(zoom)
    return style.save(figure, out, "fig_stiffness_calibrated")


def _membrane_picture(runs, out):
    figure, axes = plt.subplots(1, 2, figsize=(10.4, 4), layout="constrained", sharey=True)
    alpha = lambda run: run.get("/material/strain/compliance")
    extremes = {}
    for panel, family in zip(axes, LOOKS):
        for model, some in by_model([run for run in runs if strips.family(run) == family]).items():
            for cells, look in ((12, "--"), (24, "-")):
                line = sorted((run for run in some if strips.cells(run) == cells), key=alpha)
                x = [alpha(run) for run in line]
                panel.plot(x, list(map(share, line)),
                           label=f"{style.model_name(model)}, {cells} cells",
                           **style.look(model, linestyle=look))
                panel.plot(x, list(map(share_of_droop, line)), "x", color=style.colour(model),
                           markersize=4, alpha=0.6)
                extremes.setdefault(family, []).extend(map(share, line))
        panel.axhspan(1 - GOALS[family], 1 + GOALS[family], color="#e8f1ea", zorder=0)
        panel.set_xscale("log")
        panel.set_title(strips.MESH_NAMES[family])
        panel.set_xlabel("compliance of the membrane α (m/N)")
    axes[0].set_ylabel("stiffness, measured / stated")
    axes[0].set_ylim(0.6, 2)
    axes[1].legend(handles=[Line2D([], [], marker="x", linestyle="", color=style.GREY, markersize=4,
                                   label="from H/W, in the model's colour")])
    text = [f"{strips.MESH_NAMES[family]} {min(values):.2f} to {max(values):.2f}"
            for family, values in extremes.items()]
    figure.suptitle("The membrane reduces or increases the stiffness. Measured over stated: "
                    f"{', '.join(text)}", x=0.01, ha="left", fontsize=11.5)
    style.label_ends(axes[1])
    return style.save(figure, out, "fig_stiffness_membrane")


def _summary(runs, before):
    rows = []
    for (model, family), some in group(sorted(runs, key=name),
                                       lambda run: (name(run), strips.family(run))).items():
        old = [run for run in before if run.model == model and strips.family(run) == family]
        shares, cells = list(map(share, some)), sorted(strips.cells(run) for run in some)
        exponents = [strips.number(run, "stiffness_fit_exponent") for run in some]
        exponents = [p for p in exponents if np.isfinite(p)]
        rows.append([model, strips.MESH_NAMES[family], f"{min(exponents):.2f} – {max(exponents):.2f}"
                     if exponents else "–", f"{min(shares):.3f} – {max(shares):.3f}",
                     f"{cells[0]} – {cells[-1]}", style.number(strips.largest_ratio(shares)),
                     style.number(ratio(old)) if old else "–"])
    return Table("Before and after",
                 ["model", "mesh", "p", "measured over stated", "cells", "largest ratio, calibrated",
                  "largest ratio, paper's rule (k = 0.5)"], rows)


def _small_table(runs):
    rows = []
    for run in sorted(runs, key=lambda run: (strips.family(run), run.get("/mesh/rows", ""),
                                             run.get("/bending/deflection"))):
        range_of = lambda name: (f"{strips.number(run, name):.3f} ({strips.number(run, name + '_least'):.3f} "
                                 f"– {strips.number(run, name + '_most'):.3f})")
        rows.append([strips.mesh_name(run), run.get("/bending/deflection"), f"{share_of_droop(run):.3f}",
                     range_of("model_small_deflection"), range_of("model_large_deflection"),
                     range_of("model_small_strip")])
    return Table("Small deflection: hinges (dihedral), tip = L / 1000",
                 ["mesh", "calibrated at deflection", "measured over stated", "sheet, mean (all directions)",
                  "sheet held to a cylinder", "free narrow strip"], rows)


def _table(runs):
    rows = [[name(run), strips.MESH_NAMES[strips.family(run)], strips.cells(run), f"{share(run):.3f}",
             style.number(share_of_droop(run)),
             f"{strips.number(run, 'stiffness_fit_exponent'):.3f}", style.number(strips.droop(run)),
             style.number(strips.number(run, "springs")) if registry.made_of(run.model) == "springs"
             else "–"]
            for run in sorted(runs, key=lambda run: (name(run), strips.family(run), strips.cells(run)))]
    return Table("Calibrated", ["model", "mesh", "cells", "stiffness over stated", "from H/W", "p", "H/W",
                                "springs"], rows)


if __name__ == "__main__":
    figure_main(main)
