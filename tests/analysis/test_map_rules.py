"""Tests of the rules of the verdict maps, on invented runs: a cell holds, fails, or stays open."""
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "analysis"))

from bendlab.results.load import select  # noqa: E402
from figures.paper import map_rules as rules  # noqa: E402
from figures.paper import maps  # noqa: E402
from figures.paper.map_cells import cell, median, rows, same_seeds  # noqa: E402
from made_up_runs import made_up, planned_by, points_of  # noqa: E402
from runs.repeat import commands  # noqa: E402
from tables.claim_map import Place, places  # noqa: E402
from tables.section import Section  # noqa: E402


def sheets(value, status=lambda run: "complete", configs=maps.PIN_CONFIGS[:4]):
    """Groups of sheets with (crossover, adaptive). value(run) is the drop of a run, and its stretch − 1."""
    numbers = lambda run: {"pin_max_stretch": 1 + value(run), "pin_region_stretch": 1 + value(run),
                           "max_stretch": 1 + value(run), "drop": value(run), "mean_strain": 0.01}
    runs = made_up(configs, numbers, status)
    return [places(select(runs, bending__model=model)) for model in ("crossover", "adaptive")]


def n_of(run):
    return run.get("/mesh/cells")


def only(chosen, status):
    """A status for the chosen runs. All other runs are complete."""
    return lambda run: status if chosen(run) else "complete"


class Stretch(unittest.TestCase):
    def test_a_triangle_of_more_than_twice_its_length_is_wrong(self):
        claim = rules.wrong_at_the_pin(sheets(lambda run: 1.1 if n_of(run) > 16 else 0.9)[0])
        self.assertEqual({place.pins for place in claim.cells}, {"the corner alone"})
        for place, box in claim.cells.items():
            self.assertIs(box.holds, place.cells > 16)
            self.assertEqual(box.text, "1.1" if place.cells > 16 else "0.90")

    def test_the_stretch_has_to_grow_with_every_finer_mesh(self):
        for values, holds in (((0.5, 1, 2), True), ((0.2, 0.4, 0.9), False), ((0.5, 0.4, 2), False)):
            value = dict(zip(rules.SHEETS, values))
            claim = rules.fails_with_resolution(sheets(lambda run: value[n_of(run)])[0])
            whole = [box.holds for place, box in claim.cells.items() if place.damping == "viscous drag"]
            self.assertEqual(whole, [holds] * len(whole))

    def test_a_row_without_the_finest_mesh_is_open(self):
        claim = rules.fails_with_resolution(sheets(n_of)[0])
        much_work = ("16 × 10", "256 × 1 (strain converged)")
        lacking = {place: box for place, box in claim.cells.items()
                   if place.damping == "no damping" and place.solver in much_work}
        self.assertEqual(len(lacking), 18)
        for place, box in lacking.items():
            self.assertTrue(box.open)
            self.assertEqual(box.text, "not run" if place.cells == 64 else str(place.cells))
        self.assertEqual(claim.open, 18)
        self.assertIn("18 boxes are open", claim.sentence)

    def test_normal_cloth_has_no_large_stretch_and_no_large_strain(self):
        self.assertIs(rules.normal_cloth(sheets(lambda run: 0.9)[1]).holds, True)
        self.assertIs(rules.normal_cloth(sheets(lambda run: 1.1)[1]).holds, False)
        self.assertEqual(rules._sound(0.5, 0.11), ("0.50 (0.11)", False))


class Stiffness(unittest.TestCase):
    def strips(self, stiffness, **changes):
        return made_up(["paper/map_strip"], lambda run: {
            "settled_at": 9, "stiffness_flexural_rigidity": stiffness(run), **changes})

    def test_the_limit_of_equal_stiffness_is_a_quarter(self):
        for largest, holds in ((1.24, True), (1.26, False)):
            claim = rules.equally_stiff(self.strips(lambda run: 1e-6 * (largest if n_of(run) == 24 else 1)))
            self.assertIs(claim.holds, holds)
            self.assertEqual({box.text for box in claim.cells.values()},
                             {f"1.{2 if holds else 3} (1.0, 1.{2 if holds else 3}, 1.0)"})
            self.assertEqual({place.cells for place in claim.cells}, {"12 to 48"})

    def test_the_finest_strips_are_included(self):
        runs = self.strips(lambda run: 1) + made_up(["paper/map_strip_full"], lambda run: {
            "settled_at": 9, "stiffness_flexural_rigidity": 2})
        claim = rules.equally_stiff(runs)
        self.assertIs(claim.holds, False)
        self.assertEqual({place.cells for place in claim.cells}, {"12 to 96"})

    def test_a_strip_that_still_moves_has_no_stiffness(self):
        runs = self.strips(lambda run: 1)
        runs[0].summary.pop("settled_at")
        claim = rules.equally_stiff(runs)
        self.assertEqual([box.text for box in claim.cells.values() if box.open], ["not measured"])

    def test_only_damped_sheets_are_compared_by_drop(self):
        claim = rules.equal_drop(sheets(lambda run: 1 if run.get("/effects/1/coefficient") else n_of(run))[1])
        self.assertEqual({place.damping for place in claim.cells}, {"viscous drag"})
        self.assertIs(claim.holds, True)
        self.assertIs(rules.equal_drop(sheets(lambda run: 1 + 0.1 * (n_of(run) == 64))[1]).holds, False)

    def test_the_comparison_of_drops_needs_every_mesh(self):
        configs = [config for config in maps.PIN_CONFIGS[:4] if config != "paper/map_64_rest"]
        claim = rules.equal_drop(sheets(lambda run: 1, configs=configs)[1])
        for place, box in claim.cells.items():
            self.assertIs(box.holds, True if place.solver in ("1 × 10", "4 × 10") else None)


class SpringsOrRing(unittest.TestCase):
    def claim(self, neither, ring, springs, both):
        """The claim if the stretch has these values in all sheets."""
        value = {("crossover", 0): neither, ("crossover", 1): ring,
                 ("adaptive", 0): springs, ("adaptive", 1): both}
        return rules.springs_rather_than_ring(*sheets(lambda run: value[run.model, run.get("/pins/ring")]))

    def cell(self, *values):
        """Text and verdict of the cells, which are all equal."""
        cells = {(box.text, box.holds) for box in self.claim(*values).cells.values()}
        self.assertEqual(len(cells), 1)
        return cells.pop()

    def test_the_share_is_a_share_of_the_logarithm(self):
        self.assertEqual(self.cell(100, 50, 4, 2), ("82 %", True))  # ln 25 / ln 50
        self.assertEqual(self.cell(100, 4, 50, 2), ("18 %", False))

    def test_a_factor_that_makes_the_stretch_worse_is_named(self):
        self.assertEqual(self.cell(8, 16, 2, 4), ("the ring makes it worse", True))
        self.assertEqual(self.cell(8, 2, 16, 4), ("the springs make it worse", False))

    def test_a_cell_without_reduction_has_no_verdict(self):
        self.assertEqual(self.cell(1, 1, 1, 0.9), ("no reduction", None))
        claim = self.claim(1, 1, 1, 0.9)
        self.assertEqual((claim.open, claim.sentence), (0, "open: no box has anything to judge"))

    def test_the_claim_states_that_it_is_not_a_claim_of_the_paper(self):
        self.assertNotIn("?", self.claim(1, 1, 1, 1).english)
        self.assertIn("Our question, not the paper's", self.claim(1, 1, 1, 1).english)


class Distances(unittest.TestCase):
    """The distance of two runs is `far`; the distance of two seeds of the same sheet is 0.02."""

    def judged(self, rule, runs, far):
        distance = lambda a, b, where=None: far if a.get("/bending") != b.get("/bending") else 0.02
        with mock.patch.multiple(rules, at_rest=distance, in_first_second=distance,
                                 _outside_zone=lambda run: None):
            return rule(runs)

    def lod(self, status=lambda run: "complete", springs={"full": 100, 0: 40, 5: 83}):
        count = lambda run: springs[run.get("/bending/lod/t", "full")]
        return made_up(maps.LOD_CONFIGS, lambda run: {"springs": count(run)}, status)

    def n(self, stretch=lambda run: 1.5, status=lambda run: "complete"):
        return made_up(maps.N_CONFIGS, lambda run: {"max_stretch": stretch(run)}, status)

    def test_lod_levels_look_the_same_if_they_differ_no_more_than_two_seeds(self):
        for far, holds in ((0.024, True), (0.026, False)):
            claim = self.judged(rules.lod_looks_the_same, self.lod(), far)
            self.assertIs(claim.holds, holds)
            self.assertEqual(len(claim.cells), 6)

    def test_only_a_lod_level_with_about_a_fifth_fewer_springs_counts(self):
        claim = self.judged(rules.lod_looks_the_same, self.lod(springs={"full": 100, 0: 40, 5: 50}), 0)
        self.assertEqual(claim.cells, {})

    def test_a_missing_or_diverged_lod_level_is_reported(self):
        for status, text in (("missing", "not run"), ("diverged", "diverged")):
            runs = self.lod(only(lambda run: run.get("/bending/lod/t") == 5, status))
            for run in runs:
                run.summary = {} if run.status != "complete" else run.summary
            claim = self.judged(rules.lod_looks_the_same, runs, 0)
            self.assertEqual({box.text for box in claim.cells.values()}, {text})

    def test_a_missing_seed_leaves_the_distance_open(self):
        """The limit is the distance of two seeds, which is then not a number."""
        for rule, runs in ((rules.lod_looks_the_same, self.lod()), (rules.material_changes, self.n())):
            first_seed = [run for run in runs if run.get("/initial/seed") == 1]
            claim = self.judged(rule, first_seed, 0.5)
            self.assertEqual({(box.text, box.holds, box.open) for box in claim.cells.values()},
                             {("not measured", None, True)})

    def test_the_material_changes_if_runs_differ_more_than_two_seeds(self):
        for far, holds in ((0.041, True), (0.039, False)):
            self.assertIs(self.judged(rules.material_changes, self.n(), far).holds, holds)
        runs = self.n(status=only(lambda run: run.get("/initial/seed") == 2, "missing"))
        self.assertIsNone(self.judged(rules.material_changes, runs, 1).holds)

    def test_every_multiple_of_n_has_to_be_normal(self):
        multiple = lambda run: run.get("/bending/adaptive/n_multiplier")
        self.assertIs(rules.no_abnormal_deformation(self.n()).holds, True)
        claim = rules.no_abnormal_deformation(self.n(lambda run: 2.5 if multiple(run) == 2 else 1.1))
        self.assertEqual({box.text for box in claim.cells.values()}, {"1.5"})
        self.assertIs(claim.holds, False)
        claim = rules.no_abnormal_deformation(self.n(status=only(lambda run: multiple(run) == 2, "missing")))
        self.assertEqual((claim.holds, claim.open), (None, 6))


class Open(unittest.TestCase):
    def test_without_runs_every_claim_is_open(self):
        section = Section("maps", "")
        with tempfile.TemporaryDirectory() as empty:
            maps.main(Path(empty), Path(empty), section)
        self.assertEqual(len(section.maps), 9)
        for claim in section.maps:
            self.assertIsNone(claim.holds, claim.english)
            self.assertEqual(claim.sentence, "open: not run")
            self.assertEqual({box.text for box in claim.cells.values()}, {"not run"})
            self.assertEqual(claim.open, len(claim.cells))

    def test_a_missing_run_opens_its_row(self):
        missing = only(lambda run: n_of(run) == 32 and run.get("/effects/1/coefficient") == 1, "missing")
        claim = rules.equal_drop(sheets(lambda run: 1, missing)[1])
        self.assertEqual(claim.open, len(claim.cells))
        self.assertEqual({box.text for place, box in claim.cells.items() if place.cells == 16}, {"1.000"})

    def test_a_cell_with_a_diverged_run_fails_and_states_it(self):
        for status, holds, text in (("diverged", False, "diverged"), ("interrupted", None, "not run")):
            claim = rules.normal_cloth(sheets(lambda run: 0, only(lambda run: n_of(run) == 32, status))[1])
            self.assertEqual({(box.text, box.holds) for place, box in claim.cells.items()
                              if place.cells == 32}, {(text, holds)})
        row = rules.equal_drop(sheets(lambda run: 1, only(lambda run: n_of(run) == 32, "diverged"))[1])
        self.assertIs(row.holds, False)

    def test_a_cell_with_an_infinite_value_has_no_verdict(self):
        for value in (np.nan, np.inf):
            claim = rules.wrong_at_the_pin(sheets(lambda run: value)[0])
            self.assertEqual({(box.text, box.holds) for box in claim.cells.values()},
                             {("not measured", None)})


class Seeds(unittest.TestCase):
    FULL = [*maps.PIN_CONFIGS[:4], "paper/map_full"]

    def test_a_row_with_a_finer_mesh_compares_only_seed_1(self):
        """Seeds 2 to 5 have huge values, but exist only up to 64 cells: they must not make the row fail."""
        value = lambda run: n_of(run) if run.get("/initial/seed") == 1 else 1000
        claim = rules.fails_with_resolution(sheets(value, configs=self.FULL)[0])
        place = Place("", "no damping", "1 × 10", "the corner alone", 64)
        for n in (16, 32, 64):
            self.assertEqual((claim.cells[place.at(n)].text, claim.cells[place.at(n)].seeds),
                             (f"{n} (seed 1)", (1,)))
        self.assertEqual(claim.cells[place.at(128)].text, "128")
        self.assertIs(claim.cells[place].holds, True)

    def test_a_row_without_a_finer_mesh_compares_all_seeds(self):
        groups = sheets(lambda run: n_of(run) + run.get("/initial/seed"))[0]
        finest = Place("", "no damping", "1 × 10", "the corner alone", 64)
        verdict = rules.fails_with_resolution(groups).cells[finest]
        self.assertEqual((verdict.text, verdict.seeds), ("67", (1, 2, 3, 4, 5)))

    def test_all_rows_have_the_same_meshes(self):
        for configs, meshes in ((self.FULL, (16, 32, 64, 128)), (self.FULL[:4], (16, 32, 64)),
                                ([*self.FULL, "paper/map_256_full"], (16, 32, 64, 128))):
            claim_rows = rows(sheets(n_of, configs=configs)[0], rules.SHEETS)
            self.assertEqual({tuple(place.cells for place in row) for row in claim_rows}, {meshes})

    def test_groups_keep_only_common_seeds(self):
        runs = made_up(["paper/map_n"], lambda run: {})
        two_seeds, one_seed = runs[:2], runs[2:3]
        self.assertEqual(same_seeds([two_seeds, one_seed]), [two_seeds[:1], one_seed])


class Commands(unittest.TestCase):
    def test_the_commands_of_a_cell_repeat_its_runs(self):
        """In every map. The mock records the runs for which a command is requested."""
        requests = []
        number = lambda runs: requests.append(runs) or [str(len(requests))]
        section = Section("maps", "")
        with tempfile.TemporaryDirectory() as empty, \
                mock.patch("figures.paper.map_cells.commands", number):
            maps.main(Path(empty), Path(empty), section)
        for claim in section.maps:
            for verdict in list(claim.cells.values())[::7]:
                runs = requests[int(verdict.command) - 1]
                lines = commands(runs)
                self.assertEqual(planned_by(lines), points_of(runs))
                self.assertEqual(len(lines), len({run.experiment for run in runs}))


class Numbers(unittest.TestCase):
    def test_a_median_needs_every_run(self):
        runs = made_up(["paper/map_n"], lambda run: {"drop": run.get("/initial/seed")})[:2]
        self.assertEqual(median(runs, "drop"), 1.5)
        runs[1].summary = {}
        self.assertTrue(cell(lambda runs: (str(median(runs, "drop")), True), runs).open)


if __name__ == "__main__":
    unittest.main()
