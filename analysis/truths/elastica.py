"""The planar inextensible elastica under its weight and end forces, and the shapes that it takes.

Lengths are in units of ℓ = (B/(ρ g))^(1/3), forces per width in (ρ g)^(2/3) B^(1/3); B: flexural rigidity in
N m, ρ: mass per area in kg/m², g: gravity in m/s². θ is the angle from the horizontal, κ = θ' the curvature.
F = (H, V) is the force of the material beyond s on the material before s. Balance of forces and moments
(Love 1927, A treatise on the mathematical theory of elasticity, art. 262):

    x' = cos θ, y' = sin θ, κ' = H sin θ - V cos θ, V' = w      w: weight per length, 1 or 0

κ²/2 + H cos θ + V sin θ - w y is constant along the strip; this checks solutions.
"""
from dataclasses import dataclass

import numpy as np

from truths.collocation import NoSolution, Solution, points, solve

NODES = 48  # of a first guess
MOST_NODES = 250
RESOLVED = 1e-11  # largest tail of a solution that is accepted


@dataclass(frozen=True)
class Curve:
    """An airborne part of a strip. `length`, `across`: its length and H; `lift`: V at its start; `weight`: w;
    `solution`: rows x, y, θ, κ over s / length."""
    length: float
    across: float
    lift: float
    weight: float
    solution: Solution

    @property
    def s(self):
        return self.length * self.solution.t

    @property
    def error(self):
        """Estimated error of x, y, θ and κ, relative to their largest values."""
        return self.solution.tail

    def invariant(self):
        """κ²/2 + H cos θ + V sin θ - w y at the nodes; constant for an exact solution."""
        _, y, angle, curvature = self.solution.y
        upward = self.lift + self.weight * self.s
        return curvature**2 / 2 + self.across * np.cos(angle) + upward * np.sin(angle) - self.weight * y

    def farthest(self, row, sign=1.0):
        """Largest sign · x (row 0) or sign · y (row 1) of the curve. Newton's method improves the best of
        4001 points, so that the error is that of the solution."""
        t = np.linspace(0, 1, 4001)
        best = t[np.argmax(sign * self.solution(t)[row])]
        for _ in range(4 if 0 < best < 1 else 0):
            angle, curvature = self.solution(best)[2:, 0]
            slope, turn = (np.cos(angle), -np.sin(angle)) if row == 0 else (np.sin(angle), np.cos(angle))
            rate = turn * curvature * self.length
            if abs(slope) >= 1e-3 * abs(rate):  # a straight part: its points are equally far
                break
            best -= slope / rate
        return float(sign * self.solution(best)[row, 0])


def curve(forces, ends, guess, parameters):
    """Solves for a curve. `forces`: parameters → (length, H, V at the start, w); `ends`: conditions on x, y,
    θ, κ at both ends; `guess`: (4, n + 1) values at points(n), or the function θ(t) of a curve with the
    length of the guessed parameters. Takes more nodes until the tail is at most RESOLVED; raises NoSolution
    if MOST_NODES are not enough."""
    def field(t, state, p):
        length, across, lift, weight = forces(p)
        _, _, angle, curvature = state
        upward = lift + weight * length * t
        return [length * np.cos(angle), length * np.sin(angle), length * curvature,
                length * (across * np.sin(angle) - upward * np.cos(angle))]

    if callable(guess):
        guess = _from_angle(guess, forces(np.asarray(parameters, float))[0])
    solution = solve(field, ends, guess, parameters)
    while solution.tail > RESOLVED:
        more = len(solution.t) * 3 // 2
        if more > MOST_NODES:
            raise NoSolution(f"{len(solution.t)} nodes leave a relative error of {solution.tail:.1e}")
        solution = solve(field, ends, solution(points(more)), solution.p)
    return Curve(*forces(solution.p), solution)


def _from_angle(angle, length):
    """x, y, θ, κ at Chebyshev points of a curve with this angle θ(t), by the trapezoidal rule."""
    fine = np.linspace(0, 1, 2001)
    turned = angle(fine)
    along = lambda rate: np.concatenate([[0], np.cumsum((rate[1:] + rate[:-1]) / 2)]) * length / 2000
    rows = [along(np.cos(turned)), along(np.sin(turned)), turned, np.gradient(turned, fine) / length]
    return np.array([np.interp(points(NODES), fine, row) for row in rows])


def continued(solve_at, first, goal, ratio=1.6):
    """solve_at(value, previous curve or None) for a geometric sequence of values from `first` to `goal`; the
    result for the goal. A solution is the first guess of the next."""
    count = int(np.ceil(abs(np.log(goal / first)) / np.log(ratio)))
    found = None
    for value in np.geomspace(first, goal, count + 1) if count else [goal]:
        found = solve_at(value, found)
    return found
