"""Installs the build and moves it. Then builds and runs the example against it as a user would: outside the
tree, with plain -O2.

    install.py CMAKE BUILD_FOLDER COMPILER
"""
import json
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import h5py
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "analysis"))
from bendlab.results.facts import Facts  # noqa: E402

ROOT = Path(__file__).resolve().parents[2]
EXAMPLE = Path(__file__).resolve().parent / "example"
CMAKE, BUILD, COMPILER = sys.argv[1:4]
GRAVITY, DURATION, STEP = 9.81, 0.5, 1 / 60 / 8  # m/s²; s, of sweep.json; s, the default substep
MINE = ("model", "effect", "method", "measure")


def command(*arguments, folder):
    """Runs a command; its output is text."""
    return subprocess.run([str(argument) for argument in arguments], cwd=folder, text=True,
                          capture_output=True, stdin=subprocess.DEVNULL, check=False)


def succeeds(*arguments, folder):
    done = command(*arguments, folder=folder)
    assert done.returncode == 0, f"{arguments} gave {done.returncode}:\n{done.stdout}{done.stderr}"
    return done.stdout


def lines(text):
    return [json.loads(line) for line in text.splitlines()]


class LibraryAlone(unittest.TestCase):
    """Without the program, the library needs neither HDF5, PNG, CLI11, NLopt nor Google Benchmark."""

    def test_a_program_is_built_against_it(self):
        absent = [f"-DCMAKE_DISABLE_FIND_PACKAGE_{name}=ON" for name in ("HDF5", "PNG", "CLI11", "benchmark")]
        with tempfile.TemporaryDirectory(prefix="bendlab library ") as name:
            place = Path(name)
            succeeds(CMAKE, "-S", ROOT, "-B", place / "build", "-G", "Ninja", "-DBENDLAB_PROGRAM=OFF",
                     "-DCMAKE_BUILD_TYPE=Release", f"-DCMAKE_CXX_COMPILER={COMPILER}", *absent, folder=place)
            succeeds(CMAKE, "--build", place / "build", folder=place)
            succeeds(CMAKE, "--install", place / "build", "--prefix", place / "prefix", folder=place)
            (place / "CMakeLists.txt").write_text(
                "cmake_minimum_required(VERSION 3.25)\nproject(mine CXX)\nfind_package(bendlab REQUIRED)\n"
                f"add_executable(hang {EXAMPLE}/hang.cpp)\n"
                "target_link_libraries(hang PRIVATE bendlab::scene)\n")
            succeeds(CMAKE, "-S", ".", "-B", "mine", "-G", "Ninja", f"-DCMAKE_PREFIX_PATH={place / 'prefix'}",
                     f"-DCMAKE_CXX_COMPILER={COMPILER}", *absent, folder=place)
            succeeds(CMAKE, "--build", "mine", folder=place)
            succeeds(place / "mine/hang", folder=place)


class Installed(unittest.TestCase):
    """The files of `cmake --install`, and a program that uses the installed library."""

    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory(prefix="bendlab install ")
        cls.place = Path(cls.scratch.name)
        first, cls.prefix = cls.place / "first", cls.place / "moved prefix"
        succeeds(CMAKE, "--install", BUILD, "--prefix", first, folder=cls.place)
        first.rename(cls.prefix)
        cls.bendlab = cls.prefix / "bin/bendlab"
        cls.example = cls.place / "example"
        shutil.copytree(EXAMPLE, cls.example)
        cls.configured = succeeds(CMAKE, "-S", ".", "-B", "build", f"-DCMAKE_PREFIX_PATH={cls.prefix}",
                                  f"-DCMAKE_CXX_COMPILER={COMPILER}", "-DCMAKE_CXX_FLAGS=-O2 -Wall",
                                  "-DCMAKE_BUILD_TYPE=", folder=cls.example)
        cls.built = succeeds(CMAKE, "--build", "build", folder=cls.example)
        cls.program = cls.example / "build/my_cloth"
        cls.runs = lines(succeeds(cls.program, "run", "sweep.json", "--json", folder=cls.example))
        plain = json.loads((EXAMPLE / "sweep.json").read_text(encoding="utf-8"))
        plain.update(name="plain", sweep={"/bending/model": ["dihedral"]}, output={}, expect=[])
        cls.write("plain.json", plain)  # the sweep without the additions of the example

    @classmethod
    def write(cls, name, config):
        (cls.example / name).write_text(json.dumps(config), encoding="utf-8")

    @classmethod
    def tearDownClass(cls):
        cls.scratch.cleanup()

    def test_every_included_header_is_installed(self):
        folder = self.prefix / "include/bendlab"
        headers = list(folder.rglob("*.hpp"))
        self.assertGreater(len(headers), 100)
        for header in headers:
            text = header.read_text(encoding="utf-8")
            for name in re.findall(r'^\s*#\s*include\s*"([^"]+)"', text, re.MULTILINE):
                self.assertTrue((folder / name).is_file(), f"{header} includes {name}")
            # The contents of a header must not depend on the compiler flags of the program that includes it.
            self.assertNotRegex(text, r"__AVX|__SSE|__FMA", header)

    def test_no_installed_file_names_the_checkout_or_the_first_prefix(self):
        for file in (self.prefix / "lib/cmake/bendlab").iterdir():
            text = file.read_text(encoding="utf-8")
            for path in (ROOT, BUILD, self.place / "first"):
                self.assertNotIn(str(path), text, file)

    def test_the_example_builds_without_a_warning(self):
        self.assertNotIn("warning", self.built)

    def test_the_code_in_the_readme_of_the_project_runs(self):
        succeeds(self.example / "build/hang", folder=self.example)
        code = "\n".join((EXAMPLE / "hang.cpp").read_text(encoding="utf-8").splitlines()[4:10])
        self.assertIn(code, (ROOT / "README.md").read_text(encoding="utf-8"))

    def test_the_python_package_works_after_the_prefix_is_moved(self):
        packages = list(self.prefix.glob("lib*/**/python/bendlab"))
        if not (Path(BUILD) / "python").exists():
            self.skipTest("built without the Python module")
        lines_of_python = ("import bendlab as bl; cloth = bl.Scene(mesh=bl.grid(1, 1, 4)).simulate(); "
                           "cloth.run(0.1); "
                           "table = bl.run(bl.Scene(mesh=bl.grid(1, 1, 4), duration=0.1), out='of_python'); "
                           "print(cloth.positions.shape, table['status'][0], "
                           "bl.load(table['file'][0]).model)")
        done = subprocess.run([sys.executable, "-c", lines_of_python], cwd=self.example, text=True,
                              capture_output=True,
                              env={"PATH": "/usr/bin:/bin", "PYTHONPATH": str(packages[0].parent)},
                              check=False)
        self.assertEqual(done.stdout, "(25, 3) complete discrete_shells\n", done.stderr)
        self.assertTrue((packages[0] / "__init__.pyi").is_file())

    def test_the_sweep_has_its_runs_and_their_files_have_the_added_model_and_measure(self):
        self.assertEqual([(run["point"]["/bending/model"], run["point"].get("/bending/edge_hinge/power"))
                          for run in self.runs],
                         [("edge_hinge", 0), ("edge_hinge", 1), ("edge_hinge", 2), ("dihedral", None)])
        for run in self.runs:
            self.assertEqual(run["status"], "complete")
            with h5py.File(self.example / run["file"]) as file:
                self.assertEqual(json.loads(Facts(file).provenance["models"])["edge_hinge"]["label"],
                                 "edge hinge")
                rest, last = file["rest/positions"][()], self.frame(file, -1)
                # The measure equals its value from the positions in the file.
                self.assertAlmostEqual(Facts(file).summary["height"], last[:, 2].mean(), delta=1e-6)
                # The model does not move the centre of mass: n substeps of h fall by g h² n (n + 1) / 2.
                fall = self.centre(file, rest, self.frame(file, 0)) - self.centre(file, rest, last)
                np.testing.assert_allclose(fall, [0, 0, GRAVITY * DURATION * (DURATION + STEP) / 2],
                                           atol=2e-5)

    def test_the_softness_of_a_hinge_follows_the_setting_of_the_model(self):
        for run, power in zip(self.runs, (0, 1, 2)):
            with h5py.File(self.example / run["file"]) as file:
                vertices, rest = file["constraints/hinge/vertices"][()], file["rest/positions"][()]
                edges = np.linalg.norm(rest[vertices[:, 0]] - rest[vertices[:, 1]], axis=1)
                self.assertEqual(len(edges), 3 * 8**2 - 2 * 8)  # interior edges of 8² squares cut in two
                np.testing.assert_allclose(file["constraints/hinge/softness"][()], edges**-power, rtol=1e-12)

    def test_the_effect_swings_a_free_sheet_with_the_added_method_and_with_library_methods(self):
        runs = lines(succeeds(self.program, "run", "trap.json", "--json", folder=self.example))
        self.assertEqual([run["point"]["/solver/method"] for run in runs],
                         ["symplectic_euler", "newton", "pbd"])
        for run in runs:
            self.assertEqual(run["status"], "complete")
            with h5py.File(self.example / run["file"]) as file:
                                # The sheet starts at z = 1. After half a period it is at z = -1; the membrane
                                # keeps its shape.
                np.testing.assert_allclose(self.frame(file, -1), self.frame(file, 0) - [0, 0, 2], atol=5e-3)

    def test_a_model_whose_hinges_differ_in_softness_is_refused_with_k(self):
        by_k = json.dumps({"model": "edge_hinge", "k": 0.5})
        done = command(self.program, "run", "sweep.json", "--set", f"/bending={by_k}", "--set", "/sweep={}",
                       folder=self.example)
        self.assertEqual(done.returncode, 3)
        self.assertIn("/bending/stiffness", done.stderr)
        self.assertIn("softness_needs_compliance", done.stderr)

    def test_the_same_cloth_has_the_same_bits_in_the_installed_program(self):
        """Library and example differ in compiler flags; the linker keeps one copy of a common function."""
        [run] = lines(succeeds(self.bendlab, "run", "plain.json", "--json", folder=self.example))
        with h5py.File(self.example / run["file"]) as file:
            positions = file["VTKHDF/Points"][()].tobytes()
        for other in (self.runs[0], self.runs[3]):  # hinges times |e|⁰, and dihedral
            with h5py.File(self.example / other["file"]) as file:
                self.assertEqual(file["VTKHDF/Points"][()].tobytes(), positions)

    def test_a_sweep_from_code_has_the_same_results(self):
        heights = [f"{i}: height {run['summary']['height']:.9f} m" for i, run in enumerate(self.runs)]
        self.assertEqual(succeeds(self.program, folder=self.example).splitlines(), heights)

    def test_references_list_the_additions_and_are_otherwise_unchanged(self):
        for name in ("models", "effects", "methods", "measures"):
            theirs, ours = (json.loads(succeeds(program, name, "--json", folder=self.example))
                            for program in (self.program, self.bendlab))
            for method in theirs if name == "methods" else ():
                self.assertEqual(method["effects"].pop("trap"), "takes")
            self.assertEqual(theirs[:-1], ours)
            self.assertIn(theirs[-1]["name"], ("edge_hinge", "trap", "symplectic_euler", "height"))
        theirs, ours = (json.loads(succeeds(program, "schema", "--json", folder=self.example))["properties"]
                        for program in (self.program, self.bendlab))
        power = theirs["bending"]["properties"].pop("edge_hinge")["properties"]["power"]
        self.assertEqual((power["default"], power["minimum"]), (1.0, 0.0))
        self.assertEqual(theirs["bending"]["properties"]["model"]["enum"].pop(), "edge_hinge")
        self.assertEqual(theirs["output"]["properties"]["measures"]["items"]["enum"].pop(), "height")
        trap = theirs["effects"]["items"]["oneOf"].pop()["properties"]
        self.assertEqual((trap["type"]["const"], trap["frequency"]["x-unit"]), ("trap", "1/s"))
        theirs_methods, our_methods = (of["solver"]["properties"].pop("method") for of in (theirs, ours))
        self.assertEqual(theirs_methods["enum"], [*our_methods["enum"], "symplectic_euler"])
        self.assertEqual(theirs, ours)

    def test_a_wrong_name_is_refused_with_the_nearest_correct_name(self):
        self.write("wrong.json", {"name": "wrong", "output": {"measures": ["hight"]},
                                  "bending": {"model": "edge_hing", "edge_hinge": {"pwer": 2, "power": -1}}})
        done = command(self.program, "validate", "wrong.json", folder=self.example)
        self.assertEqual(done.returncode, 3)
        for place, answer in (("/bending/model", "did you mean 'edge_hinge'?"),
                              ("/bending/edge_hinge/pwer", "did you mean 'power'? Allowed here: power"),
                              ("/bending/edge_hinge/power", "expected a number of at least 0, got -1"),
                              ("/output/measures/0", "did you mean 'height'?")):
            [line] = [line for line in done.stderr.splitlines() if line.startswith(f"  {place}: ")]
            self.assertIn(answer, line)

    def test_the_installed_program_does_not_know_the_added_model_but_reads_its_runs(self):
        done = command(self.bendlab, "validate", "sweep.json", folder=self.example)
        self.assertEqual(done.returncode, 3)
        self.assertIn("edge_hinge", done.stderr)
        listed = lines(succeeds(self.bendlab, "list", "results", "--json", folder=self.example))
        self.assertLessEqual({run["id"] for run in self.runs}, {run["id"] for run in listed})

    def test_a_changed_program_computes_its_own_runs_again(self):
        changed = self.place / "changed"
        shutil.copy(self.program, changed)
        with changed.open("ab") as file:
            file.write(b"\0")  # after the last section, so the program still works

        def ids(program, config):
            planned = succeeds(program, "plan", config, "--json", folder=self.example)
            return [run["id"] for run in lines(planned)]
        self.assertEqual(ids(self.program, "sweep.json"), [run["id"] for run in self.runs])
        self.assertFalse(set(ids(changed, "sweep.json")) & set(ids(self.program, "sweep.json")))
        for program in (changed, self.program):  # runs without additions have the same id as in bendlab
            self.assertEqual(ids(program, "plain.json"), ids(self.bendlab, "plain.json"))

    def test_a_run_repeats_from_its_file(self):
        run = self.runs[1]["id"]
        repeated = json.loads(succeeds(self.program, "rerun", run, "--json", folder=self.example))
        self.assertTrue(repeated["same_bits"])
        self.assertEqual(repeated["changed"], {})

    def test_the_readme_shows_the_example(self):
        readme = (ROOT / "lib/bendlab/README.md").read_text(encoding="utf-8")
        sources = [f"{name}.cpp" for name in (*MINE, "main")]
        for name in ("mine.hpp", *sources, "CMakeLists.txt", "sweep.json"):
            self.assertIn((EXAMPLE / name).read_text(encoding="utf-8"), readme, name)

    @staticmethod
    def frame(file, index):
        """Positions of a recorded frame, #V by 3."""
        return file["VTKHDF/Points"][()].reshape(-1, len(file["rest/positions"]), 3)[index].astype(float)

    @staticmethod
    def centre(file, rest, positions):
        """Centre of mass: each vertex has a third of the area of its triangles."""
        triangles, weight = file["rest/triangles"][()], np.zeros(len(rest))
        a, b, c = (rest[triangles[:, corner]] for corner in range(3))
        np.add.at(weight, triangles, np.linalg.norm(np.cross(b - a, c - a), axis=1)[:, None])
        return weight @ positions / weight.sum()


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
