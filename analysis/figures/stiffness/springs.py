"""Ring springs: is the moment C κ³, how does the membrane change C, and how does droop grow with gravity?"""
import numpy as np

from bendlab.results import registry
from bendlab.results.load import group
from runs import strips
from tables import looks
from tables.numbers import percents
from tables.section import Section

RATIO = 2e5  # R⁴ / (α C); above this value the membrane reduces C by at most about 1 %
SOURCE = "shortening of every spring on a polyhedral cylinder (analysis/runs/strips.py)"


def main(results, out, section):
    runs = strips.experiment_runs(results, section, "springs", "springs_slow")
    rows = []
    for own_runs in group(runs, lambda run: (strips.cells(run), ring(run))).values():
        first = own_runs[0]  # the theoretical C depends on the mesh, not on the membrane
        quartic = strips.expected_quartic(first.rest_positions, first.triangles, first.pinned, ring(first),
                                          1 / first.get("/bending/compliance"))
        ratio = lambda run: membrane_ratio(run, quartic)
        best = min(own_runs, key=lambda run: abs(np.log(ratio(run) / RATIO)))
        section.checks += [
            strips.check(best, "C from m(κ) (N m³)", quartic, strips.fit(best, "C"), 0.03, SOURCE,
                         model=line_name(best), note=f"R⁴/(α C) = {ratio(best):.2g}"),
            strips.check(best, "exponent p of m ∝ κ^p", 3, strips.fit(best, "exponent"), 0.15,
                         "shortening ∝ κ²", "absolute", model=line_name(best))]
        rows += [{"ring": ring(run), "cells": strips.cells(run),
                  "alpha": run.get("/material/strain/compliance"), "ratio": ratio(run), "C": quartic,
                  "C_moment": strips.fit(run, "C") / quartic,
                  "C_droop": strips.number(run, "stiffness_quartic") / quartic,
                  "p": strips.fit(run, "exponent")} for run in own_runs]
    section.add_table("springs", "Ring springs", [
        ("ring", "ring"), ("cells", "cells"), ("alpha", "compliance α of the membrane", "", "m/N"),
        ("ratio", "R⁴ / (α C): stiffness of the membrane over stiffness of the springs"),
        ("C", "C of the springs", "", "N m³"), ("C_moment", "C from m(κ) over C of the springs", ".3f"),
        ("C_droop", "C from H/W over C of the springs", ".3f"), ("p", "exponent p of m ∝ κ^p", ".3f")],
        sorted(rows, key=lambda row: (row["cells"], row["ring"], row["ratio"])))
    section.add_chart("springs", _title(rows), "ratio", ["C_moment", "p", "C_droop"], ["ring", "cells"],
                      look="", limits=[*strips.as_stated("C_moment", "C_droop"), ("p", 3, "shortening ∝ κ²")])
    lines = group(strips.experiment_runs(results, section, "gravity"), line_name)
    for name, own_runs in lines.items():
        law = (1 / 3, "m = C κ³") if registry.has_springs_at_rest(own_runs[0].model) else (1, "m = B κ")
        section.checks.append(strips.exponent_check(name, own_runs, *law))
    hinges = [run for run in strips.experiment_runs(results, Section("", ""), "hinges")
              if run.model == "discrete_shells" and strips.cells(run) == 24]
    if lines and hinges:
        lines["hinges"] = hinges
    rows = [row for name, own_runs in lines.items() for row in _gravity_rows(name, own_runs)]
    section.add_table("gravity", "Droop over gravity", [
        ("line", "springs"), "kind", ("g", "gravity", "", "m/s²"), ("droop", "H/W of the free end", ".4f"),
        ("slope", "exponent p of H/W ∝ g^p", ".3f")], rows)
    powers = [f"{kind} {' to '.join(sorted({format(row['slope'], '.2f') for row in own_rows}))}"
              for kind, own_rows in group(rows, lambda row: row["kind"]).items()]
    section.add_chart("gravity", f"H/W grows as a power of g: {', '.join(powers)}", "g", ["droop"], ["line"],
                      note="Runs with H/W below 1. The hinges are discrete_shells.")


def ring(run):
    return run.get("/bending/k_ring/k")


def line_name(run):
    return f"k_ring, ring {ring(run)}" if run.model == "k_ring" else run.model


def membrane_ratio(run, quartic):
    """R⁴ / (α C): stiffness of the membrane (compliance α, m/N) relative to springs of length R."""
    edge = run.get("/mesh/width") / run.get("/mesh/cells")
    return (ring(run) * edge)**4 / (run.get("/material/strain/compliance") * quartic)


def _title(rows):
    """The title: the measured C with a stiff and with a soft membrane."""
    near = [row["C_moment"] for row in rows if RATIO / 3 < row["ratio"] < RATIO * 3]
    soft = [row["C_moment"] for row in rows if row["ratio"] < RATIO / 30]
    if not near:
        return "C of springs"
    text = f"With a stiff membrane, C is {percents(near)} % of the springs' C"
    return text + (f", with a membrane at least 30 times softer {percents(soft)} %" if soft else "")


def _gravity_rows(name, runs):
    runs = sorted((run for run in runs if strips.droop(run) < 1), key=strips.gravity)
    model, slope = runs[0].model, strips.exponent(runs)
    kind = "springs at rest" if registry.has_springs_at_rest(model) else looks.family(model)
    return [{"line": name, "model": model, "kind": kind, "g": strips.gravity(run),
             "droop": strips.droop(run), "slope": slope} for run in runs]
