"""Every measured number in our READMEs has an entry in stated_numbers.py and agrees with its data. No link is
broken, and lines of READMEs and code are short.

    python3 tests/analysis/test_stated_numbers.py             checks
    python3 tests/analysis/test_stated_numbers.py --update    writes the right numbers into the READMEs
"""
import re
import sys
import unittest

from stated_numbers import HOLDS, ROOT, STATED

REQUIRED = ["README.md", "configs/README.md", "analysis/README.md", "experiments/README.md",
            "experiments/bench/README.md", "lib/bendlab/bending/README.md", "lib/bendlab/solver/README.md",
            "lib/bendlab/effects/README.md"]
MAIN_LINES, COLUMNS = 140, 110

LINK = re.compile(r"!?\[[^\]]*\]\(([^)\s]+)\)")
# A number with one of these units looks like a measurement.
WITH_UNIT = re.compile(r"(?P<number>\d[\d.]*)(?: to [\d.]+)? ?(?:ns|ms|%|MB|bytes|minutes|times)(?![\w-])")


def own(paths):
    """The paths that are not in installed packages."""
    return (path for path in paths if "node_modules" not in path.parts)


def readmes():
    """The READMEs of the checkout, without those in build folders."""
    return sorted(path for folder in (".", "configs", "analysis", "experiments", "lib", "tests", "results")
                  for path in own(ROOT.glob("README.md") if folder == "."
                                  else (ROOT / folder).rglob("README.md")))


def visible(text):
    """The lines of a text. Each line of a code block becomes an empty line."""
    code = False
    for line in text.split("\n"):
        fence = line.lstrip().startswith("```")
        yield "" if code or fence else line
        code ^= fence


def anchors(path):
    """The anchors of the headings of a file, as GitHub forms them; or the ids of an HTML page."""
    if path.suffix == ".html":
        return set(re.findall(r"\bid='([^']+)'", path.read_text(encoding="utf-8")))
    headings = re.findall(r"^#+ (.*)$", "\n".join(visible(path.read_text(encoding="utf-8"))), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def without_code(text):
    """(line number, line) of each line outside code blocks; code spans become backticks."""
    for at, (line, seen) in enumerate(zip(text.split("\n"), visible(text)), 1):
        if seen:
            yield at, re.sub(r"(?<!>)`[^`]*`", lambda span: "`" * len(span[0]), line)


class Number(float):
    """A number in the format of our READMEs, as 16 641 and −0.6."""

    def __format__(self, spec):
        return super().__format__(spec).replace(",", " ").replace("-", "−")


def spaced(words):
    """A pattern that finds these words even if there are line breaks between them."""
    return r"\s+".join(map(re.escape, words.split()))


def stated(name):
    """For each entry of a README: a pattern that finds its words with any numbers, and the right words."""
    for words, *values in STATED[name]:
        numbers = [] if isinstance(values[0], str) else list(map(Number, values))
        shape = re.split(r"\{.*?\}", words) if numbers else [words]
        pattern = r"([\d.−]+(?: \d{3})*)".join(map(spaced_part, shape))
        yield pattern, words.format(*numbers) if numbers else words


def spaced_part(part):
    """Like spaced(), for the words between two numbers: blanks at their ends count."""
    return re.sub(r"(\\ )+", r"\\s+", re.escape(part))


def unstated(name, text):
    """(line number, error) of each number that looks like a measurement and has no entry."""
    covered = [match.span() for pattern, _ in stated(name) for match in re.finditer(pattern, text)] \
        if name in STATED else []
    start = 0
    for at, line in enumerate(text.split("\n"), 1):
        seen = dict(without_code(text)).get(at, "")
        yield from ((at, f"'{match[0]}' has no entry in stated_numbers.py")
                    for match in WITH_UNIT.finditer(seen)
                    if not any(first <= start + match.start() < last for first, last in covered))
        start += len(line) + 1


def broken_links(path, text):
    """(line number, error) of each broken link to a file of the checkout."""
    for at, line in enumerate(visible(text), 1):
        for link in LINK.findall(line):
            file, _, anchor = link.partition("#")
            target = (path.parent / file).resolve() if file else path
            if not re.match(r"[a-z]+:", link) and not (
                    target.exists() and (not anchor or anchor in anchors(target))):
                yield at, f"the link {link} is broken"


def long_lines(text):
    """(line number, error) of each long line. Tables may be wider."""
    return ((at, f"{len(line)} columns") for at, line in enumerate(visible(text), 1) if len(line) > COLUMNS
            and not line.lstrip().startswith("|"))


class StatedNumbers(unittest.TestCase):
    def none_in_any(self, problems):
        """Asserts that problems(path, text) is empty for every README."""
        errors = [f"{path.relative_to(ROOT)}:{at}: {error}" for path in readmes()
                  for at, error in problems(path, path.read_text(encoding="utf-8"))]
        self.assertFalse(errors, "\n" + "\n".join(errors))

    def test_that_every_number_agrees_with_its_data(self):
        wrong = [f"{name}: expected '{words}'" for name in STATED
                 for text in [(ROOT / name).read_text(encoding="utf-8")]
                 for _, words in stated(name) if not re.search(spaced(words), text)]
        self.assertFalse(wrong, "\n" + "\n".join(wrong) +
                         "\npython3 tests/analysis/test_stated_numbers.py --update")

    def test_that_files_have_the_constants(self):
        constants = [((ROOT / name).parent / source, *pattern)
                     for name, entries in STATED.items() for _, source, *pattern in entries
                     if re.fullmatch(r"[\w./]+\.(py|hpp|cpp|json)", str(source))]
        self.assertGreater(len(constants), 5)
        for file, pattern in constants:
            self.assertRegex(file.read_text(encoding="utf-8"), pattern, file)

    def test_that_statements_without_a_number_hold(self):
        everything = "\n".join((ROOT / name).read_text(encoding="utf-8") for name in STATED)
        for words, holds in HOLDS.items():
            self.assertRegex(everything, spaced(words))
            self.assertTrue(holds, words)

    def test_that_every_measurement_has_an_entry(self):
        self.none_in_any(lambda path, text: unstated(str(path.relative_to(ROOT)), text))

    def test_that_no_readme_has_a_comment(self):
        self.none_in_any(lambda path, text: ((at, "comment in a README") for at, line in without_code(text)
                                             if "<!--" in line))

    def test_that_no_link_is_broken(self):
        self.none_in_any(broken_links)

    def test_that_files_named_in_configs_exist(self):
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

    def test_that_each_room_has_a_readme_with_a_link(self):
        for name in REQUIRED:
            with self.subTest(name):
                text = (ROOT / name).read_text(encoding="utf-8")
                self.assertTrue(LINK.search(text), "the README has no link")


def update():
    """Writes the right numbers into the READMEs."""
    for name in STATED:
        text = (ROOT / name).read_text(encoding="utf-8")
        for pattern, words in stated(name):
            stated_now, right = re.search(pattern, text), re.fullmatch(pattern, words)
            # The last number comes first, so that the positions of earlier numbers stay valid.
            for group in range(len(stated_now.groups()) if stated_now else 0, 0, -1):
                text = text[:stated_now.start(group)] + right[group] + text[stated_now.end(group):]
        (ROOT / name).write_text(text, encoding="utf-8")


if __name__ == "__main__":
    update() if "--update" in sys.argv else unittest.main()
