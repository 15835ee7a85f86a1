"""Tests of charts of a user's sweep: a metric over another metric, meshes by vertices, and chart files."""
import sys
import tempfile
import unittest
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "analysis"))

from bendlab.results.load import Run  # noqa: E402
from draw import chart_files  # noqa: E402
from runs.axes import axes_of, by_vertices  # noqa: E402
from runs.collected import Sweep  # noqa: E402
from sweep.charts import axis_charts, numbers_of  # noqa: E402
from sweep.number_chart import number_chart, scale_of  # noqa: E402


def run_at(point, summary, status="complete"):
    name = ",".join(map(str, point.values()))
    return Run(file=None, id=f"id-{name}", name="mine", status=status, summary=summary, point=point,
               config={"bending": {"model": point.get("/bending/model", "none")}, "solver": {"method": "pbd"},
                       "mesh": {"cells": point.get("/mesh/cells", 8)}}, metrics={"time": []},
               cpu_s=summary.get("cpu_s", 0))


def sweep_of(axes, summary):
    """A sweep over these axes. The summary of a run is summary(point)."""
    points = [{}]
    for pointer, values in axes.items():
        points = [point | {pointer: value} for point in points for value in values]
    return Sweep("mine", Path("mine"), [run_at(point, summary(point)) for point in points], axes)


def error_and_time(point):
    """An error that falls with the square of the cells, and a time that grows with this square."""
    cells = point["/mesh/cells"]
    factor = 2 if point["/bending/model"] == "lod" else 1
    return {"error": 10 / cells**2, "cpu_s": 0.001 * cells**2 * factor, "vertices": (cells + 1)**2}


ERRORS = {"/bending/model": ["none", "lod"], "/mesh/cells": [4, 8, 16]}


class NumberChart(unittest.TestCase):
    def chart(self, sweep, x="cpu_s", y="error"):
        return number_chart(sweep, axes_of(sweep)[0], x, y, "a command", "s1-asked")

    def test_each_model_has_a_curve_over_its_cells(self):
        chart = self.chart(sweep_of(ERRORS, error_and_time))
        self.assertEqual([curve["label"] for curve in chart["series"]], ["none", "lod"])
        self.assertEqual(chart["series"][0]["x"], [0.016, 0.064, 0.256])
        self.assertEqual(chart["series"][0]["y"]["error"], [0.625, 0.15625, 0.039062])  # five digits
        self.assertEqual(chart["series"][1]["x"], [0.032, 0.128, 0.512])
        self.assertEqual((chart["x"]["label"], chart["x"]["unit"]), ("CPU time of the run", "s"))
        self.assertEqual(chart["x"]["scale"], "log")  # 0.512 / 0.016 = 32
        self.assertEqual((chart["texts"], chart["series"][1]["texts"]),
                         ("cells along the width", ["4", "8", "16"]))

    def test_runs_that_differ_only_in_the_seed_become_a_median(self):
        axes = {"/mesh/cells": [4, 8], "/initial/seed": [1, 2, 3]}
        chart = self.chart(sweep_of(axes, lambda point: {
            "error": point["/initial/seed"]**2, "cpu_s": point["/mesh/cells"]}))
        self.assertEqual(chart["series"][0]["y"]["error"], [4, 4])  # median of 1, 4 and 9
        self.assertEqual([len(runs) for runs in chart["series"][0]["runs"]], [3, 3])

    def test_runs_without_the_metric_have_no_point(self):
        sweep = sweep_of(ERRORS, error_and_time)
        sweep.runs[0].summary = {"cpu_s": 1.0}
        self.assertEqual(len(self.chart(sweep)["series"][0]["x"]), 2)

    def test_a_setting_can_be_an_axis(self):
        chart = self.chart(sweep_of(ERRORS, error_and_time), "/mesh/cells", "vertices")
        self.assertEqual(chart["series"][0]["x"], [4, 8, 16])
        self.assertEqual(chart["series"][0]["y"]["vertices"], [25, 81, 289])

    def test_an_unknown_metric_is_an_error_with_the_nearest_name(self):
        with self.assertRaisesRegex(ValueError, "no run has the number 'eror'; did you mean error"):
            self.chart(sweep_of(ERRORS, error_and_time), y="eror")
        with self.assertRaisesRegex(ValueError, "/mesh/file"):
            self.chart(sweep_of(ERRORS, error_and_time), x="/mesh/file")

    def test_a_scale_is_logarithmic_from_a_factor_of_10(self):
        self.assertEqual(scale_of([1, 9.9]), "linear")
        self.assertEqual(scale_of([1, 10]), "log")
        self.assertEqual(scale_of([0, 1e6]), "linear")
        self.assertEqual(scale_of([]), "linear")


class ByVertices(unittest.TestCase):
    FILES = {"/mesh/file": ["b.obj", "a.obj", "c.obj"]}
    COUNTS = {"a.obj": 100, "b.obj": 400, "c.obj": 25}

    def test_meshes_are_drawn_over_their_number_of_vertices(self):
        sweep = sweep_of(self.FILES, lambda point: {
            "vertices": self.COUNTS[point["/mesh/file"]], "drop": 1 / self.COUNTS[point["/mesh/file"]]})
        axes, _ = axes_of(sweep)
        chart, = axis_charts(sweep, axes, numbers_of(sweep), "", "s1-")
        self.assertEqual((chart["title"], chart["x"]["scale"]), ("Against vertices", "log"))
        self.assertEqual(chart["series"][0]["x"], [25, 100, 400])
        self.assertEqual(chart["series"][0]["y"]["drop"], [0.04, 0.01, 0.0025])

    def test_meshes_with_the_same_number_of_vertices_are_drawn_by_name(self):
        sweep = sweep_of(self.FILES, lambda point: {"vertices": 100, "drop": 1})
        axis, = axes_of(sweep)[0]
        self.assertIs(by_vertices(sweep, axis), axis)

    def test_cells_are_not_replaced_by_vertices(self):
        sweep = sweep_of({"/mesh/cells": [4, 8]}, lambda point: {"vertices": point["/mesh/cells"]})
        axis, = axes_of(sweep)[0]
        self.assertIs(by_vertices(sweep, axis), axis)


class Files(unittest.TestCase):
    def test_each_chart_is_a_file_and_equal_charts_are_equal_files(self):
        sweep = sweep_of(ERRORS, error_and_time)
        axes, _ = axes_of(sweep)
        charts = [number_chart(sweep, axes, "cpu_s", "error", "", "s1-asked")]
        with tempfile.TemporaryDirectory() as name:
            for kind, begins in (("pdf", b"%PDF"), ("svg", b"<?xml"), ("png", b"\x89PNG")):
                file, = chart_files.write(charts, Path(name) / "figures", kind)
                self.assertEqual(file.name, f"error-against-CPU-time-of-the-run.{kind}")
                first = file.read_bytes()
                self.assertTrue(first.startswith(begins))
                chart_files.write(charts, Path(name) / "figures", kind)
                self.assertEqual(file.read_bytes(), first, kind)
            text = (Path(name) / "figures/error-against-CPU-time-of-the-run.svg").read_text(encoding="utf-8")
            for label in ("CPU time of the run (s)", "lod", "none"):
                self.assertIn(label, text)  # text elements, not outlines


if __name__ == "__main__":
    unittest.main()
