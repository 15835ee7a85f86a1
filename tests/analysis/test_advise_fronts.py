"""Tests of the settings that `bendlab advise` starts from: only the best settings of measured scenes."""

import json
import sys
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "analysis"))

import advise_fronts  # noqa: E402


def run(model, substeps, error, ms, **changes):
    solver = {"method": "pbd", "substeps": substeps, "iterations": 1, "sweep": "forward", "levels": 0}
    result = {"experiment": "front", "point": {}, "model": model, "cells": 12, "settings": solver,
              "stiffness": "physical", "status": "complete", "error_physical_rms": error,
              "error_physical_strain": 0.01, "ms_per_frame": ms}
    return result | changes


def chosen(runs):
    return [(model, substeps) for _, _, model, substeps, _ in advise_fronts.best_settings(runs)]


class Fronts(unittest.TestCase):
    def test_settings_that_are_worse_in_error_and_time_are_left_out(self):
        runs = [run("a", 1, 0.1, 1), run("b", 1, 0.11, 2), run("a", 4, 0.02, 4)]
        self.assertEqual(chosen(runs), [("a", 1), ("a", 4)])

    def test_settings_with_a_slightly_smaller_error_are_left_out(self):
        self.assertEqual(chosen([run("a", 1, 0.1, 1), run("a", 2, 0.09, 2)]), [("a", 1)])

    def test_unfit_runs_do_not_replace_other_runs(self):
        runs = [run("a", 1, 0.01, 1, status="implausible"), run("b", 1, 0.02, 1, error_physical_strain=0.2),
                run("c", 1, 0.03, 1, stiffness="k"), run("d", 1, 0.1, 2)]
        self.assertEqual(chosen(runs), [("d", 1)])

    def test_scenes_are_not_compared_with_each_other(self):
        runs = [run("a", 1, 0.1, 1), run("b", 1, 0.15, 3, cells=24),
                run("c", 1, 0.15, 3, experiment="front_slow")]
        self.assertEqual(chosen(runs), [("a", 1), ("b", 1)])  # parts of an experiment are the same scene

    def test_the_table_in_the_program_agrees_with_the_committed_data(self):
        runs = json.loads((ROOT / "results/accuracy/summary.json").read_text())
        committed = (ROOT / "experiments/advise/fronts.def").read_text()
        table = advise_fronts.table(advise_fronts.best_settings(runs))
        self.assertEqual(committed, table, "run analysis/advise_fronts.py")


if __name__ == "__main__":
    unittest.main()
