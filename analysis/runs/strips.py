"""Runs of clamped strips and their theoretical curves, for all figures of stiffness."""
import numpy as np

from bendlab.results import registry
from runs.stretch import areas
from runs.sweeps import complete_runs, leave_out, load_experiment
from tables import looks
from tables.numbers import slope
from tables.section import Check

GRAVITY = 9.81  # m/s², as in the configs
MESH_NAMES = {"equilateral": "equilateral", "same": "grid, one diagonal", "alternating": "grid, alternating",
              "both": "grid, both diagonals", "delaunay": "delaunay"}
NOTICEABLE = 1e-3  # of the length; a strip with a larger deflection has buckled
UNBALANCED = 0.005  # share of the loads; a static run with a larger unbalanced force is no equilibrium


def experiment_runs(results, section, *names):
    """Complete runs of configs/stiffness/<name>.json, without static runs whose forces are not balanced. Adds
    to the section: commands, missing points, and the runs that are left out."""
    runs, is_balanced = [], lambda run: run.summary.get("unbalanced", 0) <= UNBALANCED
    for name in names:
        complete = complete_runs(section, load_experiment(results, f"stiffness/{name}"))
        leave_out(section, [run for run in complete if not is_balanced(run)], "found no equilibrium")
        runs += filter(is_balanced, complete)
    return runs


def family(run):
    """Kind of mesh, a key of MESH_NAMES."""
    generator = run.get("/mesh/generator")
    return run.get("/mesh/diagonal") if generator == "grid" else generator


def cells(run):
    return run.get("/mesh/cells")


def mesh_kind(run):
    """The kind of a run's mesh as text."""
    return MESH_NAMES.get(family(run), family(run))


def mesh_name(run):
    """A run's mesh as text, which states the rows of equilateral triangles only if they are parallel."""
    rows = ", parallel rows" if (family(run), run.get("/mesh/rows")) == ("equilateral", "parallel") else ""
    return f"{mesh_kind(run)}{rows}, {cells(run)} cells"


def cells_range(runs):
    """(cells of the coarsest mesh, cells of the finest mesh); None without runs."""
    return (min(map(cells, runs)), max(map(cells, runs))) if runs else None


def meshes_name(runs):
    """The meshes of runs with one kind of mesh, as text."""
    coarsest, finest = cells_range(runs)
    return f"{mesh_kind(runs[0])}, {coarsest} to {finest} cells"


def check(run, name, *numbers, model="", **more):
    """A check of a number of a run; `numbers` and `more` are the other arguments of Check."""
    return Check(name, model or run.model, mesh_name(run), *numbers, **more)


def model_name(run):
    return looks.model_name(run.model, run.get("/bending/k_ring/k"))


def gravity(run, axis=2):
    """Minus the acceleration along an axis, in m/s²."""
    return -run.get("/effects/0/acceleration", [0, 0, -GRAVITY])[axis]


def number(run, name):
    """A metric of a run; NaN if the run lacks the metric."""
    return run.summary.get(name, np.nan)


def fit(run, name):
    """B, C or the exponent of the fit of moment against curvature."""
    return number(run, f"stiffness_fit_{name}")


def droop(run):
    """H/W: H is how far the free end hangs down, W is how far this end reaches out."""
    return number(run, "stiffness_height_over_width")


def rigidity(run):
    """B in N m, from H/W and the curve of the heavy elastica."""
    return number(run, "stiffness_flexural_rigidity")


def stated(run):
    """The physical stiffness in the config: C in N m³ for springs at rest, B in N m for other models."""
    bending = run.get("/bending")
    if not registry.has_springs_at_rest(run.model):
        return bending["flexural_rigidity"]
    return bending.get("quartic_coefficient") or bending["flexural_rigidity"] / bending["at_curvature"]**2


def measured(run):
    """The physical stiffness from H/W, in the unit of stated()."""
    return number(run, "stiffness_quartic") if registry.has_springs_at_rest(run.model) else rigidity(run)


def share_of_droop(run):
    """Stiffness from H/W over the stated stiffness."""
    return measured(run) / stated(run)


def load_number(run, flexural_rigidity):
    """Γ = ρ g L³/B for this B; L is the effective length, from a point behind the clamp's edge."""
    return number(run, "stiffness_gamma") * rigidity(run) / flexural_rigidity


def elastica_droop(loads):
    """H/W of the heavy elastica (a strip that bends under its weight) for Γ = loads."""
    reach, height = elastica(loads)[-1]
    return height / reach


def elastica(loads):
    """(points, 2, loads) the heavy elastica for Γ = loads: reach from the clamp and height below it, over the
    length. Solves B θ'' + ρ g (L - s) cos θ = 0, θ(0) = 0, θ'(L) = 0 by Runge-Kutta and bisection."""
    loads = np.asarray(loads, float)
    steps = 400
    h = 1 / steps

    def shoot(slope):
        theta, curve = np.zeros_like(loads), [np.zeros((2, *loads.shape))]
        steep, flat = (np.zeros(loads.shape, bool) for _ in range(2))
        bend = lambda s, angle: -loads * (1 - s) * np.cos(angle)
        for s in np.arange(steps) * h:
            k1, l1 = slope, bend(s, theta)
            k2, l2 = slope + h / 2 * l1, bend(s + h / 2, theta + h / 2 * k1)
            k3, l3 = slope + h / 2 * l2, bend(s + h / 2, theta + h / 2 * k2)
            k4, l4 = slope + h * l3, bend(s + h, theta + h * k3)
            after = theta + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
            slope = slope + h / 6 * (l1 + 2 * l2 + 2 * l3 + l4)
            middle = (theta + after) / 2 + h / 8 * (k1 - k4)  # angle at half a step, for Simpson's rule
            curve.append(curve[-1] + h / 6 * np.array([of(theta) + 4 * of(middle) + of(after)
                                                       for of in (np.cos, np.sin)]))
            theta = after
            steep |= (theta > np.pi / 2) & ~flat  # past the vertical, the weight bends the strip further
            flat |= (slope < 0) & ~steep
        return ~flat, np.array(curve)

    # Upper bounds of the slope at the clamp: Γ/2 (a flat strip), √(2Γ) (the whole weight at the free end).
    low, high = np.zeros_like(loads), np.minimum(loads / 2, np.sqrt(2 * loads))
    for _ in range(50):
        middle = (low + high) / 2
        too_steep = shoot(middle)[0]
        low, high = np.where(too_steep, low, middle), np.where(too_steep, middle, high)
    return shoot((low + high) / 2)[1]


def ring_pairs(triangles, count, ring):
    """(S, 2) vertex pairs that are exactly `ring` edges apart."""
    neighbours = [set() for _ in range(count)]
    for triangle in triangles.tolist():
        for corner in triangle:
            neighbours[corner].update(triangle)
    pairs = []
    for vertex in range(count):
        seen = front = {vertex}
        for _ in range(ring):
            front = set().union(*(neighbours[v] for v in front)) - seen
            seen = seen | front
        pairs += [(vertex, other) for other in front if other > vertex]
    return np.array(pairs, int).reshape(-1, 2)


def expected_quartic(rest, triangles, pinned, ring, stiffness):
    """C in N m³ of an equilateral lattice with springs to one ring and rows across the strip. `stiffness`:
    stiffness of a spring in N/m. The sheet bends as a polyhedral cylinder: rows of vertices are h apart and
    stay straight, and the strip turns by κh at each row. A spring of length l over n rows shortens by
    n² (n² - 1) h⁴ κ² / 24 l. The energy of all springs per area is C κ⁴ / 4. Springs end at the free sides,
    so that C is smaller than on an infinite lattice. Only springs away from the clamp and the free end
    count."""
    pairs = ring_pairs(triangles, len(rest), ring)
    rows = np.unique(np.round(rest[:, 0], 7))
    h = (rows[-1] - rows[0]) / (len(rows) - 1)
    clamp, length = rest[pinned, 0].max(), rest[:, 0].max() - rest[pinned, 0].max()
    width = areas(rest, triangles).sum() / (rows[-1] - rows[0])
    ends = np.sort(rest[pairs][:, :, 0], axis=1) - clamp
    spanned = np.round((ends[:, 1] - ends[:, 0]) / h)
    at_rest = np.linalg.norm(rest[pairs[:, 0]] - rest[pairs[:, 1]], axis=1)
    shortening = spanned**2 * (spanned**2 - 1) * h**4 / (24 * at_rest)
    low, high = ring * h, length - ring * h
    inside = np.maximum(np.minimum(ends[:, 1], high) - np.maximum(ends[:, 0], low), 0)
    inside /= np.maximum(ends[:, 1] - ends[:, 0], h / 2)
    return 2 * stiffness * float((shortening**2 * inside).sum()) / ((high - low) * width)


def largest_ratio(values):
    """Largest over smallest value. NaN if a value is not known or not positive, or for fewer than two."""
    values = np.array([*values], float)
    return float(values.max() / values.min()) if len(values) > 1 and values.min() > 0 else np.nan


def exponent(runs):
    """The exponent p of H/W ∝ g^p (g: gravity), from the runs with H/W below 0.3; NaN for fewer than two."""
    small = [run for run in runs if droop(run) < 0.3]
    return slope(list(map(gravity, small)), list(map(droop, small)))


def exponent_check(name, runs, expected, source):
    return Check("slope of ln H/W over ln g at H/W < 0.3", name, mesh_name(runs[0]), expected, exponent(runs),
                 0.02, source, "absolute")


def as_stated(*columns):
    """Lines at 1 in a chart of these columns: 1 means that the stiffness is as stated."""
    return [(column, 1, "as stated") for column in columns]


def threshold(points):
    """The load at which a line through the two smallest noticeable squared deflections is zero; NaN without
    two. `points`: (load, deflection over length)."""
    squares = sorted((load, deflection**2) for load, deflection in points if deflection > NOTICEABLE)[:2]
    if len(squares) < 2:
        return np.nan
    (low, small), (high, large) = squares
    return low - small * (high - low) / (large - small)
