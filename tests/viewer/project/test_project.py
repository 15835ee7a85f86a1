#!/usr/bin/env python3
"""Tests the committed pages: test_project.py [PROGRAM [SCREENSHOTS]]

The pages agree with the kept sections, have no broken links, use the model names of the program, and are
small. project_test.mjs uses them in a browser, and PROGRAM validates the config that the start page offers.
Exit code 77: the tests without a browser pass, but there is no browser, Node or playwright-core.
"""
import json
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from html.parser import HTMLParser
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[2]
RESULTS = ROOT / "results"
sys.path.insert(0, str(ROOT / "analysis"))

from page import PAGES  # noqa: E402
from pages import paper, plain, project, start, stiffness  # noqa: E402
from tables.chart import Chart  # noqa: E402
from tables.claim_map import Cell, ClaimMap, Place  # noqa: E402
from tables.committed import OWN  # noqa: E402
from tables.section import Check, Claim, Section, write_objects  # noqa: E402
from tables.table import Table  # noqa: E402

MOST = 30e6  # bytes of the committed files of results/; 27e6 with 18 models
MARKUP = "<injected>'\"</script><script>document.title='injected'</script><!--<img src=x onerror=alert(2)>"
OTHER_NAMES = ["discrete shells", "Discrete shells", "k-ring,", "Choi-Ko", "no bending", "sparse LOD",
               "edge springs"]


class Links(HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.targets, self.ids, self.tags = [], [], []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        self.tags.append((tag, attributes))
        self.ids += [attributes["id"]] if "id" in attributes else []
        self.targets += [attributes[name] for name in ("href", "src") if name in attributes]


def pages():
    """(path, text) of every committed page."""
    paths = [path for path in sorted(RESULTS.glob("*/index.html")) if path.parent.name != OWN]
    return [(path, path.read_text(encoding="utf-8")) for path in [RESULTS / "index.html", *paths]]


def kept_again(section):
    """Writes a section to a file, and reads it again."""
    with tempfile.TemporaryDirectory() as name:
        write_objects(Path(name) / project.KEPT, [section.as_json()])
        again, = project.kept(Path(name))
    return again


def run_ids(text):
    data = re.search(r"id='bendlab-data'>(.*?)</script>", text, re.DOTALL)
    return {f"run-{run['id']}" for run in json.loads(data[1]).get("runs", [])}


class Committed(unittest.TestCase):
    def test_every_page_exists_and_is_linked(self):
        self.assertEqual({path.parent.name for path, _ in pages()} - {"results"}, set(project.NAMES))
        self.assertEqual(set(PAGES), set(project.NAMES))

    def test_pages_agree_with_their_kept_sections(self):
        with tempfile.TemporaryDirectory() as name:
            copied = Path(name) / "results"
            shutil.copytree(RESULTS, copied, ignore=shutil.ignore_patterns("*.vtkhdf", "*.part", OWN))
            for page, module in PAGES.items():
                project.lay_out(module.PAGE, copied / page)
            start.write(copied)
            for path, text in pages():
                again = (copied / path.relative_to(RESULTS)).read_text(encoding="utf-8")
                self.assertTrue(again == text,
                                f"{path} differs from its kept sections: run its script with --again")

    def test_no_link_is_broken(self):
        texts = dict(pages())
        for path, text in texts.items():
            links = Links(text)
            self.assertEqual(len(links.ids), len(set(links.ids)), path)
            for target in links.targets:
                if target.startswith("data:"):
                    continue
                file, _, name = target.partition("#")
                there = (path.parent / file).resolve() if file else path
                self.assertTrue(there.exists(), f"{path}: {target}")
                if name and there in texts:
                    self.assertIn(name, {*Links(texts[there]).ids, *run_ids(texts[there])}, path)

    def test_no_element_has_an_inline_script_or_style(self):
        for path, text in pages():
            for tag, attributes in Links(text).tags:
                self.assertFalse([name for name in attributes if name.startswith("on") or name == "style"],
                                 f"{path}: {tag}")

    def test_models_have_the_names_of_the_program(self):
        for path, text in pages():
            for name in OTHER_NAMES:
                self.assertFalse(name in text, f"{path}: {name}")

    def test_the_committed_results_are_small(self):
        listed = subprocess.run(["git", "-C", ROOT, "ls-files", "-z", "results"], capture_output=True,
                                check=False).stdout.decode().split("\0")
        sizes = [(ROOT / name).stat().st_size for name in listed if name and (ROOT / name).exists()]
        self.assertLessEqual(sum(sizes), MOST)


class Kept(unittest.TestCase):
    def test_a_section_is_the_same_after_it_was_written_and_read(self):
        place = Place("rounded", "no damping", "1 × 10", "the corner alone", 16)
        claim_map = ClaimMap("5", "", "It <holds>.", "it does", "stretch",
                             {place: Cell("1.5", True, "run", (1,))})
        table = Table.of("t", "A table", ["model", ("a", "A", ".2f", "m", "what it is")],
                         [{"model": "none", "a": 1.25, "range": (1.0, 2.0), "runs": ["x"]},
                          {"model": "lod", "a": float("inf")}])
        section = Section("a", "A title", "A link", "text", "5", [Chart("c", "C", "t", "model", ["a"])],
                          [("a.png", "<b>")], [table],
                          [Claim("5", "c", "r", {"n": float("inf"), "m": 1.25}, None)],
                          [Check("c", "m", "mesh", 1.0, float("nan"), 0.1, "s"),
                           Check("c", "m", "mesh", 1.0, 1.0999999, 0.1, "s")],
                          [claim_map], ["run"], ["one"], [{"commit": "x"}], bits={"config": {"place": "b"}})
        again = kept_again(section)
        self.assertEqual(again.as_json(), section.as_json())
        self.assertEqual((again.charts, again.pictures), (section.charts, section.pictures))
        self.assertEqual(again.tables[0].texts(), table.texts())
        self.assertEqual(again.table("t")[1], {"model": "lod", "a": float("inf")})
        self.assertEqual(again.maps[0].cells, claim_map.cells)
        self.assertEqual(again.claims[0].numbers["n"], float("inf"))
        self.assertEqual([check.holds for check in again.checks], [None, True])

    def test_no_text_of_a_section_or_run_becomes_markup(self):
        place = Place("", MARKUP, MARKUP, MARKUP, MARKUP)
        table = Table.of("t", MARKUP, [(MARKUP, MARKUP), ("a", MARKUP, "", MARKUP, MARKUP)],
                         [{MARKUP: MARKUP, "a": 1.0, "runs": [MARKUP]}] * 20)
        charts = [Chart(f"c{on_top}", MARKUP, "t", MARKUP, ["a"], [MARKUP], [MARKUP], scale="band", look="",
                        note=MARKUP, limits=[("a", 1, MARKUP)], on_top=on_top) for on_top in (False, True)]
        section = Section("s", MARKUP, MARKUP, MARKUP * 9, MARKUP, charts, [(MARKUP, MARKUP)], [table],
                          [Claim(MARKUP, MARKUP, MARKUP, {MARKUP: MARKUP}, True, MARKUP, MARKUP)],
                          [Check(MARKUP, MARKUP, MARKUP, 1.0, 2.0, 0.1, MARKUP, note=MARKUP)],
                          [ClaimMap(MARKUP, MARKUP, MARKUP, MARKUP, MARKUP,
                                    {place: Cell(MARKUP, True, MARKUP, (1,))}, MARKUP)],
                          [MARKUP], [MARKUP], [{"commit": MARKUP, "machine": MARKUP, "date": MARKUP}])
        with tempfile.TemporaryDirectory() as name:
            out = Path(name)
            write_objects(out / project.KEPT, [section.as_json()])
            for page in (paper, stiffness):
                project.lay_out(page.PAGE, out)
                self.only_ours((out / "index.html").read_text(encoding="utf-8"))
            run = {"id": MARKUP, "config": MARKUP, "settings": {MARKUP: MARKUP, "b": MARKUP},
                   "verdict": "warned", "status": MARKUP, "broken": [MARKUP], "warnings": MARKUP,
                   "seconds": 1.0, "command": MARKUP,
                   "worst": {"what": MARKUP, "value": 2.0, "limit": 1.0, "unit": MARKUP}}
            mixed = run | {"config": "metres", "settings": {"model": MARKUP, "mesh": MARKUP}}
            (out / "summary.json").write_text(json.dumps([run] * 3 + [mixed | {"settings": run["settings"] |
                                              mixed["settings"]}]), encoding="utf-8")
            project.lay_out(plain.PAGE, out)
            self.only_ours((out / "index.html").read_text(encoding="utf-8"))

    def only_ours(self, text):
        tags = Links(text).tags
        self.assertEqual([attributes.get("type") for tag, attributes in tags if tag == "script"],
                         ["application/json", None])
        self.assertFalse([tag for tag, attributes in tags if "onerror" in attributes or tag == "injected"])

    def test_a_start_page_without_other_pages_states_it(self):
        with tempfile.TemporaryDirectory() as name:
            start.write(Path(name))
            text = (Path(name) / "index.html").read_text(encoding="utf-8")
        self.assertIn("There are no pages yet", text)
        self.assertIn("no accuracy runs yet", text)

    def test_a_page_states_commit_date_and_machine_of_its_runs(self):
        origins = [{"commit": "abc", "machine": "a processor", "host": "h", "date": f"2001-02-0{day}"}
                   for day in (3, 1, 2)]
        source = project.made_of([Section("a", "", origins=origins)], "./bendlab reproduce")
        self.assertEqual((source.commit, source.date, source.machine),
                         ("abc", "2001-02-01 to 2001-02-03", "a processor, h"))


def in_browser(program, shots):
    """Exit code of the tests in a browser, and of the program that validates the config of the start page."""
    node = shutil.which("node")
    if not node:
        print("skipped: no Node")
        return 77
    with tempfile.TemporaryDirectory() as folder:
        arguments = [RESULTS, folder] + ([shots] if shots else [])
        code = subprocess.run([node, HERE / "project_test.mjs", *arguments], check=False).returncode
        chosen = Path(folder) / "chosen.json"
        if code == 0 and program and chosen.exists():
            code = subprocess.run([program, "validate", chosen], check=False).returncode
        return code


if __name__ == "__main__":
    program, shots = [*sys.argv[1:], None, None][:2]
    passed = unittest.main(argv=sys.argv[:1], exit=False).result.wasSuccessful()
    sys.exit(1 if not passed else in_browser(program, shots))
