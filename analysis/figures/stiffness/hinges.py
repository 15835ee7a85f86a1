"""Strips of hinges against the heavy elastica (a strip that bends under its weight, in theory)."""
import numpy as np

from runs import strips
from bendlab.results.load import group
from tables.chart import Chart
from tables.section import Check
from tables.table import Table

GIVEN = 1.5696e-3  # N m; B of every model with the compliances in the config
CURVE = "heavy elastica, Runge-Kutta (analysis/runs/strips.py)"
# Width of the strip in cm → B from H/W over the stated B, at 0.003 g, measured with REPEAT. The ratio
# approaches 1 as the width grows. In theory, a narrow beam has a ratio of 1 - ν² = 0.889.
WIDTHS = {3: 0.928, 6: 0.944, 12: 0.964, 20: 0.978, 40: 0.989}
REPEAT = ("./bendlab run configs/stiffness/gravity.json --out /tmp/widths --set /mesh/height=0.03 "
          "--set '/bending={\"model\":\"discrete_shells\",\"stiffness\":\"physical\","
          "\"flexural_rigidity\":0.0015696}'")
ACROSS = ("under small loads the free edges also bend across the strip, so that a narrow strip has a "
          "smaller B than a wide sheet. In separate runs at 0.003 g, B from H/W over the stated B is "
          f"{', '.join(f'{share:.3f}' for share in WIDTHS.values())} for widths of "
          f"{', '.join(map(str, WIDTHS))} cm ({REPEAT}, and with other values of /mesh/height)")


def main(results, out, section):
    """Measures all hinge models, with compliances that give one flexural rigidity."""
    runs = strips.experiment_runs(results, section, "hinges", "hinges_slow")
    control = strips.experiment_runs(results, section, "control")
    theory = strips.elastica_droop([strips.load_number(run, GIVEN) for run in runs])
    for run, droop in zip(runs, theory):
        section.checks += _checks(run, float(droop))
    section.checks += _slopes(runs)
    section.checks += control_checks(control)
    section.tables += [_table(runs, control), _elastica()] if runs else []
    resolved = [abs(row["off"]) for row in section.table("hinges") if row["load"] < 60 or row["cells"] >= 48]
    title = "How far strips of hinges hang down, compared with theory"
    if resolved:
        title = (f"{len({run.model for run in runs})} hinge models are within {max(resolved):.1f} % of the "
                 "heavy elastica where the mesh resolves the fold")
    section.charts = [
        Chart("hinges", title, "hinges", "load", ["droop", "off"], held=["cells"], theory="elastica",
              limits=[("off", 1, "tolerance"), ("off", -1, "tolerance")]),
        Chart("hinges_rigidity", "Measured flexural rigidity of hinges over the stated rigidity", "hinges",
              "load", ["B_droop", "B_moment"], held=["cells"],
              limits=strips.as_stated("B_droop", "B_moment"))]


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
    """Checks of the exponent d ln(H/W) / d ln g (g: gravity), from runs with H/W below 0.3."""
    checks = []
    for (model, cells), own_runs in group(runs, lambda run: (run.model, strips.cells(run))).items():
        small = [run for run in own_runs if strips.droop(run) < 0.3]
        if len(small) > 1:
            slope = np.polyfit(np.log([strips.gravity(run) for run in small]),
                               np.log([strips.droop(run) for run in small]), 1)[0]
            checks.append(Check("slope of ln H/W over ln g at H/W < 0.3", model, strips.mesh_name(small[0]),
                                1, float(slope), 0.02, "linear elasticity", "absolute"))
    return checks


def control_checks(control):
    """Checks that the membrane without bending has a small B, which is an error of every measured B."""
    return [Check("B of the membrane without bending (N m), from H/W", "none", strips.mesh_name(run),
                  0.02 * GIVEN, floor_rigidity(run), 0, "2 % of the stated B of hinges", "most",
                  note="no straight lines to fold along" if strips.family(run) == "delaunay" else "")
            for run in control]


def floor_rigidity(run):
    """B from H/W; 0 if the strip hangs straight down or past the vertical, where no elastica has this H/W."""
    value = strips.rigidity(run)
    return 0.0 if np.isnan(value) else value


def _table(runs, control):
    floor = {strips.cells(run): floor_rigidity(run) for run in control if strips.family(run) == "equilateral"}
    rows, runs = [], sorted(runs, key=lambda run: (run.model, strips.cells(run), strips.gravity(run)))
    loads = [strips.load_number(run, GIVEN) for run in runs]
    for run, load, theory in zip(runs, loads, strips.elastica_droop(loads)):
        rows.append({"model": run.model, "cells": strips.cells(run), "load": load, "droop": strips.droop(run),
                     "off": 100 * (strips.droop(run) / theory - 1),
                     "B_droop": strips.rigidity(run) / GIVEN,
                     "B_moment": strips.number(run, "stiffness_fit_B") / GIVEN,
                     "p": strips.number(run, "stiffness_fit_exponent"),
                     "floor": floor.get(strips.cells(run), np.nan) / GIVEN})
    return Table.of("hinges", "Hinges; B over the stated B", [
        "model", ("cells", "cells along the strip"), ("load", "Γ = ρ g L³ / B"),
        ("droop", "H/W of the free end", ".4f"), ("off", "H/W over theory − 1", "+.2f", "%"),
        ("B_droop", "B from H/W over B", ".3f"),
        ("B_moment", "B from m(κ) over B", ".3f", "", "from moment and curvature along the strip"),
        ("p", "p of m ∝ κ^p", ".3f"), ("floor", "control: B without bending over B")], rows)


def _elastica():
    loads = np.geomspace(0.2, 200, 60)
    rows = [{"model": "heavy elastica", "load": load, "droop": droop}
            for load, droop in zip(loads, strips.elastica_droop(loads))]
    return Table.of("elastica", "", ["model", "load", "droop"], rows)
