"""Tests of the planned runs of a config, and of the commands that compute given runs again."""
import json
import sys
import tempfile
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "analysis"))

from made_up_runs import made_up, planned_by, points_of  # noqa: E402
from runs.repeat import commands, runs_of as runs_of_command  # noqa: E402
from runs.sweeps import load_experiment, planned_points, planned_runs, read_config  # noqa: E402


def runs_of(*configs):
    return made_up(configs, lambda run: {})


class Planned(unittest.TestCase):
    def test_settings_of_another_model_are_not_an_axis(self):
        """3 pins; crossover, or adaptive with two roundings of m; 2 dampings, 4 solvers, 2 meshes."""
        settings = read_config("paper/map")
        points = planned_points(settings, settings["sweep"])
        self.assertEqual(len(points), 3 * (1 + 2) * 2 * 4 * 2)
        for point in points:
            self.assertEqual("/bending/adaptive/m_rounding" in point, point["/bending/model"] == "adaptive")

    def test_a_missing_run_has_the_settings_of_its_point(self):
        with tempfile.TemporaryDirectory() as empty:
            runs = planned_runs(load_experiment(Path(empty), "paper/map_lod"))
        self.assertEqual({(run.status, run.over) for run in runs}, {("missing", False)})
        for run in runs:
            for pointer, value in run.point.items():
                self.assertEqual(run.get(pointer), value)

    def test_runs_of_a_trial_do_not_count(self):
        """The folder has a sweep file with other settings, and no sweep file of the config itself."""
        with tempfile.TemporaryDirectory() as folder:
            trial = {"overrides": ["/bending/k=0.9"], "settings": {}, "axes": {}, "models": {}, "runs": []}
            (Path(folder) / "map_n").mkdir()
            (Path(folder) / "map_n" / "map_n,k=0.9.sweep.json").write_text(json.dumps(trial))
            experiment = load_experiment(Path(folder), "paper/map_n")
        self.assertIn("trial", experiment.absent)
        experiment.runs = runs_of("paper/map_n")
        self.assertEqual({run.status for run in planned_runs(experiment)}, {"missing"})


class Commands(unittest.TestCase):
    def check(self, runs, count):
        """Checks that `count` commands plan exactly these runs, each once."""
        lines = commands(runs)
        self.assertEqual(planned_by(lines), points_of(runs))
        self.assertEqual(len(lines), count)

    def test_all_runs_of_a_config_need_no_change(self):
        self.assertEqual(commands(runs_of("paper/map_n")), ["./bendlab run configs/paper/map_n.json"])
        self.assertEqual(commands([]), [])

    def test_the_command_of_a_run_sets_the_swept_settings(self):
        runs = runs_of("paper/map")
        self.check(runs[:1], 1)
        self.assertIn("--set /mesh/cells=16", commands(runs[:1])[0].replace("'", ""))

    def test_runs_of_two_configs_need_two_commands(self):
        at_16 = lambda run: run.get("/mesh/cells") == 16
        runs = [run for run in runs_of("paper/map", "paper/map_seeds") if at_16(run)]
        self.check(runs, 2)

    def test_models_with_different_axes_need_only_one_command(self):
        runs = [run for run in runs_of("paper/map")
                if run.get("/bending/adaptive/m_rounding", "round") == "round" and run.get("/pins/ring") == 1]
        self.assertEqual({run.model for run in runs}, {"crossover", "adaptive"})
        self.check(runs, 1)

    def test_the_runs_of_a_command_can_be_computed_from_the_command(self):
        for run in runs_of("paper/map", "paper/map_seeds", "paper/map_n")[::7]:
            self.assertEqual(runs_of_command(commands([run])[0]), (run.experiment, [run.point]))
        two_seeds = [run for run in runs_of("paper/map_n") if run.get("/initial/seed") in (2, 3)]
        self.assertEqual(runs_of_command(commands(two_seeds)[0])[1], [run.point for run in two_seeds])

    def test_runs_that_are_not_a_sweep_are_split_into_several_commands(self):
        setting = lambda run: (run.get("/bending/adaptive/n_multiplier"), run.get("/initial/seed"))
        self.check([run for run in runs_of("paper/map_n") if setting(run) in ((1, 1), (1, 2), (4, 1))], 2)
        self.check([run for run in runs_of("paper/map_n") if setting(run) in ((1, 1), (2, 2), (4, 1))], 2)


if __name__ == "__main__":
    unittest.main()
