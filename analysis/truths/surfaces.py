"""Bending energies of prescribed poses, over the flexural rigidity D. Dimensionless.

The energy density over D of an isotropic Kirchhoff-Love shell with Poisson's ratio ν is

    ((1 - ν) |K|² + ν (tr K)²) / 2,   K = a⁻¹ (b - b₀)

with the first and second fundamental forms a and b of the pose and b₀ of the rest shape (Koiter 1966, On the
nonlinear theory of thin elastic shells, eq. 5.2; |K|² means tr K²). The poses do not stretch their rest
shapes. The poses are those of the paper "Better Bending", github.com/evouga/better-bending,
energy-benchmark/src.

The forms come from derivatives of polynomials through positions at Gauss points, and the integrals from
Gauss's rule. With 32 points per direction the relative error of all energies is below 1e-11.
"""
import numpy as np

from truths.collocation import differentiation, interpolation, points

POINTS = 32
# Lengths in m, as in the paper's main.cpp.
CYLINDER = {"radius": 0.0325, "height": 0.122}
SPHERE = {"radius": 0.03}
TORUS = {"tube": 0.015, "centre": 0.03}  # radius of the tube, and distance of its centre from the axis
HELIX = {"radius": 0.02, "pitch": 0.1, "reach": 0.1}


def energy(pose, ranges, poisson, rest=None, count=POINTS):
    """∫ density dA / D. `pose`, `rest`: functions (u, v) → (3, …) positions; `ranges`: ((u₀, u₁), (v₀, v₁));
    without `rest` the rest shape has b₀ = 0. Normals are ∂u × ∂v."""
    nodes, weights, slope = spectral_rule(count)
    (u0, u1), (v0, v1) = ranges
    u, v = np.meshgrid(u0 + (u1 - u0) * nodes, v0 + (v1 - v0) * nodes, indexing="ij")
    slopes = (slope / (u1 - u0), slope / (v1 - v0))
    first, second, area = _forms(pose(u, v), slopes)
    if rest is not None:
        second = second - _forms(rest(u, v), slopes)[1]
    shape = np.linalg.solve(first, second)
    trace = np.trace(shape, axis1=-2, axis2=-1)
    square = np.trace(shape @ shape, axis1=-2, axis2=-1)
    density = ((1 - poisson) * square + poisson * trace**2) / 2
    return float(weights @ (density * area) @ weights) * (u1 - u0) * (v1 - v0)


def spectral_rule(count):
    """Gauss points and weights of [0, 1], and the matrix of derivatives at these points."""
    gauss, weights = np.polynomial.legendre.leggauss(count)
    nodes, chebyshev = (gauss + 1) / 2, points(count - 1)
    to_gauss = interpolation(chebyshev, nodes)
    return nodes, weights / 2, to_gauss @ differentiation(chebyshev) @ np.linalg.inv(to_gauss)


def _forms(position, slopes):
    """First and second fundamental forms (…, 2, 2) and the area per parameters, at all points."""
    by_u = lambda values: np.einsum("ij,kjl->kil", slopes[0], values)
    by_v = lambda values: np.einsum("ij,klj->kli", slopes[1], values)
    tangents = (by_u(position), by_v(position))
    normal = np.cross(*tangents, axis=0)
    area = np.linalg.norm(normal, axis=0)
    first = np.array([[(a * b).sum(0) for b in tangents] for a in tangents])
    second = np.array([[(by(a) * normal / area).sum(0) for by in (by_u, by_v)] for a in tangents])
    return np.moveaxis(first, (0, 1), (-2, -1)), np.moveaxis(second, (0, 1), (-2, -1)), area


def _rolled_first(radius):
    """(x, y) of a flat sheet → a cylinder that bends the first axis."""
    return lambda x, y: np.array([radius * np.cos(x / radius), radius * np.sin(x / radius), y])


def _rolled_second(radius, side):
    """(x, y) of a flat sheet → a cylinder that bends the second axis, to the side ±1 of the sheet."""
    return lambda x, y: np.array([side * radius * np.cos(y / radius), radius * np.sin(y / radius), x])


def half_cylinder(poisson, radius=CYLINDER["radius"], height=CYLINDER["height"], **numerics):
    """A rectangle π radius × height, rolled to half a cylinder. Closed form: π height / (2 radius) =
    5.896528, for every ν."""
    return energy(_rolled_first(radius), ((0, np.pi * radius), (0, height)), poisson, **numerics)


def rest_curved_cylinder(poisson, radius=CYLINDER["radius"], height=CYLINDER["height"], same_side=False,
                         **numerics):
    """The half-cylinder whose rest shape is the same rectangle, rolled about the other axis. With the paper's
    positions of pose and rest shape the two cylinders bend to opposite sides of the sheet, and the closed
    form is (1 + ν) π height / radius, 15.330972 at ν = 0.3 (the paper's ExactKichhoffLove.h). If they bend to
    the same side, the closed form is (1 - ν) π height / radius. The paper's ExactMeanCurvatureSquared.h takes
    the other sign than ExactKichhoffLove.h."""
    rest = _rolled_second(radius, -1 if same_side else 1)
    return energy(_rolled_first(radius), ((0, np.pi * radius), (0, height)), poisson, rest, **numerics)


def sphere(poisson, radius=SPHERE["radius"], **numerics):
    """A sphere whose rest shape has no curvature. Closed form: 4 π (1 + ν), for every radius; 16.336282 at
    ν = 0.3."""
    pose = lambda u, v: radius * np.array([np.sin(u) * np.cos(v), np.sin(u) * np.sin(v), np.cos(u)])
    return energy(pose, ((0, np.pi), (0, 2 * np.pi)), poisson, **numerics)


def half_torus(poisson, tube=TORUS["tube"], centre=TORUS["centre"], **numerics):
    """The upper half of a torus, whose rest shape has no curvature. Closed form: π² c²/(c² - 1)^(1/2) with c
    = centre / tube (Willmore's energy, because the total Gaussian curvature is 0); 22.792875 for every ν."""
    pose = lambda u, v: np.array([(centre + tube * np.cos(v)) * np.cos(u),
                                  (centre + tube * np.cos(v)) * np.sin(u), tube * np.sin(v) + 0 * u])
    return energy(pose, ((0, 2 * np.pi), (0, np.pi)), poisson, **numerics)


def helix(poisson, radius=HELIX["radius"], pitch=HELIX["pitch"], reach=HELIX["reach"], **numerics):
    """The tangent developable of a turn of a helix, between `reach` and 2 reach along the tangents, from
    flat. Closed form: pitch² ln 2 / (2 radius (pitch² + 4 π² radius²)^(1/2)) = 1.079017, for every ν and
    reach."""
    start = reach / radius
    pose = lambda u, v: np.array([radius * (np.cos(u) - v * np.sin(u)), radius * (np.sin(u) + v * np.cos(u)),
                                  pitch * (u + v) / (2 * np.pi)])
    return energy(pose, ((0, 2 * np.pi), (start, 2 * start)), poisson, **numerics)
