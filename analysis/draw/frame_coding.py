"""Compresses moving vertices: each integer is predicted from integers that are decoded earlier, and the error
of the prediction (the remainder) is deflated.

Positions are integer multiples of a step. The motion D of a vertex v is predicted from its motion in the last
frame, and from the motions of six near vertices with smaller numbers, the parents p1 … p6 of v:

    D(t, v) = x(t, v) - x(t-1, v) ≈ (Σ w_k f_k + ½ · 2¹²) >> 12
    f = D(t-1, v), D(t, p1) … D(t, p6), D(t-1, p1) … D(t-1, p6)

The weights w are fitted to the run. Vertices whose parents have the same arrangement form a group with its
own weights. Remainders are sorted into classes by the size of remainders nearby, because neighbours have
remainders of similar size, and equal sizes deflate better. `viewer/src/player/decode.js` decodes the frames.
Shapes: F frames, V vertices, T triangles.
"""
import itertools
import zlib
from collections import namedtuple
from functools import lru_cache

import numpy as np

ONE = 1 << 12  # weights are integers in units of 1 / ONE
PARENTS = 6
GROUPS = 16
CLASSES = 16  # of remainders, by the logarithm of the remainders nearby
LEVELS = 65535  # steps along the largest side of a run's bounding box: 16 bits
# Weights of v and p1 … p3 for slow, uniform and swinging motion. encode() also tries weights that it fits.
FIXED = ((0, (1, 0, 0), (0, 0, 0)), (0, (.5, .5, 0), (0, 0, 0)), (1, (.5, .5, 0), (-.5, -.5, 0)))
SAMPLE = 60_000  # vertices · frames from which a predictor is chosen
# All frames after the first. `data`: the low bytes of all classes, then the high bytes of all classes;
# deflated. `weights`: (GROUPS, 1 + 2 · PARENTS) in units of 1 / ONE; [] for a group without vertices.
# `counts`: (CLASSES) numbers in each class.
Coded = namedtuple("Coded", "data weights counts")


@lru_cache(maxsize=2)  # runs of a sweep share a mesh
def lineage(triangles, vertices):
    """(V, PARENTS) the parents of each vertex, and (V) its group. `triangles`: the bytes of an array of int.

    p1, p2, p3 are the neighbours with the largest numbers that are smaller than the number of the vertex. p4
    lies across the edge p1 p2; p5 and p6 lie behind p1 and p2. If one of these vertices does not exist,
    another parent is used twice. Vertex 0 is its own parent.
    """
    near = [set() for _ in range(vertices)]
    for corners in np.frombuffer(triangles, int).reshape(-1, 3).tolist():
        for a, b in itertools.permutations(corners, 2):
            near[a].add(b)
    parents, groups = np.zeros((vertices, PARENTS), int), np.zeros(vertices, int)
    for v in range(1, vertices):
        earlier = sorted((u for u in near[v] if u < v), reverse=True)
        if not earlier:
            parents[v] = v - 1
            continue
        p1, p2, p3 = (earlier + earlier[-1:] * 2)[:3]
        p4 = max((u for u in near[p1] & near[p2] if u < v and u not in near[v]), default=p3)
        taken = {p1, p2, p3, p4}
        p5, p6 = (max((u for u in near[p] if u < p and u not in taken), default=p) for p in (p1, p2))
        parents[v] = p1, p2, p3, p4, p5, p6
        groups[v] = 4 * min(len(earlier), 3) + 2 * (p4 != p3) + (p5 != p1)
    return parents, groups


def encode(frames, parents, groups):
    """Encodes all frames after the first. `frames`: (F, V, 3) integers from 0 to LEVELS, with the first."""
    motion = np.diff(frames.astype(np.int32), axis=0, prepend=frames[:1])  # frame 0 has no motion
    remainder, weights = np.empty_like(motion), [[]] * GROUPS
    for group in np.unique(groups):
        members = np.flatnonzero(groups == group)
        best = _best(motion, parents, members)
        remainder[:, members] = motion[:, members] - _predicted(_features(motion, parents, members), best)
        weights[group] = best.tolist()
    remainder = _wrapped(remainder[1:])
    classes = _classes(np.abs(remainder), parents).ravel()
    folded = ((remainder << 1) ^ (remainder >> 31)).astype(np.uint32).astype(np.uint16).ravel()
    folded = folded[np.argsort(classes, kind="stable")]
    planes = (folded & 255).astype(np.uint8).tobytes() + (folded >> 8).astype(np.uint8).tobytes()
    return Coded(deflated(planes), weights, np.bincount(classes, minlength=CLASSES).tolist())


_level = 9  # of compression; level 1 takes a third of the time, but makes a page a quarter larger


def compress_quickly():
    """Lets this process compress less but faster, for a page that is soon written again."""
    global _level
    _level = 1


def deflated(data):
    """Deflated bytes, which the browser's DecompressionStream("deflate") can read."""
    packer = zlib.compressobj(_level, zlib.DEFLATED, 15, 9)
    return packer.compress(data) + packer.flush()


def _features(motion, parents, members):
    """The terms f of the prediction for the n vertices `members`: 1 + 2 · PARENTS arrays (F, n, 3)."""
    before = np.concatenate([np.zeros_like(motion[:1]), motion[:-1]])
    near = parents[members].T
    now = [motion[:, p] for p in near]
    for parent in now:
        parent[:, members == 0] = 0  # vertex 0 is its own parent
    return [before[:, members], *now, *(before[:, p] for p in near)]


def _predicted(features, weights):
    total = np.full(features[0].shape, ONE // 2, np.int64)
    for feature, weight in zip(features, weights):
        if weight:
            total += weight * feature.astype(np.int64)
    return (total >> 12).astype(np.int32)


def _wrapped(numbers):
    """The numbers modulo 2¹⁶, in the range from -2¹⁵ to 2¹⁵ - 1."""
    return ((numbers + 32768) & 65535) - 32768


def _classes(size, parents):
    """(F, V, 3) class of each remainder, from the sizes of remainders that are decoded earlier: of two
    parents, of the same vertex in the last frame, and of the last coordinate."""
    before = np.concatenate([np.zeros_like(size[:1]), size[:-1]])
    near = size[:, parents[:, 0]] + size[:, parents[:, 1]] + 2 * before
    near[:, 0] = before[:, 0]
    near[..., 1:] += size[..., :-1]
    return np.minimum(np.frexp(near + 1)[1] - 1, CLASSES - 1).astype(np.uint8)  # log2, rounded down


def _best(motion, parents, members):
    """(1 + 2 · PARENTS) the weights, in units of 1 / ONE, with the smallest remainders in a sample."""
    rest = (0,) * (PARENTS - 3)
    candidates = [np.rint(np.array((own, *now, *rest, *then, *rest)) * ONE).astype(int)
                  for own, now, then in FIXED]
    if len(motion) < 3:
        return candidates[0]
    random = np.random.default_rng(1)
    chosen = np.sort(random.permutation(np.arange(2, len(motion)))[:max(2, SAMPLE // len(members))])
    parts = [_features(motion[frame - 1:frame + 1], parents, members) for frame in chosen]
    features = [np.concatenate([part[k][1].ravel() for part in parts]) for k in range(1 + 2 * PARENTS)]
    wanted = motion[chosen][:, members].ravel()
    candidates.append(np.rint(_fitted(features, wanted) * ONE).astype(int))
    return min(candidates, key=lambda w: _entropy(_wrapped(wanted - _predicted(features, w))))


def _fitted(features, wanted):
    """Weights that make the sum of absolute remainders small, by iteratively reweighted least squares."""
    matrix, target = np.stack(features, axis=1).astype(float), wanted.astype(float)
    weight = np.ones(len(target))
    for _ in range(5):
        scaled = matrix * weight[:, None]
        solution = np.linalg.lstsq(scaled.T @ scaled, scaled.T @ (target * weight), rcond=1e-10)[0]
        weight = 1 / np.sqrt(np.abs(matrix @ solution - target) + 2)
    return np.clip(solution, -4, 4)


def _entropy(numbers):
    share = np.unique(numbers, return_counts=True)[1] / len(numbers)
    return -(share * np.log2(share)).sum()
