"""HTML for every page: shell with style sheet and policy, sections, claims, tables and numbers."""
import base64
import hashlib
import html
import json
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import style
from claim_map import Place, answer_rank

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


def document(title, body):
    """A whole page as HTML: text, pictures and tables that nothing moves."""
    return _head(title, scripts=()) + f"<body class='article'><main>\n{body}\n</main></body></html>\n"


def page(title, top, parts, made, data, frames=""):
    """A whole page as HTML: what stands above its sections, these, and where it is from.

    `data` is what its scripts read (viewer/README.md), `frames` HTML of the scripts that hold frames. Nothing
    in the page runs but the viewer: its policy names the hashes of the one script and the one style sheet.
    """
    script = _viewer("viewer.js")
    links = "".join(f"<a href='#{part.name}'>{escape(part.link or part.title)}</a>" for part in parts)
    sections = "".join(f"<section aria-labelledby='{part.name}'>{heading(part.name, part.title)}\n{part.body}"
                       "</section>\n" for part in parts)
    return (f"{_head(title, [script], live=bool(data.get('live')))}<body>\n<a class='skip' href='#main'>Skip "
            "to the content</a>\n<header class='bar'><div><a class='home' href='#main'>bendlab</a><nav "
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


def mark(claim):
    if claim.holds is None:
        return "open", "no runs"
    return ("yes", "holds") if claim.holds else ("no", "does not hold")


def section_html(section, everything, label="", verdicts=()):
    """A section as HTML: heading with its label, text, missing runs, verdicts (HTML), pictures, tables,
    commands.

    The commands repeat the section's runs; `everything` is the last one and repeats the page.
    """
    parts = [f"<h2>{label}{escape(section.title)}</h2>"]
    if section.text:
        parts.append(f"<p>{escape(section.text)}</p>")
    if section.missing:
        missing = "<br>".join(escape(line) for line in section.missing)
        parts.append(f"<div class='missing'>Runs that are missing:<br>{missing}</div>")
    parts += verdicts
    parts += [f"<figure><img src='{name}' "
              f"alt='{escape(caption)}'><figcaption>{escape(caption)}</figcaption></figure>"
              for name, caption in section.pictures]
    tables = "".join(table_html(table) for table in section.tables if table.rows)
    if tables:
        parts.append(f"<details><summary>All numbers</summary>{tables}</details>")
    repeat = "\n".join([*section.commands, everything])
    parts.append(f"<details><summary>Repeat it</summary><pre>{escape(repeat)}</pre></details>")
    return "\n".join(parts)


def claim_html(claim):
    kind, verdict = mark(claim)
    if claim.setting:
        kind, verdict = "open", f"{verdict} with {claim.setting}"
    numbers = "".join(f"<tr><td class='t'>{escape(name)}</td><td>{shown(value)}</td></tr>"
                      for name, value in claim.numbers.items())
    note = f"<p>{escape(claim.note)}</p>" if claim.note else ""
    return (f"<div class='claim {kind}'><p>“{escape(claim.claim)}” <span "
            f"class='verdict'>{verdict}</span></p><table>{numbers}</table><p class='rule'>Holds if "
            f"{escape(claim.rule)}.</p>{note}</div>")


def map_mark(claim_map):
    """(class, text) of the verdict of a map: one word, and its sentence stands below it."""
    if claim_map.holds is None:
        return "open", "open"
    if isinstance(claim_map.holds, float):
        return "open", "holds in part"
    return ("yes", "holds") if claim_map.holds else ("no", "does not hold")


def map_html(claim_map):
    """The map of a claim: its sentence, what makes it true, a table of cells, and their commands."""
    kind, verdict = map_mark(claim_map)
    korean = f"<p class='korean' lang='ko'>{escape(claim_map.korean)}</p>" if claim_map.korean else ""
    note = f"<p>{escape(claim_map.note)}</p>" if claim_map.note else ""
    commands = "\n".join(_commands_text(place, cell) for place, cell in sorted(claim_map.cells.items())
                         if cell.command)
    repeat = (f"<details><summary>The commands of each cell</summary><pre>{escape(commands)}</pre></details>"
              if commands else "")
    quoted = "“{}”" if claim_map.korean else "{}"  # without the paper's sentence the claim is ours
    return (f"<div class='claim {kind}'><p>{quoted.format(escape(claim_map.english))} <span "
            f"class='verdict'>{verdict}</span></p>{korean}<p><b>{escape(claim_map.sentence)}</b></p>"
            f"<p class='rule'>A cell holds (blue) if {escape(claim_map.rule)}. Its number: "
            f"{escape(claim_map.number)}.</p>{_map_table(claim_map)}{note}{repeat}</div>")


def _commands_text(place, cell):
    setting = f"{_place_text(place)}, {cell.seeds_text}" if cell.seeds else _place_text(place)
    return "\n  ".join([setting, *cell.command.splitlines()])


def _place_text(place):
    parts = [f"m {place.rounding}"] if place.rounding else []
    return ", ".join([*parts, f"pinned: {place.pins}", f"N = {place.cells}", f"damping: {place.damping}",
                      f"substeps × iterations: {place.solver}"])


def _map_table(claim_map):
    ordered = lambda name: sorted({getattr(place, name) for place in claim_map.cells}, key=answer_rank(name))
    blocks, rows, columns, cells = map(ordered, ("rounding", "damping", "pins", "cells"))
    solvers, parts = ordered("solver"), []
    for block in blocks:
        head = "".join(f"<th class='group first' colspan={len(cells)}>{escape(pins)}</th>"
                       for pins in columns)
        numbers = "".join(f"<th{_first(i)}>{n}</th>" for _ in columns for i, n in enumerate(cells))
        body = ""
        for damping in rows:
            for i, solver in enumerate(solvers):
                name = f"<th class=t rowspan={len(solvers)}>{escape(damping)}</th>" if i == 0 else ""
                body += f"<tr>{name}<th class=t>{escape(solver)}</th>" + "".join(
                    _map_cell(claim_map.cells.get(Place(block, damping, solver, pins, n)), i)
                    for pins in columns for i, n in enumerate(cells)) + "</tr>"
        title = (f"<caption>m {escape(block)} (eq. 6 does not say how m becomes an integer)</caption>"
                 if block else "")
        parts.append(f"<div class='scroll'><table class='map'>{title}<tr><th class=t>damping</th><th "
                     f"class=t>substeps × iterations</th>{head}</tr><tr><th></th><th class=t>pinned ↑, N "
                     f"→</th>{numbers}</tr>{body}</table></div>")
    return "".join(parts)


def _first(column):
    return " class=first" if column == 0 else ""


def _map_cell(cell, column):
    first = " first" if column == 0 else ""
    if cell is None:
        return f"<td class='none{first}'>–</td>"
    kind = {True: "holds", False: "fails", None: "none"}[cell.holds]
    return (f"<td class='{kind}{first}' "
            f"title='{escape(cell.command)}'>{escape(cell.text)}</td>")


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
    """A table as HTML; text columns are left-aligned."""
    is_text = [any(isinstance(row[i], str) and not row[i][:1].isdigit() and row[i] not in ("–", "∞")
                   for row in table.rows) for i in range(len(table.columns))]
    cell = lambda tag, i, value: f"<{tag}{' class=t' if is_text[i] else ''}>{escape(str(value))}</{tag}>"
    head = "".join(cell("th", i, name) for i, name in enumerate(table.columns))
    rows = "".join("<tr>" + "".join(cell("td", i, value) for i, value in enumerate(row)) + "</tr>"
                   for row in table.rows)
    return (f"<div class='scroll'><table><caption>{escape(table.caption)}</caption>"
            f"<tr>{head}</tr>{rows}</table></div>")


def escape(text):
    return html.escape(str(text), quote=True)
