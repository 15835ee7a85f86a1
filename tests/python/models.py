"""Models that are written in Python, for the tests."""
import numpy as np

import bendlab as bl


def angle(x):
    """Returns the fold angle at each edge (n) and its gradient (n, 4, 3). The order of operations is that of
    the C++ oracle (hinge_angle.hpp)."""
    p0, p1, p2, p3 = np.moveaxis(x, 1, 0)
    a, b, c, d, e = p2 - p0, p2 - p1, p3 - p1, p3 - p0, p1 - p0
    n1, n2 = np.cross(a, b), np.cross(c, d)
    length = np.sqrt((e * e).sum(1))
    u1, u2 = n1 / (n1 * n1).sum(1)[:, None], n2 / (n2 * n2).sum(1)[:, None]

    def along(v):
        return ((v * e).sum(1) / length)[:, None]

    value = np.arctan2((np.cross(n1, n2) * e).sum(1) / length, (n1 * n2).sum(1))
    gradient = np.stack([-along(b) * u1 - along(c) * u2, along(a) * u1 + along(d) * u2, -length[:, None] * u1,
                         -length[:, None] * u2], axis=1)
    return value, gradient


def weights(x):
    """Area divided by edge length²: the softness of discrete shells."""
    edge = x[:, 1] - x[:, 0]
    area = sum(np.linalg.norm(np.cross(edge, x[:, corner] - x[:, 0]), axis=1) for corner in (2, 3)) / 2
    return area / (edge ** 2).sum(1)


class FoldAngle(bl.Model):
    """the fold angle at every edge between two triangles"""

    factor = bl.Setting(1.0, unit="1", meaning="factor on the angle", minimum=0, above=True)

    def elements(self, rest):
        x = rest.positions[rest.hinges]
        return bl.Elements(rest.hinges, softness=weights(x), angle=angle(x)[0])

    def constraint(self, x, rest):
        value, gradient = angle(x)
        return self.factor * (value - rest.angle), self.factor * gradient


class FoldEnergy(bl.Model):
    """half the square of the fold angle, as an energy"""

    def elements(self, rest):
        x = rest.positions[rest.hinges]
        return bl.Elements(rest.hinges, softness=weights(x), angle=angle(x)[0])

    def energy(self, x, rest):
        value, gradient = angle(x)
        return 0.5 * (value - rest.angle) ** 2, (value - rest.angle)[:, None, None] * gradient
