"""A page of one's own beside the committed one, on made-up pages whose differences are known."""
import json
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ANALYSIS = Path(__file__).resolve().parents[2] / "analysis"
sys.path.insert(0, str(ANALYSIS))

import committed  # noqa: E402
import fig_6  # noqa: E402
import fig_map  # noqa: E402
import page as paper_page  # noqa: E402
import project_pages  # noqa: E402
from claim_map import Cell, ClaimMap, Place  # noqa: E402
from report import Check, Claim, Section, bits_of, write_objects  # noqa: E402
from sweeps import missing_run  # noqa: E402


def claim(name, holds, **numbers):
    return Claim("1", name, "a rule", numbers, holds)


def check(name, measured):
    return Check(name, "a model", "a mesh", 1.0, measured, 0.1, "theory")


def write(folder, claims=(), checks=(), maps=(), bits=None, objects=()):
    folder.mkdir(parents=True, exist_ok=True)
    section = Section("a", "1", claims=list(claims), checks=list(checks), maps=list(maps), bits=bits or {})
    project_pages.keep(folder, [section])
    write_objects(folder / "summary.json", objects)


class Compared(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.theirs, self.mine = Path(self.folder.name) / "theirs", Path(self.folder.name) / "mine"

    def compared(self):
        return committed.compared(self.theirs, self.mine)

    def test_a_page_agrees_with_itself(self):
        for folder in (self.theirs, self.mine):
            write(folder, [claim("it is", True, one=1.5, two=[2, 3])], [check("a length", 1.05)],
                  bits={"a/b": {"x": "1"}})
        found = self.compared()
        self.assertEqual((found.same_verdicts, found.verdicts, found.exact, found.numbers), (2, [], 4, []))
        self.assertEqual((found.same_bits, found.other_bits, found.runs_not_made), (1, 0, 0))

    def test_verdicts_and_numbers_that_differ_are_told(self):
        write(self.theirs, [claim("it is", True, one=1.0, two=100.0, three=7.0)], [check("a length", 1.05)],
              bits={"a/b": {"x": "1", "y": "2", "z": "3"}})
        write(self.mine, [claim("it is", False, one=1.0008, two=50.0, three=7.0)], [check("a length", 1.2)],
              bits={"a/b": {"x": "1", "y": "9"}})
        found = self.compared()
        self.assertEqual(found.verdicts, [("it is", "holds", "does not hold"),
                                          ("a length, a model, a mesh", "holds", "does not hold")])
        self.assertEqual((found.exact, found.rounded), (1, 1))  # three; one, 0.08 % apart
        self.assertEqual(found.numbers, [("it is: two", 100.0, 50.0),
                                         ("a length, a model, a mesh: measured", 1.05, 1.2)])
        self.assertEqual((found.same_bits, found.other_bits, found.runs_not_made), (1, 1, 1))
        told = committed.text(found)
        self.assertIn("holds → does not hold: it is", told)
        self.assertIn("100 → 50: it is: two", told)

    def test_what_was_not_run_is_open_and_not_another_verdict(self):
        write(self.theirs, [claim("it is", True), claim("it was", False)])
        write(self.mine, [claim("it is", None)])
        found = self.compared()
        self.assertEqual(found.not_made, 2)
        self.assertEqual(committed.summary_rows(found)[0], ("verdicts", 0, 0, 2))
        self.assertIn("holds → open: it is", committed.text(found))

    def test_times_are_of_the_machine(self):
        write(self.theirs, [claim("it is fast", True, **{"CPU ms per frame": 1.0})])
        write(self.mine, [claim("it is fast", True, **{"CPU ms per frame": 9.0})])
        self.assertEqual(self.compared().numbers, [])

    def test_an_older_page_keeps_fewer_digits(self):
        write(self.theirs, [claim("it is", True, one=0.001551, two=2.0)])
        write(self.mine, [claim("it is", True, one=0.00155149, two=2.001)])
        self.assertEqual((self.compared().exact, self.compared().rounded), (1, 1))

    def test_cells_of_maps_and_objects_of_runs_count(self):
        place = Place("", "no damping", "1 × 10", "the corner alone", 16)
        for folder, holds, verdict in ((self.theirs, True, "green"), (self.mine, False, "red")):
            write(folder, maps=[ClaimMap("1", "", "it is", "", "", {place: Cell("0.5", holds)})],
                  objects=[{"case": "a", "model": "none", "precision": "single", "verdict": verdict,
                            "worst": {"what": "energy", "value": 2.0}}])
        self.assertEqual([(theirs, mine) for _, theirs, mine in self.compared().verdicts],
                         [("green", "red"), ("holds", "does not hold")])

    def test_without_a_page_nothing_is_compared(self):
        self.assertIsNone(self.compared())


class Own(unittest.TestCase):
    def test_a_script_writes_the_committed_page_only_if_told(self):
        self.assertEqual(committed.home("paper", False), Path("results/own/paper"))
        self.assertEqual(committed.home("paper", True), Path("results/paper"))
        ignored = subprocess.run(["git", "-C", ANALYSIS.parent, "check-ignore", "-q",
                                  "results/own/paper/index.html"], check=False)
        self.assertIn(ignored.returncode, (0, 128))  # 128: no checkout

    def test_a_page_of_ones_own_links_to_what_is_there_and_to_the_committed_one(self):
        with tempfile.TemporaryDirectory() as name:
            own = Path(name) / "own/paper"
            paper_page.draw(Path(name) / "none", own, "everything")
            paper_page.lay_out(own)
            text = (own / "index.html").read_text(encoding="utf-8")
            self.assertIn("href='../../paper/index.html'", text)
            self.assertIn("id='committed'", text)
            self.assertNotIn("../stiffness/index.html", text)
            again = json.loads((own / "summary.json").read_text(encoding="utf-8"))
            self.assertEqual({entry["holds"] for entry in again}, {None})  # without runs every claim is open

    def test_a_python_without_the_libraries_hands_over(self):
        for script in sorted(ANALYSIS.glob("*.py")):
            if script.name.startswith("fig_") and "__main__" in script.read_text(encoding="utf-8"):
                self.assertIn("\nimport right_python", script.read_text(encoding="utf-8"), script)
        told = subprocess.run([sys.executable, "-S", ANALYSIS / "stiffness_page.py", "--help"],
                              capture_output=True, text=True, check=False)
        self.assertEqual(told.returncode, 0, told.stderr)


class Open(unittest.TestCase):
    """What the runs of --full would decide is open without them."""

    def test_a_map_that_lacks_cells_of_full_decides_nothing(self):
        place = Place("", "", "1 × 10", "the corner alone", 16)
        for holds, word in ((True, "holds"), (False, "fails")):
            claim = ClaimMap("1", "", "", "", "", {place: Cell("1", holds)}, left_out=True)
            self.assertIsNone(claim.holds)
            self.assertEqual(claim.sentence, f"open: {word} in all 1 cells whose runs are there; those of "
                                             "--full are not run")
            claim.left_out = False
            self.assertIs(claim.holds, holds)

    def test_a_map_with_both_verdicts_stays(self):
        cells = {Place("", "", "1 × 10", "the corner alone", n): Cell("1", n > 16) for n in (16, 32)}
        self.assertEqual(ClaimMap("1", "", "", "", "", cells, left_out=True).holds, 0.5)

    def test_without_runs_the_configs_of_full_are_left_out(self):
        with tempfile.TemporaryDirectory() as name:
            section = fig_map.main(Path(name), Path(name))
        self.assertTrue(all(each.left_out for each in section.maps))

    def test_fewer_springs_at_no_n_that_was_run_leaves_the_claim_open(self):
        class Case:
            def __init__(self, n, fewer):
                self.n, self.fewer, self.name, self.lod = n, {2: fewer}, f"N = {n}", {}
                self.full = [run_with(pin_max_stretch=1.5)]
                self.yardstick = [fig_6.summary_spread(self.full, "pin_max_stretch")] * 2
                self.distance = {2: self.yardstick}

            def nearest_to_claim(self):
                return 2

        verdict = lambda *cases: fig_6._claims({(case.n, 0): case for case in cases})[0].holds
        self.assertIsNone(verdict(Case(64, 0.34)))  # N = 128 was not run
        self.assertIs(verdict(Case(64, 0.34), Case(128, 0.24)), True)
        self.assertIs(verdict(Case(64, 0.34), Case(128, 0.40)), False)
        self.assertIs(verdict(Case(64, 0.2)), True)

    def test_bits_are_those_of_the_numbers_without_times(self):
        one, same = run_with(drop=1.0, cpu_s=1), run_with(drop=1.0, cpu_s=2)
        other = run_with(drop=1.0 + 1e-15)
        self.assertEqual(bits_of(one), bits_of(same))
        self.assertNotEqual(bits_of(one), bits_of(other))


def run_with(**summary):
    run = missing_run("paper/fig1", {})
    run.summary, run.status = summary, "complete"
    return run


if __name__ == "__main__":
    unittest.main()
