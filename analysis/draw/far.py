"""Cloth that is far from the origin of its coordinates, as in geographic data.

Pages store positions in single precision, which rounds by up to 2⁻²⁴ of the distance from the origin. If this
error can exceed TOLERATED edge lengths, pages store positions relative to a point near the cloth. Like
lib/bendlab/mesh/single_precision.cpp, origin_of() takes a point with round coordinates.
"""
import numpy as np

TOLERATED = 1e-4  # edge lengths


def origin_of(rest, triangles):
    """(3) a point with round coordinates near the middle of a mesh; zeros if single precision is enough."""
    sides = rest[triangles] - rest[np.roll(triangles, -1, axis=1)]
    edge = np.linalg.norm(sides, axis=2).mean()
    if not np.abs(rest).max() * 2**-24 > TOLERATED * edge:
        return np.zeros(3)
    power = int(np.floor(np.log10(np.ptp(rest, axis=0).max())))
    unit, middle = 10.0**abs(power), (rest.min(axis=0) + rest.max(axis=0)) / 2
    return (np.rint(middle / unit) * unit if power >= 0 else np.rint(middle * unit) / unit) + 0.0  # no -0
