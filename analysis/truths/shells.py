"""Benchmarks of shells: geometry, material, loads, supports and target numbers. Units are those of the
sources; any consistent system of units will do.

SLL: Sze, Liu and Lo 2004, Popular benchmark problems for geometric nonlinear analysis of shells, doi
10.1016/j.finel.2003.11.001. The tables were read in a demo of Project Chrono (shells of Reissner's type), not
in the paper. The numbers also have the error of SLL's meshes, which is not known.
MH: MacNeal and Harder 1985, A proposed standard set of problems to test finite element accuracy, doi
10.1016/0168-874X(85)90003-4.
BS: Belytschko, Stolarski, Liu, Carpenter and Ong 1985, Stress projection for membrane and shear locking in
shell finite elements, doi 10.1016/0045-7825(85)90035-0.
"""
from dataclasses import dataclass

import numpy as np

from truths import cantilevers, linear_shells


@dataclass(frozen=True)
class Load:
    """A dead load on a place. `kind`: "point" (force), "line" (force per length), "area" (force per area),
    "line moment" (moment per length; turns with the shell). `size` times `direction` is the whole load."""
    kind: str
    place: str
    direction: tuple
    size: float


@dataclass(frozen=True)
class Support:
    """What is held at a place: any of "x", "y", "z" (displacements) and "rotation" (the tangent plane)."""
    place: str
    held: tuple


@dataclass(frozen=True)
class Target:
    """Published displacements of a point along a unit vector. `values`: {share of the whole load:
    displacement}; `error`: half a unit of the last published digit; `computed`: the displacement in the limit
    of thin shells at the whole load, as a function without arguments, if analysis/truths can compute it."""
    point: str
    direction: tuple
    values: dict
    error: float
    computed: object = None


@dataclass(frozen=True)
class Benchmark:
    """`linear`: whether the targets hold for small displacements; `surface`: words for `place`, which is a
    function of two parameters (u, v) in `ranges` → (3, …) positions; `lengths`: the same geometry as numbers.
    Places of loads, supports and targets are values of u and v."""
    name: str
    source: str
    linear: bool
    surface: str
    place: object
    ranges: tuple
    lengths: dict
    young: float
    poisson: float
    thickness: float
    loads: tuple
    supports: tuple
    targets: tuple
    note: str

    @property
    def rigidity(self):
        """Flexural rigidity D = E h³ / (12 (1 - ν²))."""
        return self.young * self.thickness**3 / (12 * (1 - self.poisson**2))


X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
DOWN, BACK = (0.0, 0.0, -1.0), (-1.0, 0.0, 0.0)
FIXED = ("x", "y", "z", "rotation")
TENTHS = tuple(k / 10 for k in range(1, 11))


def _flat(u, v):
    return np.array([u, v, 0 * u])


def _ring(u, v):
    return np.array([v * np.cos(u), v * np.sin(u), 0 * u])


def _arch(u, v):
    return np.array([u, 25 * np.sin(v), 25 * np.cos(v)])


def _tube(u, v):
    return np.array([300 * np.cos(u), 300 * np.sin(u), v])


def _ball(u, v):
    return 10 * np.array([np.sin(v) * np.cos(u), np.sin(v) * np.sin(u), np.cos(v)])


def _twisted(u, v):
    angle = np.pi * u / 24
    return np.array([u, v * np.cos(angle), v * np.sin(angle)])


def _by_share(numbers):
    """{0.1: first number, …, 1.0: tenth number}"""
    return dict(zip(TENTHS, numbers, strict=True))


def _closed_form(which):
    return {share: 12 * cantilevers.end_moment(share)[which] for share in TENTHS}


SHEARED = Benchmark(
    name="cantilever with end shear", source="SLL", linear=False,
    surface="rectangle: u along x from the clamp, v along y", place=_flat, ranges=((0.0, 10.0), (0.0, 1.0)),
    lengths={"length": 10.0, "width": 1.0}, young=1.2e6, poisson=0.0, thickness=0.1,
    loads=(Load("line", "u = 10", Z, 4.0),), supports=(Support("u = 0", FIXED),),
    targets=(Target("u = 10", Z, _by_share([1.309, 2.493, 3.488, 4.292, 4.933, 5.444, 5.855, 6.190, 6.467,
                                            6.698]), 5e-4, lambda: 10 * cantilevers.end_shear(4.0)[0]),
             Target("u = 10", BACK, _by_share([0.103, 0.381, 0.763, 1.184, 1.604, 2.002, 2.370, 2.705, 3.010,
                                               3.286]), 5e-4, lambda: 10 * cantilevers.end_shear(4.0)[1])),
    note="The exact inextensible elastica deflects more than SLL's mesh, by 5e-4 to 3.4e-3.")

ROLLED = Benchmark(
    name="cantilever with end moment", source="SLL", linear=False,
    surface="rectangle: u along x from the clamp, v along y", place=_flat, ranges=((0.0, 12.0), (0.0, 1.0)),
    lengths={"length": 12.0, "width": 1.0}, young=1.2e6, poisson=0.0, thickness=0.1,
    loads=(Load("line moment", "u = 12", (0.0, -1.0, 0.0), 50 * np.pi / 3),),
    supports=(Support("u = 0", FIXED),),
    targets=(Target("u = 12", Z, _closed_form(0), 1e-14), Target("u = 12", BACK, _closed_form(1), 1e-14)),
    note="The whole moment is 2 π E I / L, and bends the strip to a circle. The targets are the closed form.")

SLIT = Benchmark(
    name="slit annular plate", source="SLL, table 4", linear=False,
    surface="ring: u is the angle from one side of the slit, v the radius", place=_ring,
    ranges=((0.0, 2 * np.pi), (6.0, 10.0)), lengths={"inner radius": 6.0, "outer radius": 10.0},
    young=21e6, poisson=0.0, thickness=0.03,
    loads=(Load("line", "u = 2π", Z, 0.8),), supports=(Support("u = 0", FIXED),),
    targets=(Target("u = 2π, v = 6", Z, _by_share([4.277, 6.725, 8.340, 9.529, 10.468, 11.257, 11.970, 12.642,
                                                   13.282, 13.891]), 5e-4),
             Target("u = 2π, v = 10", Z, _by_share([5.876, 9.160, 11.213, 12.661, 13.768, 14.674, 15.469,
                                                    16.202, 16.886, 17.528]), 5e-4)),
    note="No exact solution is known. The plate stretches little, so that the shape is nearly developable.")

ROOF = Benchmark(
    name="Scordelis-Lo roof", source="MH; Scordelis and Lo 1964, J. Am. Concrete Inst. 61", linear=True,
    surface="part of a cylinder: u along x, v the angle from the top", place=_arch,
    ranges=((-25.0, 25.0), (np.radians(-40.0), np.radians(40.0))),
    lengths={"radius": 25.0, "length": 50.0}, young=4.32e8, poisson=0.0, thickness=0.25,
    loads=(Load("area", "everywhere", DOWN, 90.0),),
    supports=(Support("u = ±25", ("y", "z")), Support("u = 0, v = 0", ("x",))),
    targets=(Target("u = 0, v = ±40°", DOWN, {1.0: 0.3024}, 5e-5,
                    lambda: linear_shells.scordelis_lo(theory="koiter")),),
    note="The exact limit of thin shells is 0.30059 (Koiter) or 0.30060 (Sanders); converged elements give "
         "0.3006. MH state 0.3024 as the number to which many elements converge.")

PINCHED = Benchmark(
    name="pinched cylinder with end diaphragms", source="BS; Lindberg, Olson and Cowper 1969", linear=True,
    surface="cylinder: u is the angle, v along z", place=_tube,
    ranges=((0.0, 2 * np.pi), (-300.0, 300.0)), lengths={"radius": 300.0, "length": 600.0},
    young=3e6, poisson=0.3, thickness=3.0,
    loads=(Load("point", "u = 0, v = 0", BACK, 1.0), Load("point", "u = 180°, v = 0", X, 1.0)),
    supports=(Support("v = ±300", ("x", "y")), Support("u = 90°, v = 0", ("z",))),
    targets=(Target("u = 0, v = 0", BACK, {1.0: 1.8248e-5}, 5e-10,
                    lambda: linear_shells.pinched_cylinder(theory="koiter")),),
    note="The whole Fourier series of thin-shell theory gives 1.8277e-5 (Sanders) or 1.8282e-5 (Koiter). The "
         "stated number is about the sum of 71 × 71 terms. In theories with shear the deflection under a "
         "point is infinite, so that fine meshes of such elements exceed all these numbers.")


def _hemisphere(name, source, hole, published):
    return Benchmark(
        name=name, source=source, linear=True,
        surface="sphere: u is the longitude, v the angle from the axis", place=_ball,
        ranges=((0.0, 2 * np.pi), (np.radians(hole), np.pi / 2)), lengths={"radius": 10.0},
        young=6.825e7, poisson=0.3, thickness=0.04,
        loads=(Load("point", "u = 0°, v = 90°", X, 2.0), Load("point", "u = 180°, v = 90°", BACK, 2.0),
               Load("point", "u = 90°, v = 90°", (0.0, -1.0, 0.0), 2.0),
               Load("point", "u = 270°, v = 90°", Y, 2.0)),
        supports=(Support("u = 0°, v = 90°", ("y", "z")), Support("u = 180°, v = 90°", ("y", "z")),
                  Support("u = 90°, v = 90°", ("x", "z"))),
        targets=(Target("u = 0°, v = 90°", X, {1.0: published}, 5e-5,
                        lambda: linear_shells.hemisphere(hole)),),
        note="A quarter of the hemisphere carries half of each point load, which is MH's load of 1. The "
             "supports only prevent rigid motions. The limit of thin shells (Sanders) is 0.09352 with the "
             "hole, and 0.09241 without a hole.")


HOLED = _hemisphere("pinched hemisphere with a hole of 18°", "MH", 18.0, 0.0940)
CLOSED = _hemisphere("pinched hemisphere, closed", "Morley and Morris 1978, quoted by MH", 0.0, 0.0924)


def _beam(name, direction, published):
    return Benchmark(
        name=f"twisted beam, load {name}", source="MH", linear=True,
        surface="u along x from the clamp, v along the width, which turns from y to z", place=_twisted,
        ranges=((0.0, 12.0), (-0.55, 0.55)), lengths={"length": 12.0, "width": 1.1},
        young=29e6, poisson=0.22, thickness=0.32,
        loads=(Load("point", "u = 12, v = 0", direction, 1.0),), supports=(Support("u = 0", FIXED),),
        targets=(Target("u = 12, v = 0", direction, {1.0: published}, 5e-7,
                        lambda: linear_shells.twisted_beam(name)),),
        note="The plane is that of the free end. The computed number is Euler-Bernoulli theory; shear adds "
             "3.4e-6. The thickness is 0.29 of the width, so that thin-shell theory is not exact.")


IN_PLANE, OUT_OF_PLANE = _beam("in-plane", Z, 5.424e-3), _beam("out-of-plane", Y, 1.754e-3)
ALL = (SHEARED, ROLLED, SLIT, ROOF, PINCHED, HOLED, CLOSED, IN_PLANE, OUT_OF_PLANE)
