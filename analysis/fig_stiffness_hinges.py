"""Hinges against the heavy elastica: H/W, flexural rigidity, exponent, growth with gravity."""
import right_python  # noqa: F401  (first: it may hand over to another Python)
import matplotlib.pyplot as plt
import numpy as np

import strips
import style
from bendlab.results.load import by_model, group
from report import Check, Section, Table, figure_main

GIVEN = 1.5696e-3  # N m; B that the compliances in the config give each model
CURVE = "heavy elastica, Runge-Kutta (analysis/strips.py)"
# Not from this page's runs. The values approach B with the width; theory gives a narrow beam 1 - ν² = 0.889
# of B.
# Width of the strip in cm → B from H/W over B, 0.003 g
WIDTHS = {3: 0.928, 6: 0.944, 12: 0.964, 20: 0.978, 40: 0.989}
REPEAT = ("./bendlab run configs/stiffness/gravity.json --out /tmp/widths --set /mesh/height=0.03 "
          "--set '/bending={\"model\":\"discrete_shells\",\"stiffness\":\"physical\","
          "\"flexural_rigidity\":0.0015696}'")
ACROSS = ("under small loads free edges also bend across the strip, and a beam has less than the B of a "
          "wide sheet. Measured apart from this page at 0.003 g: B from H/W over B is "
          f"{', '.join(f'{share:.3f}' for share in WIDTHS.values())} for widths of "
          f"{', '.join(map(str, WIDTHS))} cm ({REPEAT}, and other heights)")


def main(results, out):
    """Hinge models whose compliances give one flexural rigidity."""
    section = Section("Hinges against the heavy elastica", "hinges")
    runs = strips.experiment_runs(results, section, "hinges", "hinges_slow")
    control = strips.experiment_runs(results, section, "control")
    section.text = ("A strip is clamped at one end and hangs by its own weight in static equilibrium. All "
                    "hinge models are given one flexural rigidity B; gravity makes Γ = ρ g L³/B about 0.3, "
                    "1, 10 and 100. L begins half a row behind the clamp's edge, at the first hinge that "
                    "turns. At Γ = 100 and below 48 cells the fold at the clamp is narrower than three rows; "
                    "these runs are not checked.")
    theory = strips.elastica_droop([strips.load_number(run, GIVEN) for run in runs])
    for run, droop in zip(runs, theory):
        section.checks += _checks(run, float(droop))
    section.checks += _slopes(runs)
    section.checks += control_checks(control)
    if runs:
        section.pictures.append((_picture(runs, out), "Left: H/W of the free end over Γ; the line is theory. "
                                 "Right: difference of H/W to the line; the band is the tolerance of 1 %."))
        section.tables.append(_table(runs, control))
    return section


def _checks(run, droop):
    given, mesh = GIVEN, strips.mesh_name(run)
    load = strips.load_number(run, given)
    checks = []
    if load < 60 or strips.cells(run) >= 48:
        if load > 0.7:
            checks.append(Check(f"H/W at Γ = {load:.3g}", run.model, mesh, droop, strips.droop(run), 0.01,
                                CURVE))
        checks.append(Check(f"B from H/W at Γ = {load:.3g} (N m)", run.model, mesh, given,
                            strips.rigidity(run), 0.02, "the compliance"))
        checks.append(Check(f"B from m(κ) at Γ = {load:.3g} (N m)", run.model, mesh, given,
                            strips.number(run, "stiffness_fit_B"), 0.02, "the compliance",
                            note=ACROSS if load < 0.2 else ""))
        checks.append(Check(f"exponent p of m ∝ κ^p at Γ = {load:.3g}", run.model, mesh, 1,
                            strips.number(run, "stiffness_fit_exponent"), 0.02,
                            "linear elasticity", "absolute"))
    return checks


def _slopes(runs):
    """Checks of d ln(H/W) / d ln g at H/W below 0.3."""
    checks = []
    for (model, cells), some in group(runs, lambda run: (run.model, strips.cells(run))).items():
        small = [run for run in some if strips.droop(run) < 0.3]
        if len(small) > 1:
            slope = np.polyfit(np.log([strips.gravity(run) for run in small]),
                               np.log([strips.droop(run) for run in small]), 1)[0]
            checks.append(Check("slope of ln H/W over ln g at H/W < 0.3", model, strips.mesh_name(small[0]),
                                1, float(slope), 0.02, "linear elasticity", "absolute"))
    return checks


def control_checks(control):
    """Checks of the membrane without bending: its B is the error floor of all others."""
    return [Check("B of the membrane without bending (N m), from H/W", "none", strips.mesh_name(run),
                  0.02 * GIVEN, floor_rigidity(run), 0, "2 % of the B given to hinges", "most",
                  note="no straight lines to fold along" if strips.family(run) == "delaunay" else "")
            for run in control]


def floor_rigidity(run):
    """B from H/W; 0 if the strip hangs straight down or beyond, so that no elastica has its H/W."""
    value = strips.rigidity(run)
    return 0.0 if np.isnan(value) else value


def _picture(runs, out):
    figure, (left, right) = plt.subplots(1, 2, figsize=(10.4, 4.2), layout="constrained",
                                         gridspec_kw={"width_ratios": [1, 1.15]})
    loads = np.geomspace(0.2, 200, 60)
    left.plot(loads, strips.elastica_droop(loads), color=style.INK, linewidth=1, label="heavy elastica")
    finest = {model: max(map(strips.cells, some)) for model, some in by_model(runs).items()}
    worst = []
    for (model, cells), some in group(runs, lambda run: (run.model, strips.cells(run))).items():
        load = np.array([strips.load_number(run, GIVEN) for run in some])
        measured, theory = np.array([strips.droop(run) for run in some]), strips.elastica_droop(load)
        look = style.look(model, linestyle="")
        if cells == finest[model]:
            left.plot(load, measured, label=style.model_name(model), **look)
        size = {24: 4, 48: 6, 96: 8}.get(cells, 5)
        inside = "none" if cells < 48 else look["color"]
        right.plot(load, 100 * (measured / theory - 1), alpha=0.8,
                   **look | {"markersize": size, "markerfacecolor": inside})
        worst += [abs(m / t - 1) for m, t, g in zip(measured, theory, load) if g < 60 or cells >= 48]
    left.set_xscale("log"), left.set_yscale("log")
    left.set_xlabel("Γ = ρ g L³ / B"), left.set_ylabel("H/W of the free end")
    left.legend()
    right.axhspan(-1, 1, color="#e8f1ea")
    right.axhline(0, color=style.INK, linewidth=0.8)
    right.set_xscale("log"), right.set_ylim(-2.5, 2.5)
    right.set_xlabel("Γ"), right.set_ylabel("H/W over theory − 1 (%)")
    right.set_title("open: 24 cells, filled: 48, large: 96")
    figure.suptitle(f"{len(finest)} hinge models are within {100 * max(worst):.1f} % of the heavy elastica "
                    "where the mesh resolves the fold", x=0.01, ha="left", fontsize=11.5)
    return style.save(figure, out, "fig_stiffness_hinges")


def _table(runs, control):
    floor = {strips.cells(run): floor_rigidity(run) for run in control if strips.family(run) == "equilateral"}
    rows = [[run.model, strips.cells(run), style.number(strips.load_number(run, GIVEN)),
             f"{strips.droop(run):.4f}", f"{strips.rigidity(run) / GIVEN:.3f}",
             f"{strips.number(run, 'stiffness_fit_B') / GIVEN:.3f}",
             f"{strips.number(run, 'stiffness_fit_exponent'):.3f}",
             style.number(floor.get(strips.cells(run), np.nan) / GIVEN)]
            for run in sorted(runs, key=lambda run: (run.model, strips.cells(run), strips.gravity(run)))]
    return Table("Hinges; B over the stated B",
                 ["model", "cells", "Γ", "H/W", "B from H/W", "B from m(κ)", "p", "control: none"], rows)


if __name__ == "__main__":
    figure_main(main)
