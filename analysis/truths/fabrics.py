"""Cantilevers of cloth whose moment is not linear in the curvature, or whose rigidity varies along the strip,
and the rigidities of a woven sheet.

A strip of length L and weight w per length (N/m per m of width) is clamped horizontally at s = 0. θ is the
angle below the horizontal, M the moment per width in N:

    x' = cos θ, y' = -sin θ, θ' = κ(M, s), M' = -w (L - s) cos θ, θ(0) = 0, M(L) = 0

The equations are integrated from the free end by the classical Runge-Kutta method (error ∝ 1/steps⁴). The
angle of the free end is the smallest for which θ(0) = 0; larger solutions are loops. With a linear moment the
result agrees with cantilevers.py.
"""
import numpy as np

STEPS = 400


def linear(rigidity):
    """κ of a sheet of this rigidity (N m), a number or a function of s."""
    at = rigidity if callable(rigidity) else lambda s: rigidity
    return lambda moment, s: moment / at(s)


def softening(rigidity, half_at):
    """κ of M = B κ / (1 + |κ|/half_at). A moment of B half_at or more has no curvature."""
    return lambda moment, s: moment / (rigidity - abs(moment) / half_at)


def table(curvatures, moments):
    """κ of a piecewise linear moment; the last slope goes on."""
    k, m = np.concatenate([[0], curvatures]), np.concatenate([[0], moments])
    slope = (k[-1] - k[-2]) / (m[-1] - m[-2])

    def curvature(moment, s):
        size = abs(moment)
        beyond = max(0.0, size - m[-1])
        return np.sign(moment) * (np.interp(size, m, k) + slope * beyond)
    return curvature


def friction(rigidity, moment, slip):
    """κ of a sheet that is bent for the first time: over the curvature `slip` friction grows to `moment`."""
    first = rigidity + moment / slip
    return lambda m, s: (m / first if abs(m) <= first * slip
                         else np.sign(m) * (slip + (abs(m) - first * slip) / rigidity))


def cantilever(length, weight, curvature, steps=STEPS):
    """(x, y) of the strip, #(steps + 1) by 2, in m, for κ(M, s)."""
    def end(angle):
        state, h = np.array([0.0, 0.0, angle, 0.0]), length / steps
        rows = [state]
        rate = lambda s, z: -np.array([np.cos(z[2]), -np.sin(z[2]), curvature(z[3], s),
                                       -weight * (length - s) * np.cos(z[2])])
        for i in range(steps):  # backwards from the free end
            s = length - i * h
            a = rate(s - 1e-12 * length, state)
            b = rate(s - h / 2, state + h / 2 * a)
            c = rate(s - h / 2, state + h / 2 * b)
            d = rate(s - h + 1e-12 * length, state + h * c)
            state = state + h / 6 * (a + 2 * b + 2 * c + d)
            rows.append(state)
        return state[2], np.array(rows[::-1])

    # Short steps up from the angle 0, because a heavy strip has more than one solution.
    angles = np.linspace(0, np.pi / 2, 33)
    straight = end(angles[1] / 64)[0] >= 0
    first = next(i for i in range(1, 33) if (end(angles[i])[0] >= 0) != straight)
    low, high = angles[first - 1], angles[first]
    for _ in range(45):
        middle = (low + high) / 2
        low, high = (middle, high) if end(middle)[0] < 0 else (low, middle)
    rows = end((low + high) / 2)[1]
    return rows[:, :2] - rows[0, :2]


def plate(warp, weft, bias, poisson_ratio=0.0):
    """The matrix D of a woven sheet whose narrow strips have the rigidities `warp`, `weft` and, at 45°,
    `bias` in N m. (κ11, κ22, 2 κ12) → (M11, M22, M12); 1: along the warp. Timoshenko and Woinowsky-Krieger
    1959, § 85."""
    across = -poisson_ratio / np.sqrt(warp * weft)
    twist = 4 / bias - 1 / warp - 1 / weft - 2 * across
    return np.linalg.inv(np.array([[1 / warp, across, 0], [across, 1 / weft, 0], [0, 0, twist]]))


def bias_of_huber(warp, weft):
    """The rigidity of a narrow strip at 45° if D12 + 2 D66 = √(D11 D22), as in Huber's theory, and ν = 0."""
    return 4 / (1 / warp + 1 / weft + 2 / np.sqrt(warp * weft))


def cylinder(plate, degrees):
    """The rigidity of a wide sheet that is bent along φ, the angle to the warp."""
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    curvature = np.array([c * c, s * s, 2 * c * s])
    return curvature @ plate @ curvature


def strip(plate, degrees):
    """The rigidity of a narrow strip cut at φ. Its sides are free: it may also curve across and twist."""
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    moment = np.array([c * c, s * s, c * s])
    return 1 / (moment @ np.linalg.inv(plate) @ moment)
