#!/usr/bin/env python3
"""The committed pages: test_project.py [PROGRAM [SCREENSHOTS]]

They are what their scripts make of what is kept, hold no link that leads nowhere, name models as the program
does, and are small. project_test.mjs uses them in a browser, and PROGRAM validates the config that the start
page gave it. Exit code 77: all that holds, but there is no browser, Node or playwright-core.
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

import accuracy_page  # noqa: E402
import page as paper_page  # noqa: E402
import performance_page  # noqa: E402
import plain_page  # noqa: E402
import project_pages  # noqa: E402
import stability_page  # noqa: E402
import start_page  # noqa: E402
import stiffness_page  # noqa: E402
from claim_map import Cell, ClaimMap, Place  # noqa: E402
from committed import OWN  # noqa: E402
from report import Check, Claim, Section, Table  # noqa: E402

LAYOUTS = {"paper": paper_page.lay_out, "stiffness": stiffness_page.lay_out,
           "accuracy": accuracy_page.lay_out, "stability": stability_page.lay_out,
           "plain": plain_page.lay_out}
MOST = 25e6  # bytes of results/, as it is committed
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


def run_ids(text):
    data = re.search(r"id='bendlab-data'>(.*?)</script>", text, re.DOTALL)
    return {f"run-{run['id']}" for run in json.loads(data[1]).get("runs", [])}


class Committed(unittest.TestCase):
    def test_every_page_is_there_and_is_linked(self):
        self.assertEqual({path.parent.name for path, _ in pages()} - {"results"}, set(project_pages.PAGES))

    def test_pages_are_what_their_scripts_make_of_what_is_kept(self):
        with tempfile.TemporaryDirectory() as name:
            copied = Path(name) / "results"
            shutil.copytree(RESULTS, copied, ignore=shutil.ignore_patterns("*.vtkhdf", "*.part", OWN))
            for page, lay_out in LAYOUTS.items():
                lay_out(copied / page)
            bench = json.loads((copied / "performance/bench.json").read_text(encoding="utf-8"))
            performance_page.lay_out(bench, copied / "performance")
            start_page.write(copied)
            for path, text in pages():
                again = (copied / path.relative_to(RESULTS)).read_text(encoding="utf-8")
                self.assertTrue(again == text, f"{path} is not what is kept: run its script with --again")

    def test_no_link_leads_nowhere(self):
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

    def test_nothing_is_inline(self):
        for path, text in pages():
            for tag, attributes in Links(text).tags:
                self.assertFalse([name for name in attributes if name.startswith("on") or name == "style"],
                                 f"{path}: {tag}")

    def test_models_have_one_name(self):
        for path, text in pages():
            for name in OTHER_NAMES:
                self.assertFalse(name in text, f"{path}: {name}")

    def test_results_stay_small(self):
        listed = subprocess.run(["git", "-C", ROOT, "ls-files", "-z", "results"], capture_output=True,
                                check=False).stdout.decode().split("\0")
        sizes = [(ROOT / name).stat().st_size for name in listed if name and (ROOT / name).exists()]
        self.assertLessEqual(sum(sizes), MOST)


class Kept(unittest.TestCase):
    def test_a_section_is_the_same_after_it_was_kept(self):
        place = Place("rounded", "no damping", "1 × 10", "the corner alone", 16)
        claim_map = ClaimMap("5", "", "It <holds>.", "it does", "stretch",
                             {place: Cell("1.5", True, "run", (1,))})
        section = Section("A title", "5", [("a.png", "<b>")], [Table("t", ["a"], [["1"]])],
                          [Claim("5", "c", "r", {"n": float("inf"), "m": 1.25}, None)],
                          [Check("c", "m", "mesh", 1.0, float("nan"), 0.1, "s"),
                           Check("c", "m", "mesh", 1.0, 1.0999999, 0.1, "s")],
                          [claim_map], ["run"], ["one"], "text")
        with tempfile.TemporaryDirectory() as name:
            project_pages.keep(Path(name), [section])
            again, = project_pages.kept(Path(name))
        self.assertEqual(again.as_json(), section.as_json())
        self.assertEqual(again.maps[0].cells, claim_map.cells)
        self.assertEqual(again.claims[0].numbers["n"], float("inf"))
        self.assertEqual([check.holds for check in again.checks], [None, True])

    def test_no_text_of_a_section_or_run_becomes_markup(self):
        place = Place("", MARKUP, MARKUP, MARKUP, MARKUP)
        section = Section(MARKUP, MARKUP, [(MARKUP, MARKUP)],
                          [Table(MARKUP, [MARKUP] * 2, [[MARKUP, 1.0]] * 20)],
                          [Claim(MARKUP, MARKUP, MARKUP, {MARKUP: MARKUP}, True, MARKUP, MARKUP)],
                          [Check(MARKUP, MARKUP, MARKUP, 1.0, 2.0, 0.1, MARKUP, note=MARKUP)],
                          [ClaimMap(MARKUP, MARKUP, MARKUP, MARKUP, MARKUP,
                                    {place: Cell(MARKUP, True, MARKUP, (1,))}, MARKUP)],
                          [MARKUP], [MARKUP], MARKUP * 9)
        with tempfile.TemporaryDirectory() as name:
            out = Path(name)
            for lay_out in (paper_page.lay_out, stiffness_page.lay_out):
                project_pages.keep(out, [section])
                lay_out(out)
                self.only_ours((out / "index.html").read_text(encoding="utf-8"))
            run = {"config": MARKUP, "settings": {MARKUP: MARKUP, "b": MARKUP}, "verdict": "told",
                   "status": MARKUP, "worst": {"what": MARKUP, "value": 2.0, "limit": 1.0, "unit": MARKUP},
                   "broken": [MARKUP], "told": MARKUP, "seconds": 1.0, "command": MARKUP}
            mixed = run | {"config": "metres", "settings": {"model": MARKUP, "mesh": MARKUP}}
            (out / "summary.json").write_text(json.dumps([run] * 3 + [mixed | {"settings": run["settings"] |
                                              mixed["settings"]}]), encoding="utf-8")
            plain_page.lay_out(out)
            self.only_ours((out / "index.html").read_text(encoding="utf-8"))

    def only_ours(self, text):
        tags = Links(text).tags
        self.assertEqual([attributes.get("type") for tag, attributes in tags if tag == "script"],
                         ["application/json", None])
        self.assertFalse([tag for tag, attributes in tags if "onerror" in attributes or tag == "injected"])

    def test_a_start_page_without_pages_says_so(self):
        with tempfile.TemporaryDirectory() as name:
            start_page.write(Path(name))
            text = (Path(name) / "index.html").read_text(encoding="utf-8")
        self.assertIn("There are no pages yet", text)
        self.assertIn("no runs of accuracy yet", text)

    def test_a_page_says_where_its_runs_are_from(self):
        origins = [{"commit": "abc", "machine": "a processor", "host": "h", "date": f"2001-02-0{day}"}
                   for day in (3, 1, 2)]
        made = project_pages.made_of([Section("a", "", origins=origins)], "./bendlab reproduce")
        self.assertEqual((made.commit, made.date, made.machine),
                         ("abc", "2001-02-01 to 2001-02-03", "a processor, h"))


def in_browser(program, shots):
    """Exit code of the tests in a browser, and of the program's verdict on what the start page gave."""
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
    held = unittest.main(argv=sys.argv[:1], exit=False).result.wasSuccessful()
    sys.exit(1 if not held else in_browser(program, shots))
