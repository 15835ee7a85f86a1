"""Tests of the page on the performance of the solver, on invented rows with known results."""
import json
import re
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "analysis"))
from figures.performance import effects, history, kinds, laws, limits, methods, order  # noqa: E402
from figures.performance import overview, set_up, sizes, threads  # noqa: E402
from figures.performance.rows import iterations, lacking, per_vertex, series, shown, usual  # noqa: E402
from pages import performance, project  # noqa: E402
from tables.section import Section  # noqa: E402

CONTEXT = {"schema_version": 1, "date": "2001-02-03T04:05:06Z", "host": "a host", "processor": "a processor",
           "compiler": "a compiler", "flags": "-O3", "build_type": "Release", "vector_bits": 128,
           "version": "1.2.3", "git_commit": "0123456789abcdef", "git_dirty": False, "source_hash": "fedcba",
           "triad_16_KiB_GB_per_s": 300.0, "peak_float_Gflop_per_s": 200.0}


def row_of(name, vertices=100, constraints=100, ns=1.0, scalar="float", threads=1, ratio=None, roofline=None,
           **more):
    """A row with the median `ns`, the lowest value ns / 2 and the highest value 2 ns."""
    return {"name": name, "scalar": scalar, "threads": threads, "vertices": vertices,
            "constraints": constraints, "ns_per_constraint": ns, "ns_lowest": ns and ns / 2,
            "ns_highest": ns and 2 * ns, "repetitions": 7 if ns else 0, "ratio_to_oracle": ratio,
            "roofline_fraction": roofline, **more}


def order_row(scene, sweeps, match, colour, mesh=0.1):
    return row_of(f"convergence/{scene}/{sweeps}", ns=None, scalar="double", sweeps=sweeps,
                  sweeps_to_match=match, strain_error_mesh=mesh, strain_error_colour=colour,
                  strain_error_from_pins=mesh, strain_error_to_pins=mesh, strain_error_colour_from_pins=mesh,
                  colour_over_mesh=colour / mesh)


# A step has 4 iterations with 200 triangles of 5 ns and 300 springs of 2 ns: 4 (1000 + 600) ns.
KERNELS = [row_of("strain/10", constraints=200, ns=5.0, ratio=30.0, roofline=0.25),
           row_of("crossover/10", constraints=300, ns=2.0, ratio=20.0, roofline=0.5),
           row_of("crossover/100", vertices=10000, constraints=30000, ns=6.0, ratio=5.0, roofline=0.75),
           row_of("crossover_oracle/10", constraints=300, ns=40.0, roofline=0.01),
           row_of("dense/10", constraints=1000, ns=2.5, ratio=16.0, roofline=0.5),
           row_of("step/10", constraints=500, ns=3.2, ratio=25.0, step_ms=0.0064),
           row_of("step/10", constraints=500, ns=1.6, threads=2, step_ms=0.0032),
           row_of("step/10", constraints=500, ns=6.4, ratio=8.0, scalar="double", step_ms=0.0128)]
EFFECTS = [row_of("effect/wind/10", ns=8.0, acted_per_step=50.0, per_action_ns=16.0, share_of_step=0.1),
           row_of("effect/wind/100", vertices=10000, constraints=10000, ns=40.0, acted_per_step=5000.0,
                  per_action_ns=80.0, share_of_step=0.2),
           row_of("effect/gravity/10", ns=1.0, acted_per_step=0.0, share_of_step=0.01)]
SET_UP = [row_of("set_up/10", constraints=100000, ns=100.0, set_up_s=0.01, rings_and_pairs_s=0.002,
                 colours_and_batches_s=0.008, springs_per_s=1e7, peak_bytes_per_spring=40.0)]
ORDER = [order_row("corner", 1, 5, 0.12), order_row("corner", 10, 20, 0.11), order_row("strip", 1, 9, 0.09),
         order_row("strip", 10, 0, 0.15)]
BESIDE = [row_of("recording/10", threads=2, ns=3.0, wall_ratio=1.25, wall_ratio_lowest=1.1,
                 wall_ratio_highest=1.5, wall_s=1.0, writer_cpu_s=0.1),
          row_of("sweep/10", threads=2, ns=3.0, speed_up=1.75, speed_up_lowest=1.5, speed_up_highest=2.0,
                 wall_s=1.0)]
# ns per vertex: 30 for pbd; 60 for quasi_newton, including 24 for the solve and 5 · 2 for the gradient.
METHODS = [row_of("method/pbd/10", ns=30.0, step_ms=0.03),
           row_of("method/quasi_newton/10", ns=60.0, step_ms=0.06, roofline=0.5),
           row_of("method/quasi_newton/10", ns=40.0, threads=2, step_ms=0.04),
           row_of("solve/10", ns=24.0, ratio=3.0, roofline=0.6),
           row_of("gradient/10", constraints=500, ns=2.0, ratio=40.0, roofline=0.4),
           row_of("method/newton/10", ns=9000.0, scalar="double", step_ms=2.0),
           row_of("solve_oracle/10", ns=72.0, scalar="double")]
LAWS = [row_of("law/pbd/mid_edge/one_rigidity/10", ns=10.0, step_ms=2.0),
        row_of("law/pbd/mid_edge/friction/10", ns=15.0, step_ms=3.0),
        row_of("law/pbd/mid_edge/over_time/10", ns=11.0, step_ms=2.2)]
EVERYTHING = [*KERNELS, *METHODS, *LAWS, *EFFECTS, *SET_UP, *ORDER, *BESIDE]


class MeasureTest(unittest.TestCase):
    def table(self, rows=KERNELS):
        return series(rows)

    def test_rows_are_grouped_by_kind_and_precision_and_sorted_by_size(self):
        table = self.table(list(reversed(EVERYTHING)))
        self.assertEqual([row["vertices"] for row in table["crossover", "float"]], [100, 10000])
        self.assertEqual(len(table["step", "float"]), 1)  # one thread only
        self.assertEqual(len(table["effect/wind", "float"]), 2)
        self.assertNotIn("convergence/corner", {kind for kind, _ in table})  # not timed

    def test_the_cost_per_vertex_is_the_cost_of_its_constraints(self):
        strain, spring = KERNELS[:2]
        self.assertEqual(per_vertex(strain), 10)  # two triangles of 5 ns
        self.assertEqual(per_vertex(spring, "ns_highest"), 12)  # three springs of 4 ns

    def test_the_iterations_of_a_step_follow_from_its_time(self):
        self.assertEqual(iterations(KERNELS), 4)
        self.assertIsNone(iterations(EFFECTS))

    def test_the_usual_size_is_the_size_of_most_kinds(self):
        self.assertEqual(usual(self.table()), 100)
        self.assertIsNone(usual(self.table(EFFECTS)))

    def test_the_title_of_the_laws_names_the_slowest_law(self):
        section = Section("laws", "")
        laws.main({"rows": LAWS}, None, section)
        self.assertEqual([row["times"] for row in section.tables[0].rows], [1, 1.5, 1.1])
        self.assertEqual(section.charts[0].title,
                         "Over the time of a step with one rigidity, a step takes at most 1.50 with pbd "
                         "(friction, mid_edge)")

    def test_kinds_without_a_row_are_listed(self):
        lines = lacking(self.table(), ["strain", "dihedral"])
        self.assertEqual(lines, ["single precision: dihedral",
                                 "double precision: strain triangles, dihedral"])

    def test_the_title_of_the_sizes_compares_kinds_with_both_sizes(self):
        title = sizes.title(self.table())
        self.assertIn("3.00 for crossover springs (single precision)", title)
        self.assertNotIn("3.00", sizes.title(self.table(KERNELS[:1])))

    def test_all_parts_of_a_step_have_the_same_unit(self):
        parts = [(part.group, part.name, part.ns) for part in overview.parts(EVERYTHING)]
        self.assertEqual(parts, [("strain", "strain triangles", 40), ("bending", "adaptive springs", 100),
                                 ("bending", "crossover springs", 24), ("effects", "wind", 8),
                                 ("effects", "gravity", 1)])
        self.assertEqual(overview.parts(EFFECTS), [])

    def test_the_answer_and_the_title_of_the_overview(self):
        self.assertEqual(overview.answer(EVERYTHING),
                         "One step with 4 iterations of a cloth with 100 vertices and crossover springs "
                         "takes 0.0064 ms on one thread. Each vertex takes 64.0 ns: 40.0 ns for the "
                         "strain of the triangles and 24.0 ns for the springs.")
        title = overview.title(overview.parts(EVERYTHING))
        self.assertIn("0.60 (crossover springs) to 2.5 (adaptive springs)", title)
        self.assertIn("wind, takes 0.20", title)

    def test_kinds_are_compared_at_the_same_size(self):
        self.assertEqual(kinds.title(self.table()),
                         "A bending constraint costs 2.0 to 2.5 ns. All bending constraints of a model cost "
                         "6.0 to 25 ns per vertex (single precision, 100 vertices)")
        self.assertEqual(limits.title(self.table()),
                         "The kernels are 16 to 30 times as fast as the oracle and reach 25 to 50 % of "
                         "the roofline (single precision, 100 vertices)")

    def test_an_iteration_of_quasi_newton_is_compared_with_its_solve(self):
        table = self.table(METHODS)
        self.assertEqual(methods.title(table),
                         "An iteration of quasi_newton costs 60.0 ns per vertex, 2.00 times an iteration of "
                         "pbd; the solve takes 40 % of it (single precision, 100 vertices)")
        self.assertNotIn("costs", methods.title(self.table(METHODS[:3])))
        self.assertEqual(methods.threads_gain(METHODS, METHODS[1]), 1.5)
        self.assertIsNone(methods.threads_gain(METHODS, METHODS[0]))

    def test_the_title_names_the_effect_whose_cost_grows_most(self):
        by_effect = effects.by_effect(EVERYTHING)
        self.assertEqual(list(by_effect), ["wind", "gravity"])  # the most expensive first
        self.assertIn("1 of 1 effects", effects.title(by_effect))
        self.assertIn("5.0 (wind)", effects.title(by_effect))

    def test_the_known_effects_are_effects_of_the_program(self):
        known = effects.known_effects()
        files = {path.stem for path in (ROOT / "lib/bendlab/effects").glob("*.cpp")}
        self.assertIn("gravity", known)
        self.assertLessEqual(set(known), files)

    def test_the_time_of_set_up_in_steps(self):
        # 100 ns per spring, divided by 4 iterations of 2.5 ns.
        self.assertEqual(set_up.steps_text(SET_UP), "")
        self.assertIn("in 10 steps",
                      set_up.steps_text(EVERYTHING))
        self.assertEqual(set_up.title(SET_UP),
                         "Setting up 100,000 springs takes 0.010 s: 100 ns and 40 bytes for each spring")

    def test_order_by_colour_is_sooner_if_its_speed_makes_up_for_its_iterations(self):
        # Order by colour needs 5, 2 and 9 times as many iterations, or never reaches the error of list order.
        # An iteration in order by colour is 8 times as fast.
        self.assertEqual([order.more(row) for row in ORDER], [5, 2, 9, None])
        self.assertIn("2 of 4", order.time_text(EVERYTHING))
        self.assertEqual(order.time_text(ORDER), "")
        self.assertEqual(order.title(order.by_scene(ORDER)),
                         "Order by colour changes the error by −10 to 50 %. To reach the error of list "
                         "order, order by colour needs 2.0 to 9.0 times as many iterations")

    def test_the_gain_of_threads(self):
        steps = threads.by_precision(EVERYTHING)
        gains = [threads.gain(steps["float"], row) for row in steps["float"]]
        self.assertEqual(gains, [1, 2])
        self.assertIn("2.0 times (single precision)", threads.title(steps))
        self.assertIn("(1.50 to 2.00)", threads.beside_text(BESIDE))


class PageTest(unittest.TestCase):
    def page(self, rows, **context):
        """Writes the page of these rows. Returns its text, its charts by id, and its summary.json."""
        with tempfile.TemporaryDirectory() as folder:
            out = Path(folder)
            file = out / "bench.json"
            file.write_text(json.dumps({"context": {**CONTEXT, **context}, "rows": rows}), encoding="utf-8")
            project.lay_out(performance.PAGE, out, project.draw(performance.PAGE, file, out))
            text = (out / "index.html").read_text(encoding="utf-8")
            data = re.search("<script type='application/json' id='bendlab-data'>(.*?)</script>", text, re.S)
            charts = {chart["id"]: chart for chart in json.loads(data[1])["charts"]}
            self.assertEqual(len(charts), text.count("data-chart="))
            self.assertEqual(set(re.findall(r"<img src='([^']+)'", text)),
                             {f"{name}.png" for name in charts})
            for name in charts:
                self.assertTrue((out / f"{name}.png").is_file(), name)
            return text, charts, json.loads((out / "summary.json").read_text(encoding="utf-8"))

    def test_every_row_is_on_the_page_and_in_the_summary(self):
        text, charts, rows = self.page(EVERYTHING)
        self.assertEqual(len(rows), len(EVERYTHING))
        self.assertIn("not timed at 10,000 vertices: gravity (100)", text)
        self.assertEqual([row["ns_per_vertex"] for row in rows[:2]], [10, 6])
        self.assertIsNone(next(row for row in rows if row["name"] == "convergence/corner/1")["ns_per_vertex"])
        timed = len(EVERYTHING) - len(ORDER)
        self.assertIn(f"All {timed} timed rows", text)
        self.assertEqual(list(charts), ["step", "sizes", "kinds", "limits", "methods", "effects", "laws",
                                        "set_up", "order", "threads", "history"])
        # The answer comes first.
        self.assertLess(text.index("0.0064 ms on one thread"), text.index("data-chart="))

    def test_charts_have_the_numbers_of_the_rows(self):
        _, charts, _ = self.page(EVERYTHING)
        series_of = lambda name: {curve["label"]: curve for curve in charts[name]["series"]}
        step = series_of("step")
        self.assertEqual(charts["step"]["x"]["categories"], ["strain triangles", "adaptive springs",
                                                             "crossover springs", "wind", "gravity"])
        self.assertEqual([(step[group]["x"], step[group]["y"]["ns"]) for group in overview.GROUPS],
                         [([0], [40]), ([1, 2], [100, 24]), ([3, 4], [8, 1])])
        spring = series_of("sizes")["crossover springs, single"]
        self.assertEqual((spring["x"], spring["y"]), ([100, 10000], {"ns": [2, 6], "vertex": [6, 18]}))
        self.assertEqual((spring["low"]["ns"], spring["high"]["vertex"]), ([1, 3], [12, 36]))
        strain = series_of("limits")["single, 100 vertices"]
        self.assertEqual([strain["y"][name][0] for name in ("ratio", "share")], [30, 25])
        self.assertEqual(series_of("effects")["10,000 vertices"]["y"]["vertex"], [40])
        self.assertEqual(charts["effects"]["limits"][0]["value"], 64)  # a whole step
        parts, = charts["set_up"]["rows"]
        self.assertEqual(parts["values"], [20, 80])  # a fifth and four fifths of 100 ns
        error, places = charts["order"]["series"], charts["order"]["held"][0]["values"]
        corner = next(curve for curve in error if curve["label"] == "by colour" and curve["held"] == [0])
        self.assertEqual(places[0], order.SCENES["corner"])
        self.assertEqual((corner["x"], corner["y"]), ([1, 10], {"change": [20, 10], "more": [5, 2]}))
        gains = series_of("threads")
        self.assertEqual((gains["single"]["y"], gains["double"]["y"]),
                         ({"ms": [0.0064, 0.0032], "gain": [1, 2]}, {"ms": [0.0128], "gain": [1]}))

    def test_a_row_is_shown_from_lowest_to_highest(self):
        row = shown(KERNELS[1])
        self.assertEqual([row[name] for name in ("ns_low", "ns", "ns_high", "range")], [1, 2, 4, (1, 4)])
        self.assertEqual([row[name] for name in ("vertex_low", "vertex", "vertex_high")], [3, 6, 12])
        self.assertEqual([row[name] for name in ("precision", "per_vertex", "ratio", "share")],
                         ["single", 3, 20, 50])

    def test_the_page_names_the_machine_and_the_program(self):
        text, *_ = self.page(KERNELS)
        self.assertIn("Measured on 2001-02-03 on one machine: a processor, 128-bit vectors, a compiler, "
                      "commit 0123456789ab without further changes", text)
        self.assertIn("<td class='t'>bandwidth on 16 KiB</td><td class='t'>300 GB/s</td>", text)
        self.assertIn("with changes that are not committed", self.page(KERNELS, git_dirty=True)[0])

    def test_rows_of_a_single_family_make_a_page(self):
        for rows, names in [(KERNELS[:1], "sizes kinds limits history"), (KERNELS[3:4], ""),
                            (KERNELS[5:6], "threads"), (KERNELS[7:], "threads"),
                            (KERNELS[5:6] + EFFECTS, "step effects threads"), (EFFECTS, "effects"),
                            (SET_UP, "set_up"), (ORDER, "order"), (METHODS, "methods"), (METHODS[-1:], ""),
                            (BESIDE, "")]:
            with self.subTest(rows[0]["name"]):
                self.assertEqual(list(self.page(rows)[1]), names.split())

    def test_earlier_measurements_are_kept_by_date(self):
        kept = {}
        with tempfile.TemporaryDirectory() as folder:
            out = Path(folder)
            for date, ratio, processor in (("2001-02-03", 25.0, "a processor"),
                                           ("2001-01-01", 20.0, "a processor"),
                                           ("2001-01-15", 99.0, "another processor"),
                                           ("2001-02-03", 30.0, "a processor")):
                rows = [*KERNELS, KERNELS[5] | {"ratio_to_oracle": ratio}]  # the last row of a kind counts
                bench = {"context": CONTEXT | {"date": date, "processor": processor},
                         "rows": [*rows, *EFFECTS, *METHODS]}
                kept = history.measurements(bench, out)
                (out / history.FILE).write_text(json.dumps(kept), encoding="utf-8")
        self.assertEqual([entry["date"] for entry in kept],
                         ["2001-01-01", "2001-01-15", "2001-02-03"])
        self.assertEqual(kept[-1]["kinds"], {"strain triangles": (5, 30), "crossover springs": (2, 20),
                                             "adaptive springs": (2.5, 16), "whole step": (3.2, 30)})
        self.assertEqual(history.title(kept), "A step is 30.0 times as fast as a step of the oracle "
                         "(in the last measurement on a processor of this name: 20.0 times)")
        self.assertNotIn("times", history.title(kept[:1]))

    def test_a_page_without_rows_lists_missing_rows(self):
        text, charts, rows = self.page([])
        self.assertEqual((charts, rows), ({}, []))
        self.assertNotIn("<img", text)
        for name in ("a whole step", "any kind of bending constraint", "quasi_newton", "effects: gravity",
                     "set_up/", "corner, strip, irreg", "more than one thread", "recording/", "sweep/"):
            self.assertIn(name, text)

    def test_measurements_may_be_in_another_folder(self):
        with tempfile.TemporaryDirectory() as folder:
            file, out = Path(folder) / "mine.json", Path(folder) / "page"
            file.write_text(json.dumps({"context": CONTEXT, "rows": KERNELS}), encoding="utf-8")
            project.lay_out(performance.PAGE, out, project.draw(performance.PAGE, file, out))
            self.assertEqual(performance.read(out / "bench.json"), performance.read(file))


if __name__ == "__main__":
    unittest.main()
