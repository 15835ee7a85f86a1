"""Obstacles of a scene: surfaces as triangles, and the distance of cloth from them. Lengths in m."""
import numpy as np


def surfaces(run, time):
    """(P, 3) points and (T, 3) triangles of all obstacles of a run at a time in s. Horizontal planes are left
    out, because the highest of them is drawn as the floor (floor_of)."""
    points, triangles = [np.empty((0, 3))], [np.empty((0, 3), int)]
    for at_start, corners, velocity in drawn(run).values():
        triangles.append(corners + sum(map(len, points)))
        points.append(at_start + time * velocity)
    return np.concatenate(points), np.concatenate(triangles)


def drawn(run):
    """run.obstacles without horizontal planes."""
    effects = run.get("/effects", [])
    return {index: surface for index, surface in run.obstacles.items() if not _level(effects[index])}


def are_unknown(run):
    """Whether a run's file, from an older program, lacks the surfaces of the run's obstacles."""
    return not run.obstacles and any({"velocity", "thickness"} <= effect.keys() and not _level(effect)
                                     for effect in run.get("/effects", []))


def clearance(run, time, points):
    """Smallest distance of points (n, 3) from a run's obstacles at a time in s; negative inside, inf without
    obstacles. An open mesh has no inside."""
    least = np.inf
    for index, effect in enumerate(run.get("/effects", [])):
        if effect["type"] in DISTANCES:
            distances = DISTANCES[effect["type"]](effect, points - time * np.array(effect["velocity"], float))
            least = min(least, distances.min())
        elif index in run.obstacles:
            at_start, corners, velocity = run.obstacles[index]
            least = min(least, _off_mesh(points - time * velocity, at_start, corners))
    return float(least)


def _off_plane(plane, points):
    return (points - plane["point"]) @ plane["normal"] / np.linalg.norm(plane["normal"])


def _off_disc(disc, points):
    axis = disc["axis"] / np.linalg.norm(disc["axis"])
    relative = points - disc["centre"]
    up = relative @ axis
    outward = np.linalg.norm(relative - up[:, None] * axis, axis=1) - (disc["radius"] - disc["height"] / 2)
    return np.hypot(np.maximum(outward, 0), up) - disc["height"] / 2


def _off_sphere(sphere, points):
    return np.linalg.norm(points - sphere["centre"], axis=1) - sphere["radius"]


def _off_capsule(capsule, points):
    axis, relative = np.subtract(capsule["b"], capsule["a"]), points - capsule["a"]
    along = np.clip(relative @ axis / max(axis @ axis, 1e-300), 0, 1)
    return np.linalg.norm(relative - along[:, None] * axis, axis=1) - capsule["radius"]


# Shapes with a formula for the distance. For other obstacles, the distance is measured from the surface.
DISTANCES = {"plane": _off_plane, "sphere": _off_sphere, "capsule": _off_capsule, "disc": _off_disc}


def _off_mesh(points, corners, triangles):
    """Smallest distance of points (n, 3) from a mesh; if points are inside, minus the largest depth."""
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
    near = points[first:last, 1:]
    return first + np.flatnonzero(((near >= low[1:]) & (near <= high[1:])).all(axis=1))


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
    along = np.einsum("nij,ij->ni", relative, sides) / np.maximum((sides**2).sum(axis=1), 1e-300)
    along = np.clip(along, 0, 1)
    beside = np.linalg.norm(relative - along[..., None] * sides, axis=2).min(axis=1)
    return np.where(over, np.abs(relative[:, 0] @ normal) / max(np.linalg.norm(normal), 1e-300), beside)


def _within(points, faces):
    """Whether each of the points (n, 3), sorted by x, is inside a closed surface: a ray upwards from the
    point crosses the surface an odd number of times."""
    odd, bottom = np.zeros(len(points), bool), faces[..., 2].min()
    for face in faces:
        below = _in_box(points, np.array([*face.min(axis=0)[:2], bottom]), face.max(axis=0))
        odd[below] ^= _passes(points[below], face)
    return odd


def _passes(points, face):
    """Whether rays upwards from points (n, 3) cross a triangle. A ray through an edge crosses exactly one of
    the edge's two triangles."""
    x, y, _ = points.T
    normal = np.cross(face[1] - face[0], face[2] - face[0])
    over = np.zeros(len(points), bool)
    for a, b in ((0, 1), (1, 2), (2, 0)):
        # Sorted, so that both triangles of an edge compute the same numbers
        (ax, ay), (bx, by) = sorted([tuple(face[a, :2]), tuple(face[b, :2])])
        if ay != by:
            over ^= ((ay > y) != (by > y)) & (x < ax + (y - ay) * (bx - ax) / (by - ay))
    return over & ((face[0] - points) @ normal * normal[2] > 0)


def floor_of(config):
    """Height of the highest horizontal plane, or None."""
    return max((effect["point"][2] for effect in config.get("effects", []) if _level(effect)), default=None)


def _level(effect):
    return effect["type"] == "plane" and not np.any(effect["normal"][:2]) and effect["normal"][2] > 0
