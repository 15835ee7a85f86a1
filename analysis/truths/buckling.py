"""Loads at which flat strips buckle sideways, and the wrinkles of a stretched sheet.

Lateral buckling: a strip of length L and width w in a vertical plane, clamped at x = 0, under its weight or
under a vertical load on its end. D: flexural rigidity, ν: Poisson's ratio.
"""
from math import lgamma

import numpy as np
from numpy.polynomial import legendre

# First zeros of Bessel functions, see bessel_zero.
SLENDER = {"weight": (-1 / 6, 6.0), "end load": (-1 / 4, 2.0)}


def bessel_zero(order):
    """The first positive zero of the Bessel function J of an order in (-1, 0], by bisection of its power
    series (DLMF 10.2.2). Error below 1e-14."""
    k = np.arange(30)
    log_terms = np.array([lgamma(j + 1) + lgamma(j + order + 1) for j in k])

    def value(x):
        return np.sum((-1.0)**k * np.exp(2 * k * np.log(x / 2) - log_terms))

    low, high = 0.5, 2.6
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if value(middle) > 0 else (low, middle)
    return (low + high) / 2


def slender_load(kind):
    """Critical q L³/(B C)^(1/2) ("weight", 12.853763) or P L²/(B C)^(1/2) ("end load", 4.012599) of a slender
    strip; q: weight per length, B: rigidity for sideways bending, C: for torsion, both in N m². Timoshenko
    and Gere 1961, Theory of elastic stability, section 6.3: φ'' + (q² s⁴/4BC) φ = 0 with φ'(0) = 0, φ(L) = 0,
    s from the free end, has solutions with J of order -1/6; with P² s²/BC instead, of order -1/4. Error below
    1e-12."""
    order, factor = SLENDER[kind]
    return factor * bessel_zero(order)


def slender_plate_load(poisson, kind="weight"):
    """Critical Γ = ρ g L³/D ("weight") or P L²/(D w) ("end load") for w/L → 0, from B = D (1-ν²) w and C = 2
    D (1-ν) w. 14.508249 and 4.529085 at ν = 0.3. Error below 1e-12."""
    return slender_load(kind) * (1 - poisson) * np.sqrt(2 * (1 + poisson))


def _basis(count, low, high, at):
    """(count, #at) Legendre polynomials on [low, high], and their first and second derivatives."""
    scale = 2 / (high - low)
    return [scale**k * np.array([legendre.legval((at - low) * scale - 1, legendre.legder(row, k))
                                 for row in np.eye(count)]) for k in range(3)]


def plate_load(width, poisson, kind="weight", along=24, across=10):
    """Critical Γ = ρ g L³/D ("weight") or P L²/(D w) ("end load", spread evenly over the free end) of a
    Kirchhoff plate; `width`: w/L. Ritz's method with `along` × `across` Legendre polynomials, first for plane
    stress, then for buckling. The values are too large: by at most 0.06 % from w/L = 0.02 to 1 and ν = -1/2
    to 1/2, compared with 32 × 14 polynomials. The difference of both from the limit is not known; the
    sequence of values suggests 0.1 %. Romero et al. 2021, doi 10.1145/3450626.3459931, measure this load in
    simulators."""
    gauss_x, weights_x = legendre.leggauss(along + 12)
    gauss_y, weights_y = legendre.leggauss(across + 8)
    x, y, weights_y = (gauss_x + 1) / 2, width / 2 * gauss_y, width / 2 * weights_y
    weights = np.outer(weights_x / 2, weights_y).ravel()
    f, f1, f2 = _basis(along, 0, 1, x)
    g, g1, g2 = _basis(across, -width / 2, width / 2, y)
    spread = lambda a, b: np.einsum("ia,jb->ijab", a, b).reshape(along * across, -1)
    product = lambda a, b: (a * weights) @ b.T

    by_x, by_y = spread(f + x * f1, g), spread(x * f, g1)  # of displacements x P(x) Q(y), 0 at the clamp
    if kind == "weight":
        force = -spread(x * f, g) @ weights
    else:
        force = -np.outer(_basis(along, 0, 1, np.ones(1))[0], g @ weights_y).ravel()
    shear = (1 - poisson) / 2
    coupled = poisson * product(by_x, by_y) + shear * product(by_y, by_x)
    stretch = np.block([[product(by_x, by_x) + shear * product(by_y, by_y), coupled],
                        [coupled.T, product(by_y, by_y) + shear * product(by_x, by_x)]])
    u, v = np.split(np.linalg.lstsq(stretch, np.concatenate([0 * force, force]), rcond=1e-13)[0], 2)
    n_x = u @ by_x + poisson * (v @ by_y)
    n_y = v @ by_y + poisson * (u @ by_x)
    n_xy = shear * (u @ by_y + v @ by_x)

    slope_x, slope_y = spread(2 * x * f + x**2 * f1, g), spread(x**2 * f, g1)  # of deflections x² P(x) Q(y)
    k_x, k_y = spread(2 * f + 4 * x * f1 + x**2 * f2, g), spread(x**2 * f, g2)
    k_xy = spread(2 * x * f + x**2 * f1, g1)
    mixed = product(k_x, k_y)
    bending = product(k_x + k_y, k_x + k_y) - (1 - poisson) * (mixed + mixed.T - 2 * product(k_xy, k_xy))
    sheared = product(slope_x * n_xy, slope_y)
    loaded = product(slope_x * n_x, slope_x) + product(slope_y * n_y, slope_y) + sheared + sheared.T
    return 1 / _largest_eigenvalue(-loaded, bending)


def _largest_eigenvalue(a, b):
    """The largest λ with a x = λ b x, for symmetric a and positive definite b."""
    scale = 1 / np.sqrt(np.diag(b))
    lower = np.linalg.cholesky(b * np.outer(scale, scale))
    half = np.linalg.solve(lower, a * np.outer(scale, scale))
    reduced = np.linalg.solve(lower, half.T)
    return float(np.linalg.eigvalsh((reduced + reduced.T) / 2)[-1])


def wrinkle_length(rigidity, tension, length):
    """Wavelength in m of the wrinkles of a long sheet that is pulled at its clamped ends: λ = 2 √π
    (B/T)^(1/4) L^(1/2), Cerda and Mahadevan 2003, doi 10.1103/PhysRevLett.90.074302. `rigidity`: B in N m;
    `tension`: T in N/m; `length`: L in m between the clamps. The formula minimises B k² + T (π/L)²/k² over k
    = 2π/λ. It is an asymptotic law for λ ≪ width < L, not an exact number; its error is not known in general,
    and of the order of the scatter of the paper's measurements, several percent."""
    return 2 * np.sqrt(np.pi) * (rigidity / tension)**0.25 * np.sqrt(length)
