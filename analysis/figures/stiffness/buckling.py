"""Lateral buckling: upright strips of hinges buckle at a theoretical load, strips of springs at any load."""
import numpy as np

from tables import looks
from bendlab.results import registry
from runs import strips
from bendlab.results.load import group
from tables.chart import Chart
from tables.section import Check
from tables.table import Table

# Width over length → critical load Γ* = ρ g L³/D of a Kirchhoff plate, by Ritz's method with Legendre
# polynomials, converged to 0.1 %. A lattice of hinges has Poisson's ratio ν = -1/3. Springs in all directions
# have ν = 1/3, like all central forces: the energy is proportional to the mean square of the curvature over
# all directions, 3/8 (κ₁² + κ₂² + 2/3 κ₁ κ₂).
CRITICAL = {"hinges": {0.1: 20.92, 0.2: 22.16, 0.3: 23.49, 0.5: 26.30, 1.0: 33.39},
            "springs that push": {0.1: 15.148, 0.2: 16.474, 0.3: 17.929, 0.5: 21.085, 1.0: 29.387}}
POISSON = {"hinges": "−1/3", "springs that push": "1/3"}
NEAR = 1.1  # times the critical load; above this load the linear theory is not exact
NOTICEABLE = 1e-3  # of the length; a sheet with a larger deflection has buckled


def main(results, out, section):
    stiff = strips.experiment_runs(results, section, "buckling", "buckling_slow", "buckling_prestressed")
    springs = strips.experiment_runs(results, section, "buckling_springs")
    for (model, cells, _), own_runs in strip_groups(stiff).items():
        section.checks.append(Check(f"Γ* at width over length {width_over_length(own_runs[0]):.2f}", model,
                                    strips.mesh_name(own_runs[0]), theory(own_runs[0]),
                                    critical_load(own_runs), 0.03 if cells > 24 else 0.05,
                                    f"Kirchhoff plate, ν = {POISSON[looks.family(model)]}, by Ritz's method"))
    section.checks.append(spring_check(springs))
    section.tables += [_table(stiff), _springs_table(springs)]
    shares = [check.measured / check.expected for check in section.checks[:-1] if np.isfinite(check.measured)]
    title = "Lateral buckling"
    if shares:
        title = (f"Strips with linear stiffness buckle at {100 * min(shares):.0f} to "
                 f"{100 * max(shares):.0f} % of the theoretical load")
    section.charts = [
        Chart("buckling", title, "buckling", "over", ["squared"], ["model", "width", "cells"],
              scale="linear", y_scale="linear", look="",
              note="The squared deflection of the farthest vertex in static equilibrium. In theory, the "
                   "deflection is 0 up to Γ / Γ* = 1."),
        Chart("buckling_springs", "Springs at rest buckle under any load", "buckling_springs", "gravity",
              ["deflection"], ["model"], y_scale="log", theory="root",
              note="The springs are k_ring, ring 3. The line has the slope 1/2.")]
    if springs:
        rows = section.table("buckling_springs")
        section.tables.append(Table.of("root", "", ["model", "gravity", "deflection"], [
            {"model": "slope 1/2", "gravity": row["gravity"], "deflection": rows[0]["deflection"] * np.sqrt(
                row["gravity"] / rows[0]["gravity"])} for row in rows]))


def _lengths(run):
    """(effective length, width) in m."""
    rest, pinned = run.rest_positions, run.pinned
    free = rest[:, 0].max() - rest[pinned, 0].max()
    row = np.diff(np.unique(np.round(rest[:, 0], 7))).mean()
    level = run.get(f"/bending/{run.model}/t") if registry.is_prestressed(run.model) else None
    behind = row * level / 4 if level else row / 2
    return free + behind, np.ptp(rest[:, 1])


def strip_groups(runs):
    """(model, cells, width) → runs under different loads."""
    return group(runs, lambda run: (run.model, strips.cells(run), run.get("/mesh/height")))


def theory(run):
    table = CRITICAL[looks.family(run.model)]
    return float(np.interp(width_over_length(run), list(table), list(table.values())))


def _rigidity(run):
    """The flexural rigidity D that the config states, in N m."""
    return run.get("/bending/flexural_rigidity") or 1 / run.get("/bending/compliance")


def width_over_length(run):
    length, width = _lengths(run)
    return width / length


def pull(run):
    """Gravity in the strip's plane, in m/s²."""
    return -run.get("/effects/0/acceleration")[1]


def load_number(run):
    """The load of a run, Γ = ρ g L³/D."""
    return run.get("/material/density") * pull(run) * _lengths(run)[0]**3 / _rigidity(run)


def deflection(run):
    """Largest distance of a vertex from the strip's plane, over the strip's length."""
    return float(np.abs(run.positions(-1)[:, 2]).max() / _lengths(run)[0])


def critical_load(runs):
    """Γ where a line through the two smallest noticeable squared deflections is zero; NaN without two."""
    points = sorted((load_number(run), deflection(run)**2) for run in runs)
    points = [point for point in points if point[1] > NOTICEABLE**2][:2]
    if len(points) < 2:
        return np.nan
    (low, small), (high, large) = points
    return low - small * (high - low) / (large - small)


def spring_check(runs):
    slope = np.nan
    if len(runs) > 1:
        slope = np.polyfit(np.log([pull(run) for run in runs]), np.log([deflection(run) for run in runs]),
                           1)[0]
    return Check("slope of ln deflection over ln load, from Γ* = 0", "k_ring, ring 3",
                 strips.mesh_name(runs[0]) if runs else "equilateral", 0.5, float(slope),
                 0.02, "bending energy ∝ deflection⁴, work of the load ∝ deflection²", "absolute")


def _table(runs):
    rows = [{"model": model, "width": round(width_over_length(own_runs[0]), 2), "cells": cells,
             "load": load_number(run), "over": load_number(run) / theory(own_runs[0]),
             "squared": 1e4 * deflection(run)**2}
            for (model, cells, _), own_runs in strip_groups(runs).items()
            for run in sorted(own_runs, key=load_number) if load_number(run) < NEAR * theory(own_runs[0])]
    return Table.of("buckling", "Strips with linear stiffness", [
        "model", ("width", "width over length", ".2f"), "cells", ("load", "Γ = ρ g L³ / D"),
        ("over", "Γ / Γ* of theory", ".3f"), ("squared", "(deflection / L)²", "", "10⁻⁴")], rows)


def _springs_table(runs):
    rows = [{"model": "k_ring", "gravity": pull(run), "deflection": deflection(run)}
            for run in sorted(runs, key=pull)]
    return Table.of("buckling_springs", "Springs to ring 3", [
        "model", ("gravity", "gravity in the plane", "", "m/s²"), ("deflection", "deflection / L", ".4f")],
                    rows)
