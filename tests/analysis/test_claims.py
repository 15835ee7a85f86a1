"""Tests of the rules behind claims, checks and answers, on invented runs with numbers beside each limit."""
import os
import sys
import tempfile
import unittest
from pathlib import Path
from types import SimpleNamespace
from unittest import mock

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "analysis"))
from bendlab.results.load import Run, select, spread  # noqa: E402
from figures.accuracy import measures, methods, solver  # noqa: E402
from figures.paper import ablations, fig_1, fig_5, fig_6, fig_7, large_forces  # noqa: E402
from figures.paper import promise, promise_strip  # noqa: E402
from figures.plain import shares  # noqa: E402
from figures.stiffness import buckling, calibrated, hinges, resolution, textile  # noqa: E402
from made_up_runs import made_up  # noqa: E402
from pages import accuracy, paper, stability, start  # noqa: E402
from runs import distance, expectations, plain_cases, stability_cases, stability_reasons, strips  # noqa: E402
from runs import sweeps  # noqa: E402
from sweep import charts  # noqa: E402
from tables import committed  # noqa: E402
from tables.section import Check, Section  # noqa: E402
from web import stability_matrix  # noqa: E402
from web.verdicts import tally  # noqa: E402

NAN = np.nan


def run_of(summary, config=None, status="complete", time=(0, 0.5), **more):
    metrics = {"time": np.array(time, float)}
    return Run(Path("-"), "0", "made up", status, config or {}, summary, metrics, **more)


def verdicts(claims):
    return [claim.holds for claim in claims]


class Distances(unittest.TestCase):
    """Cloths of 50 vertices with a diagonal of 2 m at rest, pinned at vertex 0."""

    cloth = np.random.default_rng(3).random((50, 3)) - [0, 0, 1]

    def run_at(self, *frames, seed=1, times=None, status="complete"):
        times = np.arange(len(frames)) / 2 if times is None else np.array(times)
        return SimpleNamespace(positions=lambda frame: frames[frame], size=2.0, pin_seeds=np.array([0]),
                               metrics={"time": times}, file=frames, complete=status == "complete",
                               get=lambda _: seed)

    def turned(self, angle, centre):
        x, y, z = (self.cloth - centre).T
        return np.c_[np.cos(angle) * x - np.sin(angle) * y, np.sin(angle) * x + np.cos(angle) * y, z] + centre

    def test_a_turn_about_the_vertical_through_the_pins_is_undone(self):
        centre = self.cloth[0]
        for angle in (0.3, -2.0):
            turned = self.turned(angle, centre)
            np.testing.assert_allclose(distance.turned_onto(self.cloth, turned, centre), turned, atol=1e-14)
            lower = turned - [0, 0, 0.3]  # a height is not undone
            self.assertAlmostEqual(distance.at_rest(self.run_at(self.cloth), self.run_at(lower)), 0.15)

    def test_the_distance_in_motion_is_a_mean_over_equal_times(self):
        first, second = ([self.cloth + [0, 0, height] for height in heights]
                         for heights in ((9, 0, 0, 0), (0, 0.2, 0.4, 9)))
        apart = lambda *times: distance.in_first_second(self.run_at(*first),
                                                        self.run_at(*second, times=times))
        self.assertAlmostEqual(apart(0, 0.5, 1, 1.5), 0.15)  # without the times 0 and 1.5 s
        with self.assertRaises(ValueError):
            apart(0, 0.4, 0.8, 1.2)

    def test_the_distance_of_groups_is_the_median_over_pairs_with_different_seeds(self):
        run_at = lambda height, seed, status="complete": self.run_at(self.cloth + [0, 0, height], seed=seed,
                                                                     status=status)
        runs = [run_at(0, 1), run_at(0.1, 2), run_at(1, 3)]
        with mock.patch.object(distance, "_last_second", lambda frames: frames):
            rms, hausdorff = distance.between_runs(runs, runs)  # 0.1, 0.9 and 1 m
            self.assertAlmostEqual(rms.median, 0.45)
            np.testing.assert_allclose((rms.low, rms.high, rms.count), (0.05, 0.5, 3))
            self.assertTrue(0 < hausdorff.median <= 0.45)  # a vertex may be nearer than the same vertex
            self.assertEqual(distance.between_runs(runs, [run_at(0, 1)])[0].count, 2)  # one pair has one seed
            moving = [self.run_at(*(self.cloth + [0, 0, height] for height in heights), seed=seed)
                      for seed, heights in ((1, (0, 0, 0)), (2, (9, 0.2, 0.1)))]
            self.assertAlmostEqual(distance.between_runs(moving, moving)[0].median, 0.1)  # over frames
            diverged = distance.between_runs(runs, [run_at(0, 4, "diverged")])
            self.assertEqual([part.low for part in diverged], [np.inf, np.inf])


class Paper(unittest.TestCase):
    def grid(self, stretch):
        """The runs of Fig. 5 with these numbers: stretch(model, pinned rings, N, seed) minus 1."""
        def summary(run):
            value = 1 + stretch(run.model, *map(run.get, ("/pins/ring", "/mesh/cells", "/initial/seed")))
            return {"pin_max_stretch": value, "pin_region_stretch": value, "drop": 1.0}
        return fig_5.Grid(made_up(["paper/fig5"], summary), "floor")

    def test_crossover_springs_fail_with_resolution_if_every_seed_is_worse_and_the_median_never_falls(self):
        for values, noise, holds, finest in (
                ((0.2, 0.5, 1.1), 0, True, 0.19), ((0.2, 0.5, 0.9), 0, False, 0.21),
                ((0.2, 1.3, 1.1), 0, False, 0.19), ((0.8, 1, 1.1), 0.5, False, 0.21)):
            of = dict(zip((16, 32, 64), values))
            grid = self.grid(lambda model, ring, n, seed: of[n] + noise * (seed - 3) / 2
                             if model == "crossover" else finest if n == 64 else 0.1)
            self.assertEqual(verdicts(fig_5._resolution_claims(grid)), [holds, finest < 0.2, True])

    def test_springs_cause_an_improvement_if_they_cause_two_thirds_of_it(self):
        for by_springs, by_ring, holds in ((10, 3, True), (10, 4, False)):
            grid = self.grid(lambda model, ring, n, seed: 50 / (by_springs if model == "adaptive" else 1)
                             / (by_ring if ring else 1))
            self.assertIs(fig_5._cause_claim(grid).holds, holds)

    def test_a_single_bad_sheet_breaks_the_promise(self):
        def claim(worst, configs=("recommended",)):
            bad = lambda run: run.get("/pins/vertices") == ["top"] and run.get("/mesh/cells") == 32
            runs = made_up(configs, lambda run: {
                "pin_max_stretch": 1 + (worst if bad(run) else 0.1), "max_stretch": 1.1, "mean_strain": 0.01,
                "worst_stretch": 2.0})
            return promise._sound_claim(runs, {})
        self.assertIs(claim(0.29).holds, True)
        self.assertIs(claim(0.31).holds, False)
        self.assertAlmostEqual(max(claim(0.31).numbers.values()), 1)  # the fall has no limit
        self.assertIsNone(claim(0.1, ["paper/recommended_full"]).holds)  # N = 128 is missing

    def test_a_strip_is_as_stiff_at_every_resolution_within_the_goal(self):
        claim = lambda *shares: promise_strip._claim({promise_strip.DEFAULTS: dict(zip((12, 96), shares))})
        self.assertEqual(verdicts(claim(*shares) for shares in ((0.9, 0.94), (0.9, 0.96), (0.9, NAN))),
                         [True, False, None])

    def test_materials_differ_if_they_are_twice_as_far_apart_as_seeds(self):
        runs = made_up(["paper/fig7"], lambda run: {"drop": 1, "pin_max_stretch": 1.5, "max_stretch": 1.9})
        cases = {(rate, k): [run for run in select(runs, bending__adaptive__n_multiplier=k)
                             if fig_7.damping_rate(run) == rate] for rate in (0, 1) for k in (1, 2, 4)}
        for apart, holds in ((2.1, True), (1.9, False)):
            between = lambda a, b: (spread([1.0 if a is b else apart]), spread([1.0]))
            with mock.patch.object(fig_7, "between_runs", between):
                self.assertEqual(verdicts(fig_7._claims(cases, [0, 1])), [holds, True])
        for run in cases[1, 4]:
            run.summary["max_stretch"] = 2.1
        with mock.patch.object(fig_7, "between_runs", between):
            self.assertEqual(verdicts(fig_7._claims(cases, [0, 1])), [False, False])

    def test_lod_is_compared_with_the_complete_runs_of_the_full_model(self):
        runs = made_up(["paper/fig6_64"], lambda run: {"springs": 100 - 10 * run.get("/bending/lod/t", 0)},
                       lambda run: "diverged" if run.get("/bending/lod/t") == 5 else "complete")
        section = Section("", "")
        experiment = sweeps.Experiment("paper/fig6_64", {}, {}, runs, [])
        with mock.patch.object(fig_6, "between_runs", lambda a, b: (len(a), len(b))), \
                mock.patch.object(Section, "uses", lambda section, experiment: experiment.runs):
            case = fig_6.Case(64, 0, sweeps.complete_runs(section, experiment))
        self.assertEqual([*case.fewer], [0, 2, 3, 4])
        np.testing.assert_allclose([*case.fewer.values()], [0, 0.2, 0.3, 0.4])
        self.assertEqual(case.nearest_to_claim(), 2)
        self.assertEqual((case.yardstick, case.distance[2]), ((6, 6), (6, 6)))
        missing, = section.missing
        self.assertIn("configs/paper/fig6_64.json: diverged: 6 runs, first /bending/model lod", missing)

    def test_large_forces_are_judged_by_the_largest_stretch_of_both_scenes(self):
        claim = lambda *worst: large_forces._claim({name: {large_forces.OURS: value} for name, value
                                                    in zip(large_forces.SCENES, worst)}).holds
        self.assertEqual([claim(1.1, 1.14), claim(1.1, 1.2), claim(1.1), claim(1.1, NAN)],
                         [True, False, None, None])
        title = large_forces._title({"storm": {("paper", "lod"): 9.0, ("paper", "adaptive"): 7.0,
                                               ("recommended", "lod"): 1.2, large_forces.OURS: 1.1}})
        self.assertIn("storm: at least 7.0 times with the paper's springs, at most 1.20 times with our "
                      "defaults (2 models)", title)

    def test_the_effect_of_an_open_question_is_a_ratio_of_positive_stretches(self):
        def effect(*stretches):
            config = lambda k: {"bending": {"k": k}}
            runs = [run_of({"triangles": 512, "pin_max_stretch": 1 + stretch, "mean_strain": 0, "drop": 1},
                           config(k)) for k, stretch in enumerate(stretches)]
            experiment = SimpleNamespace(runs=runs, settings=config(0),
                                         sweep={"/bending/k": list(range(len(stretches)))})
            rows = ablations._rows("k_16", experiment)
            self.assertEqual([row["answer"] for row in rows][:1], ["k, N = 16: 0"])
            return rows[0]["effect"]
        self.assertAlmostEqual(effect(0.1, 0.4, 0.2), 4)
        for unknown in ((0.2, -0.01), (0.2, NAN), (0.2,)):
            self.assertTrue(np.isnan(effect(*unknown)))

    def test_a_sheet_that_never_fails_has_no_time_of_failure(self):
        run = lambda *stretch: SimpleNamespace(metrics={"pin_max_stretch": np.array(stretch), "frames": 3,
                                                        "time": np.array([0, 1, 2])}, frames=3)
        self.assertEqual([fig_1._onset(run(1, 2.5, 3)), fig_1._onset(run(1, 1, 1.9))], [(1, 1), (2, np.inf)])


class Strips(unittest.TestCase):
    @staticmethod
    def strip(summary=None, model="dihedral", cells=12, gravity=9.81, status="complete", **bending):
        config = {"bending": {"model": model, **bending},
                  "mesh": {"generator": "equilateral", "cells": cells},
                  "effects": [{"type": "gravity", "acceleration": [0, -2, -gravity]}]}
        return run_of(summary or {}, config, status)

    def test_unbalanced_and_diverged_runs_are_left_out_and_named(self):
        runs = [self.strip({"unbalanced": value}, cells=n) for n, value in ((1, 0.004), (2, 0.006), (3, NAN))]
        runs += [self.strip(cells=4, status="diverged"), self.strip(cells=5)]
        for run in runs:
            run.point, run.experiment = {"/mesh/cells": run.get("/mesh/cells")}, "stiffness/a"
        runs[1].point = {"/mesh": {"cells": 2, "width": 0.1 + 0.2}, "/bending/model": "dkt"}
        experiment, section = SimpleNamespace(runs=runs, config="stiffness/a"), Section("", "")
        with mock.patch.object(strips, "load_experiment", lambda *_: experiment), \
                mock.patch.object(Section, "uses", lambda section, experiment: experiment.runs):
            kept = strips.experiment_runs("", section, "a")
        self.assertEqual([run.get("/mesh/cells") for run in kept], [1, 5])
        self.assertEqual(section.missing, [
            "configs/stiffness/a.json: diverged: 1 run /mesh/cells 4",
            "configs/stiffness/a.json: found no equilibrium: 2 runs, first /mesh/cells 2, /mesh/width 0.3, "
            "/bending/model dkt; /mesh/cells 3"])

    def test_stiffness_is_compared_with_the_stated_stiffness_of_springs_or_of_hinges(self):
        measured = {"stiffness_flexural_rigidity": 3.0, "stiffness_quartic": 8.0, "stiffness_gamma": 10.0}
        hinge = self.strip(measured, flexural_rigidity=2.0)
        self.assertEqual((strips.stated(hinge), strips.share_of_droop(hinge)), (2, 1.5))
        self.assertEqual(strips.load_number(hinge, 5.0), 6)
        for stated in ({"quartic_coefficient": 4.0}, {"flexural_rigidity": 400.0, "at_curvature": 10}):
            springs = self.strip(measured, "lod", **stated)
            self.assertEqual((strips.stated(springs), strips.share_of_droop(springs)), (4, 2))

    def test_the_exponent_of_droop_is_fitted_to_small_droop(self):
        runs = [self.strip({"stiffness_height_over_width": droop}, gravity=gravity)
                for gravity, droop in ((1, 0.02), (8, 0.04), (27, 0.06), (1000, 0.9))]
        self.assertAlmostEqual(strips.exponent(runs), 1 / 3)

    def test_a_ratio_needs_every_number(self):
        self.assertEqual([strips.largest_ratio(values) for values in ([2, 1, 3], [2.0, 2.0])], [3, 1])
        for values in ([1, 1.02, NAN], [1], [], [1, 0], [1, -2]):
            self.assertTrue(np.isnan(strips.largest_ratio(values)))

    def test_a_mesh_without_a_stiffness_is_not_in_the_range_of_cells(self):
        runs = [self.strip({"stiffness_flexural_rigidity": value}, "adaptive", n)
                for n, value in ((12, 1.0), (24, 1.1), (48, NAN))]
        row, = calibrated._ratios(runs, calibrated.RULES[1], lambda run: run.model, strips.rigidity)
        self.assertEqual((row["cells"], row["ratio"]), ((12, 24), 1.1))
        section = Section("", "")
        with mock.patch.object(strips, "experiment_runs", lambda *_: runs):
            resolution.main("", "", section)
        self.assertEqual((section.table("ratios")[0]["cells"], section.checks[0].holds), ((12, 24), None))
        self.assertEqual(section.charts[0].title, "Stiffness over resolution")

    def test_rows_are_part_of_the_name_of_a_mesh(self):
        names = []
        for rows in ("parallel", "perpendicular"):
            run = self.strip()
            run.config["mesh"]["rows"] = rows
            names.append(strips.mesh_name(run))
        self.assertEqual(names, ["equilateral, parallel rows, 12 cells", "equilateral, 12 cells"])

    def test_a_strip_of_hinges_is_checked_where_its_mesh_resolves_the_fold(self):
        names = lambda load, n: [check.check.split(" at")[0] for check
                                 in hinges._checks(self.strip(cells=n), load, 0.5)]
        rest = ["B from H/W", "B from m(κ)", "exponent p of m ∝ κ^p"]
        self.assertEqual([names(0.3, 12), names(1, 12), names(100, 24), names(100, 48)],
                         [rest, ["H/W", *rest], [], ["H/W", *rest]])

    def test_the_load_of_an_upright_strip_and_its_deflection(self):
        rest = np.array([[x, y, 0] for x in (-1.0, 0, 1, 2, 3) for y in (0, 0.5)])
        bent = rest + np.array([0, 0, -0.07]) * (rest[:, :1] == 3)
        run = SimpleNamespace(rest_positions=rest, pinned=rest[:, 0] <= 0, positions=lambda frame: bent,
                              model="dihedral", get={"/effects/0/acceleration": [0, -2, 0],
                                                     "/bending/compliance": 0.1, "/material/density": 3}.get)
        run.get = lambda pointer, default=None, values=run.get: values(pointer, default)
        # The length of 3 m begins half a row, 0.5 m, behind the clamp's edge.
        self.assertAlmostEqual(buckling.load_number(run), 3 * 2 * 3.5**3 * 0.1)
        self.assertAlmostEqual(buckling.deflection(run), 0.07 / 3.5)

    def test_the_bending_length_grows_with_the_cube_root_of_the_rigidity(self):
        self.assertAlmostEqual(textile.length_of(8 * 9.81e-6, 1e-3) / textile.length_of(9.81e-6, 1e-3), 2)
        self.assertAlmostEqual(textile.length_of(9.81e-6, 1.0), 0.01)


class Accuracy(unittest.TestCase):
    @staticmethod
    def run_with(error, gap=NAN, unbalanced=0.0, ms=1.0, time=(0, 0.5), **solver_settings):
        summary = {"error_physical_rms": error, "error_solver_rms": error,
                   "error_physical_unbalanced": unbalanced, "error_physical_reference_gap": gap}
        return run_of(summary, {"solver": {"substeps": 1, "iterations": 1, **solver_settings},
                                "bending": {"model": "lod"}}, time=time, step_cpu_s=0.03 * ms)

    def test_the_gap_is_the_largest_of_all_known_gaps_in_any_order(self):
        runs = [self.run_with(0.1, gap) for gap in (0.01, 0.03, NAN, 0.02)]
        self.assertEqual([measures.gap(runs), measures.gap(runs[::-1])], [0.03, 0.03])
        self.assertTrue(np.isnan(measures.gap([self.run_with(0.1)])))

    def test_an_error_needs_a_balanced_reference(self):
        self.assertEqual(measures.error(self.run_with(0.1, unbalanced=0.9e-3)), 0.1)
        unknown = self.run_with(0.1, unbalanced=1.1e-3)
        self.assertTrue(np.isnan(measures.error(unknown)))
        for runs in ([unknown, self.run_with(0.2)], [self.run_with(0.2), unknown]):
            self.assertEqual(measures.levels_rows(runs, "", "physical", "")[0]["least"], 20)

    def test_the_finest_step_is_compared_among_known_errors(self):
        runs = [self.run_with(error, dt=dt) for error, dt in ((NAN, 0.1), (0.2, 0.2), (0.1, 0.1))]
        self.assertEqual([solver.finest_best(runs), solver.finest_best(runs[::-1])], ["1 of 1", "1 of 1"])

    def test_a_run_that_ended_at_its_start_is_never_the_cheapest(self):
        self.assertEqual(measures.cost(self.run_with(0.1, time=(0,))), np.inf)

    def test_a_method_is_compared_with_the_fastest_other_method(self):
        runs = []
        for method, ms, error in (("pbd", 6, 0.009), ("pbd", 1, 0.02), ("newton", 2, 0.009),
                                  ("vbd", 3, 0.009)):
            runs.append(self.run_with(error, ms=ms, method=method))
            runs[-1].config["mesh"] = {"cells": 24}
        self.assertTrue(methods._message(runs).endswith("3.0 × at 24 cells"))
        levels = methods._levels("", runs, methods.by_cells, "").rows
        self.assertEqual([(row["ms_1"], row["ms_5"]) for row in levels if row["method"] == "pbd"], [(6, 1)])

    def test_the_answer_states_only_runs_near_the_stated_cloth(self):
        def run(id, error, ms):
            return {"id": id, "experiment": "accuracy_front", "status": "complete", "point": {}, "cells": 24,
                    "settings": {"method": id}, "model": "lod", "error_physical_rms": error,
                    "ms_per_frame": ms}
        answer = accuracy.answer([run("far", 0.011, 1), run("near", 0.009, 5)])
        self.assertIn("an error of at most 1 %", answer)
        self.assertIn("#run-near", answer)
        self.assertIn("None of the 1 runs is known", accuracy.answer([run("far", 0.011, 1)]))


class Plain(unittest.TestCase):
    def test_a_pin_must_not_move_and_a_free_cloth_must_fall(self):
        def broken(moved=0.0, slower=1.0, pins=()):
            time = np.array([0, 0.1, 0.2])
            fall = np.array([0, 0, -9.81]) * (time * (time + 0.01) / 2 * slower)[:, None, None]
            rest = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], float)
            scene = SimpleNamespace(
                rest=rest, triangles=np.array([[0, 1, 2], [0, 2, 3]]), pins=np.array(pins, int), size=2**0.5,
                time=time, frames=rest + (fall if not pins else np.zeros((3, 1, 3))), h=0.01,
                mass=np.full(4, 0.25), gravity=np.array([0, 0, -9.81]), velocity=np.zeros((4, 3)),
                second_order=False,
                run=SimpleNamespace(pinned=np.isin(range(4), pins)))
            for pin in pins:
                scene.frames[2, pin] += [0, 0, moved]
            run = SimpleNamespace(model="none", get=lambda pointer: 0.2)
            with mock.patch.object(plain_cases, "Scene", lambda run: scene):
                return [bound.name for bound in plain_cases.bounds_of(run) if not bound.holds]
        self.assertEqual([broken(), broken(pins=[2])], [[], []])
        self.assertEqual(broken(moved=1e-5, pins=[2]), ["movement of a pin"])
        self.assertEqual(broken(slower=0.99), ["distance from free fall"])

    def test_a_warning_about_something_else_is_no_warning(self):
        run = lambda *codes: SimpleNamespace(status="complete", warnings=[{"code": code} for code in codes])
        self.assertEqual(plain_cases.warnings_of(run("units", "inert_seed")), "")
        self.assertEqual(plain_cases.warnings_of(run("units", "unconverged")), "unconverged")

    def test_a_share_is_of_the_runs_with_a_value(self):
        settings = lambda model: {axis: model if axis == "model" else "same" for axis in plain_cases.AXES}
        judged = [{"settings": settings(model), "verdict": verdict, "config": "metres"}
                  for model, verdict in (("none", plain_cases.WARNED), ("none", plain_cases.SOUND),
                                         ("lod", plain_cases.SOUND))]
        runs = [SimpleNamespace(over=True, point={}, judged=one) for one in judged]
        experiment = lambda results, name: SimpleNamespace(runs=runs if name == "plain/metres" else [],
                                                           sweep={}, settings={})
        section = Section("", "")
        with mock.patch.object(shares, "load_experiment", experiment), \
                mock.patch.object(shares, "judge", lambda run, name: run.judged), \
                mock.patch.object(Section, "uses", lambda section, experiment: experiment.runs):
            shares.main("", "", section)
        rows = [(row["value"], row["share"], row["number"]) for row in section.table("shares")
                if row["setting"] == "model" and row["what"] == shares.NAMES[plain_cases.WARNED]]
        self.assertEqual(rows, [("none", 50, 2), ("lod", 0, 1)])


class Stability(unittest.TestCase):
    def verdict(self, model="none", stiffness="k", **summary):
        calm = dict(mean_strain=0.004, stability_reach=0.5, stability_reach_start=0.5,
                    stability_reach_end=0.5, stability_rest_distance=0.001, stability_energy_gain=0.0,
                    stability_momentum_drift=0.0,
                    stability_rounding_speed=1e-7, stability_creep=0.0, projections=100, vertices=100)
        case = stability_cases.Case("a", "a", "a", {}, {}, energy=True, creep=True)
        run = run_of(calm | summary, {"bending": {"model": model, "stiffness": stiffness}})
        cell = stability_cases.judge(run, None, case)
        return cell.verdict if cell.verdict == "green" else cell.worst.name

    def test_every_limit(self):
        self.assertEqual([self.verdict(stability_creep=value) for value in (0.9e-3, 1.1e-3)],
                         ["green", "creep"])
        self.assertEqual([self.verdict(stability_momentum_drift=value) for value in (7e-7, 9e-7)],
                         ["green", "momentum gained, as a speed"])
        self.assertEqual([self.verdict(*kind, stability_energy_gain=0.1) for kind in (
            ("prestressed", "k"), ("prestressed", "compliance"), ("lod", "k"))],
                         ["green", "energy gained", "energy gained"])

    def test_a_strained_cloth_has_a_reason(self):
        cell = lambda strain: SimpleNamespace(case=SimpleNamespace(name="stiff: k = 1"), model="lod",
                                              run=run_of({"mean_strain": strain}))
        self.assertIsNone(stability_reasons.reason(cell(0.019)))
        self.assertIsNotNone(stability_reasons.reason(cell(0.021)))

    RUNS = [{"case": f"meshes: {mesh}", "precision": "single", "model": model, "verdict": verdict}
            for mesh, model, verdict in (
                ("grid", "lod", "red"), ("grid", "none", "amber"), ("grid", "adaptive", "green"),
                ("strip", "lod", "red"), ("strip", "none", "red"), ("strip", "adaptive", "amber"),
                ("ball", "none", "red"))]

    def test_models_are_compared_in_cases_with_runs_of_every_model(self):
        self.assertEqual(stability_matrix.shared(self.RUNS), self.RUNS[:-1])
        answer = stability.answer(self.RUNS)
        self.assertIn("Every model has 2 comparable runs", answer)
        self.assertIn("<b>adaptive</b> fails in the fewest of these runs, 0. <b>lod</b> fails in the most, "
                      "2.", answer)
        self.assertIn("Of all 7 runs 4 fail, 2 are stable but do not recover, 1 pass.", answer)
        self.assertIn("no hard case with runs of every model", stability.answer(self.RUNS[2:4]))

    def test_only_red_runs_count_as_unstable_on_the_start_page(self):
        self.assertEqual(start.stability(self.RUNS)[""], {"lod": [2, 2], "none": [2, 3], "adaptive": [0, 2]})

    def test_each_section_writes_its_own_file(self):
        sections = [Section("pin", ""), Section("methods", "", data=[{"a": 1}])]
        with tempfile.TemporaryDirectory() as folder:
            stability.write_data(sections, None, Path(folder))
            self.assertEqual([path.name for path in Path(folder).iterdir()], [stability.METHODS])


class Pages(unittest.TestCase):
    def test_open_claims_are_counted_apart(self):
        answer = paper.answer([True, True, False, None, 0.5, 0.25, 0.75])
        for part in ("Of 7 claims", "<b>2</b> hold at every", "<b>3</b> at some",
                     "<b>1</b> at none; 1 are open"):
            self.assertIn(part, answer)

    def test_checks_without_a_number_are_counted_apart(self):
        checks = [Check("", "", "", 1.0, measured, 0.1, "") for measured in (1.0, 2.0, NAN)]
        self.assertEqual(tally(checks), ("no", "1 of 2 checks hold, 1 without a number"))
        self.assertEqual(tally(checks[::2]), ("yes", "1 of 1 checks hold, 1 without a number"))
        self.assertTrue(Check("", "", "", -1.0, -1.05, 0.1, "").holds)  # relative to a negative number

    def test_a_diverged_run_fails_its_expectations(self):
        settings = {"expect": [{"metric": "drop", "max": 2}]}
        holds = lambda status, **summary: [bound.holds for bound in expectations.check(
            settings, run_of(summary, status=status))]
        self.assertEqual([holds("complete", drop=1), holds("complete", drop=3), holds("diverged", drop=1),
                          holds("diverged"), holds("missing"), holds("interrupted")],
                         [[True], [False], [False], [False], [], []])

    def test_the_time_per_frame_is_of_a_sixtieth_second(self):
        run = run_of({}, {"duration": 2.0}, step_cpu_s=0.6)
        self.assertAlmostEqual(charts.cpu_ms(run), 5)

    def test_the_newest_unfinished_file_is_read(self):
        with tempfile.TemporaryDirectory() as name:
            files = [Path(name) / f"run.vtkhdf.{end}.part" for end in ("b", "a")]
            for age, file in enumerate(files):
                file.write_text("")
                os.utime(file, (age, age))
            self.assertEqual(sweeps.file_in(Path(name)), files[1])


class Committed(unittest.TestCase):
    def compared(self, theirs, mine):
        pages = {"theirs": {"key": committed.Row("a", *theirs)}, "mine": {"key": committed.Row("a", *mine)}}
        with mock.patch.object(committed, "rows_of", pages.get), \
                mock.patch.object(committed, "_bits", lambda folder: {}):
            return committed.compared("theirs", "mine")

    def test_numbers_agree_within_a_thousandth(self):
        same, other = (self.compared(("holds", {"x": 1000.0}), ("holds", {"x": x})) for x in (1000.9, 1001.5))
        self.assertEqual([(one.rounded, len(one.numbers)) for one in (same, other)], [(1, 0), (0, 1)])

    def test_an_open_verdict_has_no_numbers_to_compare(self):
        opened = self.compared(("holds", {"x": 1.0}), ("open", {"x": 2.0}))
        self.assertEqual((opened.numbers, opened.lost, opened.not_made), ([], [], 1))
        changed = self.compared(("holds", {"x": 1.0}), ("does not hold", {"x": 1.0}))
        self.assertEqual(committed.summary_rows(changed)[0], ("verdicts", 0, 1, 0))

    def test_a_number_that_only_my_page_lacks_is_listed(self):
        result = self.compared(("holds", {"x": 3.5, "gone": 1.0, "CPU": 2.0}), ("holds", {"x": None}))
        self.assertEqual(result.lost, [("a: x", 3.5, None), ("a: gone", 1.0, None)])
        self.assertEqual([row[-1] for row in committed.summary_rows(result)[1:]], [2, 2])
        self.assertIn("Numbers that your page lacks:\n  3.5: a: x", committed.text(result))


if __name__ == "__main__":
    unittest.main()
