"""Boundary value problems of ordinary differential equations, by collocation with polynomials and Newton's
method.

The unknowns are the values of polynomials of degree n at the n + 1 Chebyshev points of [0, 1]. The equations
hold at the n Gauss points: Driscoll and Hale 2016, Rectangular spectral collocation, doi
10.1093/imanum/dru062. The error of a smooth solution decreases geometrically with n. The derivatives for
Newton's method come from complex steps (Squire and Trapp 1998, doi 10.1137/S003614459631241X) and are exact
up to rounding.
"""
from dataclasses import dataclass
from functools import cache

import numpy as np

STEP = 1e-30  # of complex steps; no difference is formed, so that nothing cancels
ROUNDING = 1e-11  # relative; Newton's method stops below this step,
NEAR = 1e-7  # and below this step if steps no longer become shorter
MOST_STEPS = 60
TINY = 1e-4


class NoSolution(RuntimeError):
    """Newton's method did not converge, or the polynomials do not resolve the solution."""


@dataclass(frozen=True)
class Solution:
    """`t`: (n + 1) points of [0, 1]; `y`: (m, n + 1) values there; `p`: parameters; `tail`: size of the last
    two Chebyshev coefficients, relative to the largest value of the same function. The error of y is about as
    large as the tail."""
    t: np.ndarray
    y: np.ndarray
    p: np.ndarray
    tail: float

    def __call__(self, t):
        """(m, #t) values at any points of [0, 1], by barycentric interpolation."""
        return self.y @ interpolation(self.t, np.atleast_1d(t)).T


def points(n):
    """The n + 1 Chebyshev points of [0, 1], in ascending order."""
    return (1 - np.cos(np.pi * np.arange(n + 1) / n)) / 2


def interpolation(nodes, targets):
    """(#targets, #nodes) matrix from values at Chebyshev points to values at the targets (Berrut and
    Trefethen 2004, doi 10.1137/S0036144502417715, eq. 4.2)."""
    weights = np.where(np.arange(len(nodes)) % 2, -1.0, 1.0)
    weights[[0, -1]] /= 2
    apart = targets[:, None] - nodes
    hit = apart == 0
    rows = weights / np.where(hit, 1, apart)
    rows[hit.any(1)] = hit[hit.any(1)]
    return rows / rows.sum(1)[:, None]


def differentiation(nodes):
    """(n + 1, n + 1) matrix from values at Chebyshev points to derivatives there (same paper, eq. 9.4)."""
    weights = np.where(np.arange(len(nodes)) % 2, -1.0, 1.0)
    weights[[0, -1]] /= 2
    matrix = weights / weights[:, None] / (nodes[:, None] - nodes + np.eye(len(nodes)))
    np.fill_diagonal(matrix, 0)
    return matrix - np.diag(matrix.sum(1))


@cache
def _matrices(n):
    """Gauss points, and the matrices from Chebyshev points to values and derivatives at Gauss points."""
    gauss = (np.polynomial.legendre.leggauss(n)[0] + 1) / 2
    value = interpolation(points(n), gauss)
    return gauss, value, value @ differentiation(points(n))


def mean(solution, values):
    """The integral over [0, 1] of a function with these values at solution.t, by Gauss's rule."""
    n = len(solution.t) - 1
    return np.polynomial.legendre.leggauss(n)[1] / 2 @ _matrices(n)[1] @ values


def solve(field, ends, y, p):
    """Solves y' = field(t, y, p) on [0, 1] with ends(y(0), y(1), p) = 0. `y`: (m, n + 1) first guess at
    points(n); `p`: first guess of the q parameters. field: (#t), (m, #t), (q) → (m, #t) or a list of m rows;
    ends: (m), (m), (q) → m + q numbers. Both have to be analytic functions (no abs, no arctan2). Raises
    NoSolution."""
    y, p = np.array(y, float), np.array(p, float)
    gauss, value, slope = _matrices(y.shape[1] - 1)

    def residual(y, p):
        inside = y @ slope.T - np.array(field(gauss, y @ value.T, p))
        return np.concatenate([inside.ravel(), ends(y[:, 0], y[:, -1], p)])

    size, before = np.linalg.norm(residual(y, p)), np.inf
    for _ in range(MOST_STEPS):
        try:
            step = np.linalg.solve(_jacobian(field, ends, y, p), -residual(y, p))
        except np.linalg.LinAlgError as error:
            raise NoSolution("the equations do not determine the solution") from error
        change_y, change_p = step[:y.size].reshape(y.shape), step[y.size:]
        share = 1.0
        while share > 1e-5:  # a shorter step, until the residual decreases
            new = np.linalg.norm(residual(y + share * change_y, p + share * change_p))
            if new < (1 - share / 4) * size or new < ROUNDING:
                break
            share /= 2
        y, p, size = y + share * change_y, p + share * change_p, new
        change = np.abs(step).max() / (1 + max(np.abs(y).max(), *np.abs(p), 0))
        if change < ROUNDING or before / 2 < change < NEAR:
            return Solution(points(y.shape[1] - 1), y, p, _tail(y))
        before = change
    raise NoSolution(f"Newton's method did not converge in {MOST_STEPS} steps")


def _jacobian(field, ends, y, p):
    """Derivatives of the residual by all values of y (function by function) and all parameters."""
    (m, size), n = y.shape, y.shape[1] - 1
    gauss, value, slope = _matrices(n)
    inside, q = (y @ value.T).astype(complex), p.astype(complex)
    first, last = y[:, 0].astype(complex), y[:, -1].astype(complex)
    jacobian = np.zeros((m * n + m + len(p), y.size + len(p)))
    unit = lambda k, count: 1j * STEP * (np.arange(count) == k)
    for j in range(m):
        by_y = np.array(field(gauss, inside + unit(j, m)[:, None], q)).imag / STEP
        for i in range(m):
            jacobian[i * n:(i + 1) * n, j * size:(j + 1) * size] = (i == j) * slope - by_y[i][:, None] * value
        jacobian[m * n:, j * size] = np.imag(ends(first + unit(j, m), last, q)) / STEP
        jacobian[m * n:, j * size + n] = np.imag(ends(first, last + unit(j, m), q)) / STEP
    for k in range(len(p)):
        moved = q + unit(k, len(p))
        jacobian[:m * n, y.size + k] = -np.array(field(gauss, inside, moved)).imag.ravel() / STEP
        jacobian[m * n:, y.size + k] = np.imag(ends(first, last, moved)) / STEP
    return jacobian


def _tail(y):
    """Size of the last two Chebyshev coefficients of the rows of y, relative to the largest value of the row
    (or to TINY times that of all rows, because a row can be zero up to rounding)."""
    n = y.shape[1] - 1
    cosines = np.cos(np.pi * np.outer([n - 1, n], np.arange(n + 1)) / n)
    cosines[:, [0, -1]] /= 2
    largest = np.abs(y).max(1)
    return float((np.abs(2 / n * y @ cosines.T).max(1) / np.maximum(largest, TINY * largest.max())).max())
