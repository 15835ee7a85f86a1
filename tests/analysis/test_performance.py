"""Tests of the page of what the solver costs, on made-up rows whose answers are known by hand."""
import json
import re
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "analysis"))
import fig_performance  # noqa: E402
import fig_performance_effects  # noqa: E402
import fig_performance_kinds  # noqa: E402
import fig_performance_limits  # noqa: E402
import fig_performance_methods  # noqa: E402
import fig_performance_order  # noqa: E402
import fig_performance_overview  # noqa: E402
import fig_performance_set_up  # noqa: E402
import fig_performance_threads  # noqa: E402
import performance_page  # noqa: E402

CONTEXT = {"schema_version": 1, "date": "2001-02-03T04:05:06Z", "host": "a host", "processor": "a processor",
           "compiler": "a compiler", "flags": "-O3", "build_type": "Release", "vector_bits": 128,
           "version": "1.2.3", "git_commit": "0123456789abcdef", "git_dirty": False, "source_hash": "fedcba",
           "triad_16_KiB_GB_per_s": 300.0, "peak_float_Gflop_per_s": 200.0}


def row_of(name, vertices=100, constraints=100, ns=1.0, scalar="float", threads=1, ratio=None, roofline=None,
           **more):
    """A row from half its median to twice its median."""
    return {"name": name, "scalar": scalar, "threads": threads, "vertices": vertices,
            "constraints": constraints, "ns_per_constraint": ns, "ns_lowest": ns and ns / 2,
            "ns_highest": ns and 2 * ns, "repetitions": 7 if ns else 0, "ratio_to_oracle": ratio,
            "roofline_fraction": roofline, **more}


def order_row(scene, sweeps, match, colour, mesh=0.1):
    return row_of(f"convergence/{scene}/{sweeps}", ns=None, scalar="double", sweeps=sweeps,
                  sweeps_to_match=match, strain_error_mesh=mesh, strain_error_colour=colour,
                  strain_error_from_pins=mesh, strain_error_to_pins=mesh, strain_error_colour_from_pins=mesh,
                  colour_over_mesh=colour / mesh)


# 200 triangles of 5 ns and 300 springs of 2 ns, 4 iterations: 4 (1000 + 600) ns in a step.
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
# Per vertex 30 ns of pbd; of quasi_newton 60, of which 24 in the solve and 5 · 2 in the gradient.
METHODS = [row_of("method/pbd/10", ns=30.0, step_ms=0.03),
           row_of("method/quasi_newton/10", ns=60.0, step_ms=0.06, roofline=0.5),
           row_of("method/quasi_newton/10", ns=40.0, threads=2, step_ms=0.04),
           row_of("solve/10", ns=24.0, ratio=3.0, roofline=0.6),
           row_of("gradient/10", constraints=500, ns=2.0, ratio=40.0, roofline=0.4),
           row_of("method/newton/10", ns=9000.0, scalar="double", step_ms=2.0),
           row_of("solve_oracle/10", ns=72.0, scalar="double")]
EVERYTHING = [*KERNELS, *METHODS, *EFFECTS, *SET_UP, *ORDER, *BESIDE]


class MeasureTest(unittest.TestCase):
    def table(self, rows=KERNELS):
        return fig_performance.series(rows)

    def test_rows_are_told_apart_by_kind_precision_and_size(self):
        table = self.table(list(reversed(EVERYTHING)))
        self.assertEqual([row["vertices"] for row in table["crossover", "float"]], [100, 10000])
        self.assertEqual(len(table["step", "float"]), 1)  # one thread only
        self.assertEqual(len(table["effect/wind", "float"]), 2)
        self.assertNotIn("convergence/corner", {kind for kind, _ in table})  # not timed

    def test_the_cost_of_a_vertex_is_that_of_its_constraints(self):
        strain, spring = KERNELS[:2]
        self.assertEqual(fig_performance.per_vertex(strain), 10)  # two triangles of 5 ns
        self.assertEqual(fig_performance.per_vertex(spring, "ns_highest"), 12)  # three springs of 4 ns

    def test_the_iterations_of_a_step_follow_from_its_time(self):
        self.assertEqual(fig_performance.iterations(KERNELS), 4)
        self.assertIsNone(fig_performance.iterations(EFFECTS))

    def test_the_usual_size_is_that_of_most_kinds(self):
        self.assertEqual(fig_performance.usual(self.table()), 100)
        self.assertIsNone(fig_performance.usual(self.table(EFFECTS)))

    def test_what_has_no_row_is_named(self):
        lines = fig_performance.lacking(self.table(), ["strain", "dihedral"])
        self.assertEqual(lines, ["single precision: dihedral hinges",
                                 "double precision: strain triangles, dihedral hinges"])

    def test_the_title_over_size_compares_what_has_both_sizes(self):
        title = fig_performance.title(self.table())
        self.assertEqual(title, "Cost of a constraint on 10,000 vertices over that on 100:\n"
                         "3.00 for crossover springs (single precision)")
        self.assertNotIn("over that", fig_performance.title(self.table(KERNELS[:1])))

    def test_parts_of_a_step_are_in_one_unit(self):
        parts = [(part.group, part.name, part.ns) for part in fig_performance_overview.parts(EVERYTHING)]
        self.assertEqual(parts, [("strain", "strain triangles", 40), ("bending", "adaptive springs", 100),
                                 ("bending", "crossover springs", 24), ("effects", "wind", 8),
                                 ("effects", "gravity", 1)])
        self.assertEqual(fig_performance_overview.parts(EFFECTS), [])

    def test_the_answer_and_its_title(self):
        self.assertEqual(fig_performance_overview.answer(EVERYTHING),
                         "One step with 4 iterations of a cloth with 100 vertices and crossover springs "
                         "takes 0.0064 ms on one thread. That is 64.0 ns for each vertex: 40.0 ns for the "
                         "strain of the triangles and 24.0 ns for the springs.")
        title = fig_performance_overview.title(fig_performance_overview.parts(EVERYTHING))
        self.assertIn("Bending takes 0.60 (crossover springs) to 2.5 (adaptive springs) times", title)
        self.assertIn("1 of 2 effects take less than a tenth of it; the dearest is wind, with 0.20", title)

    def test_kinds_are_compared_at_one_size(self):
        self.assertEqual(fig_performance_kinds.title(self.table()),
                         "A bending constraint costs 2.0 to 2.5 ns; all constraints of a model cost 6.0 to "
                         "25 ns per vertex\n(single precision, 100 vertices)")
        self.assertEqual(fig_performance_limits.title(self.table()),
                         "The fast code is 16 to 30 times as fast as the oracle and reaches 25 to 50 % of "
                         "the roofline\n(single precision, 100 vertices)")

    def test_an_iteration_of_quasi_newton_is_compared_with_its_solve(self):
        table = self.table(METHODS)
        self.assertEqual(fig_performance_methods.title(table),
                         "An iteration of quasi_newton costs 60.0 ns per vertex, 2.00 times one of pbd;\n"
                         "the solve is 40 % of it (single precision, 100 vertices)")
        self.assertNotIn("costs", fig_performance_methods.title(self.table(METHODS[:3])))
        self.assertEqual(fig_performance_methods.threads_gain(METHODS, METHODS[1]), "1.50")
        self.assertEqual(fig_performance_methods.threads_gain(METHODS, METHODS[0]), "")

    def test_an_effect_that_grows_is_named(self):
        effects = fig_performance_effects.by_effect(EVERYTHING)
        self.assertEqual(list(effects), ["wind", "gravity"])  # the dearest first
        self.assertEqual(fig_performance_effects.growth(effects["wind"]), 5)
        self.assertIn("1 of 1 effects", fig_performance_effects.title(effects))
        self.assertIn("most of all wind: 5.0 times", fig_performance_effects.title(effects))
        self.assertIn("10,000 vertices, only at fewer: gravity (100)",
                      fig_performance_effects.sizes_text(effects))

    def test_effects_are_those_of_the_program(self):
        known = fig_performance_effects.known_effects()
        files = {path.stem for path in (ROOT / "lib/bendlab/effects").glob("*.cpp")}
        self.assertIn("gravity", known)
        self.assertLessEqual(set(known), files)

    def test_set_up_in_steps(self):
        # 100 ns per spring against 4 iterations of 2.5 ns
        self.assertEqual(fig_performance_set_up.steps(SET_UP[0], self.table(), 4), 10)
        self.assertIsNone(fig_performance_set_up.steps(SET_UP[0], {}, 4))
        self.assertIn("For 100,000 springs it takes as long as projecting them in 10 steps",
                      fig_performance_set_up.steps_text(EVERYTHING))
        self.assertEqual(fig_performance_set_up.title(SET_UP),
                         "Setting up 100,000 springs takes 0.010 s: 100 ns and 40 bytes for each")

    def test_order_by_colour_wins_where_it_needs_fewer_times_as_many_iterations_as_it_is_faster(self):
        # 5, 2 and 9 times as many, and never; 8 times as fast
        self.assertEqual([fig_performance_order.more(row) for row in ORDER], [5, 2, 9, None])
        self.assertIn("sooner in 2 of 4 comparisons", fig_performance_order.time_text(EVERYTHING))
        self.assertEqual(fig_performance_order.time_text(ORDER), "")
        self.assertEqual(fig_performance_order.title(fig_performance_order.by_scene(ORDER)),
                         "Order by colour changes the error by −10 to 50 %;\nit needs 2.0 to 9.0 times "
                         "as many iterations for the error of list order")

    def test_gain_of_threads(self):
        steps = fig_performance_threads.by_precision(EVERYTHING)
        gains = [fig_performance_threads.gain(steps["float"], row) for row in steps["float"]]
        self.assertEqual(gains, [1, 2])
        self.assertEqual(fig_performance_threads.title(steps),
                         "On 2 threads a step is 2.0 times (single precision) as fast as on one")
        self.assertIn("are 1.8 times as fast as one after the other (1.50 to 2.00)",
                      fig_performance_threads.beside_text(BESIDE))


class PageTest(unittest.TestCase):
    def page(self, rows, **context):
        with tempfile.TemporaryDirectory() as folder:
            out = Path(folder)
            performance_page.main({"context": {**CONTEXT, **context}, "rows": rows}, out)
            text = (out / "index.html").read_text(encoding="utf-8")
            for picture in re.findall(r"<img src='([^']+)'", text):
                self.assertTrue((out / picture).is_file(), picture)
            return text, json.loads((out / "summary.json").read_text(encoding="utf-8"))

    def test_every_row_is_on_the_page_and_in_the_summary(self):
        text, rows = self.page(EVERYTHING)
        self.assertEqual(len(rows), len(EVERYTHING))
        self.assertEqual([row["ns_per_vertex"] for row in rows[:2]], [10, 6])
        self.assertIsNone(next(row for row in rows if row["name"] == "convergence/corner/1")["ns_per_vertex"])
        timed = len(EVERYTHING) - len(ORDER)
        self.assertIn(f"All {timed} timed rows", text)
        self.assertEqual(len(re.findall("<img", text)), 9)
        self.assertLess(text.index("0.0064 ms on one thread"), text.index("<img"))  # the answer first

    def test_the_page_names_machine_and_program(self):
        text, _ = self.page(KERNELS)
        self.assertIn("Measured on 2001-02-03 on one machine: a processor, 128-bit vectors, a compiler, "
                      "commit 0123456789ab without further changes", text)
        self.assertIn("<td class='t'>bandwidth on 16 KiB</td><td class='t'>300 GB/s</td>", text)
        self.assertIn("with changes that are not committed", self.page(KERNELS, git_dirty=True)[0])

    def test_rows_of_one_family_make_a_page(self):
        for rows, pictures in [(KERNELS[:1], 3), (KERNELS[3:4], 0), (KERNELS[5:6], 1), (KERNELS[7:], 1),
                               (KERNELS[5:6] + EFFECTS, 3), (EFFECTS, 1), (SET_UP, 1), (ORDER, 1),
                               (METHODS, 1), (METHODS[-1:], 0), (BESIDE, 0)]:
            with self.subTest(rows[0]["name"]):
                self.assertEqual(self.page(rows)[0].count("<img"), pictures)

    def test_a_page_of_no_rows_says_what_is_missing(self):
        text, rows = self.page([])
        self.assertEqual(rows, [])
        self.assertNotIn("<img", text)
        for what in ("a whole step", "any kind of bending constraint", "quasi_newton", "effects: gravity",
                     "set_up/", "corner, strip, irreg", "more than one thread", "recording/", "sweep/"):
            self.assertIn(what, text)


if __name__ == "__main__":
    unittest.main()
