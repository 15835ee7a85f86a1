#!/usr/bin/env python3
"""Tests of `bendlab report` and `bendlab view` from a user's point of view: test_commands.py PROGRAM"""
import http.client
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path
from urllib.parse import urlparse

import h5py

from made import report_of, run_at, sweep_of

from runs.axes import axes_of, label_of
from runs.collected import separating
from sweep import charts, run_facts
from sweep.answer import top_html
from sweep.run_table import RunTable, explorer

PROGRAM = None
SWEEP = {"name": "some", "description": "Few runs", "duration": 0.2, "mesh": {"cells": 4},
         "pins": {"vertices": ["upper_left"]}, "output": {"frames_per_second": 20},
         "expect": [{"metric": "mean_strain", "max": 1, "why": "holds"},
                    {"metric": "drop", "min": 5, "why": "fails", "where": {"/bending/model": "none"}},
                    {"metric": "mean_strain", "min": 0, "why": "holds", "where": {
                        "/mesh/cells": 5.0, "/bending": {"model": "dihedral"}}}],
         "sweep": {"/bending/model": ["none", "dihedral"], "/mesh/cells": [4, 5]}}
LONG = {"name": "long", "duration": 600, "mesh": {"cells": 32}, "pins": {"vertices": ["upper_left"]},
        "output": {"frames_per_second": 30}}


class Place(unittest.TestCase):
    """A folder with a sweep, which is computed once for all tests."""

    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp())
        cls.environment = {key: value for key, value in os.environ.items()
                           if key not in ("DISPLAY", "WAYLAND_DISPLAY")}
        cls.environment |= {"XDG_CACHE_HOME": str(cls.folder / "cache")}
        (cls.folder / "some.json").write_text(json.dumps(SWEEP))
        done = cls.run_program("run", "some.json", "--json")
        cls.runs = [json.loads(line) for line in done.stdout.splitlines()]
        assert len(cls.runs) == 4, done.stderr

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    @classmethod
    def run_program(cls, *arguments, **environment):
        return subprocess.run([PROGRAM, *map(str, arguments)], cwd=cls.folder, capture_output=True, text=True,
                              check=False, stdin=subprocess.DEVNULL, env=cls.environment | environment,
                              timeout=120)

    def page(self, *arguments):
        """Makes a page with these arguments. Returns its data and its text."""
        done = self.run_program("report", *arguments, "-o", "page.html")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stdout, "page.html\n")
        text = (self.folder / "page.html").read_text(encoding="utf-8")
        return json.loads(re.search(r"id='bendlab-data'>(.*?)</script>", text, re.DOTALL)[1]), text

    def wrong(self, *arguments, code=2):
        done = self.run_program(*arguments)
        self.assertEqual((done.returncode, done.stdout), (code, ""))
        return done.stderr


class Report(Place):
    def test_the_page_is_written_next_to_its_runs(self):
        done = self.run_program("report", "results/some")
        self.assertEqual((done.stdout, done.stderr), ("results/some/report.html\n", ""))
        self.assertTrue((self.folder / "results/some/report.html").exists())
        run = Path(self.runs[0]["file"])
        self.assertEqual(self.run_program("report", run).stdout, f"{run.parent / 'report.html'}\n")
        self.assertEqual(self.run_program("report", run, Path(self.runs[1]["file"]).parent).stdout,
                         "results/some/report.html\n")

    def test_a_config_stands_for_its_sweep_and_its_folder_is_not_changed(self):
        done = self.run_program("report", "some.json")
        self.assertEqual((done.stdout, done.stderr), ("results/some/report.html\n", ""))
        self.assertFalse((self.folder / "report.html").exists())
        (self.folder / "new.json").write_text('{"name": "new"}')
        self.assertIn("'bendlab run new.json' computes them", self.wrong("report", "new.json"))
        (self.folder / "new.json").unlink()

    def test_charts_are_written_as_files(self):
        done = self.run_program("report", "results/some", "--figures", "svg")
        self.assertRegex(done.stdout, "results/some/report.html\nresults/some/figures: [0-9]+ figures\n")
        drawn = {file.name for file in (self.folder / "results/some/figures").iterdir()}
        self.assertIn("drop-against-cells-along-the-width.svg", drawn)
        shutil.rmtree(self.folder / "results/some/figures")

    def test_a_chart_of_one_metric_over_another(self):
        axes = ("--x", "ms_per_frame", "--y", "drop")
        data, _ = self.page("results/some", *axes)
        chart = data["charts"][0]
        self.assertEqual((chart["id"], chart["x"]["name"], [y["name"] for y in chart["ys"]]),
                         ("s1-asked", "ms_per_frame", ["drop"]))
        drops = {entry["id"]: entry["summary"]["drop"] for entry in self.runs}
        for series in chart["series"]:
            for run, drop in zip(series["runs"], series["y"]["drop"]):
                self.assertAlmostEqual(drop, drops[run[0]], 4)
        done = self.run_program("report", "results/some", *axes, "--figures", "pdf")
        self.assertEqual(done.stdout.splitlines()[1],
                         "results/some/figures/drop-against-CPU-time-per-frame.pdf")
        error = self.wrong("report", "results/some", "--x", "dropp", "--y", "drop")
        self.assertIn("did you mean drop", error)
        self.assertIn("--y", self.wrong("report", "results/some", "--x", "drop"))
        shutil.rmtree(self.folder / "results/some/figures")

    def test_the_page_has_every_run_of_a_sweep(self):
        data, text = self.page("results/some")
        self.assertEqual({run["id"] for run in data["runs"]}, {run["id"] for run in self.runs})
        self.assertEqual([chart["id"] for chart in data["charts"]],
                         ["s1-against-1", "s1-against-2", "over-time", "s1-passes"])
        self.assertIn("Few runs", text)
        self.assertIn("./bendlab report results/some -o page.html", text)

    def test_a_run_can_be_named_by_its_file_its_folder_and_its_id(self):
        run = self.runs[0]
        for name in (run["file"], Path(run["file"]).parent, run["id"], run["id"][:12]):
            data, _ = self.page(name)
            self.assertEqual([entry["id"] for entry in data["runs"]], [run["id"]])
            self.assertIn(f"./bendlab rerun {run['file']}", data["runs"][0]["command"])

    def test_expectations_agree_with_those_of_the_run_command(self):
        from runs.collected import collect
        from runs.expectations import check
        sweep = collect([self.folder / "results/some"])[0]
        for run, printed in zip(sweep.runs, self.runs):
            self.assertEqual(run.id, printed["id"])
            self.assertEqual([(result.metric, result.holds) for result in check(sweep.settings, run)],
                             [(result["metric"], result["holds"]) for result in printed["expectations"]])
        _, text = self.page("results/some")
        self.assertIn("5 of 7 expectations hold", text)
        self.assertIn("fails in 2 of 2", text)

    def test_the_command_of_a_run_computes_that_run(self):
        data, _ = self.page("results/some")
        for entry in data["runs"]:
            words = subprocess.run(["bash", "-c", f'printf "%s\\n" {entry["command"]}'], capture_output=True,
                                   text=True,
                                   check=True).stdout.splitlines()
            plan = self.run_program("plan", *words[2:], "--json")
            self.assertEqual([json.loads(line)["id"] for line in plan.stdout.splitlines()], [entry["id"]])

    def test_without_a_sweep_file_the_axes_follow_from_the_runs(self):
        shutil.copytree(self.folder / "results/some", self.folder / "copy",
                        ignore=shutil.ignore_patterns("*.json"))
        data, _ = self.page("copy")
        self.assertEqual(len(data["runs"]), 4)
        self.assertEqual([chart["x"]["name"] for chart in data["charts"][:2]],
                         ["/mesh/cells", "/bending/model"])

    def test_the_page_lists_missing_and_damaged_runs(self):
        shutil.copytree(self.folder / "results/some", self.folder / "less")
        places = [Path(run["file"]).parent.name for run in self.runs]
        shutil.rmtree(self.folder / "less" / places[0])
        damaged = self.folder / "less" / places[1] / "run.vtkhdf"
        content = bytearray(damaged.read_bytes())
        content[len(content) // 2] ^= 1
        damaged.write_bytes(content)
        data, text = self.page("less")
        status = {run["id"]: run["status"] for run in data["runs"]}
        self.assertEqual([status[run["id"]] for run in self.runs],
                         ["missing", "unreadable", "complete", "complete"])
        self.assertIn("was changed", text)

    def test_the_page_states_the_cause_of_an_implausible_run(self):
        torn = {"name": "torn", "defaults": "paper", "allow": ["implausible"], "duration": 1,
                "mesh": {"cells": 32},
                "bending": {"model": "none"}, "pins": {"vertices": ["upper_right"], "ring": 0},
                "solver": {"iterations": 10, "substeps": 1}, "material": {"strain": {"form": "normalised"}},
                "initial": {"perturbation": 1e-6}}
        (self.folder / "torn.json").write_text(json.dumps(torn))
        run = json.loads(self.run_program("run", "torn.json", "--json").stdout)
        self.assertEqual(run["status"], "implausible")
        data, text = self.page("results/torn")
        self.assertEqual(data["runs"][0]["worst"]["limit"], float(f"{run['implausible']['limit']:.5g}"))
        self.assertFalse(data["runs"][0]["worst"]["held"])
        self.assertIn("broke the bound on", text)

    def test_a_page_of_several_results(self):
        (self.folder / "other.json").write_text(json.dumps(SWEEP | {"name": "other", "sweep": {},
                                                                    "expect": []}))
        self.run_program("run", "other.json")
        data, text = self.page("results/some", "results/other")
        self.assertEqual(len(data["runs"]), 5)
        self.assertEqual(self.run_program("report", "results/some", "results/other").stdout,
                         "results/report.html\n")
        self.assertIn("<th class='t choose'>sweep</th>", text)

    def test_runs_in_the_player_can_be_chosen_by_id(self):
        data, _ = self.page("results/some", "--play", self.runs[2]["id"][:10])
        chart = next(chart for chart in data["charts"] if chart["id"] == "over-time")
        self.assertEqual([series["run"] for series in chart["series"]], [self.runs[2]["id"]])
        error = self.wrong("report", "results/some", "--play", "none such")
        self.assertIn("--play none such: no run", error)
        self.assertIn(self.runs[0]["id"], error)

    def test_an_error_on_a_missing_result_names_existing_results(self):
        self.assertIn("did you mean 'results/some'?", self.wrong("report", "results/sme"))
        self.assertIn("did you mean 'results/some'?", self.wrong("view", "smoe"))
        self.assertIn("bendlab list results", self.wrong("report", "far"))
        (self.folder / "empty").mkdir(exist_ok=True)
        self.assertIn("'empty'", self.wrong("report", "empty"))
        (self.folder / "text").write_text("no run")
        self.assertIn("not an HDF5", self.wrong("report", "text"))
        with h5py.File(self.folder / "foreign.h5", "w") as file:
            file["a"] = 1
        self.assertIn("not a run file", self.wrong("report", "foreign.h5"))
        self.assertIn("RESULT is required", self.wrong("report"))

    def test_the_error_of_a_damaged_sweep_file_names_the_file(self):
        (self.folder / "bad").mkdir()
        for text in ("not json", '{"experiment": 3}'):
            (self.folder / "bad/bad.sweep.json").write_text(text)
            self.assertIn("bad.sweep.json", self.wrong("report", "bad/bad.sweep.json"))

    def test_a_result_that_is_named_twice_is_shown_once(self):
        data, text = self.page("results/some", "results/some/", self.runs[0]["file"], self.runs[0]["file"])
        self.assertEqual(len(data["runs"]), 4)
        self.assertNotIn("<th class='t choose'>sweep</th>", text)

    def test_the_files_of_a_sweep_are_one_sweep(self):
        data, _ = self.page(*(run["file"] for run in self.runs))
        self.assertEqual([chart["x"]["name"] for chart in data["charts"][:2]],
                         ["/mesh/cells", "/bending/model"])

    def test_a_diverged_run_is_infinite_and_meets_no_expectation(self):
        wild = {**SWEEP, "name": "wild", "solver": {"method": "pbd"}, "effects": [{"type": "gravity"}],
                "sweep": {"/effects/0/acceleration": [[0, 0, -9.81], [0, 0, -1e30]]},
                "expect": [{"metric": "mean_strain", "max": 1, "why": "cloth"}]}
        (self.folder / "wild.json").write_text(json.dumps(wild))
        self.run_program("run", "wild.json")
        data, text = self.page("results/wild")
        self.assertEqual(data["charts"][0]["series"][0]["y"]["mean_strain"][1], "∞")
        self.assertEqual((data["runs"][1]["worst"]["value"], data["runs"][1]["worst"]["held"]), ("∞", False))
        self.assertEqual(data["runs"][1]["summary"]["pinned_vertices"],
                         data["runs"][0]["summary"]["pinned_vertices"])
        self.assertIn("1 of 2 expectations hold", text)

    def test_failed_runs_are_not_called_missing(self):
        (self.folder / "flaws.json").write_text(json.dumps(
            {"name": "flaws", "mesh": {"flaw": "duplicate_faces"}, "sweep": {"/mesh/cells": [4, 5]}}))
        self.run_program("run", "flaws.json", "--out", "far off")
        done = self.run_program("report", "far off/flaws", "-o", "page.html", "--x", "drop", "--y", "cpu_s")
        self.assertIn("cpu_s against drop", done.stderr)
        data, text = self.page("far off/flaws")
        self.assertEqual([run["status"] for run in data["runs"]], ["failed", "failed"])
        self.assertTrue(all(run["command"].endswith("--out 'far off'") for run in data["runs"]))
        self.assertNotIn("id='explorer'", text)
        self.assertNotIn("no sweep file lists", text)

    def test_the_error_of_a_page_that_cannot_be_written(self):
        (self.folder / "file").write_text("")
        error = self.wrong("report", "results/some", "-o", "file/page.html", code=5)
        self.assertRegex(error, "could not be written to file/page.html: .*Name another file with -o")

    def test_help_and_completion_of_the_commands(self):
        for command, example in (("report", "-o both.html"), ("view", "--play cells=16")):
            self.assertIn(example, self.run_program(command, "--help").stdout)
            self.assertRegex(self.run_program("completion", "bash").stdout,
                             rf"    {command}\) options='.*--play")


class View(Place):
    def test_the_page_is_written_to_the_cache_and_opened(self):
        tools = self.folder / "tools"
        tools.mkdir()
        opener = tools / "xdg-open"
        opener.write_text(f"#!/bin/sh\nprintf '%s\\n' \"$@\" > '{self.folder}/opened'\n")
        opener.chmod(0o755)
        path = f"{tools}:{os.environ['PATH']}"
        done = self.run_program("view", "results/some", DISPLAY=":9", PATH=path)
        page = Path(done.stdout.strip())
        self.assertEqual(page.parent, self.folder / "cache/bendlab")
        self.assertTrue(page.exists())
        self.assertEqual((self.folder / "opened").read_text(), f"{page.as_uri()}\n")
        self.assertEqual(self.run_program("view", "results/some", "--no-open").stdout, done.stdout)

    def test_without_a_browser_the_command_prints_the_path_of_the_page(self):
        done = self.run_program("view", "results/some", "-o", "watch.html")
        self.assertEqual((done.returncode, done.stdout), (0, "watch.html\n"))
        self.assertIn("no browser", done.stderr)

    def test_live_needs_exactly_one_run(self):
        self.assertIn("--live shows one run", self.wrong("view", "results/some", "results/some", "--live"))

    def ask(self, address, path=None, host=None):
        parts = urlparse(address)
        connection = http.client.HTTPConnection(parts.hostname, parts.port, timeout=60)
        try:
            connection.request("GET", path or parts.path, headers={"Host": host or parts.netloc})
            answer = connection.getresponse()
            return answer.status, answer.read()
        finally:
            connection.close()

    def test_a_run_in_progress_is_served_and_its_frames_increase(self):
        (self.folder / "long.json").write_text(json.dumps(LONG))
        run = subprocess.Popen([PROGRAM, "run", "long.json"], cwd=self.folder, stdout=subprocess.DEVNULL,
                               stderr=subprocess.DEVNULL)
        self.addCleanup(run.wait)
        self.addCleanup(run.kill)
        until = time.monotonic() + 60
        while not list(self.folder.glob("results/long/*/run.vtkhdf*.part")) and time.monotonic() < until:
            time.sleep(0.1)
        time.sleep(2)
        server = subprocess.Popen([PROGRAM, "view", "results/long", "--live", "--no-open"], cwd=self.folder,
                                  stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
                                  env=self.environment)
        self.addCleanup(server.wait)
        self.addCleanup(server.kill)
        self.addCleanup(server.stdout.close)
        address = server.stdout.readline().strip()
        parts = urlparse(address)
        self.assertEqual(parts.hostname, "127.0.0.1")
        self.assertGreaterEqual(len(parts.path), 30)
        status, page = self.ask(address)
        self.assertEqual(status, 200)
        self.assertIn(b"The run goes on.", page)
        self.assertIn(b"connect-src 'self'", page)
        self.assertEqual(self.ask(address, "/")[0], 404)
        self.assertEqual(self.ask(address, host="evil.example")[0], 404)
        first = json.loads(self.ask(address, f"{parts.path}frames")[1])
        self.assertEqual((first["status"], first["duration"]), ("running", 600))
        later, until = first, time.monotonic() + 60
        while later["frames"] == first["frames"] and time.monotonic() < until:
            time.sleep(0.5)
            later = json.loads(self.ask(address, f"{parts.path}frames")[1])
        self.assertGreater(later["frames"], first["frames"])
        self.assertGreater(later["time"], first["time"])
        self.assertEqual(later["run"]["frames"]["recorded"], later["frames"])
        run_file = next((self.folder / "results/long").glob("*/run.vtkhdf*.part"))
        for result in ("results/long", run_file):
            data, text = Place.page(self, result)
            self.assertEqual(data["runs"][0]["status"], "running")
            self.assertNotIn("no sweep file lists", text)
        run.kill()
        run.wait()
        while later["status"] == "running" and time.monotonic() < until:
            time.sleep(0.5)
            later = json.loads(self.ask(address, f"{parts.path}frames")[1])
        self.assertEqual(later["status"], "interrupted")
        self.assertIn(b"The run was stopped.", self.ask(address)[1])
        server.send_signal(signal.SIGINT)
        self.assertEqual(server.wait(timeout=20), 130)


class Made(unittest.TestCase):
    """Pages of invented runs."""

    def test_labels_name_values_that_do_not_explain_themselves(self):
        objects = [[], [{"type": "gravity"}], [{"type": "gravity"}, {"type": "wind", "velocity": [0, 3, 0]}]]
        axes = axes_of(sweep_of([], {"/effects": objects, "/mesh/jitter": [None, 0.1], "/a/on": [True, False],
                                     "/bending/model": ["none", "lod"]}))[0]
        self.assertEqual([axis.texts for axis in axes[:2]],
                         [["none", "gravity", "gravity, wind, velocity 0 3 0"], ["absent", "0.1"]])
        run = run_at({"/effects": [], "/mesh/jitter": None, "/a/on": True, "/bending/model": "none"})
        self.assertEqual(label_of(run, axes), "none, effects none, jitter absent, on yes")

    def test_the_chart_of_a_covering_array_begins_at_a_run(self):
        axes = {"/mesh/cells": [4, 8], "/bending/model": ["lod", "none"], "/a": [1, 2, 3], "/b": [1, 2, 3]}
        runs = [run_at(dict(zip(axes, values)), {"drop": values[0]})
                for values in ((4, "lod", 1, 3), (8, "lod", 1, 3), (4, "none", 2, 1), (8, "none", 3, 2))]
        chart = report_charts(sweep_of(runs, axes))[0]
        self.assertEqual([held["at"] for held in chart["held"]], [0, 2])

    def test_runs_with_different_seeds_are_counted(self):
        axes = {"/mesh/cells": [4], "/a/seed": [1, 2, 3], "/b/seed": [1, 2, 3]}
        runs = [run_at({"/mesh/cells": 4, "/a/seed": a, "/b/seed": b, "/x": x}, {"drop": a + b + x})
                for a in (1, 2, 3) for b in (1, 2, 3) for x in (1, 2)]
        chart = report_charts(sweep_of(runs, axes | {"/x": [1, 2]}))[0]
        self.assertEqual(chart["note"], "Median and range over 9 runs with different seeds.")

    def test_the_explorer_has_settings_that_differ_between_experiments(self):
        one = sweep_of([run_at({"/mesh/cells": c}, {"drop": c}) for c in (4, 8)], {"/mesh/cells": [4, 8]})
        other = sweep_of([run_at({}, {"drop": 1}, config={"bending": {"model": "lod"}, "mesh": {}})], {})
        other.name = "other"
        self.assertEqual(separating([*one.runs, *other.runs]), ["/bending/model", "/mesh/cells"])
        made = explorer(report_of(one, other))
        self.assertEqual([axis["texts"] for axis in made["axes"]], [["adaptive", "lod"], ["4", "8"]])
        self.assertEqual(made["places"]["one"], [1, None])

    def test_equal_metrics_are_in_the_table_but_not_in_charts(self):
        runs = [run_at({"/mesh/cells": c}, {"springs": 68.0, "drop": 1 + 1e-5 * c}) for c in (4, 8)]
        sweep = sweep_of(runs, {"/mesh/cells": [4, 8]})
        report = report_of(sweep)
        self.assertIn("data-v='68'>68</td>", RunTable(report).html())
        self.assertIn("<b>1.0000</b> (cells 4) to <b>1.0001</b>", top_html(report))
        self.assertEqual([number["name"] for number in charts.numbers_of(sweep)], ["drop"])

    def test_a_missing_run_differs_in_its_point_and_not_in_defaults(self):
        whole = [run_at({"/mesh/cells": c}, id=str(c)) for c in (4, 8)]
        missing = run_at({}, status="missing", config={"mesh": {"cells": 5}})
        settings = run_facts.Settings([*whole, missing])
        self.assertEqual(settings.changes(missing), {"/mesh/cells": [5]})

    def test_a_metric_that_the_run_lacks_is_not_infinite(self):
        worst = run_facts.worst(run_at({}, {"drop": 1.0}), sweep_of([], {}, {"expect": [
            {"metric": "other", "max": 1}]}))
        self.assertEqual((worst["value"], worst["text"], worst["held"]), (None, "not measured", False))

    def test_the_page_says_which_axes_it_leaves_out(self):
        axes = {f"/axis_{i}": [1, 2] for i in range(9)}
        runs = [run_at(dict.fromkeys(axes, value), {"drop": value}) for value in (1, 2)]
        report = report_of(sweep_of(runs, axes))
        self.assertIn("The table leaves out axis 8.", RunTable(report).html())
        self.assertIn("No chart is drawn against axis 8.", next(report._against()).body)


def report_charts(sweep):
    return charts.axis_charts(sweep, axes_of(sweep)[0], charts.numbers_of(sweep), "", "s1-")


if __name__ == "__main__":
    PROGRAM = str(Path(sys.argv.pop(1)).resolve())
    unittest.main()
