"""A page of the project: its figures, and how its files are made.

A page is made in two steps. First, drawing reads run files and writes sections to page.json. Then, laying out
makes index.html from page.json. A change of the layout needs only the second step: page.py NAME --again.
"""
import importlib
import json
import re
import struct
from collections import Counter
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, field, replace

from draw import chart_files, style
from tables.numbers import number_text
from tables import committed
from tables.chart import resolved
from tables.section import Section, write_objects
from tables.table import Table
from web.html_parts import Made, Part, escape, page, section_part, table_html
from draw.page_frames import PageFrames, taken_from

NAMES = {"paper": "The paper", "stiffness": "Stiffness", "accuracy": "Accuracy", "stability": "Stability",
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

    @property
    def id(self):
        return self.module.__name__.rpartition(".")[2]


@dataclass
class Content:
    """The content of a page besides the sections of its figures."""

    answer: str  # HTML, one sentence
    top: str = ""  # HTML below the answer
    parts: list = field(default_factory=list)  # Parts after the sections
    moving: list = field(default_factory=list)  # Parts before the sections, if the page has moving cloth
    data: dict = field(default_factory=dict)  # what scripts read
    frames: PageFrames = field(default_factory=PageFrames)
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
        last_first = [(figure.id, pool.submit(drawn, *described(figure), results, out, page_.command))
                      for figure in reversed(wanted)]  # the pictures of cloth come last and take longest
        now = {id: section.result() for id, section in last_first}
    sections = [now.get(figure.id) or before.get(figure.id) for figure in page_.figures]
    sections = [section for section in sections if section]
    page_.write_data(sections, results, out)
    write_objects(out / KEPT, [section.as_json() for section in sections])
    return sections


def described(figure):
    """A figure in a form that another process can receive: the name of its module, and its empty section."""
    return figure.module.__name__, Section(figure.id, figure.title, figure.link, figure.text, figure.figure)


def drawn(module, section, results, out, command=""):
    """Lets the main() of a module fill the section, and writes pictures and charts to files in `out`."""
    importlib.import_module(module).main(results, out, section)
    tables = {table.id: table for table in section.tables}
    for chart in section.charts:
        data = resolved(chart, tables, command)
        if data and chart.printed:
            chart_files.write_chart(data, out, chart.id)
    return section


def kept(out):
    """The sections in a folder's page.json. ValueError if another version of this program wrote the file."""
    try:
        return [Section.of_json(entry) for entry in json.loads((out / KEPT).read_text(encoding="utf-8"))]
    except (KeyError, TypeError):
        raise ValueError(f"{out / KEPT} was written by another version of this program: make the page again "
                         "from its runs") from None


def summary(out):
    """The objects of a page's summary.json; [] if there is no such file."""
    file = out / "summary.json"
    return json.loads(file.read_text(encoding="utf-8")) if file.exists() else []


# --- laying out --------------------------------------------------------------------------------------------

def lay_out(page_, out, drawn_now=()):
    """Writes index.html from the page.json in the folder `out`. The page's moving cloth comes from the
    sections `drawn_now`; if these sections have none, from the old index.html."""
    sections = kept(out)
    content = page_.content(sections, out)
    moving = [section.frames for section in drawn_now if section.frames]
    content.frames = moving[0] if moving else taken_from(out / "index.html")
    charts, parts = [], []
    top = content.top
    for section in sections:
        tables = {table.id: table for table in section.tables}
        drawn_charts = [(chart, data) for chart in section.charts
                        if (data := resolved(chart, tables, page_.command))]
        charts += [data for _, data in drawn_charts]
        top = "".join(chart_html(data) for chart, data in drawn_charts if chart.on_top) + top
        own = [("" if chart.on_top else chart_html(data),
                file if chart.printed and (out / file).exists() else "")
               for chart, data in drawn_charts for file in [f"{chart.id}.png"]]
        parts.append(section_part(section, content.heading(section), page_.everything,
                                  content.verdicts(section), own))
    data = {"charts": charts} | content.data
    write(out, page_, replace(content, top=top, parts=[*(content.moving if content.frames.heads else []),
                                                       *parts, *content.parts], data=data),
          content.made or made_of(sections, page_.command))


def chart_html(chart, note=""):
    """The HTML element in which the page's script draws a chart."""
    text = " ".join(part for part in (chart.get("note", ""), note) if part)
    text = f"<span>{escape(text)}</span>" if text else ""
    return (f"<figure class='chart' data-chart='{chart['id']}' id='chart-{chart['id']}'><figcaption><b>"
            f"{escape(chart['title'])}</b>{text}</figcaption></figure>")


def write(out, page_, content, made):
    top = f"<h1>{escape(page_.title)}</h1><p class='answer'>{content.answer}</p>{content.top}"
    parts = content.parts
    if committed.is_own(out):
        top = own_html(page_.name) + top
        parts = [*parts, *beside_the_committed(out)]
    moving = content.frames
    data = {"runs": [], "charts": []} | content.data | moving.data
    data["runs"] = [{"label": run["title"]} | run | {"frames": moving.heads[run["id"]]}
                    if run["id"] in moving.heads else run for run in data["runs"]]
    text = page(f"bendlab: {page_.title}", top, parts, made, data, moving.html,
                links_html(page_.name, out.parent), player=bool(moving.heads))
    (out / "index.html").write_text(sized(text, out), encoding="utf-8")


def links_html(here, home):
    """The links at the top of a page, to all pages below the folder `home`. `here`: folder of this page, ""
    for the start page."""
    there = [name for name in NAMES if name == here or (home / name / "index.html").exists()]
    to = lambda name: f"{name}/index.html" if not here else f"../{name}/index.html"
    current = lambda name: " aria-current='page'" if name == here else ""
    links = "".join(f"<a href='{to(name)}'{current(name)}>{escape(NAMES[name])}</a>" for name in there)
    start = f"<a class='home' href='{'' if not here else '../'}index.html'{current('')}>bendlab</a>"
    return f"<div class='site'><div>{start}<nav aria-label='Pages'>{links}</nav></div></div>\n"


def own_html(name):
    return ("<p class='grey small'>This page shows your own runs. The project's runs are on <a "
            f"href='../../{name}/index.html'>the committed page</a>.</p>")


def beside_the_committed(out):
    """A list: the section that compares a page of your own runs with the committed page; [] without data."""
    comparison = committed.compared(committed.COMMITTED / out.name, out)
    if comparison is None:
        return []
    differing = [{"what": label, "committed": number_text(theirs, 4), "mine": number_text(mine, 4)}
                 for label, theirs, mine in comparison.numbers]
    tables = [Table.of("agreement", "Committed → mine", [("what", " "), "agree", ("do_not", "do not"),
                                                         ("not_made", "not made here")],
                       [dict(zip(("what", "agree", "do_not", "not_made"), row))
                        for row in committed.summary_rows(comparison)]),
              Table.of("verdicts", "Verdicts that differ or are open", ["what", "committed", "mine"],
                       [dict(zip(("what", "committed", "mine"), row)) for row in comparison.verdicts]),
              Table.of("numbers", "Numbers that differ", ["what", "committed", "mine"], differing)]
    text = ("<p>On processors of one kind, runs of the same program agree to the bit. On another kind of "
            "processor rounding differs, and chaotic sheets then differ as much as runs with different "
            "seeds.</p>")
    return [Part("committed", "Beside the committed page",
                 text + "".join(table_html(table) for table in tables if table.rows), "Committed")]


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
    most = lambda name: ", ".join(
        text for text, _ in Counter(origin[name] for origin in origins if origin.get(name)).most_common(3))
    dates = sorted({origin["date"] for origin in origins if origin.get("date")})
    span = " to ".join(dict.fromkeys([*dates[:1], *dates[-1:]]))
    machine = ", ".join(filter(None, [most("machine"), most("host")]))
    return Made(most("commit"), span, machine, command)
