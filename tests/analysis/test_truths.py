"""Tests of the truths in analysis/truths. Expectations come from closed forms, conservation laws, orders of
convergence, published numbers, and other methods than those of the room."""
import ast
import math
import sys
import unittest
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "analysis"))

from truths import buckling, cantilevers, collocation, fabrics, linear_shells, moebius, order  # noqa: E402
from truths import shells, strips, surfaces  # noqa: E402
from truths.napkin import Napkin  # noqa: E402

GAUSS, WEIGHTS = np.polynomial.legendre.leggauss(60)


def integral(function, low, high):
    """∫ function by Gauss's rule; exact up to rounding for smooth functions."""
    return (high - low) / 2 * WEIGHTS @ function(low + (high - low) / 2 * (GAUSS + 1))


def runge_kutta(rate, state, length, steps):
    """The state after `length`, by the classical method of order 4."""
    h = length / steps
    for k in range(steps):
        one = rate(k * h, state)
        two = rate((k + 0.5) * h, state + h / 2 * one)
        three = rate((k + 0.5) * h, state + h / 2 * two)
        state = state + h / 6 * (one + 2 * two + 2 * three + rate((k + 1) * h, state + h * three))
    return state


def end_by_runge_kutta(found, steps):
    """x, y, θ, κ at the end of a curve, integrated from its start."""
    def rate(s, state):
        up = found.lift + found.weight * s
        return np.array([np.cos(state[2]), np.sin(state[2]), state[3],
                         found.across * np.sin(state[2]) - up * np.cos(state[2])])
    return runge_kutta(rate, found.solution.y[:, 0], found.length, steps)


class Room(unittest.TestCase):
    def test_the_room_imports_only_numpy_the_standard_library_and_itself(self):
        allowed = sys.stdlib_module_names | {"numpy", "truths"}
        for file in sorted((ROOT / "analysis" / "truths").glob("*.py")):
            for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
                names = ([alias.name for alias in node.names] if isinstance(node, ast.Import) else
                         [node.module] if isinstance(node, ast.ImportFrom) else [])
                self.assertLessEqual({name.split(".")[0] for name in names}, allowed, file.name)


class Collocation(unittest.TestCase):
    def solve(self, n):
        """y'' = -λ² y, y(0) = y(1) = 0, y'(0) = λ: sin λ s with λ = 3 π, from a guess nearby."""
        t = collocation.points(n)
        return collocation.solve(lambda t, y, p: [y[1], -p[0]**2 * y[0]],
                                 lambda a, b, p: [a[0], b[0], a[1] - p[0]],
                                 [np.sin(9 * t), 9 * np.cos(9 * t)], [9.0])

    def test_the_error_decreases_geometrically_and_the_tail_predicts_it(self):
        errors = [abs(self.solve(n).p[0] - 3 * np.pi) for n in (8, 12, 16, 24)]
        for coarse, fine in zip(errors, errors[1:3]):
            self.assertLess(fine, coarse / 100)
        self.assertLess(errors[-1], 1e-12)
        self.assertLess(errors[1], 10 * self.solve(12).tail)

    def test_between_nodes_and_in_the_mean(self):
        found = self.solve(24)
        at = np.array([0.0, 0.1234, 0.5, 1.0])
        np.testing.assert_allclose(found(at)[0], np.sin(3 * np.pi * at), atol=1e-11)
        self.assertAlmostEqual(collocation.mean(found, found.y[0]), 2 / (3 * np.pi), places=12)

    def test_no_solution(self):
        with self.assertRaises(collocation.NoSolution):
            collocation.solve(lambda t, y, p: [0 * y[0]], lambda a, b, p: [a[0]**2 + 1], np.ones((1, 11)), [])


class Surfaces(unittest.TestCase):
    def test_closed_forms(self):
        ratio = 2.0
        for poisson in (-0.3, 0.0, 0.3):
            for found, expected in (
                    (surfaces.half_cylinder(poisson), np.pi * 0.122 / (2 * 0.0325)),
                    (surfaces.rest_curved_cylinder(poisson), (1 + poisson) * np.pi * 0.122 / 0.0325),
                    (surfaces.rest_curved_cylinder(poisson, same_side=True),
                     (1 - poisson) * np.pi * 0.122 / 0.0325),
                    (surfaces.sphere(poisson), 4 * np.pi * (1 + poisson)),
                    (surfaces.half_torus(poisson), np.pi**2 * ratio**2 / np.sqrt(ratio**2 - 1)),
                    (surfaces.helix(poisson), 0.1**2 * np.log(2) / (2 * 0.02 * np.sqrt(
                        0.1**2 + 4 * np.pi**2 * 0.02**2)))):
                self.assertAlmostEqual(found / expected, 1, places=11)

    def test_numbers_of_better_bending(self):
        for found, stated in ((surfaces.half_cylinder, 5.8965), (surfaces.sphere, 16.3363),
                              (surfaces.half_torus, 22.7929), (surfaces.helix, 1.07902)):
            self.assertAlmostEqual(found(0.3) / stated, 1, places=5)

    def test_a_pose_equal_to_its_rest_shape_has_no_energy(self):
        pose = lambda u, v: np.array([u, v, 0.1 * u**2 - 0.2 * u * v])
        self.assertLess(surfaces.energy(pose, ((0, 1), (0, 2)), 0.3, pose), 1e-20)
        self.assertGreater(surfaces.energy(pose, ((0, 1), (0, 2)), 0.3), 0.01)


class Cantilevers(unittest.TestCase):
    def test_end_shear_by_elliptic_integrals(self):
        """Bisshopp and Drucker 1945: with the end angle φ, k² = (1 + sin φ)/2 and sin a = 1/(k √2), the load
        is (F(π/2, k) - F(a, k))², the deflection 1 - 2 (E(π/2, k) - E(a, k)) / √load."""
        for angle in (0.1, 0.7, 1.2):
            k2 = (1 + np.sin(angle)) / 2
            low = np.arcsin(1 / np.sqrt(2 * k2))
            root = lambda t: np.sqrt(1 - k2 * np.sin(t)**2)
            size = integral(lambda t: 1 / root(t), low, np.pi / 2)
            deflection, shortening = cantilevers.end_shear(size**2)
            self.assertAlmostEqual(deflection, 1 - 2 * integral(root, low, np.pi / 2) / size, places=10)
            self.assertAlmostEqual(shortening, 1 - np.sqrt(2 * np.sin(angle)) / size, places=10)

    def test_table_of_mattiasson(self):
        """Mattiasson 1981, doi 10.1002/nme.1620170113, table 1: P L²/EI, deflection, shortening."""
        for load, deflection, shortening in ((1, 0.30172, 0.05643), (4, 0.66996, 0.32894),
                                             (10, 0.81061, 0.55500)):
            np.testing.assert_allclose(cantilevers.end_shear(load), (deflection, shortening), atol=5.1e-6)

    def test_an_end_moment_bends_to_a_circle(self):
        np.testing.assert_allclose(cantilevers.end_moment(1), (0, 1), atol=1e-15)
        np.testing.assert_allclose(cantilevers.end_moment(0.5), (2 / np.pi, 1), atol=1e-15)

    def test_weight(self):
        """Numbers by scipy's solve_bvp and by shooting with DOP853, which agree in 10 digits."""
        for gamma, *expected in ((1, 0.991246, 0.123471), (10, 0.656354, 0.700200),
                                 (100, 0.159223, 0.937524)):
            length = gamma**(1 / 3)
            strip = cantilevers.cantilever(length)
            np.testing.assert_allclose((strip.x[-1] / length, -strip.y[-1] / length), expected, atol=6e-7)

    def test_the_standard_angle_of_cloth_tests(self):
        """ASTM D1388: the chord is 41.5° below the horizontal where half the overhang is ℓ, Γ = 8."""
        strip = cantilevers.cantilever(2.0)
        self.assertAlmostEqual(math.degrees(math.atan2(-strip.y[-1], strip.x[-1])), 41.5, delta=0.02)

    def test_limits_of_weight(self):
        share = lambda length: -cantilevers.cantilever(length).y[-1] / cantilevers.small_deflection(length)
        self.assertAlmostEqual(share(0.2), 1, places=5)
        self.assertAlmostEqual((1 - share(0.3)) / 0.3**6, 1 / 80, places=5)
        steep = cantilevers.cantilever(1e4**(1 / 3))  # height over reach → √(Γ/2)
        self.assertAlmostEqual(-steep.y[-1] / steep.x[-1] / np.sqrt(5e3), 1, delta=0.02)
        upright = cantilevers.cantilever(1.0, clamp=np.pi / 2)
        self.assertAlmostEqual(upright.y[-1], 1, places=12)

    def test_natural_frequencies_by_ritz(self):
        """Polynomials s² … s¹³ on a clamped strip; Rayleigh quotients bound β⁴ from above."""
        power = np.arange(2, 12)
        total = power[:, None] + power
        mass = 1 / (total + 1.0)
        bend = np.outer(power * (power - 1), power * (power - 1)) / (total - 3.0)
        lower = np.linalg.cholesky(mass)
        reduced = np.linalg.solve(lower, np.linalg.solve(lower, bend).T)
        squares = np.linalg.eigvalsh(reduced)
        for mode in (1, 2):
            frequency = cantilevers.natural_frequency(1.0, mode)
            self.assertAlmostEqual(squares[mode - 1] / frequency**2, 1, places=5)


class Fabrics(unittest.TestCase):
    def test_a_linear_moment_gives_the_elastica(self):
        for gamma in (1, 20, 100):
            length = gamma**(1 / 3)
            strip = cantilevers.cantilever(length)
            end = fabrics.cantilever(length, 1, fabrics.linear(1))[-1]
            np.testing.assert_allclose(end, (strip.x[-1], strip.y[-1]), atol=1e-6 * length)

    def test_laws_with_a_linear_limit(self):
        end = lambda curvature: fabrics.cantilever(1, 3, curvature)[-1]
        np.testing.assert_allclose(end(fabrics.softening(1, 1e9)), end(fabrics.linear(1)), atol=1e-8)
        np.testing.assert_allclose(end(fabrics.table([1, 2], [1, 2])), end(fabrics.linear(1)), atol=1e-8)
        # The curvature of a moment is the inverse of the moment of a curvature.
        for k in (0.3, 5.0, 40.0):
            self.assertAlmostEqual(fabrics.softening(2, 5)(2 * k / (1 + k / 5), 0), k)
        table = fabrics.table([1, 3], [2, 4])  # slopes 2, then 1, which goes on
        np.testing.assert_allclose([table(m, 0) for m in (1, 3, -3, 6)], (0.5, 2, -2, 5))
        rubs = fabrics.friction(2, 1, 0.5)  # slope 2 + 1/0.5 up to κ = 0.5, then 2
        np.testing.assert_allclose([rubs(m, 0) for m in (1, 2, 4, -4)], (0.25, 0.5, 1.5, -1.5))
        # Friction that is never overcome adds moment / slip to the rigidity.
        np.testing.assert_allclose(end(fabrics.friction(1, 100, 50)), end(fabrics.linear(3)), atol=1e-8)

    def test_an_orthotropic_sheet(self):
        warp, weft, bias = 3.0, 1.0, 1.6
        plate = fabrics.plate(warp, weft, bias, 0.2)
        np.testing.assert_allclose([fabrics.strip(plate, angle) for angle in (0, 90, 45)], (warp, weft, bias))
        huber = fabrics.plate(warp, weft, fabrics.bias_of_huber(warp, weft))
        self.assertAlmostEqual(huber[0, 1] + 2 * huber[2, 2], np.sqrt(huber[0, 0] * huber[1, 1]))
        isotropic = fabrics.plate(2, 2, 2, 0.3)  # B of a strip is D (1 - ν²)
        for angle in (0, 20, 45):
            self.assertAlmostEqual(fabrics.strip(isotropic, angle), 2)
            self.assertAlmostEqual(fabrics.cylinder(isotropic, angle), 2 / (1 - 0.3**2))


class Napkins(unittest.TestCase):
    def test_a_small_sag_is_that_of_kirchhoffs_plate(self):
        """w = q r⁴/64 + c0 + c1 ln r + c2 r² + c3 r² ln r; the rim has no moment and no shear."""
        inner, nu = 0.6, 0.3
        one = lambda r: [r**4 / 64, 1, np.log(r), r**2, r**2 * np.log(r)]
        slope = lambda r: [r**3 / 16, 0, 1 / r, 2 * r, r * (2 * np.log(r) + 1)]
        second = lambda r: [3 * r**2 / 16, 0, -1 / r**2, 2, 2 * np.log(r) + 3]
        moment = np.array(second(1)) + nu * np.array(slope(1))
        shear = np.array([1 / 2, 0, 0, 0, 4])  # (∇²w)' at r = 1
        rows = np.array([one(inner), slope(inner), moment, shear])
        c = np.linalg.solve(rows[:, 1:], -rows[:, 0])
        napkin = Napkin(inner, nu)
        load = 1e-6
        sag = napkin.w[0] @ napkin.sag(load)[:napkin.terms] / load
        np.testing.assert_allclose(sag, [row[0] + row[1:] @ c for row in map(np.array, map(one, napkin.r))],
                                   rtol=1e-8)

    def test_the_second_variation_is_that_of_the_energy(self):
        """Against second differences of the energy, integrated over the disc."""
        napkin, n, nu = Napkin(0.5, 0.25, 5), 3, 0.25
        t = napkin.terms
        x = napkin.sag(900)
        random = np.random.default_rng(1)
        wave = random.normal(size=3 * t)
        phi = np.arange(48) * 2 * np.pi / 48
        r, cos, sin = napkin.r[:, None], np.cos(n * phi), np.sin(n * phi)

        def energy(step):
            w1, w2 = ((table @ x[:t])[:, None] + step * (table @ wave[:t])[:, None] * cos
                      for table in napkin.w[1:])
            u, u1 = ((table @ x[t:])[:, None] + step * (table @ wave[t:2 * t])[:, None] * cos
                     for table in napkin.u[:2])
            v, v1 = (step * (table @ wave[2 * t:])[:, None] * sin for table in napkin.u[:2])
            by_phi = lambda table, part: -n * step * (table @ part)[:, None] * sin
            w_phi, w1_phi, u_phi = (by_phi(napkin.w[0], wave[:t]), by_phi(napkin.w[1], wave[:t]),
                                    by_phi(napkin.u[0], wave[t:2 * t]))
            w_phi2 = -n**2 * step * (napkin.w[0] @ wave[:t])[:, None] * cos
            v_phi = n * step * (napkin.u[0] @ wave[2 * t:])[:, None] * cos
            plate = lambda a, b, shear: a**2 + b**2 + 2 * nu * a * b + (1 - nu) / 2 * shear**2
            stretch = plate(u1 + w1**2 / 2, (u + v_phi) / r + w_phi**2 / 2 / r**2,
                            u_phi / r + v1 - v / r + w1 * w_phi / r) / (1 - nu**2)
            bend = plate(w2, w1 / r + w_phi2 / r**2, 2 * (w1_phi / r - w_phi / r**2))
            return np.sum(napkin.area[:, None] * (stretch + bend) / 2) / len(phi)

        step = 1e-3
        difference = (energy(step) - 2 * energy(0) + energy(-step)) / step**2
        # The mean of cos² and sin² is ½.
        self.assertAlmostEqual(difference / (wave @ napkin.second_variation(x, n) @ wave / 2), 1, places=5)

    def test_the_critical_load_does_not_depend_on_the_number_of_terms(self):
        few, many = (Napkin(0.6, 0.3, terms).critical(range(4, 7)) for terms in (9, 12))
        self.assertAlmostEqual(few[0] / many[0], 1, places=6)
        self.assertEqual((few[1], many[1]), (5, 5))


class Strips(unittest.TestCase):
    def test_the_invariant_is_constant(self):
        for strip in (strips.hanging_loop("heart", 3.0), strips.hanging_loop("pear", 3.0),
                      strips.standing_ring(4.0), strips.standing_ring(8.0), strips.free_fold()):
            self.assertLess(np.ptp(strip.half.invariant()), 1e-9)
            self.assertLess(strip.error, 1e-8)

    def test_runge_kutta_converges_to_the_same_ends_with_order_4(self):
        for strip in (strips.standing_ring(5.0), strips.free_fold()):
            error = [np.abs(end_by_runge_kutta(strip.half, steps) - strip.half.solution.y[:, -1]).max()
                     for steps in (400, 800)]
            self.assertAlmostEqual(math.log2(error[0] / error[1]), 4, delta=0.1)
            self.assertLess(error[1], 1e-7)

    def test_loops_without_weight(self):
        drop = lambda kind: strips.drop(strips.hanging_loop(kind, 2.0, weight=0.0))
        heights = {kind: drop(kind) / 2 for kind in strips.STARTS}
        self.assertAlmostEqual(heights["ring"], 1 / np.pi, places=11)
        self.assertAlmostEqual(heights["pear"], 0.4243, places=4)  # Peirce 1930
        self.assertAlmostEqual(heights["heart"] / 0.1337, 1, delta=2e-3)  # Peirce 1930, ASTM D1388

    def test_the_heart_without_weight_by_quadrature(self):
        """κ² = 2 (E - H cos θ) turns from π/2 to -π; E/H makes the sum of x zero."""
        over = lambda ratio, row: integral(lambda t: row(t) / np.sqrt(ratio + np.cos(t)), -np.pi, np.pi / 2)
        low, high = 1.05, 5.0
        for _ in range(60):
            middle = (low + high) / 2
            low, high = (middle, high) if over(middle, np.cos) < 0 else (low, middle)
        height = -over(low, np.sin) / over(low, np.ones_like) / 2
        heart = strips.hanging_loop("heart", 1.0, weight=0.0)
        self.assertAlmostEqual(abs(height), strips.drop(heart), places=9)

    def test_light_rings(self):
        """Roark's formulas for stress and strain, circular rings under their weight: the height changes by
        (π²/4 - 2) w R⁴/B, the width by (2 - π/2) w R⁴/B. A hanging ring is the standing ring upside down."""
        radius = 0.5 / (2 * np.pi)
        for strip, sign in ((strips.standing_ring(0.5), -1), (strips.hanging_loop("ring", 0.5), 1)):
            taller, wider = (size - 2 * radius for size in (strip.height, strip.width))
            self.assertAlmostEqual(sign * taller / radius**4, np.pi**2 / 4 - 2, delta=5e-4)
            self.assertAlmostEqual(-sign * wider / radius**4, 2 - np.pi / 2, delta=5e-4)

    def test_a_long_loop_hangs_straight(self):
        for kind in strips.STARTS:
            shares = [strips.drop(strips.hanging_loop(kind, length)) / length for length in (2.0, 12.0)]
            self.assertTrue(shares[0] < shares[1] < 0.5)
            self.assertAlmostEqual(shares[1], 0.5, delta=0.12)

    def test_the_contact_of_a_standing_ring_begins_where_the_curvature_vanishes(self):
        onset = strips.flat_onset()
        below, above = strips.standing_ring(onset * (1 - 1e-5)), strips.standing_ring(onset * (1 + 1e-5))
        self.assertEqual(below.contact, 0)
        self.assertAlmostEqual(below.half.solution.y[3, 0], 0, delta=1e-3)
        self.assertTrue(0 < above.contact < 1e-3)
        self.assertAlmostEqual(below.height, above.height, delta=1e-4)
        ring = strips.standing_ring(8.0)
        self.assertAlmostEqual(ring.s[-1] + ring.contact / 2, 8.0, places=10)
        self.assertAlmostEqual(ring.x[0], ring.contact / 2, places=10)

    def test_the_fold_lands_on_its_lower_layer(self):
        fold = strips.free_fold()
        self.assertAlmostEqual(fold.y[-1], 0, places=11)  # not a condition of the solution
        self.assertLess(fold.x[-1], 0)
        self.assertGreaterEqual(fold.y.min(), -1e-12)


class LinearShells(unittest.TestCase):
    def test_converged_elements_agree(self):
        """Kiendl, Bletzinger, Linhard and Wüchner 2009, doi 10.1016/j.cma.2009.08.013: 0.3006 and 0.0924."""
        for theory in ("sanders", "koiter"):
            self.assertAlmostEqual(linear_shells.scordelis_lo(theory=theory), 0.3006, delta=5e-5)
        self.assertAlmostEqual(linear_shells.hemisphere(0), 0.0924, delta=5e-5)
        self.assertTrue(0.093 < linear_shells.hemisphere(18) < 0.094)  # Simo et al. 1989; MacNeal and Harder

    def test_more_terms_change_little(self):
        self.assertAlmostEqual(linear_shells.scordelis_lo(terms=60, count=22), linear_shells.scordelis_lo(),
                               delta=1e-7)
        self.assertAlmostEqual(linear_shells.hemisphere(terms=12, count=30), linear_shells.hemisphere(),
                               delta=5e-7)
        self.assertAlmostEqual(1e5 * linear_shells.pinched_cylinder(terms=100),
                               1e5 * linear_shells.pinched_cylinder(), delta=3e-5)

    def test_theories_differ_by_less_than_thickness_over_radius(self):
        for deflection, ratio in ((linear_shells.scordelis_lo, 0.25 / 25),
                                  (linear_shells.pinched_cylinder, 3 / 300)):
            self.assertLess(abs(deflection(theory="koiter") / deflection(theory="sanders") - 1), ratio / 10)

    def test_the_load_and_the_modulus_scale_the_deflection(self):
        for deflection in (linear_shells.scordelis_lo, linear_shells.pinched_cylinder):
            self.assertAlmostEqual(deflection(young=1e7, load=2.0) / deflection(young=1e7, load=1.0), 2,
                                   places=10)

    def test_the_twisted_beam(self):
        angle = lambda x: np.pi * x / 24
        soft, stiff = 29e6 * 1.1 * 0.32**3 / 12, 29e6 * 0.32 * 1.1**3 / 12
        found = linear_shells.twisted_beam("in-plane")
        self.assertAlmostEqual(found / integral(lambda x: (12 - x)**2 * (
            np.cos(angle(x))**2 / soft + np.sin(angle(x))**2 / stiff), 0, 12), 1, places=12)
        self.assertAlmostEqual(found / 5.424e-3, 1, delta=1e-3)
        self.assertAlmostEqual(linear_shells.twisted_beam("out-of-plane") / 1.754e-3, 1, delta=5e-3)


class Shells(unittest.TestCase):
    def test_every_benchmark_is_complete(self):
        for benchmark in shells.ALL:
            u, v = (np.linspace(*ends, 5) for ends in benchmark.ranges)
            place = benchmark.place(*np.meshgrid(u, v))
            self.assertEqual(place.shape, (3, 5, 5))
            self.assertTrue(benchmark.loads and benchmark.supports and benchmark.targets and benchmark.note)
            for part in (*benchmark.loads, *benchmark.targets):
                self.assertAlmostEqual(np.linalg.norm(part.direction), 1)

    def test_published_numbers_are_near_those_of_thin_shells(self):
        """The largest difference: MacNeal and Harder's hemisphere and roof, 0.5 % and 0.6 %."""
        for benchmark in shells.ALL:
            for target in filter(lambda target: target.computed, benchmark.targets):
                self.assertAlmostEqual(target.values[1.0] / target.computed(), 1, delta=7e-3)

    def test_the_cantilevers(self):
        self.assertAlmostEqual(shells.SHEARED.rigidity, 100)
        self.assertAlmostEqual(shells.ROLLED.loads[0].size, 2 * np.pi * shells.ROLLED.rigidity / 12)
        down, inward = shells.SHEARED.targets
        for share in (0.3, 0.5, 1.0):
            deflection, shortening = cantilevers.end_shear(share * 4.0)
            for exact, target in ((deflection, down), (shortening, inward)):
                self.assertTrue(0 < 10 * exact - target.values[share] < 3.5e-3)

    def test_loads_of_the_hemisphere_balance(self):
        for benchmark in (shells.HOLED, shells.CLOSED):
            total = sum(load.size * np.array(load.direction) for load in benchmark.loads)
            np.testing.assert_allclose(total, 0, atol=1e-15)


class Buckling(unittest.TestCase):
    def test_zeros_of_bessel_functions(self):
        self.assertAlmostEqual(buckling.bessel_zero(-0.5), np.pi / 2, places=13)  # J₋½ ∝ cos x / √x
        self.assertAlmostEqual(buckling.bessel_zero(0.0), 2.404825557695773, places=13)

    def test_slender_strips(self):
        """Timoshenko and Gere 1961, section 6.3: 12.85 and 4.013."""
        self.assertAlmostEqual(buckling.slender_load("weight"), 12.85, places=2)
        self.assertAlmostEqual(buckling.slender_load("end load"), 4.013, places=3)

    def test_slender_strips_by_integration(self):
        """φ'' + λ² s² φ/4 = 0 from φ' = 0 at the free end vanishes at the clamp (λ: end load)."""
        for kind, rate in (("weight", lambda s: s**4 / 4), ("end load", lambda s: s**2)):
            load = buckling.slender_load(kind)
            end = runge_kutta(lambda s, y: np.array([y[1], -load**2 * rate(s) * y[0]]), np.array([1.0, 0]),
                              1, 400)
            self.assertAlmostEqual(end[0], 0, places=7)

    def test_a_plate_becomes_a_slender_strip(self):
        for kind in buckling.SLENDER:
            loads = [buckling.plate_load(width, 0.3, kind, 16, 6) for width in (0.2, 0.1, 0.05)]
            limit = buckling.slender_plate_load(0.3, kind)
            self.assertTrue(limit < loads[2] < loads[1] < loads[0])
            self.assertAlmostEqual(2 * loads[2] - loads[1], limit, delta=0.01 * limit)

    def test_more_polynomials_lower_the_load(self):
        loads = [buckling.plate_load(0.2, 0.3, along=along, across=8) for along in (10, 14, 18)]
        self.assertTrue(loads[0] > loads[1] > loads[2] > 0.999 * loads[0])

    def test_wrinkles_minimise_bending_and_stretching(self):
        rigidity, tension, length = 2e-6, 30.0, 0.4
        waves = np.linspace(0.5, 2, 20001) * 2 * np.pi / buckling.wrinkle_length(rigidity, tension, length)
        energy = rigidity * waves**2 + tension * (np.pi / length)**2 / waves**2
        best = 2 * np.pi / waves[np.argmin(energy)]
        self.assertAlmostEqual(best / buckling.wrinkle_length(rigidity, tension, length), 1, places=3)

    def test_wrinkles_in_the_form_of_thickness_and_strain(self):
        """Cerda and Mahadevan's form for a thickness and a strain: λ = √(2πLh) / (3 (1-ν²) γ)^¼."""
        young, poisson, thickness, length, strain = 3e6, 0.4, 1e-4, 0.3, 0.05
        rigidity = young * thickness**3 / (12 * (1 - poisson**2))
        expected = np.sqrt(2 * np.pi * length * thickness) / (3 * (1 - poisson**2) * strain)**0.25
        found = buckling.wrinkle_length(rigidity, young * thickness * strain, length)
        self.assertAlmostEqual(found / expected, 1)


def relaxed(curvature, twist):
    """The convex density of narrow ribbons (Freddi et al. 2016), also for complex arguments."""
    flat = curvature.real**2 < twist.real**2
    safe = np.where(flat, 1, curvature)
    return np.where(flat, 2 * twist**2, (safe**2 + twist**2)**2 / (2 * safe**2))


def half_band(strains):
    """Conditions of a half of a Moebius band (position and d₁ off the axis at its end), for N pieces of
    constant curvature and twist: (…, 2 N) → (…, 4)."""
    count = strains.shape[-1] // 2
    frame = [np.zeros(strains.shape[:-1] + (3,), strains.dtype) for _ in range(2)]
    frame[0][..., 0] = frame[1][..., 2] = 1
    place = 0 * frame[0]
    for k in range(count):
        rate = strains[..., k, None] * frame[0] + strains[..., count + k, None] * frame[1]
        size = np.sqrt((rate**2).sum(-1, keepdims=True) + 1e-12)

        def turned(vector, angle):
            axis = rate / size
            return (np.cos(angle) * vector + np.sin(angle) * np.cross(axis, vector)
                    + (1 - np.cos(angle)) * axis * (axis * vector).sum(-1, keepdims=True))
        place = place + turned(frame[1], size / (4 * count)) / (2 * count)
        frame = [turned(vector, size / (2 * count)) for vector in frame]
    return np.stack([place[..., 0], place[..., 2], frame[0][..., 0], frame[0][..., 2]], -1)


def least_energy(count):
    """The energy of a Moebius band of `count` straight pieces per half, by sequential quadratic programs."""
    s = (np.arange(count) + 0.5) / count
    strains, step = np.concatenate([6 + 0 * s, -np.pi + 0 * s]), np.inf
    gradient = lambda at: np.concatenate([relaxed(at[:count] + 1e-20j, at[count:] + 0j).imag,
                                          relaxed(at[:count] + 0j, at[count:] + 1e-20j).imag]) / 1e-20 / count
    while np.abs(step).max() > 1e-6:
        slopes = half_band(strains + 1e-20j * np.eye(2 * count)).imag / 1e-20
        second = np.zeros((2 * count, 2 * count))
        for row, shift in enumerate(np.eye(2)):
            moved = 1e-5 * np.repeat(shift, count)
            change = (gradient(strains + moved) - gradient(strains - moved)) / 2e-5
            k = np.arange(count)
            second[k, row * count + k], second[count + k, row * count + k] = np.split(change, 2)
        matrix = np.block([[second + 0.3 / count * np.eye(2 * count), slopes], [slopes.T, np.zeros((4, 4))]])
        step = np.linalg.solve(matrix, -np.concatenate([gradient(strains), half_band(strains)]))[:2 * count]
        strains = strains + min(1, 1 / np.abs(step).max()) * step
    return relaxed(strains[:count] + 0j, strains[count:] + 0j).real.mean()


def writhe(closed):
    """Writhe of a closed polygon: (3, #points). Klenin and Langowski 2000, method 1a."""
    points, total = closed.T, 0.0
    after, unit = np.roll(points, -1, 0), lambda v: v / np.linalg.norm(v, axis=1)[:, None]
    for i in range(len(points)):
        others = np.setdiff1d(np.arange(len(points)), np.arange(i - 1, i + 2) % len(points))
        r13, r14 = points[others] - points[i], after[others] - points[i]
        r23, r24 = points[others] - after[i], after[others] - after[i]
        normals = [unit(np.cross(*pair)) for pair in ((r13, r14), (r14, r24), (r24, r23), (r23, r13))]
        cosines = [(a * b).sum(1) for a, b in zip(normals, np.roll(normals, -1, 0))]
        angles = np.arcsin(np.clip(cosines, -1, 1)).sum(0)
        sign = np.sign((np.cross(after[others] - points[others], after[i] - points[i]) * r13).sum(1))
        total += (angles * sign).sum()
    return total / (4 * np.pi)


class Moebius(unittest.TestCase):
    def test_the_energy_is_the_hamiltonian(self):
        """The energy of a closed strip is ∝ 1/length, and its derivative is minus the Hamiltonian."""
        midline = moebius.midline()
        np.testing.assert_allclose(midline.hamiltonian, midline.energy, rtol=1e-8)
        self.assertAlmostEqual(midline.energy, moebius.ENERGY, places=7)
        self.assertGreater(midline.energy, 2 * np.pi**2)  # Fenchel: a closed curve turns by at least 2 π

    def test_the_energy_by_direct_minimisation(self):
        coarse, fine = least_energy(12), least_energy(24)
        self.assertAlmostEqual((4 * fine - coarse) / 3, moebius.ENERGY, delta=5e-4 * moebius.ENERGY)

    def test_the_strip_makes_half_a_turn(self):
        midline = moebius.midline()
        half = midline.position @ collocation.interpolation(2 * midline.s, np.linspace(0, 1, 120)).T
        other = half[:, -2:0:-1] * np.array([[-1], [1], [-1]])
        closed = np.concatenate([half, other], axis=1)
        self.assertAlmostEqual(midline.turns + writhe(closed), -0.5, delta=2e-3)

    def test_the_generators_stay_in_the_strip(self):
        midline = moebius.midline()
        self.assertTrue(np.all(np.abs(midline.twist) <= midline.curvature * (1 + 1e-6)))
        np.testing.assert_allclose(np.linalg.norm(midline.across, axis=0), 1, atol=1e-8)
        np.testing.assert_allclose(midline.across[:, -1], (0, 1, 0), atol=1e-8)


class Order(unittest.TestCase):
    def test_published_example(self):
        """Celik et al. 2008, table 1: a reattachment length and a velocity; a velocity that oscillates."""
        for sizes, values, p, limit, index in (
                ((1, 1.5, 2.0), (6.063, 5.972, 5.863), 1.53, 6.1685, 0.022),
                ((1, 2.0, 2 * 2.143), (10.7880, 10.7250, 10.6050), 0.75, 10.8801, 0.011)):
            found = order.converge(sizes, values)
            self.assertEqual(found.kind, "monotonic")
            self.assertAlmostEqual(found.order, p, delta=0.021)
            self.assertAlmostEqual(found.limit, limit, delta=2e-3)
            self.assertAlmostEqual(found.index, index, delta=6e-4)
        self.assertEqual(order.converge((1, 2, 4.286), (6.0042, 5.9624, 6.0909)).kind, "oscillatory")

    def test_made_up_errors(self):
        for p in (0.7, 1.0, 2.0, 4.0):
            for sizes in ((0.4, 0.1, 0.2), (1.0, 0.3, 0.5)):
                found = order.converge(sizes, [5 - 3 * size**p for size in sizes], formal=p)
                self.assertAlmostEqual(found.order, p, places=8)
                self.assertAlmostEqual(found.limit, 5, places=9)
                self.assertAlmostEqual(found.uncertainty, 1.25 * 3 * min(sizes)**p, places=9)
                self.assertAlmostEqual(order.extrapolated(sizes[1:], [5 - 3 * h**p for h in sizes[1:]], p), 5)

    def test_an_order_far_from_theory_has_a_cautious_factor(self):
        values = [1 + size for size in (1, 2, 4)]
        found = order.converge((1, 2, 4), values, formal=2)
        self.assertEqual((found.factor, found.order), (3.0, 1.0))
        self.assertAlmostEqual(found.uncertainty, 3 * 1.0)
        quick = order.converge((1, 2, 4), [size**3 for size in (1, 2, 4)], formal=2)
        self.assertAlmostEqual(quick.uncertainty, 3 * 7 / (2**2 - 1))

    def test_other_kinds(self):
        kind = lambda *values: order.converge((1, 2, 4), values).kind
        self.assertEqual(kind(1.0, 1.1, 0.8), "oscillatory")
        self.assertEqual(kind(1.0, 1.3, 1.2), "divergent")
        self.assertEqual(kind(1.0, 2.0, 3.0), "divergent")
        self.assertEqual(kind(1.0, 1.0, 1.0), "exact")
        self.assertEqual(kind(0.0, 0.0, 0.0), "exact")
        oscillatory = order.converge((1, 2, 4), (1.0, 1.1, 0.8))
        self.assertAlmostEqual(oscillatory.uncertainty, 3 * 0.15)
        self.assertEqual(order.converge((1, 2, 4), (1.0, 2.0, 3.0)).uncertainty, math.inf)

    def test_wrong_input(self):
        for sizes, values in (((1, 2), (1, 2)), ((1, 1, 2), (1, 2, 3)), ((0, 1, 2), (1, 2, 3)),
                              ((1, 2, 4), (1, math.nan, 3))):
            with self.assertRaises(ValueError):
                order.converge(sizes, values)


if __name__ == "__main__":
    unittest.main()
