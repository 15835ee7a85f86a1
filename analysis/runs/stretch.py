"""Where a cloth is stretched: σ₁ of the triangles, and their distances from the pins.

σ₁, the largest principal stretch of a triangle, is the largest singular value of its deformation gradient: in
its most stretched direction, a triangle is σ₁ times as long as at rest. Here σ₁ is computed from the recorded
positions, and not read from the run file, so that the program's metric can be checked.
"""
from dataclasses import dataclass

import numpy as np

from bendlab.results.load import spread, statuses, summary_spread

WRONG = 1.0  # σ₁ − 1; above it a triangle has failed: it is more than twice as long as at rest
NEAR = 2.0  # cells; triangles nearer than this to a pinned vertex count as at the pin
PER_DOUBLING = 2  # bins of distance; with fewer, the first cells share a bin; with more, bins are empty
USUAL = 0.9  # share of the triangles of a bin that are stretched less than the number Group.usual of the bin


def principal_stretch(rest, positions, triangles):
    """(T) σ₁ of each triangle from (V, 3) positions, (F, T) from (F, V, 3).

    NaN where a triangle has no area at rest.
    """
    a, b, c = triangles.T
    side, slope = rest[b] - rest[a], rest[c] - rest[a]
    length = np.linalg.norm(side, axis=1)
    with np.errstate(divide="ignore", invalid="ignore"):
        unit = side / length[:, None]
        along = (slope * unit).sum(axis=1)
        height = np.linalg.norm(slope - along[:, None] * unit, axis=1)
        # The columns of the deformation gradient in the rest frame (unit, its normal in the triangle)
        first = (positions[..., b, :] - positions[..., a, :]) / length[:, None]
        second = (positions[..., c, :] - positions[..., a, :] - along[:, None] * first) / height[:, None]
        s11, s22, s12 = ((x * y).sum(axis=-1) for x, y in ((first, first), (second, second), (first, second)))
        # The larger eigenvalue of FᵀF
        largest = np.sqrt((s11 + s22 + np.hypot(s11 - s22, 2 * s12)) / 2)
    return np.where(height > 1e-9 * length, largest, np.nan)  # relative: no unit of length


def ring_of(triangles, centre, count):
    """(V) number of edges from `centre` to every vertex, breadth-first."""
    distance = np.full(count, -1)
    distance[centre] = 0
    ring = 0
    while True:
        here = distance == ring
        touched = np.unique(triangles[here[triangles].any(axis=1)])
        new = touched[distance[touched] < 0]
        if not len(new):
            return distance
        ring += 1
        distance[new] = ring


def distance_from_pins(rest, triangles, pinned):
    """(T) distance at rest from the middle of each triangle to the nearest pinned vertex; ∞ without pins."""
    middle = rest[triangles].mean(axis=1)
    distance = np.full(len(triangles), np.inf)
    for pin in rest[pinned]:
        distance = np.minimum(distance, np.linalg.norm(middle - pin, axis=1))
    return distance


@dataclass
class Stretched:
    """The triangles of a run that can move, in the last simulated second. Lengths in m."""

    distance: np.ndarray  # (T) at rest, from the nearest pinned vertex
    ring: np.ndarray  # (T) edges from the pinned vertices to the triangle's farthest corner
    excess: np.ndarray  # (F, T) σ₁ − 1; ∞ where it is not finite
    cell: float  # side of a cell at rest
    disagreement: float  # largest relative difference between the largest σ₁ of a frame and the run's metric

    def largest(self, where=slice(None)):
        """Largest σ₁ − 1 of the chosen triangles, median over the frames."""
        return float(np.median(self.excess[:, where].max(axis=1)))

    @property
    def at_pin(self):
        """(T) whether a triangle is within NEAR cells of a pinned vertex."""
        return self.distance <= NEAR * self.cell

    @property
    def worst(self):
        """(F) index of the most stretched triangle of each frame."""
        return self.excess.argmax(axis=1)

    def over_distance(self, edges, share=1.0):
        """(B) quantile `share` of σ₁ − 1 among the triangles of each bin, median over frames.

        NaN: no triangle.
        """
        bins = np.digitize(self.distance, edges) - 1
        return np.array([np.median(np.quantile(self.excess[:, bins == i], share, axis=1))
                         if (bins == i).any() else np.nan for i in range(len(edges) - 1)])


def stretched(run):
    """The Stretched of a run. Triangles whose three corners are pinned are left out: they cannot stretch."""
    rest, triangles, pinned = run.rest_positions, run.triangles, run.pinned
    frames = run.last_second()
    free = triangles[~pinned[triangles].all(axis=1)]
    positions = np.stack([run.positions(frame) for frame in frames])
    stretch = principal_stretch(rest, positions, free)
    stretch = np.where(np.isfinite(stretch), stretch, np.inf)
    recorded = run.metrics["max_stretch"][frames]
    return Stretched(distance_from_pins(rest, free, pinned),
                     ring_of(triangles, pinned, len(rest))[free].max(axis=1), stretch - 1,
                     run.get("/mesh/width", 1) / run.get("/mesh/cells"),
                     float(np.max(np.abs(stretch.max(axis=1) / recorded - 1))))


def bin_edges(smallest, largest):
    """Edges of bins of distance from `smallest` to above `largest`, PER_DOUBLING for each doubling. The edges
    are powers of 2^(1/PER_DOUBLING) in m for every mesh, so that bins of two meshes are equal."""
    first = np.floor(PER_DOUBLING * np.log2(smallest))
    last = np.floor(PER_DOUBLING * np.log2(largest)) + 1
    return 2.0 ** (np.arange(first, last + 1) / PER_DOUBLING)


@dataclass
class Group:
    """Runs that differ only in their seed. Distances in m; stretch is σ₁ − 1."""

    n: int  # cells per side
    cell: float  # side of a cell
    status: dict  # verdict → runs
    near: object  # Spread: largest within NEAR cells of a pinned vertex
    far: object  # Spread: largest farther away
    whole: object  # Spread: largest anywhere
    place: object  # Spread: distance of the most stretched triangle from the nearest pinned vertex
    range: tuple  # 10 % and 90 % quantiles of this distance, over frames and seeds
    ring: float  # edges from pinned vertices to this triangle's farthest corner; median, frames and seeds
    rings: tuple  # 10 % and 90 % quantiles of this number
    reach: float  # ring at which the springs of pinned vertices end (n of eq. 7); NaN without n
    worst: list  # (B) Spreads: largest in each bin of distance
    usual: np.ndarray  # (B) quantile USUAL in each bin, median over seeds
    edges: np.ndarray  # (B + 1)
    disagreement: float

    @property
    def middles(self):
        return np.sqrt(self.edges[1:] * self.edges[:-1])

    @property
    def in_cells(self):
        """Distance of the most stretched triangle from the nearest pinned vertex, in cells."""
        return self.place.median / self.cell

    @property
    def failed(self):
        return self.whole.median > WRONG


def measure(runs):
    """Measures these runs, which differ only in their seed."""
    parts = [stretched(run) for run in runs]
    edges = bin_edges(min(part.distance.min() for part in parts), max(p.distance.max() for p in parts))
    of = lambda value: spread([value(part) for part in parts])
    middle = lambda numbers: tuple(np.quantile(numbers, [0.1, 0.9]))
    worst = np.array([part.over_distance(edges) for part in parts])
    usual = np.array([part.over_distance(edges, USUAL) for part in parts])
    places, rings = (np.concatenate([getattr(part, name)[part.worst] for part in parts])
                     for name in ("distance", "ring"))
    return Group(n=runs[0].get("/mesh/cells"), cell=parts[0].cell, status=statuses(runs),
                 near=of(lambda part: part.largest(part.at_pin)),
                 far=of(lambda part: part.largest(~part.at_pin)), whole=of(lambda part: part.largest()),
                 place=of(lambda part: np.median(part.distance[part.worst])), range=middle(places),
                 ring=float(np.median(rings)), rings=middle(rings),
                 reach=summary_spread(runs, "model_n").median, worst=[spread(column) for column in worst.T],
                 usual=np.median(usual, axis=0), edges=edges,
                 disagreement=max(part.disagreement for part in parts))
