"""Lateral buckling: upright strips of hinges buckle at a theoretical load, strips of springs at any load."""
import numpy as np

from bendlab.results import registry
from bendlab.results.load import group
from runs import strips
from tables import looks
from tables.numbers import percents, slope

# Width over length → critical load Γ* = ρ g L³/D of a Kirchhoff plate, by Ritz's method with Legendre
# polynomials, converged to 0.1 %. A lattice of hinges has Poisson's ratio ν = -1/3. Springs in all directions
# have ν = 1/3, like all central forces: the energy is proportional to the mean square of the curvature over
# all directions, 3/8 (κ₁² + κ₂² + 2/3 κ₁ κ₂).
CRITICAL = {"hinges": {0.1: 20.92, 0.2: 22.16, 0.3: 23.49, 0.5: 26.30, 1.0: 33.39},
            "springs that push": {0.1: 15.148, 0.2: 16.474, 0.3: 17.929, 0.5: 21.085, 1.0: 29.387}}
POISSON = {"hinges": "−1/3", "springs that push": "1/3"}
NEAR = 1.1  # times the critical load; above this load the linear theory is not exact
pull = lambda run: strips.gravity(run, axis=1)  # in the strip's plane, in m/s²


def main(results, out, section):
    stiff = strips.experiment_runs(results, section, "buckling", "buckling_slow", "buckling_prestressed")
    springs = sorted(strips.experiment_runs(results, section, "buckling_springs"), key=pull)
    rows, title = [], "Lateral buckling"
    strip = lambda run: (run.model, strips.cells(run), run.get("/mesh/height"))
    for own_runs in group(stiff, strip).values():
        run, cells = own_runs[0], strips.cells(own_runs[0])
        length, width = _lengths(run)
        table = CRITICAL[looks.family(run.model)]
        theory = float(np.interp(width / length, list(table), list(table.values())))
        section.checks.append(strips.check(
            run, f"Γ* at width over length {width / length:.2f}", theory, critical_load(own_runs),
            0.03 if cells > 24 else 0.05,
            f"Kirchhoff plate, ν = {POISSON[looks.family(run.model)]}, by Ritz's method"))
        rows += [{"model": run.model, "width": round(width / length, 2), "cells": cells, "load": load,
                  "over": load / theory, "squared": 1e4 * deflection(run)**2}
                 for run in sorted(own_runs, key=load_number) if (load := load_number(run)) < NEAR * theory]
    shares = [check.measured / check.expected for check in section.checks if np.isfinite(check.measured)]
    if shares:
        title = f"Strips with linear stiffness buckle at {percents(shares)} % of the theoretical load"
    section.add_table("buckling", "Strips with linear stiffness", [
        "model", ("width", "width over length", ".2f"), "cells", ("load", "Γ = ρ g L³ / D"),
        ("over", "Γ / Γ* of theory", ".3f"), ("squared", "(deflection / L)²", "", "10⁻⁴")], rows)
    section.add_chart(
        "buckling", title, "over", ["squared"], ["model", "width", "cells"], scale="linear", y_scale="linear",
        note="The squared deflection of the farthest vertex in static equilibrium. In theory, the "
                      "deflection is 0 up to Γ / Γ* = 1.")
    rows = [{"model": "k_ring", "gravity": pull(run), "deflection": deflection(run)} for run in springs]
    section.add_check("slope of ln deflection over ln load, from Γ* = 0", "k_ring, ring 3",
                      strips.mesh_name(springs[0]) if springs else "equilateral", 0.5,
                      slope([row["gravity"] for row in rows], [row["deflection"] for row in rows]), 0.02,
                      "bending energy ∝ deflection⁴, work of the load ∝ deflection²", "absolute")
    section.add_table("buckling_springs", "Springs to ring 3", [
        "model", ("gravity", "gravity in the plane", "", "m/s²"), ("deflection", "deflection / L", ".4f")],
        rows)
    section.add_table("root", "", ["model", "gravity", "deflection"], [
        {"model": "slope 1/2", "gravity": row["gravity"],
         "deflection": rows[0]["deflection"] * np.sqrt(row["gravity"] / rows[0]["gravity"])} for row in rows])
    section.add_chart("buckling_springs", "Springs at rest buckle under any load", "gravity", ["deflection"],
                      y_scale="log", theory="root",
                      note="The springs are k_ring, ring 3. The line has the slope 1/2.")


def _lengths(run):
    """(effective length, width) in m."""
    rest, pinned = run.rest_positions, run.pinned
    free = rest[:, 0].max() - rest[pinned, 0].max()
    row = np.diff(np.unique(np.round(rest[:, 0], 7))).mean()
    level = run.get(f"/bending/{run.model}/t") if registry.is_prestressed(run.model) else None
    behind = row * level / 4 if level else row / 2
    return free + behind, np.ptp(rest[:, 1])


def load_number(run):
    """The load of a run, Γ = ρ g L³/D. D: the flexural rigidity that the config states, in N m."""
    rigidity = run.get("/bending/flexural_rigidity") or 1 / run.get("/bending/compliance")
    return run.get("/material/density") * pull(run) * _lengths(run)[0]**3 / rigidity


def deflection(run):
    """Largest distance of a vertex from the strip's plane, over the strip's length."""
    return float(np.abs(run.positions(-1)[:, 2]).max() / _lengths(run)[0])


def critical_load(runs):
    """Γ at which these runs begin to buckle; NaN if that is not known."""
    return strips.threshold([(load_number(run), deflection(run)) for run in runs])
