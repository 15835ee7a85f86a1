"""Tests of where a cloth is stretched: σ₁ of known deformations, distances, and a whole run."""
import sys
import tempfile
import unittest
from pathlib import Path
from types import SimpleNamespace
from unittest import mock

import h5py
import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "analysis"))

from bendlab.results import checksum, load  # noqa: E402
from figures.paper import where  # noqa: E402
from made_up_runs import facts  # noqa: E402
from runs import stretch  # noqa: E402

ROUNDING = 1e-14  # relative error after a few operations in double precision
TURN = np.linalg.qr(np.random.default_rng(7).normal(size=(3, 3)))[0]  # a random rotation or reflection


def grid(cells, size=1.0):
    """Vertices (V, 3) and triangles (T, 3) of a square of `size` in cells × cells, split along a diagonal."""
    x = np.linspace(0, size, cells + 1)
    rest = np.array([[a, b, 0] for b in x for a in x])
    corner = np.array([i + j * (cells + 1) for j in range(cells) for i in range(cells)])
    right, up, both = corner + 1, corner + cells + 1, corner + cells + 2
    return rest, np.concatenate([np.stack([corner, right, both], 1), np.stack([corner, both, up], 1)])


def by_svd(rest, positions, triangles):
    """σ₁ (T) by NumPy's singular values. The rest shape lies in the plane z = 0."""
    edges = lambda x: np.stack([x[triangles[:, i]] - x[triangles[:, 0]] for i in (1, 2)], axis=2)
    gradient = edges(positions) @ np.linalg.inv(edges(rest)[:, :2])
    return np.linalg.svd(gradient, compute_uv=False)[:, 0]


class PrincipalStretch(unittest.TestCase):
    rest, triangles = grid(5)

    def test_a_uniform_stretch_is_the_same_in_every_triangle(self):
        for factor in (1, 1.7, 40):
            sigma = stretch.principal_stretches(self.rest, self.rest * [factor, 1, 1], self.triangles)[0]
            np.testing.assert_allclose(sigma - 1, factor - 1, rtol=0, atol=ROUNDING * factor)

    def test_the_stretch_of_a_compressed_cloth_is_below_1(self):
        sigma = stretch.principal_stretches(self.rest, self.rest * [0.25, 0.5, 1], self.triangles)[0]
        np.testing.assert_allclose(sigma, 0.5, rtol=ROUNDING)

    def test_simple_shear(self):
        # x += g y: σ₁ − 1/σ₁ = g, so that σ₁ = (g + √(g² + 4)) / 2
        for g in (0.1, 1, 30):
            sheared = self.rest @ np.array([[1, 0, 0], [g, 1, 0], [0, 0, 1]])
            sigma = stretch.principal_stretches(self.rest, sheared, self.triangles)[0]
            np.testing.assert_allclose(sigma, (g + np.sqrt(g * g + 4)) / 2, rtol=10 * ROUNDING)

    def test_a_rotation_of_the_rest_shape_or_of_the_cloth_changes_nothing(self):
        cloth = self.rest @ np.array([[1.2, 0.3, 0], [-0.4, 0.8, 0.5], [0, 0, 1]])
        expected = by_svd(self.rest, cloth, self.triangles)
        for rest, positions in ((self.rest @ TURN, cloth), (self.rest, cloth @ TURN),
                                (self.rest @ TURN + 3, cloth @ TURN.T - 5)):
            sigma = stretch.principal_stretches(rest, positions, self.triangles)[0]
            np.testing.assert_allclose(sigma, expected, rtol=100 * ROUNDING)  # the shift by 3 costs digits

    def test_several_frames_and_other_units(self):
        frames = np.stack([self.rest, self.rest * [2, 3, 1]])
        for metre in (1, 1000):
            sigma = stretch.principal_stretches(self.rest * metre, frames * metre, self.triangles)[0]
            np.testing.assert_allclose(sigma, np.outer([1, 3], np.ones(50)), rtol=ROUNDING)

    def test_a_triangle_without_area_at_rest_has_no_stretch(self):
        rest = np.array([[0, 0, 0], [1, 0, 0], [3, 0, 0], [0, 1, 0]], float)
        sigma = stretch.principal_stretches(rest, rest, np.array([[0, 1, 2], [0, 1, 3], [1, 1, 3]]))[0]
        np.testing.assert_array_equal(np.isnan(sigma), [True, False, True])


class Distance(unittest.TestCase):
    def test_the_distance_is_from_the_nearest_pin(self):
        rest = np.array([[0, 0, 0], [3, 0, 0], [0, 3, 0], [9, 0, 0], [12, 0, 0], [9, 3, 0]], float)
        triangles = np.array([[0, 1, 2], [3, 4, 5]])  # centroids (1, 1) and (10, 1)
        pinned = np.array([1, 0, 0, 0, 0, 1], bool)  # (0, 0) and (9, 3)
        np.testing.assert_allclose(stretch.distance_from_pins(rest, triangles, pinned),
                                   [np.sqrt(2), np.sqrt(5)], rtol=ROUNDING)
        self.assertTrue(np.isinf(stretch.distance_from_pins(rest, triangles, np.zeros(6, bool))).all())

    def test_bins_contain_every_distance_and_agree_between_meshes(self):
        fine, coarse = stretch.bin_edges(0.0037, 1.41), stretch.bin_edges(0.0295, 1.4)
        self.assertLessEqual(fine[0], 0.0037)
        self.assertGreater(fine[-1], 1.41)
        self.assertLessEqual(set(coarse), set(fine))


class WholeRun(unittest.TestCase):
    """A sheet of 8² cells that hangs from a corner and is torn three cells away from this corner."""

    cells, frames = 8, 16

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.rest, self.triangles = grid(self.cells)
        self.trajectory = self.positions().astype("f4")
        self.sigma = np.array([by_svd(self.rest, x.astype(float), self.triangles) for x in self.trajectory])
        self.run = load.load_run(self.written(Path(folder.name) / "run.vtkhdf"))

    def positions(self):
        """Frames (F, V, 3): random edges that are a few percent too long, and a vertex that is pulled out."""
        noise = np.random.default_rng(3).normal(scale=0.05 / self.cells,
                                                size=(self.frames, len(self.rest), 3))
        frames = self.rest @ TURN + noise
        torn = np.flatnonzero((np.abs(self.rest - [5 / 8, 5 / 8, 0]) < 1e-9).all(axis=1))
        frames[:, torn] += np.array([0, 0, 0.4]) * np.linspace(1, 2, self.frames)[:, None, None]
        return frames

    def written(self, path):
        pinned = np.zeros(len(self.rest), bool)
        pinned[-1] = True
        with h5py.File(path, "w") as file:
            file["facts"] = facts({"mesh": {"cells": self.cells, "width": 1}}, ("time", "max_stretch"))
            file["VTKHDF/Points"] = self.trajectory.reshape(-1, 3)
            file["rest/positions"], file["rest/triangles"] = self.rest, self.triangles.astype("i4")
            file["rest/pinned"] = pinned.astype("u1")
            # The run takes 1.5 s, so the last second is frames 6 … 15.
            file["metrics/values"] = np.stack([np.arange(self.frames) / 10, self.sigma.max(axis=1)], axis=1)
        checksum.seal(path)
        return path

    def test_the_largest_stretch_equals_the_metric(self):
        part = stretch.Stretched(self.run)
        self.assertEqual(part.excess.shape, (10, len(self.triangles)))
        self.assertLess(part.disagreement, 1e-13)  # two methods for the same singular value
        self.assertAlmostEqual(part.largest(), np.median(self.sigma[6:].max(axis=1)) - 1, places=12)

    def test_a_disagreement_with_the_metric_is_measured(self):
        self.run.metrics["max_stretch"][7] *= 1.25
        self.assertAlmostEqual(stretch.Stretched(self.run).disagreement, 0.2, places=12)

    def test_the_worst_triangles_are_at_the_tear(self):
        part = stretch.Stretched(self.run)
        # The torn vertex is three cells from the corner in both directions. The centroids of its six
        # triangles are within 0.75 cells of it. It is three edges away along diagonals, so it is in ring 3.
        np.testing.assert_array_less(part.distance[part.worst] * self.cells, 3 * np.sqrt(2) + 0.75)
        np.testing.assert_array_less(3 * np.sqrt(2) - 0.75, part.distance[part.worst] * self.cells)
        self.assertLessEqual(set(part.ring[part.worst]), {3, 4})
        self.assertGreater(part.largest(~part.at_pin), 2)
        self.assertLess(part.largest(part.at_pin), 0.3)

    def test_bins_have_the_maximum_and_the_median_of_their_triangles(self):
        part = stretch.Stretched(self.run)
        edges = stretch.bin_edges(part.distance.min(), part.distance.max())
        for share in (1.0, 0.5):
            for i, value in enumerate(part.over_distance(edges, share)):
                inside = (part.distance >= edges[i]) & (part.distance < edges[i + 1])
                expected = [np.quantile(frame[inside], share) for frame in part.excess] if inside.any() else [
                    np.nan]
                np.testing.assert_allclose(value, np.median(expected), rtol=1e-12)

    def test_ranges_leave_out_a_tenth_at_each_end(self):
        part = SimpleNamespace(distance=np.arange(1.0, 12), worst=np.arange(11), ring=np.arange(11), cell=1,
                               at_pin=np.ones(11, bool), largest=lambda *where: 1.0, disagreement=0,
                               over_distance=lambda edges, *share: edges[1:])
        with mock.patch.object(stretch, "Stretched", lambda run: part):
            group = stretch.Group([self.run])
        np.testing.assert_allclose((*group.range, *group.rings), (2, 10, 1, 9))

    def test_the_chart_and_the_table_of_a_group(self):
        group = stretch.Group([self.run, self.run])
        self.assertEqual((group.near.count, group.status), (2, {"complete": 2}))
        part = stretch.Stretched(self.run)
        edges = stretch.bin_edges(part.distance.min(), part.distance.max())
        np.testing.assert_allclose(group.usual, part.over_distance(edges, 0.9), rtol=1e-12)
        self.assertEqual(max(group.near.median, group.far.median), group.whole.median)
        self.assertAlmostEqual(np.nanmax([s.median for s in group.worst]), group.whole.median, places=12)
        cases = {where.MENDED: {self.cells: group}, where.ADAPTIVE: {self.cells: group}}
        bins = where._bins("bins", cases)
        self.assertEqual({row["case"] for row in bins.rows}, {where.MENDED, where.ADAPTIVE})
        known = [i for i, spread in enumerate(group.worst) if spread.known]
        own = bins.rows[:len(known)]
        self.assertEqual([row["distance"] for row in own], [group.middles[i] for i in known])
        self.assertEqual(max(row["worst"] for row in own), group.whole.median)
        for row in own:
            self.assertLessEqual(row["usual"], row["worst"])
        table = where._table("torn", cases, "Torn")
        self.assertEqual([(row["case"], row["N"]) for row in table.rows],
                         [(where.MENDED, 8), (where.ADAPTIVE, 8)])
        for row in table.rows:
            self.assertLessEqual({column.id for column in table.columns}, set(row))
            self.assertEqual([row[part] for part in ("near", "far", "whole")],
                             [group.near.median, group.far.median, group.whole.median])


class Claims(unittest.TestCase):
    @staticmethod
    def group(n, near, far, ring=1.0, reach=np.nan):
        single = lambda value: load.spread([value])
        group = object.__new__(stretch.Group)  # without runs
        vars(group).update(n=n, cell=1 / n, near=single(near), far=single(far), whole=single(max(near, far)),
                           place=single(ring / n), ring=ring, reach=reach)
        return group

    def verdicts(self, adaptive, crossover=(), further=()):
        by_n = lambda groups: {group.n: group for group in groups}
        return [claim.holds for claim in where._claims(by_n(adaptive), by_n(crossover), list(further))]

    def test_claims_without_runs_are_open(self):
        self.assertEqual(self.verdicts([]), [None, None, None])

    def test_verdicts_on_sound_cloth(self):
        self.assertEqual(self.verdicts([self.group(16, 0.2, 0.1, 1, 3)], [self.group(16, 0.5, 0.3)]),
                         [True, None, True])

    def test_verdicts_on_a_failure_that_moves_away_from_the_pin(self):
        moved = self.group(64, 0.8, 5.5, 6, 5)
        self.assertEqual(self.verdicts([moved], [self.group(64, 4.5, 4.1)]), [False, True, False])
        self.assertEqual(self.verdicts([moved], [self.group(64, 4.5, 6)]), [False, True, True])
        for elsewhere in (self.group(64, 0.8, 2, 7, 5), self.group(64, 0.8, 2, 4, 5),
                          self.group(64, 3, 2, 6, 5)):
            self.assertFalse(self.verdicts([moved], [], [elsewhere])[1])


if __name__ == "__main__":
    unittest.main()
