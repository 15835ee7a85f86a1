"""Ring springs: is the moment C κ³, how does the membrane change C, and how does droop grow with gravity?"""
import numpy as np

from tables import looks
from bendlab.results import registry
from runs import strips
from bendlab.results.load import group
from tables.chart import Chart
from tables.section import Check, Section
from tables.table import Table

RATIO = 2e5  # R⁴ / (α C); above this value the membrane reduces C by at most about 1 %
SOURCE = "shortening of every spring on a polyhedral cylinder (analysis/runs/strips.py)"


def ring(run):
    return run.get("/bending/k_ring/k")


def place(run):
    return strips.cells(run), ring(run)


def expected_quartic(run):
    """Theoretical C of the springs of a strip, in N m³."""
    return strips.expected_quartic(run.rest_positions, run.triangles, run.pinned, ring(run),
                                   1 / run.get("/bending/compliance"))


def membrane_ratio(run, quartic):
    """R⁴ / (α C): stiffness of the membrane (compliance α, m/N) relative to springs of length R."""
    edge = run.get("/mesh/width") / run.get("/mesh/cells")
    return (ring(run) * edge)**4 / (run.get("/material/strain/compliance") * quartic)


def main(results, out, section):
    runs = strips.experiment_runs(results, section, "springs", "springs_slow")
    sweep = strips.experiment_runs(results, section, "gravity")
    # The theoretical C depends on the mesh, not on the membrane
    quartic_of = {key: expected_quartic(own[0]) for key, own in group(runs, place).items()}
    points = [(run, quartic_of[place(run)], membrane_ratio(run, quartic_of[place(run)])) for run in runs]
    for _, own in group(points, lambda point: place(point[0])).items():
        section.checks += _checks(*min(own, key=lambda point: abs(np.log(point[2] / RATIO))))
    section.checks += slopes(sweep)
    section.tables += [_table(points)] if points else []
    section.tables += [_gravity_table(sweep, results)] if sweep else []
    section.charts = [
        Chart("springs", _title(section.table("springs")), "springs", "ratio", ["C_moment", "p", "C_droop"],
              ["ring", "cells"], look="", limits=strips.as_stated("C_moment", "C_droop")
              + [("p", 3, "shortening ∝ κ²")]),
        Chart("gravity", _gravity_title(section.table("gravity")), "gravity", "g", ["droop"], ["line"],
              look="",
              note="Runs with H/W below 1. The hinges are discrete_shells.")]


def _checks(run, quartic, ratio):
    name, mesh = f"k_ring, ring {ring(run)}", strips.mesh_name(run)
    return [Check("C from m(κ) (N m³)", name, mesh, quartic, strips.number(run, "stiffness_fit_C"), 0.03,
                  SOURCE, note=f"R⁴/(α C) = {ratio:.2g}"),
            Check("exponent p of m ∝ κ^p", name, mesh, 3, strips.number(run, "stiffness_fit_exponent"), 0.15,
                  "shortening ∝ κ²", "absolute")]


def slopes(runs):
    """Checks of the exponent d ln(H/W) / d ln g (g: gravity), from runs with H/W below 0.3."""
    checks = []
    for label, own_runs in group(runs, line_name).items():
        small = [run for run in own_runs if strips.droop(run) < 0.3]
        slope = strips.power(small) if len(small) > 1 else np.nan
        at_rest = registry.has_springs_at_rest(own_runs[0].model)
        checks.append(Check("slope of ln H/W over ln g at H/W < 0.3", label, strips.mesh_name(own_runs[0]),
                            1 / 3 if at_rest else 1, float(slope), 0.02, "m = C κ³" if at_rest else "m = B κ",
                            "absolute"))
    return checks


def line_name(run):
    return f"k_ring, ring {ring(run)}" if run.model == "k_ring" else run.model


def _title(rows):
    """The title: the measured C with a stiff and with a soft membrane."""
    near = [row["C_moment"] for row in rows if RATIO / 3 < row["ratio"] < RATIO * 3]
    soft = [row["C_moment"] for row in rows if row["ratio"] < RATIO / 30]
    if not near:
        return "C of springs"
    text = (f"With a stiff membrane, C is {100 * min(near):.0f} to {100 * max(near):.0f} % of the springs' C")
    return text + (f", with a membrane at least 30 times softer {100 * min(soft):.0f} to "
                   f"{100 * max(soft):.0f} %"
                   if soft else "")


def _table(points):
    rows = [{"ring": ring(run), "cells": strips.cells(run), "alpha": run.get("/material/strain/compliance"),
             "ratio": ratio, "C": quartic, "C_moment": strips.number(run, "stiffness_fit_C") / quartic,
             "C_droop": strips.number(run, "stiffness_quartic") / quartic,
             "p": strips.number(run, "stiffness_fit_exponent")}
            for run, quartic, ratio in sorted(points, key=lambda point: (*place(point[0]), point[2]))]
    return Table.of("springs", "Ring springs", [
        ("ring", "ring"), ("cells", "cells"), ("alpha", "compliance α of the membrane", "", "m/N"),
        ("ratio", "R⁴ / (α C): stiffness of the membrane over stiffness of the springs"),
        ("C", "C of the springs", "", "N m³"), ("C_moment", "C from m(κ) over C of the springs", ".3f"),
        ("C_droop", "C from H/W over C of the springs", ".3f"), ("p", "exponent p of m ∝ κ^p", ".3f")], rows)


def _gravity_table(runs, results):
    hinges = [run for run in strips.experiment_runs(results, Section("", ""), "hinges")
              if run.model == "discrete_shells" and strips.cells(run) == 24]
    rows = []
    for name, own_runs in (group(runs, line_name) | ({"hinges": hinges} if hinges else {})).items():
        own_runs = sorted((run for run in own_runs if strips.droop(run) < 1), key=strips.gravity)
        small = [run for run in own_runs if strips.droop(run) < 0.3]
        slope = strips.power(small) if len(small) > 1 else np.nan
        model = own_runs[0].model
        kind = "springs at rest" if registry.has_springs_at_rest(model) else looks.family(model)
        rows += [{"line": name, "model": model, "kind": kind, "g": strips.gravity(run),
                  "droop": strips.droop(run), "slope": slope} for run in own_runs]
    return Table.of("gravity", "Droop over gravity", [
        ("line", "springs"), "kind", ("g", "gravity", "", "m/s²"), ("droop", "H/W of the free end", ".4f"),
        ("slope", "exponent p of H/W ∝ g^p", ".3f")], rows)


def _gravity_title(rows):
    powers = {kind: " to ".join(sorted({f"{row['slope']:.2f}" for row in own_rows}))
              for kind, own_rows in group(rows, lambda row: row["kind"]).items()}
    return "H/W grows as a power of g: " + ", ".join(f"{kind} {power}" for kind, power in powers.items())
