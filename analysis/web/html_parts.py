"""The HTML that all pages share: the frame with style sheet and security policy, sections, tables."""
import base64
import hashlib
import html
import json
import re
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

MANY, CHOICES = 12, 14  # most rows of a table without filters; most values in the filter of a column
VIEWER = Path(__file__).resolve().parents[1] / "viewer/dist"
HEAD = """<!doctype html>
<html lang="en"><head><meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="{policy}">
<meta name="viewport" content="width=device-width, initial-scale=1">
<link rel="icon" href="data:,">
<title>{title}</title>
<style>{style}</style></head>
"""


@dataclass
class Part:
    """A section of a page with an address of its own."""

    name: str  # its address, as in #name
    title: str
    body: str  # HTML
    link: str = ""  # its name in the navigation; "": the title


@dataclass
class Made:
    """The origin of a page."""

    commit: str
    date: str
    machine: str
    command: str

    @property
    def html(self):
        rows = [("Made by", f"<code>{escape(self.command)}</code>" if self.command else ""),
                ("Commit", escape(self.commit)), ("Date", escape(self.date)),
                ("Machine", escape(self.machine))]
        entries = "".join(f"<dt>{name}</dt><dd>{text}</dd>" for name, text in rows if text)
        return f"<footer class='foot'><div><dl>{entries}</dl></div></footer>"


def page(title, top, parts, made, data, frames="", places="", player=True):
    """A whole page as HTML: the part above the sections, the sections, and the origin.

    `data`: what the page's scripts read (viewer/README.md). `frames`: the script elements that hold frames.
    `places`: links to other pages. The browser runs only the viewer's script, because the page's policy names
    the hashes of this script and of the style sheet. Without `player` the script is an eighth as long.
    """
    script = _viewer("viewer.js" if player else "page.js")
    links = "".join(f"<a href='#{part.name}'>{escape(part.link or part.title)}</a>" for part in parts)
    sections = "".join(f"<section aria-labelledby='{part.name}'>{heading(part.name, part.title)}\n{part.body}"
                       "</section>\n" for part in parts)
    home = "" if places else "<a class='home' href='#main'>bendlab</a>"
    return (f"{_head(title, [script], live=bool(data.get('live')))}<body>\n<a class='skip' href='#main'>Skip "
            f"to the content</a>\n{places}<header class='bar'><div>{home}<nav "
            f"aria-label='Sections'>{links}</nav></div></header>\n<main id='main'>\n{top}\n{sections}</main>"
            f"\n{made.html}\n<script type='application/json' id='bendlab-data'>{json_text(data)}</script>\n"
            f"{frames}\n<script>{script}</script></body></html>\n")


def heading(name, title, level=2):
    """A heading with an address, and a link to this address."""
    anchor = f"<a class='anchor' href='#{name}' aria-label='Address of this section'>#</a>"
    return f"<h{level} id='{name}'>{escape(title)}{anchor}</h{level}>"


def json_text(data):
    """JSON for the inside of a script element: no text in the JSON can end the element."""
    text = json.dumps(data, ensure_ascii=False, separators=(",", ":"), allow_nan=False)
    for character in "<>&\u2028\u2029":
        text = text.replace(character, f"\\u{ord(character):04x}")
    return text


def _head(title, scripts, live=False):
    sheet = _viewer("viewer.css")
    hashes = lambda texts: " ".join(_hash(text) for text in texts) or "'none'"
    connect = "'self'" if live else "'none'"
    policy = (f"default-src 'none'; script-src {hashes(scripts)}; style-src {hashes([sheet])}; connect-src "
              f"{connect}; img-src 'self' file: data: blob:; media-src blob:; base-uri 'none'; form-action "
              "'none'")
    return HEAD.format(policy=policy, title=escape(title), style=sheet)


def _hash(text):
    """The hash of a script or style sheet, as a page's policy names it."""
    return "'sha256-" + base64.b64encode(hashlib.sha256(text.encode()).digest()).decode() + "'"


@lru_cache(maxsize=None)
def _viewer(name):
    """A file of the viewer's bundle. ValueError if a text in the file would end an HTML element early."""
    text = (VIEWER / name).read_text(encoding="utf-8")
    if "</script" in text.lower() or "</style" in text.lower() or "<!--" in text:
        raise ValueError(f"{VIEWER / name} has a text that would end its HTML element early")
    return text


def section_part(section, heading_text, everything, verdicts=(), charts=()):
    """A section as a Part: charts and pictures, verdicts (HTML), text, missing runs, tables, commands.

    `everything`: the command that repeats the page, after the commands that repeat the section's runs.
    `charts`: pairs of a chart's HTML element ("" if the element is elsewhere in the page) and the chart's
    file for print, or "".
    """
    first, rest = _beginning(section.text)
    parts = [f"<p>{escape(first)}</p>"] if first else []
    if section.missing:
        missing = "<br>".join(escape(line) for line in section.missing)
        parts.append(f"<div class='missing'>Missing:<br>{missing}</div>")
    parts += [place for place, _ in charts]
    parts += [picture_html(*picture) for picture in section.pictures]
    parts += verdicts
    prints = [file for _, file in charts if file]
    if prints:
        parts.append(folded("As a picture, for print", "".join(picture_html(file, "") for file in prints)))
    if rest:
        parts.append(folded("More on how it was measured", f"<p>{escape(rest)}</p>"))
    tables = [table_html(table) for table in section.tables if table.rows and table.caption]
    if tables:
        parts.append(folded("All numbers" if len(tables) == 1 else f"All numbers, {len(tables)} tables",
                            "".join(tables)))
    repeat = "\n".join([*section.commands, everything])
    parts.append(folded("Repeat it", f"<pre>{escape(repeat)}</pre>"))
    return Part(section.id, heading_text, "\n".join(parts), section.link)


def folded(title, body):
    """HTML that is hidden until the reader clicks on its title."""
    return f"<details><summary>{escape(title)}</summary>{body}</details>"


def picture_html(name, caption):
    """A picture with its caption."""
    return (f"<figure><img src='{escape(name)}' alt='{escape(caption)}' loading='lazy'><figcaption>"
            f"{escape(caption)}</figcaption></figure>")


def address(title):
    """The address of the section with this title, such as what-is-stable."""
    return re.sub(r"[^a-z0-9]+", "-", title.lower()).strip("-")


def _beginning(text, most=420):
    """(the first sentences of a long text, the rest)."""
    if len(text) <= 1.5 * most:
        return text, ""
    cut = text[:most].rfind(". ")
    return (text[:cut + 1], text[cut + 2:]) if cut > 0 else (text, "")


def table_html(table, opens=""):
    """A table as HTML, which the reader can sort and filter. Columns of text are left-aligned. `opens`: a
    column of run ids, whose cells open the runs."""
    columns, texts = [column for column in table.columns if column.shown], table.texts()
    if not texts:
        return ""
    raw = [[row.get(column.id) for column in columns] for row in table.rows]
    of_text = [any(isinstance(row[i], str) for row in raw) for i in range(len(columns))]
    chosen = [kind and len(texts) > MANY and 1 < len({row[i] for row in texts}) <= CHOICES
              for i, kind in enumerate(of_text)]
    head = "".join(element("th", escape(column.title),
                           class_=" ".join(filter(None, ("t" * kind, "choose" * choice))),
                           title=column.meaning)
                   for column, kind, choice in zip(columns, of_text, chosen))
    opening = [column.id == opens for column in columns]
    rows = "\n".join(element("tr", "".join(_opener(text) if opener else _cell(kind, value, text)
                                           for opener, kind, value, text in zip(opening, of_text, values,
                                                                                row)))
                     for values, row in zip(raw, texts))
    body = (element("caption", escape(table.caption)) if table.caption else "") + element(
        "thead", element("tr", head)) + element("tbody", rows)
    tall = {"tabindex": "0", "role": "region", "aria_label": table.caption} if len(texts) > MANY else {}
    table_ = element("table", body, class_="sortable", data_rows="runs" if opens else "")
    return element("div", table_, class_="scroll tall" if tall else "scroll", **tall)


def _opener(id):
    """A cell that opens a run."""
    button = element("button", escape(id[:8]), type="button", class_="opens")
    return element("td", button, class_="t", data_run=id)


def _cell(of_text, value, text):
    """A cell. If the text of a number does not sort like the number, the cell also has the value (data-v)."""
    sorts_as = value[0] if isinstance(value, (list, tuple)) and value else value
    is_plain = of_text or not isinstance(sorts_as, (int, float)) or text == str(sorts_as)
    return element("td", escape(text), class_="t" if of_text else "",
                   data_v="" if is_plain else f"{sorts_as:.9g}".replace("inf", "∞"))


def element(name, body="", **attributes):
    """An HTML element. Attributes without a value are left out. class_ means class; data_v means data-v."""
    text = "".join(f" {key.rstrip('_').replace('_', '-')}='{escape(value)}'"
                   for key, value in attributes.items() if value)
    return f"<{name}{text}>{body}</{name}>"


def escape(text):
    return html.escape(str(text), quote=True)
