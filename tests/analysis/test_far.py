"""Runs far from the origin: the single-precision positions in a page have the edge lengths of the mesh."""
import sys
import tempfile
import unittest
import zlib
from pathlib import Path

import h5py
import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "analysis"))

from bendlab.results import checksum  # noqa: E402
from draw import frames  # noqa: E402
from bendlab.results import load  # noqa: E402
from made_up_runs import facts  # noqa: E402

CELLS = 64
FLOOR = {"type": "plane", "point": [0, 0, 317.0], "normal": [0, 0, 1.0], "velocity": [0, 0, 0]}


def grid(place):
    """Vertices (V, 3) and triangles (T, 3) of a square of 1 m around a place."""
    x = np.linspace(-0.5, 0.5, CELLS + 1)
    rest = np.array([[a, b, 0] for b in x for a in x]) + place
    corner = np.array([i + j * (CELLS + 1) for j in range(CELLS) for i in range(CELLS)])
    right, up, both = corner + 1, corner + CELLS + 1, corner + CELLS + 2
    return rest, np.concatenate([np.stack([corner, right, both], 1), np.stack([corner, both, up], 1)])


def edges(points, triangles):
    return np.linalg.norm(points[triangles] - points[np.roll(triangles, -1, axis=1)], axis=2)


def floats(packed, name):
    """(rows, columns) of a section of floats. It is stored in byte planes: first the first byte of each."""
    at = packed.head["sections"][name]
    planes = zlib.decompress(packed.data[at["offset"]:at["offset"] + at["size"]])
    rows = np.frombuffer(planes, "u1").reshape(at["columns"], 4, at["rows"])
    return np.ascontiguousarray(rows.transpose(2, 0, 1)).view("<f4").reshape(at["rows"], at["columns"])


class Far(unittest.TestCase):
    def run_at(self, place):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        path = Path(folder.name) / "run.vtkhdf"
        rest, triangles = grid(np.array(place, float))
        with h5py.File(path, "w") as file:
            file["facts"] = facts({"mesh": {"cells": CELLS}, "effects": [FLOOR]})
            file["VTKHDF/Points"] = np.concatenate([rest, rest - [0, 0, 0.5]])
            file["rest/positions"], file["rest/triangles"] = rest, triangles.astype("i4")
            file["rest/pinned"] = np.zeros(len(rest), "u1")
            file["rest/pin_seeds"] = np.zeros(0, "i4")
            file["metrics/values"] = np.arange(2)[:, None] / 10
        checksum.seal(path)
        return load.load_run(path)

    def test_a_page_has_the_edges_and_heights_above_the_floor(self):
        for place in ([1e6, 0, 318], [450123.75, 5412345.5, 318.25], [-1e7, 1e7, 1e7]):
            run = self.run_at(place)
            packed = frames.pack(run)
            rest, triangles = run.rest_positions, run.triangles
            # Half a unit in the last place of a float at half a metre is 3e-8 m; an edge is 1/64 m.
            np.testing.assert_allclose(edges(floats(packed, "rest").astype(float), triangles),
                                       edges(rest, triangles), rtol=1e-5)
            head = packed.head
            self.assertLess(np.abs(head["box"]).max(), 2)
            self.assertAlmostEqual(head["box"][0][2] - head["floor"], place[2] - 0.5 - 317, places=6)
            self.assertTrue(any("relative to" in note for note in head["notes"]), head["notes"])

    def test_near_the_origin_a_page_has_the_original_coordinates(self):
        run = self.run_at([3, -2, 18])
        packed = frames.pack(run)
        np.testing.assert_array_equal(floats(packed, "rest"), run.rest_positions.astype("f4"))
        self.assertEqual((packed.head["notes"], packed.head["floor"]), ([], 317))

    def test_the_origin_has_round_coordinates(self):
        rest, triangles = grid(np.array([450123.3, -5412345.4, 250]))
        np.testing.assert_array_equal(frames.origin_of(rest, triangles), [450123, -5412345, 250])
        np.testing.assert_array_equal(frames.origin_of(1e-3 * rest, triangles), [450.123, -5412.345, 0.25])


if __name__ == "__main__":
    unittest.main()
