"""Tests of the comparison of a user's page with the committed page, on pages with known differences."""
import json
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ANALYSIS = Path(__file__).resolve().parents[2] / "analysis"
sys.path.insert(0, str(ANALYSIS))

from figures.paper import fig_6, maps  # noqa: E402
from pages import paper, project  # noqa: E402
from runs.sweeps import missing_run  # noqa: E402
from tables import committed  # noqa: E402
from tables.claim_map import Cell, ClaimMap, Place  # noqa: E402
from tables.section import Check, Claim, Section, bits_of, write_objects  # noqa: E402


def claim(name, holds, **numbers):
    return Claim("1", name, "a rule", numbers, holds)


def check(name, measured):
    return Check(name, "a model", "a mesh", 1.0, measured, 0.1, "theory")


def write(folder, claims=(), checks=(), maps=(), bits=None, objects=()):
    folder.mkdir(parents=True, exist_ok=True)
    section = Section("a", "1", claims=list(claims), checks=list(checks), maps=list(maps), bits=bits or {})
    write_objects(folder / project.KEPT, [section.as_json()])
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
        result = self.compared()
        self.assertEqual((result.same_verdicts, result.verdicts, result.exact, result.numbers),
                         (2, [], 4, []))
        self.assertEqual((result.same_bits, result.other_bits, result.runs_not_made), (1, 0, 0))

    def test_different_verdicts_and_numbers_are_listed(self):
        write(self.theirs, [claim("it is", True, one=1.0, two=100.0, three=7.0)], [check("a length", 1.05)],
              bits={"a/b": {"x": "1", "y": "2", "z": "3"}})
        write(self.mine, [claim("it is", False, one=1.0008, two=50.0, three=7.0)], [check("a length", 1.2)],
              bits={"a/b": {"x": "1", "y": "9"}})
        result = self.compared()
        self.assertEqual(result.verdicts, [("it is", "holds", "does not hold"),
                                           ("a length, a model, a mesh", "holds", "does not hold")])
        # "three" is exact; "one" differs by 0.08 %.
        self.assertEqual((result.exact, result.rounded), (1, 1))
        self.assertEqual(result.numbers, [("it is: two", 100.0, 50.0),
                                          ("a length, a model, a mesh: measured", 1.05, 1.2)])
        self.assertEqual((result.same_bits, result.other_bits, result.runs_not_made), (1, 1, 1))
        text = committed.text(result)
        self.assertIn("holds → does not hold: it is", text)
        self.assertIn("100 → 50: it is: two", text)

    def test_a_claim_without_runs_is_open_and_not_a_different_verdict(self):
        write(self.theirs, [claim("it is", True), claim("it was", False)])
        write(self.mine, [claim("it is", None)])
        result = self.compared()
        self.assertEqual(result.not_made, 2)
        self.assertEqual(committed.summary_rows(result)[0], ("verdicts", 0, 0, 2))
        self.assertIn("holds → open: it is", committed.text(result))

    def test_times_are_not_compared(self):
        write(self.theirs, [claim("it is fast", True, **{"CPU ms per frame": 1.0})])
        write(self.mine, [claim("it is fast", True, **{"CPU ms per frame": 9.0})])
        self.assertEqual(self.compared().numbers, [])

    def test_numbers_are_compared_with_the_digits_of_an_older_page(self):
        write(self.theirs, [claim("it is", True, one=0.001551, two=2.0)])
        write(self.mine, [claim("it is", True, one=0.00155149, two=2.001)])
        self.assertEqual((self.compared().exact, self.compared().rounded), (1, 1))

    def test_cells_of_maps_and_objects_of_runs_are_compared(self):
        place = Place("", "no damping", "1 × 10", "the corner alone", 16)
        for folder, holds, verdict in ((self.theirs, True, "green"), (self.mine, False, "red")):
            write(folder, maps=[ClaimMap("1", "", "it is", "", "", {place: Cell("0.5", holds)})],
                  objects=[{"case": "a", "model": "none", "precision": "single", "verdict": verdict,
                            "worst": {"what": "energy", "value": 2.0}}])
        self.assertEqual([(theirs, mine) for _, theirs, mine in self.compared().verdicts],
                         [("green", "red"), ("holds", "does not hold")])

    def test_two_verdicts_with_one_name_are_an_error(self):
        write(self.theirs, checks=[check("a length", 1.0), check("a length", 2.0)])
        with self.assertRaisesRegex(ValueError, "two verdicts with the name 'a length, a model, a mesh'"):
            committed.rows_of(self.theirs)

    def test_without_committed_page_there_is_no_comparison(self):
        self.assertIsNone(self.compared())


class Own(unittest.TestCase):
    def test_a_script_writes_the_committed_page_only_on_request(self):
        self.assertEqual(committed.home("paper", False), Path("results/own/paper"))
        self.assertEqual(committed.home("paper", True), Path("results/paper"))
        ignored = subprocess.run(["git", "-C", ANALYSIS.parent, "check-ignore", "-q",
                                  "results/own/paper/index.html"], check=False)
        self.assertIn(ignored.returncode, (0, 128))  # 128: no checkout

    def test_a_users_page_links_to_existing_pages_and_to_the_committed_page(self):
        with tempfile.TemporaryDirectory() as name:
            own = Path(name) / "own/paper"
            project.draw(paper.PAGE, Path(name) / "none", own)
            project.lay_out(paper.PAGE, own)
            text = (own / "index.html").read_text(encoding="utf-8")
            self.assertIn("href='../../paper/index.html'", text)
            self.assertIn("id='committed'", text)
            self.assertNotIn("../stiffness/index.html", text)
            again = json.loads((own / "summary.json").read_text(encoding="utf-8"))
            self.assertEqual({entry["holds"] for entry in again}, {None})  # without runs every claim is open

    def test_a_python_without_the_libraries_starts_the_right_python(self):
        folders = "|".join(sorted(path.name for path in ANALYSIS.iterdir() if path.is_dir()))
        commands = [script for script in sorted(ANALYSIS.rglob("*.py"))
                    if "__main__" in (text := script.read_text(encoding="utf-8"))
                    and re.search(rf"^from ({folders})\b", text, re.MULTILINE)]
        self.assertIn(ANALYSIS / "page.py", commands)
        for script in commands:
            first = re.search(r"^(import|from) .*", script.read_text(encoding="utf-8"), re.MULTILINE)
            self.assertTrue(first[0].startswith("import right_python"), script)
        done = subprocess.run([sys.executable, "-S", ANALYSIS / "page.py", "--help"],
                              capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)


class Open(unittest.TestCase):
    """Claims that need runs of --full are open without these runs."""

    def test_a_map_without_the_cells_of_full_has_no_verdict(self):
        place = Place("", "", "1 × 10", "the corner alone", 16)
        for holds, word in ((True, "holds"), (False, "fails")):
            claim = ClaimMap("1", "", "", "", "", {place: Cell("1", holds)}, left_out=True)
            self.assertIsNone(claim.holds)
            self.assertEqual(claim.sentence, f"open: {word} in all 1 boxes that have runs; the boxes of "
                                             "--full are not computed")
            claim.left_out = False
            self.assertIs(claim.holds, holds)

    def test_a_map_with_both_verdicts_keeps_its_share(self):
        cells = {Place("", "", "1 × 10", "the corner alone", n): Cell("1", n > 16) for n in (16, 32)}
        self.assertEqual(ClaimMap("1", "", "", "", "", cells, left_out=True).holds, 0.5)

    def test_without_runs_the_configs_of_full_are_left_out(self):
        with tempfile.TemporaryDirectory() as name:
            section = Section("maps", "Maps")
            maps.main(Path(name), Path(name), section)
        self.assertTrue(section.maps)
        self.assertTrue(all(claim_map.left_out for claim_map in section.maps))

    def test_the_claim_on_fewer_springs_is_open_if_the_decisive_n_is_missing(self):
        class Case:
            def __init__(self, n, fewer):
                self.n, self.fewer, self.name, self.lod = n, {2: fewer}, f"N = {n}", {}
                self.full = [run_with(pin_max_stretch=1.5)]
                self.yardstick = [fig_6.summary_spread(self.full, "pin_max_stretch")] * 2
                self.distance = {2: self.yardstick}

            def nearest_to_claim(self):
                return 2

        verdict = lambda *cases: fig_6._claims(cases)[0].holds
        self.assertIsNone(verdict(Case(64, 0.34)))  # N = 128 was not run
        self.assertIs(verdict(Case(64, 0.34), Case(128, 0.24)), True)
        self.assertIs(verdict(Case(64, 0.34), Case(128, 0.40)), False)
        self.assertIs(verdict(Case(64, 0.2)), True)

    def test_the_bits_of_a_run_do_not_depend_on_times(self):
        run, same = run_with(drop=1.0, cpu_s=1), run_with(drop=1.0, cpu_s=2)
        different = run_with(drop=1.0 + 1e-15)
        self.assertEqual(bits_of(run), bits_of(same))
        self.assertNotEqual(bits_of(run), bits_of(different))


def run_with(**summary):
    run = missing_run("paper/fig1", {})
    run.summary, run.status = summary, "complete"
    return run


if __name__ == "__main__":
    unittest.main()
