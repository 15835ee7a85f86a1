"""Imports exported files into Blender, and writes the vertices that Blender then has. blender.py runs this.

    blender --background --factory-startup --python in_blender.py -- FOLDER FRAMES

FOLDER has obj/, ply/, pc2/, usda/ and up/ (obj with y up). For each folder, NAME.f32 gets the coordinates of
the cloth in world space: float32, frame after frame. read.json lists these names and Blender's version.
"""
import json
import sys
from pathlib import Path

import bpy
import numpy as np


def fresh():
    bpy.ops.wm.read_factory_settings(use_empty=True)


def only_new():
    """The object that an importer made."""
    meshes = [thing for thing in bpy.data.objects if thing.type == "MESH"]
    assert len(meshes) == 1, meshes
    return meshes[0]


def world(thing):
    """(V, 3) vertices as Blender draws them: with the modifiers and the matrix of the object."""
    evaluated = thing.evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = evaluated.to_mesh()
    points = np.empty(3 * len(mesh.vertices), np.float32)
    mesh.vertices.foreach_get("co", points)
    evaluated.to_mesh_clear()
    matrix = np.array(evaluated.matrix_world)
    points = points.reshape(-1, 3)
    if np.array_equal(matrix, np.eye(4)):
        return points
    return (points.astype(float) @ matrix[:3, :3].T + matrix[:3, 3]).astype(np.float32)


def import_obj(file, **axes):
    fresh()
    bpy.ops.wm.obj_import(filepath=str(file), **axes)
    return only_new()


def import_ply(file):
    fresh()
    if "ply_import" in dir(bpy.ops.wm):  # Blender 3.6 and later
        bpy.ops.wm.ply_import(filepath=str(file))
    else:
        bpy.ops.preferences.addon_enable(module="io_mesh_ply")
        bpy.ops.import_mesh.ply(filepath=str(file))
    return only_new()


def at_frames(thing, count):
    for frame in range(count):
        bpy.context.scene.frame_set(frame)
        yield world(thing)


def pc2(folder, count):
    cloth = import_obj(folder / "pc2" / "cloth.obj", forward_axis="Y", up_axis="Z")
    cache = cloth.modifiers.new("cache", "MESH_CACHE")
    cache.cache_format, cache.filepath = "PC2", str(folder / "pc2" / "cloth.pc2")
    cache.interpolation = "NONE"
    return at_frames(cloth, count)


def usda(folder, count):
    fresh()
    bpy.ops.wm.usd_import(filepath=str(folder / "usda" / "cloth.usda"))
    return at_frames(bpy.data.objects["cloth"], count)


def sequence(folder, suffix, count):
    return [folder / f"cloth.{frame:04}{suffix}" for frame in range(count)]


def main(folder, count):
    as_it_is = {"forward_axis": "Y", "up_axis": "Z"}
    obj, up = sequence(folder / "obj", ".obj", count), sequence(folder / "up", ".obj", count)
    ply = sequence(folder / "ply", ".ply", count)
    reads = {
        "obj": lambda: [world(import_obj(file, **as_it_is)) for file in obj],
        "ply": lambda: [world(import_ply(file)) for file in ply],
        "pc2": lambda: pc2(folder, count),
        "default": lambda: [world(import_obj(obj[0]))],
        "up": lambda: [world(import_obj(file)) for file in up],
    }
    if bpy.app.build_options.usd:
        reads["usda"] = lambda: usda(folder, count)
    for name, read in reads.items():
        np.stack(list(read())).tofile(folder / f"{name}.f32")
    texture = import_obj(obj[0], **as_it_is).data.uv_layers.active.data
    coordinates = np.empty(2 * len(texture), np.float32)
    texture.foreach_get("uv", coordinates)
    coordinates.tofile(folder / "texture.f32")
    report = {"version": bpy.app.version_string, "read": list(reads)}
    (folder / "read.json").write_text(json.dumps(report), encoding="utf-8")


if __name__ == "__main__":
    main(Path(sys.argv[-2]), int(sys.argv[-1]))
