"""The verdict maps: the sentence that cells give, the place of a run, and the table of a page."""
import sys
import unittest
from pathlib import Path
from types import SimpleNamespace

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "analysis"))

import claim_map  # noqa: E402
from claim_map import Cell, ClaimMap, Place  # noqa: E402
from html_parts import map_html  # noqa: E402


def grid(holds):
    """A whole map of two dampings, four solvers, three kinds of pins and three N; `holds`: Place → bool."""
    claim = ClaimMap("5b", "옷감", "Cloth <is> sound.", "it is", "stretch − 1")
    for damping in claim_map.DAMPINGS.values():
        for solver in claim_map.SOLVERS.values():
            for pins in claim_map.PINS:
                for cells in (16, 32, 64):
                    place = Place("rounded", damping, solver, pins, cells)
                    claim.cells[place] = Cell("0.5", holds(place), f"run {cells}")
    return claim


class Sentence(unittest.TestCase):
    def test_all_none_and_nothing(self):
        self.assertEqual(grid(lambda _: True).sentence, "holds in every cell")
        self.assertEqual(grid(lambda _: False).sentence, "does not hold in any cell")
        self.assertEqual(ClaimMap("", "", "", "", "").sentence, "not measured")

    def test_one_question_decides(self):
        sentence = grid(lambda place: place.damping == "viscous").sentence
        self.assertEqual(sentence, "holds where damping is viscous (36 cells); 36 of 72 cells in all")

    def test_two_questions_decide(self):
        good = ("16 × 10", "256 × 1")
        sentence = grid(lambda place: place.solver in good and place.pins != "alone").sentence
        self.assertIn("where substeps × iterations are 16 × 10 or 256 × 1 and what is pinned is its 1-ring "
                      "or a patch of 5 cm (24 cells)", sentence)
        self.assertIn("24 of 72 cells in all", sentence)

    def test_what_lies_beside_is_counted(self):
        odd = Place("rounded", "none", "1 × 10", "alone", 16)
        sentence = grid(lambda place: place.damping == "viscous" or place == odd).sentence
        self.assertIn("(36 cells); and in 1 of the others; 37 of 72", sentence)

    def test_a_chequerboard_has_no_region(self):
        orders = [list(claim_map.DAMPINGS.values()), list(claim_map.SOLVERS.values()), list(claim_map.PINS),
                  [16, 32, 64]]
        odd = lambda place: sum(order.index(answer) for order, answer in zip(
            orders, (place.damping, place.solver, place.pins, place.cells))) % 2
        self.assertEqual(grid(odd).sentence, "holds in 36 of 72 cells, for no answer to one or two of the "
                         "open questions")

    def test_a_region_never_holds_a_cell_that_fails(self):
        for seed in range(40):
            claim = grid(lambda place: (7 * place.cells + 3 * len(place.solver) + len(place.pins) + seed)
                         % 5 > 1)
            found = claim_map.region(claim.cells)
            if found:
                self.assertLessEqual(found[1], sum(cell.holds for cell in claim.cells.values()))


class PlaceOfARun(unittest.TestCase):
    def run_with(self, **changes):
        config = {"/solver/substeps": 4, "/solver/iterations": 10, "/pins/ring": 1, "/pins/distance": 0.0,
                  "/effects/1/coefficient": 1.0, "/bending/adaptive/m_rounding": "floor",
                  "/mesh/cells": 32, **changes}
        return SimpleNamespace(model="adaptive",
                               get=lambda pointer, default=None: config.get(pointer, default),
                               point={"/mesh/cells": 32, "/pins": claim_map.PINS["its 1-ring"],
                                      "/bending/adaptive/m_rounding": "floor"})

    def test_it_answers_each_question(self):
        self.assertEqual(claim_map.place_of(self.run_with()),
                         Place("rounded down", "viscous", "4 × 10", "its 1-ring", 32))
        self.assertEqual(claim_map.place_of(self.run_with(**{"/pins/ring": 0, "/pins/distance": 0.05})).pins,
                         "a patch of 5 cm")

    def test_other_settings_have_no_place(self):
        self.assertIsNone(claim_map.place_of(self.run_with(**{"/solver/substeps": 3})))

    def test_its_command_names_what_varies(self):
        command = claim_map.command("paper/map", self.run_with())
        self.assertTrue(command.startswith("./bendlab run configs/paper/map.json --set '/pins="))
        self.assertIn("--set '/mesh/cells=32'", command)
        self.assertIn("--set '/bending/adaptive/m_rounding=floor'", command)


class Table(unittest.TestCase):
    def test_every_cell_has_its_number_its_colour_and_its_command(self):
        page = map_html(grid(lambda place: place.cells == 16))
        self.assertEqual(page.count("class='holds"), 24)
        self.assertEqual(page.count("class='fails"), 48)
        self.assertEqual(page.count("title='run 16'"), 24)
        self.assertIn("Cloth &lt;is&gt; sound.", page)
        self.assertIn("lang='ko'", page)

    def test_a_missing_cell_is_a_dash(self):
        claim = grid(lambda _: True)
        claim.cells.pop(Place("rounded", "none", "1 × 10", "alone", 16))
        self.assertEqual(map_html(claim).count(">–</td>"), 1)


if __name__ == "__main__":
    unittest.main()
