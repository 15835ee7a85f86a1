"""Small deflections of thin shells (Kirchhoff-Love), by Fourier series in one direction and exact solution or
Ritz's method with Legendre polynomials in the other. These are the limits of shell benchmarks for a mesh that
becomes fine.

Displacements: u along the meridian or generator, v around the axis, w outward. Membrane strains ε and changes
of curvature κ by Sanders (Budiansky and Sanders 1963, On the "best" first-order linear shell theory); energy
per area (Eh/(1-ν²) q(ε) + D q(κ)) / 2 with q(e) = e₁₁² + e₂₂² + 2 ν e₁₁ e₂₂ + 2 (1-ν) e₁₂², D = Eh³/12(1-ν²).
Other first-order theories differ by a share of order h/R. The cylinders also take Koiter's theory (1966: κ is
the change of the second fundamental form), which differs by 3e-5 (roof) and 3e-4 (pinched cylinder). Shear
and the third dimension also change deflections by shares of order h/R.

Numerical errors are far below these differences. Units are those of the arguments.
"""
from functools import cache

import numpy as np
from numpy.polynomial import legendre


def _polynomials(count, low, high, at):
    """(#at, count) Legendre polynomials on [low, high], and their first and second derivatives."""
    scale = 2 / (high - low)
    inside = (at - low) * scale - 1
    return [scale**k * np.array([legendre.legval(inside, legendre.legder(row, k))
                                 for row in np.eye(count)]).T for k in range(3)]


def _stiffness(strains, curvatures, weights, young, poisson, thickness):
    """Matrices of second derivatives of the energy. `strains`, `curvatures`: three (…, #points, #unknowns)
    arrays (11, 22, 12); `weights`: area per point."""
    membrane = young * thickness / (1 - poisson**2)
    product = lambda a, b: (a * weights[:, None]).swapaxes(-1, -2) @ b
    matrix = 0
    for rigidity, (one, two, both) in ((membrane, strains), (membrane * thickness**2 / 12, curvatures)):
        mixed = product(one, two)
        matrix = matrix + rigidity * (product(one, one) + product(two, two) + poisson
                                      * (mixed + mixed.swapaxes(-1, -2)) + 2 * (1 - poisson)
                                      * product(both, both))
    return matrix


def _cylinder(theory, radius):
    """Coefficients of v (in κ₂₂, κ₁₂), u (in κ₁₂) and w (in κ₂₂) that the theories do not share."""
    return {"sanders": (1 / radius**2, 3 / (4 * radius), -1 / (4 * radius**2), 0.0),
            "koiter": (2 / radius**2, 1 / radius, 0.0, 1 / radius**2)}[theory]


@cache
def scordelis_lo(young=4.32e8, poisson=0.0, thickness=0.25, radius=25.0, length=50.0, angle=np.radians(40.0),
                 load=90.0, theory="sanders", terms=40, count=16):
    """Sag of the middle of a free side of the Scordelis-Lo roof (1964): a cylinder of half-angle `angle`,
    with its weight per area, whose ends are held in their planes (v = w = 0) and free along the axis
    (Navier's support). 0.3006009 by Sanders and 0.3005925 by Koiter, numerical error 1e-7."""
    gauss, weights = legendre.leggauss(2 * count + 10)
    around, weights = angle * gauss, angle * weights * radius
    f, f1, f2 = _polynomials(count, -angle, angle, around)
    none, side = 0 * f, _polynomials(count, -angle, angle, np.array([angle]))[0][0]
    v22, v12, u12, w22 = _cylinder(theory, radius)
    sag = 0.0
    for k in range(terms):  # u sin(wave x), v cos(wave x), w cos(wave x)
        wave = (2 * k + 1) * np.pi / length
        row = lambda u, v, w: np.hstack([u, v, w])
        strains = (row(wave * f, none, none), row(none, f1 / radius, f / radius),
                   row(f1 / radius, -wave * f, none) / 2)
        curvatures = (row(none, none, wave**2 * f), row(none, v22 * f1, w22 * f - f2 / radius**2),
                      row(u12 * f1, -v12 * wave * f, wave * f1 / radius))
        part = load * 4 * (-1)**k / ((2 * k + 1) * np.pi)
        forces = part * row(none, np.sin(around)[:, None] * f, -np.cos(around)[:, None] * f).T @ weights
        stiffness = _stiffness(strains, curvatures, weights, young, poisson, thickness)
        _, v, w = np.split(np.linalg.solve(stiffness, forces), 3)
        sag += side @ v * np.sin(angle) - side @ w * np.cos(angle)
    return float(sag)


@cache
def pinched_cylinder(young=3e6, poisson=0.3, thickness=3.0, radius=300.0, length=600.0, load=1.0,
                     theory="sanders", terms=200):
    """Deflection under either of two opposite radial loads in the middle of a cylinder whose ends are held in
    their planes, by a double Fourier series. 1.82767e-5 by Sanders and 1.82820e-5 by Koiter, numerical error
    2e-10 (the series is summed for two numbers of terms, and its tail is proportional to terms⁻²). The usual
    reference 1.8248e-5 is 0.16 % lower: about the sum of 71 × 71 terms."""
    partial = [_pinched(young, poisson, thickness, radius, length, load, theory, count)
               for count in (terms // 2, terms)]
    return float((4 * partial[1] - partial[0]) / 3)


def _pinched(young, poisson, thickness, radius, length, load, theory, terms):
    """The sum of terms² terms u cos(nθ) sin(wave x), v sin(nθ) cos(wave x), w cos(nθ) cos(wave x)."""
    v22, v12, u12, w22 = _cylinder(theory, radius)
    wave, n = (grid.ravel() for grid in np.meshgrid((2 * np.arange(terms) + 1) * np.pi / length,
                                                    2.0 * np.arange(terms), indexing="ij"))
    none = 0 * wave
    rows = lambda u, v, w: np.array([u, v, w]).T[:, None]
    strains = (rows(wave, none, none), rows(none, n / radius, none + 1 / radius),
               rows(-n / radius, -wave, none) / 2)
    curvatures = (rows(none, none, wave**2), rows(none, v22 * n, n**2 / radius**2 + w22),
                  rows(-u12 * n, -v12 * wave, -wave * n / radius))
    matrix = _stiffness(strains, curvatures, np.ones(1), young, poisson, thickness)
    area = np.where(n == 0, 2, 1) * np.pi * radius * length / 2
    forces = np.array([none, none, 2 * load / area]).T
    return np.linalg.solve(matrix, forces[..., None])[:, 2, 0].sum()


@cache
def hemisphere(hole=18.0, young=6.825e7, poisson=0.3, thickness=0.04, radius=10.0, load=2.0, terms=24,
               count=40):
    """Deflection under the loads of a hemisphere with a free equator, on which four radial loads act, outward
    and inward by turns, 90° apart. `hole`: angle in degrees between the axis and the free edge of the hole; 0
    for a closed hemisphere. `load`: a whole load, twice the load on a quarter of the hemisphere in MacNeal
    and Harder 1985. 0.0935212 with the hole of 18°, 0.0924127 without a hole; numerical error 1e-7."""
    low, high = np.radians(hole), np.pi / 2
    gauss, weights = legendre.leggauss(count + 40)
    down = (low + high) / 2 + (high - low) / 2 * gauss
    sine, cosine = np.sin(down)[:, None], np.cos(down)[:, None]
    weights = (high - low) / 2 * weights * radius**2 * np.sin(down)
    f, f1, _ = g, g1, g2 = _polynomials(count, low, high, down)  # f: of u and v; g: of w
    if hole == 0:  # u, v ∝ sin and w ∝ sin² at the pole
        f, f1 = sine * g, sine * g1 + cosine * g
        g, g1, g2 = (sine**2 * g, sine**2 * g1 + 2 * sine * cosine * g,
                     sine**2 * g2 + 4 * sine * cosine * g1 + 2 * (cosine**2 - sine**2) * g)
    none, cot = 0 * f, cosine / sine
    row = lambda u, v, w: np.hstack([u, v, w])
    edge, partial = _polynomials(count, low, high, np.array([high]))[0][0], []
    for n in 2 + 4 * np.arange(terms):  # u cos(nθ), v sin(nθ), w cos(nθ)
        m = n / sine
        strains = [part / radius for part in (row(f1, none, g), row(cot * f, m * f, g),
                                              row(-m * f, f1 - cot * f, none) / 2)]
        along, along1 = row(f, none, -g1), row(f1, none, -g2)  # rotations times the radius
        across, across1 = row(none, f, m * g), row(none, f1, m * (g1 - cot * g))
        curvatures = [part / radius**2 for part in (along1, m * across + cot * along,
                                                    (across1 - cot * across - m * along) / 2)]
        matrix = np.pi * _stiffness(strains, curvatures, weights, young, poisson, thickness)
        scale = 1 / np.sqrt(np.diag(matrix))
        forces = np.concatenate([0 * edge, 0 * edge, 4 * load * edge])
        answer = scale * np.linalg.solve(matrix * np.outer(scale, scale), scale * forces)
        partial.append(edge @ answer[2 * count:])
    half, whole = np.sum(partial[:terms // 2]), np.sum(partial)
    return float((4 * whole - half) / 3)  # the tail is proportional to terms⁻²


def twisted_beam(direction, young=29e6, length=12.0, width=1.1, thickness=0.32, load=1.0):
    """Deflection of the end of a cantilever that is twisted by 90°, by Euler-Bernoulli theory: closed form of
    ∫ (L-x)² (cos²φ/EI₁ + sin²φ/EI₂) dx, φ = π x/2L. The load is along the width ("in-plane") or the thickness
    ("out-of-plane") of the free end. MacNeal and Harder 1985 state 5.424e-3 and 1.754e-3. This theory
    neglects shear, warping and the stiffness of a plate against anticlastic bending."""
    soft, stiff = young * width * thickness**3 / 12, young * thickness * width**3 / 12
    mean, wave = length**3 / 6, length**3 / np.pi**2  # ∫ (L-x)² cos²φ dx = mean + wave
    at_clamp, other = (soft, stiff) if direction == "in-plane" else (stiff, soft)
    return load * ((mean + wave) / at_clamp + (mean - wave) / other)
