"""A page of the project: its figures, and how its files are made.

A page is made in two steps. First, drawing reads run files and writes sections to page.json. Then, laying out
makes index.html from page.json. A change of the layout needs only the second step: page.py NAME --again.
"""
import importlib
import json
import re
import struct
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, field

from draw import chart_files, style
from draw.frames import taken_from
from tables import committed
from tables.chart import resolved
from tables.numbers import number_text
from tables.section import Section, read_objects, write_objects
from tables.table import Table
from web.html_parts import Made, Part, chart_html, escape, page, section_part, table_html
from web.origin import most_frequent

NAMES = {"paper": "The paper", "verification": "Verification", "stiffness": "Stiffness",
         "accuracy": "Accuracy", "stability": "Stability",
         "performance": "Performance", "plain": "Plain scenes"}  # folder below results/ → its name in links
KEPT = "page.json"


@dataclass
class Figure:
    """A section of a page: the module whose main(results, out, section) fills it, and its titles."""

    module: object
    title: str
    link: str  # its name in the navigation
    text: str = ""  # text that does not depend on the runs; the module may add to it
    figure: str = ""  # the paper's number

    def __post_init__(self):
        self.module = self.module.__name__  # another process can receive a name, but not a module

    @property
    def id(self):
        return self.module.rpartition(".")[2]


@dataclass
class Content:
    """The content of a page besides the sections of its figures."""

    answer: str  # HTML, one sentence
    top: str = ""  # HTML below the answer
    parts: list = field(default_factory=list)  # Parts after the sections
    moving: list = field(default_factory=list)  # Parts before the sections, if the page has moving cloth
    data: dict = field(default_factory=dict)  # what scripts read
    made: Made | None = None  # origin of the page; None: taken from its runs
    verdicts: Callable = lambda section: []  # HTML that a section shows besides its charts
    heading: Callable = lambda section: section.title


@dataclass
class Page:
    name: str  # its folder below results/
    title: str
    command: str  # the command that makes its runs and the page
    figures: list  # Figure
    content: Callable  # (sections, folder) → Content
    write_data: Callable = lambda sections, results, out: None  # the files beside page.json
    read: Callable = lambda results: results  # results as the caller names them → the argument of the figures

    @property
    def everything(self):
        return f"{self.command}      # everything on this page"


# --- drawing -----------------------------------------------------------------------------------------------

def draw(page_, results, out, only=(), with_pdf=False):
    """Draws the sections of a page, writes them to page.json in the folder `out`, and returns them. `only`:
    ids of the figures to draw, all if empty; all other sections stay as they are in page.json."""
    out.mkdir(parents=True, exist_ok=True)
    results = page_.read(results)
    before = {section.id: section for section in kept(out)} if only and (out / KEPT).exists() else {}
    wanted = [figure for figure in page_.figures if not only or figure.id in only]
    with ProcessPoolExecutor(initializer=style.print_as_pdf, initargs=(with_pdf,)) as pool:
        last_first = [(figure.id, pool.submit(drawn, figure, results, out, page_.command))
                      for figure in reversed(wanted)]  # the pictures of cloth come last and take longest
        now = {id: section.result() for id, section in last_first}
    known = before | now
    sections = [known[figure.id] for figure in page_.figures if figure.id in known]
    page_.write_data(sections, results, out)
    write_objects(out / KEPT, [section.as_json() for section in sections])
    return sections


def drawn(figure, results, out, command):
    """The section of a figure, filled by the main() of its module. Its charts are also files in `out`."""
    section = Section(figure.id, figure.title, figure.link, figure.text, figure.figure)
    importlib.import_module(figure.module).main(results, out, section)
    for chart, data in charts_of(section, command):
        if chart.printed:
            chart_files.write_chart(data, out, chart.id)
    return section


def charts_of(section, command):
    """(chart, its data) for every chart of a section that has a number to draw."""
    tables = {table.id: table for table in section.tables}
    return [(chart, data) for chart in section.charts if (data := resolved(chart, tables, command))]


def kept(out):
    """The sections in a folder's page.json. ValueError if another version of this program wrote the file."""
    try:
        return [Section.of_json(entry) for entry in json.loads((out / KEPT).read_text(encoding="utf-8"))]
    except (KeyError, TypeError):
        raise ValueError(f"{out / KEPT} was written by another version of this program: make the page again "
                         "from its runs") from None


def summary(out):
    """The objects of a page's summary.json; [] if there is no such file."""
    return read_objects(out / "summary.json")


# --- laying out --------------------------------------------------------------------------------------------

def lay_out(page_, out, drawn_now=()):
    """Writes index.html from the page.json in the folder `out`. The page's moving cloth comes from the
    sections `drawn_now`; if these sections have none, from the old index.html."""
    sections = kept(out)
    content = page_.content(sections, out)
    frames = next((section.frames for section in drawn_now if section.frames), None) or taken_from(
        out / "index.html")
    charts, on_top, parts = [], "", [*content.moving] if frames.heads else []
    for section in sections:
        own = []
        for chart, data in charts_of(section, page_.command):
            charts.append(data)
            file = f"{chart.id}.png" if chart.printed and (out / f"{chart.id}.png").exists() else ""
            own.append(("" if chart.on_top else chart_html(data, prefix="chart-"), file))
            on_top += chart_html(data, prefix="chart-") if chart.on_top else ""
        parts.append(section_part(section, content.heading(section), page_.everything,
                                  content.verdicts(section), own))
    parts += content.parts
    top = f"<h1>{escape(page_.title)}</h1><p class='answer'>{content.answer}</p>{on_top}{content.top}"
    if committed.is_own(out):
        top = ("<p class='grey small'>This page shows your own runs. The project's runs are on <a "
               f"href='../../{page_.name}/index.html'>the committed page</a>.</p>{top}")
        parts += beside_the_committed(out)
    data = {"runs": [], "charts": charts} | content.data | frames.data
    data["runs"] = [{"label": run["title"]} | run | {"frames": frames.heads[run["id"]]}
                    if run["id"] in frames.heads else run for run in data["runs"]]
    text = page(f"bendlab: {page_.title}", top, parts, content.made or made_of(sections, page_.command), data,
                frames.html, links_html(page_.name, out.parent), player=bool(frames.heads))
    (out / "index.html").write_text(sized(text, out), encoding="utf-8")


def links_html(here, home):
    """The links at the top of a page, to all pages below the folder `home`. `here`: folder of this page, ""
    for the start page."""
    up = "../" if here else ""
    current = lambda name: " aria-current='page'" if name == here else ""
    links = "".join(f"<a href='{up}{name}/index.html'{current(name)}>{escape(text)}</a>"
                    for name, text in NAMES.items() if name == here or (home / name / "index.html").exists())
    return (f"<div class='site'><div><a class='home' href='{up}index.html'{current('')}>bendlab</a><nav "
            f"aria-label='Pages'>{links}</nav></div></div>\n")


def beside_the_committed(out):
    """A list: the section that compares a page of your own runs with the committed page; [] without data."""
    comparison = committed.compared(committed.COMMITTED / out.name, out)
    if comparison is None:
        return []
    numbers = [(label, number_text(theirs, 4), number_text(mine, 4))
               for label, theirs, mine in comparison.numbers + comparison.lost]
    tables = [Table.of("agreement", "Committed → mine", [("what", " "), "agree", ("do_not", "do not"),
                                                         ("not_made", "not made here")],
                       committed.summary_rows(comparison)),
              Table.of("verdicts", "Verdicts that differ or are open", ["what", "committed", "mine"],
                       comparison.verdicts),
              Table.of("numbers", "Numbers that differ, and numbers that your page lacks",
                       ["what", "committed", "mine"], numbers)]
    text = ("<p>On processors of one kind, runs of the same program agree to the bit. On another kind of "
            "processor rounding differs, and chaotic sheets then differ as much as runs with different "
            "seeds.</p>")
    return [Part("committed", "Beside the committed page", text + "".join(map(table_html, tables)),
                 "Committed")]


def sized(text, folder):
    """The page with sizes added to its PNG pictures, so that the text does not move while they load."""
    def with_size(match):
        file = folder / match[1]
        if not file.exists():
            return match[0]
        width, height = struct.unpack(">II", file.read_bytes()[16:24])
        return f"{match[0]} width='{width}' height='{height}'"
    return re.sub(r"<img src='([^']+\.png)'", with_size, text)


def made_of(sections, command):
    """Commit, dates and machine (Made) of the runs that the sections used."""
    origins = [origin for section in sections for origin in section.origins]
    dates = sorted({origin["date"] for origin in origins if origin.get("date")})
    span = " to ".join(dict.fromkeys([*dates[:1], *dates[-1:]]))
    commit, *machine = (most_frequent(origins, name) for name in ("commit", "machine", "host"))
    return Made(commit, span, ", ".join(filter(None, machine)), command)
