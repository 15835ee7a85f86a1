"""Tests of the analysis scripts on files and shapes with known results."""
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
from bendlab.results import checksum, load, registry  # noqa: E402
from bendlab.results.load import group  # noqa: E402
from draw import cloth, render, style  # noqa: E402
from figures.accuracy import beat, fronts, measures, roads, rounding, scaling, solver  # noqa: E402
from figures.paper import fig_5, large_forces, models, scenes, structure  # noqa: E402
from figures.plain import shares  # noqa: E402
from figures.stability import cells as hard_cases  # noqa: E402
from figures.stiffness import buckling, calibrated, effective, textile  # noqa: E402
from made_up_runs import facts  # noqa: E402
from pages import accuracy, paper, plain, project, stability, stiffness  # noqa: E402
from runs import obstacles, plain_cases, stability_cases, stability_reasons, strips, sweeps  # noqa: E402
from runs.distance import hausdorff_distance, rms_distance  # noqa: E402
from tables import looks  # noqa: E402
from tables.numbers import number, rounded, slope  # noqa: E402
from tables.section import Check, write_objects  # noqa: E402
from web import stability_matrix  # noqa: E402

SQUARE = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], float)
TRIANGLES = np.array([[0, 1, 2], [0, 2, 3]])


RUN_ID = "0123456789abcdef"


def write_run(path, config, committed=3, extra=0, status="complete", summary=None):
    """Writes a run of a square that falls by 0.1 m per frame, with `extra` frames that are not committed."""
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
    """A run of a hard case, as in summary.json."""
    worst = worst or {"what": "mean strain", "value": 2, "limit": 1, "unit": "1"}
    title = next(known.title for known in stability_cases.CASES if known.name == case)
    return {"case": case, "title": title, "model": model, "precision": precision, "verdict": verdict,
            "worst": worst, "seconds": 0.1, "recovered_s": None, "energy_rises": 0.5, "why": why}


def written(page, results, out):
    """Writes a page of the runs in the folder `results`, and returns its sections."""
    sections = project.draw(page.PAGE, results, out)
    project.lay_out(page.PAGE, out, sections)
    return sections


def every_point(sweep):
    """The points of a sweep in the form of a config."""
    lists = [registry.models() if values == "all" else values for values in sweep.values()]
    return [sorted(zip(sweep, values), key=str) for values in itertools.product(*lists)]


def config_of(name="fig5", cells=16, model="crossover", seed=1, **more):
    return {"name": name, "mesh": {"cells": cells}, "pins": {"ring": 0},
            "bending": {"model": model, model: {}}, "initial": {"seed": seed}, **more}


class CameraTest(unittest.TestCase):
    def test_the_camera_shows_the_pin_if_the_cloth_is_far_from_it(self):
        camera = render.camera_for([SQUARE - [0, 0, 100]], np.zeros(3), 1.4)
        self.assertTrue(np.isfinite(camera.extent).all())
        self.assertGreater(camera.extent[1], camera.extent[0])
        self.assertAlmostEqual(camera.aspect, 0.8)


class LoadTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def test_a_loaded_run_has_the_written_values(self):
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
        np.testing.assert_array_equal(run.last_second(), [1, 2])  # of 0, 0.5 and 1 s; 0 is excluded
        self.assertAlmostEqual(run.size, 2**0.5, places=15)
        with self.assertRaises(IndexError):
            run.positions(3)
        with self.assertRaises(KeyError):
            run.constraints("distance")

    def test_an_unfinished_run_has_only_its_committed_frames(self):
        write_run(self.folder / "a/run.vtkhdf.part", config_of(), committed=2, extra=1, status="running")
        run, = load.load_runs(self.folder)
        self.assertEqual((run.status, run.frames, len(run.metrics["pin_max_stretch"])), ("interrupted", 2, 2))
        self.assertTrue(np.isfinite(run.positions(-1)).all())

    def test_an_implausible_run_is_over_and_has_all_its_data(self):
        write_run(self.folder / "a/run.vtkhdf", config_of(seed=1), status="implausible",
                  summary={"drop": 9.0})
        write_run(self.folder / "b/run.vtkhdf", config_of(seed=2), status="diverged")
        write_run(self.folder / "c/run.vtkhdf", config_of(seed=3), status="interrupted")
        runs = load.load_runs(self.folder)
        self.assertEqual([(run.status, run.complete, run.over) for run in runs],
                         [("implausible", True, True), ("diverged", False, True),
                          ("interrupted", False, False)])
        self.assertEqual(load.values(runs[:1], "drop").tolist(), [9.0])  # the measured value, not infinity

    def test_a_reference_is_not_a_run_of_the_sweep(self):
        write_run(self.folder / "fig5/a/run.vtkhdf", config_of(cells=16))
        write_run(self.folder / "fig5/references/b/run.vtkhdf", config_of(cells=64))
        self.assertEqual([run.get("/mesh/cells") for run in load.load_runs(self.folder / "fig5")], [16])
        self.assertEqual([run.get("/mesh/cells") for run in load.load_runs(self.folder / "fig5/references")],
                         [64])

    def test_a_file_that_is_not_a_run_is_left_out(self):
        (self.folder / "a").mkdir()
        (self.folder / "a/run.vtkhdf").write_bytes(b"cut off")
        self.assertEqual(load.load_runs(self.folder), [])

    def sweep(self, runs, **more):
        """Writes the sweep file of configs/paper/fig1 like the program; `runs` are pairs (folder, point)."""
        config = json.loads((sweeps.CONFIGS / "paper/fig1.json").read_text(encoding="utf-8"))
        settings = {key: value for key, value in config.items() if key not in ("sweep", "expect")}
        folder = self.folder / "fig1"
        folder.mkdir()
        (folder / "fig1.sweep.json").write_text(json.dumps({
            "settings": settings, "axes": config["sweep"], "models": {"crossover": "Crossover"},
            "runs": [{"point": point, "id": RUN_ID, "folder": name} for name, point in runs],
            "overrides": [], **more}))
        return folder

    def test_an_experiment_has_the_runs_of_its_sweep_and_lists_missing_runs(self):
        points = [{"/mesh/cells": cells} for cells in (16, 32, 64, 128)]
        folder = self.sweep([("d", points[0]), ("c", points[1]), ("b", points[2]), (None, points[3])])
        write_run(folder / "trial/run.vtkhdf", config_of("fig1", cells=16, duration=1))  # another sweep
        write_run(folder / "d/run.vtkhdf", config_of("fig1", cells=16))
        write_run(folder / "c/run.vtkhdf.part", config_of("fig1", cells=32), status="running")
        experiment = sweeps.load_experiment(self.folder, "paper/fig1")
        self.assertEqual([run.point for run in experiment.runs], points[:2])
        self.assertEqual(experiment.missing, ["/mesh/cells 32", "/mesh/cells 64", "/mesh/cells 128"])
        self.assertEqual(looks.model_name("discrete_shells"), "discrete_shells")

    def test_runs_of_an_older_version_of_the_config_are_not_shown(self):
        self.assertEqual(sweeps.load_experiment(self.folder, "paper/fig1").missing_text,
                         "none of its runs")
        folder = self.sweep([("a", {})], axes={"/mesh/cells": [7]})
        write_run(folder / "a/run.vtkhdf", config_of("fig1"))
        experiment = sweeps.load_experiment(self.folder, "paper/fig1")
        self.assertEqual(experiment.runs, [])
        self.assertIn("changed", experiment.missing_text)

    def test_a_trial_is_shown_with_a_remark_if_there_are_no_other_runs(self):
        folder = self.sweep([("a", {})], axes={}, overrides=["/duration=1"])
        (folder / "fig1.sweep.json").rename(folder / "fig1,0123.sweep.json")
        write_run(folder / "a/run.vtkhdf", config_of("fig1", duration=1))
        experiment = sweeps.load_experiment(self.folder, "paper/fig1")
        self.assertEqual(len(experiment.runs), 1)
        self.assertEqual(experiment.missing_text, "only runs of a trial with --set /duration=1")

    def test_all_in_a_sweep_stands_for_any_list_of_models(self):
        self.assertTrue(sweeps._same_axes({"/bending/model": "all"}, {"/bending/model": ["none"]}))
        self.assertFalse(sweeps._same_axes({"/mesh/cells": [1, 2]}, {"/mesh/cells": [1]}))
        self.assertFalse(sweeps._same_axes({}, {"/mesh/cells": [1]}))

    def test_a_spread_has_median_and_range(self):
        s = load.spread([5, 1, 2]) - 1
        self.assertEqual((s.median, s.low, s.high, s.count), (1, 0, 4, 3))
        self.assertFalse(load.spread([]).known)

    def test_the_typical_run_is_nearest_to_the_median(self):
        times = {"time": np.array([0, 0.5, 1.0, 1.5, 2.0])}
        runs = [SimpleNamespace(frames=5, last_second=lambda: np.array([2, 3, 4]),
                                metrics={**times, "pin_max_stretch": np.array([0, 0, *last])})
                for last in ([9, 9, 9], [3, 4, 99], [1, 1, 4])]
        self.assertEqual(load.typical_run(runs), (runs[1], 4))  # medians of the last second: 9, 4 and 1
        self.assertIsNone(load.typical_run([]))


class DistanceTest(unittest.TestCase):
    def test_the_distance_of_a_shifted_sheet_is_the_length_of_the_shift(self):
        rng = np.random.default_rng(1)
        sheet = np.c_[rng.random((500, 2)), np.zeros(500)]
        shift = np.array([0, 0, 0.3])
        self.assertAlmostEqual(rms_distance(sheet, sheet + shift), 0.3, places=14)
        # The nearest point is straight above.
        self.assertAlmostEqual(hausdorff_distance(sheet, sheet + shift), 0.3, places=14)

    def test_the_hausdorff_distance_is_the_larger_of_both_directions(self):
        line = np.c_[np.linspace(0, 1, 101), np.zeros((101, 2))]
        half = line[:51]
        self.assertAlmostEqual(hausdorff_distance(line, half), 0.5, places=14)
        self.assertAlmostEqual(hausdorff_distance(half, line), 0.5, places=14)

    def test_the_distance_of_concentric_circles_is_the_difference_of_their_radii(self):
        angle = 2 * np.pi * np.arange(2000) / 2000
        circle = np.c_[np.cos(angle), np.sin(angle), 0 * angle]
        self.assertAlmostEqual(hausdorff_distance(circle, 1.7 * circle), 0.7, places=13)

    def test_the_hausdorff_distance_does_not_depend_on_the_order_of_vertices(self):
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

    def test_the_nearer_triangle_is_visible_in_any_order(self):
        xy = np.array([[0, 0], [20, 0], [0, 20]] * 2, float)
        nearness = np.array([1, 1, 1, 2, 2, 2], float)
        for order in ([[0, 1, 2], [3, 4, 5]], [[3, 4, 5], [0, 1, 2]]):
            owner, best = render.rasterise(xy, nearness, np.array(order), (20, 20))
            self.assertEqual(set(np.array(order)[owner[owner >= 0], 0]), {3})
            self.assertEqual(best.max(), 2)

    def test_each_of_two_intersecting_triangles_is_visible_on_its_side(self):
        xy = np.array([[0, 0], [20, 0], [20, 20], [0, 20]] * 2, float)
        nearness = np.array([1, 3, 3, 1, 3, 1, 1, 3], float)  # equal at x = 10
        triangles = np.concatenate([TRIANGLES, TRIANGLES + 4])
        owner, _ = render.rasterise(xy, nearness, triangles, (20, 20))
        self.assertTrue((owner[:, :10] >= 2).all() and (owner[:, 10:] < 2).all())

    def test_an_exploded_vertex_does_not_move_the_camera(self):
        pin = SQUARE[2]
        blown = SQUARE.copy()
        blown[0] = [300, -200, 900]
        usual = render.camera_for([SQUARE], pin, 2**0.5)
        both = render.camera_for([SQUARE, blown], pin, 2**0.5)
        np.testing.assert_allclose(both.extent, usual.extent, rtol=1e-12)
        self.assertEqual(cloth.share_outside(SQUARE, both, (100, 80)), 0)
        self.assertEqual(cloth.share_outside(blown, both, (100, 80)), 0.25)

    def test_a_close_up_shows_the_cloth_below_the_pin(self):
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
        # An obstacle below the cloth is hidden; above the cloth, it hides half of the cloth.
        for height, share in ((-0.5, 1), (0.5, 0.5)):
            solid = SQUARE * [0.5, 1, 0] + [0, 0, height], TRIANGLES
            alone, both = (is_red(render.render(SQUARE, TRIANGLES, red, camera, 100, False, obstacle))
                           for obstacle in (None, solid))
            # Perspective: the distances are 5 and 4.5.
            self.assertAlmostEqual(both.sum() / alone.sum(), share, delta=0.05)


def with_obstacles(effects, surfaces=None):
    """A run with these effects. `surfaces`: {index of an effect: (points, triangles, velocity)}."""
    return SimpleNamespace(get=lambda pointer, default=None: effects, config={"effects": effects},
                           obstacles=surfaces or {})


class ObstacleTest(unittest.TestCase):
    def test_surfaces_of_obstacles_move_and_a_horizontal_plane_is_left_out(self):
        effects = [{"type": "gravity"}, {"type": "plane", "point": [0, 0, -0.3], "normal": [0, 0, 2]},
                   {"type": "a new one"}, {"type": "plane", "point": [0, 0, 0], "normal": [1, 0, 1]}]
        surface = lambda height, speed: (SQUARE + [0, 0, height], TRIANGLES, np.array([0, 0, speed]))
        run = with_obstacles(effects, {1: surface(0, 0), 2: surface(1, 0.5), 3: surface(2, 0)})
        points, triangles = obstacles.surfaces(run, 4.0)
        np.testing.assert_array_equal(points, np.concatenate([SQUARE + [0, 0, 3], SQUARE + [0, 0, 2]]))
        np.testing.assert_array_equal(triangles, np.concatenate([TRIANGLES, TRIANGLES + 4]))

    def test_a_run_without_recorded_obstacles_differs_from_a_run_without_obstacles(self):
        ball = {"type": "sphere", "velocity": [0, 0, 0], "thickness": 0.01}
        wind = {"type": "wind", "velocity": [0, 3, 0]}
        self.assertTrue(obstacles.are_unknown(with_obstacles([wind, ball])))
        self.assertFalse(obstacles.are_unknown(with_obstacles([wind])))
        self.assertFalse(obstacles.are_unknown(with_obstacles([ball], {0: (SQUARE, TRIANGLES, np.zeros(3))})))

    def test_the_clearance_is_the_signed_distance_from_the_surface(self):
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
        """Clearance from these triangles of a cube that is scaled by 2, moved by 5 m to the right, and has an
        upward velocity of 1 m/s."""
        corners = np.array([[i % 2, i // 2 % 2, i // 4] for i in range(8)], float)
        surface = 2 * corners + [5, 0, 0], np.array(triangles), np.array([0, 0, 1.0])
        return obstacles.clearance(with_obstacles([{"type": "a new one"}], {0: surface}), time,
                                   np.array(points, float))

    def test_the_clearance_of_a_mesh_of_a_cube_equals_the_closed_form(self):
        def expected(points):
            q = np.abs(points - [6, 1, 1]) - 1  # distance beyond each pair of sides
            return (np.linalg.norm(np.maximum(q, 0), axis=1) + np.minimum(q.max(axis=1), 0)).min()
        rng = np.random.default_rng(4)
        # Points around, beside and inside the cube. 1e-12: rounding of coordinates of up to about 8 m, which
        # are squared and summed.
        for _ in range(50):
            alone = rng.uniform([4, -1, -1], [8, 3, 3], (1, 3))
            self.assertAlmostEqual(self.mesh_clearance(self.CUBE, alone), expected(alone), delta=1e-12)
            many = np.array([6, 1, 1]) + rng.uniform(-1, 1, (200, 3)) * [9, 5, 5]
            many = many[(np.abs(many - [6, 1, 1]) > 1 + rng.random()).any(axis=1)]
            self.assertAlmostEqual(self.mesh_clearance(self.CUBE, many), expected(many), delta=1e-12)
        for point, distance in (([6, 1, 1], -1), ([6, 1, 2.5], 0.5), ([8, 3, 1], 2**0.5),
                                ([4, -1, 3], 3**0.5),
                                # Points over the centre and over the diagonal of a face.
                                ([6, 1, 1.75], -0.25), ([5.5, 0.5, 1.9], -0.1)):
            self.assertAlmostEqual(self.mesh_clearance(self.CUBE, [point]), distance, delta=1e-12)
        self.assertAlmostEqual(self.mesh_clearance(self.CUBE, [[6, 1, 5.5]], time=3), 0.5, delta=1e-12)
        self.assertAlmostEqual(self.mesh_clearance(self.CUBE, [[6, 1, 4], [6, 1, 0.3], [6, 1, 0.1]]), -0.3,
                               delta=1e-12)

    def test_an_open_mesh_has_no_inside(self):
        without_bottom = self.CUBE[2:]
        for point, distance in (([6, 1.1, 0.3], 0.9), ([6, 1, 2.5], 0.5), ([6, 1, -0.5], np.hypot(1, 0.5))):
            self.assertAlmostEqual(self.mesh_clearance(without_bottom, [point]), distance, delta=1e-12)

    def test_a_horizontal_plane_is_the_floor(self):
        level = {"type": "plane", "point": [0, 0, -0.3], "normal": [0, 0, 2]}
        self.assertEqual(obstacles.floor_of({"effects": [level]}), -0.3)
        self.assertIsNone(obstacles.floor_of({"effects": [{**level, "normal": [1, 0, 1]}]}))


class FigureTest(unittest.TestCase):
    def test_the_factors_of_figure_5_add_up_to_the_whole(self):
        # Values: stretch - 1.
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

    def test_the_elastica_follows_the_master_curve(self):
        # Position of the tip, divided by the length, at Γ = weight length³ / rigidity. For small Γ it is Γ/8,
        # else a solution of the boundary value problem to 10 digits, of which 6 decimals are written here.
        for gamma, x, y in ((0.01, 0.999999, 0.001250), (1, 0.991246, 0.123471), (10, 0.656354, 0.700200)):
            tip = models.heavy_strip(gamma, 1, 1)[-1]
            np.testing.assert_allclose(tip, [x, -y], atol=1e-6)
        np.testing.assert_allclose(models.heavy_strip(10 / 8, 2, 1)[-1], [2 * 0.656354, -2 * 0.7002],
                                   atol=2e-6)

    def test_the_cost_of_a_model_equals_a_computation_by_hand(self):
        config = {"bending": {"model": "dihedral"}, "solver": {"dt": 0.5, "substeps": 2, "iterations": 10}}
        passes = {"strain": 2.0, "bending": 3.0, "predict": 1.0, "recording": 4.0}
        runs = [load.Run(Path("-"), "", "", "complete", config, {"bending_constraints": 50, "vertices": 25},
                         {"time": np.array([0, 4.0])}, cpu_s=cpu, passes=passes) for cpu in (10, 5, 20)]
        # 8 steps with 20 projections each. The CPU time is half of the wall time of each pass.
        c = models.cost(runs)
        self.assertAlmostEqual(c["strain"], 1e3 / 8)
        self.assertAlmostEqual(c["bending"], 1.5e3 / 8)
        self.assertAlmostEqual(c["rest"], 0.5e3 / 8)
        self.assertAlmostEqual(c["ns"], 1.5e9 / (8 * 20 * 50))
        self.assertEqual(c["per_vertex"], 2)

    def test_the_profile_of_a_strip_is_the_mean_of_each_row(self):
        rest = np.array([[x, y, 0] for x in (-2, -1, 0, 1) for y in (0, 1)], float)
        hung = rest + np.repeat([[0, 0, 5], [0, 0, 5], [-0.2, 0, 4], [-0.8, 0, 3]], 2, axis=0)
        hung[5] += [0.2, 0, -0.5]  # only one end of this row
        strip = SimpleNamespace(rest_positions=rest, pinned=rest[:, 0] < -0.5, positions=lambda frame: hung)
        np.testing.assert_allclose(models.profile(strip), [[0, 0], [0.9, -1.25], [1.2, -2]], atol=1e-15)

    def test_every_swept_model_is_registered(self):
        for name in ("hanging_sheet", "cantilever", "cantilever_rigidity"):
            sweep = json.loads((sweeps.CONFIGS / f"models/{name}.json").read_text())["sweep"]
            models = sweep.get("/bending/model") or [value["model"] for value in sweep["/bending"]]
            self.assertLessEqual(set(models), set(registry.models()))

    def test_every_scene_has_a_view_and_its_models_are_registered(self):
        configs = {path.stem: json.loads(path.read_text()) for path in sweeps.CONFIGS.glob("scenes/*.json")}
        times = {name: view.time for name, view in scenes.SCENES.items()} | large_forces.SCENES
        self.assertEqual(set(configs), set(times))
        for name, config in configs.items():
            self.assertEqual(config["name"], name)
            self.assertLessEqual(set(config["sweep"]["/bending/model"]), set(registry.models()))
            self.assertLessEqual(times[name], config["duration"])

    def test_the_title_of_the_scenes_counts_failures(self):
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
        title = scenes.title({"flag": SimpleNamespace(runs=runs)})
        self.assertIn("2 of 3 runs are complete", title)
        self.assertIn("degenerate triangles in 1 of 2 runs, cloth inside obstacles in 1 of 2",
                      title)
        self.assertIn("1.50 (flag, crossover)", title)

    def test_the_title_of_the_hanging_sheets_counts_models_with_small_strain(self):
        def run(model, strain):
            return load.Run(Path("-"), "", "", "complete", {"bending": {"model": model}},
                            {"mean_strain": strain}, {"time": []})
        runs = {("none", 1): [run("none", 25.0)], ("adaptive", 1): [run("adaptive", 0.05)],
                ("lod", 1): [run("lod", 0.5)]}
        title = models.sheet_title([1], ["none", "adaptive", "lod"], runs)
        self.assertIn("1 of 3 models", title)
        self.assertTrue(title.endswith(" none"), title)

    def test_a_page_without_runs_says_what_is_missing(self):
        with tempfile.TemporaryDirectory() as folder:
            written(paper, Path(folder), Path(folder) / "paper")
            claims = json.loads((Path(folder) / "paper/summary.json").read_text())
            text = (Path(folder) / "paper/index.html").read_text()
        self.assertEqual({claim["holds"] for claim in claims}, {None})
        self.assertEqual({claim["figure"][0] for claim in claims}, set("12567o"))  # o: "ours"
        self.assertIn("configs/paper/fig1.json: none of its runs", text)

    def test_rings_of_a_strip(self):
        triangles = np.array([[i, i + 1, i + 2] for i in range(6)])  # vertex i touches i + 1 and i + 2
        np.testing.assert_array_equal(structure.ring_of(triangles, 0, 8), [0, 1, 1, 2, 2, 3, 3, 4])

    def test_rounding_changes_a_shade_by_at_most_one(self):
        image = np.random.default_rng(5).random((60, 60, 3))
        shades = []
        with tempfile.TemporaryDirectory() as folder:
            for large in (np.inf, 0):
                figure = style.plt.figure(figsize=(1, 1))
                figure.figimage(image)
                name = style.save(figure, folder, "noise", palette=False, large=large)
                shades.append(style.plt.imread(Path(folder) / name)[..., :3] * 255)
        # Half a step of 3 shades, rounded down, plus rounding in single precision.
        self.assertLessEqual(np.abs(shades[1] - shades[0]).max(), 1.001)
        self.assertEqual(shades[1].max(), 255)
        np.testing.assert_allclose(np.unique(np.rint(shades[1])) % 3, 0)

    def test_a_panel_states_its_time_and_whether_the_cloth_is_at_rest(self):
        speed = {3: 1.1 * cloth.REST * 2**0.5, 4: 0.9 * cloth.REST * 2**0.5}  # m/s; the square's size is √2
        run = SimpleNamespace(metrics={"time": np.array([0, 0.5, 1.0, 1.5, 2.0])}, size=2**0.5,
                              positions=lambda frame: SQUARE + [0, 0, 0.5 * speed.get(frame, 0)])
        self.assertEqual(cloth.time_text(run, 0), "t = 0.0 s")
        self.assertEqual(cloth.time_text(run, 3), "t = 1.5 s")
        run.positions = lambda frame: SQUARE + [0, 0, 0.5 * speed[4] * (frame == 4)]
        self.assertEqual(cloth.time_text(run, 4), "at rest, t = 2.0 s")
        run.metrics["time"] = np.array([0, 1 / 15])
        self.assertEqual(cloth.time_text(run, 1), "at rest, t = 0.07 s")

    def test_the_time_is_written_in_a_corner_without_cloth(self):
        left, low = np.array([[10.0, 5.0], [20, 8], [np.nan, 1]]), np.array([[10.0, 90.0]])
        self.assertIs(cloth.free_corner(left, (100, 100)), cloth.RIGHT)
        self.assertIs(cloth.free_corner(100 - left, (100, 100)), cloth.LEFT)  # below
        self.assertIs(cloth.free_corner(low, (100, 100)), cloth.LEFT)

    def test_the_panel_of_a_cloth_states_its_time(self):
        square = SimpleNamespace(metrics={"time": np.array([3.0])}, size=2**0.5, rest_positions=SQUARE,
                                 triangles=TRIANGLES, pinned=np.array([True, False, False, False]),
                                 pin_seeds=np.array([0]), positions=lambda frame: SQUARE,
                                 cell=lambda name, frame: np.ones(2))
        figure, axes = style.plt.subplots()
        cloth.draw_cloth(axes, cloth.Panel((square, 0), cloth.camera_of([(square, 0)])), width=40)
        self.assertIn("t = 3.0 s", [text.get_text() for text in axes.texts])
        style.plt.close(figure)

    def test_cloths_have_a_common_scale_and_the_largest_intact_cloth_fills_its_panel(self):
        def sample(height, strain, shift=0.0):
            cloth = np.array([[0, 0, 0], [0.1, 0, 0], [0.1, 0, -height], [0, 0, -height]]) + [0, 0, shift]
            return SimpleNamespace(metrics={"mean_strain": [strain]}, size=1.0, rest_positions=SQUARE,
                                   pin_seeds=np.array([0]), positions=lambda frame: cloth), 0
        samples = [sample(0.5, 0.1), sample(1.0, 0.1, shift=7.0), None, sample(40.0, 5.0)]
        cameras = cloth.cameras_of(samples, elevation=0.0, azimuth=-90.0)
        self.assertIsNone(cameras[2])
        heights = []
        for camera, (run, _) in zip(cameras[:2], samples[:2]):
            y = camera.project(run.positions(0), (100, 80))[0][:, 1]
            self.assertAlmostEqual((y.min() + y.max()) / 2, 50, delta=3)  # vertically centred
            heights.append(np.ptp(y))
        self.assertAlmostEqual(heights[1] / 100, 1 / 1.12, places=2)  # except for the margin
        self.assertAlmostEqual(heights[0] / heights[1], 0.5, places=2)

    def test_colour_blind_readers_can_distinguish_the_models_of_a_family(self):
        # Machado, Oliveira and Fernandes 2009, severity 1, on linear RGB: blind for red, green and blue.
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

        families = list(group(registry.models(), looks.family).values())
        for family, sight in itertools.product(families, map(np.array, sights)):
            for first, second in itertools.combinations(family, 2):
                contrast = np.linalg.norm(lab(looks.colour(first), sight) - lab(looks.colour(second), sight))
                self.assertGreater(contrast, 15, (first, second))  # 2.3 is just noticeable
        kinds = [{looks.of_model(model)["mark"] for model in family} for family in families]
        for first, second in itertools.combinations(kinds, 2):
            self.assertFalse(first & second)

    def test_numbers_are_written_with_three_digits(self):
        self.assertEqual([number(x) for x in (0.12345, 12.345, 1234.5, 0, np.inf, np.nan)],
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

    def test_the_verdict_of_every_rule(self):
        self.assertEqual(self.judged()[0], "green")
        self.assertEqual(self.judged(mean_strain=0.03), ("amber", "mean strain"))
        # The limit is twice the strain of the undisturbed run.
        self.assertEqual(self.judged(mean_strain=0.03, control={"mean_strain": 0.02})[0], "green")
        # The limit does not grow if the undisturbed run is strained, too.
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
        for strain in (0.03, 1.0, 30.0, 1e6):  # with the reach of the cloth at rest
            self.assertEqual(self.judged(mean_strain=strain), ("amber", "mean strain"))
        self.assertEqual(self.judged(mean_strain=1e6, stability_reach_end=3)[0], "red")

    def test_each_failed_criterion_of_a_case_has_a_still(self):
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
        stills = [(cell.case.name, cell.model, alike) for cell, alike in hard_cases.shown(cells, cases)]
        self.assertEqual(stills, [(cases[0].name, "lod", 2), (cases[0].name, "k_ring", 1),
                                  (cases[1].name, "lod", 2)])

    def test_a_cloth_of_any_extent_fits_the_frame_of_its_still(self):
        size, rng = 2**0.5, np.random.default_rng(7)
        for extent in ((0, 0, 0), (1, 0, 0), (0, 0, 400), (1e-6, 1e-6, 1e-6), (100, 1, 1), (3, 300, 20)):
            cloth = rng.uniform(-0.5, 0.5, (200, 3)) * extent + [5, -7, 3]
            camera = render.camera_around(np.concatenate([cloth, [[np.nan] * 3]]), size / 2)
            pixels, nearness = camera.project(cloth, (200, 200))
            self.assertTrue((nearness > 0).all())
            self.assertTrue((pixels > 2).all() and (pixels < 198).all(), extent)
            if max(extent) > size:  # a large cloth fills the frame
                self.assertGreater(np.ptp(pixels, axis=0).max(), 160)

    def test_a_degenerate_triangle_is_drawn_as_a_line(self):
        thread, wide = np.array([[0, 0], [0.2, 50], [0, 100], [60, 0]]), np.array([[0, 1, 2], [0, 1, 3]])
        lines = hard_cases._slivers(thread, wide, np.zeros((2, 3))).get_segments()
        self.assertEqual(len(lines), 1)
        np.testing.assert_array_equal(np.sort(lines[0][:, 1]), [0, 100])  # along its longest edge

    def test_needles_are_the_flawed_triangles(self):
        rest = np.array([[0, 0, 0], [1, 0, 0], [1, 0.001, 0], [0, 1, 0]])
        run = SimpleNamespace(rest_positions=rest, triangles=np.array([[0, 1, 2], [0, 1, 3]]),
                              cell=lambda name, frame: np.array([4.0, 2.0]))
        np.testing.assert_array_equal(stability_reasons.flawed_triangles(run), [True, False])
        self.assertAlmostEqual(stability_reasons.flawed_strain(run), 75)

    def test_cases_with_different_verdicts_are_rows_and_uniform_cases_are_listed(self):
        cases = [stability_cases.CASES[i] for i in range(4)]
        verdicts = ["green green", "amber red", "red red", ""]  # in single and double precision
        cells = {(case.name, "none", precision): SimpleNamespace(verdict=verdict)
                 for case, pair in zip(cases, verdicts)
                 for precision, verdict in zip(("single", "double"), pair.split())}
        runs = [hard_run(*place, cell.verdict) for place, cell in cells.items()]
        rows, _ = stability_matrix.split_cases(group(runs, lambda run: run["case"]))
        self.assertEqual(rows, [cases[1].name])  # the last case has no runs
        matrix, uniform = stability_matrix.cases_html(runs)
        self.assertIn("The 2 cases in which all runs have one colour", uniform)
        self.assertIn(f"all green</span>: start poses: {cases[0].title}<", uniform)
        self.assertIn(f"all red</span>: start poses: {cases[2].title}<", uniform)
        self.assertNotIn(cases[1].title, uniform)
        self.assertNotIn(cases[3].title, uniform)
        self.assertIn(cases[1].title, matrix)
        self.assertIn("aria-label='none, double: red'>×<", matrix)

    def test_cases_with_the_most_different_verdicts_come_first(self):
        of = lambda *verdicts: [hard_run("start: point", str(i), "single", verdict)
                                for i, verdict in enumerate(verdicts)]
        ordered = sorted([of("red", "green"), of("amber", "green"), of("red", "red"),
                          of("red", *["green"] * 9)], key=stability_matrix.discrimination, reverse=True)
        self.assertEqual([len(case_runs) for case_runs in ordered], [2, 10, 2, 2])
        self.assertEqual(stability_matrix.discrimination(ordered[-1]), 0)  # all red

    def test_a_cell_opens_a_panel_with_limit_config_and_command_of_its_run(self):
        runs = [hard_run("start: creased", "adaptive", "single", "red", why="it folds"),
                hard_run("gust: gale", "adaptive", "double", "green")]
        data = stability_matrix.data(runs)
        failed, green = data["runs"]
        self.assertEqual(failed["command"], "./bendlab run configs/stability/start.json --set "
                         "'/initial={\"creases\": 31}' --set '/solver/precision=single'")
        self.assertEqual(data["texts"][failed["why"]], "it folds")
        worst = failed["worst"]
        self.assertEqual((worst["value"], worst["limit"], worst["held"]), (2, 1, False))
        settings = data["settings"][failed["base"]] | {pointer: value[0] for pointer, value
                                                       in failed["changes"].items() if value}
        self.assertEqual(settings["/initial/creases"], 31)
        self.assertEqual(settings["/solver/precision"], "single")
        self.assertIn("/effects/0/type", data["settings"][green["base"]])
        self.assertEqual(green["status"], "green")

    def test_models_with_the_same_reason_share_a_row(self):
        worst = lambda value: stability_cases.Criterion("mean strain", value, 0.2, "1", "amber")
        cells = [hard_run("start: point", model, precision, "amber", worst(value).as_json(), why)
                 for model, precision, value, why in [("none", "single", 0.5, "it slips"),
                                                      ("none", "double", 0.25, "it slips"),
                                                      ("adaptive", "double", 0.75, "it slips"),
                                                      ("dihedral", "double", 3.0, "")]]
        text = stability.failed_html(cells, 3)
        self.assertEqual(text.count("<tr>"), 3)  # the head and two rows
        self.assertIn("none, adaptive (double)</td><td class='t'>mean strain 0.250 to 0.750", text)
        self.assertEqual(text.count("it slips"), 1)
        self.assertIn(f"<li>{stability.UNKNOWN}</li>", text)

    def test_every_reason_belongs_to_a_case_and_states_a_number(self):
        names = [case.name for case in stability_cases.CASES]
        for reason in stability_reasons.REASONS:
            self.assertRegex(reason.text, r"\d|<")
            for quantity, case, named, change in stability_reasons.PLACE.findall(reason.text):
                self.assertIn(quantity, stability_reasons.QUANTITIES)
                self.assertTrue(any(name.startswith(case) for name in names), case)
                self.assertLessEqual(set(named.split()), set(registry.models()))
                self.assertIn(change, ["", *stability_reasons.CHANGES])
            for config, _ in reason.apart:
                self.assertTrue((sweeps.CONFIGS / f"stability/{config}.json").is_file(), config)
            for beginning in reason.cases:
                self.assertTrue(any(name.startswith(beginning) for name in names), beginning)
            self.assertLessEqual(set(reason.models), set(registry.models()))

    def test_a_reason_is_given_only_if_its_condition_holds(self):
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
        self.assertNotEqual(bare, ring)  # one name is the beginning of the other

    def test_numbers_of_a_reason_are_from_the_page_or_have_a_command(self):
        def cell(model, precision, strain):
            run = SimpleNamespace(complete=True, summary={"mean_strain": strain})
            return stability_cases.Cell(SimpleNamespace(name="stiff: k = 1"), run, "amber",
                                        None), model, precision
        cells = {}
        for entry, model, precision in (cell("dihedral", "double", 1.052), cell("dihedral", "single", 9.0),
                                        cell("none", "double", 0.94)):
            entry.run.model = model
            cells[entry.case.name, model, precision] = entry
        apart = {"stiff": {"100": {"stiff: k = 1": {"dihedral": {"strain": 0.067},
                                                    "none": {"strain": 0.059}}}}}
        with mock.patch.object(stability_reasons, "apart", lambda: apart):
            stability_reasons.explain(cells)
        text = cells["stiff: k = 1", "none", "double"].why
        self.assertIn("1.1 → 0.067 (dihedral), 0.94 → 0.059", text)
        self.assertIn("apart from this page", text)
        self.assertIn("./bendlab run configs/stability/stiff.json --set /solver/iterations=100", text)

    def test_every_point_of_every_sweep_is_a_case_or_the_control_of_a_case(self):
        # 1 and 1.0 are equal
        canonical = lambda value: json.dumps(json.loads(json.dumps(value), parse_int=float), sort_keys=True)

        def places(sweep):
            swept = {pointer: values for pointer, values in sweep.items() if pointer not in
                     ("/bending/model", "/bending", "/solver/precision", "/solver/order", "/solver")}
            return [(pointer, canonical(index if pointer == "/effects" else value))
                    for pointer, values in swept.items() for index, value in enumerate(values)]

        for folder, cases in ((stability_cases.FOLDER, stability_cases.CASES),
                              (stability_cases.METHODS, stability_cases.METHOD_CASES),
                              (stability_cases.FABRICS, stability_cases.FABRIC_CASES)):
            for config in sorted(sweeps.CONFIGS.glob(f"{folder}/*.json")):
                used = {(pointer, canonical(value)) for case in cases
                        for of, wanted in ((case.config, case.where),
                                           (case.control_config or case.config, case.control))
                        if of == config.stem for pointer, value in wanted.items()}
                there = set(places(json.loads(config.read_text(encoding="utf-8"))["sweep"]))
                self.assertEqual(used, there, config)

    def test_the_cases_of_methods_have_the_scenes_of_the_hard_cases(self):
        read = lambda place: json.loads((sweeps.CONFIGS / f"{place}.json").read_text(encoding="utf-8"))
        scene = ("pins", "effects", "initial")
        for name in stability_cases.REPEATED:
            hard = read(f"stability/{name}")
            for end in ("", stability_cases.BY_NEWTON):
                config = read(f"methods/{name}{end}")
                self.assertEqual(config["name"], f"methods_{name}{end}")
                self.assertEqual(config["output"], hard["output"])
                self.assertEqual([config.get(key) for key in scene], [hard.get(key) for key in scene])
                self.assertEqual(set(config["sweep"]) - {"/solver"},
                                 set(hard["sweep"]) - {"/solver/precision"})
        self.assertEqual(len(list((sweeps.CONFIGS / "methods").glob("*.json"))),
                         2 * len(stability_cases.REPEATED))
        for name in stability_cases.WITH_FABRICS:
            method, fabric = (read(f"{folder}/{name}") for folder in ("methods", "fabrics"))
            same = ("duration", "mesh", "material", "output", *scene)
            self.assertEqual([fabric.get(key) for key in same], [method.get(key) for key in same])
        self.assertEqual(sorted(file.stem for file in (sweeps.CONFIGS / "fabrics").glob("*.json")),
                         sorted(stability_cases.WITH_FABRICS))

    @staticmethod
    def by_method(case, model, method, verdict, value=2.0):
        config = "methods/" + next(known.config for known in stability_cases.METHOD_CASES
                                   if known.name == case)
        solver = {"method": method.split(",")[0]} | ({"integrator": "euler"} if "euler" in method else {})
        run = hard_run(case, model, "", verdict, {"what": "reach", "value": value, "limit": 1, "unit": "1"})
        del run["precision"]
        return run | {"method": method, "config": config,
                      "point": {"/solver": solver, "/initial": {"random": 1}, "/bending/model": model}}

    def test_a_cell_of_a_method_lists_its_models_worst_first_and_counts_failures(self):
        case = "start: random"
        runs = [self.by_method(case, "none", "pbd", "red", 3), self.by_method(case, "lod", "pbd", "red", 9),
                self.by_method(case, "dihedral", "pbd", "green"),
                self.by_method(case, "none", "newton, euler", "amber"),
                self.by_method("start: mirrored", "none", "pbd", "green", 0.5),
                self.by_method("start: mirrored", "none", "newton, euler", "green", 0.5)]
        table, alike = stability_matrix.columns_table(runs, "method")
        self.assertIn("data-run='start-random.lod.pbd start-random.none.pbd'", table)  # worst first
        self.assertIn("status red' title='red'>2 of 3<", table)
        self.assertIn("status amber' title='amber'>1 of 1<", table)
        self.assertNotIn("mirrored", table)
        self.assertIn("all green</span>: start poses: mirrored<", alike)
        self.assertEqual(stability_matrix.columns_answer(runs, "method", "model"),
                         "Unstable with at least one model: newton, euler in 0 of 2; pbd in 1 of 2 cases.")

    def test_the_panel_of_a_run_of_a_method(self):
        runs = [hard_run("start: random", "none", "single", "green"),
                self.by_method("start: random", "none", "newton, euler", "red")]
        data = stability_matrix.data(runs)
        hard, method = data["runs"]
        self.assertEqual([hard["id"], method["id"]],
                         ["start-random.none.single", "start-random.none.newton-euler"])
        self.assertIn("./bendlab run configs/methods/start.json --set '/solver=", method["command"])
        self.assertTrue(method["title"].endswith("none, newton, euler"))
        settings = data["settings"][method["base"]] | {pointer: value[0] for pointer, value
                                                       in method["changes"].items() if value}
        self.assertEqual((settings["/solver/integrator"], settings["/initial/random"]), ("euler", 1))
        self.assertNotIn("stills", method)  # runs of methods have no stills

    def test_the_name_of_a_method_states_the_integrator_if_it_is_not_the_default(self):
        self.assertEqual([load.method_name(solver) for solver in
                          ({}, {"method": "newton", "integrator": "bdf2"},
                           {"method": "newton", "integrator": "euler"},
                           {"method": "quasi_newton", "integrator": "euler"},
                           {"method": "quasi_newton", "integrator": "bdf2"})],
                         ["pbd", "newton", "newton, euler", "quasi_newton", "quasi_newton, bdf2"])

    def test_the_overview_counts_verdicts(self):
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
        self.assertIn("amber for 1 of 2 models", stability.plain_grid(runs))
        self.assertEqual(stability.plain_grid([]), "")

    def test_a_page_without_runs_says_what_is_missing(self):
        with tempfile.TemporaryDirectory() as folder:
            section, *_ = written(stability, Path(folder), Path(folder) / "page")
            self.assertEqual(section.data, [])
            self.assertIn("configs/stability/start.json: none of its runs",
                          (Path(folder) / "page/index.html").read_text(encoding="utf-8"))


class PlainTest(unittest.TestCase):
    """The bounds of the plain matrix, on motions with known values."""

    @staticmethod
    def sheet(cells=4, pins=(), velocity=(0, 0, 0)):
        """Replaces plain_cases.Scene: a unit square of cells × cells squares at rest, with one frame."""
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
        scene.mass = plain_cases.masses(rest, triangles)
        return scene

    def test_a_free_fall_has_no_fall_error_and_no_energy_gain(self):
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
        # The mean velocity between two frames is v0 + g (t₁ + t₂ + h) / 2.
        before, after = scene.time[:-1], scene.time[1:]
        between = np.array([0.3, 0, 1]) + scene.gravity * ((before + after + scene.h) / 2)[:, None]
        expected = np.linalg.norm(between, axis=1) / (np.hypot(0.3, 1) + 9.81 * after)
        self.assertAlmostEqual(plain_cases.speed(scene), expected.max(), places=12)
        # A sheet that does not move would, with an upward speed of 1 and gravity of 9.81, be lower by 0.18.
        scene.frames = np.repeat(scene.rest[None], 4, axis=0)
        self.assertGreater(plain_cases.fall_error(scene), 0.1)

    def test_a_free_fall_with_bdf2_equals_its_closed_form(self):
        h, g = 0.02, -9.81
        place, speed = [0, g * h ** 2], [0, g * h]  # the first step is a backward Euler step
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

    def test_a_setting_that_a_method_does_not_read_is_marked(self):
        config = {"solver": {"method": "newton", "integrator": "bdf2", "substeps": 1, "iterations": 20}}
        read = {axis: plain_cases.AXES[axis](config) for axis in ("method", "order", "sweep", "precision")}
        self.assertEqual(read, {"method": "newton", "order": plain_cases.NOT_READ,
                                "sweep": plain_cases.NOT_READ, "precision": "double"})

    def test_masses_are_thirds_of_areas(self):
        scene = self.sheet(1)
        # The diagonal connects the first and the last vertex.
        np.testing.assert_allclose(scene.mass, np.array([2, 1, 1, 2]) / 6)

    def test_strains_of_a_stretched_sheet_and_of_a_rotated_sheet(self):
        scene = self.sheet()
        scene.frames = np.stack([scene.rest, scene.rest * [1.2, 1, 1]])
        np.testing.assert_allclose(plain_cases.strains(scene), (0.2, 1.2))
        scene.frames = scene.rest[None] @ np.linalg.qr(np.random.default_rng(1).normal(size=(3, 3)))[0]
        np.testing.assert_allclose(plain_cases.strains(scene), (0, 1), atol=1e-7)  # √ of rounding

    def test_the_reach_of_a_vertex_is_1_1_times_its_path_along_edges(self):
        scene = self.sheet(4, pins=(0,))
        far = scene.rest * [1.2, 1, 1]  # (1, 0) is 1.2 from its pin; its path has length 1
        scene.frames = np.stack([scene.rest, far])
        self.assertAlmostEqual(plain_cases.beyond_reach(scene), (1.2 - 1.1) / scene.size, places=12)

    def test_paths_along_edges_are_the_shortest(self):
        scene = self.sheet(5, pins=(0, 35))
        way, pin = plain_cases.ways_from(scene)
        x, y = scene.rest[:, 0], scene.rest[:, 1]
        exact = lambda dx, dy: np.minimum(dx, dy) * np.sqrt(2) + abs(dx - dy)  # along diagonals first
        np.testing.assert_allclose(way, np.minimum(exact(x, y), exact(1 - x, 1 - y)), atol=1e-12)
        self.assertEqual(set(pin), {0, 35})

    def test_a_gain_of_energy_is_measured(self):
        scene = self.sheet(pins=(0,))
        scene.frames, scene.time = np.stack([scene.rest, scene.rest + [0, 0, 0.1]]), np.array([0, 0.1])
        # Mean speed 1 m/s, mean height 0.05 m; the scale is g √2.
        self.assertAlmostEqual(plain_cases.energy_gain(scene), (0.5 + 9.81 * 0.05) / (9.81 * np.sqrt(2)),
                               places=9)

    @staticmethod
    def verdict(value, warning="", status="complete"):
        return plain_cases.verdict_of(status, [stability_cases.Criterion("mean strain", value, 0.1, "1")],
                                      warning)

    def test_a_broken_bound_without_a_warning_is_silent(self):
        self.assertEqual(self.verdict(0.2), plain_cases.SILENT)
        self.assertEqual(self.verdict(np.nan), plain_cases.SILENT)
        self.assertEqual(self.verdict(0.2, "unconverged"), plain_cases.WARNED)
        self.assertEqual(self.verdict(0.05, "unconverged"), plain_cases.SOUND)
        self.assertEqual(self.verdict(0.05, "implausible", "implausible"), plain_cases.ALARM)

    def test_a_pair_of_settings_that_fails_is_listed_and_a_single_setting_is_not(self):
        values = [(a, b, c) for a in range(4) for b in range(4) for c in range(4)]
        row = lambda value, **settings: {"verdict": self.verdict(value), "settings": settings}
        together = [row(0.2 if a == b == 1 else 0, a=a, b=b, c=c) for a, b, c in values]
        self.assertEqual([(pair, wrong, runs) for pair, wrong, runs, _ in shares.pairs(together)],
                         [((("a", 1), ("b", 1)), 4, 4)])
        self.assertEqual(shares.pairs([row(0.2 if a == 1 else 0, a=a, b=b, c=c)
                                       for a, b, c in values]), [])
        self.assertEqual(shares.pairs([row(0.0, a=1, b=2)]), [])

    def test_a_run_that_diverges_in_the_first_step_breaks_a_bound(self):
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
        self.assertEqual(judged["broken"], ["time not simulated"])
        self.assertEqual((judged["verdict"], judged["warnings"]), (plain_cases.WARNED, "diverged"))
        self.assertEqual(judged["settings"]["pins"], "an edge")

    def test_the_sweeps_in_both_units_have_the_same_rows(self):
        read = lambda name: json.loads((sweeps.CONFIGS / f"plain/{name}.json").read_text(encoding="utf-8"))
        small, large, metres = (read(name)["sweep"] for name in (*plain_cases.TWINS, "metres"))
        self.assertEqual(large, metres)
        self.assertEqual([len(values) for values in small.values()],
                         [len(values) for values in large.values()])
        for in_small, in_large in zip(small["/bending"], large["/bending"]):
            self.assertEqual(plain_cases._bending({"bending": in_small, "mesh": {"scale": 2.0 ** -10}}),
                             plain_cases._bending({"bending": in_large, "mesh": {"scale": 1.0}}))
        scales = {value["scale"] for value in small["/mesh"]}
        self.assertEqual(scales, {1 / 1024})
        self.assertEqual(read("millimetres")["effects"][0]["acceleration"][2], -9.81 / 1024)

    def test_missing_pairs_of_a_cover_are_counted(self):
        experiment = SimpleNamespace(settings={"cover": 2},
                                     sweep={"/mesh/cells": [2, 4], "/bending/model": ["none", "lod"],
                                            "/solver/sweep": ["forward"]})
        run = lambda cells, model: SimpleNamespace(point={"/mesh/cells": cells, "/bending/model": model,
                                                          "/solver/sweep": "forward"})
        runs = [run(2, "none"), run(4, "none"), run(2, "lod")]
        self.assertEqual(shares.coverage(experiment, runs),
                         (2, 7, [{"/mesh/cells": 4, "/bending/model": "lod"}]))

    def test_a_page_without_runs_says_what_is_missing(self):
        with tempfile.TemporaryDirectory() as folder:
            section, = written(plain, Path(folder), Path(folder) / "page")
            self.assertEqual(section.data, [])
            self.assertIn("configs/plain/first.json: none of its runs",
                          (Path(folder) / "page/index.html").read_text(encoding="utf-8"))


class AccuracyTest(unittest.TestCase):
    """Costs, fronts and error levels of invented runs."""

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

    def test_the_cost_is_the_cpu_time_of_steps_per_frame(self):
        run = self.run_of(4, 0.1)
        self.assertAlmostEqual(measures.cost(run), 4, places=9)
        self.assertAlmostEqual(measures.projections(run), 10)

    def test_no_run_is_better_than_a_run_of_the_front_in_both_cost_and_error(self):
        cheap, _, middle, _, best = runs = [self.run_of(*point)
                                            for point in ((1, 0.5), (2, 0.6), (3, 0.2), (4, 0.2), (9, 0.1))]
        self.assertEqual(measures.front(runs[::-1]), [cheap, middle, best])
        diverged = self.run_of(0.1, np.nan, status="diverged")
        del diverged.summary["error_physical_rms"]
        self.assertEqual(measures.front([diverged, *runs])[0], cheap)
        self.assertIs(measures.reaching(runs, 20), middle)
        self.assertIsNone(measures.reaching(runs, 5))

    def test_a_run_without_an_error_is_not_on_the_front_of_this_error(self):
        run = self.run_of(1, 0.5)
        self.assertTrue(np.isnan(measures.error(run, against="solver")))
        self.assertEqual(measures.front([run], against="solver"), [])

    def test_slopes_and_costs_of_power_laws(self):
        self.assertAlmostEqual(slope([1, 2, 8], [3, 3 * 2**1.5, 3 * 8**1.5]), 1.5)
        self.assertTrue(np.isnan(slope([1], [2])))
        runs = [self.run_of(ms, 0.2 / ms**2, against="solver") for ms in (1, 3, 10)]  # 0.01 at √20 ms
        self.assertAlmostEqual(scaling.cost_at(runs, 0.01), np.sqrt(20), places=9)
        self.assertTrue(np.isnan(scaling.cost_at(runs, 1e-5)))

    def test_the_gain_by_substeps_is_the_ratio_of_errors(self):
        runs = [self.run_of(1, 0.3, substeps=1, iterations=16, against="solver"),
                self.run_of(1, 0.1, substeps=16, iterations=1, against="solver")]
        self.assertAlmostEqual(solver.gain(runs, 16), 3)
        self.assertTrue(np.isnan(solver.gain(runs, 64)))
        self.assertIn("1 of 1",
                      solver.message({("dihedral", 16): 3.0}, {("dihedral", 16): None}))

    def test_the_best_split_of_the_same_work_may_be_between_both_ends(self):
        errors = {(1, 16): 0.3, (4, 4): 0.05, (16, 1): 0.1, (16, 4): 0.01}  # (16, 4) is more work
        runs = [self.run_of(1, error, substeps=s, iterations=i, against="solver")
                for (s, i), error in errors.items()]
        line = solver.along(runs, 16)
        self.assertEqual(line, [(1, 0.3), (4, 0.05), (16, 0.1)])
        self.assertTrue(solver.best_between(line))
        self.assertFalse(solver.best_between([(1, 0.3), (4, 0.2), (16, 0.1)]))
        self.assertIsNone(solver.best_between([(1, 0.3), (16, 0.1)]))
        text = solver.message({("dihedral", 16): 3.0, ("none", 16): 2.0},
                              {("dihedral", 16): True, ("none", 16): False})
        self.assertIn("1 of 2 at work 16", text)

    def test_no_error_level_below_the_gap_of_the_reference_is_stated(self):
        runs = [self.run_of(1, 0.004, error_physical_reference_gap=0.012),
                self.run_of(2, 0.03, model="none", error_physical_reference_gap=0.012)]
        self.assertEqual(measures.known_levels(runs), [20, 5])
        # Without a coarser reference
        self.assertEqual(measures.known_levels([self.run_of(1, 0.1)]), list(measures.LEVELS))
        none, dihedral = measures.levels_rows(runs, "", "physical", "")
        of = lambda row: [row[name] for name in ("ms_1", "settings_1", "least", "not_known")]
        self.assertEqual([of(none), of(dihedral)],
                         [[None, "not known", 3, 1.2], [None, "not known", 0.4, 1.2]])
        self.assertEqual(measures.levels_table([none, dihedral]).texts()[1][-4:],
                         ["–", "not known", "below 1.2", "1.20"])
        self.assertIn("errors of 1 % are not known", fronts.message("", runs))
        self.assertIn("1.0 ms", fronts.message("", runs))

    def test_the_gain_is_stated_together_with_the_gain_of_a_coarser_mesh(self):
        def run_of(cells, ms, error):
            run = self.run_of(ms, error, model="adaptive")
            run.config["mesh"] = {"cells": cells}
            return run

        line = [run_of(8, 1, 0.04), run_of(64, 100, 0.2)]
        rest = [run_of(8, 0.5, 0.2), run_of(8, 2, 0.04), run_of(24, 50, 0.01)]
        np.testing.assert_allclose(beat.ratios(rest, line[1]), (0.005, 0.05))
        np.testing.assert_allclose(beat.ratios(rest, line[0]), (2, 5))
        np.testing.assert_allclose(beat.ratios(line, line[1]), (0.01, 0.2))
        self.assertTrue(np.isnan(beat.ratios([], line[0])).all())
        text = beat.message(rest, line, line[1])
        for ratio in ("0.50 % of the time", "5.0 % of the error", "on 8 cells", "2.0 times the time",
                      "5.0 times the error"):
            self.assertIn(ratio, text)

    def test_precisions_agree_up_to_the_first_difference(self):
        def run(precision, substeps):
            values = {"/solver/precision": precision, "/solver/substeps": substeps}
            return SimpleNamespace(get=values.get, wrong=1.0 + (precision == "single") * substeps / 1000)
        runs = [run(precision, n) for precision in ("single", "double") for n in (1, 16, 64, 256)]
        self.assertEqual(rounding.alike_until(lambda run: run.wrong, runs), 64)

    def test_models_for_which_the_smallest_time_step_is_best_are_counted(self):
        runs = [self.run_of(1, error, model, against="solver") for model, error in
                (("none", 0.3), ("none", 0.1), ("lod", 0.1), ("lod", 0.2))]
        for run, dt in zip(runs, (0.1, 0.01, 0.1, 0.01)):
            run.config["solver"]["dt"] = dt
        self.assertEqual(solver.finest_best(runs), "1 of 2")

    def test_the_message_on_motion_names_a_setting_and_not_a_model(self):
        runs = [self.run_of(ms, error, model, substeps, against="solver")
                for model, substeps, ms, error in [("none", 4, 1, 0.04), ("dihedral", 4, 2, 0.1),
                                                   ("none", 16, 4, 0.02), ("dihedral", 16, 8, 0.03),
                                                   ("none", 64, 16, 0.001), ("dihedral", 64, 32, 0.001)]]
        for run in runs:
            run.config["solver"]["precision"] = "single"
        text = scaling.motion_message(runs)
        self.assertTrue(text.startswith("16 × 1, single: 2 of 2 models"), text)
        self.assertIn("6.0 ms", text)  # between 4 and 8
        self.assertNotIn("dihedral", text)

    def test_scenes_are_compared_with_the_same_cloth(self):
        physical = lambda name: json.loads((sweeps.CONFIGS
                                            / f"accuracy/{name}.json").read_text(encoding="utf-8"))[
                                            "accuracy"]["physical"]
        for front, configs in (("front", ("paper", "paper_64", "paper_cells_slow", "beat")),
                               ("front_cantilever", ("paper_cantilever",))):
            for name in configs:  # their references state a membrane, because the scenes use k
                self.assertEqual([setting for setting in physical(name)
                                  if not setting.startswith("/material")], physical(front), name)

    def test_the_effect_of_a_remedy_is_the_effect_that_the_scene_does_not_have(self):
        run = lambda *types: SimpleNamespace(get=lambda _: [{"type": kind} for kind in types])
        self.assertEqual([roads.effects_of(run("gravity", *more)) for more in ((), ("tethers",))],
                         [[], ["tethers"]])

    def test_configs_that_share_a_front_have_no_run_twice(self):
        for configs in measures.FRONTS:
            experiments = [sweeps.load_experiment("none", f"accuracy/{name}") for name in configs]
            self.assertEqual(len({json.dumps(experiment.settings["accuracy"]) for experiment in experiments}),
                             1)
            wanted = [str(point) for experiment in experiments for point in every_point(experiment.sweep)]
            self.assertEqual(len(wanted), len(set(wanted)))
            # models × ways to split the work, and models × iterations of quasi_newton
            self.assertEqual(len(wanted), 17 * 15 + 11 * 7)

    def test_each_object_is_written_on_a_line(self):
        with tempfile.TemporaryDirectory() as folder:
            write_objects(Path(folder) / "summary.json", [{"a": 1}, {"b": [2, "ö"]}])
            text = (Path(folder) / "summary.json").read_text(encoding="utf-8")
        self.assertEqual(json.loads(text), [{"a": 1}, {"b": [2, "ö"]}])
        self.assertEqual(text.count("\n"), 4)

    def test_a_page_without_runs_lists_missing_runs(self):
        with tempfile.TemporaryDirectory() as folder:
            sections = written(accuracy, Path(folder) / "results", Path(folder) / "out")
            page_text = (Path(folder) / "out/index.html").read_text(encoding="utf-8")
            self.assertEqual(json.loads((Path(folder) / "out/summary.json").read_text(encoding="utf-8")), [])
        self.assertTrue(all(section.missing for section in sections))
        self.assertIn("Missing:<br>configs/accuracy/", page_text)


def lattice(rows, columns):
    """(rest, triangles) of an equilateral lattice with edges of length 1. Rows lie along y, and every second
    row is shifted by half an edge."""
    rest = np.array([[i * 3**0.5 / 2, j + i % 2 / 2, 0] for i in range(rows) for j in range(columns)])
    triangles = []
    for i in range(rows - 1):
        for j in range(columns - 1):
            a, b, c, d = i * columns + j, i * columns + j + 1, (i
                                                                + 1) * columns + j, (i + 1) * columns + j + 1
            triangles += [(a, b, d), (a, d, c)] if i % 2 else [(a, b, c), (b, d, c)]
    return rest, np.array(triangles)


class StripTest(unittest.TestCase):
    def test_the_heavy_elastica_agrees_with_its_limits(self):
        small, knee, large = strips.elastica_droop([1e-3, 8.0042, 1e3])
        self.assertAlmostEqual(small / (1e-3 / 8), 1, delta=1e-5)  # a beam under its weight: H/L = Γ/8
        self.assertAlmostEqual(np.degrees(np.arctan(knee)), 41.5, delta=0.01)  # the angle of ASTM D1388
        # With a boundary layer at the clamp: √(Γ/2) (1 - O(Γ^-1/2)).
        self.assertAlmostEqual(large / np.sqrt(1e3 / 2), 1, delta=0.06)

    def test_rings_of_a_lattice_have_six_vertices_per_edge(self):
        rest, triangles = lattice(11, 11)
        for ring in (1, 2, 3):
            pairs = strips.ring_pairs(triangles, len(rest), ring)
            self.assertEqual((pairs == 60).sum(), 6 * ring)  # vertex 60 is in the middle

    def test_springs_of_a_wide_lattice_have_the_coefficient_of_an_infinite_lattice(self):
        # Sums over half the springs of a vertex (its area is √3/2), with edge length and spring stiffness 1.
        # A spring of length l over n rows has δ = n² (n² - 1) h⁴/(24 l); C = 4/√3 Σ δ².
        h = 3**0.5 / 2
        by_hand = {2: [(2, 2 * h), (2, 2), (2, 2)],
                   3: [(2, 7**0.5), (2, 7**0.5), (3, 3), (3, 3), (3, 7**0.5), (3, 7**0.5)]}
        rest, triangles = lattice(26, 61)
        pinned = rest[:, 0] < 1e-9
        for ring, spans in by_hand.items():
            infinite = 4 / 3**0.5 * sum((n**2 * (n**2 - 1) * h**4 / (24 * length))**2 for n, length in spans)
            measured = strips.expected_quartic(rest, triangles, pinned, ring, 1.0)
            # A lattice of 60 edges in width has fewer oblique springs, by the share ring/60.
            self.assertAlmostEqual(measured / infinite, 1, delta=0.03)

    def test_a_check_holds_within_its_tolerance(self):
        check = lambda measured, tolerance, kind: Check("", "", "", 2.0, measured, tolerance, "", kind).holds
        self.assertEqual([check(2.1, 0.06, "relative"), check(2.1, 0.04, "relative"),
                          check(2.1, 0.11, "absolute"), check(2.1, 0.09, "absolute"), check(1.9, 0, "most"),
                          check(2.1, 0, "most"), check(np.nan, 1, "relative")],
                         [True, False, True, False, True, False, None])

    def test_the_sag_of_a_long_chain_is_half_its_length(self):
        # Solution of 2 a sinh(d/2a) = L by hand.
        self.assertAlmostEqual(textile.catenary_sag(1.25), 0.3318, delta=1e-4)
        # A very long chain hangs as two vertical lines.
        self.assertAlmostEqual(textile.catenary_sag(200) / 100, 1, delta=0.05)

    def test_the_critical_load_is_the_load_at_which_deflection_begins(self):
        points = {10: 0.0, 21: 0.01, 22: 0.01 * 2**0.5, 30: 0.5}  # deflection² ∝ Γ - 20 just above 20
        with unittest.mock.patch.multiple(buckling, load_number=lambda run: run,
                                          deflection=points.get):
            self.assertAlmostEqual(buckling.critical_load(list(points)), 20, places=9)

    def test_texts_of_the_stiffness_page_state_computed_numbers(self):
        def run(family, cells, model="lod", deflection="large", **summary):
            config = {"mesh": {"generator": "grid", "diagonal": family, "cells": cells, "width": 0.24},
                      "bending": {"model": model, "deflection": deflection, model: {"radius": 0.04}}}
            if family == "equilateral":
                config["mesh"]["generator"] = family
            return load.Run(Path("-"), "", "", "complete", config, summary, {"time": []})
        self.assertEqual(calibrated.lengths_text([run("equilateral", n) for n in (24, 12)]),
                         "Springs have one length, 4 cm, at every resolution (2, 4 edges at 12, 24 cells).")
        text = calibrated.small_text([run("alternating", 24, "dihedral", model_small_deflection=0.9,
                                          model_large_deflection=1.2)])
        self.assertIn("energy is 0.75 of the cylinder's", text)
        rows = [{"model": model, "iterations": 1, "substeps": n, "measured": 1 / (1 + lost)}
                for model, n, lost in (("dihedral", 1, 16), ("dihedral", 4, 1), ("lod", 1, 4), ("lod", 2, 2))]
        text = effective.doubling_text(rows)
        self.assertIn("by 75 % for hinges, by 50 % for springs", text)

    def test_a_page_without_runs_has_checks_without_a_result(self):
        with tempfile.TemporaryDirectory() as folder:
            written(stiffness, Path(folder), Path(folder) / "stiffness")
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
