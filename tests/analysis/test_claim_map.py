"""Tests of the verdict maps: the sentence about the cells, the place of a run, and the table of a page."""
import random
import re
import sys
import unittest
from pathlib import Path
from types import SimpleNamespace

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "analysis"))

from tables import claim_map  # noqa: E402
from tables.claim_map import Cell, ClaimMap, Place  # noqa: E402
from web.verdicts import map_cells, map_html, map_mark  # noqa: E402


def grid(holds):
    """A map of two dampings, four solvers, three kinds of pins and three N. `holds`: Place → bool or None."""
    claim = ClaimMap("5b", "옷감", "Cloth <is> sound.", "it is", "stretch − 1")
    for damping in claim_map.DAMPINGS.values():
        for solver in claim_map.SOLVERS.values():
            for pins in claim_map.PINS:
                for cells in (16, 32, 64):
                    place = Place("rounded", damping, solver, pins, cells)
                    verdict = holds(place)
                    claim.cells[place] = Cell("0.5", None if verdict is None else bool(verdict),
                                              f"run {cells}", (1, 2))
    return claim


class Sentence(unittest.TestCase):
    def test_a_map_with_one_verdict_and_a_map_without_cells(self):
        self.assertEqual(grid(lambda _: True).sentence, "holds in every box")
        self.assertEqual(grid(lambda _: False).sentence, "does not hold in any box")
        self.assertEqual(ClaimMap("", "", "", "", "").sentence, "open: not run")

    def test_the_sentence_if_one_question_decides(self):
        sentence = grid(lambda place: place.damping == "viscous drag").sentence
        self.assertEqual(sentence, "holds in 36 of 72 boxes: exactly where there is viscous drag; in "
                         "9 of the 18 boxes with 1 × 10 substeps × iterations")

    def test_the_sentence_if_two_questions_decide(self):
        good = ("4 × 10", "16 × 10")
        sentence = grid(lambda place: place.solver in good and place.pins != "the corner alone").sentence
        self.assertEqual(sentence, "holds in 24 of 72 boxes: exactly where substeps × iterations are 4 × 10 "
                         "or 16 × 10 and what is pinned is the corner and its 1-ring or a patch of 5 cm; in "
                         "0 of the 18 boxes with 1 × 10 substeps × iterations")

    def test_cells_outside_the_region_are_counted(self):
        odd = Place("rounded", "no damping", "1 × 10", "the corner alone", 16)
        sentence = grid(lambda place: place.damping == "viscous drag" or place == odd).sentence
        self.assertEqual(sentence, "holds in 37 of 72 boxes: wherever there is viscous drag (36 boxes), and "
                         "in 1 more; in 10 of the 18 boxes with 1 × 10 substeps × iterations")

    def test_a_claim_is_open_if_open_cells_could_refute_it(self):
        odd = Place("rounded", "no damping", "1 × 10", "the corner alone", 16)
        for verdict, word in ((True, "holds"), (False, "fails")):
            claim = grid(lambda _: verdict)
            claim.cells[odd] = Cell("not run", None, open=True)
            self.assertIsNone(claim.holds)
            self.assertEqual(claim.sentence, f"open: {word} in all 71 boxes that have runs; 1 box is "
                             "open, because runs are missing")
            self.assertEqual(map_mark(claim), ("open", "open"))

    def test_cells_without_a_verdict_do_not_refute_a_claim(self):
        odd = Place("rounded", "no damping", "1 × 10", "the corner alone", 16)
        claim = grid(lambda place: None if place == odd else True)
        self.assertIs(claim.holds, True)
        self.assertEqual(claim.sentence, "holds in every box; 1 box has no verdict")

    def test_a_chequerboard_has_no_region(self):
        orders = [list(claim_map.DAMPINGS.values()), list(claim_map.SOLVERS.values()), list(claim_map.PINS),
                  [16, 32, 64]]
        odd = lambda place: sum(order.index(answer) for order, answer in zip(
            orders, (place.damping, place.solver, place.pins, place.cells))) % 2
        self.assertEqual(grid(odd).sentence, "holds in 36 of 72 boxes, without a simple pattern; "
                         "in 9 of the 18 boxes with 1 × 10 substeps × iterations")

    def test_a_region_never_has_a_cell_that_fails_or_is_open(self):
        chance, regions = random.Random(1), 0
        for seed in range(40):
            good = {name: chance.choice(list(values)) for name, values in
                    (("solver", claim_map.SOLVERS.values()), ("pins", claim_map.PINS))}
            claim = grid(lambda place: any(getattr(place, name) == value for name, value in good.items())
                         or chance.random() < 0.3)
            if seed % 2:
                claim.cells[chance.choice(list(claim.cells))] = Cell("not run", None, open=True)
            region = claim_map.region(claim.cells)
            if region:
                regions += 1
                self.assertEqual({claim.cells[place].holds for place in region[1]}, {True})
        self.assertGreater(regions, 30)


class PlaceOfARun(unittest.TestCase):
    def run_with(self, **changes):
        config = {"/solver/substeps": 4, "/solver/iterations": 10, "/pins/ring": 1, "/pins/distance": 0.0,
                  "/effects/1/coefficient": 1.0, "/bending/adaptive/m_rounding": "floor",
                  "/mesh/cells": 32, **changes}
        return SimpleNamespace(model="adaptive",
                               get=lambda pointer, default=None: config.get(pointer, default))

    def test_a_place_has_an_answer_to_each_question(self):
        self.assertEqual(claim_map.place_of(self.run_with()),
                         Place("rounded down", "viscous drag", "4 × 10", "the corner and its 1-ring", 32))
        self.assertEqual(claim_map.place_of(self.run_with(**{"/pins/ring": 0, "/pins/distance": 0.05})).pins,
                         "a patch of 5 cm")

    def test_a_run_with_other_settings_has_no_place(self):
        self.assertIsNone(claim_map.place_of(self.run_with(**{"/solver/substeps": 3})))


class Table(unittest.TestCase):
    def test_every_cell_has_its_value_its_colour_and_its_command(self):
        claim = grid(lambda place: place.cells == 16)
        page = map_html(claim, "map-1")
        self.assertEqual(page.count("class='holds"), 24)
        self.assertEqual(page.count("class='fails"), 48)
        commands = {cell["id"]: cell["command"] for cell in map_cells(claim, "map-1")}
        self.assertEqual(list(commands.values()).count("run 16"), 24)
        self.assertEqual(set(re.findall("data-run='([^']+)'", page)), set(commands))
        self.assertIn("“Cloth &lt;is&gt; sound.”", page)
        self.assertIn("lang='ko'", page)

    def test_the_panel_of_a_cell_has_its_seeds_and_all_commands(self):
        claim = ClaimMap("5", "", "Ours is sound.", "it is", "stretch − 1")
        claim.cells[Place("", "no damping", "1 × 10", "a patch of 5 cm", 16)] = Cell(
            "0.5", True, "run a\nrun b", (1, 2))
        cell, = map_cells(claim, "map-1")
        self.assertEqual((cell["outcome"], cell["command"], cell["status"]),
                         ("seeds 1, 2", "run a\nrun b", "holds"))
        self.assertNotIn("“", map_html(claim, "map-1"))  # not a quotation

    def test_a_cell_without_a_verdict_is_grey(self):
        page = map_html(grid(lambda place: None if place.cells == 16 else True), "map-1")
        self.assertEqual(page.count("<td class='none first'"), 24)

    def test_a_missing_cell_is_a_dash(self):
        claim = grid(lambda _: True)
        claim.cells.pop(Place("rounded", "no damping", "1 × 10", "the corner alone", 16))
        self.assertEqual(map_html(claim, "map-1").count(">–</td>"), 1)


if __name__ == "__main__":
    unittest.main()
