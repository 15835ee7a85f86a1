"""Draws cloth and grey obstacles as an RGB image with shadows. Both sides of a surface are lit.

This is a z-buffer in numpy. Triangles are cut into pixel rows, and rows into pixels. The nearest triangle is
the owner of a pixel. Light, shadow and colour are then computed once per visible pixel. There are no gaps
between neighbouring triangles.
"""
import itertools
from dataclasses import dataclass, replace

import numpy as np

LIGHT = np.array([-0.45, -0.62, 0.80]) / np.linalg.norm([-0.45, -0.62, 0.80])  # towards the light
SUPERSAMPLE = 2
SHADOWS = 900  # pixels along each side of a shadow map
CHUNK = 4_000_000  # pixels that are rasterised at once, to limit the memory
OBSTACLE = (0.72, 0.73, 0.74)  # sRGB
BACK = np.array([0.50, 0.58, 0.78])  # linear; the colour of a back face is multiplied by this blue


@dataclass(frozen=True)
class Camera:
    """A perspective view. `extent` = (left, right, bottom, top) of the image: tangents of the angles to the
    view axis."""

    eye: np.ndarray
    axes: np.ndarray  # rows: right, up, backward
    extent: tuple
    floor: float  # height of the ground plane, m
    size: float  # diagonal of the rest box, m

    @property
    def aspect(self):
        left, right, bottom, top = self.extent
        return (right - left) / (top - bottom)

    def project(self, points, shape):
        """(n, 3) points → (n, 2) pixel coordinates (x right, y down) and (n) nearness 1/depth. Points behind
        the camera have a nearness ≤ 0."""
        view = (points - self.eye) @ self.axes.T
        depth = -view[:, 2]
        nearness = np.where(depth > 1e-3 * self.size, 1 / np.where(depth == 0, 1, depth), -1.0)
        slopes = view[:, :2] * nearness[:, None]
        left, right, bottom, top = self.extent
        height, width = shape
        x = (slopes[:, 0] - left) / (right - left) * width
        y = (top - slopes[:, 1]) / (top - bottom) * height
        return np.stack([x, y], axis=1), nearness

    def rays(self, shape):
        """(h, w, 3) direction from the eye through the centre of every pixel."""
        left, right, bottom, top = self.extent
        x = left + (np.arange(shape[1]) + 0.5) / shape[1] * (right - left)
        y = top - (np.arange(shape[0]) + 0.5) / shape[0] * (top - bottom)
        x, y = np.meshgrid(x, y)
        return np.stack([x, y, -np.ones_like(x)], axis=-1) @ self.axes


def camera_for(cloths, pin, size, azimuth=-62.0, elevation=14.0, aspect=0.8, zoom=None, reach=1.02):
    """One camera for all cloths of a figure. `cloths`: (V, 3) positions of each cloth; `pin`: the position of
    their common pin.

    The picture shows all points within `reach` sizes of the pin. By default an unstretched sheet just fits,
    and a sheet that has flown apart does not make the other sheets small. With `zoom` the picture shows only
    the region below the pin, up to `zoom` sizes to each side. `aspect` is width over height of the picture;
    None takes the aspect of the cloth, limited to 0.5 to 2.
    """
    points = np.concatenate(list(cloths))
    near = points[np.linalg.norm(points - pin, axis=1) <= reach * size]  # without points that are not finite
    near = np.concatenate([near, [pin]])
    floor = near[:, 2].min() - 0.06 * size
    if zoom:
        near = pin + zoom * size * np.array([*itertools.product((-1, 1), (-1, 1), (0.2 - 2 / aspect, 0.2))])
    return _framing(near, azimuth, elevation, size, floor, aspect, least=0.02)


def scaled(camera, half):
    """The camera with another height of the picture. `half`: half of this height, as tangent of an angle."""
    left, right, bottom, top = camera.extent
    middle, level, across = (left + right) / 2, (bottom + top) / 2, half * camera.aspect
    return replace(camera, extent=(middle - across, middle + across, level - half, level + half))


def camera_around(points, least):
    """A camera whose picture shows all finite points of one cloth, and is at least `least` m wide."""
    points = points[np.isfinite(points).all(axis=1)]
    size = max(np.linalg.norm(np.ptp(points, axis=0)), least)
    return _framing(points, -62.0, 14.0, size, points[:, 2].min() - 0.06 * size, aspect=1.0, least=0.2)


def _framing(points, azimuth, elevation, size, floor, aspect, least):
    """The camera whose picture shows these points with a small margin. `least`: smallest half width in
    sizes."""
    azimuth, elevation = np.radians(azimuth), np.radians(elevation)
    backward = np.array([np.cos(elevation) * np.cos(azimuth), np.cos(elevation) * np.sin(azimuth),
                         np.sin(elevation)])
    right = np.cross([0.0, 0.0, 1.0], backward)
    right /= np.linalg.norm(right)
    axes = np.stack([right, np.cross(backward, right), backward])
    low, high = points.min(axis=0), points.max(axis=0)
    eye = (low + high) / 2 + 3.2 * size * axes[2]
    view = (points - eye) @ axes.T
    slopes = view[:, :2] / -view[:, 2:]
    low, high = slopes.min(axis=0), slopes.max(axis=0)
    centre, half = (low + high) / 2, np.maximum((high - low) / 2 * 1.12, least / 3.2)
    if aspect is None:
        aspect = np.clip(half[0] / half[1], 0.5, 2)
    centre[1] -= 0.03 * half[1]
    half = np.maximum(half, [half[1] * aspect, half[0] / aspect])
    extent = (centre[0] - half[0], centre[0] + half[0], centre[1] - half[1], centre[1] + half[1])
    return Camera(eye, axes, extent, floor, size)


def rasterise(xy, nearness, triangles, shape):
    """For each pixel, (h, w): the index of the nearest triangle, or -1; and its nearness, or 0.

    `xy` (V, 2) in pixels. `nearness` (V) is linear across the screen; larger is nearer. Triangles with a
    vertex of nearness ≤ 0 are left out.
    """
    height, width = shape
    owner, best = np.full(height * width, -1, np.int32), np.zeros(height * width)
    corners = np.column_stack([xy, nearness])[triangles]
    low, high = corners.min(axis=1), corners.max(axis=1)
    seen = np.isfinite(corners[..., :2]).all(axis=(1, 2)) & (low[:, 2] > 0)
    seen &= ((high[:, :2] > 0) & (low[:, :2] < (width, height))).all(axis=1)
    ids, corners = np.flatnonzero(seen), corners[seen]
    x, y, z = corners.transpose(2, 0, 1)

    # On a triangle the nearness is linear: z = z0 + gx (x - x0) + gy (y - y0).
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    gx, gy = -normal[:, :2].T / np.where(np.abs(normal[:, 2]) < 1e-12, np.inf, normal[:, 2])

    first_pixel = lambda place, count: np.clip(np.ceil(place - 0.5), 0, count).astype(int)  # by its centre
    first = first_pixel(y.min(axis=1), height)
    triangle, row = _expand(first, first_pixel(y.max(axis=1), height) - first)
    left, right = _row_interval(x[triangle], y[triangle], row + 0.5)
    begin = first_pixel(left, width)
    length = np.maximum(first_pixel(right, width) - begin, 0)

    chunk = np.cumsum(length) // CHUNK
    for part in np.split(np.arange(len(length)), np.flatnonzero(np.diff(chunk)) + 1):
        span, column = _expand(begin[part], length[part])
        t, r = triangle[part][span], row[part][span]
        depth = z[t, 0] + gx[t] * (column + 0.5 - x[t, 0]) + gy[t] * (r + 0.5 - y[t, 0])
        _keep_nearest(best, owner, r * width + column, depth, ids[t])
    return owner.reshape(shape), best.reshape(shape)


def _expand(first, count):
    """For every i, the numbers first[i] … first[i] + count[i] - 1. Returns (all i, all numbers)."""
    index = np.repeat(np.arange(len(count)), count)
    offset = np.arange(len(index)) - np.repeat(np.cumsum(count) - count, count)
    return index, first[index] + offset


def _row_interval(x, y, centre):
    """The x (n) at which horizontal lines at heights `centre` (n) enter and leave triangles x, y (n, 3); ∞
    and -∞ for a line that misses its triangle."""
    left, right = np.full(len(centre), np.inf), np.full(len(centre), -np.inf)
    for a, b in ((0, 1), (1, 2), (2, 0)):
        rise = y[:, b] - y[:, a]
        t = (centre - y[:, a]) / np.where(rise == 0, np.inf, rise)
        crosses = (rise != 0) & (t >= 0) & (t <= 1)
        at = x[:, a] + t * (x[:, b] - x[:, a])
        left = np.where(crosses, np.minimum(left, at), left)
        right = np.where(crosses, np.maximum(right, at), right)
    return left, right


def _keep_nearest(best, owner, pixel, depth, ids):
    """Stores depth and owner of each pixel that is nearer (has a larger depth) than best[pixel]."""
    while len(pixel):
        better = depth > best[pixel]
        pixel, depth, ids = pixel[better], depth[better], ids[better]
        best[pixel] = depth  # a repeated pixel gets its last depth here; the loop compares again
        owner[pixel] = ids


def _unit(vectors):
    """Vectors (n, 3) with length 1; vectors of length 0 stay."""
    return vectors / np.maximum(np.linalg.norm(vectors, axis=1, keepdims=True), 1e-300)


class _ShadowMap:
    """How near the surface is to the light, for each pixel of an image along LIGHT."""

    def __init__(self, positions, triangles, centre, reach):
        self.right = np.cross([0.0, 1.0, 0.0], LIGHT)
        self.right /= np.linalg.norm(self.right)
        self.up = np.cross(LIGHT, self.right)
        self.centre, self.reach = centre, reach
        xy, nearness = self._project(positions)
        self.map = rasterise(xy, nearness, triangles, (SHADOWS, SHADOWS))[1]

    def _project(self, points):
        relative = points - self.centre
        xy = np.stack([relative @ self.right, relative @ self.up], axis=-1) / self.reach
        return (xy + 1) / 2 * SHADOWS, 10 + relative @ LIGHT / self.reach

    def light(self, points, bias, radius, taps):
        """(n) share of the light that reaches each point: mean of taps² samples within `radius` pixels."""
        xy, nearness = self._project(points)
        total = np.zeros(len(points))
        for shift in itertools.product(np.linspace(-radius, radius, taps), repeat=2):
            x, y = np.clip((xy + shift).astype(int), 0, SHADOWS - 1).T
            total += self.map[y, x] <= nearness + bias
        return total / taps**2


def render(positions, triangles, colours, camera, width, mesh_lines=True, obstacles=None):
    """(h, w, 3) image in [0, 1] of a cloth and its obstacles. `colours` (T, 3) sRGB; `obstacles` (points,
    triangles)."""
    shape = (round(width / camera.aspect) * SUPERSAMPLE, width * SUPERSAMPLE)
    usable = np.isfinite(positions[triangles]).all(axis=(1, 2))
    triangles, colours = triangles[usable], colours[usable]
    positions, cloth = np.nan_to_num(positions), len(triangles)
    if obstacles is not None:
        triangles = np.concatenate([triangles, obstacles[1] + len(positions)])
        positions = np.concatenate([positions, obstacles[0]])
        colours = np.concatenate([colours, np.tile(OBSTACLE, (len(obstacles[1]), 1))])
    xy, nearness = camera.project(positions, shape)
    owner, nearest = rasterise(xy, nearness, triangles, shape)

    middle = camera.eye - 3.2 * camera.size * camera.axes[2]
    shadows = _ShadowMap(positions, triangles, middle, 1.3 * camera.size)
    # The background is smooth and needs no supersampling.
    backdrop = _background(camera, (shape[0] // SUPERSAMPLE, width), shadows)
    image = backdrop.repeat(SUPERSAMPLE, axis=0).repeat(SUPERSAMPLE, axis=1)
    seen = owner >= 0
    if seen.any():
        light = _shade(positions, triangles, colours, camera, xy, nearness, owner, shadows, mesh_lines, cloth)
        image[seen] = light * (1 - 0.75 * _occlusion(nearest, camera)[seen])[:, None]
    image = np.clip(image, 0, 1) ** (1 / 2.2)
    return image.reshape(shape[0] // SUPERSAMPLE, SUPERSAMPLE, width, SUPERSAMPLE, 3).mean(axis=(1, 3))


def _occlusion(nearest, camera):
    """(h, w) how much of the surroundings of a pixel is in front of it, from 0 to 1. Makes folds dark inside.

    Takes pairs of pixels on opposite sides, up to a thirtieth of the picture away. A pair contributes by how
    far its mean depth is in front of the pixel. On a plane this is zero, however the plane is inclined. Pairs
    with much smaller or larger depth belong to another part of the scene, and are ignored.
    """
    depth = np.full(nearest.shape, 1e9 * camera.size)
    depth[nearest > 0] = 1 / nearest[nearest > 0]
    total = np.zeros(depth.shape)
    for radius, angle in itertools.product((0.008, 0.018, 0.033), (0, np.pi / 4, np.pi / 2, 3 * np.pi / 4)):
        reach = max(1, round(radius * depth.shape[0]))
        shift = np.array([round(reach * part(angle + radius)) for part in (np.sin, np.cos)])
        first, second = (depth - np.roll(depth, way * shift, axis=(0, 1)) for way in (1, -1))
        near = (np.abs(first) < 0.15 * camera.size) & (np.abs(second) < 0.15 * camera.size)
        total += np.where(near, np.clip((first + second) / (0.01 * camera.size), 0, 1), 0)
    return total / 12


def _background(camera, shape, shadows):
    """(h, w, 3) linear RGB of a pale floor, with the shadow of the cloth, and of the backdrop behind it."""
    rays = camera.rays(shape)
    height = np.linspace(0, 1, shape[0])[:, None, None]
    backdrop = (1 - height) * np.array([0.955, 0.965, 0.975]) + height * np.array([0.86, 0.875, 0.89])
    image = np.broadcast_to(backdrop, (*shape, 3)).copy()
    distance = (camera.floor - camera.eye[2]) / np.where(rays[..., 2] < -1e-6, rays[..., 2], np.inf)
    hit = (distance > 0) & (distance < 9 * camera.size)
    points = camera.eye + distance[hit][:, None] * rays[hit]
    lit = shadows.light(points, bias=0.0, radius=14, taps=9)
    fade = np.clip(1 - (distance[hit] / camera.size - 3.0) / 4.0, 0, 1)
    image[hit] *= (1 - 0.34 * fade * (1 - lit))[:, None]
    return image


def _shade(positions, triangles, colours, camera, xy, nearness, owner, shadows, mesh_lines, cloth):
    """(n, 3) linear RGB of the n pixels with an owner. The first `cloth` triangles are cloth."""
    rows, columns = np.nonzero(owner >= 0)
    t = owner[rows, columns]
    corners = triangles[t]
    flat = _barycentric(xy[corners], np.stack([columns + 0.5, rows + 0.5], axis=1))
    weight = flat * nearness[corners]
    weight /= weight.sum(axis=1, keepdims=True)
    point = np.einsum("ni,nic->nc", weight, positions[corners])
    a, b, c = (positions[triangles[:, i]] for i in range(3))
    faces = np.cross(b - a, c - a)  # normals of triangles, as long as twice their areas
    normals = _unit(np.stack([np.bincount(triangles.ravel(), np.repeat(part, 3), len(positions))
                              for part in faces.T], axis=1))  # of vertices
    normal = _unit(np.einsum("ni,nic->nc", weight, normals[corners]))
    towards_eye = _unit(camera.eye - point)
    # The flat normal decides which side is visible; the smooth normal may point away near an outline.
    back = (faces[t] * towards_eye).sum(1) < 0
    normal *= np.where(back, -1.0, 1.0)[:, None]

    shadow = shadows.light(point + 0.006 * camera.size * normal, bias=0.004, radius=1.5, taps=4)
    facing = normal @ LIGHT
    direct = np.clip((facing + 0.12) / 1.12, 0, 1) * (0.25 + 0.75 * shadow)
    through = 0.22 * np.clip(-facing, 0, 1) * (t < cloth)  # thin cloth lets some light through
    ambient = 0.34 + 0.10 * normal[:, 2] + 0.12 * (normal * towards_eye).sum(1)
    halfway = _unit(LIGHT + towards_eye)
    gloss = 0.10 * shadow * np.clip((normal * halfway).sum(1), 0, 1) ** 24

    base = np.asarray(colours)[t] ** 2.2
    base = np.where((back & (t < cloth))[:, None], base * BACK, base)
    if mesh_lines:
        base = base * (1 - _mesh_lines(xy, triangles, t, flat) * (t < cloth))[:, None]
    return base * (ambient + 0.78 * direct + through)[:, None] + gloss[:, None]


def _barycentric(corners, point):
    """(n, 3) barycentric coordinates of points (n, 2) in triangles (n, 3, 2) on the screen."""
    a, b, c = corners.transpose(1, 0, 2)
    cross = lambda u, v: u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]
    area = cross(b - a, c - a)
    area = np.where(np.abs(area) < 1e-12, 1e-12, area)
    of_b, of_c = cross(point - a, c - a) / area, cross(b - a, point - a) / area
    weight = np.clip(np.stack([1 - of_b - of_c, of_b, of_c], axis=1), 0, 1)
    return weight / np.maximum(weight.sum(axis=1, keepdims=True), 1e-12)


def _mesh_lines(xy, triangles, t, flat):
    """(n) how much the lines of the mesh darken each pixel. There are no lines where triangles are tiny."""
    corners = xy[triangles]
    # Lengths of the edges opposite to the corners.
    edges = np.linalg.norm(np.roll(corners, -1, axis=1) - np.roll(corners, 1, axis=1), axis=2)
    a, b = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    area = np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])
    heights = area[:, None] / np.maximum(edges, 1e-9)
    distance = (flat * heights[t]).min(axis=1) / SUPERSAMPLE  # pixels
    strength = np.clip((np.sqrt(area[t]) / SUPERSAMPLE - 4) / 14, 0, 1)
    return 0.30 * strength * np.clip(1.1 - distance, 0, 1)
