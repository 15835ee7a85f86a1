"""Lateral buckling: upright strips of hinges deflect above a theoretical load, of springs under any."""
import right_python  # noqa: F401  (first: it may hand over to another Python)
import matplotlib.pyplot as plt
import numpy as np

from bendlab.results import registry
import strips
import style
from bendlab.results.load import group
from report import Check, Section, figure_main

# Width over length → Γ* = ρ g L³/D of a Kirchhoff plate, by Ritz's method with Legendre polynomials,
# converged to 0.1 %. A lattice of hinges has Poisson's ratio ν = -1/3. Springs in all directions have ν =
# 1/3, as central forces do: their energy
# is proportional to the mean square of the curvature along them, 3/8 (κ₁² + κ₂² + 2/3 κ₁ κ₂).
CRITICAL = {"hinges": {0.1: 20.92, 0.2: 22.16, 0.3: 23.49, 0.5: 26.30, 1.0: 33.39},
            "springs that push": {0.1: 15.148, 0.2: 16.474, 0.3: 17.929, 0.5: 21.085, 1.0: 29.387}}
POISSON = {"hinges": "−1/3", "springs that push": "1/3"}
NOTICEABLE = 1e-3  # of the length; a sheet with a larger deflection has buckled


def main(results, out):
    section = Section("Lateral buckling", "buckling")
    stiff = strips.experiment_runs(results, section, "buckling", "buckling_slow", "buckling_prestressed")
    springs = strips.experiment_runs(results, section, "buckling_springs")
    section.text = ("The strip's width stands upright and its weight acts in its plane. It stays in its "
                    "plane until Γ = ρ g L³/D reaches Γ*; then it deflects sideways. Just above Γ* the "
                    "squared deflection grows linearly with the load: a line through two points gives Γ*, "
                    "its zero. L begins half a row behind the clamp's edge; for springs to ring t, a quarter "
                    "of t rows behind. A lattice of hinges has Poisson's ratio −1/3, springs have 1/3. "
                    "Springs without linear stiffness have Γ* = 0 and a deflection proportional to the root "
                    "of the load. Springs that push in the flat sheet (prestressed) have a Γ* as hinges do.")
    for (model, cells, _), some in strip_groups(stiff).items():
        section.checks.append(Check(f"Γ* at width over length {width_over_length(some[0]):.2f}", model,
                                    strips.mesh_name(some[0]), theory(some[0]), critical_load(some),
                                    0.03 if cells > 24 else 0.05,
                                    f"Kirchhoff plate, ν = {POISSON[style.family(model)]}, Ritz"))
    section.checks.append(spring_check(springs))
    if stiff or springs:
        section.pictures.append((_picture(stiff, springs, out), "Deflection of the farthest vertex in static "
                                 "equilibrium. Left: squared, over the load divided by the theoretical "
                                 "critical load. Right: springs to ring 3; the line has the slope 1/2."))
    return section


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
    """Γ* of the strip."""
    table = CRITICAL[style.family(run.model)]
    return float(np.interp(width_over_length(run), list(table), list(table.values())))


def _rigidity(run):
    """D that the config states, in N m."""
    return run.get("/bending/flexural_rigidity") or 1 / run.get("/bending/compliance")


def width_over_length(run):
    length, width = _lengths(run)
    return width / length


def pull(run):
    """Gravity in the plane, in m/s²."""
    return -run.get("/effects/0/acceleration")[1]


def load_number(run):
    """Γ"""
    return run.get("/material/density") * pull(run) * _lengths(run)[0]**3 / _rigidity(run)


def deflection(run):
    """Largest distance of a vertex from the plane, over the length."""
    return float(np.abs(run.positions(-1)[:, 2]).max() / _lengths(run)[0])


def critical_load(runs):
    """Γ at which the line through the squares of the two smallest noticeable deflections is zero, or NaN."""
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
                 0.02, "quartic bending energy against work ∝ deflection²", "absolute")


def _picture(stiff, springs, out):
    figure, (left, right) = plt.subplots(1, 2, figsize=(10.4, 4), layout="constrained")
    found = []
    for ((model, cells, _), some), colour in zip(strip_groups(stiff).items(), style.SEQUENCE):
        expected = theory(some[0])
        some = sorted(some, key=load_number)
        left.plot([load_number(run) / expected for run in some], [1e4 * deflection(run)**2 for run in some],
                  "o-", color=colour, label=f"{style.model_name(model)}, width "
                  f"{width_over_length(some[0]):.2f} L, {cells} cells")
        found.append(critical_load(some) / expected)
    left.axvline(1, color=style.INK, linewidth=0.8)
    left.set_ylim(-0.05, 1.5), left.set_xlim(0.9, 1.1)
    left.set_xlabel("Γ / Γ* of theory"), left.set_ylabel("(deflection / L)² (10⁻⁴)")
    if found:
        left.legend(frameon=True, framealpha=0.9, edgecolor="none")  # over the line at 1
    springs = sorted(springs, key=pull)
    if springs:
        g, z = np.array([pull(run) for run in springs]), np.array([deflection(run) for run in springs])
        right.plot(g, z[0] * np.sqrt(g / g[0]), color=style.INK, linewidth=0.8)
        right.plot(g, z, "o", color=style.colour("k_ring"))
    right.set_xscale("log"), right.set_yscale("log")
    right.set_xlabel("gravity in the plane (m/s²)"), right.set_ylabel("deflection / L")
    known = [value for value in found if np.isfinite(value)]
    title = (f"Strips with linear stiffness buckle at {100 * min(known):.0f} to {100 * max(known):.0f} % of "
             "the theoretical load" if known else "Lateral buckling")
    figure.suptitle(title + ("; springs at rest buckle under any load" if springs else ""), x=0.01, ha="left",
                    fontsize=11.5)
    return style.save(figure, out, "fig_stiffness_buckling")


if __name__ == "__main__":
    figure_main(main)
