"""Convergence and verdicts of the verification page, on made-up numbers whose order and limit are known."""
import math
import sys
import unittest
from pathlib import Path
from types import SimpleNamespace

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "analysis"))
from runs import verified  # noqa: E402


def made(value, sizes=(0.4, 0.2, 0.1, 0.05), truth=1.0):
    """Converging of runs with the mesh sizes `sizes`. `value`: mesh size → number."""
    runs = [SimpleNamespace(summary={"edge_length": size}) for size in sizes]
    return verified.converging(runs, lambda run: value(run.summary["edge_length"]), truth)


class Verdicts(unittest.TestCase):
    def test_second_order_to_the_truth_agrees(self):
        result = made(lambda h: 1 + 0.3 * h**2)
        self.assertEqual(result.verdict, "agrees")
        self.assertAlmostEqual(result.cells()["order"], 2, places=9)
        self.assertAlmostEqual(result.cells()["limit"], 1, places=9)
        self.assertAlmostEqual(result.cells()["off"], 100 * 0.3 * 0.05**2, places=9)

    def test_another_limit_is_stated(self):
        result = made(lambda h: 0.8 + 0.3 * h)
        self.assertEqual(result.verdict, "converges to 0.800")
        self.assertAlmostEqual(result.cells()["order"], 1, places=9)

    def test_growth_without_bound_does_not_converge(self):
        self.assertEqual(made(lambda h: 1 / h).verdict, "does not converge")

    def test_two_meshes_are_too_few(self):
        self.assertEqual(made(lambda h: 1 + h, sizes=(0.2, 0.1)).verdict, "too few meshes")
        self.assertTrue(math.isnan(made(lambda h: 1 + h, sizes=(0.2, 0.1)).cells()["bar"]))

    def test_the_uncertainty_covers_the_error_of_a_slowly_converging_row(self):
        result = made(lambda h: 1 + 0.5 * h)  # 2.5 % off on the finest mesh
        self.assertEqual(result.verdict, "agrees")
        self.assertGreaterEqual(result.uncertainty, abs(result.off))

    def test_runs_may_come_in_any_order(self):
        result = made(lambda h: 1 + 0.3 * h**2, sizes=(0.1, 0.4, 0.05, 0.2))
        self.assertAlmostEqual(result.finest, 1 + 0.3 * 0.05**2)


if __name__ == "__main__":
    unittest.main()
