"""HTML for every page: head with style sheet, sections, claims, tables and numbers."""
import html

import style
from claim_map import Place, answer_rank

HEAD = """<!doctype html>
<html lang="en"><head><meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>TITLE</title>
<style>
  :root { --ink: #22262b; --grey: #6d747c; --line: #e2e6ea; --yes: #00694c; --no: #a8321a; --open: #7a6000; }
  * { box-sizing: border-box }
  body { margin: 0; color: var(--ink); background: #fff;
    font: 16px/1.55 system-ui, "Segoe UI", "DejaVu Sans", sans-serif }
  main { max-width: 60rem; margin: 0 auto; padding: 3rem 1.25rem 5rem }
  h1 { font-size: 2rem; line-height: 1.2; margin: 0 0 .4rem; letter-spacing: -.01em }
  h2 { font-size: 1.35rem; margin: 3.6rem 0 .6rem; padding-top: 1.1rem; border-top: 1px solid var(--line) }
  h2 span { color: var(--grey); font-weight: 500; margin-right: .5rem }
  p { margin: .5rem 0 1rem; max-width: 46rem } .lead { color: var(--grey); font-size: 1.08rem }
  figure { margin: 1.4rem 0 } img { max-width: 100%; height: auto; display: block }
  figcaption { color: var(--grey); font-size: .88rem; margin-top: .35rem; max-width: 46rem }
  .scroll { overflow-x: auto; margin: 1rem 0 }
  table { border-collapse: collapse; font-size: .84rem; line-height: 1.35;
    font-variant-numeric: tabular-nums }
  caption { caption-side: top; text-align: left; color: var(--grey); padding: .3rem 0 .5rem }
  th, td { text-align: right; padding: .28rem .75rem .28rem 0; border-bottom: 1px solid var(--line);
    vertical-align: top }
  th { font-weight: 600; border-bottom: 1.5px solid var(--ink); vertical-align: bottom }
  th.t, td.t { text-align: left }
  .overview td { font-size: .95rem; padding: .45rem .9rem .45rem 0 }
  .overview td:first-child { white-space: nowrap }
  .claim { border-left: 4px solid var(--line); padding: .1rem 0 .1rem 1rem; margin: 1.3rem 0 }
  .claim.yes { border-color: var(--yes) } .claim.no { border-color: var(--no) }
  .claim.open { border-color: var(--open) }
  .claim p { margin: .25rem 0 } .claim .rule { color: var(--grey); font-size: .9rem }
  .claim table { margin: .5rem 0 .2rem }
  .verdict { font-weight: 650; white-space: nowrap } .yes .verdict, .verdict.yes { color: var(--yes) }
  .no .verdict, .verdict.no { color: var(--no) } .open .verdict, .verdict.open { color: var(--open) }
  .map td.holds { background: #dcebf7 } .map td.fails { background: #fbe0cc }
  .map td.none { color: var(--grey) }
  .map td, .map th { padding: .25rem .45rem; border-left: 2px solid #fff; white-space: nowrap }
  .map th.group { text-align: left; border-bottom: 1px solid var(--line) }
  .map td.first, .map th.first { border-left: 10px solid #fff }
  .korean { color: var(--grey); font-size: .92rem }
  code, pre { font: .86rem/1.5 ui-monospace, "DejaVu Sans Mono", monospace;
    background: #f5f6f8; border-radius: 4px }
  code { padding: .1rem .3rem } pre { padding: .7rem .9rem; overflow-x: auto }
  details { margin: 1rem 0 } summary { cursor: pointer; color: var(--grey); font-size: .92rem }
  .missing { background: #fff7e0; border-left: 4px solid #d9a400; padding: .5rem .9rem; font-size: .92rem }
</style></head><body><main>
"""


def document(title, body):
    """A whole page as HTML."""
    return HEAD.replace("TITLE", escape(title)) + body + "\n</main></body></html>\n"


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
