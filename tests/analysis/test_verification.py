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
    runs = [SimpleNamespace(summary={"edge_length": size}, model="none") for size in sizes]
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

    def test_a_row_with_a_wide_bar_is_not_resolved(self):
        result = made(lambda h: 0.5 + 0.9 * h**0.2)  # order 0.2: the bar is wider than the error
        self.assertEqual(result.verdict, "not resolved")

    def test_the_order_in_theory_makes_the_bar_of_an_irregular_row_wider(self):
        sizes, values = (0.4, 0.2, 0.1), (1.5, 1.2, 1.0)  # observed order 0.58
        rows = [{"h": size, "value": value} for size, value in zip(sizes, values)]
        wide, narrow = (verified.of_rows(rows, 1.0, formal).uncertainty for formal in (2.0, None))
        self.assertAlmostEqual(wide / narrow, 3 / 1.25, places=9)

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
