"""Distances between cloths with the same vertices, (V, 3) in m, and between groups of runs."""
import itertools
from functools import lru_cache

import numpy as np

from bendlab.results.load import load_run, spread

BLOCK = 128  # vertices measured at once


def rms_distance(a, b):
    """Root mean square distance between corresponding vertices, in m."""
    return float(np.sqrt(((a - b) ** 2).sum(axis=1).mean()))


def hausdorff_distance(a, b):
    """Largest distance from a vertex of either cloth to the nearest vertex of the other, in m. The distance
    is exact for the vertices. For the surfaces, it is too large by at most half of the longest edge."""
    return max(_farthest(a, b), _farthest(b, a))


def _farthest(a, b):
    """Largest distance from a vertex of a to the nearest of b. A few vertices of b give an upper bound for
    each vertex of a. Exact distances follow, largest bound first, until no bound exceeds the largest
    distance."""
    bound = np.concatenate([_nearest(a[i:i + BLOCK], b[::16]) for i in range(0, len(a), BLOCK)])
    order = np.argsort(-bound)
    farthest = 0.0
    for start in range(0, len(a), BLOCK):
        block = order[start:start + BLOCK]
        if bound[block[0]] <= farthest:
            break
        farthest = max(farthest, _nearest(a[block], b).max())
    return float(farthest)


def _nearest(points, targets):
    """(n) distance from each point to the nearest target."""
    squared = sum((points[:, None, axis] - targets[None, :, axis]) ** 2 for axis in range(3))
    return np.sqrt(squared.min(axis=1))


def turned_onto(a, b, centre):
    """`a`, turned about the vertical through `centre` so that it lies nearest to `b` (least squares)."""
    p, q = (a - centre)[:, :2], (b - centre)[:, :2]
    angle = np.arctan2((p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0]).sum(), (p * q).sum())
    turn = np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
    result = a.copy()
    result[:, :2] = p @ turn + centre[:2]
    return result


def at_rest(run, other, where=slice(None)):
    """RMS distance of the last frames of two runs, in sizes of the sheet, after the best turn about the
    vertical through the pins, because only the shape counts. `where`: the compared vertices."""
    a, b, seeds = run.positions(-1), other.positions(-1), run.pin_seeds
    centre = (a[seeds] if len(seeds) else a).mean(axis=0)
    return rms_distance(turned_onto(a, b, centre)[where], b[where]) / run.size


def in_first_second(run, other, where=slice(None)):
    """RMS distance of two runs at equal times, in sizes of the sheet; mean over the first second. ValueError
    if the runs were recorded at different times."""
    frames = [frame for frame, time in enumerate(run.metrics["time"]) if 0 < time <= 1 + 1e-9]
    if not np.allclose(*(np.asarray(each.metrics["time"])[frames] for each in (run, other))):
        raise ValueError(f"{run.file} and {other.file} have frames at different times")
    distances = [rms_distance(run.positions(frame)[where], other.positions(frame)[where])
                 for frame in frames]
    return float(np.mean(distances)) / run.size


def between_runs(runs, other_runs):
    """(RMS, Hausdorff) distances as spreads, in sizes of the sheet, over all pairs of one run from each group
    with different seeds. With the same group twice, the result is the distance between two runs of one scene,
    with which other distances of chaotic sheets are compared."""
    pairs = itertools.combinations(runs, 2) if runs is other_runs else itertools.product(runs, other_runs)
    apart = [_apart(a, b) for a, b in pairs if a.get("/initial/seed") != b.get("/initial/seed")]
    return tuple(spread([distances[kind] for distances in apart]) for kind in (0, 1))


def _apart(a, b):
    """(RMS, Hausdorff) distance of two runs, in sizes of the sheet; infinite if a run diverged. RMS is the
    median over the last second; Hausdorff is from the last frame."""
    if not (a.complete and b.complete):
        return np.inf, np.inf
    first, second = _last_second(a.file), _last_second(b.file)
    rms = np.median([rms_distance(p, q) for p, q in zip(first, second, strict=True)])
    return rms / a.size, hausdorff_distance(first[-1], second[-1]) / a.size


@lru_cache(maxsize=64)
def _last_second(file):
    run = load_run(file)
    return [run.positions(frame) for frame in run.last_second()]
