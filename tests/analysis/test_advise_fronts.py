"""The settings that `bendlab advise` starts from: the best of measured scenes, and nothing else."""

import json
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "analysis"))

import advise_fronts  # noqa: E402


def run(model, substeps, error, ms, **changes):
    solver = {"method": "pbd", "substeps": substeps, "iterations": 1, "sweep": "forward", "levels": 0}
    made = {"experiment": "front", "point": {}, "model": model, "cells": 12, "settings": solver,
            "stiffness": "physical", "status": "complete", "error_physical_rms": error,
            "error_physical_strain": 0.01, "ms_per_frame": ms}
    return made | changes


def chosen(runs):
    return [(model, substeps) for _, _, model, substeps, _ in advise_fronts.best_settings(runs)]


class Fronts(unittest.TestCase):
    def test_what_another_beats_is_left_out(self):
        runs = [run("a", 1, 0.1, 1), run("b", 1, 0.11, 2), run("a", 4, 0.02, 4)]
        self.assertEqual(chosen(runs), [("a", 1), ("a", 4)])

    def test_what_is_hardly_better_is_left_out(self):
        self.assertEqual(chosen([run("a", 1, 0.1, 1), run("a", 2, 0.09, 2)]), [("a", 1)])

    def test_what_is_unfit_beats_nothing(self):
        runs = [run("a", 1, 0.01, 1, status="implausible"), run("b", 1, 0.02, 1, error_physical_strain=0.2),
                run("c", 1, 0.03, 1, stiffness="k"), run("d", 1, 0.1, 2)]
        self.assertEqual(chosen(runs), [("d", 1)])

    def test_scenes_are_not_compared_with_each_other(self):
        runs = [run("a", 1, 0.1, 1), run("b", 1, 0.15, 3, cells=24),
                run("c", 1, 0.15, 3, experiment="front_slow")]
        self.assertEqual(chosen(runs), [("a", 1), ("b", 1)])  # parts of an experiment are one scene

    def test_the_table_is_that_of_the_committed_data(self):
        runs = json.loads((ROOT / "results/accuracy/summary.json").read_text())
        committed = (ROOT / "experiments/advise/fronts.def").read_text()
        made = advise_fronts.table(advise_fronts.best_settings(runs))
        self.assertEqual(committed, made, "run analysis/advise_fronts.py")


if __name__ == "__main__":
    unittest.main()
