"""Bending models, effects and measures that are written in Python.

    test_own.py PROGRAM
"""
import subprocess
import sys
import tempfile
import threading
import traceback
import unittest
from pathlib import Path
from types import SimpleNamespace

import numpy as np

import bendlab as bl

sys.path.insert(0, str(Path(__file__).resolve().parent))
from models import FoldAngle, FoldEnergy, angle  # noqa: E402

PROGRAM = sys.argv.pop(1)
TWO = ["upper_left", "upper_right"]
BY_COMPLIANCE = {"stiffness": "compliance", "compliance": 1e3}


def sheet(bending, solver, cells=8, **settings):
    """A sheet without symmetry that swings in air. The drag keeps the motion from becoming chaotic."""
    return bl.Scene(mesh=bl.Mesh(width=1, height=1, cells=cells, jitter=0.2), pins=TWO, bending=bending,
                    solver=solver, initial=bl.Initial(tilt=30),
                    effects=[bl.Gravity(), bl.ViscousDrag(coefficient=3)], **settings)


def apart(first, second, steps):
    """Returns the largest difference of a coordinate after this number of steps, m."""
    first, second = first.simulate(), second.simulate()
    for _ in range(steps):
        first.step(), second.step()
    return np.abs(first.positions - second.positions).max()


class Models(unittest.TestCase):
    def test_positions_equal_those_of_the_oracle(self):
        # The membrane has stiffness factors k, as rounding errors would grow with stiff springs.
        soft = bl.Material(strain=bl.Strain(stiffness="k", warp=0.5, weft=0.5, shear=0.5))
        for solver in (bl.Pbd(order="mesh", precision="double", iterations=3),
                       bl.Pbd(order="mesh", sweep="symmetric", precision="double", substeps=4, iterations=1),
                       bl.Pbd(order="colour", precision="double", iterations=3)):
            with self.subTest(repr(solver)):
                self.assertLess(apart(sheet(FoldAngle(**BY_COMPLIANCE), solver, 6, material=soft),
                                      sheet(bl.DiscreteShells(**BY_COMPLIANCE), solver, 6, material=soft),
                                      30), 1e-12)
        for solver in (bl.Newton(), bl.Newton(integrator="euler")):
            with self.subTest(repr(solver)):
                self.assertLess(apart(sheet(FoldAngle(**BY_COMPLIANCE), solver, 6),
                                      sheet(bl.DiscreteShells(**BY_COMPLIANCE), solver, 6), 50), 1e-12)

    def test_with_k_the_model_is_the_dihedral_constraint(self):
        solver = bl.Pbd(order="mesh", precision="double", iterations=3)
        by_k = {"stiffness": "k"}
        self.assertLess(apart(sheet(FoldAngle(**by_k, k=0.3), solver, 6),
                              sheet(bl.DiscreteShells(**by_k, k=0.3), solver, 6), 20), 1e-12)

    def test_equilibrium_equals_that_of_the_oracle_for_constraint_and_energy(self):
        pose = {}
        for bending in (bl.DiscreteShells(**BY_COMPLIANCE), FoldAngle(**BY_COMPLIANCE),
                        FoldEnergy(**BY_COMPLIANCE)):
            cloth = sheet(bending, bl.Equilibrium()).simulate()
            cloth.run(1e9)
            self.assertTrue(cloth.settled)
            pose[type(bending).__name__] = cloth.positions.copy()
        self.assertLess(np.abs(pose["FoldAngle"] - pose["DiscreteShells"]).max(), 1e-9)
        # The solver stops at a residual of 1e-9 of the loads: a micrometre where the sheet is softest.
        self.assertLess(np.abs(pose["FoldEnergy"] - pose["DiscreteShells"]).max(), 1e-5)

    def test_an_energy_gives_the_same_motion_as_its_constraint(self):
        # Newton's method stops at an update of 1e-7 of the size, and the errors of all steps add up.
        self.assertLess(apart(sheet(FoldEnergy(**BY_COMPLIANCE), bl.Newton()),
                              sheet(bl.DiscreteShells(**BY_COMPLIANCE), bl.Newton()), 60), 1e-5)

    def test_a_stated_rigidity_multiplies_the_energy_of_the_weights(self):
        def folded(**stiffness):
            scene = bl.Scene(mesh=bl.Mesh(generator="equilateral", cells=8), solver=bl.Newton(),
                             bending=FoldAngle(**stiffness), initial=bl.Initial(perturbation=0.01))
            return scene.simulate().energies()["fold_angle"]

        # The weights belong to a rigidity of 1 N m. The rigidity B multiplies their energy; a compliance is
        # 1/B.
        self.assertAlmostEqual(folded(flexural_rigidity=2e-3) / folded(flexural_rigidity=1e-3), 2, 12)
        by_compliance = folded(stiffness="compliance", compliance=1e3)
        self.assertAlmostEqual(by_compliance / folded(flexural_rigidity=1e-3), 1, 12)

    def test_settings_have_ranges_and_can_be_swept(self):
        self.assertEqual(FoldAngle(factor=2).factor, 2)
        with self.assertRaisesRegex(bl.ConfigError, "/bending/fold_angle/factor"):
            FoldAngle(factor=0)
        with tempfile.TemporaryDirectory() as place:
            table = bl.run(sheet(FoldAngle(**BY_COMPLIANCE), bl.Newton(), cells=4, duration=0.1),
                           sweep={"/bending/fold_angle/factor": [1.0, 2.0]}, out=place)
            self.assertEqual(list(table["factor"]), [1, 2])
            self.assertEqual(list(table["status"]), ["complete"] * 2)

    def test_the_error_of_a_wrong_gradient_states_both_numbers(self):
        with self.assertRaises(ValueError) as caught:
            class WrongGradient(bl.Model):
                def elements(self, rest):
                    return bl.Elements(rest.hinges)

                def constraint(self, x, rest):
                    value, gradient = angle(x)
                    gradient[:, 2, 1] *= 1.01
                    return value, gradient
        self.assertRegex(str(caught.exception),
                         r"WrongGradient.*vertex 2 of 4, d/dy: returned \S+, central differences")
        with self.assertRaisesRegex(bl.ConfigError, "model"):
            bl.run({"name": "a", "bending": {"model": "wrong_gradient"}})

    def test_other_errors_in_the_definition_of_a_class_are_refused(self):
        def define(name="Odd", **members):
            return type(name, (bl.Model,), {"elements": lambda self, rest: bl.Elements(rest.hinges),
                                            **members})

        def constraint(self, x, rest):
            return angle(x)

        for members, text in (
                ({}, "either constraint"),
                ({"constraint": constraint, "energy": constraint}, "either constraint"),
                ({"constraint": lambda self, x, rest: angle(x)[0]}, r"returned ndarray, expected \(values"),
                ({"constraint": lambda self, x, rest: (angle(x)[0][:, None], angle(x)[1])},
                 "arrays of shapes"),
                ({"constraint": lambda self, x, rest: (angle(x)[0] + np.nan, angle(x)[1])}, "not finite"),
                ({"constraint": constraint, "elements": lambda self, rest: rest.hinges}, "expected Elements"),
                ({"constraint": constraint,
                  "elements": lambda self, rest: bl.Elements(rest.hinges + 100)}, "vertex"),
                ({"constraint": constraint,
                  "elements": lambda self, rest: bl.Elements(rest.hinges, softness=0)}, "above 0"),
                ({"constraint": constraint,
                  "elements": lambda self, rest: bl.Elements(rest.hinges, a=np.ones(3))}, "3 rows"),
                ({"constraint": constraint,
                  "elements": lambda self, rest: bl.Elements(rest.hinges.astype(float))}, "whole numbers"),
                ({"constraint": constraint, "size": bl.Setting(None)}, "a setting is")):
            with self.subTest(text), self.assertRaisesRegex((ValueError, TypeError), text):
                define(**members)
        with self.assertRaisesRegex(ValueError, "by the same vector"):
            define("Height", elements=lambda self, rest: bl.Elements(rest.triangles[:, :1]),
                   constraint=lambda self, x, rest: (x[:, 0, 2], np.tile([0, 0, 1.0], (len(x), 1, 1))))
        with self.assertRaisesRegex(ValueError, "bending model 'lod' cannot be registered"):
            define("Lod", constraint=constraint)

    def test_a_class_replaces_an_earlier_class_with_the_same_name(self):
        def define(factor):
            class Twice(bl.Model):
                def elements(self, rest):
                    return bl.Elements(rest.hinges)

                def constraint(self, x, rest):
                    value, gradient = angle(x)
                    return factor * value, factor * gradient
            return Twice

        first = define(1)
        cloth = sheet(first(**BY_COMPLIANCE), bl.Newton()).simulate()
        second = define(3)
        cloth.run(0.2)
        other = sheet(second(**BY_COMPLIANCE), bl.Newton()).simulate()
        other.run(0.2)
        self.assertGreater(np.abs(cloth.positions - other.positions).max(), 1e-6)

    def test_an_exception_ends_the_step_with_its_traceback_and_does_not_change_the_cloth(self):
        calls = SimpleNamespace(now=0, fails_at=0)

        class Fragile(bl.Model):
            def elements(self, rest):
                return bl.Elements(rest.hinges)

            def constraint(self, x, rest):
                calls.now += 1
                if calls.now == calls.fails_at:
                    raise ZeroDivisionError("in the middle of a step")
                return angle(x)

        for solver in (bl.Pbd(), bl.Newton(), bl.QuasiNewton(), bl.Pbd(precision="double", order="mesh")):
            with self.subTest(repr(solver)):
                calls.fails_at = 0
                cloth, whole = (sheet(Fragile(**BY_COMPLIANCE), solver, cells=4).simulate() for _ in range(2))
                cloth.run(0.1), whole.run(0.1)
                before, time = cloth.positions.copy(), cloth.time
                calls.now, calls.fails_at = 0, 2
                try:
                    cloth.step()
                    self.fail("the step ended without the exception")
                except ZeroDivisionError as error:
                    self.assertIn("in constraint", "".join(traceback.format_exception(error)))
                self.assertTrue((cloth.positions == before).all())
                self.assertEqual(cloth.time, time)
                calls.fails_at = 0
                cloth.run(0.1), whole.run(0.1)
                self.assertTrue((cloth.positions == whole.positions).all())

    def test_a_method_that_cannot_take_a_model_in_python_is_refused(self):
        for solver in (bl.Vbd(), bl.KangCho()):
            with self.assertRaisesRegex(bl.ConfigError, "/solver/method"):
                sheet(FoldAngle(**BY_COMPLIANCE), solver).simulate()

    def test_threads_with_models_in_python_do_not_deadlock(self):
        cloths = [sheet(FoldAngle(**BY_COMPLIANCE), bl.QuasiNewton()).simulate() for _ in range(3)]
        workers = [threading.Thread(target=cloth.run, args=(0.2,)) for cloth in cloths]
        for worker in workers:
            worker.start()
        for worker in workers:
            worker.join(60)
            self.assertFalse(worker.is_alive())
        self.assertTrue((cloths[0].positions == cloths[2].positions).all())


class Trap(bl.Effect):
    """pulls every vertex to the origin, in proportion to its distance"""

    frequency = bl.Setting(1.0, unit="1/s", meaning="f of x'' = -(2 π f)² x", minimum=0)

    def acceleration(self, x, v, t):
        return -(2 * np.pi * self.frequency) ** 2 * x


class Thrust(bl.Effect):
    """the same force on every vertex"""

    keeps_momentum = False

    def force(self, x, v, t):
        return np.array([0, 0, 1e-3])


class Effects(unittest.TestCase):
    def test_a_trap_moves_a_free_sheet_to_the_other_side(self):
        for solver in (bl.Pbd(substeps=64, iterations=1), bl.Newton(substeps=64),
                       bl.QuasiNewton(substeps=64)):
            with self.subTest(repr(solver)):
                # The sheet starts at rest, 1 m away. After half a period of 1 s it is 1 m away on the other
                # side.
                mesh = bl.Mesh(width=0.2, height=0.2, cells=4, offset=[1, 0, 0])
                cloth = bl.Scene(mesh=mesh, pins=[], effects=[Trap()], solver=solver).simulate()
                start = cloth.positions.mean(axis=0)
                cloth.run(0.5)
                self.assertLess(np.abs(cloth.positions.mean(axis=0) + start).max(), 5e-3)

    def test_a_force_is_divided_by_the_masses(self):
        cloth = bl.Scene(mesh=bl.grid(1, 1, 4), pins=[], effects=[Thrust()], solver=bl.Newton(),
                         bending=bl.None_()).simulate()
        cloth.run(0.5)
        # ½ a t² for 25 vertices with 1 mN each, and 0.2 kg. The first substep of BDF2 adds ½ a h².
        expected = 0.5 * 25e-3 / 0.2 * 0.25
        self.assertAlmostEqual(cloth.masses.sum(), 0.2)
        centre = (cloth.masses * cloth.positions[:, 2]).sum() / 0.2
        self.assertAlmostEqual(centre, expected, delta=25e-3 / 0.2 / 60 ** 2)

    def test_an_exception_keeps_the_cloth_of_the_last_step(self):
        class Late(bl.Effect):
            def acceleration(self, x, v, t):
                return x[:, :2] if t > 0.05 else np.zeros(3)

        cloth = bl.Scene(effects=[Late()]).simulate()
        with self.assertRaisesRegex(ValueError, r"shape \(1089, 2\), expected \(1089, 3\)"):
            cloth.run(1)
        self.assertGreater(cloth.time, 0.04)
        self.assertTrue(np.isfinite(cloth.positions).all())

    def test_an_effect_needs_exactly_one_function(self):
        with self.assertRaisesRegex(TypeError, "either acceleration"):
            type("Nothing", (bl.Effect,), {})


class Lowest(bl.Measure):
    """lowest point of the sheet"""

    columns = {"lowest": ("m", "smallest z of the vertices")}
    numbers = {"lowest_ever": ("m", "smallest z of all frames"),
               "area_at_rest": ("m²", "area of all triangles"), "unknown": ("1", "a number without a value")}

    def begin(self, rest):
        self.area, self.ever = rest.areas.sum(), np.inf

    def frame(self, x, t):
        self.ever = min(self.ever, x[:, 2].min())
        return {"lowest": x[:, 2].min()}

    def finish(self, x):
        return {"lowest_ever": self.ever, "area_at_rest": self.area, "unknown": None}


class Measures(unittest.TestCase):
    def test_the_numbers_of_a_measure_are_in_the_table_and_in_the_file(self):
        with tempfile.TemporaryDirectory() as place:
            scene = bl.Scene(mesh=bl.grid(1, 1, 6), pins=TWO, duration=0.3)
            table = bl.run(scene, sweep={"/mesh/cells": [4, 6]}, measures=[Lowest], out=place, jobs=2)
            self.assertEqual(list(table["area_at_rest"].round(9)), [1, 1])
            for row in range(2):
                run = bl.load(table["file"][row])
                lowest = run.metrics["lowest"]
                self.assertAlmostEqual(lowest[-1], run.positions()[:, 2].min(), 6)
                self.assertEqual(table["lowest_ever"][row], lowest.min())
                self.assertNotIn("unknown", run.summary)
                self.assertEqual(run.metrics.about("lowest"), ("m", "smallest z of the vertices"))

    def test_a_number_with_the_name_of_a_metric_of_the_program_is_refused(self):
        with self.assertRaisesRegex(ValueError, "metric 'drop'"):
            type("Taken", (bl.Measure,), {"numbers": {"drop": ("m", "")}, "finish": lambda self, x: {}})
        with self.assertRaisesRegex(TypeError, "no method finish"):
            type("Unfinished", (bl.Measure,), {"numbers": {"a": ("m", "")}})

    def test_a_run_fails_if_a_measure_does_not_return_its_declared_numbers(self):
        class Other(bl.Measure):
            numbers = {"promised": ("1", "a number")}

            def finish(self, x):
                return {"given": 1}

        with tempfile.TemporaryDirectory() as place:
            table = bl.run(bl.Scene(mesh=bl.grid(1, 1, 4), duration=0.1), measures=Other, out=place)
            self.assertIn("expected a dict of promised", table["message"][0])

    def test_a_run_fails_with_the_reason_if_a_measure_raises_an_exception(self):
        class Failing(bl.Measure):
            columns = {"nothing_at_all": ("1", "never computed")}

            def frame(self, x, t):
                raise ArithmeticError("no such number today")

        with tempfile.TemporaryDirectory() as place:
            table = bl.run(bl.Scene(mesh=bl.grid(1, 1, 4), duration=0.1), measures=[Failing], out=place)
            self.assertEqual(table["status"][0], "failed")
            self.assertIn("no such number today", table["message"][0])


class Runs(unittest.TestCase):
    PULL = ("import sys, bendlab as bl\nclass Pull(bl.Effect):\n    def acceleration(self, x, v, t):\n"
            "        return [0, 0, {}]\n"
            "scene = bl.Scene(mesh=bl.grid(1, 1, 4), effects=[Pull()], duration=0.1)\n"
            "print(bl.run(scene, out=sys.argv[1])['file'][0])\n")

    def test_a_run_with_a_class_is_computed_again_after_the_file_of_the_class_changes(self):
        with tempfile.TemporaryDirectory() as place:
            script, files = Path(place, "mine.py"), []
            for number in (-1, -1, -2):
                script.write_text(self.PULL.format(number))
                files.append(subprocess.run([sys.executable, script, place], check=True, text=True,
                                            capture_output=True).stdout)
            self.assertEqual(files[0], files[1])
            self.assertNotEqual(files[0], files[2])

    def test_a_class_defined_in_a_function_is_new_in_every_call(self):
        def pull(acceleration):
            class Pulled(bl.Effect):
                def acceleration(self, x, v, t):
                    return [0, 0, acceleration]
            return Pulled

        with tempfile.TemporaryDirectory() as place:
            drops = []
            for number in (-1.0, -20.0):
                scene = bl.Scene(mesh=bl.grid(1, 1, 4), pins=[], effects=[pull(number)()], duration=0.1)
                drops.append(bl.load(bl.run(scene, out=place)["file"][0]).positions()[:, 2].mean())
            self.assertAlmostEqual(drops[1] / drops[0], 20, delta=0.1)

    def test_a_scene_with_a_class_that_was_defined_again_is_refused(self):
        def define():
            class Again(bl.Effect):
                def acceleration(self, x, v, t):
                    return np.zeros(3)
            return Again

        scene = bl.Scene(effects=[define()()])
        define()
        with self.assertRaisesRegex(TypeError, "defined again"):
            scene.simulate()


if __name__ == "__main__":
    unittest.main()
