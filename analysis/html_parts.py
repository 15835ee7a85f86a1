"""HTML for every page: shell with style sheet and policy, sections, tables and numbers."""
import base64
import hashlib
import html
import json
import re
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import style

MANY, CHOICES = 12, 14  # rows of a table without filters; values of a column to choose from
VIEWER = Path(__file__).resolve().parent / "viewer/dist"
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
    """Where a page is from."""

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
    """A whole page as HTML: what stands above its sections, these, and where it is from.

    `data` is what its scripts read (viewer/README.md), `frames` HTML of the scripts that hold frames,
    `places` links to other pages. Nothing in the page runs but the viewer: its policy names the hashes of the
    one script and the one style sheet. Without `player` the script is an eighth as long.
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
    """A heading with an address that shows itself beside it."""
    anchor = f"<a class='anchor' href='#{name}' aria-label='Address of this section'>#</a>"
    return f"<h{level} id='{name}'>{escape(title)}{anchor}</h{level}>"


def json_text(data):
    """JSON that can stand inside a script element, whatever its texts are."""
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
    """The name of a script or style sheet in a page's policy."""
    return "'sha256-" + base64.b64encode(hashlib.sha256(text.encode()).digest()).decode() + "'"


@lru_cache(maxsize=None)
def _viewer(name):
    """A file of the viewer's bundle. ValueError if it holds what would end its element early."""
    text = (VIEWER / name).read_text(encoding="utf-8")
    if "</script" in text.lower() or "</style" in text.lower() or "<!--" in text:
        raise ValueError(f"{VIEWER / name} cannot stand inside an HTML element")
    return text


def section_part(section, everything, verdicts=(), label="", charts=(), link="", printed=()):
    """A section as a Part: charts and pictures, verdicts (HTML), text, missing runs, tables, commands.

    The commands repeat the section's runs; `everything` is the last one and repeats the page. `printed`:
    pictures that say what a chart says.
    """
    first, rest = _beginning(section.text)
    parts = [f"<p>{escape(first)}</p>"] if first else []
    if section.missing:
        missing = "<br>".join(escape(line) for line in section.missing)
        parts.append(f"<div class='missing'>Runs that are missing:<br>{missing}</div>")
    parts += charts
    parts += [picture_html(*picture) for picture in section.pictures if picture[0] not in printed]
    parts += verdicts
    parts += [folded("As a picture, for print", picture_html(*picture)) for picture in section.pictures
              if picture[0] in printed]
    if rest:
        parts.append(folded("More on how it was measured", f"<p>{escape(rest)}</p>"))
    tables = [table_html(table) for table in section.tables if table.rows]
    if tables:
        parts.append(folded("All numbers" if len(tables) == 1 else f"All numbers, {len(tables)} tables",
                            "".join(tables)))
    repeat = "\n".join([*section.commands, everything])
    parts.append(folded("Repeat it", f"<pre>{escape(repeat)}</pre>"))
    return Part(address(section.title), f"{label}{section.title}", "\n".join(parts), link)


def folded(title, body):
    """HTML that is folded away below its title."""
    return f"<details><summary>{escape(title)}</summary>{body}</details>"


def picture_html(name, caption):
    """A picture with its caption, and the same for print."""
    return (f"<figure><img src='{escape(name)}' alt='{escape(caption)}' loading='lazy'><figcaption>"
            f"{escape(caption)}</figcaption></figure>")


def address(title):
    """A title as the address of its section: what-is-stable."""
    return re.sub(r"[^a-z0-9]+", "-", title.lower()).strip("-")


def _beginning(text, most=420):
    """(the sentences with which a long text begins, the others)."""
    if len(text) <= 1.5 * most:
        return text, ""
    cut = text[:most].rfind(". ")
    return (text[:cut + 1], text[cut + 2:]) if cut > 0 else (text, "")


def shown(value):
    if isinstance(value, (list, tuple)):
        return ", ".join(shown(entry) for entry in value)
    if isinstance(value, str):
        return escape(value)
    return str(value) if isinstance(value, int) else style.number(value)


def number_text(value, digits=3):
    """A number as text of a page: 0.00123, 1.23·10⁻⁵, − for negative ones."""
    first, _, exponent = style.number(value, digits).replace("-", "−", 1 if value < 0 else 0).partition("e")
    if not exponent:
        return first
    raised = str(int(exponent)).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))
    return f"{first}·10{raised}"


def table_html(table):
    """A table as HTML that sorts and filters; text columns are left-aligned."""
    kinds = ["t" if _is_text(table, i) else "" for i in range(len(table.columns))]
    chosen = [kind and len(table.rows) > MANY and 1 < len({row[i] for row in table.rows}) <= CHOICES
              for i, kind in enumerate(kinds)]
    head = "".join(f"<th class='{kind}{' choose' if some else ''}'>{escape(name)}</th>"
                   for kind, some, name in zip(kinds, chosen, table.columns))
    cell = lambda kind, value: f"<td{' class=t' if kind else ''}>{escape(str(value))}</td>"
    rows = "\n".join(f"<tr>{''.join(map(cell, kinds, row))}</tr>" for row in table.rows)
    caption = f"<caption>{escape(table.caption)}</caption>" if table.caption else ""
    tall = " tall' tabindex='0' role='region' aria-label='" + escape(table.caption) if len(
        table.rows) > MANY else ""
    return (f"<div class='scroll{tall}'><table class='sortable'>{caption}<thead><tr>{head}</tr></thead>"
            f"<tbody>{rows}</tbody></table></div>")


def _is_text(table, column):
    return any(isinstance(row[column], str) and not row[column][:1].isdigit()
               and row[column] not in ("–", "∞") for row in table.rows)


def escape(text):
    return html.escape(str(text), quote=True)
