"""Experiments from Python have the same results as experiments from the command line.

    test_runs.py PROGRAM
"""
import json
import multiprocessing
import os
import signal
import subprocess
import sys
import tempfile
import threading
import unittest
from pathlib import Path
from unittest import mock

import numpy as np

import bendlab as bl
from bendlab.results.lock import is_locked

try:
    import pandas
except ImportError:
    pandas = None

PROGRAM = sys.argv.pop(1) if __name__ == "__main__" else None  # None: imported by a process of a test
CONFIG = {"name": "small", "mesh": {"cells": 6}, "pins": {"vertices": ["upper_left", "upper_right"]},
          "duration": 0.2,
          "sweep": {"/bending/model": ["crossover", "discrete_shells"], "/mesh/cells": [4, 6]}}


class Height(bl.Measure):
    """mean height of the cloth"""

    numbers = {"height": ("m", "mean z of the vertices")}

    def finish(self, x):
        return {"height": x[:, 2].mean()}


class Stopping(bl.Measure):
    """sends Ctrl-C with the frame number `at`, and goes on when the main thread has got it"""

    columns = {"nothing": ("1", "always 0")}
    at, frames, interrupted = None, 0, threading.Event()

    def frame(self, x, t):
        Stopping.frames += 1
        if Stopping.frames == Stopping.at:
            os.kill(os.getpid(), signal.SIGINT)
            Stopping.interrupted.wait()
        return {"nothing": 0}


def compute_sweep(out):
    """Computes the runs of CONFIG with a longer duration, two at a time."""
    table = bl.run({**CONFIG, "duration": 2.0}, out=out, jobs=2)
    return list(table["status"])


def locked_folders(out):
    return [file.parent for file in Path(out).glob("**/run.lock") if is_locked(file.parent)]


class Runs(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.place = Path(folder.name)

    def program(self, *arguments):
        return subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, check=False)

    def test_run_files_have_the_same_bits_as_from_the_command_line(self):
        config = self.place / "small.json"
        config.write_text(json.dumps(CONFIG))
        self.program("run", config, "--out", self.place / "program")
        theirs = {run.id: run for run in bl.load(self.place / "program")}
        for argument in (config, str(config), CONFIG):
            out = self.place / f"python{len(list(self.place.iterdir()))}"
            table = bl.run(argument, out=out, jobs=2)
            ours = bl.load(out)
            self.assertEqual({run.id for run in ours}, set(theirs))
            for run in ours:
                expected = theirs[run.id]
                self.assertTrue((run.trajectory() == expected.trajectory()).all())
                metrics = {name for name in run.summary if not name.endswith(("_s", "bytes"))}
                for name in metrics:
                    np.testing.assert_equal(run.summary[name], expected.summary[name])
            self.assertEqual(list(table["model"]), ["crossover"] * 2 + ["discrete_shells"] * 2)
            self.assertEqual(list(table["cells"]), [4, 6, 4, 6])
            for row in range(4):
                self.assertEqual(table["drop"][row], bl.load(table["file"][row]).summary["drop"])

    def test_a_sweep_by_keyword_equals_the_sweep_of_a_config(self):
        scene = bl.Scene(mesh=bl.grid(1, 1, 6), duration=0.2)
        table = bl.run(scene, sweep={"mesh.cells": [4, 6], "/bending": [bl.Crossover(), bl.DiscreteShells()],
                                     "/solver/dt": np.array([0.01, 0.02])}, out=self.place, jobs=2)
        self.assertEqual(len(table), 8)
        self.assertEqual(list(table["cells"]), [4] * 4 + [6] * 4)
        self.assertEqual(json.loads(table["bending"][0]), {"model": "crossover"})
        self.assertEqual(list(table["dt"][:2]), [0.01, 0.02])
        again = bl.run(scene, sweep={"mesh.cells": [4]}, out=self.place)
        self.assertEqual(list(again["status"]), ["complete"])

    def test_the_table_is_the_same_array_whether_or_not_pandas_can_be_imported(self):
        scene = bl.Scene(mesh=bl.grid(1, 1, 4), duration=0.05)
        tables = []
        for modules in ({}, {"pandas": None}):  # None: an import fails as if pandas were absent
            with mock.patch.dict(sys.modules, modules):
                tables.append(bl.run(scene, sweep={"/mesh/cells": [3, 4]}, out=self.place))
        for table in tables:
            self.assertIs(type(table), np.ndarray)
            self.assertEqual(table.dtype, tables[0].dtype)
            self.assertEqual(list(table["cells"]), [3, 4])
            self.assertEqual(table[1]["drop"], table["drop"][1])

    @unittest.skipUnless(pandas, "needs pandas")
    def test_pandas_makes_a_data_frame_of_the_table(self):
        table = bl.run(bl.Scene(mesh=bl.grid(1, 1, 4), duration=0.05),
                       sweep={"/mesh/cells": [3, 4], "/bending": [bl.Crossover(), bl.DiscreteShells()]},
                       out=self.place)
        frame = pandas.DataFrame(table)
        self.assertEqual(tuple(frame.columns), table.dtype.names)
        for name in table.dtype.names:
            np.testing.assert_array_equal(frame[name].to_numpy(), table[name])
        self.assertEqual(list(frame.groupby("cells")["drop"].mean()),
                         [table["drop"][table["cells"] == cells].mean() for cells in (3, 4)])

    def test_a_scene_with_a_mesh_from_arrays(self):
        vertices = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0.0]]) / 3
        scene = bl.Scene(mesh=bl.Mesh(vertices, [[0, 1, 3], [0, 3, 2]]), pins=[0], duration=0.1)
        table = bl.run(scene, out=self.place, name="arrays")
        run = bl.load(table["file"][0])
        self.assertTrue((run.rest_positions == vertices).all())
        cloth = scene.simulate()
        cloth.run(0.1)
        self.assertLess(np.abs(run.positions() - cloth.positions).max(), 1e-7)

    def test_the_config_is_not_changed(self):
        config = {"name": "same", "mesh": {"cells": 4}, "duration": 0.05, "output": {"constraints": True}}
        before = json.dumps(config)
        bl.run(config, sweep={"/mesh/cells": [3]}, out=self.place)
        bl.run(config, measures=[Height], out=self.place)
        self.assertEqual(json.dumps(config), before)

    def test_a_class_cannot_be_defined_while_runs_are_computed(self):
        def define():
            class Meanwhile(bl.Effect):
                def acceleration(self, x, v, t):
                    return np.zeros(3)

        errors = []

        class Defining(bl.Measure):
            numbers = {"defined": ("1", "whether a class was defined in the middle of a run")}

            def finish(self, x):
                try:
                    define()
                except RuntimeError as error:
                    errors.append(str(error))
                return {"defined": len(errors)}

        bl.run(bl.Scene(mesh=bl.grid(1, 1, 4), duration=0.05), measures=[Defining], out=self.place)
        self.assertIn("while", errors[0])
        define()

    def test_the_error_of_a_wrong_config_lists_every_problem(self):
        with self.assertRaises(bl.ConfigError) as caught:
            bl.run({"name": "a", "mesh": {"cells": 0, "cels": 3}})
        self.assertEqual({pointer for pointer, _ in caught.exception.problems}, {"/mesh/cells", "/mesh/cels"})
        with self.assertRaises(FileNotFoundError):
            bl.run(self.place / "no.json")
        with self.assertRaisesRegex(bl.ConfigError, "/mesh/none"):
            bl.run(bl.Scene(), sweep={"/mesh/none": [1]}, out=self.place)

    def test_a_failed_run_has_its_reason_and_other_runs_still_complete(self):
        table = bl.run(bl.Scene(mesh=bl.grid(1, 1, 4), solver=bl.Pbd(), duration=0.1),
                       sweep={"/effects": [[bl.Gravity()], [bl.Gravity(acceleration=(0, 0, -1e15))]]},
                       out=self.place)
        self.assertEqual(table["status"][0], "complete")
        self.assertIn(table["status"][1], ("diverged", "implausible"))
        self.assertTrue(table["message"][1])

    def test_ctrl_c_stops_the_runs_and_the_same_call_continues_them(self):
        def of_runs(out):
            return bl.run(bl.Scene(mesh=bl.grid(1, 1, 6), solver=bl.Newton(), duration=0.5), out=out, jobs=2,
                          sweep={"/initial/tilt": [0, 10, 20, 30]}, measures=[Stopping])

        def interrupt(*_):
            Stopping.interrupted.set()
            raise KeyboardInterrupt

        self.addCleanup(signal.signal, signal.SIGINT, signal.signal(signal.SIGINT, interrupt))
        Stopping.at = 10
        with self.assertRaises(KeyboardInterrupt):
            of_runs(self.place)
        self.assertLess(len(list(self.place.rglob("run.vtkhdf"))), 4)
        Stopping.at = None
        table = of_runs(self.place)
        self.assertEqual(list(table["status"]), ["complete"] * 4)
        whole = of_runs(self.place / "whole")
        for name in ("drop", "mean_strain"):
            self.assertEqual(list(table[name]), list(whole[name]))

    def test_a_forked_child_has_no_part_in_the_locks_of_its_parent(self):
        place, children = self.place, []

        class Forking(bl.Measure):
            numbers = {"seen": ("1", "locks that a forked child sees")}

            def finish(self, x):
                reader, writer = os.pipe()
                child = os.fork()  # while this process computes, and so owns the folder
                if child == 0:
                    os.write(writer, bytes([len(locked_folders(place))]))
                    signal.pause()
                children.append(child)
                return {"seen": os.read(reader, 1)[0]}

        table = bl.run(bl.Scene(mesh=bl.grid(1, 1, 4), duration=0.05), measures=[Forking], out=place)
        self.assertEqual(list(table["seen"]), [1])
        self.assertEqual(os.waitpid(children[0], os.WNOHANG), (0, 0))  # the child lives
        self.assertEqual(locked_folders(place), [])
        os.kill(children[0], signal.SIGKILL)
        os.waitpid(children[0], 0)

    def test_forked_and_spawned_processes_compute_a_sweep_together(self):
        whole = self.place / "whole"
        compute_sweep(whole)
        for method in ("fork", "spawn"):
            out = self.place / method
            with multiprocessing.get_context(method).Pool(3) as pool:
                self.assertEqual(pool.map(compute_sweep, [out] * 3), [["complete"] * 4] * 3)
            self.assertEqual(locked_folders(out), [])
            left = {file.name for file in out.glob("small/*/*")}
            self.assertEqual(left, {"run.vtkhdf", "run.lock"})  # and no file of a second computation
            for ours, theirs in zip(bl.load(out), bl.load(whole)):
                self.assertEqual(ours.id, theirs.id)
                self.assertTrue((ours.trajectory() == theirs.trajectory()).all())


if __name__ == "__main__":
    unittest.main()
