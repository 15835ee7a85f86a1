"""The Moebius strip of vanishing width: the shape and energy of its midline.

Without stretching, a narrow strip of width w has the bending energy (Sadowsky 1930; translation by Hinz and
Fried, arXiv 1408.3035)

    E = D w ∫ ℒ ds,   ℒ = κ² (1 + η²)² / 2,   η = τ/κ, |η| ≤ 1

κ: curvature about the direction d₁ in the strip, across it; τ: rate of twist, the torsion of the midline. The
midline has no curvature in the strip's plane. Where |τ| > |κ|, the density is 2 τ² (Freddi, Hornung, Mora and
Paroni 2016, A corrected Sadowsky functional for inextensible elastic ribbons, J. Elasticity 123); the
solution below reaches |η| = 1 only at a point.

Moments M₁ = ∂ℒ/∂κ = κ (1 - η⁴), M₃ = ∂ℒ/∂τ = 2 κ η (1 + η²). With M = (M₁² + M₃²)^(1/2) the inverse is κ = (M
+ M₁)²/4M, τ = M₃ (M + M₁)/4M, and ℒ = (M + M₁)²/8. Balance of the moment m and the force n in the frame d₁,
d₂, d₃ (d₃: tangent): m' + u × m + d₃ × n = 0, n' + u × n = 0, u = (κ, 0, τ). The strip is symmetric about an
axis that contains d₂ at s = 0 and d₁ at s = 1/2, where κ changes its sign by a jump and M₁ = 0. Starostin and
van der Heijden 2007, The shape of a Möbius strip, doi 10.1038/nmat1929, solve these equations for finite
width.

Not computed here: strips of finite width. Their equations (Wunderlich 1962) are of higher
order, and singular at the edge point of the symmetry axis; published numbers could not be read. The energy of
a strip of finite width is larger than D w/L times ENERGY, because Wunderlich's density exceeds Sadowsky's.
"""
from dataclasses import dataclass
from functools import cache

import numpy as np

from truths.collocation import mean, points, solve

ENERGY = 57.449503114  # E L/(D w) for a midline of length L; error 1e-9. A closed ring: 2 π² = 19.739
NODES = 40
# Length over width above which smooth embedded strips exist: Schwartz 2023, The optimal paper Moebius band,
# arXiv 2308.12641. At this ratio the strip is a flat equilateral triangle.
SHORTEST = 3**0.5


@dataclass(frozen=True)
class Midline:
    """The half of the midline from s = 0 to s = 1/2, for length 1. `s`; `position`: (3, #s) from the
    symmetric point, with the axis along y; `across`: (3, #s) the direction d₁; `curvature`, `twist`: κ and τ;
    `energy`: E L/(D w); `turns`: ∫ τ ds / 2 π over the whole midline; with the writhe the sum is -1/2;
    `hamiltonian`: κ M₁ + τ M₃ - ℒ + n₃ at all s, constant and equal to the energy; `error`: estimate,
    relative."""
    s: np.ndarray
    position: np.ndarray
    across: np.ndarray
    curvature: np.ndarray
    twist: np.ndarray
    energy: float
    turns: float
    hamiltonian: np.ndarray
    error: float

    def whole(self):
        """(3, 2 #s - 1) positions along the whole closed midline."""
        other = self.position * np.array([[-1], [1], [-1]])
        return np.concatenate([self.position, other[:, -2::-1]], axis=1)


def _strains(m1, m3):
    """κ, τ and ℒ of moments."""
    size = (m1**2 + m3**2)**0.5
    return (size + m1)**2 / (4 * size), m3 * (size + m1) / (4 * size), (size + m1)**2 / 8


def _field(t, state, p):
    """Derivatives by t = 2 s of m, n, position, d₁ and d₃."""
    m1, m2, m3, n1, n2, n3 = state[:6]
    d1, d3 = state[9:12], state[12:15]
    d2 = np.cross(d3, d1, axis=0)
    curvature, twist, _ = _strains(m1, m3)
    return np.array([twist * m2 + n2, curvature * m3 - twist * m1 - n1, -curvature * m2,
                     twist * n2, curvature * n3 - twist * n1, -curvature * n2,
                     *d3, *(twist * d2), *(-curvature * d2)]) / 2


def _ends(a, b, p):
    """Symmetry about the y axis: M₂ = n₂ = 0, d₁ = x, d₃ = z at s = 0; at s = 1/2 the position is on the
    axis, and d₁ is parallel to the axis. M₁ = n₁ = 0 at s = 1/2 follow."""
    return np.array([a[1], a[4], a[6], a[7], a[8], a[9] - 1, a[10], a[11], a[12], a[13], a[14] - 1,
                     b[6], b[8], b[9], b[11]])


@cache
def midline(nodes=NODES):
    """The midline of the Moebius strip of width 0 and length 1. With 40 nodes the energy has an error of
    1e-10. The points of the midline on the symmetry axis are 0.212697811 apart (error 1e-9). The first guess
    integrates the equations from moments and forces at s = 0 that were found by random search; of all
    solutions found by this search and by direct minimisation it has the least energy."""
    steps = 400
    state = np.zeros(15)
    state[[0, 2, 3, 5, 9, 14]] = 2.0, 8.9, -43.5, 42.1, 1, 1
    path = [state]
    for _ in range(steps):
        middle = path[-1] + _field(0, path[-1], None) / (2 * steps)
        path.append(path[-1] + _field(0, middle, None) / steps)
    t = points(nodes)
    guess = np.array([np.interp(t, np.linspace(0, 1, steps + 1), row) for row in np.transpose(path)])
    solution = solve(_field, _ends, guess, [])
    m1, m3, n3 = solution.y[[0, 2, 5]]
    curvature, twist, density = _strains(m1, m3)
    return Midline(solution.t / 2, solution.y[6:9], solution.y[9:12], curvature, twist,
                   float(mean(solution, density)), float(mean(solution, twist)) / (2 * np.pi),
                   curvature * m1 + twist * m3 - density + n3, solution.tail)
