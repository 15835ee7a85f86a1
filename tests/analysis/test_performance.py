"""Tests of the page on the performance of the solver, on invented rows with known results."""
import json
import re
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "analysis"))
from figures.performance import effects, history, kinds, laws, limits, measured, methods  # noqa: E402
from figures.performance import overview, set_up, sizes, threads  # noqa: E402
from figures.performance.roofline import Machine  # noqa: E402
from figures.performance.rows import iterations, lacking, per_vertex, series, shown, usual  # noqa: E402
from pages import performance, project  # noqa: E402
from tables.section import Section  # noqa: E402

CONTEXT = {"date": "2001-02-03T06:05:06+02:00", "host_name": "a host", "processor": "a processor",
           "compiler": "a compiler", "flags": "-O3", "build_type": "Release", "vector_bits": "128",
           "version": "1.2.3", "git_commit": "0123456789abcdef", "git_dirty": "false",
           "source_hash": "fedcba"}


def benchmark(name, vertices=100, constraints=100, ns=1.0, scalar="float", threads=1, iterations=1, wide=(),
              **counters):
    """What Google Benchmark writes of a benchmark with the median `ns`, the lowest time ns / 2 and the
    highest time 2 ns per constraint. The counters in `wide` have the same range."""
    run_name = f"{name}/{scalar}{f'/threads:{threads}' if threads > 1 else ''}/min_time:0.150/manual_time"
    entries = []
    for statistic, factor in (("median", 1), ("lowest", 0.5), ("highest", 2)):
        ranges = {name: value * (factor if name in wide else 1) for name, value in counters.items()}
        entries.append({
            "name": f"{run_name}_{statistic}", "family_index": 0, "per_family_instance_index": 0,
            "run_name": run_name, "run_type": "aggregate", "repetitions": 7, "threads": 1,
            "aggregate_name": statistic, "aggregate_unit": "time", "iterations": 7,
            "real_time": factor * iterations * constraints * ns, "cpu_time": 1.0, "time_unit": "ns",
            "constraints": float(constraints), "vertices": float(vertices),
            "seconds_per_item": 1e-9 * factor * ns, **ranges})
    return entries


def limit(name, **rate):
    return [{"run_name": f"{name}/min_time:0.150", "aggregate_name": "highest", **rate}]


def bench_of(benchmarks, **context):
    """The JSON of Google Benchmark."""
    return {"context": CONTEXT | context, "benchmarks": sum(benchmarks, [])}


def rows(benchmarks):
    return measured.rows_of(bench_of([*benchmarks, *LIMITS]))


LIMITS = [limit("triad/16384", bytes_per_second=300e9), limit("peak/float", flop_per_second=200e9),
          limit("peak/double", flop_per_second=100e9)]
# A step has 4 iterations with 200 triangles of 5 ns and 300 springs of 2 ns: 4 (1000 + 600) ns.
KERNELS = [benchmark("strain/10", constraints=200, ns=5.0),
           benchmark("crossover/10", constraints=300, ns=2.0),
           benchmark("crossover/100", vertices=10000, constraints=30000, ns=6.0),
           benchmark("crossover_oracle/10", constraints=300, ns=40.0),
           benchmark("dense/10", constraints=1000, ns=2.5),
           benchmark("step/10", constraints=500, ns=3.2, iterations=4),
           benchmark("step/10", constraints=500, ns=1.6, iterations=4, threads=2),
           benchmark("step/10", constraints=500, ns=6.4, iterations=4, scalar="double"),
           benchmark("strain_oracle/10", constraints=200, ns=150.0),
           benchmark("dense_oracle/10", constraints=1000, ns=40.0),
           benchmark("step_oracle/10", constraints=500, ns=80.0, iterations=4),
           benchmark("step_oracle/10", constraints=500, ns=96.0, iterations=4, scalar="double")]
EFFECTS = [benchmark("effect/wind/10", ns=8.0, acted_per_step=50.0, share_of_step=0.1),
           benchmark("effect/wind/100", vertices=10000, constraints=10000, ns=40.0, acted_per_step=5000.0,
                     share_of_step=0.2),
           benchmark("effect/gravity/10", ns=1.0, acted_per_step=0.0, share_of_step=0.01)]
SET_UP = [benchmark("set_up/10", constraints=100000, ns=100.0, rings_and_pairs_s=0.002,
                    colours_and_batches_s=0.008, peak_bytes_per_spring=40.0)]
BESIDE = [benchmark("recording/10", threads=2, ns=3.0, wall_ratio=1.25, writer_cpu_s=0.1),
          benchmark("sweep/10", threads=2, ns=3.0, speed_up=1.75, wide=["speed_up"])]
# ns per vertex: 30 for pbd; 60 for quasi_newton, including 24 for the solve and 5 · 2 for the gradient.
METHODS = [benchmark("method/pbd/10", ns=30.0),
           benchmark("method/quasi_newton/10", ns=60.0),
           benchmark("method/quasi_newton/10", ns=40.0, threads=2),
           benchmark("solve/10", ns=24.0, bytes_per_second=150e9),
           benchmark("gradient/10", constraints=500, ns=2.0),
           benchmark("method/newton/10", ns=9000.0, scalar="double"),
           benchmark("solve_oracle/10", ns=72.0, scalar="double")]
LAWS = [benchmark("law/pbd/mid_edge/one_rigidity/10", ns=10.0),
        benchmark("law/pbd/mid_edge/friction/10", ns=15.0),
        benchmark("law/pbd/mid_edge/over_time/10", ns=11.0)]
EVERYTHING = [*KERNELS, *METHODS, *LAWS, *EFFECTS, *SET_UP, *BESIDE]


class MeasureTest(unittest.TestCase):
    def table(self, benchmarks=KERNELS):
        return series(rows(benchmarks))

    def test_a_row_has_the_times_of_the_repetitions_in_one_unit(self):
        step, = rows(KERNELS[6:7])
        self.assertEqual([step[name] for name in ("name", "scalar", "threads", "vertices", "constraints",
                                                  "repetitions")], ["step/10", "float", 2, 100, 500, 7])
        self.assertEqual([round(step[name], 12) for name in ("ns_lowest", "ns_per_constraint", "ns_highest")],
                         [0.8, 1.6, 3.2])
        self.assertAlmostEqual(step["call_ms"], 4 * 500 * 1.6e-6)
        in_us, = rows([[entry | {"time_unit": "us"} for entry in KERNELS[6]]])
        self.assertAlmostEqual(in_us["call_ms"], 1e3 * step["call_ms"])

    def test_a_benchmark_that_failed_has_no_row(self):
        failed = {"run_name": "strain/10/float/manual_time", "run_type": "iteration", "error_occurred": True}
        self.assertEqual(len(rows([*KERNELS[:1], [failed]])), 1)

    def test_a_row_is_compared_with_the_oracle_that_is_most_like_it(self):
        ratios = {(row["name"], row["scalar"], row["threads"]): row["ratio_to_oracle"]
                  for row in rows(EVERYTHING)}
        for key, ratio in ((("strain/10", "float", 1), 150 / 5), (("crossover/100", "float", 1), 40 / 6),
                           (("step/10", "float", 2), 80 / 1.6), (("step/10", "double", 1), 96 / 6.4),
                           (("solve/10", "float", 1), 72 / 24)):
            self.assertAlmostEqual(ratios[key], ratio)
        for name in ("strain_oracle/10", "method/pbd/10", "effect/wind/10"):
            self.assertIsNone(ratios[name, "float", 1])

    def test_the_roofline_is_the_largest_of_three_times(self):
        strain = {"name": "strain/10", "scalar": "float", "vertices": 100, "constraints": 200,
                  "ns_per_constraint": 10.0}
        share = lambda bandwidths, peak: Machine(bandwidths, {"float": peak}).share(strain)
        # 240 flops; 3 indices and 4 numbers are streamed, and 3 corners of 8 numbers are read and written.
        self.assertAlmostEqual(share({1: 1e15}, 48e9), 0.5)
        self.assertAlmostEqual(share({1: (28 + 96) / 5e-9}, 1e15), 0.5)
        # Half a vertex per triangle comes from the memory, which has the bandwidth of large arrays.
        self.assertAlmostEqual(share({1: 1e15, 2: (28 + 16) / 5e-9}, 1e15), 0.5)
        self.assertIsNone(share({}, 48e9))
        self.assertIsNone(Machine({1: 1e9}, {"float": 1e9}).share(strain | {"name": "step/10"}))
        solve = {"name": "solve/10", "scalar": "float", "bytes_per_second": 80e9, "call_ms": 1.0}
        self.assertAlmostEqual(Machine({1: 160e9}, {"float": 1e15}).share(solve), 0.5)
        # Each entry of 4 bytes is read twice, with 6 flops each time: 120 Gflop/s.
        self.assertAlmostEqual(Machine({1: 1e15}, {"float": 240e9}).share(solve), 0.5)

    def test_the_bandwidth_between_two_sizes_lies_between_theirs(self):
        machine = Machine({1 << 10: 100.0, 1 << 20: 20.0}, {})
        self.assertEqual([round(machine.bandwidth(1 << power), 9) for power in (0, 10, 15, 20, 30)],
                         [100, 100, 60, 20, 20])

    def test_rows_are_grouped_by_kind_and_precision_and_sorted_by_size(self):
        table = self.table(list(reversed(EVERYTHING)))
        self.assertEqual([row["vertices"] for row in table["crossover", "float"]], [100, 10000])
        self.assertEqual(len(table["step", "float"]), 1)  # one thread only
        self.assertEqual(len(table["effect/wind", "float"]), 2)

    def test_the_cost_per_vertex_is_the_cost_of_its_constraints(self):
        strain, spring = rows(KERNELS[:2])
        self.assertAlmostEqual(per_vertex(strain), 10)  # two triangles of 5 ns
        self.assertAlmostEqual(per_vertex(spring, "ns_highest"), 12)  # three springs of 4 ns

    def test_the_iterations_of_a_step_follow_from_its_time(self):
        self.assertEqual(iterations(rows(KERNELS)), 4)
        self.assertIsNone(iterations(rows(EFFECTS)))

    def test_the_usual_size_is_the_size_of_most_kinds(self):
        self.assertEqual(usual(self.table()), 100)
        self.assertIsNone(usual(self.table(EFFECTS)))

    def test_the_title_of_the_laws_names_the_slowest_law(self):
        section = Section("laws", "")
        laws.main({"rows": rows(LAWS)}, None, section)
        self.assertEqual([round(row["times"], 12) for row in section.tables[0].rows], [1, 1.5, 1.1])
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
        parts = [(part.group, part.name, round(part.ns, 9)) for part in overview.parts(rows(EVERYTHING))]
        self.assertEqual(parts, [("strain", "strain triangles", 40), ("bending", "adaptive springs", 100),
                                 ("bending", "crossover springs", 24), ("effects", "wind", 8),
                                 ("effects", "gravity", 1)])
        self.assertEqual(overview.parts(rows(EFFECTS)), [])

    def test_the_answer_and_the_title_of_the_overview(self):
        self.assertEqual(overview.answer(rows(EVERYTHING)),
                         "One step with 4 iterations of a cloth with 100 vertices and crossover springs "
                         "takes 0.0064 ms on one thread. Each vertex takes 64.0 ns: 40.0 ns for the "
                         "strain of the triangles and 24.0 ns for the springs.")
        title = overview.title(overview.parts(rows(EVERYTHING)))
        self.assertIn("0.60 (crossover springs) to 2.5 (adaptive springs)", title)
        self.assertIn("wind, takes 0.20", title)

    def test_kinds_are_compared_at_the_same_size(self):
        self.assertEqual(kinds.title(self.table()),
                         "A bending constraint costs 2.0 to 2.5 ns. All bending constraints of a model cost "
                         "6.0 to 25 ns per vertex (single precision, 100 vertices)")
        self.assertEqual(limits.title(self.table()),
                         "The kernels are 16 to 30 times as fast as the oracle and reach 5.6 to 24 % of "
                         "the roofline (single precision, 100 vertices)")

    def test_an_iteration_of_quasi_newton_is_compared_with_its_solve(self):
        table = self.table(METHODS)
        self.assertEqual(methods.title(table),
                         "An iteration of quasi_newton costs 60.0 ns per vertex, 2.00 times an iteration of "
                         "pbd; the solve takes 40 % of it (single precision, 100 vertices)")
        self.assertNotIn("costs", methods.title(self.table(METHODS[:3])))
        self.assertAlmostEqual(methods.threads_gain(rows(METHODS), rows(METHODS)[1]), 1.5)
        self.assertIsNone(methods.threads_gain(rows(METHODS), rows(METHODS)[0]))

    def test_the_title_names_the_effect_whose_cost_grows_most(self):
        by_effect = effects.by_effect(rows(EVERYTHING))
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
        self.assertEqual(set_up.steps_text(rows(SET_UP)), "")
        self.assertIn("in 10 steps", set_up.steps_text(rows(EVERYTHING)))
        self.assertEqual(set_up.title(rows(SET_UP)),
                         "Setting up 100,000 springs takes 0.010 s: 100 ns and 40 bytes for each spring")

    def test_the_gain_of_threads(self):
        steps = threads.by_precision(rows(EVERYTHING))
        gains = [round(threads.gain(steps["float"], row), 12) for row in steps["float"]]
        self.assertEqual(gains, [1, 2])
        self.assertIn("2.0 times (single precision)", threads.title(steps))
        self.assertIn("1.8 times as fast as one after the other (0.875 to 3.50)",
                      threads.beside_text(rows(BESIDE)))


class PageTest(unittest.TestCase):
    def page(self, benchmarks, **context):
        """Writes the page of these benchmarks. Returns its text, its charts by id, and its summary.json."""
        with tempfile.TemporaryDirectory() as folder:
            out = Path(folder)
            file = out / "bench.json"
            file.write_text(json.dumps(bench_of([*benchmarks, *LIMITS], **context)), encoding="utf-8")
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
        text, charts, summary = self.page(EVERYTHING)
        self.assertEqual(len(summary), len(EVERYTHING))
        self.assertIn("not timed at 10,000 vertices: gravity (100)", text)
        self.assertEqual([row["ns_per_vertex"] for row in summary[:2]], [10, 6])
        self.assertIn(f"All {len(EVERYTHING)} timed rows", text)
        self.assertEqual(list(charts), ["step", "sizes", "kinds", "limits", "methods", "effects", "laws",
                                        "set_up", "threads", "history"])
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
        self.assertEqual([strain["y"][name][0] for name in ("ratio", "share")], [30, 24])
        self.assertEqual(series_of("effects")["10,000 vertices"]["y"]["vertex"], [40])
        self.assertEqual(charts["effects"]["limits"][0]["value"], 64)  # a whole step
        parts, = charts["set_up"]["rows"]
        self.assertEqual(parts["values"], [20, 80])  # a fifth and four fifths of 100 ns
        gains = series_of("threads")
        self.assertEqual((gains["single"]["y"], gains["double"]["y"]),
                         ({"ms": [0.0064, 0.0032], "gain": [1, 2]}, {"ms": [0.0128], "gain": [1]}))

    def test_a_row_is_shown_from_lowest_to_highest(self):
        row = shown(rows(KERNELS)[1])
        self.assertEqual([row[name] for name in ("ns_low", "ns", "ns_high", "range")], [1, 2, 4, (1, 4)])
        self.assertEqual([row[name] for name in ("vertex_low", "vertex", "vertex_high")], [3, 6, 12])
        self.assertEqual(row["precision"], "single")
        self.assertEqual([round(row[name], 9) for name in ("per_vertex", "ratio", "share")], [3, 20, 7])

    def test_the_page_names_the_machine_and_the_program(self):
        text, *_ = self.page(KERNELS)
        self.assertIn("Measured on 2001-02-03 on one machine: a processor, 128-bit vectors, a compiler, "
                      "commit 0123456789ab without further changes", text)
        self.assertIn("<td class='t'>bandwidth on 16 KiB</td><td class='t'>300 GB/s</td>", text)
        self.assertIn("with changes that are not committed", self.page(KERNELS, git_dirty="true")[0])

    def test_rows_of_a_single_family_make_a_page(self):
        for benchmarks, names in [(KERNELS[:9:8], "sizes kinds limits history"), (KERNELS[3:4], ""),
                            (KERNELS[5:6], "threads"), (KERNELS[7:8], "threads"),
                            (KERNELS[5:6] + EFFECTS, "step effects threads"), (EFFECTS, "effects"),
                            (SET_UP, "set_up"), (METHODS, "methods"), (METHODS[-1:], ""),
                            (BESIDE, "")]:
            with self.subTest(benchmarks[0][0]["name"]):
                self.assertEqual(list(self.page(benchmarks)[1]), names.split())

    def test_earlier_measurements_are_kept_by_date(self):
        kept = {}
        with tempfile.TemporaryDirectory() as folder:
            out = Path(folder)
            for date, ratio, processor in (("2001-02-03", 25.0, "a processor"),
                                           ("2001-01-01", 20.0, "a processor"),
                                           ("2001-01-15", 99.0, "another processor"),
                                           ("2001-02-03", 30.0, "a processor")):
                kernels = rows(KERNELS)
                kernels.append(kernels[5] | {"ratio_to_oracle": ratio})  # the last row of a kind counts
                bench = {"context": CONTEXT | {"date": date, "processor": processor},
                         "rows": [*kernels, *rows(EFFECTS), *rows(METHODS)]}
                kept = history.measurements(bench, out)
                (out / history.FILE).write_text(json.dumps(kept), encoding="utf-8")
        self.assertEqual([entry["date"] for entry in kept],
                         ["2001-01-01", "2001-01-15", "2001-02-03"])
        known = {kind: tuple(round(value, 9) for value in values)
                 for kind, values in kept[-1]["kinds"].items()}
        self.assertEqual(known, {"strain triangles": (5, 30), "crossover springs": (2, 20),
                                 "adaptive springs": (2.5, 16), "whole step": (3.2, 30)})
        self.assertEqual(history.title(kept), "A step is 30.0 times as fast as a step of the oracle "
                         "(in the last measurement on a processor of this name: 20.0 times)")
        self.assertNotIn("times", history.title(kept[:1]))

    def test_a_page_without_rows_lists_missing_rows(self):
        text, charts, summary = self.page([])
        self.assertEqual((charts, summary), ({}, []))
        self.assertNotIn("<img", text)
        for name in ("a whole step", "any kind of bending constraint", "quasi_newton", "effects: gravity",
                     "set_up/", "more than one thread", "recording/", "sweep/"):
            self.assertIn(name, text)

    def test_measurements_may_be_in_another_folder(self):
        with tempfile.TemporaryDirectory() as folder:
            file, out = Path(folder) / "mine.json", Path(folder) / "page"
            file.write_text(json.dumps(bench_of(KERNELS)), encoding="utf-8")
            project.lay_out(performance.PAGE, out, project.draw(performance.PAGE, file, out))
            self.assertEqual(performance.read(out / "bench.json"), performance.read(file))


if __name__ == "__main__":
    unittest.main()
