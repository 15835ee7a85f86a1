"""The project's own pages: their order and links, what is kept of them, and their command line.

A page has two steps. Drawing reads run files and gives sections, which are kept beside the page as page.json.
Laying out makes index.html of what is kept, so that another layout needs no runs: `SCRIPT --again`.
"""
import argparse
import json
import re
import struct
from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path

import committed
from html_parts import Made, Part, escape, number_text, page, table_html
from page_frames import PageFrames
from report import Section, Table, print_option, write_objects

PAGES = {"paper": "The paper", "stiffness": "Stiffness", "accuracy": "Accuracy", "stability": "Stability",
         "performance": "Performance", "plain": "Plain scenes"}  # folder below results/ → its name
KEPT = "page.json"


@dataclass
class Content:
    """What a page says."""

    title: str
    answer: str  # HTML, one sentence
    top: str  # HTML below the answer: its picture
    parts: list  # Part
    data: dict = field(default_factory=dict)  # what scripts read: charts, runs
    frames: PageFrames = field(default_factory=PageFrames)


def links_html(here, home):
    """The links to all pages that are below the folder `home`, for the top of one of them; `here` is its
    folder, "" the start page's."""
    there = [name for name in PAGES if name == here or (home / name / "index.html").exists()]
    to = lambda name: f"{name}/index.html" if not here else f"../{name}/index.html"
    current = lambda name: " aria-current='page'" if name == here else ""
    links = "".join(f"<a href='{to(name)}'{current(name)}>{escape(PAGES[name])}</a>" for name in there)
    start = f"<a class='home' href='{'' if not here else '../'}index.html'{current('')}>bendlab</a>"
    return f"<div class='site'><div>{start}<nav aria-label='Pages'>{links}</nav></div></div>\n"


def write(out, name, content, made):
    """Writes a page's index.html into the folder `out`."""
    top = f"<h1>{escape(content.title)}</h1><p class='answer'>{content.answer}</p>{content.top}"
    parts = content.parts
    if committed.is_own(out):
        top = own_html(name) + top
        parts = [*parts, *beside_the_committed(out)]
    shown = content.frames
    data = {"runs": [], "charts": []} | content.data | shown.data
    data["runs"] = [{"label": run["title"]} | run | {"frames": shown.heads[run["id"]]}
                    if run["id"] in shown.heads else run for run in data["runs"]]
    text = page(f"bendlab: {content.title}", top, parts, made, data, shown.html,
                links_html(name, out.parent), player=bool(shown.heads))
    (out / "index.html").write_text(sized(text, out), encoding="utf-8")


def own_html(name):
    """What a page of one's own says above all."""
    return (f"<p class='grey small'>This page is made of your own runs. The project's is <a "
            f"href='../../{name}/index.html'>the committed one</a>.</p>")


def beside_the_committed(out):
    """The section of a page of one's own that compares it with the committed one; none without data."""
    found = committed.compared(committed.COMMITTED / out.name, out)
    if found is None:
        return []
    tables = [Table("Committed → mine", ["", "agree", "do not", "not made here"],
                    [list(row) for row in committed.summary_rows(found)]),
              Table("Verdicts that are others, or open", ["what", "committed", "mine"],
                    [list(row) for row in found.verdicts]),
              Table("Numbers that are others", ["what", "committed", "mine"],
                    [[label, number_text(one, 4), number_text(two, 4)] for label, one, two in found.numbers])]
    text = ("<p>Runs of the same program agree to the bit on processors of one kind. On another kind numbers "
            "are rounded elsewhere, and sheets that are chaotic then differ as two seeds do.</p>")
    return [Part("committed", "Beside the committed page",
                 text + "".join(table_html(table) for table in tables if table.rows), "Committed")]


def sized(text, folder):
    """A page whose PNG pictures state their size, so that nothing moves when they arrive."""
    def with_size(match):
        file = folder / match[1]
        if not file.exists():
            return match[0]
        width, height = struct.unpack(">II", file.read_bytes()[16:24])
        return f"{match[0]} width='{width}' height='{height}'"
    return re.sub(r"<img src='([^']+\.png)'", with_size, text)


def made_of(sections, command):
    """The Made of a page whose sections saw these runs."""
    seen = [origin for section in sections for origin in section.origins]
    most = lambda name: ", ".join(
        text for text, _ in Counter(one[name] for one in seen if one.get(name)).most_common(3))
    dates = sorted({one["date"] for one in seen if one.get("date")})
    span = " to ".join(dict.fromkeys([*dates[:1], *dates[-1:]]))
    machine = ", ".join(filter(None, [most("machine"), most("host")]))
    return Made(most("commit"), span, machine, command)


def keep(out, sections):
    """Writes what the page is made of."""
    write_objects(out / KEPT, [section.as_json() for section in sections])


def kept(out):
    """The sections that keep() wrote."""
    return [Section.of_json(entry) for entry in json.loads((out / KEPT).read_text(encoding="utf-8"))]


def summary(out):
    """The objects of the page's summary.json."""
    return json.loads((out / "summary.json").read_text(encoding="utf-8"))


def command_line(name, about, main, lay_out, parts=None):
    """The command line of a page's script: main(results, out), or lay_out(out) of what is kept. `parts`: a
    function renew(results, out, figure) for one of these figures."""
    parser = argparse.ArgumentParser(description=about)
    parser.add_argument("--results", type=Path, default=Path("results"), help="folder with the runs")
    folder_options(parser, name)
    parser.add_argument("--again", action="store_true",
                        help=f"write index.html again, of the {KEPT} and summary.json that are there")
    if parts:
        parser.add_argument("--only", choices=[figure.__name__ for figure in parts[1]], metavar="FIGURE",
                            help="draw one section again, and keep the others: %(choices)s")
    print_option(parser)
    arguments = parsed(parser, name)
    if arguments.again:
        lay_out(arguments.out)
    elif parts and arguments.only:
        parts[0](arguments.results, arguments.out, arguments.only)
    else:
        main(arguments.results, arguments.out)
    renew_start(arguments.out)
    print(arguments.out / "index.html")


def folder_options(parser, name):
    """The options that say where a page goes; parsed() reads them."""
    parser.add_argument("--out", type=Path,
                        help=f"folder for the page (default: {committed.home(name, False)})")
    parser.add_argument("--committed", action="store_true",
                        help=f"write the project's own page, {committed.home(name, True)}")


def parsed(parser, name):
    """The arguments of a page's script; `out` is the folder of the page."""
    arguments = parser.parse_args()
    if arguments.out and arguments.committed:
        parser.error("--out and --committed name two folders: leave one of them out")
    arguments.out = arguments.out or committed.home(name, arguments.committed)
    if arguments.again and not (arguments.out / KEPT).exists():
        parser.error(f"{arguments.out / KEPT}, of which --again makes the page, is not there: leave --again "
                     f"out, or name the folder of a page with --out or --committed")
    return arguments


def renew_start(out):
    """Writes the start page beside the folder of a page again, for it has the page's answer."""
    if out.name in PAGES:
        import start_page  # which reads what pages kept
        start_page.write(out.parent)
