"""Tests of the READMEs: every measured number has a marker (stated_numbers.py) and agrees with its data;
links work; lines are short, in code as well.

    python3 tests/analysis/test_stated_numbers.py             checks
    python3 tests/analysis/test_stated_numbers.py --update    writes the right numbers in place
"""
import re
import sys
import unittest
import unittest.mock
from pathlib import Path

from stated_numbers import MARKER, ROOT, Expression, Tables, rewritten, single, written

REQUIRED = ["README.md", "configs/README.md", "analysis/README.md", "experiments/README.md",
            "experiments/bench/README.md", "lib/bendlab/bending/README.md", "lib/bendlab/solver/README.md",
            "lib/bendlab/effects/README.md"]
MAIN_LINES, COLUMNS = 140, 110

LINK = re.compile(r"!?\[[^\]]*\]\(([^)\s]+)\)")
# What looks like a measurement: a number with one of these units.
WITH_UNIT = re.compile(r"(?P<number>\d[\d.]*)(?: to [\d.]+)? ?(?:ns|ms|%|MB|bytes|minutes|times)(?![\w-])")


def own(paths):
    """Those that are not packages of others."""
    return (path for path in paths if "node_modules" not in path.parts)


def readmes():
    """The READMEs of the checkout, without build folders."""
    return sorted(path for folder in (".", "configs", "analysis", "experiments", "lib", "tests", "results")
                  for path in own(ROOT.glob("README.md") if folder == "."
                                  else (ROOT / folder).rglob("README.md")))


def visible(text):
    """Lines as a reader sees them: without comments, code blocks as empty lines."""
    code = False
    for line in text.split("\n"):
        fence = line.lstrip().startswith("```")
        yield "" if code or fence else re.sub(r"<!--.*?-->", "", line)
        code ^= fence


def anchors(path):
    """GitHub's anchors of the headings of a file, or the ids of a page."""
    if path.suffix == ".html":
        return set(re.findall(r"\bid='([^']+)'", path.read_text(encoding="utf-8")))
    headings = re.findall(r"^#+ (.*)$", "\n".join(visible(path.read_text(encoding="utf-8"))), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def without_code(text):
    """(line number, line) outside code blocks; code spans are blanked, comments kept."""
    for at, (line, seen) in enumerate(zip(text.split("\n"), visible(text)), 1):
        if seen:
            yield at, re.sub(r"(?<!>)`[^`]*`", lambda span: "`" * len(span[0]), line)


def unmarked(text):
    """(line number, error) of numbers that look like a measurement and have no marker."""
    for at, line in without_code(text):
        blank = MARKER.sub(lambda marker: "\0" * len(marker[0]), line)
        yield from ((at, f"'{found[0]}' has no marker") for found in WITH_UNIT.finditer(blank)
                    if blank[found.start() - 1] != "\0")


def broken_paragraphs(text):
    """(line number, error) of lines that begin with a marker: Markdown ends the paragraph there."""
    return ((at, "a marker begins the line") for at, line in without_code(text)
            if re.match(r"\s*<!--.*-->\s*\S", line))


def broken_links(path, text):
    """(line number, error) of links within the checkout without a target."""
    for at, line in enumerate(visible(text), 1):
        for link in LINK.findall(line):
            file, _, anchor = link.partition("#")
            target = (path.parent / file).resolve() if file else path
            if not re.match(r"[a-z]+:",
                            link) and not (target.exists() and (not anchor or anchor in anchors(target))):
                yield at, f"{link} leads nowhere"


def long_lines(text):
    """(line number, error) of long lines; tables may be wider."""
    return ((at, f"{len(line)} columns") for at, line in enumerate(visible(text), 1) if len(line) > COLUMNS
            and not line.lstrip().startswith("|"))


class StatedNumbers(unittest.TestCase):
    def none_in_any(self, problems):
        """Asserts that problems(path, text) finds nothing in any README."""
        found = [f"{path.relative_to(ROOT)}:{at}: {what}" for path in readmes()
                 for at, what in problems(path, path.read_text(encoding="utf-8"))]
        self.assertFalse(found, "\n" + "\n".join(found))

    def test_that_every_number_is_the_one_of_its_data(self):
        wrong = [problem for path in readmes() for problem in rewritten(path)[1]]
        self.assertFalse(wrong,
                         "\n" + "\n".join(wrong) + "\npython3 tests/analysis/test_stated_numbers.py --update")

    def test_that_what_looks_like_a_measurement_has_a_marker(self):
        self.none_in_any(lambda path, text: unmarked(text))

    def test_that_no_marker_begins_a_line(self):
        self.none_in_any(lambda path, text: broken_paragraphs(text))

    def test_that_links_lead_somewhere(self):
        self.none_in_any(broken_links)

    def test_that_files_that_configs_name_are_there(self):
        named = re.compile(r"\b(?:lib|configs|analysis|experiments|tests)/[\w./-]+\.\w+")
        configs = sorted((ROOT / "configs").rglob("*.json"))
        absent = [f"{config.relative_to(ROOT)}: {file}" for config in configs
                  for file in named.findall(config.read_text(encoding="utf-8"))
                  if not (ROOT / file).exists()]
        self.assertFalse(absent, "\n" + "\n".join(absent))

    def test_that_lines_are_short(self):
        self.none_in_any(lambda path, text: long_lines(text))
        self.assertLessEqual(len((ROOT / "README.md").read_text(encoding="utf-8").splitlines()), MAIN_LINES)

    def test_that_lines_of_code_are_short(self):
        code = [path for folder in ("lib", "experiments", "tests", "analysis")
                for ending in ("hpp", "cpp", "def", "py", "cmake", "txt")
                for path in own((ROOT / folder).rglob(f"*.{ending}"))]
        long = [f"{path.relative_to(ROOT)}:{at}" for path in code
                for at, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1)
                if len(line) > COLUMNS]
        self.assertGreater(len(code), 400)
        self.assertFalse(long, "\n" + "\n".join(long))

    def test_that_each_room_has_a_readme_with_a_marker_or_link(self):
        for name in REQUIRED:
            with self.subTest(name):
                text = (ROOT / name).read_text(encoding="utf-8")
                self.assertTrue(MARKER.search(text) or LINK.search(text), "neither a marker nor a link")


class Language(unittest.TestCase):
    """The markers' language, on values known beforehand."""

    RUNS = [{"model": "a", "set": {"n": 1}, "ms": 2.0, "error": 0.5},
            {"model": "a", "set": {"n": 4}, "ms": 8.0, "error": 0.1},
            {"model": "b", "set": {"n": 4}, "ms": "3", "error": 0.2}]

    def value(self, text):
        return Expression(text, {"runs": self.RUNS, "first": self.RUNS[0]}).value

    def test_arithmetic(self):
        self.assertEqual(self.value("1 + 2 * 3 - 8 / (2 + 2)"), 5)
        self.assertIs(self.value("first/ms * 100 <= 200"), True)

    def test_places(self):
        self.assertEqual(self.value("runs/[model=b]/ms"), ["3"])
        self.assertEqual(self.value("count(runs/[set/n=4 & error<0.15])"), 1)
        self.assertEqual(self.value("count(runs/[error<=first/error])"), 3)
        self.assertEqual(self.value("runs/least:error/model"), "a")
        self.assertEqual(self.value("runs/[error<=0.2]/least:ms/model"), "b")
        self.assertEqual(self.value("max(runs/ms / runs/error)"), 80)
        self.assertEqual(self.value("min(runs/ms, 1)"), 1)

    def test_mistakes_are_errors(self):
        for text in ("runs/ms", "runs/[model=c]/ms", "nobody/ms", "first/nothing", "1 +",
                     "min(runs/[model=c]/ms)", "1 2", "first/model"):
            with self.subTest(text), self.assertRaises(ValueError):
                single(self.value(text))

    def test_texts(self):
        self.assertEqual(written(16641, ",.0f"), "16 641")
        self.assertEqual(written(-0.00602 * 100, ".1f"), "−0.6")
        self.assertEqual(written(285.2, ".2g"), "290")
        self.assertEqual(written(["lod"], "name"), "lod")

    def test_tables_of_a_page(self):
        tables = Tables()
        tables.feed("<table><caption>C</caption><tr><th>x</th><th>y</th></tr><tr><td>1</td><td>2 &amp; "
                    "3</td></tr></table>")
        self.assertEqual(tables.found, {"C": [{"x": "1", "y": "2 & 3"}]})

    def test_a_wrong_number_is_named_and_mended(self):
        path = ROOT / "tests" / "analysis" / "README.md"
        with unittest.mock.patch.object(Path, "read_text",
                                        return_value="a <!--= 1 / 4 as .2f -->0.3 b\n<!--= holds: 1 > 2 -->"):
            text, wrong = rewritten(path)
        self.assertIn("0.25 b", text)
        self.assertEqual(len(wrong), 2)
        self.assertRegex(wrong[0], r"README.md:1: says 0.3, should be 0.25")
        self.assertRegex(wrong[1], r"README.md:2: holds: 1 > 2: does not hold")


def update():
    """Writes the right numbers in place, and prints changes and remaining errors."""
    for path in readmes():
        text, wrong = rewritten(path)
        print(*wrong, sep="\n", end="\n" if wrong else "")
        path.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    update() if "--update" in sys.argv else unittest.main()
