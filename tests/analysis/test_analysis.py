"""Tests of the analysis scripts on files and shapes whose answers are known beforehand."""
import itertools
import json
import sys
import tempfile
import unittest
import unittest.mock
from pathlib import Path
from types import SimpleNamespace
from unittest import mock

import h5py
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "analysis"))
import accuracy  # noqa: E402
import accuracy_page  # noqa: E402
from bendlab.results import checksum  # noqa: E402
import fig_5  # noqa: E402
import fig_accuracy  # noqa: E402
import fig_accuracy_beat  # noqa: E402
import fig_accuracy_roads  # noqa: E402
import fig_accuracy_rounding  # noqa: E402
import fig_accuracy_scaling  # noqa: E402
import fig_accuracy_solver  # noqa: E402
import fig_models  # noqa: E402
import fig_plain  # noqa: E402
import fig_large_forces
import fig_scenes  # noqa: E402
import fig_stability  # noqa: E402
import fig_stiffness_buckling  # noqa: E402
import fig_stiffness_calibrated  # noqa: E402
import fig_stiffness_effective  # noqa: E402
import fig_stiffness_textile  # noqa: E402
import fig_structure  # noqa: E402
from bendlab.results import load  # noqa: E402
import obstacles  # noqa: E402
import page  # noqa: E402
import plain_cases  # noqa: E402
import plain_page  # noqa: E402
from bendlab.results import registry  # noqa: E402
import render  # noqa: E402
import stability_cases  # noqa: E402
import stability_matrix  # noqa: E402
import stability_methods  # noqa: E402
import stability_page  # noqa: E402
import stability_reasons  # noqa: E402
import stiffness_page  # noqa: E402
import strips  # noqa: E402
import style  # noqa: E402
import sweeps  # noqa: E402
from distance import hausdorff_distance, rms_distance  # noqa: E402
from bendlab.results.load import group  # noqa: E402
from made_up_runs import facts  # noqa: E402
from report import Check, rounded, write_objects  # noqa: E402

SQUARE = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], float)
TRIANGLES = np.array([[0, 1, 2], [0, 2, 3]])


RUN_ID = "0123456789abcdef"


def write_run(path, config, committed=3, extra=0, status="complete", summary=None):
    """Writes a square that falls by 0.1 m per frame; `extra` frames are begun but not committed."""
    frames = committed + extra
    path.parent.mkdir(parents=True, exist_ok=True)
    with h5py.File(path, "w") as file:
        file["facts"] = facts(config, ("time", "pin_max_stretch"), id=RUN_ID, name=config["name"],
                              status=status, constraints={"distance": 7}, summary=summary or {})
        points = np.concatenate([SQUARE - [0, 0, 0.1 * k] for k in range(frames)])
        points[committed * 4:] = np.nan
        file["VTKHDF/Points"] = points.astype("f4")
        file["VTKHDF/CellData/max_stretch"] = np.repeat(1.0 + np.arange(frames), 2).astype("f4")
        file["rest/positions"] = SQUARE
        file["rest/triangles"] = TRIANGLES.astype("i4")
        file["rest/pinned"] = np.array([0, 0, 1, 0], "u1")
        file["rest/pin_seeds"] = np.array([2], "i4")
        file["metrics/values"] = np.stack([0.5 * np.arange(committed), 1.0 + np.arange(committed)], axis=1)
    if status != "running":
        checksum.seal(path)
    return path


def hard_run(case, model, precision, verdict, worst=None, why=""):
    """A run of a hard case as summary.json has it."""
    worst = worst or {"what": "mean strain", "value": 2, "limit": 1, "unit": "1"}
    title = next(one.title for one in stability_cases.CASES if one.name == case)
    return {"case": case, "title": title, "model": model, "precision": precision, "verdict": verdict,
            "worst": worst, "seconds": 0.1, "recovered_s": None, "energy_rises": 0.5, "why": why}


def every_point(sweep):
    """The points of a sweep as its config writes it."""
    lists = [registry.models() if values == "all" else values for values in sweep.values()]
    return [sorted(zip(sweep, values), key=str) for values in itertools.product(*lists)]


def config_of(name="fig5", cells=16, model="crossover", seed=1, **more):
    return {"name": name, "mesh": {"cells": cells}, "pins": {"ring": 0},
            "bending": {"model": model, model: {}}, "initial": {"seed": seed}, **more}


class CameraTest(unittest.TestCase):
    def test_of_a_cloth_that_has_left_its_pin_the_camera_shows_the_pin(self):
        camera = render.camera_for([SQUARE - [0, 0, 100]], np.zeros(3), 1.4)
        self.assertTrue(np.isfinite(camera.extent).all())
        self.assertGreater(camera.extent[1], camera.extent[0])
        self.assertAlmostEqual(camera.aspect, 0.8)


class LoadTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def test_a_run_gives_back_what_was_written(self):
        run = load.load_run(write_run(self.folder / "run.vtkhdf", config_of(),
                                      summary={"drop": 1.25, "springs": 7}))
        self.assertEqual((run.status, run.id, run.frames, run.model),
                         ("complete", "0123456789abcdef", 3, "crossover"))
        self.assertEqual(run.summary, {"drop": 1.25, "springs": 7})
        self.assertEqual(run.counts, {"distance": 7})
        self.assertEqual(run.get("/mesh/cells"), 16)
        self.assertIsNone(run.get("/mesh/file"))
        # float32 of numbers below 1
        np.testing.assert_allclose(run.positions(-1), SQUARE - [0, 0, 0.2], atol=1e-7)
        np.testing.assert_array_equal(run.cell("max_stretch", 1), [2, 2])
        np.testing.assert_array_equal(run.pinned, [False, False, True, False])
        np.testing.assert_array_equal(run.last_second(), [1, 2])  # 0, 0.5 and 1 s: the second begins after 0
        self.assertAlmostEqual(run.size, 2**0.5, places=15)
        with self.assertRaises(IndexError):
            run.positions(3)
        with self.assertRaises(KeyError):
            run.constraints("distance")

    def test_only_committed_frames_of_an_unfinished_run_count(self):
        write_run(self.folder / "a/run.vtkhdf.part", config_of(), committed=2, extra=1, status="running")
        run, = load.load_runs(self.folder)
        self.assertEqual((run.status, run.frames, len(run.metrics["pin_max_stretch"])), ("interrupted", 2, 2))
        self.assertTrue(np.isfinite(run.positions(-1)).all())

    def test_an_implausible_run_has_all_its_data_and_is_over(self):
        write_run(self.folder / "a/run.vtkhdf", config_of(seed=1), status="implausible",
                  summary={"drop": 9.0})
        write_run(self.folder / "b/run.vtkhdf", config_of(seed=2), status="diverged")
        write_run(self.folder / "c/run.vtkhdf", config_of(seed=3), status="interrupted")
        runs = load.load_runs(self.folder)
        self.assertEqual([(run.status, run.complete, run.over) for run in runs],
                         [("implausible", True, True), ("diverged", False, True),
                          ("interrupted", False, False)])
        self.assertEqual(load.values(runs[:1], "drop").tolist(), [9.0])  # as it was measured, not infinite

    def test_references_are_no_points_of_a_sweep(self):
        write_run(self.folder / "fig5/a/run.vtkhdf", config_of(cells=16))
        write_run(self.folder / "fig5/references/b/run.vtkhdf", config_of(cells=64))
        self.assertEqual([run.get("/mesh/cells") for run in load.load_runs(self.folder / "fig5")], [16])
        self.assertEqual([run.get("/mesh/cells") for run in load.load_runs(self.folder / "fig5/references")],
                         [64])

    def test_what_is_no_run_is_left_out(self):
        (self.folder / "a").mkdir()
        (self.folder / "a/run.vtkhdf").write_bytes(b"cut off")
        self.assertEqual(load.load_runs(self.folder), [])

    def sweep(self, runs, **more):
        """Writes configs/paper/fig1's sweep file: entries (folder, point) as the program would."""
        config = json.loads((sweeps.CONFIGS / "paper/fig1.json").read_text(encoding="utf-8"))
        settings = {key: value for key, value in config.items() if key not in ("sweep", "expect")}
        folder = self.folder / "fig1"
        folder.mkdir()
        (folder / "fig1.sweep.json").write_text(json.dumps({
            "settings": settings, "axes": config["sweep"], "models": {"crossover": "Crossover"},
            "runs": [{"point": point, "id": RUN_ID, "folder": name} for name, point in runs],
            "overrides": [], **more}))
        return folder

    def test_an_experiment_has_the_runs_of_its_sweep_and_names_those_missing(self):
        points = [{"/mesh/cells": cells} for cells in (16, 32, 64, 128)]
        folder = self.sweep([("d", points[0]), ("c", points[1]), ("b", points[2]), (None, points[3])])
        write_run(folder / "trial/run.vtkhdf", config_of("fig1", cells=16, duration=1))  # of another sweep
        write_run(folder / "d/run.vtkhdf", config_of("fig1", cells=16))
        write_run(folder / "c/run.vtkhdf.part", config_of("fig1", cells=32), status="running")
        experiment = sweeps.load_experiment(self.folder, "paper/fig1")
        self.assertEqual([run.point for run in experiment.runs], points[:2])
        self.assertEqual(experiment.missing, ["/mesh/cells 32", "/mesh/cells 64", "/mesh/cells 128"])
        self.assertEqual(style.model_name("discrete_shells"), "discrete_shells")

    def test_runs_of_a_config_that_was_changed_since_are_not_shown(self):
        self.assertEqual(sweeps.load_experiment(self.folder, "paper/fig1").missing_text,
                         "none of its runs")
        folder = self.sweep([("a", {})], axes={"/mesh/cells": [7]})
        write_run(folder / "a/run.vtkhdf", config_of("fig1"))
        experiment = sweeps.load_experiment(self.folder, "paper/fig1")
        self.assertEqual(experiment.runs, [])
        self.assertIn("changed", experiment.missing_text)

    def test_a_trial_is_shown_where_there_is_nothing_else_and_called_so(self):
        folder = self.sweep([("a", {})], axes={}, overrides=["/duration=1"])
        (folder / "fig1.sweep.json").rename(folder / "fig1,0123.sweep.json")
        write_run(folder / "a/run.vtkhdf", config_of("fig1", duration=1))
        experiment = sweeps.load_experiment(self.folder, "paper/fig1")
        self.assertEqual(len(experiment.runs), 1)
        self.assertEqual(experiment.missing_text, "these are of a trial with --set /duration=1")

    def test_all_stands_for_the_choices_that_the_program_lists(self):
        self.assertTrue(sweeps._same_axes({"/bending/model": "all"}, {"/bending/model": ["none"]}))
        self.assertFalse(sweeps._same_axes({"/mesh/cells": [1, 2]}, {"/mesh/cells": [1]}))
        self.assertFalse(sweeps._same_axes({}, {"/mesh/cells": [1]}))

    def test_spread_is_median_and_range(self):
        s = load.spread([5, 1, 2]) - 1
        self.assertEqual((s.median, s.low, s.high, s.count), (1, 0, 4, 3))
        self.assertFalse(load.spread([]).known)

    def test_the_typical_run_is_the_one_nearest_to_the_median_and_all_show_the_same_time(self):
        times = {"time": np.array([0, 0.5, 1.0, 1.5, 2.0])}
        runs = [SimpleNamespace(frames=5, last_second=lambda: np.array([2, 3, 4]),
                                metrics={**times, "pin_max_stretch": np.array([0, 0, *last])})
                for last in ([9, 9, 9], [3, 4, 99], [1, 1, 4])]
        self.assertEqual(load.typical_run(runs), (runs[1], 4))  # medians of the last second: 9, 4 and 1
        self.assertIsNone(load.typical_run([]))


class DistanceTest(unittest.TestCase):
    def test_a_shift_is_as_far_as_it_goes(self):
        rng = np.random.default_rng(1)
        sheet = np.c_[rng.random((500, 2)), np.zeros(500)]
        shift = np.array([0, 0, 0.3])
        self.assertAlmostEqual(rms_distance(sheet, sheet + shift), 0.3, places=14)
        # Straight above is nearest
        self.assertAlmostEqual(hausdorff_distance(sheet, sheet + shift), 0.3, places=14)

    def test_the_farther_direction_counts(self):
        line = np.c_[np.linspace(0, 1, 101), np.zeros((101, 2))]
        half = line[:51]
        self.assertAlmostEqual(hausdorff_distance(line, half), 0.5, places=14)
        self.assertAlmostEqual(hausdorff_distance(half, line), 0.5, places=14)

    def test_concentric_circles_are_their_radii_apart(self):
        angle = 2 * np.pi * np.arange(2000) / 2000
        circle = np.c_[np.cos(angle), np.sin(angle), 0 * angle]
        self.assertAlmostEqual(hausdorff_distance(circle, 1.7 * circle), 0.7, places=13)

    def test_relabelled_vertices_are_the_same_set(self):
        points = np.random.default_rng(2).random((300, 3))
        self.assertEqual(hausdorff_distance(points, points[::-1]), 0)
        self.assertGreater(rms_distance(points, points[::-1]), 0.1)


class RasterTest(unittest.TestCase):
    def test_two_triangles_cover_their_square_without_a_seam(self):
        xy = np.array([[10, 10], [50, 10], [50, 50], [10, 50]], float)
        owner, _ = render.rasterise(xy, np.ones(4), TRIANGLES, (60, 60))
        inside = np.zeros((60, 60), bool)
        inside[10:50, 10:50] = True
        np.testing.assert_array_equal(owner >= 0, inside)

    def test_the_nearer_triangle_wins_in_either_order(self):
        xy = np.array([[0, 0], [20, 0], [0, 20]] * 2, float)
        nearness = np.array([1, 1, 1, 2, 2, 2], float)
        for order in ([[0, 1, 2], [3, 4, 5]], [[3, 4, 5], [0, 1, 2]]):
            owner, best = render.rasterise(xy, nearness, np.array(order), (20, 20))
            self.assertEqual(set(np.array(order)[owner[owner >= 0], 0]), {3})
            self.assertEqual(best.max(), 2)

    def test_interpenetrating_triangles_swap_at_their_intersection(self):
        xy = np.array([[0, 0], [20, 0], [20, 20], [0, 20]] * 2, float)
        nearness = np.array([1, 3, 3, 1, 3, 1, 1, 3], float)  # equal at x = 10
        triangles = np.concatenate([TRIANGLES, TRIANGLES + 4])
        owner, _ = render.rasterise(xy, nearness, triangles, (20, 20))
        self.assertTrue((owner[:, :10] >= 2).all() and (owner[:, 10:] < 2).all())

    def test_a_blown_up_vertex_does_not_move_the_camera(self):
        pin = SQUARE[2]
        blown = SQUARE.copy()
        blown[0] = [300, -200, 900]
        usual = render.camera_for([SQUARE], pin, 2**0.5)
        both = render.camera_for([SQUARE, blown], pin, 2**0.5)
        np.testing.assert_allclose(both.extent, usual.extent, rtol=1e-12)
        self.assertEqual(style.share_outside(SQUARE, both, (100, 80)), 0)
        self.assertEqual(style.share_outside(blown, both, (100, 80)), 0.25)

    def test_a_close_up_shows_what_is_below_the_pin(self):
        for aspect in (0.5, 0.8, 2.0):
            camera = render.camera_for([SQUARE], np.zeros(3), 1.0, elevation=0.0, aspect=aspect, zoom=0.1)
            beside = camera.axes[0] * 0.1
            (x, y), *sides = camera.project(np.array([0 * beside, beside, -beside]), (100, 100))[0]
            self.assertAlmostEqual(x, 50, delta=2)  # perspective
            self.assertTrue(0 < y < 35, (aspect, y))
            self.assertTrue(all(0 < side[0] < 100 for side in sides))

    def test_an_obstacle_hides_the_cloth_behind_it_and_is_grey(self):
        camera = render.Camera(np.array([0.5, 0.5, 5.0]), np.eye(3), (-0.2, 0.2, -0.2, 0.2), -9.0, 1.0)
        red = np.array([[1.0, 0, 0]] * 2)
        is_red = lambda image: image[..., 0] > image[..., 1] + 0.2
        # Below the cloth it is not seen, above it hides half of it
        for height, share in ((-0.5, 1), (0.5, 0.5)):
            solid = SQUARE * [0.5, 1, 0] + [0, 0, height], TRIANGLES
            alone, both = (is_red(render.render(SQUARE, TRIANGLES, red, camera, 100, False, with_it))
                           for with_it in (None, solid))
            self.assertAlmostEqual(both.sum() / alone.sum(), share, delta=0.05)  # perspective: 5 against 4.5


def with_obstacles(effects, surfaces=None):
    """A run with these effects; `surfaces`: index of an effect → points, triangles, velocity."""
    return SimpleNamespace(get=lambda pointer, default=None: effects, config={"effects": effects},
                           obstacles=surfaces or {})


class ObstacleTest(unittest.TestCase):
    def test_surfaces_move_and_a_level_plane_is_left_out(self):
        effects = [{"type": "gravity"}, {"type": "plane", "point": [0, 0, -0.3], "normal": [0, 0, 2]},
                   {"type": "a new one"}, {"type": "plane", "point": [0, 0, 0], "normal": [1, 0, 1]}]
        surface = lambda height, speed: (SQUARE + [0, 0, height], TRIANGLES, np.array([0, 0, speed]))
        run = with_obstacles(effects, {1: surface(0, 0), 2: surface(1, 0.5), 3: surface(2, 0)})
        points, triangles = obstacles.surfaces(run, 4.0)
        np.testing.assert_array_equal(points, np.concatenate([SQUARE + [0, 0, 3], SQUARE + [0, 0, 2]]))
        np.testing.assert_array_equal(triangles, np.concatenate([TRIANGLES, TRIANGLES + 4]))

    def test_a_run_whose_obstacles_were_not_recorded_is_told_from_one_without(self):
        ball = {"type": "sphere", "velocity": [0, 0, 0], "thickness": 0.01}
        wind = {"type": "wind", "velocity": [0, 3, 0]}
        self.assertTrue(obstacles.are_unknown(with_obstacles([wind, ball])))
        self.assertFalse(obstacles.are_unknown(with_obstacles([wind])))
        self.assertFalse(obstacles.are_unknown(with_obstacles([ball], {0: (SQUARE, TRIANGLES, np.zeros(3))})))

    def test_the_clearance_is_the_distance_from_the_surface(self):
        common = {"centre": [0, 0, 1], "axis": [0, 0, 1], "normal": [0, 0, 3], "point": [0, 0, 1],
                  "a": [0, 0, 0], "b": [0, 0, 2], "radius": 0.5, "height": 0.1, "velocity": [0, 0, 1]}
        at = lambda kind, point, time=0: obstacles.clearance(with_obstacles([{"type": kind, **common}]), time,
                                                             np.array([point], float))
        for kind, point, expected in (("plane", [5, 0, 0.8], -0.2), ("sphere", [0, 0.7, 1], 0.2),
                                      ("sphere", [0, 0.4, 1], -0.1), ("capsule", [0.7, 0, 1.4], 0.2),
                                      ("capsule", [0, 0, 2.6], 0.1), ("disc", [0.1, 0, 1.2], 0.15),
                                      ("disc", [0.6, 0, 1], 0.1), ("disc", [0.2, 0.1, 1.03], -0.02),
                                      ("gravity", [0, 0, 0], np.inf)):
            self.assertAlmostEqual(at(kind, point), expected, places=12)
        self.assertAlmostEqual(at("sphere", [0, 0.7, 3], time=2), 0.2, places=12)
        self.assertAlmostEqual(at("disc", [0.53, 0, 1.04]), np.hypot(0.08, 0.04) - 0.05, places=12)

    CUBE = [corners for a, b, c, d in ([0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2],
                                       [1, 3, 7, 5]) for corners in ([a, b, c], [a, c, d])]

    def mesh_clearance(self, triangles, points, time=0.0):
        """Clearance from these triangles of a cube scaled by 2 and moved 5 m to the right, with a velocity of
        1 m/s upwards."""
        corners = np.array([[i % 2, i // 2 % 2, i // 4] for i in range(8)], float)
        surface = 2 * corners + [5, 0, 0], np.array(triangles), np.array([0, 0, 1.0])
        return obstacles.clearance(with_obstacles([{"type": "a new one"}], {0: surface}), time,
                                   np.array(points, float))

    def test_the_clearance_of_a_mesh_is_that_of_the_cube_it_shows(self):
        def expected(points):
            q = np.abs(points - [6, 1, 1]) - 1  # beyond each pair of sides
            return (np.linalg.norm(np.maximum(q, 0), axis=1) + np.minimum(q.max(axis=1), 0)).min()
        rng = np.random.default_rng(4)
        # around, beside and within; 1e-12: coordinates of some 8 m rounded, squared and summed
        for _ in range(50):
            alone = rng.uniform([4, -1, -1], [8, 3, 3], (1, 3))
            self.assertAlmostEqual(self.mesh_clearance(self.CUBE, alone), expected(alone), delta=1e-12)
            many = np.array([6, 1, 1]) + rng.uniform(-1, 1, (200, 3)) * [9, 5, 5]
            many = many[(np.abs(many - [6, 1, 1]) > 1 + rng.random()).any(axis=1)]
            self.assertAlmostEqual(self.mesh_clearance(self.CUBE, many), expected(many), delta=1e-12)
        for point, distance in (([6, 1, 1], -1), ([6, 1, 2.5], 0.5), ([8, 3, 1], 2**0.5),
                                ([4, -1, 3], 3**0.5),
                                # Over the middle and the diagonals of faces
                                ([6, 1, 1.75], -0.25), ([5.5, 0.5, 1.9], -0.1)):
            self.assertAlmostEqual(self.mesh_clearance(self.CUBE, [point]), distance, delta=1e-12)
        self.assertAlmostEqual(self.mesh_clearance(self.CUBE, [[6, 1, 5.5]], time=3), 0.5, delta=1e-12)
        self.assertAlmostEqual(self.mesh_clearance(self.CUBE, [[6, 1, 4], [6, 1, 0.3], [6, 1, 0.1]]), -0.3,
                               delta=1e-12)

    def test_an_open_mesh_has_no_inside(self):
        without_bottom = self.CUBE[2:]
        for point, distance in (([6, 1.1, 0.3], 0.9), ([6, 1, 2.5], 0.5), ([6, 1, -0.5], np.hypot(1, 0.5))):
            self.assertAlmostEqual(self.mesh_clearance(without_bottom, [point]), distance, delta=1e-12)

    def test_a_level_plane_is_the_floor(self):
        level = {"type": "plane", "point": [0, 0, -0.3], "normal": [0, 0, 2]}
        self.assertEqual(obstacles.floor_of({"effects": [level]}), -0.3)
        self.assertIsNone(obstacles.floor_of({"effects": [{**level, "normal": [1, 0, 1]}]}))


class FigureTest(unittest.TestCase):
    def test_the_factors_add_up_to_the_whole(self):
        # Stretch - 1
        pin = {("crossover", 0): 10, ("crossover", 1): 2, ("adaptive", 0): 5, ("adaptive", 1): 1}
        runs = []
        for (model, ring), excess in pin.items():
            config = config_of(model=model)
            config["pins"]["ring"] = ring
            runs.append(load.Run(Path("-"), "", "", "complete", config, {"pin_max_stretch": 1.0 + excess},
                                 {"time": []}))
        effect = fig_5.factors(fig_5.Grid(runs, "floor"), 16, "pin_max_stretch")
        self.assertAlmostEqual(effect["whole"], 1, places=14)  # 10 → 1
        self.assertAlmostEqual(effect["model"], np.log10(2), places=14)  # 10 → 5 and 2 → 1
        self.assertAlmostEqual(effect["ring"], np.log10(5), places=14)  # 10 → 2 and 5 → 1
        self.assertAlmostEqual(effect["interaction"], 0, places=14)

    def test_the_elastica_bends_as_the_master_curve(self):
        # Tip over length at Γ = weight length³ / rigidity: Γ/8 where it is small, else a solution of the
        # boundary value problem to 10 digits; the midpoint rule over 400 points is good to (1/400)² times
        # some 10.
        for gamma, x, y in ((0.01, 0.999999, 0.001250), (1, 0.991246, 0.123471), (10, 0.656354, 0.700200)):
            tip = fig_models.elastica(gamma, 1, 1)[-1]
            np.testing.assert_allclose(tip, [x, -y], atol=1e-4)
        np.testing.assert_allclose(fig_models.elastica(10 / 8, 2, 1)[-1], [2 * 0.656354, -2 * 0.7002],
                                   atol=2e-4)

    def test_the_cost_of_a_model_by_hand(self):
        config = {"bending": {"model": "dihedral"}, "solver": {"dt": 0.5, "substeps": 2, "iterations": 10}}
        passes = {"strain": 2.0, "bending": 3.0, "predict": 1.0, "recording": 4.0}
        runs = [load.Run(Path("-"), "", "", "complete", config, {"bending_constraints": 50, "vertices": 25},
                         {"time": np.array([0, 4.0])}, cpu_s=cpu, passes=passes) for cpu in (10, 5, 20)]
        # 8 steps of 20 projections; half of each pass's wall time was the processor's
        c = fig_models.cost(runs)
        self.assertAlmostEqual(c["strain"], 1e3 / 8)
        self.assertAlmostEqual(c["bending"], 1.5e3 / 8)
        self.assertAlmostEqual(c["rest"], 0.5e3 / 8)
        self.assertAlmostEqual(c["ns"], 1.5e9 / (8 * 20 * 50))
        self.assertEqual(c["per_vertex"], 2)

    def test_the_side_of_a_strip_is_the_mean_of_its_rows(self):
        rest = np.array([[x, y, 0] for x in (-2, -1, 0, 1) for y in (0, 1)], float)
        hung = rest + np.repeat([[0, 0, 5], [0, 0, 5], [-0.2, 0, 4], [-0.8, 0, 3]], 2, axis=0)
        hung[5] += [0.2, 0, -0.5]  # one end of a row
        strip = SimpleNamespace(rest_positions=rest, pinned=rest[:, 0] < -0.5, positions=lambda frame: hung)
        np.testing.assert_allclose(fig_models.profile(strip), [[0, 0], [0.9, -1.25], [1.2, -2]], atol=1e-15)

    def test_every_model_that_is_swept_has_a_colour_and_a_name(self):
        for name in ("hanging_sheet", "cantilever", "cantilever_rigidity"):
            sweep = json.loads((sweeps.CONFIGS / f"models/{name}.json").read_text())["sweep"]
            models = sweep.get("/bending/model") or [value["model"] for value in sweep["/bending"]]
            self.assertLessEqual(set(models), set(registry.models()))

    def test_every_scene_has_a_view_and_its_models_a_name(self):
        configs = {path.stem: json.loads(path.read_text()) for path in sweeps.CONFIGS.glob("scenes/*.json")}
        times = {name: view.time for name, view in fig_scenes.SCENES.items()} | fig_large_forces.SCENES
        self.assertEqual(set(configs), set(times))
        for name, config in configs.items():
            self.assertEqual(config["name"], name)
            self.assertLessEqual(set(config["sweep"]["/bending/model"]), set(registry.models()))
            self.assertLessEqual(times[name], config["duration"])

    def test_the_title_of_the_scenes_counts_what_went_wrong(self):
        def run(model, status, stretch, needles):
            summary = {"max_stretch": stretch, "degenerate_triangles": needles}
            floor = {"type": "plane", "point": [0, 0, 0.5 if model == "adaptive" else -1],
                     "normal": [0, 0, 1], "velocity": [0, 0, 0]}
            config = {"bending": {"model": model}, "effects": [floor]}
            return SimpleNamespace(model=model, complete=status == "complete", config=config, summary=summary,
                                   frames=1, metrics={"time": [0.0]}, positions=lambda frame: SQUARE,
                                   triangles=TRIANGLES, obstacles={}, get=lambda *_: [floor])
        runs = [run("adaptive", "complete", 1.1, 0), run("crossover", "complete", 1.5, 2),
                run("lod", "diverged", 9, 50)]
        title = fig_scenes.title({"flag": SimpleNamespace(runs=runs)})
        self.assertIn("2 of 3 runs complete", title)
        self.assertIn("Last frame: 1 have a degenerate triangle, 1 reach into an obstacle", title)
        self.assertIn("1.50 (flag, crossover)", title)

    def test_the_titles_say_what_the_runs_say(self):
        def run(model, strain):
            return load.Run(Path("-"), "", "", "complete", {"bending": {"model": model}},
                            {"mean_strain": strain}, {"time": []})
        runs = {("none", 1): [run("none", 25.0)], ("adaptive", 1): [run("adaptive", 0.05)],
                ("lod", 1): [run("lod", 0.5)]}
        title = fig_models.sheet_title([1], ["none", "adaptive", "lod"], runs)
        self.assertEqual(title, "One substep: 1 of 3 models keep the mean strain below 10 %; it exceeds 100 "
                         "% with none")

    def test_a_page_without_runs_says_what_is_missing(self):
        with tempfile.TemporaryDirectory() as folder:
            page.main(Path(folder), Path(folder) / "paper")
            claims = json.loads((Path(folder) / "paper/summary.json").read_text())
            text = (Path(folder) / "paper/index.html").read_text()
        self.assertEqual({claim["holds"] for claim in claims}, {None})
        self.assertEqual({claim["figure"][0] for claim in claims}, set("12567o"))  # "ours"
        self.assertIn("configs/paper/fig1.json: none of its runs", text)

    def test_rings_of_a_strip(self):
        triangles = np.array([[i, i + 1, i + 2] for i in range(6)])  # i touches i + 1 and i + 2
        np.testing.assert_array_equal(fig_structure.ring_of(triangles, 0, 8), [0, 1, 1, 2, 2, 3, 3, 4])

    def test_rounded_shades_are_those_drawn_but_for_one(self):
        image = np.random.default_rng(5).random((60, 60, 3))
        shades = []
        with tempfile.TemporaryDirectory() as folder:
            for large in (np.inf, 0):
                figure = style.plt.figure(figsize=(1, 1))
                figure.figimage(image)
                with mock.patch.object(style, "LARGE", large):
                    name = style.save(figure, folder, "noise", palette=False)
                shades.append(style.plt.imread(Path(folder) / name)[..., :3] * 255)
        # Half a step of 3, in single precision
        self.assertLessEqual(np.abs(shades[1] - shades[0]).max(), 1.001)
        self.assertEqual(shades[1].max(), 255)
        np.testing.assert_allclose(np.unique(np.rint(shades[1])) % 3, 0)

    def test_a_panel_says_its_time_and_whether_the_cloth_rests(self):
        speed = {3: 1.1 * style.REST * 2**0.5, 4: 0.9 * style.REST * 2**0.5}  # m/s; the square's size is √2
        run = SimpleNamespace(metrics={"time": np.array([0, 0.5, 1.0, 1.5, 2.0])}, size=2**0.5,
                              positions=lambda frame: SQUARE + [0, 0, 0.5 * speed.get(frame, 0)])
        self.assertEqual(style.time_text(run, 0), "t = 0.0 s")
        self.assertEqual(style.time_text(run, 3), "t = 1.5 s")
        run.positions = lambda frame: SQUARE + [0, 0, 0.5 * speed[4] * (frame == 4)]
        self.assertEqual(style.time_text(run, 4), "at rest, t = 2.0 s")
        run.metrics["time"] = np.array([0, 1 / 15])
        self.assertEqual(style.time_text(run, 1), "at rest, t = 0.07 s")

    def test_the_time_stands_where_no_cloth_is(self):
        left, low = np.array([[10.0, 5.0], [20, 8], [np.nan, 1]]), np.array([[10.0, 90.0]])
        self.assertIs(style.free_corner(left, (100, 100)), style.RIGHT)
        self.assertIs(style.free_corner(100 - left, (100, 100)), style.LEFT)  # below
        self.assertIs(style.free_corner(low, (100, 100)), style.LEFT)

    def test_every_cloth_has_its_time_in_the_corner(self):
        square = SimpleNamespace(metrics={"time": np.array([3.0])}, size=2**0.5, rest_positions=SQUARE,
                                 triangles=TRIANGLES, pinned=np.array([True, False, False, False]),
                                 pin_seeds=np.array([0]), positions=lambda frame: SQUARE,
                                 cell=lambda name, frame: np.ones(2))
        figure, axes = style.plt.subplots()
        style.draw_cloth(axes, (square, 0), style.camera_of([(square, 0)]), width=40)
        self.assertIn("t = 3.0 s", [text.get_text() for text in axes.texts])
        style.plt.close(figure)

    def test_cloths_have_one_scale_and_the_largest_that_holds_fills_its_panel(self):
        def sample(height, strain, shift=0.0):
            cloth = np.array([[0, 0, 0], [0.1, 0, 0], [0.1, 0, -height], [0, 0, -height]]) + [0, 0, shift]
            return SimpleNamespace(metrics={"mean_strain": [strain]}, size=1.0, rest_positions=SQUARE,
                                   pin_seeds=np.array([0]), positions=lambda frame: cloth), 0
        samples = [sample(0.5, 0.1), sample(1.0, 0.1, shift=7.0), None, sample(40.0, 5.0)]
        cameras = style.cameras_of(samples, elevation=0.0, azimuth=-90.0)
        self.assertIsNone(cameras[2])
        heights = []
        for camera, (run, _) in zip(cameras[:2], samples[:2]):
            y = camera.project(run.positions(0), (100, 80))[0][:, 1]
            self.assertAlmostEqual((y.min() + y.max()) / 2, 50, delta=3)  # in the middle
            heights.append(np.ptp(y))
        self.assertAlmostEqual(heights[1] / 100, 1 / 1.12, places=2)  # but for the margin
        self.assertAlmostEqual(heights[0] / heights[1], 0.5, places=2)

    def test_labels_that_would_overlap_are_spread_and_others_stay(self):
        spread = lambda places, heights, *limits: style.spread(places, heights, *limits).tolist()
        self.assertEqual(spread([5, 1], [1, 1]), [5, 1])
        self.assertEqual(spread([0, 0, 0], [1, 1, 1]), [-1, 0, 1])  # about their mean
        self.assertEqual(spread([0, 0], [3, 1]), [-1, 1])  # half of both heights apart
        self.assertEqual(spread([9, 9.5], [1, 1], 0, 10), [8.5, 9.5])  # the upper one ends at 10
        rng = np.random.default_rng(3)
        places, heights = rng.random(30), rng.uniform(0.01, 0.2, 30)
        found = style.spread(places, heights)
        order = np.argsort(places)
        gaps, least = np.diff(found[order]), (heights[order][1:] + heights[order][:-1]) / 2
        self.assertTrue((gaps >= least - 1e-12).all())
        # A least squares answer does not improve if labels that touch move together
        blocks = np.split(order, np.flatnonzero(gaps > least + 1e-9) + 1)
        for block in blocks:
            self.assertAlmostEqual(np.mean(found[block] - places[block]), 0)

    def test_curves_that_lie_on_one_another_share_a_label(self):
        figure, axes = style.plt.subplots(layout="constrained")
        x = np.arange(1, 6)
        for name, y in (("a", x), ("b", x + 1e-4), ("c", 9 - x), ("d", np.r_[x[:4], 9])):
            axes.plot(x, y, label=name)
        style.label_ends(axes)
        self.assertEqual([text.get_text() for text in axes.texts], ["a", "= b", "c", "d"])
        figure.draw_without_rendering()
        boxes = sorted((text.get_window_extent() for text in axes.texts), key=lambda box: box.y0)
        for low, high in zip(boxes, boxes[1:]):
            self.assertLessEqual(low.y1, high.y0 + 1)
        self.assertLessEqual(max(box.x1 for box in boxes), figure.bbox.x1)  # the layout made room
        style.plt.close(figure)

    def test_the_colour_blind_tell_the_models_of_a_family_apart(self):
        # Machado, Oliveira and Fernandes 2009, severity 1, on linear RGB: red, green and blue blind
        sights = [np.eye(3), [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216],
                              [-0.003882, -0.048116, 1.051998]],
                  [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413],
                   [-0.011820, 0.042940, 0.968881]],
                  [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602],
                   [0.004733, 0.691367, 0.303900]]]
        to_xyz = np.array([[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]])

        def lab(colour, sight):
            shade = np.array([int(colour[i:i + 2], 16) for i in (1, 3, 5)]) / 255
            linear = np.clip(sight @ np.where(shade > 0.04045, ((shade + 0.055) / 1.055)**2.4, shade / 12.92),
                             0, 1)
            ratio = to_xyz @ linear / to_xyz.sum(axis=1)
            x, y, z = np.where(ratio > 0.008856, np.cbrt(ratio), 7.787 * ratio + 16 / 116)
            return np.array([116 * y - 16, 500 * (x - y), 200 * (y - z)])

        families = list(group(registry.models(), style.family).values())
        for family, sight in itertools.product(families, map(np.array, sights)):
            for one, other in itertools.combinations(family, 2):
                apart = np.linalg.norm(lab(style.colour(one), sight) - lab(style.colour(other), sight))
                self.assertGreater(apart, 15, (one, other))  # 2.3 is just noticeable
        kinds = [{style.marker(model) for model in family} for family in families]
        for one, other in itertools.combinations(kinds, 2):
            self.assertFalse(one & other)

    def test_numbers_are_written_for_readers(self):
        self.assertEqual([style.number(x) for x in (0.12345, 12.345, 1234.5, 0, np.inf, np.nan)],
                         ["0.123", "12.3", "1234", "0", "∞", "–"])
        self.assertEqual(rounded({"a": [0.123456, np.inf, np.nan, True, "x"]}),
                         {"a": [0.1235, "inf", None, True, "x"]})


class StabilityTest(unittest.TestCase):
    CASE = stability_cases.Case("fall: free", "falls", "fall", {}, {}, energy=True)
    CALM = dict(mean_strain=0.004, stability_reach=0.5, stability_reach_start=0.5, stability_reach_end=0.5,
                stability_rest_distance=0.001, stability_energy_gain=0.0, stability_momentum_drift=1e-9,
                stability_rounding_speed=1e-7, projections=100, vertices=100)

    def judged(self, status="complete", control=None, **summary):
        run = lambda status, summary: SimpleNamespace(status=status, summary={**self.CALM, **summary},
                                                      metrics={"time": [0, 0.25]},
                                                      complete=status == "complete", model="none")
        cell = stability_cases.judge(run(status, summary), control and run("complete", control), self.CASE)
        return cell.verdict, cell.worst.name

    def test_every_rule_has_its_colour(self):
        self.assertEqual(self.judged()[0], "green")
        self.assertEqual(self.judged(mean_strain=0.03), ("amber", "mean strain"))
        # Twice the undisturbed
        self.assertEqual(self.judged(mean_strain=0.03, control={"mean_strain": 0.02})[0], "green")
        # The limit does not grow with a strained control
        self.assertEqual(self.judged(mean_strain=0.3, control={"mean_strain": 5})[0], "amber")
        self.assertEqual(self.judged(stability_rest_distance=0.02), ("amber", "distance from rest"))
        self.assertEqual(self.judged(stability_reach=9), ("red", "largest reach"))
        self.assertEqual(self.judged(stability_reach=9, stability_reach_start=5)[0], "green")
        self.assertEqual(self.judged(stability_reach=9, stability_reach_start=5, stability_reach_end=3),
                         ("red", "reach at the end"))
        self.assertEqual(self.judged(stability_energy_gain=0.1), ("red", "energy gained"))
        self.assertEqual(self.judged(stability_momentum_drift=1e-3), ("red", "momentum gained, as a speed"))
        self.assertEqual(self.judged(status="diverged"), ("red", "diverged after"))
        self.assertEqual(self.judged(mean_strain=np.nan)[0], "red")

    def test_strain_alone_is_never_red(self):
        for strain in (0.03, 1.0, 30.0, 1e6):  # the cloth stays where it was
            self.assertEqual(self.judged(mean_strain=strain), ("amber", "mean strain"))
        self.assertEqual(self.judged(mean_strain=1e6, stability_reach_end=3)[0], "red")

    def test_one_still_per_way_to_fail(self):
        cases, cells = stability_cases.CASES[:3], {}
        for case, model, verdict, name, value in ((0, "none", "red", "reach", 7),
                                                  (0, "lod", "red", "reach", 9),
                                                  (0, "k_ring", "red", "energy", 2),
                                                  (0, "adaptive", "amber", "mean strain", 99),
                                                  (1, "none", "amber", "mean strain", 3),
                                                  (1, "lod", "amber", "mean strain", np.nan),
                                                  (2, "none", "green", "mean strain", 1)):
            worst = stability_cases.Criterion(name, value, 1.0, "1", verdict)
            cell = SimpleNamespace(case=cases[case], model=model, verdict=verdict, worst=worst)
            cells[cases[case].name, model, "single"] = cell
        found = [(cell.case.name, cell.model, alike) for cell, alike in fig_stability.shown(cells, cases)]
        self.assertEqual(found, [(cases[0].name, "lod", 2), (cases[0].name, "k_ring", 1),
                                 (cases[1].name, "lod", 2)])

    def test_a_cloth_of_any_extent_fits_the_frame_of_its_still(self):
        size, rng = 2**0.5, np.random.default_rng(7)
        for extent in ((0, 0, 0), (1, 0, 0), (0, 0, 400), (1e-6, 1e-6, 1e-6), (100, 1, 1), (3, 300, 20)):
            cloth = rng.uniform(-0.5, 0.5, (200, 3)) * extent + [5, -7, 3]
            camera = render.camera_around(np.concatenate([cloth, [[np.nan] * 3]]), size / 2)
            pixels, nearness = camera.project(cloth, (200, 200))
            self.assertTrue((nearness > 0).all())
            self.assertTrue((pixels > 2).all() and (pixels < 198).all(), extent)
            if max(extent) > size:  # and fills it
                self.assertGreater(np.ptp(pixels, axis=0).max(), 160)

    def test_a_thread_is_drawn_as_lines(self):
        thread, wide = np.array([[0, 0], [0.2, 50], [0, 100], [60, 0]]), np.array([[0, 1, 2], [0, 1, 3]])
        lines = fig_stability._slivers(thread, wide, np.zeros((2, 3))).get_segments()
        self.assertEqual(len(lines), 1)
        np.testing.assert_array_equal(np.sort(lines[0][:, 1]), [0, 100])  # along its longest edge

    def test_needles_are_the_flawed_triangles(self):
        rest = np.array([[0, 0, 0], [1, 0, 0], [1, 0.001, 0], [0, 1, 0]])
        run = SimpleNamespace(rest_positions=rest, triangles=np.array([[0, 1, 2], [0, 1, 3]]),
                              cell=lambda name, frame: np.array([4.0, 2.0]))
        np.testing.assert_array_equal(stability_reasons.flawed_triangles(run), [True, False])
        self.assertAlmostEqual(stability_reasons.flawed_strain(run), 75)

    def test_only_cases_that_tell_runs_apart_are_rows_and_the_others_are_named(self):
        cases = [stability_cases.CASES[i] for i in range(4)]
        verdicts = ["green green", "amber red", "red red", ""]  # in single and in double precision
        cells = {(case.name, "none", precision): SimpleNamespace(verdict=verdict)
                 for case, both in zip(cases, verdicts)
                 for precision, verdict in zip(("single", "double"), both.split())}
        telling, alike = fig_stability.folded(cells, cases)
        self.assertEqual(telling, [cases[1]])
        self.assertEqual(alike, {"green": [cases[0]], "red": [cases[2]]})  # the last one has no runs
        self.assertEqual(fig_stability.alike_text(alike), "not shown: 1 all green, 1 all red")
        runs = [hard_run(*place, cell.verdict) for place, cell in cells.items()]
        matrix, others = stability_matrix.cases_html(runs)
        self.assertIn("The 2 cases in which all runs have one colour", others)
        self.assertIn(f"all red</span>: start poses: {cases[2].title}<", others)
        self.assertNotIn(cases[1].title, others)
        self.assertIn(cases[1].title, matrix)
        self.assertIn("aria-label='none, double: red'>×<", matrix)

    def test_cases_that_tell_most_come_first(self):
        of = lambda *verdicts: [hard_run("start: point", str(i), "single", verdict)
                                for i, verdict in enumerate(verdicts)]
        ordered = sorted([of("red", "green"), of("amber", "green"), of("red", "red"),
                          of("red", *["green"] * 9)], key=stability_matrix.discrimination, reverse=True)
        self.assertEqual([len(some) for some in ordered], [2, 10, 2, 2])
        self.assertEqual(stability_matrix.discrimination(ordered[-1]), 0)  # all red

    def test_a_cell_opens_its_run_with_limit_config_and_command(self):
        runs = [hard_run("start: creased", "adaptive", "single", "red", why="it folds"),
                hard_run("gust: gale", "adaptive", "double", "green")]
        told = stability_matrix.data(runs)
        one, other = told["runs"]
        self.assertEqual(one["command"], "./bendlab run configs/stability/start.json --set "
                         "'/initial={\"creases\": 31}' --set '/solver/precision=single'")
        self.assertEqual(told["texts"][one["why"]], "it folds")
        self.assertEqual((one["worst"]["value"], one["worst"]["limit"], one["worst"]["held"]), (2, 1, False))
        settings = told["settings"][one["base"]] | {pointer: value[0]
                                                    for pointer, value in one["changes"].items() if value}
        self.assertEqual(settings["/initial/creases"], 31)
        self.assertEqual(settings["/solver/precision"], "single")
        self.assertIn("/effects/0/type", told["settings"][other["base"]])
        self.assertEqual(other["status"], "green")

    def test_models_that_share_a_reason_share_a_row(self):
        worst = lambda value: stability_cases.Criterion("mean strain", value, 0.2, "1", "amber")
        cells = [hard_run("start: point", model, precision, "amber", worst(value).as_json(), why)
                 for model, precision, value, why in [("none", "single", 0.5, "it slips"),
                                                      ("none", "double", 0.25, "it slips"),
                                                      ("adaptive", "double", 0.75, "it slips"),
                                                      ("dihedral", "double", 3.0, "")]]
        text = stability_page.failed_html(cells, 3)
        self.assertEqual(text.count("<tr>"), 3)  # the head and two rows
        self.assertIn("none, adaptive (double)</td><td class=t>mean strain 0.250 to 0.750", text)
        self.assertEqual(text.count("it slips"), 1)
        self.assertIn(f"<li>{stability_page.UNKNOWN}</li>", text)

    def test_every_reason_is_of_a_case_and_names_a_number(self):
        names = [case.name for case in stability_cases.CASES]
        for one in stability_reasons.REASONS:
            self.assertRegex(one.text, r"\d")
            for quantity, case, models in stability_reasons.PLACE.findall(one.text):
                self.assertIn(quantity, stability_reasons.QUANTITIES)
                self.assertTrue(any(name.startswith(case) for name in names), case)
                self.assertLessEqual(set(models.split()), set(registry.models()))
            for part in filter(None, one.apart.split("; ")):
                self.assertTrue((sweeps.CONFIGS / f"stability/{part.split()[0]}.json").is_file(), part)
            for beginning in one.cases:
                self.assertTrue(any(name.startswith(beginning) for name in names), beginning)
            self.assertLessEqual(set(one.models), set(registry.models()))

    def test_a_reason_needs_its_number(self):
        cell = lambda name, status="complete", **numbers: SimpleNamespace(case=SimpleNamespace(name=name),
                                                                          model="none",
                                                                          run=SimpleNamespace(
                                                                          complete=status == "complete",
                                                                          summary=numbers))
        folded = stability_reasons.reason(cell("start: creased", stability_shut_hinges=0.3))
        self.assertIn("fold", folded.text)
        self.assertIsNone(stability_reasons.reason(cell("start: creased", stability_shut_hinges=0.0)))
        self.assertIsNone(stability_reasons.reason(cell("start: creased", "diverged",
                                                        stability_shut_hinges=0.3)))
        bare, ring = (stability_reasons.reason(cell(name, mean_strain=0.5))
                      for name in ("pins: one bare", "pins: one"))
        self.assertNotEqual(bare, ring)  # one name begins with the other

    def test_the_numbers_of_a_reason_are_the_pages_and_the_others_have_a_command(self):
        def cell(model, precision, strain):
            run = SimpleNamespace(complete=True, summary={"mean_strain": strain})
            return stability_cases.Cell(SimpleNamespace(name="stiff: k = 1"), run, "amber",
                                        None), model, precision
        cells = {}
        for one, model, precision in (cell("dihedral", "double", 1.052), cell("dihedral", "single", 9.0),
                                      cell("none", "double", 0.94)):
            one.run.model = model
            cells[one.case.name, model, precision] = one
        stability_reasons.explain(cells)
        text = cells["stiff: k = 1", "none", "double"].why
        self.assertIn("1.1 → 0.067 (dihedral), 0.94 → 0.059", text)
        self.assertIn("apart from this page", text)
        self.assertIn("./bendlab run configs/stability/stiff.json --set /solver/iterations=100", text)

    def test_every_place_of_every_sweep_is_a_case_or_what_one_is_compared_with(self):
        # 1 and 1.0 are equal
        canonical = lambda value: json.dumps(json.loads(json.dumps(value), parse_int=float), sort_keys=True)

        def places(sweep):
            swept = {pointer: values for pointer, values in sweep.items() if pointer not in
                     ("/bending/model", "/bending", "/solver/precision", "/solver/order", "/solver")}
            return [(pointer, canonical(index if pointer == "/effects" else value))
                    for pointer, values in swept.items() for index, value in enumerate(values)]

        for folder, cases in ((stability_cases.FOLDER, stability_cases.CASES),
                              (stability_cases.METHODS, stability_cases.METHOD_CASES)):
            for config in sorted(sweeps.CONFIGS.glob(f"{folder}/*.json")):
                used = {(pointer, canonical(value)) for case in cases
                        for of, wanted in ((case.config, case.where),
                                           (case.control_config or case.config, case.control))
                        if of == config.stem for pointer, value in wanted.items()}
                there = set(places(json.loads(config.read_text(encoding="utf-8"))["sweep"]))
                self.assertEqual(used, there, config)

    def test_cases_by_methods_are_the_scenes_of_the_hard_cases(self):
        read = lambda place: json.loads((sweeps.CONFIGS / f"{place}.json").read_text(encoding="utf-8"))
        scene = ("pins", "effects", "initial")
        for name in stability_cases.REPEATED:
            by_hand = read(f"stability/{name}")
            for end in ("", stability_cases.BY_NEWTON):
                config = read(f"methods/{name}{end}")
                self.assertEqual(config["name"], f"methods_{name}{end}")
                self.assertEqual(config["output"], by_hand["output"])
                self.assertEqual([config.get(key) for key in scene], [by_hand.get(key) for key in scene])
                self.assertEqual(set(config["sweep"]) - {"/solver"},
                                 set(by_hand["sweep"]) - {"/solver/precision"})
        self.assertEqual(len(list((sweeps.CONFIGS / "methods").glob("*.json"))),
                         2 * len(stability_cases.REPEATED))

    @staticmethod
    def by_method(case, model, method, verdict, value=2.0):
        config = "methods/" + next(one.config for one in stability_cases.METHOD_CASES if one.name == case)
        solver = {"method": method.split(",")[0]} | ({"integrator": "euler"} if "euler" in method else {})
        run = hard_run(case, model, "", verdict, {"what": "reach", "value": value, "limit": 1, "unit": "1"})
        del run["precision"]
        return run | {"method": method, "config": config,
                      "point": {"/solver": solver, "/initial": {"random": 1}, "/bending/model": model}}

    def test_a_cell_of_methods_has_its_worst_models_and_how_many_of_how_many(self):
        case = "start: random"
        runs = [self.by_method(case, "none", "pbd", "red", 3), self.by_method(case, "lod", "pbd", "red", 9),
                self.by_method(case, "dihedral", "pbd", "green"),
                self.by_method(case, "none", "newton, euler", "amber"),
                self.by_method("start: mirrored", "none", "pbd", "green", 0.5),
                self.by_method("start: mirrored", "none", "newton, euler", "green", 0.5)]
        table, alike = stability_methods.table_html(runs)
        self.assertIn("data-run='start-random.lod.pbd start-random.none.pbd'", table)  # the worst first
        self.assertIn("status red' title='red'>2 of 3<", table)
        self.assertIn("status amber' title='amber'>1 of 1<", table)
        self.assertNotIn("mirrored", table)
        self.assertIn("all green</span>: start poses: mirrored<", alike)
        self.assertEqual(stability_methods.answer(runs), "Unstable with at least one model: newton, euler in "
                         "0 of 2; pbd in 1 of 2 cases.")

    def test_a_run_by_a_method_opens_beside_those_by_precision(self):
        runs = [hard_run("start: random", "none", "single", "green"),
                self.by_method("start: random", "none", "newton, euler", "red")]
        told = stability_matrix.data(runs)
        one, other = told["runs"]
        self.assertEqual([one["id"], other["id"]],
                         ["start-random.none.single", "start-random.none.newton-euler"])
        self.assertIn("./bendlab run configs/methods/start.json --set '/solver=", other["command"])
        self.assertTrue(other["title"].endswith("none, newton, euler"))
        settings = told["settings"][other["base"]] | {pointer: value[0] for pointer, value
                                                      in other["changes"].items() if value}
        self.assertEqual((settings["/solver/integrator"], settings["/initial/random"]), ("euler", 1))
        self.assertNotIn("stills", other)  # there is no picture of it

    def test_a_method_has_its_integrator_only_if_that_is_not_its_default(self):
        self.assertEqual([load.method_name(solver) for solver in
                          ({}, {"method": "newton", "integrator": "bdf2"},
                           {"method": "newton", "integrator": "euler"},
                           {"method": "quasi_newton", "integrator": "euler"},
                           {"method": "quasi_newton", "integrator": "bdf2"})],
                         ["pbd", "newton", "newton, euler", "quasi_newton", "quasi_newton, bdf2"])

    def test_the_overview_counts_shares_and_says_what_its_control_is(self):
        cells = {(name, model, precision): SimpleNamespace(verdict=verdict, model=model)
                 for name, model, precision, verdict in [("meshes: grid", "none", "single", "amber"),
                                                         ("meshes: grid", "none", "double", "green"),
                                                         ("flaws: hole", "none", "single", "red"),
                                                         ("flaws: hole", "none", "double", "green"),
                                                         ("meshes: grid", "dihedral", "single", "green")]}
        runs = [hard_run(*place, cell.verdict) for place, cell in cells.items()]
        text = stability_matrix.groups_html(runs)
        self.assertEqual(stability_matrix.models_of(runs), ["dihedral", "none"])  # 0 of 1, 1 of 4
        self.assertIn(">25 %<", text)
        self.assertIn("aria-label='1 red, 1 amber, 2 green'", text)
        self.assertIn("amber for 1 of 2 models", stability_page.plain_grid(runs))
        self.assertEqual(stability_page.plain_grid([]), "")

    def test_a_page_without_runs_says_what_is_missing(self):
        with tempfile.TemporaryDirectory() as folder:
            section = stability_page.main(Path(folder), Path(folder) / "page")
            self.assertEqual(section.cells, {})
            self.assertIn("Runs that are missing",
                          (Path(folder) / "page/index.html").read_text(encoding="utf-8"))


class PlainTest(unittest.TestCase):
    """Bounds of the plain matrix on motions whose numbers are known."""

    @staticmethod
    def sheet(cells=4, pins=(), velocity=(0, 0, 0)):
        """A stand-in for plain_cases.Scene: a unit square of cells × cells squares at rest, one frame."""
        x, y = np.meshgrid(np.linspace(0, 1, cells + 1), np.linspace(0, 1, cells + 1))
        rest = np.stack([x.ravel(), y.ravel(), 0 * x.ravel()], axis=1)
        corner = (np.arange(cells)[:, None] * (cells + 1) + np.arange(cells)).ravel()
        triangles = np.concatenate([np.stack([corner, corner + 1, corner + cells + 2], axis=1),
                                    np.stack([corner, corner + cells + 2, corner + cells + 1], axis=1)])
        pinned = np.isin(np.arange(len(rest)), pins)
        scene = SimpleNamespace(rest=rest, triangles=triangles, pins=np.flatnonzero(pinned), size=np.sqrt(2),
                                gravity=np.array([0, 0, -9.81]), h=0.01, second_order=False,
                                frames=rest[None], time=np.zeros(1),
                                velocity=np.tile(np.array(velocity, float), (len(rest), 1)),
                                run=SimpleNamespace(pinned=pinned))
        scene.velocity[scene.pins] = 0
        scene.mass = plain_cases.Scene._masses(scene)
        return scene

    def test_steps_of_free_fall_are_free_fall(self):
        scene = self.sheet(velocity=(0.3, 0, 1))
        place, speed, frames = scene.rest.copy(), scene.velocity.copy(), []
        for step in range(31):
            if step % 10 == 0:
                frames.append(place.copy())
            speed = speed + scene.h * scene.gravity
            place = place + scene.h * speed
        scene.frames, scene.time = np.array(frames), 10 * scene.h * np.arange(4)
        self.assertLess(plain_cases.fall_error(scene), 1e-12)
        self.assertLess(plain_cases.energy_gain(scene), 1e-12)
        self.assertLessEqual(plain_cases.speed(scene), 1)
        # Gravity 9.81, thrown up by 1: would be lower by 0.18
        scene.frames = np.repeat(scene.rest[None], 4, axis=0)
        self.assertGreater(plain_cases.fall_error(scene), 0.1)

    def test_steps_of_bdf2_fall_as_their_closed_form(self):
        h, g = 0.02, -9.81
        place, speed = [0, g * h ** 2], [0, g * h]  # the first step is one of backward Euler
        for _ in range(20):
            speed.append((4 * speed[-1] - speed[-2] + 2 * h * g) / 3)
            place.append((4 * place[-1] - place[-2] + 2 * h * speed[-1]) / 3)
        times = h * np.arange(len(place))
        np.testing.assert_allclose(g * plain_cases.fallen(times, h, True), place, rtol=1e-12, atol=1e-15)
        scene = self.sheet()
        scene.frames = scene.rest + np.array(place)[:, None, None] * [0, 0, 1]
        scene.time, scene.h, scene.second_order = times, h, True
        self.assertLess(plain_cases.fall_error(scene), 1e-12)
        scene.second_order = False
        self.assertGreater(plain_cases.fall_error(scene), 0.01)

    def test_a_method_without_order_and_precision_says_so(self):
        config = {"solver": {"method": "newton", "integrator": "bdf2", "substeps": 1, "iterations": 20}}
        read = {axis: plain_cases.AXES[axis](config) for axis in ("method", "order", "sweep", "precision")}
        self.assertEqual(read, {"method": "newton", "order": plain_cases.NOT_READ,
                                "sweep": plain_cases.NOT_READ, "precision": "double"})

    def test_masses_are_thirds_of_areas(self):
        scene = self.sheet(1)
        # The diagonal joins the first and the last
        np.testing.assert_allclose(scene.mass, np.array([2, 1, 1, 2]) / 6)

    def test_a_stretched_sheet_has_its_stretch_and_a_turned_one_none(self):
        scene = self.sheet()
        scene.frames = np.stack([scene.rest, scene.rest * [1.2, 1, 1]])
        np.testing.assert_allclose(plain_cases.strains(scene), (0.2, 1.2))
        scene.frames = scene.rest[None] @ np.linalg.qr(np.random.default_rng(1).normal(size=(3, 3)))[0]
        np.testing.assert_allclose(plain_cases.strains(scene), (0, 1), atol=1e-7)  # √ of rounding

    def test_reach_is_the_path_along_edges_and_a_tenth(self):
        scene = self.sheet(4, pins=(0,))
        far = scene.rest * [1.2, 1, 1]  # (1, 0) is 1.2 from its pin; its path has length 1
        scene.frames = np.stack([scene.rest, far])
        self.assertAlmostEqual(plain_cases.beyond_reach(scene), (1.2 - 1.1) / scene.size, places=12)

    def test_paths_are_the_shortest(self):
        scene = self.sheet(5, pins=(0, 35))
        way, pin = plain_cases.ways_from(scene)
        x, y = scene.rest[:, 0], scene.rest[:, 1]
        exact = lambda dx, dy: np.minimum(dx, dy) * np.sqrt(2) + abs(dx - dy)  # the diagonals run this way
        np.testing.assert_allclose(way, np.minimum(exact(x, y), exact(1 - x, 1 - y)), atol=1e-12)
        self.assertEqual(set(pin), {0, 35})

    def test_energy_from_nothing_is_seen(self):
        scene = self.sheet(pins=(0,))
        scene.frames, scene.time = np.stack([scene.rest, scene.rest + [0, 0, 0.1]]), np.array([0, 0.1])
        # 1 m/s and 0.05 m in the mean, on a scale of g √2
        self.assertAlmostEqual(plain_cases.energy_gain(scene), (0.5 + 9.81 * 0.05) / (9.81 * np.sqrt(2)),
                               places=9)

    @staticmethod
    def judged(value, told="", status="complete", **settings):
        return plain_cases.Judged("first", SimpleNamespace(status=status, cpu_s=0.1), settings,
                                  [plain_cases.Bound("mean strain", value, 0.1, "1")], told, "")

    def test_a_broken_bound_without_a_warning_is_silent(self):
        self.assertEqual(self.judged(0.2).verdict, plain_cases.SILENT)
        self.assertEqual(self.judged(np.nan).verdict, plain_cases.SILENT)
        self.assertEqual(self.judged(0.2, "unconverged").verdict, plain_cases.TOLD)
        self.assertEqual(self.judged(0.05, "unconverged").verdict, plain_cases.SOUND)
        self.assertEqual(self.judged(0.05, "implausible", "implausible").verdict, plain_cases.ALARM)

    def test_pairs_that_fail_together_are_found_and_single_values_are_not(self):
        values = [(a, b, c) for a in range(4) for b in range(4) for c in range(4)]
        seen = lambda value, **settings: self.judged(value, **settings).as_json()
        together = [seen(0.2 if a == b == 1 else 0, a=a, b=b, c=c) for a, b, c in values]
        self.assertEqual([(pair, wrong, runs) for pair, wrong, runs, _ in fig_plain.pairs(together)],
                         [((("a", 1), ("b", 1)), 4, 4)])
        self.assertEqual(fig_plain.pairs([seen(0.2 if a == 1 else 0, a=a, b=b, c=c)
                                          for a, b, c in values]), [])
        self.assertEqual(fig_plain.pairs([seen(0.0, a=1, b=2)]), [])

    def test_a_run_that_stops_at_once_breaks_a_bound(self):
        with tempfile.TemporaryDirectory() as folder:
            config = {"name": "plain_first", "duration": 0.3,
                      "mesh": {"generator": "grid", "diagonal": "same", "cells": 1, "height": 1, "width": 1,
                               "scale": 1}, "pins": {"vertices": ["top"], "ring": 0},
                      "bending": {"model": "none", "stiffness": "k", "k": 0.5}, "effects": [],
                      "material": {"strain": {"form": "green", "stiffness": "k"}},
                      "initial": {"tilt": 0, "velocity": [0, 0, 0], "spin": [0, 0, 0]},
                      "solver": {"dt": 0.01, "substeps": 1, "iterations": 1, "order": "mesh",
                                 "sweep": "forward", "precision": "single"}}
            write_run(Path(folder) / "run.vtkhdf", config, committed=1, status="diverged")
            judged = plain_cases.judge(load.load_run(Path(folder) / "run.vtkhdf"), "first")
        self.assertEqual([bound.name for bound in judged.broken], ["time not simulated"])
        self.assertEqual((judged.verdict, judged.told), (plain_cases.TOLD, "diverged"))
        self.assertEqual(judged.settings["pins"], "an edge")

    def test_both_units_read_alike(self):
        read = lambda name: json.loads((sweeps.CONFIGS / f"plain/{name}.json").read_text(encoding="utf-8"))
        small, large, metres = (read(name)["sweep"] for name in (*plain_cases.TWINS, "metres"))
        self.assertEqual(large, metres)
        self.assertEqual([len(values) for values in small.values()],
                         [len(values) for values in large.values()])
        for one, other in zip(small["/bending"], large["/bending"]):
            self.assertEqual(plain_cases._bending({"bending": one, "mesh": {"scale": 2.0 ** -10}}),
                             plain_cases._bending({"bending": other, "mesh": {"scale": 1.0}}))
        scales = {value["scale"] for value in small["/mesh"]}
        self.assertEqual(scales, {1 / 1024})
        self.assertEqual(read("millimetres")["effects"][0]["acceleration"][2], -9.81 / 1024)

    def test_what_a_cover_lacks_is_counted(self):
        experiment = SimpleNamespace(settings={"cover": 2},
                                     sweep={"/mesh/cells": [2, 4], "/bending/model": ["none", "lod"],
                                            "/solver/sweep": ["forward"]})
        run = lambda cells, model: SimpleNamespace(point={"/mesh/cells": cells, "/bending/model": model,
                                                          "/solver/sweep": "forward"})
        strength, held, wanted, absent = fig_plain.coverage(experiment,
                                                            [run(2, "none"), run(4, "none"), run(2, "lod")])
        self.assertEqual((strength, held, wanted), (2, 7, 8))
        self.assertEqual(absent, [(("/mesh/cells", 4), ("/bending/model", "lod"))])

    def test_a_page_without_runs_says_what_is_missing(self):
        with tempfile.TemporaryDirectory() as folder:
            section = plain_page.main(Path(folder), Path(folder) / "page")
            self.assertEqual(section.judged, [])
            self.assertIn("configs/plain/first.json: none of its runs",
                          (Path(folder) / "page/index.html").read_text(encoding="utf-8"))


class AccuracyTest(unittest.TestCase):
    """Costs, fronts and levels of runs that are made up."""

    @staticmethod
    def run_of(ms, error, model="dihedral", substeps=1, iterations=1, against="physical", status="complete",
               **summary):
        """A run of half a second, 30 frames, with 3 s of CPU time for set-up and recording."""
        config = {"solver": {"substeps": substeps, "iterations": iterations, "dt": 1 / 60,
                             "sweep": "forward"}}
        return load.Run(Path("none"), "0", "made_up", status, {**config, "bending": {"model": model}},
                        {f"error_{against}_rms": error, "projections": 300.0, **summary},
                        {"time": np.array([0, 0.5])}, cpu_s=3 + ms * 30 / 1000, step_cpu_s=ms * 30 / 1000,
                        passes={"strain": 99.0})

    def test_cost_is_that_of_the_steps_for_a_frame(self):
        run = self.run_of(4, 0.1)
        self.assertAlmostEqual(accuracy.cost(run), 4, places=9)
        self.assertAlmostEqual(accuracy.projections(run), 10)

    def test_the_front_is_what_no_other_beats_in_both(self):
        cheap, _, middle, _, best = runs = [self.run_of(*point)
                                            for point in ((1, 0.5), (2, 0.6), (3, 0.2), (4, 0.2), (9, 0.1))]
        self.assertEqual(accuracy.front(runs[::-1]), [cheap, middle, best])
        diverged = self.run_of(0.1, np.nan, status="diverged")
        del diverged.summary["error_physical_rms"]
        self.assertEqual(accuracy.front([diverged, *runs])[0], cheap)
        self.assertIs(accuracy.reaching(runs, 0.2), middle)
        self.assertIsNone(accuracy.reaching(runs, 0.05))

    def test_a_front_in_one_measure_says_nothing_of_another(self):
        run = self.run_of(1, 0.5)
        self.assertTrue(np.isnan(accuracy.error(run, against="solver")))
        self.assertEqual(accuracy.front([run], against="solver"), [])

    def test_slopes_and_levels_are_those_of_power_laws(self):
        self.assertAlmostEqual(accuracy.slope([1, 2, 8], [3, 3 * 2**1.5, 3 * 8**1.5]), 1.5)
        self.assertTrue(np.isnan(accuracy.slope([1], [2])))
        runs = [self.run_of(ms, 0.2 / ms**2, against="solver") for ms in (1, 3, 10)]  # 0.01 at √20 ms
        self.assertAlmostEqual(fig_accuracy_scaling.cost_at(runs, 0.01), np.sqrt(20), places=9)
        self.assertTrue(np.isnan(fig_accuracy_scaling.cost_at(runs, 1e-5)))

    def test_substeps_win_where_their_error_is_smaller(self):
        runs = [self.run_of(1, 0.3, substeps=1, iterations=16, against="solver"),
                self.run_of(1, 0.1, substeps=16, iterations=1, against="solver")]
        self.assertAlmostEqual(fig_accuracy_solver.gain(runs, 16), 3)
        self.assertTrue(np.isnan(fig_accuracy_solver.gain(runs, 64)))
        self.assertIn("1 of 1",
                      fig_accuracy_solver.message({("dihedral", 16): 3.0}, {("dihedral", 16): None}))

    def test_the_best_split_of_the_same_work_may_be_in_between(self):
        errors = {(1, 16): 0.3, (4, 4): 0.05, (16, 1): 0.1, (16, 4): 0.01}  # the last is more work
        runs = [self.run_of(1, error, substeps=s, iterations=i, against="solver")
                for (s, i), error in errors.items()]
        line = fig_accuracy_solver.along(runs, 16)
        self.assertEqual(line, [(1, 0.3), (4, 0.05), (16, 0.1)])
        self.assertTrue(fig_accuracy_solver.best_between(line))
        self.assertFalse(fig_accuracy_solver.best_between([(1, 0.3), (4, 0.2), (16, 0.1)]))
        self.assertIsNone(fig_accuracy_solver.best_between([(1, 0.3), (16, 0.1)]))
        text = fig_accuracy_solver.message({("dihedral", 16): 3.0, ("none", 16): 2.0},
                                           {("dihedral", 16): True, ("none", 16): False})
        self.assertIn("1 of 2 at work 16", text)

    def test_no_level_below_the_gap_of_the_reference_is_claimed(self):
        runs = [self.run_of(1, 0.004, error_physical_reference_gap=0.012),
                self.run_of(2, 0.03, model="none", error_physical_reference_gap=0.012)]
        self.assertEqual(accuracy.known_levels(runs), [0.20, 0.05])
        # With no coarser reference
        self.assertEqual(accuracy.known_levels([self.run_of(1, 0.1)]), list(accuracy.LEVELS))
        none, dihedral = fig_accuracy.levels_table(runs, "", "physical", "").rows
        self.assertEqual([none[5:], dihedral[5:]],
                         [["–", "not known", "3.00"], ["–", "not known", "below 1.2"]])
        self.assertIn("errors of 1 % are not known", fig_accuracy.message(runs, []))
        self.assertIn("is within 5 % in 1.0 ms", fig_accuracy.message(runs, []))

    def test_the_gain_is_stated_beside_that_of_the_mesh(self):
        def run_of(cells, ms, error):
            run = self.run_of(ms, error, model="adaptive")
            run.config["mesh"] = {"cells": cells}
            return run

        line = [run_of(8, 1, 0.04), run_of(64, 100, 0.2)]
        rest = [run_of(8, 0.5, 0.2), run_of(8, 2, 0.04), run_of(24, 50, 0.01)]
        np.testing.assert_allclose(fig_accuracy_beat.ratios(rest, line[1]), (0.005, 0.05))
        np.testing.assert_allclose(fig_accuracy_beat.ratios(rest, line[0]), (2, 5))
        np.testing.assert_allclose(fig_accuracy_beat.ratios(line, line[1]), (0.01, 0.2))
        self.assertTrue(np.isnan(fig_accuracy_beat.ratios([], line[0])).all())
        text = fig_accuracy_beat.message(rest, line, line[1])
        for ratio in ("0.50 % of the time", "5.0 % of the error", "on 8 cells", "2.0 times the time",
                      "5.0 times the error"):
            self.assertIn(ratio, text)

    def test_precisions_are_compared_up_to_the_first_difference(self):
        def run(precision, substeps):
            values = {"/solver/precision": precision, "/solver/substeps": substeps}
            return SimpleNamespace(get=values.get, wrong=1.0 + (precision == "single") * substeps / 1000)
        runs = [run(precision, n) for precision in ("single", "double") for n in (1, 16, 64, 256)]
        self.assertEqual(fig_accuracy_rounding.alike_until([("", lambda run: run.wrong, 1, runs)]), 64)

    def test_the_smallest_time_step_is_counted_where_it_is_best(self):
        runs = [self.run_of(1, error, model, against="solver") for model, error in
                (("none", 0.3), ("none", 0.1), ("lod", 0.1), ("lod", 0.2))]
        for run, dt in zip(runs, (0.1, 0.01, 0.1, 0.01)):
            run.config["solver"]["dt"] = dt
        self.assertEqual(fig_accuracy_solver.finest_best(runs), "1 of 2")

    def test_motion_names_a_setting_and_no_model(self):
        runs = [self.run_of(ms, error, model, substeps, against="solver")
                for model, substeps, ms, error in [("none", 4, 1, 0.04), ("dihedral", 4, 2, 0.1),
                                                   ("none", 16, 4, 0.02), ("dihedral", 16, 8, 0.03),
                                                   ("none", 64, 16, 0.001), ("dihedral", 64, 32, 0.001)]]
        for run in runs:
            run.config["solver"]["precision"] = "single"
        text = fig_accuracy_scaling.motion_message(runs)
        self.assertTrue(text.startswith("16 × 1, single: 2 of 2 models"), text)
        self.assertIn("6.0 ms", text)  # between 4 and 8
        self.assertNotIn("dihedral", text)

    def test_scenes_are_compared_with_one_cloth(self):
        physical = lambda name: json.loads((sweeps.CONFIGS
                                            / f"accuracy/{name}.json").read_text(encoding="utf-8"))[
                                            "accuracy"]["physical"]
        for front, others in (("front", ("paper", "paper_64", "paper_cells_slow", "beat")),
                              ("front_cantilever", ("paper_cantilever",))):
            for other in others:  # these are given a membrane, because their own is k
                self.assertEqual([setting for setting in physical(other)
                                  if not setting.startswith("/material")], physical(front), other)

    def test_a_remedys_effect_is_the_one_that_is_none_of_the_scene(self):
        run = lambda *types: SimpleNamespace(get=lambda _: [{"type": kind} for kind in types])
        self.assertEqual([fig_accuracy_roads.effect_of(run("gravity", *more)) for more in ((), ("tethers",))],
                         ["", "tethers"])

    def test_configs_that_share_a_front_ask_for_no_run_twice(self):
        for configs in accuracy.FRONTS:
            experiments = [sweeps.load_experiment("none", f"accuracy/{name}") for name in configs]
            self.assertEqual(len({json.dumps(experiment.settings["accuracy"]) for experiment in experiments}),
                             1)
            wanted = [str(point) for experiment in experiments for point in every_point(experiment.sweep)]
            self.assertEqual(len(wanted), len(set(wanted)))
            self.assertEqual(len(wanted), 12 * 15)  # all models × all ways to spend the work

    def test_objects_stand_on_a_line_each(self):
        with tempfile.TemporaryDirectory() as folder:
            write_objects(Path(folder) / "summary.json", [{"a": 1}, {"b": [2, "ö"]}])
            text = (Path(folder) / "summary.json").read_text(encoding="utf-8")
        self.assertEqual(json.loads(text), [{"a": 1}, {"b": [2, "ö"]}])
        self.assertEqual(text.count("\n"), 4)

    def test_the_page_is_made_without_runs_and_says_so(self):
        with tempfile.TemporaryDirectory() as folder:
            sections = accuracy_page.main(Path(folder) / "results", Path(folder) / "out")
            page_text = (Path(folder) / "out/index.html").read_text(encoding="utf-8")
            self.assertEqual(json.loads((Path(folder) / "out/summary.json").read_text(encoding="utf-8")), [])
        self.assertTrue(all(section.missing for section in sections))
        self.assertIn("Runs that are missing", page_text)


def lattice(rows, columns):
    """(rest, triangles) of an equilateral lattice of edges 1 whose rows lie along y, every second row half an
    edge up."""
    rest = np.array([[i * 3**0.5 / 2, j + i % 2 / 2, 0] for i in range(rows) for j in range(columns)])
    triangles = []
    for i in range(rows - 1):
        for j in range(columns - 1):
            a, b, c, d = i * columns + j, i * columns + j + 1, (i
                                                                + 1) * columns + j, (i + 1) * columns + j + 1
            triangles += [(a, b, d), (a, d, c)] if i % 2 else [(a, b, c), (b, d, c)]
    return rest, np.array(triangles)


class StripTest(unittest.TestCase):
    def test_the_heavy_elastica_has_its_limits(self):
        small, knee, large = strips.elastica_droop([1e-3, 8.0042, 1e3])
        self.assertAlmostEqual(small / (1e-3 / 8), 1, delta=1e-5)  # a beam under its weight: H/L = Γ/8
        self.assertAlmostEqual(np.degrees(np.arctan(knee)), 41.5, delta=0.01)  # what ASTM D1388 builds on
        # A boundary layer: √(Γ/2) (1 - O(Γ^-1/2))
        self.assertAlmostEqual(large / np.sqrt(1e3 / 2), 1, delta=0.06)

    def test_rings_of_a_lattice_have_six_vertices_per_edge(self):
        rest, triangles = lattice(11, 11)
        for ring in (1, 2, 3):
            pairs = strips.ring_pairs(triangles, len(rest), ring)
            self.assertEqual((pairs == 60).sum(), 6 * ring)  # vertex 60 is the middle one

    def test_springs_of_a_wide_lattice_have_the_coefficient_of_an_infinite_one(self):
        # Lattice sums, edges and spring stiffness 1, over half the springs of a vertex (of area √3/2): δ = n²
        # (n² - 1) h⁴/24 l over n rows, C = 4/√3 Σ δ².
        h = 3**0.5 / 2
        by_hand = {2: [(2, 2 * h), (2, 2), (2, 2)],
                   3: [(2, 7**0.5), (2, 7**0.5), (3, 3), (3, 3), (3, 7**0.5), (3, 7**0.5)]}
        rest, triangles = lattice(26, 61)
        pinned = rest[:, 0] < 1e-9
        for ring, spans in by_hand.items():
            infinite = 4 / 3**0.5 * sum((n**2 * (n**2 - 1) * h**4 / (24 * length))**2 for n, length in spans)
            measured = strips.expected_quartic(rest, triangles, pinned, ring, 1.0)
            # 60 edges wide it lacks ring/60 of its oblique springs
            self.assertAlmostEqual(measured / infinite, 1, delta=0.03)

    def test_a_check_holds_within_its_tolerance(self):
        check = lambda measured, tolerance, kind: Check("", "", "", 2.0, measured, tolerance, "", kind).holds
        self.assertEqual([check(2.1, 0.06, "relative"), check(2.1, 0.04, "relative"),
                          check(2.1, 0.11, "absolute"), check(2.1, 0.09, "absolute"), check(1.9, 0, "most"),
                          check(2.1, 0, "most"), check(np.nan, 1, "relative")],
                         [True, False, True, False, True, False, None])

    def test_a_long_chain_hangs_half_its_length(self):
        # 2 a sinh(d/2a) = L, solved by hand
        self.assertAlmostEqual(fig_stiffness_textile.catenary_sag(1.25), 0.3318, delta=1e-4)
        # Two plumb lines
        self.assertAlmostEqual(fig_stiffness_textile.catenary_sag(200) / 100, 1, delta=0.05)

    def test_the_critical_load_is_where_the_deflection_begins(self):
        points = {10: 0.0, 21: 0.01, 22: 0.01 * 2**0.5, 30: 0.5}  # deflection² ∝ Γ - 20 just above 20
        with unittest.mock.patch.multiple(fig_stiffness_buckling, load_number=lambda run: run,
                                          deflection=points.get):
            self.assertAlmostEqual(fig_stiffness_buckling.critical_load(list(points)), 20, places=9)

    def test_the_texts_of_the_stiffness_page_state_computed_numbers(self):
        def run(family, cells, model="lod", deflection="large", **summary):
            config = {"mesh": {"generator": "grid", "diagonal": family, "cells": cells, "width": 0.24},
                      "bending": {"model": model, "deflection": deflection, model: {"radius": 0.04}}}
            if family == "equilateral":
                config["mesh"]["generator"] = family
            return load.Run(Path("-"), "", "", "complete", config, summary, {"time": []})
        self.assertEqual(fig_stiffness_calibrated.lengths_text([run("equilateral", n) for n in (24, 12)]),
                         "Springs have one length, 4 cm, at every resolution (2, 4 edges at 12, 24 cells).")
        text = fig_stiffness_calibrated.small_text([run("alternating", 24, "dihedral",
                                                        model_small_deflection=0.9,
                                                        model_large_deflection=1.2)])
        self.assertIn("energy is 0.75 of the cylinder's", text)
        rows = [{"model": model, "iterations": 1, "substeps": n, "measured": 1 / (1 + lost)}
                for model, n, lost in (("dihedral", 1, 16), ("dihedral", 4, 1), ("lod", 1, 4), ("lod", 2, 2))]
        text = fig_stiffness_effective.doubling_text(rows)
        self.assertIn("for hinges it removes 75 %, for springs it removes 50 %", text)

    def test_a_page_without_runs_has_its_checks_open(self):
        with tempfile.TemporaryDirectory() as folder:
            stiffness_page.main(Path(folder), Path(folder) / "stiffness")
            checks = json.loads((Path(folder) / "stiffness/summary.json").read_text())
            text = (Path(folder) / "stiffness/index.html").read_text()
        self.assertTrue(checks)
        self.assertEqual({check["holds"] for check in checks}, {None})
        self.assertEqual(set(checks[0]), {"check", "model", "mesh", "expected", "measured", "tolerance",
                                          "source", "holds", "note"})
        self.assertIn("configs/stiffness/hinges.json: none of its runs", text)
        self.assertIn("no runs", text)


if __name__ == "__main__":
    unittest.main()
