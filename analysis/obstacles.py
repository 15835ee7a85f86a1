"""Obstacles of a scene: surfaces as triangles, and the distance of cloth from them. Lengths in m."""
from pathlib import Path

import numpy as np

AROUND = 96  # points on a circle
KINDS = ("plane", "sphere", "capsule", "disc", "mesh_obstacle")


def obstacles_of(config):
    """The obstacles among a resolved config's effects."""
    return [effect for effect in config.get("effects", []) if effect["type"] in KINDS]


def surfaces(config, time, size, folder="."):
    """(P, 3) points and (T, 3) triangles of all obstacles of a resolved config at a time in s. A plane is a
    square of side `size`; mesh files are relative to `folder`. Level planes are left out: they are the floor
    (floor_of)."""
    points, triangles = [np.empty((0, 3))], [np.empty((0, 3), int)]
    for effect in obstacles_of(config):
        if not _level(effect):
            p, t = _surface(effect, size, Path(folder))
            triangles.append(t + sum(map(len, points)))
            points.append(p + time * np.array(effect["velocity"], float))
    return np.concatenate(points), np.concatenate(triangles)


def clearance(config, time, points, folder="."):
    """Smallest distance of points (n, 3) from the obstacles at a time in s; negative inside, inf without
    obstacles. Mesh files are relative to `folder`; an open mesh has no inside."""
    distances = [_distance(effect, points - time * np.array(effect["velocity"], float), Path(folder)).min()
                 for effect in obstacles_of(config)]
    return float(min(distances, default=np.inf))


def _distance(effect, points, folder):
    kind, vector = effect["type"], lambda name: np.array(effect[name], float)
    if kind == "mesh_obstacle":
        return _off_mesh(points, *_surface(effect, None, folder))
    if kind == "plane":
        return (points - vector("point")) @ _frame(vector("normal"))[2]
    if kind == "disc":
        relative, axis = points - vector("centre"), _frame(vector("axis"))[2]
        up = relative @ axis
        outward = np.linalg.norm(relative - up[:, None] * axis,
                                 axis=1) - (effect["radius"] - effect["height"] / 2)
        return np.hypot(np.maximum(outward, 0), up) - effect["height"] / 2
    a, b = (vector("a"), vector("b")) if kind == "capsule" else (vector("centre"), vector("centre"))
    along = np.clip((points - a) @ (b - a) / max((b - a) @ (b - a), 1e-300), 0, 1)
    return np.linalg.norm(points - a - along[:, None] * (b - a), axis=1) - effect["radius"]


def _off_mesh(points, corners, triangles):
    """Smallest distance of points (n, 3) from a mesh; minus the depth of the deepest if inside."""
    points, faces = points[np.argsort(points[:, 0])], corners[triangles]
    within = points[_within(points, faces)] if _is_closed(triangles) else points[:0]
    if len(within):
        return -np.min([_from_triangle(within, face) for face in faces], axis=0).max()
    least = np.inf
    for face in faces:  # points farther than the nearest so far are skipped
        near = _in_box(points, face.min(axis=0) - least, face.max(axis=0) + least)
        if len(near):
            least = min(least, _from_triangle(points[near], face).min())
    return np.float64(least)


def _in_box(points, low, high):
    """Indices of points (n, 3) in a box; the points are sorted by x."""
    first, last = np.searchsorted(points[:, 0], (low[0], high[0]))
    y, z = points[first:last, 1], points[first:last, 2]
    return first + np.flatnonzero((y >= low[1]) & (y <= high[1]) & (z >= low[2]) & (z <= high[2]))


def _is_closed(triangles):
    """Whether each edge has two triangles."""
    edges = np.sort(np.stack([triangles, np.roll(triangles, -1, axis=1)], axis=-1).reshape(-1, 2), axis=1)
    return bool((np.unique(edges, axis=0, return_counts=True)[1] == 2).all())


def _from_triangle(points, corners):
    """(n) distances of points (n, 3) from a triangle (3, 3)."""
    sides = np.roll(corners, -1, axis=0) - corners
    normal = np.cross(sides[0], sides[1])
    relative = points[:, None] - corners
    over = (np.einsum("nij,ij->ni", relative, np.cross(sides, normal)) < 0).all(axis=1)
    along = np.clip(np.einsum("nij,ij->ni", relative, sides) / np.maximum((sides**2).sum(axis=1), 1e-300), 0,
                    1)
    beside = np.linalg.norm(relative - along[..., None] * sides, axis=2).min(axis=1)
    return np.where(over, np.abs(relative[:, 0] @ normal) / max(np.linalg.norm(normal), 1e-300), beside)


def _within(points, faces):
    """Which points (n, 3), sorted by x, are inside a closed surface: those whose ray upwards crosses it an
    odd number of times."""
    odd, bottom = np.zeros(len(points), bool), faces[..., 2].min()
    for face in faces:
        (left, front, _), (right, back, top) = face.min(axis=0), face.max(axis=0)
        below = _in_box(points, (left, front, bottom), (right, back, top))
        if len(below):
            odd[below] ^= _passes(points[below], face)
    return odd


def _passes(points, face):
    """Whether rays upwards from points (n, 3) meet a triangle. Above a shared edge it meets one."""
    x, y, _ = points.T
    normal = np.cross(face[1] - face[0], face[2] - face[0])
    over = np.zeros(len(points), bool)
    for a, b in ((0, 1), (1, 2), (2, 0)):
        # The same numbers from both sides
        (ax, ay), (bx, by) = sorted([tuple(face[a, :2]), tuple(face[b, :2])])
        if ay != by:
            over ^= ((ay > y) != (by > y)) & (x < ax + (y - ay) * (bx - ax) / (by - ay))
    return over & ((face[0] - points) @ normal * normal[2] > 0)


def floor_of(config):
    """Height of the highest level plane, None if there is none."""
    return max((effect["point"][2] for effect in obstacles_of(config) if _level(effect)), default=None)


def _level(effect):
    return effect["type"] == "plane" and not np.any(effect["normal"][:2]) and effect["normal"][2] > 0


def _surface(effect, size, folder):
    kind, vector = effect["type"], lambda name: np.array(effect[name], float)
    if kind == "sphere":
        return _revolved(_arc(effect["radius"], -90, 90), vector("centre"), np.array([0, 0, 1.0]))
    if kind == "capsule":
        length = np.linalg.norm(vector("b") - vector("a"))
        profile = np.concatenate([_arc(effect["radius"], -90, 0),
                                  _arc(effect["radius"], 0, 90) + [0, length]])
        return _revolved(profile, vector("a"), vector("b") - vector("a") if length else np.array([0, 0, 1.0]))
    if kind == "disc":
        edge = _arc(effect["height"] / 2, -90, 90) + [effect["radius"] - effect["height"] / 2, 0]
        profile = np.concatenate([[[0, edge[0, 1]]], edge, [[0, edge[-1, 1]]]])
        return _revolved(profile, vector("centre"), vector("axis"))
    if kind == "plane":
        right, forward, _ = _frame(vector("normal"))
        corners = [vector("point") + size / 2 * (x * right + y * forward)
                   for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
        return np.array(corners), np.array([[0, 1, 2], [0, 2, 3]])
    points, triangles = read_obj(folder / effect["file"])
    return effect["scale"] * points + vector("offset"), triangles


def _arc(radius, first, last):
    """(n, 2) distance from the axis and height along an arc of `radius`, angles in degrees."""
    angles = np.radians(np.linspace(first, last, 1 + int(abs(last - first) / 4)))
    return radius * np.stack([np.cos(angles), np.sin(angles)], axis=1)


def _frame(axis):
    """Two unit vectors perpendicular to an axis, and the axis as a unit vector."""
    axis = axis / np.linalg.norm(axis)
    right = np.cross([0.0, 1.0, 0.0] if abs(axis[1]) < 0.9 else [1.0, 0.0, 0.0], axis)
    right /= np.linalg.norm(right)
    return right, np.cross(axis, right), axis


def _revolved(profile, origin, axis):
    """Surface of revolution of a profile (n, 2): distances from an axis, heights along it. Normals point
    outward where the profile goes up."""
    right, forward, up = _frame(axis)
    angles = 2 * np.pi * np.arange(AROUND) / AROUND
    circle = np.cos(angles)[:, None] * right + np.sin(angles)[:, None] * forward
    points = origin + profile[:, None, :1] * circle + profile[:, None, 1:] * up
    at = np.arange(len(profile) - 1)[:, None] * AROUND + np.arange(AROUND)
    beside = np.arange(len(profile) - 1)[:, None] * AROUND + (np.arange(AROUND) + 1) % AROUND
    quads = np.stack([at, beside, beside + AROUND, at + AROUND], axis=-1).reshape(-1, 4)
    return points.reshape(-1, 3), np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])


def read_obj(path):
    """Points and triangles of a Wavefront OBJ file; polygons become fans. ValueError for other files."""
    if path.suffix.lower() != ".obj":
        raise ValueError(f"{path}: obstacles are drawn from .obj files only; convert the mesh to OBJ")
    points, triangles = [], []
    for line in path.read_text(encoding="utf-8").splitlines():
        kind, *words = line.split() or [""]
        if kind == "v":
            points.append([float(word) for word in words[:3]])
        if kind == "f":
            corners = [int(word.split("/")[0]) for word in words]
            corners = [c - 1 if c > 0 else len(points) + c for c in corners]
            triangles += [[corners[0], b, c] for b, c in zip(corners[1:], corners[2:])]
    return np.array(points, float).reshape(-1, 3), np.array(triangles, int).reshape(-1, 3)
