"""Runs of the verification page: names of their models and meshes, displacements, and convergence."""
import math
from dataclasses import dataclass

import numpy as np

from bendlab.results.load import group
from runs.sweeps import complete_runs, leave_out, load_experiment
from tables import looks
from truths import order

UNBALANCED = 1e-4  # share of the loads; a static run with a larger unbalanced force is no equilibrium
NEAR = 0.01  # relative; a limit that is nearer to the truth agrees with it
KNOWN = 0.05  # relative; a row with a larger uncertainty says nothing
FAMILIES = {"same": "one diagonal", "alternating": "alternating", "both": "both diagonals",
            "delaunay": "irregular", "equilateral": "equilateral"}
MEASURES = {"mid_edge": "tan", "discrete_shells": "theta"}  # the default measure of a model
# Order of convergence in theory: of Morley's triangle and of the discrete Kirchhoff triangle, as of linear
# triangles of the membrane, in energies and displacements. For other models no order is known.
ORDERS = {"mid_edge": 2.0, "dkt": 2.0}


def runs_of(results, section, *configs):
    """Complete runs of configs/verification/<config>.json, without static runs whose forces are not balanced,
    and without runs that had to come to rest, but did not. The section names the runs that are left out."""
    def is_balanced(run):
        if "settled_at" in run.summary:  # forces balance up to the rounding of positions, or nothing moves
            return True
        return run.get("/settled_speed", 0) == 0 and run.summary.get("unbalanced", 0) <= UNBALANCED
    runs = []
    for config in configs:
        complete = complete_runs(section, load_experiment(results, f"verification/{config}"))
        leave_out(section, [run for run in complete if not is_balanced(run)], "found no equilibrium")
        runs += filter(is_balanced, complete)
    return runs


def model(run):
    """The name of a run's model, with its measure if that is not the default."""
    own = run.get(f"/bending/{run.model}/measure")
    name = looks.model_name(run.model)
    return f"{name} ({own})" if own and own != MEASURES.get(run.model) else name


def family(run):
    """The kind of a run's mesh."""
    generator = run.get("/mesh/generator")
    name = FAMILIES.get(run.get("/mesh/diagonal") if generator == "grid" else generator, generator)
    return f"{name} 4:1" if run.get("/mesh/aspect", 1) == 4 else name


def corner_displacement(run, place):
    """The displacement of the vertex that is nearest to `place` at rest, from rest to the last frame."""
    rest = run.rest_positions
    return displacement(run, int(np.argmin(np.linalg.norm(rest - np.asarray(place), axis=1))))


def displacement(run, vertex):
    """The displacement of a vertex from rest to the last frame."""
    return run.positions(-1)[vertex] - run.rest_positions[vertex]


@dataclass
class Converging:
    """A number of a model on a family of meshes against its truth."""

    rows: list  # {"h": mesh size, "value": number}, coarsest first
    truth: float
    result: order.Convergence | None  # None: fewer than three meshes
    formal: float | None = None  # order in theory

    @property
    def finest(self):
        return self.rows[-1]["value"]

    @property
    def off(self):
        """Relative error on the finest mesh."""
        return self.finest / self.truth - 1

    @property
    def uncertainty(self):
        """Relative uncertainty of the finest value; NaN if convergence is not known."""
        if self.result is None or not math.isfinite(self.result.index):
            return math.nan
        return abs(self.result.uncertainty / self.truth)

    @property
    def verdict(self):
        """What the three finest meshes show."""
        if self.result is None:
            return "too few meshes"
        if self.result.kind == "divergent":
            return "does not converge"
        apart = abs(self.result.limit / self.truth - 1)
        if apart <= NEAR or abs(self.off) <= max(self.uncertainty, 1e-9) and self.uncertainty <= KNOWN:
            return "agrees"
        if self.uncertainty > KNOWN:
            return "not resolved"
        return f"converges to {self.result.limit / self.truth:.3f}"

    def cells(self):
        """The values of the columns of columns()."""
        known = self.result is not None and self.result.kind == "monotonic"
        return {"finest": self.finest / self.truth, "off": 100 * self.off,
                "order": self.result.order if known else math.nan, "formal": self.formal or math.nan,
                "limit": self.result.limit / self.truth if known else math.nan,
                "bar": 100 * self.uncertainty, "verdict": self.verdict}


def columns():
    """The columns that cells() fills."""
    return [("finest", "finest mesh over truth", ".4f"), ("off", "error", "+.2f", "%"),
            ("order", "observed order", ".2f"), ("formal", "order in theory", ".0f"),
            ("limit", "limit over truth", ".4f"),
            ("bar", "uncertainty", ".2g", "%", "grid convergence index (Roache 1994) of the finest mesh, "
             "from the three finest meshes, relative to the truth"), "verdict"]


def converging(runs, value, truth, size=lambda run: run.summary["edge_length"], orders=ORDERS):
    """Converging of runs that differ only in the size of their cells. `value`: run → number. `orders`: the
    order in theory of each model for which it is known."""
    rows = sorted(({"h": size(run), "value": value(run), "run": run} for run in runs),
                  key=lambda row: -row["h"])
    return of_rows(rows, truth, orders.get(runs[0].model))


def of_rows(rows, truth, formal):
    """Converging of {"h": mesh size, "value": number}, coarsest first. `formal`: order in theory, or None."""
    last = rows[-3:]
    sizes = [row["h"] for row in last]
    made = None
    if len(last) == 3 and len(set(sizes)) == 3 and all(math.isfinite(row["value"]) for row in last):
        made = order.converge(sizes, [row["value"] for row in last], formal)
    return Converging(rows, truth, made, formal)


def by_model_and_family(runs, *more):
    """{(model, family, …): runs}; `more`: run → a further part of the key."""
    return group(runs, lambda run: (model(run), family(run), *(key(run) for key in more)))
