"""Compares the rest edges of a run with the edges of its first frame, in the run file and in its exports.

    edges.py RUN TOLERANCE FILES...     exit 1 if an edge length is off by more than the share TOLERANCE

FILES were written by `bendlab export`: PLY, OBJ, PC2 or USD. The first frame of the run has to be its rest
shape. The readers are independent of the program. Positions relative to an origin are first moved by it.
"""
import re
import sys
from pathlib import Path

import numpy as np
import usda
from exported import Run, read_obj, read_pc2, read_ply

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "analysis"))
from bendlab.results.load import load_run  # noqa: E402


def stated_origin(path):
    """(3) the origin in a comment of an OBJ file, which has to be added to its positions."""
    match = re.search(r"^# origin (\S+) (\S+) (\S+):", path.read_text(encoding="ascii"), re.MULTILINE)
    return np.array([float(number) for number in match.groups()]) if match else np.zeros(3)


def usda_points(path):
    layer, prims = usda.read_stage(path)
    prim = prims[layer["defaultPrim"]]
    place = prim["properties"].get("xformOp:translate", {"value": (0, 0, 0)})["value"]
    cloth = prim["children"]["cloth"]["properties"]["points.timeSamples"]["value"]
    return np.array(next(iter(cloth.values())), np.float32) + np.array(place, float)


READERS = {".obj": lambda path: read_obj(path)[0] + stated_origin(path),
           ".ply": lambda path: read_ply(path)[0].astype(float),
           ".pc2": lambda path: read_pc2(path)[2][0] + stated_origin(path.with_suffix(".obj")),
           ".usda": usda_points}


def main(run_file, tolerance, *files):
    run = load_run(run_file)
    rest, triangles = run.rest_positions, run.triangles
    lengths = lambda points: np.linalg.norm(  # noqa: E731
        points[triangles] - points[np.roll(triangles, -1, axis=1)], axis=2)
    frames = {"analysis/load.py": run.positions(0), "h5py": Run(run_file).points[0].astype(float)}
    frames.update({name: READERS[Path(name).suffix](Path(name)) for name in files})
    wrong = 0
    for name, points in frames.items():
        off = np.abs(lengths(points) / lengths(rest) - 1).max()
        away = np.abs(points - rest).max() / np.ptp(rest, axis=0).max()
        if not max(off, away) <= float(tolerance):
            wrong += 1
            print(f"{name}: an edge is off by {off:.3g} of its length, a vertex by {away:.3g} of the size")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
