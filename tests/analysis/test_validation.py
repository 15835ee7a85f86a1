"""Tests of validation (ASME V&V 20) against numbers computed by hand."""
import math
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "analysis"))

from figures.stiffness import textile  # noqa: E402
from truths import validation  # noqa: E402
from truths.validation import Validation  # noqa: E402


class Formulas(unittest.TestCase):
    def test_the_uncertainty_is_the_root_of_the_sum_of_squares(self):
        case = Validation(data=50, simulation=44, u_num=2, u_input=3, u_data=6)  # 4 + 9 + 36 = 49
        self.assertEqual((case.error, case.u_val), (-6, 7))

    def test_an_error_up_to_u_val_is_validated_and_a_larger_one_is_an_error_of_the_model(self):
        for simulation, holds, verdict in ((57, True, "validated within u_val"),
                                           (43, True, "validated within u_val"),
                                           (60, False, "model error of at least 3.0 points"),
                                           (40, False, "model error of at least 3.0 points")):
            case = Validation(50, simulation, 2, 3, 6)
            self.assertEqual((case.holds, case.verdict("points")), (holds, verdict))

    def test_there_is_no_verdict_if_a_number_is_missing(self):
        for numbers in ((50, math.nan, 2, 3, 6), (50, 50, math.nan, 3, 6), (50, 50, 2, math.nan, 6)):
            self.assertIsNone(Validation(*numbers).holds)

    def test_scatter_is_pooled_over_groups_of_several_values(self):
        # Squared distances from the means 2 and 5: 1 + 1 and 1 + 0 + 1; degrees of freedom: 1 + 2.
        self.assertAlmostEqual(validation.scatter([[1, 3], [4, 5, 6], [100]]), math.sqrt(4 / 3))
        self.assertTrue(math.isnan(validation.scatter([[1], []])))

    def test_a_mesh_twice_as_coarse_counts_half_of_the_difference_at_order_2(self):
        # Factor of safety 3 over 2² - 1, over the factor of coverage 2; root mean square of 1 and 7 is 5.
        self.assertAlmostEqual(validation.mesh_uncertainty([1, -7], 2, 2), 2.5)


class Drape(unittest.TestCase):
    def test_uncertain_inputs_of_a_straight_curve(self):
        """If the drape coefficient is 100 ln(length) + constant, the slope is 100 at every length."""
        length = textile.length_of(1e-5, 0.1)
        curve = {length * math.exp(k / 1000): 50 + k / 10 for k in range(-200, 201)}
        relative = math.sqrt(textile.DIRECTIONS**2 + textile.RIGIDITY**2 + textile.WEIGHT**2)
        self.assertAlmostEqual(textile.u_input(curve, 1e-5, 0.1), 100 * relative / 3, 2)
        self.assertAlmostEqual(textile.u_friction(curve, 1e-5, 1.2e-5, 0.1),  # B between 10 and 12 µN m
                               100 * math.log(1.2) / 3 / math.sqrt(3), 2)

    def test_a_rigidity_by_direction_leaves_the_other_inputs_uncertain(self):
        length = textile.length_of(1e-5, 0.1)
        curve = {length * math.exp(k / 1000): 50 + k / 10 for k in range(-200, 201)}
        self.assertAlmostEqual(textile.u_input(curve, 1e-5, 0.1, directions=0),
                               100 * math.hypot(textile.RIGIDITY, textile.WEIGHT) / 3, 2)

    def test_without_runs_there_is_no_verdict(self):
        self.assertEqual({case.holds for case in textile.validations([]).values()}, {None})


if __name__ == "__main__":
    unittest.main()
