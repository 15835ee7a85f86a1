"""Where a cloth is stretched: σ₁ of the triangles, and their distances from the pins.

σ₁, the largest principal stretch of a triangle, is the largest singular value of its deformation gradient: in
its most stretched direction, a triangle is σ₁ times as long as at rest. Here σ₁ is computed from the recorded
positions, and not read from the run file, so that the program's metric can be checked.
"""
import itertools

import numpy as np

from bendlab.results.load import spread, statuses, summary_spread

WRONG = 1.0  # σ₁ − 1; above it a triangle has failed: it is more than twice as long as at rest
NEAR = 2.0  # cells; triangles nearer than this to a pinned vertex count as at the pin
PER_DOUBLING = 2  # bins of distance; with fewer, the first cells share a bin; with more, bins are empty
USUAL = 0.9  # share of the triangles of a bin that are stretched less than the number Group.usual of the bin


def areas(points, triangles):
    """(T) areas of the triangles."""
    a, b, c = points[triangles].swapaxes(0, 1)
    return np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2


def principal_stretches(rest, positions, triangles):
    """(2, T) σ₁ and σ₂ of each triangle from (V, 3) positions, (2, F, T) from (F, V, 3). NaN where a triangle
    has no area at rest."""
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
        # The eigenvalues of FᵀF
        apart = np.hypot(s11 - s22, 2 * s12)
        stretches = np.sqrt(np.maximum([s11 + s22 + apart, s11 + s22 - apart], 0) / 2)
    return np.where(height > 1e-9 * length, stretches, np.nan)  # relative: no unit of length


def ring_of(triangles, centre, count):
    """(V) number of edges from `centre` to every vertex, breadth-first."""
    distance = np.full(count, -1)
    distance[centre] = 0
    for ring in itertools.count(1):
        touched = np.unique(triangles[(distance[triangles] == ring - 1).any(axis=1)])
        new = touched[distance[touched] < 0]
        if not len(new):
            return distance
        distance[new] = ring


def distance_from_pins(rest, triangles, pinned):
    """(T) distance at rest from the middle of each triangle to the nearest pinned vertex; ∞ without pins."""
    middle = rest[triangles].mean(axis=1)
    distance = np.full(len(triangles), np.inf)
    for pin in rest[pinned]:
        distance = np.minimum(distance, np.linalg.norm(middle - pin, axis=1))
    return distance


class Stretched:
    """The triangles of a run that can move, in the last simulated second. Lengths in m. Triangles whose three
    corners are pinned are left out: they cannot stretch."""

    def __init__(self, run):
        rest, triangles, pinned, frames = run.rest_positions, run.triangles, run.pinned, run.last_second()
        free = triangles[~pinned[triangles].all(axis=1)]
        stretch = principal_stretches(rest, run.trajectory(frames), free)[0]
        stretch = np.where(np.isfinite(stretch), stretch, np.inf)
        recorded = run.metrics["max_stretch"][frames]
        self.excess = stretch - 1  # (F, T) σ₁ − 1; ∞ where it is not finite
        self.distance = distance_from_pins(rest, free, pinned)  # (T) at rest, from the nearest pinned vertex
        # (T) edges from the pinned vertices to the triangle's farthest corner
        self.ring = ring_of(triangles, pinned, len(rest))[free].max(axis=1)
        self.cell = run.get("/mesh/width", 1) / run.get("/mesh/cells")  # side of a cell at rest
        # Largest relative difference between the largest σ₁ of a frame and the run's metric
        self.disagreement = float(np.abs(stretch.max(axis=1) / recorded - 1).max())

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
        """(B) quantile `share` of σ₁ − 1 among the triangles of each bin, median over frames; NaN without
        triangles."""
        bins = np.digitize(self.distance, edges) - 1
        return np.array([np.median(np.quantile(self.excess[:, bins == i], share, axis=1))
                         if (bins == i).any() else np.nan for i in range(len(edges) - 1)])


def bin_edges(smallest, largest):
    """Edges of bins of distance from `smallest` to above `largest`, PER_DOUBLING for each doubling. The edges
    are powers of 2^(1/PER_DOUBLING) in m for every mesh, so that bins of two meshes are equal."""
    first = np.floor(PER_DOUBLING * np.log2(smallest))
    last = np.floor(PER_DOUBLING * np.log2(largest)) + 1
    return 2.0 ** (np.arange(first, last + 1) / PER_DOUBLING)


class Group:
    """Runs that differ only in their seed. Distances in m; stretch is σ₁ − 1; a Spread is over seeds."""

    def __init__(self, runs):
        parts = [Stretched(run) for run in runs]
        ends = lambda numbers: tuple(np.quantile(numbers, [0.1, 0.9]))
        self.n, self.cell, self.status = runs[0].get("/mesh/cells"), parts[0].cell, statuses(runs)
        # Spreads of the largest stretch within NEAR cells of a pinned vertex, farther away, and anywhere
        self.near = spread([part.largest(part.at_pin) for part in parts])
        self.far = spread([part.largest(~part.at_pin) for part in parts])
        self.whole = spread([part.largest() for part in parts])
        # Distance of the most stretched triangle from the nearest pinned vertex: Spread, and 10 % and 90 %
        # quantiles over frames and seeds
        places = [part.distance[part.worst] for part in parts]
        self.place, self.range = spread([np.median(place) for place in places]), ends(np.concatenate(places))
        # Edges from pinned vertices to this triangle's farthest corner: median and these quantiles
        rings = np.concatenate([part.ring[part.worst] for part in parts])
        self.ring, self.rings = float(np.median(rings)), ends(rings)
        # Ring at which the springs of pinned vertices end (n of eq. 7); NaN without n
        self.reach = summary_spread(runs, "model_n").median
        # Bins of distance: middles, Spreads of the largest stretch, quantiles USUAL (median over seeds)
        distances = np.concatenate([part.distance for part in parts])
        edges = bin_edges(distances.min(), distances.max())
        self.middles = np.sqrt(edges[1:] * edges[:-1])
        self.worst = list(map(spread, zip(*(part.over_distance(edges) for part in parts))))
        self.usual = np.median([part.over_distance(edges, USUAL) for part in parts], axis=0)
        self.disagreement = max(part.disagreement for part in parts)

    @property
    def in_cells(self):
        """Distance of the most stretched triangle from the nearest pinned vertex, in cells."""
        return self.place.median / self.cell

    @property
    def failed(self):
        return self.whole.median > WRONG
