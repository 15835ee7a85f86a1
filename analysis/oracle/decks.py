"""Benchmarks of shells, as input files ("decks") for CalculiX.

A mesh consists of patches. A patch is a grid of quadrilaterals on a surface; the element S8R covers a
quadrilateral, two elements S6 cover it by triangles. Both elements are quadratic: they have nodes on the
middles of their edges. CalculiX turns them into solids of a single layer (C3D20R, C3D15), which also shear.
So its shells are a little softer than thin-shell theory.
"""
from dataclasses import dataclass
from math import cos, pi, sin

import numpy as np

from truths import cantilevers, shells

# Degrees of freedom: 1 to 3 move a node along x, y, z; 4 to 6 turn it about x, y, z.
CLAMPED = (1, 2, 3, 4, 5, 6)
# A diaphragm normal to y. The edge of a thin shell can't turn about y either, because it keeps its shape.
DIAPHRAGM = (1, 3, 5)
UP, DOWN, INWARD = (0, 0, 1), (0, 0, -1), (-1, 0, 0)
GRAVITY = 9.81  # m/s²
CLOSE = 1e-6  # distance of equal positions, as a fraction of the size of a benchmark

# With its default tolerances, CalculiX leaves errors near 0.1 %, and it gives up on thin shells, which need
# more iterations. The increment grows by half after two increments of at most 12 iterations.
NONLINEAR_STEP = ("*STEP,NLGEOM,INC=1000", "*STATIC", "0.05,1.,1e-6,1.",
                  "*CONTROLS,PARAMETERS=TIME INCREMENTATION", "20,40,20,50,30,12,,10", "",
                  "*CONTROLS,PARAMETERS=FIELD", "2e-5,1e-3")
LINEAR_STEP = ("*STEP", "*STATIC")


@dataclass(frozen=True)
class Quantity:
    """A number that a benchmark measures: the mean displacement of `nodes` along `direction`. truths: its
    true values at the end of the first steps. Later steps have no row in the results."""
    name: str
    nodes: tuple
    direction: tuple
    truths: tuple
    unit: str = "1"


@dataclass(frozen=True)
class Deck:
    """An input file. Step k of the file ends at the fraction `loads[k]` of the load."""
    benchmark: str
    element: str
    mesh: str
    text: str
    loads: tuple
    quantities: tuple


@dataclass(frozen=True)
class Shell:
    modulus: float
    poisson: float
    thickness: float

    @property
    def rigidity(self):
        """Flexural rigidity."""
        return self.modulus * self.thickness**3 / (12 * (1 - self.poisson**2))


@dataclass(frozen=True)
class Load:
    """Forces {(node, degree of freedom): force or moment}, and weight per area, which acts along -z."""
    forces: dict
    weight: float = 0.0


class Mesh:
    """Nodes, and elements of one kind. Numbers of nodes and elements begin with 1."""

    def __init__(self, element, size):
        self.element, self.size = element, size
        self.positions, self.elements = [], []

    def add_patch(self, n, m, surface):
        """Adds n × m quadrilaterals. surface(u, v) gives the position for u and v from 0 to 1. Nodes of other
        patches at the same place become nodes of this patch, too. Returns {(i, j): node number} with i up to
        2 n and j up to 2 m."""
        others = {self._cell(position): node for node, position in enumerate(self.positions, 1)}
        grid = {}
        for j in range(2 * m + 1):
            for i in range(2 * n + 1):
                if self.element == "S6" or i % 2 == 0 or j % 2 == 0:
                    position = np.array(surface(i / (2 * n), j / (2 * m)))
                    grid[i, j] = others.get(self._cell(position)) or self._add_node(position)
        for j in range(0, 2 * m, 2):
            for i in range(0, 2 * n, 2):
                for polygon in self._polygons([(i, j), (i + 2, j), (i + 2, j + 2), (i, j + 2)]):
                    middles = [((a[0] + b[0]) // 2, (a[1] + b[1]) // 2)
                               for a, b in zip(polygon, polygon[1:] + polygon[:1])]
                    self.elements.append([grid[place] for place in polygon + middles])
        return grid

    def _cell(self, position):
        return tuple(np.round(position / (CLOSE * self.size)).astype(int))

    def _add_node(self, position):
        self.positions.append(position)
        return len(self.positions)

    def _polygons(self, corners):
        a, b, c, d = corners
        return [[a, b, c, d]] if self.element == "S8R" else [[a, b, c], [a, c, d]]

    def where(self, axis, value):
        """The numbers of all nodes whose coordinate `axis` (0, 1 or 2) has this value."""
        return [node for node, position in enumerate(self.positions, 1)
                if abs(position[axis] - value) < CLOSE * self.size]

    def normals(self):
        """{node number: sum of the normals of its elements}"""
        sums = {}
        for element in self.elements:
            first, second, third = (self.positions[node - 1] for node in element[:3])
            for node in element:
                sums[node] = sums.get(node, 0.0) + np.cross(second - first, third - first)
        return sums

    def mirror(self, axis, value):
        """Symmetry about the plane where coordinate `axis` has this value: pairs of nodes and degrees of
        freedom. CalculiX projects an axis of rotation onto the shell, so a single axis in the plane is
        enough. If both axes in the plane have opposite projections, CalculiX clamps the node."""
        in_plane, normals = [other for other in range(3) if other != axis], self.normals()
        return [([node], (axis + 1, 4 + min(in_plane, key=lambda other: abs(normals[node][other]))))
                for node in self.where(axis, value)]

    def text(self):
        nodes = [f"{node},{x:.10g},{y:.10g},{z:.10g}" for node, (x, y, z) in enumerate(self.positions, 1)]
        elements = [f"{k}," + ",".join(map(str, element)) for k, element in enumerate(self.elements, 1)]
        return "\n".join(["*NODE,NSET=NODES", *nodes, f"*ELEMENT,TYPE={self.element},ELSET=SHELL", *elements])


def along(nodes, axis, total):
    """A uniform load on an edge, whose nodes come in order: {(node, axis): force}, by Simpson's rule."""
    last = len(nodes) - 1
    return {(node, axis): total * (4 if k % 2 else 1 if k in (0, last) else 2) / (3 * last)
            for k, node in enumerate(nodes)}


def step_text(load, fraction, start):
    forces = [f"{node},{axis},{fraction * force:.10g}" for (node, axis), force in load.forces.items()]
    weight = ["*DLOAD", f"SHELL,GRAV,{fraction:.10g},0.,0.,-1."] if load.weight else []
    return "\n".join([*start, *(["*CLOAD", *forces] if forces else []), *weight,
                      "*NODE PRINT,NSET=MEASURED,FREQUENCY=1000000", "U", "*END STEP"])


def deck(benchmark, mesh, description, shell, fixed, load, quantities, loads=()):
    """A deck; linear without `loads`, the fractions of the load. fixed: pairs of nodes and degrees of
    freedom."""
    measured = sorted({node for quantity in quantities for node in quantity.nodes})
    weight = ["*DENSITY", f"{load.weight / shell.thickness:.10g}"] if load.weight else []
    start = NONLINEAR_STEP if loads else LINEAR_STEP
    steps = [step_text(load, fraction, start) for fraction in loads or (1.0,)]
    text = "\n".join([
        f"** {benchmark}, {mesh.element}, {description}", mesh.text(),
        "*NSET,NSET=MEASURED", *(f"{node}," for node in measured),
        "*MATERIAL,NAME=MATERIAL", "*ELASTIC", f"{shell.modulus:.10g},{shell.poisson:.10g}", *weight,
        "*SHELL SECTION,ELSET=SHELL,MATERIAL=MATERIAL", f"{shell.thickness:.10g}",
        "*BOUNDARY", *(f"{node},{axis},{axis}" for nodes, axes in fixed for node in nodes for axis in axes),
        *steps, ""])
    return Deck(benchmark, mesh.element, description, text, loads or (1.0,), tuple(quantities))


def strip(element, n, m, length, width):
    """A flat strip along x. Returns the mesh, and the nodes of the end at x = length in order. A strip of S8R
    elements needs m > 1: a single row has a motion without energy."""
    mesh = Mesh(element, length)
    grid = mesh.add_patch(n, m, lambda u, v: (length * u, width * v, 0.0))
    return mesh, tuple(grid[2 * n, j] for j in range(2 * m + 1))


def tip_moves(tip, moves, length, unit):
    """The quantities of a strip whose tip moves down and in by these fractions of its length: a pair for each
    step."""
    down, inward = (tuple(length * move for move in component) for component in zip(*moves))
    return [Quantity("tip down", tip, DOWN, down, unit), Quantity("tip in", tip, INWARD, inward, unit)]


def cantilever_shear(element, n):
    """Sze, Liu, Lo (2004): a cantilever with a shear force at its end. The truth is the elastica, from which
    the finite-element results of Sze, Liu and Lo (6.698 down, 3.286 in) differ by 0.03 and 0.1 %."""
    length, m, shell, force, loads = 10.0, max(2, n // 8), Shell(1.2e6, 0.0, 0.1), 4.0, (0.5, 1.0)
    mesh, tip = strip(element, n, m, length, 1.0)
    moves = [cantilevers.end_shear(fraction * force * length**2 / shell.rigidity) for fraction in loads]
    return deck("cantilever, end shear", mesh, f"{n} x {m}", shell, [(mesh.where(0, 0), CLAMPED)],
                Load(along(tip, 3, -force)), tip_moves(tip, moves, length, "1"), loads)


def cantilever_moment(element, n):
    """Sze, Liu, Lo (2004): a cantilever with a moment at its end, which rolls it into a circle.

    A narrow flange across the end makes CalculiX join the layers there by rigid bodies. Otherwise the end
    could not turn by more than 90 degrees. All nodes stay in their planes normal to y: beyond 180 degrees
    the strip leaves the plane, because the moment keeps its axis. The truths are those of an inextensible
    strip; at the full load, strains of 2.6 % move the tip by 0.1 %. The height of the tip at the full load is
    left out, because it is 0."""
    length, shell, loads = 12.0, Shell(1.2e6, 0.0, 0.1), (0.25, 0.5, 1.0)
    mesh, tip = strip(element, n, 2, length, 1.0)
    clamp = mesh.where(0, 0)
    mesh.add_patch(1, 2, lambda u, v: (length, v, shell.thickness * u))
    free = [node for node in range(1, len(mesh.positions) + 1) if node not in clamp]
    turns = [2 * pi * fraction for fraction in loads]
    quantities = [Quantity("tip up", tip, UP, tuple(length * (1 - cos(turn)) / turn for turn in turns[:-1])),
                  Quantity("tip in", tip, INWARD, tuple(length * (1 - sin(turn) / turn) for turn in turns))]
    moment = -2 * pi / length * shell.rigidity
    return deck("cantilever, end moment", mesh, f"{n} x 2", shell,
                [(clamp, CLAMPED), (free, (2,)), (tip, (4, 6))], Load(along(tip, 5, moment)), quantities,
                loads)


def slit_annulus(element, around, across):
    """Sze, Liu, Lo (2004): a flat ring with a slit. An edge of the slit is lifted, the other is clamped."""
    mesh = Mesh(element, 10.0)

    def ring(u, v):
        angle, radius = 2 * pi * u, 6.0 + 4.0 * v
        return radius * cos(angle), radius * sin(angle), 0.0

    grid = mesh.add_patch(around, across, ring)
    lifted = [grid[0, j] for j in range(2 * across + 1)]
    clamped = [grid[2 * around, j] for j in range(2 * across + 1)]
    quantities = [Quantity("inner point up", (lifted[0],), UP, (10.468, 13.891)),
                  Quantity("outer point up", (lifted[-1],), UP, (13.768, 17.528))]
    return deck("slit annulus", mesh, f"{around} x {across}", Shell(21e6, 0.0, 0.03), [(clamped, CLAMPED)],
                Load(along(lifted, 3, 0.8 * 4.0)), quantities, (0.5, 1.0))


def arc(radius, degrees, length):
    """A part of a cylinder along y, from the top (u = 0) towards x. The surface of a patch."""
    def surface(u, v):
        angle = np.radians(degrees) * u
        return radius * sin(angle), length * v, radius * cos(angle)
    return surface


def roof(element, n):
    """Scordelis-Lo roof, a quarter of it: diaphragm at y = 0, mirrors at y = 25 and x = 0."""
    mesh = Mesh(element, 25.0)
    grid = mesh.add_patch(n, n, arc(25.0, 40.0, 25.0))
    return deck("Scordelis-Lo roof", mesh, f"{n} x {n}, a quarter", Shell(4.32e8, 0.0, 0.25),
                [(mesh.where(1, 0), DIAPHRAGM), *mesh.mirror(1, 25.0), *mesh.mirror(0, 0)],
                Load({}, weight=90.0),
                [Quantity("middle of the free edge down", (grid[2 * n, 2 * n],), DOWN,
                          (shells.ROOF.targets[0].computed(),))])


def pinched_cylinder(element, n):
    """An eighth of a cylinder along y: diaphragm at y = 0, mirrors at y = 300, x = 0 and z = 0. The truth is
    that of thin-shell theory; under a point force, shells that shear move without bound on finer meshes."""
    mesh = Mesh(element, 300.0)
    grid = mesh.add_patch(n, n, arc(300.0, 90.0, 300.0))
    pinched = grid[0, 2 * n]
    mirrors = [*mesh.mirror(0, 0), *mesh.mirror(1, 300.0), *mesh.mirror(2, 0)]
    return deck("pinched cylinder", mesh, f"{n} x {n}, an eighth", Shell(3e6, 0.3, 3.0),
                [(mesh.where(1, 0), DIAPHRAGM), *mirrors],
                Load({(pinched, 3): -0.25}), [Quantity("under the force", (pinched,), DOWN,
                                                       (shells.PINCHED.targets[0].computed(),))])


def hemisphere(benchmark, mesh, description, truth):
    """A quarter of a hemisphere of radius 10, with an outward force on x and an inward force on y."""
    on_x, on_y = (mesh.where(axis, 10.0)[0] for axis in (0, 1))
    return deck(benchmark, mesh, f"{description}, a quarter", Shell(6.825e7, 0.3, 0.04),
                [*mesh.mirror(0, 0), *mesh.mirror(1, 0), ([on_x], (3,))],
                Load({(on_x, 1): 1.0, (on_y, 2): -1.0}),
                [Quantity("under the outward force", (on_x,), (1, 0, 0), (truth,)),
                 Quantity("under the inward force", (on_y,), (0, -1, 0), (truth,))])


def hemisphere_with_hole(element, n):
    """The hole reaches 18 degrees from the pole."""
    mesh = Mesh(element, 10.0)

    def sphere(u, v):
        longitude, latitude = pi / 2 * u, np.radians(72) * v
        equator = 10.0 * cos(latitude)
        return equator * cos(longitude), equator * sin(longitude), 10.0 * sin(latitude)

    mesh.add_patch(n, n, sphere)
    return hemisphere("hemisphere with hole", mesh, f"{n} x {n}", shells.HOLED.targets[0].computed())


def closed_hemisphere(element, n):
    """Three faces of a cube, projected onto the sphere."""
    mesh = Mesh(element, 10.0)

    def face(axis):
        def sphere(u, v):
            point = np.roll((1.0, np.tan(pi / 4 * u), np.tan(pi / 4 * v)), axis)
            return 10.0 * point / np.linalg.norm(point)
        return sphere

    for axis in range(3):
        mesh.add_patch(n, n, face(axis))
    return hemisphere("closed hemisphere", mesh, f"3 ({n} x {n})",
                      shells.CLOSED.targets[0].computed())


def twisted_beam(element, n, axis):
    """MacNeal, Harder (1985): a beam twisted by 90 degrees, with a force at its end along y (axis 2) or z
    (axis 3). The clamped end lies along y, the loaded end along z."""
    length, width, m = 12.0, 1.1, max(1, n // 6)
    mesh = Mesh(element, length)

    def helicoid(u, v):
        angle, place = pi / 2 * u, width * (v - 0.5)
        return length * u, place * cos(angle), place * sin(angle)

    grid = mesh.add_patch(n, m, helicoid)
    tip = [grid[2 * n, j] for j in range(2 * m + 1)]
    name, direction, truth = {2: ("y", (0, 1, 0), 1.754e-3), 3: ("z", UP, 5.424e-3)}[axis]
    return deck(f"twisted beam, force along {name}", mesh, f"{n} x {m}", Shell(29e6, 0.22, 0.32),
                [(mesh.where(0, 0), CLAMPED)], Load(along(tip, axis, 1.0)),
                [Quantity("middle of the end, along the force", (tip[m],), direction, (truth,))])


def under_weight(number):
    """(deflection, shortening) over the length of a cantilever with ρ g L³/B = number."""
    size = number**(1 / 3)
    shape = cantilevers.cantilever(size)
    return -shape.y[-1] / size, 1 - shape.x[-1] / size


def draped_strip(element, n):
    """A clamped strip of cloth under its weight: B = 1e-5 N m, E h = 2e3 N/m, 0.2 kg/m². The truth is the
    elastica."""
    length, bending, membrane, weight, loads = 0.1, 1e-5, 2e3, 0.2 * GRAVITY, (0.5, 1.0)
    thickness = np.sqrt(12 * bending / membrane)
    mesh, tip = strip(element, n, 2, length, 0.03)
    moves = [under_weight(fraction * weight * length**3 / bending) for fraction in loads]
    return deck("draped strip", mesh, f"{n} x 2", Shell(membrane / thickness, 0.0, thickness),
                [(mesh.where(0, 0), CLAMPED)], Load({}, weight), tip_moves(tip, moves, length, "m"), loads)


# For each benchmark, the sizes of its meshes from coarse to fine.
SIZES = {cantilever_shear: ((8,), (16,), (32,)), cantilever_moment: ((8,), (16,), (32,)),
         slit_annulus: ((20, 4), (40, 4), (60, 4)), draped_strip: ((10,), (20,), (40,)),
         roof: ((8,), (16,), (32,)), pinched_cylinder: ((8,), (16,), (32,)),
         hemisphere_with_hole: ((8,), (16,), (32,)), closed_hemisphere: ((4,), (8,), (16,)),
         twisted_beam: ((12, 2), (24, 2), (48, 2), (12, 3), (24, 3), (48, 3))}


def all_decks():
    for benchmark, sizes in SIZES.items():
        for element in ("S6", "S8R"):
            for size in sizes:
                yield benchmark(element, *size)
