"""Strips that hang or lie under their own weight, as in textile tests: Plaut 2015, Formulas to determine
fabric bending rigidity from simple tests, doi 10.1177/0040517514553877; Peirce 1930, The "handle" of cloth
as a measurable quantity, J. Textile Inst. 21, T377.

All lengths are in units of ℓ = (B/(ρ g))^(1/3), see elastica.py. The relative error of all numbers is below
1e-8 (Strip.error estimates it). NoSolution is raised if the strip is too long to be resolved. `weight=0`
gives the weightless shape; ℓ is then any length."""
from dataclasses import dataclass
from functools import cache

import numpy as np

from truths.elastica import continued, curve

# θ at the clamp, where both ends are held, and H length² of the weightless loop (a first guess)
STARTS = {"ring": (0.0, 0.0), "heart": (np.pi / 2, -35.2), "pear": (-np.pi / 2, 39.7)}


@dataclass(frozen=True)
class Strip:
    """The shape of a strip. `s`, `x`, `y`, `theta`: arclength, position and angle; `height`: of the whole
    strip; `width`: likewise; `contact`: length that lies on the plane; `across`: horizontal internal force;
    `error`: estimate, relative."""
    s: np.ndarray
    x: np.ndarray
    y: np.ndarray
    theta: np.ndarray
    height: float
    width: float
    contact: float
    across: float
    error: float
    half: object  # the Curve that was computed


def _both_halves(half, start=0.0, contact=0.0):
    """A loop that is symmetric about the axis x = 0, from its right half, which ends on the axis. `start`: s
    at the start of the computed curve."""
    x, y, theta, _ = half.solution.y
    s, back = start + half.s, slice(-2, None, -1)
    whole = lambda right, left: np.concatenate([right, left[back]])
    return Strip(whole(s, 2 * s[-1] - s), whole(x, -x), whole(y, y), whole(theta, 2 * theta[-1] - theta),
                 half.farthest(1) + half.farthest(1, -1.0), 2 * half.farthest(0), contact, half.across,
                 half.error, half)


def hanging_loop(kind, length, weight=1.0):
    """A strip of this length whose ends are held together, with horizontal tangents ("ring"), with tangents
    upward ("heart") or downward ("pear"). s = 0 is the clamp at (0, 0). Height without weight, over length:
    ring 1/π; heart 0.1338604 (Peirce 1930 and ASTM D1388: 0.1337); pear 0.4243080 (Peirce: 0.4243). The
    height of the heart is counted from its highest point; `drop` counts from the clamp, as the tests do."""
    start, across = STARTS[kind]
    turn = lambda t: start + (-np.pi - start) * t + (1.2 * np.sin(np.pi * t) * (1 - t) if start < 0 else 0)
    ends = lambda a, b, p: [a[0], a[1], a[2] - start, b[2] + np.pi, b[0]]

    def solve_at(size, before):
        forces = lambda p: (size / 2, p[0], -weight * size / 2, weight)
        if before is None:
            return curve(forces, ends, turn, [across / size**2])
        scale = np.array([[size / (2 * before.length)]] * 2 + [[1], [2 * before.length / size]])
        return curve(forces, ends, before.solution.y * scale, [before.across])

    return _both_halves(continued(solve_at, min(length, 1.0), length) if weight else solve_at(length, None))


def drop(strip):
    """Depth of the lowest point of a hanging loop below its clamp."""
    return strip.half.farthest(1, -1.0)


def standing_ring(length):
    """A strip closed to a ring that rests on the plane y = 0. s = 0 is the middle of the contact. A ring
    shorter than `flat_onset()` touches the plane in a line across the strip. In a longer ring the contact is
    flat, and ends where κ = 0. Up to a length of 11.21 ℓ the top stays above the plane; the result for longer
    rings is no shape of a real strip. Only shapes that are symmetric about the vertical are computed."""
    onset = _onset()
    if length <= onset.length * 2:
        return _both_halves(continued(_point_ring, min(length, 1.0), length))
    half = continued(lambda size, before: _flat_ring(size, before or onset), 2 * onset.length, length, 1.1)
    contact = length - 2 * half.length
    return _both_halves(half, contact / 2, contact)


def flat_onset():
    """The length in ℓ at which the contact of a standing ring becomes flat: 5.278736299, error 1e-9."""
    return 2 * _onset().length


def _round(t):
    return np.pi * t


def _point_ring(size, before):
    return curve(lambda p: (size / 2, p[0], -size / 2, 1.0),
                 lambda a, b, p: [a[0], a[1], a[2], b[2] - np.pi, b[0]],
                 before.solution.y if before else _round, [before.across if before else 0.0])


@cache
def _onset():
    near = continued(_point_ring, 1.0, 5.0)
    return curve(lambda p: (p[1] / 2, p[0], -p[1] / 2, 1.0),
                 lambda a, b, p: [a[0], a[1], a[2], a[3], b[2] - np.pi, b[0]],
                 near.solution.y, [near.across, 5.0])


def _flat_ring(size, before):
    return curve(lambda p: (size / 2 - p[1], p[0], p[1] - size / 2, 1.0),
                 lambda a, b, p: [a[0] - p[1], a[1], a[2], a[3], b[2] - np.pi, b[0]],
                 before.solution.y, [before.across, size / 2 - before.length])


def free_fold():
    """A long strip folded back over itself on the plane y = 0, without friction: it lifts off at s = 0 where
    κ = 0, and lands on the lower layer where κ = 0 and θ = π. H = 0, because the upper layer can slide. The
    height at landing is not prescribed: it is 0 because the invariant of elastica.py is. Thickness is
    neglected. Height 0.906596870 ℓ. `width`: from landing to the farthest point of the fold."""
    guess = lambda t: np.pi * (3 * t**2 - 2 * t**3) + 1.2 * np.sin(np.pi * t)**2 * t
    fold = curve(lambda p: (p[1], 0.0, p[0], 1.0), lambda a, b, p: [*a, b[2] - np.pi, b[3]],
                 guess, [-3.75, 4.2])
    x, y, theta, _ = fold.solution.y
    return Strip(fold.s, x, y, theta, fold.farthest(1), fold.farthest(0) - x[-1], 0.0, 0.0, fold.error, fold)
