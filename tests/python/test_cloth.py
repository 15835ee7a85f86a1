"""A cloth in Python: steps, arrays, pins, meshes from NumPy, threads, signals.

    test_cloth.py PROGRAM
"""
import gc
import json
import os
import signal
import subprocess
import sys
import tempfile
import threading
import unittest
from pathlib import Path

import numpy as np

import bendlab as bl

PROGRAM = sys.argv.pop(1)
TWO = ["upper_left", "upper_right"]


def hanging(cells=8, **settings):
    return bl.Scene(mesh=bl.grid(1, 1, cells), pins=TWO, **settings)


def square():
    """Vertices (4, 3) and triangles (2, 3) of a square of 1 m."""
    return np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0.0]]), np.array([[0, 1, 3], [0, 3, 2]])


class Surfaces(unittest.TestCase):
    def test_a_sheet_starts_and_rests_on_a_cylinder(self):
        cylinder, radius = bl.Surface(shape="cylinder", radius=0.25), 0.25
        for scene in (bl.Scene(mesh=bl.Mesh(cells=16, surface=cylinder)),
                      bl.Scene(mesh=bl.grid(1, 1, 16), initial=bl.Initial(surface=cylinder))):
            x = scene.simulate().positions
            middle = np.array([[p[0], p[2]] for p in x])
            # Circle through all points (x, z): 2 a x + 2 b z + c = x² + z².
            a, b, c = np.linalg.lstsq(np.c_[2 * middle, np.ones(len(x))], (middle ** 2).sum(1), rcond=None)[0]
            np.testing.assert_allclose(np.hypot(*(middle - [a, b]).T), radius, rtol=1e-6)  # stored as float
            self.assertEqual(scene, eval(repr(scene), {**vars(bl)}))
        flat = bl.Scene(mesh=bl.grid(1, 1, 16))
        self.assertNotEqual(scene, flat)
        with self.assertRaisesRegex(TypeError, "Surface"):
            bl.Mesh(surface="cylinder")


class Steps(unittest.TestCase):
    def test_a_run_has_the_same_bits_as_from_the_program(self):
        with tempfile.TemporaryDirectory() as place:
            for solver in (bl.QuasiNewton(), bl.Pbd(substeps=3), bl.Newton()):
                scene = hanging(bending=bl.DiscreteShells(flexural_rigidity=1e-4), solver=solver,
                                duration=0.2)
                config = Path(place, f"{type(solver).__name__}.json")
                config.write_text(json.dumps({"name": config.stem, "duration": 0.2, **scene.config()}))
                subprocess.run([PROGRAM, "run", config, "--out", place], check=True, capture_output=True)
                cloth = scene.simulate()
                cloth.run(0.2)
                run, = bl.load(Path(place, config.stem))
                # The file of a scene in single precision has frames in single precision.
                single = run.provenance["precision"] == "single"
                now = cloth.positions.astype(np.float32) if single else cloth.positions
                self.assertTrue((run.positions() == now).all())

    def test_single_steps_equal_the_steps_of_a_run(self):
        first, second = hanging().simulate(), hanging().simulate()
        first.run(0.5)
        for _ in range(30):
            second.step()
        self.assertEqual(first.time, second.time)
        self.assertTrue((first.positions == second.positions).all())
        self.assertTrue((first.velocities == second.velocities).all())

    def test_a_free_cloth_falls_like_a_stone(self):
        cloth = bl.Scene(mesh=bl.grid(1, 1, 4), pins=[], effects=[bl.Gravity()],
                         solver=bl.Newton()).simulate()
        cloth.run(0.5)
        # The first substep of BDF2 is a backward Euler step, which falls g h² / 2 too far.
        self.assertAlmostEqual(cloth.positions[:, 2].mean(), -9.81 * 0.125, delta=9.81 / 60 ** 2)

    def test_a_negative_or_infinite_duration_is_refused(self):
        for seconds in (-1, float("nan"), float("inf")):
            with self.assertRaisesRegex(ValueError, "seconds of at least 0"):
                hanging().simulate().run(seconds)

    def test_a_doubtful_scene_causes_a_warning(self):
        vertices, triangles = square()
        with self.assertWarnsRegex(UserWarning, "units"):
            cloth = bl.Scene(mesh=bl.Mesh(100 * vertices, triangles), pins=[0]).simulate()
        self.assertIn("units", [code for code, _ in cloth.warnings])

    def test_progress(self):
        seen = []
        hanging(8, solver=bl.Newton()).simulate().run(0.5, progress=seen.append)
        self.assertTrue(seen)
        self.assertEqual(seen, sorted(seen))
        self.assertTrue(all(0 <= share <= 1 for share in seen))

    def test_a_cloth_at_rest_stops(self):
        cloth = hanging(solver=bl.Equilibrium()).simulate()
        cloth.run(1e9)
        self.assertTrue(cloth.settled)

    def test_a_diverging_cloth_raises_an_error(self):
        scene = hanging(solver=bl.Pbd(), effects=[bl.Gravity(acceleration=(0, 0, -1e12))])
        with self.assertRaisesRegex(RuntimeError, "diverged"):
            scene.simulate().run(10)


class Arrays(unittest.TestCase):
    def test_arrays_have_their_shapes_and_are_read_only(self):
        cloth = hanging(8).simulate()
        self.assertEqual((cloth.positions.shape, cloth.velocities.shape, cloth.triangles.shape,
                          cloth.pinned.shape), ((81, 3), (81, 3), (128, 3), (2,)))
        for array in (cloth.positions, cloth.velocities, cloth.triangles, cloth.pinned):
            with self.assertRaises(ValueError):
                array[0] = 1
        self.assertEqual(cloth.triangles.max(), 80)

    def test_arrays_are_views_and_outlive_the_cloth(self):
        cloth = hanging().simulate()
        view = cloth.positions
        self.assertTrue(np.shares_memory(view, cloth.positions))
        cloth.step()
        now = cloth.positions.copy()
        self.assertTrue((view == now).all(), "the view shows the state after the last call")
        del cloth
        gc.collect()
        bl.Scene().simulate()  # this cloth would reuse memory that was freed
        self.assertTrue((view == now).all())

    def test_energies_and_forces_have_the_same_kinds_of_constraints(self):
        for bending, kind in ((bl.DiscreteShells(flexural_rigidity=1e-3), "hinge"),
                              (bl.Crossover(), "distance")):
            cloth = hanging(6, bending=bending, solver=bl.Newton(), initial=bl.Initial(tilt=20)).simulate()
            cloth.run(0.2)
            energies, forces = cloth.energies(), cloth.forces()
            self.assertEqual(set(forces), {"strain", kind})
            self.assertEqual(set(energies), {"strain", kind, "kinetic", "weight"})
            mass = 0.2 / 49  # of a vertex, roughly
            self.assertGreater(energies["kinetic"], 0.1 * mass * (cloth.velocities ** 2).sum())
            for force in forces.values():  # forces at pinned vertices are zero
                free = np.ones(49, bool)
                free[cloth.pinned] = False
                self.assertTrue((force[cloth.pinned] == 0).all())
                self.assertGreater(np.abs(force[free]).max(), 0)


class Pins(unittest.TestCase):
    def test_pinned_vertices_move_to_the_given_positions(self):
        for solver in (bl.QuasiNewton(), bl.Newton(substeps=3), bl.Pbd(),
                       bl.Pbd(precision="double", substeps=4), bl.Vbd()):
            with self.subTest(repr(solver)):
                cloth = hanging(solver=solver).simulate()
                cloth.run(0.1)
                self.assertEqual(cloth.pins.shape, (2, 3))
                start = cloth.positions[cloth.pinned].copy()
                self.assertLess(np.abs(cloth.pins - start).max(), 1e-6)
                for step in range(1, 4):
                    cloth.pins[:] = start + (0, 0, 0.01 * step)
                    cloth.step()
                    self.assertLess(np.abs(cloth.positions[cloth.pinned] - cloth.pins).max(), 1e-6)
                cloth.run(0.5)
                self.assertLess(cloth.positions[:, 2].max(), start[0, 2] + 0.05)

    def test_reading_the_pins_does_not_change_the_motion(self):
        for solver in (bl.QuasiNewton(), bl.Newton(), bl.Pbd(precision="double")):
            plain, asked = hanging(solver=solver).simulate(), hanging(solver=solver).simulate()
            plain.run(0.3), asked.run(0.1)
            self.assertEqual(asked.pins.shape, (2, 3))
            asked.run(0.2)
            self.assertLess(np.abs(plain.positions - asked.positions).max(), 1e-9)

    def test_a_method_that_cannot_move_pins_refuses_them(self):
        for solver in (bl.Equilibrium(), bl.KangCho()):
            bending = bl.Crossover() if isinstance(solver, bl.KangCho) else bl.DiscreteShells()
            with self.assertRaisesRegex(ValueError, "pinned vertices"):
                hanging(solver=solver, bending=bending).simulate().pins
        cloth = hanging().simulate()
        cloth.pins = cloth.pins + 0.01
        cloth.step()
        self.assertAlmostEqual(cloth.positions[cloth.pinned][0, 2], 0.01, 6)
        cloth.pins[0] = np.nan
        with self.assertRaisesRegex(ValueError, "not finite"):
            cloth.step()
        self.assertTrue(np.isfinite(cloth.positions).all())

    def test_a_cloth_without_pins_has_an_empty_array_of_pins(self):
        self.assertEqual(bl.Scene(pins=[]).simulate().pins.shape, (0, 3))


class MeshesFromArrays(unittest.TestCase):
    def test_arrays_of_any_layout_and_type_are_converted(self):
        vertices, triangles = square()
        expected = bl.Scene(mesh=bl.Mesh(vertices, triangles), pins=[0]).simulate()
        expected.run(0.2)
        read_only = vertices.copy()
        read_only.flags.writeable = False
        wide = np.zeros((4, 6))
        wide[:, ::2] = vertices
        for kind, points, corners in (("lists", vertices.tolist(), triangles.tolist()),
                                      ("Fortran order", np.asfortranarray(vertices),
                                       np.asfortranarray(triangles)),
                                      ("float32", vertices.astype(np.float32), triangles.astype(np.uint8)),
                                      ("not contiguous", wide[:, ::2], triangles[:, :]),
                                      ("read-only", read_only, triangles),
                                      ("big-endian", vertices.astype(">f8"), triangles.astype(">i4"))):
            with self.subTest(kind):
                cloth = bl.Scene(mesh=bl.Mesh(points, corners), pins=[0]).simulate()
                cloth.run(0.2)
                self.assertTrue((cloth.positions == expected.positions).all())

    def test_a_mesh_file(self):
        with tempfile.TemporaryDirectory() as place:
            Path(place, "square.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 4\nf 1 4 3\n")
            cloth = bl.Scene(mesh=bl.Mesh(file="square.obj"), folder=place, pins=[0]).simulate()
            self.assertEqual(cloth.positions.shape, (4, 3))

    def test_a_mesh_from_arrays_refuses_settings_of_shape_and_has_no_config(self):
        with self.assertRaisesRegex(TypeError, "does not read cells"):
            bl.Mesh(*square(), cells=4)
        with self.assertRaisesRegex(ValueError, "a config cannot contain"):
            bl.Scene(mesh=bl.Mesh(*square())).config()

    def test_the_mesh_is_a_copy(self):
        vertices, triangles = square()
        mesh = bl.Mesh(vertices, triangles)
        vertices[:] = 7
        self.assertEqual(bl.Scene(mesh=mesh, pins=[0]).simulate().positions.max(), 1)

    def test_a_wrong_array_is_refused_with_the_reason(self):
        vertices, triangles = square()
        bad = vertices.copy()
        bad[2, 1] = np.nan
        for points, corners, text in ((bad, triangles, "vertex 2 is not finite"),
                                      (vertices[:, :2], triangles, r"vertices have the shape \(4, 2\)"),
                                      (vertices, triangles.ravel(), r"triangles have the shape \(6,\)"),
                                      (vertices, triangles.astype(float), "triangles are of dtype float64"),
                                      (vertices.astype(complex), triangles,
                                       "vertices are of dtype complex128"),
                                      (vertices.astype(str), triangles, "vertices are of dtype"),
                                      (vertices, triangles + 2, "triangle 0 is"),
                                      (vertices, triangles - 1, "triangle 0 is")):
            with self.subTest(text), self.assertRaisesRegex(ValueError, text):
                bl.Mesh(points, corners)
        with self.assertRaisesRegex(TypeError, "needs both"):
            bl.Mesh(vertices)
        with self.assertRaises(bl.MeshError):
            bl.Scene(mesh=bl.Mesh(vertices, [[0, 1, 1]])).simulate()
        paint = bl.Map(file="missing.ply", property="paint")
        for scene in (bl.Scene(mesh=bl.Mesh(file="missing.obj")),
                      bl.Scene(mesh=bl.grid(1, 1, 4), bending=bl.MidEdge(map=paint))):
            with self.assertRaisesRegex(bl.MeshError, "missing"):
                scene.simulate()
        with self.assertRaises((bl.MeshError, ValueError)):
            bl.Scene(mesh=bl.Mesh(np.zeros((0, 3)), np.zeros((0, 3), int))).simulate()


class ThreadsAndSignals(unittest.TestCase):
    def test_two_threads_with_one_cloth_raise_an_error_and_do_not_race(self):
        cloth = hanging(8).simulate()
        raised, inside, tried = [], threading.Event(), threading.Event()

        def wait(share):
            inside.set()
            tried.wait()

        worker = threading.Thread(target=cloth.run, args=(0.1,), kwargs={"progress": wait})
        worker.start()
        inside.wait()
        uses = (cloth.step, lambda: cloth.positions, cloth.energies, lambda: cloth.pins)
        for use in uses:
            try:
                use()
            except RuntimeError as error:
                raised.append(str(error))
        tried.set()
        worker.join()
        self.assertEqual(len(raised), len(uses))
        self.assertIn("each thread", raised[0])
        cloth.step()

    def test_threads_with_different_cloths_run_at_the_same_time(self):
        cloths = [hanging(24).simulate() for _ in range(4)]
        workers = [threading.Thread(target=cloth.run, args=(0.5,)) for cloth in cloths]
        for worker in workers:
            worker.start()
        for worker in workers:
            worker.join()
        for cloth in cloths[1:]:
            self.assertTrue((cloth.positions == cloths[0].positions).all())

    def test_ctrl_c_during_a_run_keeps_the_state_of_the_last_step(self):
        cloth = hanging(24).simulate()
        with self.assertRaises(KeyboardInterrupt):  # the whole run would take hours
            cloth.run(1e6, progress=lambda share: os.kill(os.getpid(), signal.SIGINT))
        steps = round(cloth.time * 60)
        self.assertGreater(steps, 0)
        again = hanging(24).simulate()
        for _ in range(steps):
            again.step()
        self.assertTrue((again.positions == cloth.positions).all())
        cloth.step()


if __name__ == "__main__":
    unittest.main()
