"""Tests whether Blender reads the files of `bendlab export`: compares each vertex of each frame with the run.

    blender.py PROGRAM [CONFIG]      exit 1 if a vertex differs, 77 if Blender is not installed

Reads OBJ and PLY files, the PC2 cache of a mesh cache modifier, and USD if Blender was built with it. CONFIG,
with one run and z up, replaces the small default scene.
"""
import json
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
from exported import Run, flat_texture

MISSING = 77
SCENE = {"name": "scene", "duration": 0.5, "allow": ["implausible"],
         "mesh": {"generator": "grid", "width": 1, "height": 0.8, "cells": 12, "diagonal": "alternating"},
         "pins": {"vertices": ["upper_left"], "ring": 0},
         "effects": [{"type": "gravity", "acceleration": [0, 0, -9.81]},
                     {"type": "sphere", "centre": [0, 0, -0.35], "radius": 0.25, "velocity": [0.3, 0, 0]}]}


def export(program, folder):
    """Runs the config in `folder`, exports the run, and returns it."""
    def command(*arguments):
        subprocess.run([program, *map(str, arguments)], cwd=folder, check=True, stdout=subprocess.DEVNULL)

    command("run", "scene.json")
    file, = folder.glob("results/**/run.vtkhdf")
    for name in ("obj", "ply", "pc2", "usda"):
        command("export", file, "--format", name, "--to", name)
    command("export", file, "--format", "obj", "--to", "up", "--up", "y")
    return Run(file)


def farthest(folder, name, expected):
    """The largest difference of a coordinate between Blender and the run, in m; inf if the sizes differ."""
    read = np.fromfile(folder / f"{name}.f32", np.float32)
    if read.size != expected.size:
        return np.inf
    return np.abs(read.reshape(expected.shape).astype(float) - expected).max()


def main(program, config=None):
    if not (blender := shutil.which("blender")):
        print("blender is not installed: its import of exported files was not tested")
        return MISSING
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        text = Path(config).read_text(encoding="utf-8") if config else json.dumps(SCENE)
        (folder / "scene.json").write_text(text, encoding="utf-8")
        run = export(Path(program).resolve(), folder)
        inside = Path(__file__).with_name("in_blender.py")
        command = [blender, "--background", "--factory-startup", "--python-exit-code", "3",
                   "--python", inside, "--", folder, str(len(run.times))]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode != 0 or not (folder / "read.json").exists():
            print(done.stdout[-2000:], done.stderr[-2000:])
            return 1
        report = json.loads((folder / "read.json").read_text(encoding="utf-8"))
        size = np.ptp(run.points[0], axis=0).max()
        # By default, Blender rotates imported vertices by a matrix in single precision.
        expected = {name: (run.points, 0) for name in ("obj", "ply", "pc2", "usda")}
        x, y, z = np.moveaxis(run.points[:1], -1, 0)
        expected |= {"up": (run.points, 1e-6 * size), "default": (np.stack([x, -z, y], axis=-1), 1e-6 * size)}
        wrong = 0
        for name in report["read"]:
            off = farthest(folder, name, expected[name][0])
            wrong += not off <= expected[name][1]
            frames = len(expected[name][0])
            print(f"Blender {report['version']}, {name}: off by at most {off:.3g} m, frames: {frames}")
        if not config:
            off = farthest(folder, "texture", flat_texture(run)[run.triangles].astype(np.float32))
            wrong += not off < 1e-6
            print(f"Blender {report['version']}, texture coordinates: off by at most {off:.3g}")
        if "usda" not in report["read"]:
            print("this Blender is built without USD")
        return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
