"""Verdicts as HTML: claims, checks, maps of claims, and the data of their cells."""
from itertools import product

from bendlab.results.load import group
from tables.claim_map import Place, answer_rank
from tables.table import Table, cell_text
from web.html_parts import element, escape, folded, opener, scroll_table, table_html

STATUS = {True: "holds", False: "fails", None: "none"}  # whether a claim holds in a cell → CSS class


def mark(claim):
    """(CSS class, text) of the verdict of a claim or a check."""
    if claim.holds is None:
        return "open", "no runs"
    return ("yes", "holds") if claim.holds else ("no", "does not hold")


def verdict_html(kind, text):
    return element("span", escape(text), class_=f"verdict {kind}")


def cards_html(rows):
    """A table of rows (name, text, (CSS class, text) of the verdict). On a phone, each row is a card."""
    body = "".join(f"<tr><td class='t'>{name}</td><td class='t text'>{text}</td><td class='t'>"
                   f"{verdict_html(*verdict)}</td></tr>" for name, text, verdict in rows)
    return scroll_table("", body, class_="overview cards")


# --- claims and checks -------------------------------------------------------------------------------------

def claim_html(claim):
    kind, verdict = mark(claim)
    if claim.setting:
        kind, verdict = "open", f"{verdict} with {claim.setting}"
    numbers = "".join(f"<tr><td class='t'>{escape(name)}</td><td>{escape(_shown(value))}</td></tr>"
                      for name, value in claim.numbers.items())
    note = f"<p>{escape(claim.note)}</p>" if claim.note else ""
    return (f"<div class='claim {kind}'><p>“{escape(claim.claim)}” {verdict_html(kind, verdict)}</p>"
            f"<div class='scroll'><table>{numbers}</table></div><p class='rule'>Holds if "
            f"{escape(claim.rule)}.</p>{note}</div>")


def _shown(value):
    if isinstance(value, (list, tuple)):
        return ", ".join(map(_shown, value))
    return cell_text(value)


def checks_html(checks):
    """Checks as HTML: how many hold, then a folded table, which begins with the checks that do not hold."""
    if not checks:
        return ""
    first = ", failed checks first" if any(check.holds is False for check in checks) else ""
    return (f"<p>{verdict_html(*tally(checks))}</p>"
            + folded(f"All {len(checks)} checks{first}", table_html(_checks_table(checks))))


def tally(checks):
    """(CSS class, text): how many of these checks hold."""
    known = [check for check in checks if check.holds is not None]
    held = sum(check.holds for check in known)
    if not known:
        return "open", "no runs"
    without = len(checks) - len(known)
    text = f"{held} of {len(known)} checks hold" + (f", {without} without a number" if without else "")
    return "yes" if held == len(known) else "no", text


def _checks_table(checks):
    """Checks that do not hold come first, and then checks with the same name and model beside each other."""
    failed_first = sorted(checks, key=lambda check: check.holds is not False)
    alike = group(failed_first, lambda check: (check.holds is False, check.check, check.model)).values()
    rows = [{"check": check.check, "model": check.model, "mesh": check.mesh, "expected": check.expected,
             "measured": check.measured, "tolerance": check.bound, "verdict": mark(check)[1],
             "source": check.source, "note": check.note} for same_check in alike for check in same_check]
    noted = any(row["note"] for row in rows)
    return Table.of("checks", "Checks", [name for name in rows[0] if name != "note" or noted], rows)


# --- maps --------------------------------------------------------------------------------------------------

def map_mark(claim_map):
    """(CSS class, text) of the verdict of a map: one to three words. The full sentence is below."""
    if claim_map.holds in (True, False):
        return mark(claim_map)
    return "open", "open" if claim_map.holds is None else "holds in part"


def map_html(claim_map, name):
    """The map of a claim as HTML: its sentence, its rule, and a table. Ids of cells begin with `name`."""
    kind, verdict = map_mark(claim_map)
    korean = f"<p class='korean' lang='ko'>{escape(claim_map.korean)}</p>" if claim_map.korean else ""
    note = f"<p>{escape(claim_map.note)}</p>" if claim_map.note else ""
    quoted = "“{}”" if claim_map.korean else "{}"  # without the paper's sentence the claim is ours
    return (f"<div class='claim {kind}'><p>{quoted.format(escape(claim_map.english))} "
            f"{verdict_html(kind, verdict)}</p>{korean}<p><b>{escape(claim_map.sentence)}</b></p>"
            f"{_map_table(claim_map, name)}<p class='rule'>The claim holds in a box "
            f"({'torn' if claim_map.of_torn else '✓'}) if {escape(claim_map.rule)}. The number in a box: "
            f"{escape(claim_map.number)}. Click a box to see the commands that repeat it.</p>{note}</div>")


def map_cells(claim_map, name):
    """The data of the cells of a map for the page's scripts."""
    for place, id in _ids(claim_map, name).items():
        cell = claim_map.cells[place]
        if cell.command:
            yield {"id": id, "title": _place_text(place), "status": STATUS[cell.holds],
                   "outcome": cell.seeds_text if cell.seeds else "", "command": cell.command,
                   "worst": {"label": claim_map.number, "text": cell.text, "held": cell.holds,
                             "note": claim_map.rule}}


def _ids(claim_map, name):
    """Place → id of its cell."""
    return {place: f"{name}-{number}" for number, place in enumerate(sorted(claim_map.cells))}


def _place_text(place):
    rounding = f"m {place.rounding}, " if place.rounding else ""
    return (f"{rounding}pinned: {place.pins}, N = {place.cells}, damping: {place.damping}, substeps × "
            f"iterations: {place.solver}")


def _map_table(claim_map, name):
    roundings, dampings, solvers, pinned, sizes = (
        sorted({getattr(place, question) for place in claim_map.cells}, key=answer_rank(question))
        for question in ("rounding", "damping", "solver", "pins", "cells"))
    ids, columns = _ids(claim_map, name), list(product(pinned, sizes))
    first = lambda size: " first" if size == sizes[0] else ""  # the first column of what is pinned
    over = "".join(f"<th class='group first' colspan={len(sizes)}>{escape(pins)}</th>" for pins in pinned)
    below = "".join(f"<th{' class=first' if first(size) else ''}>{escape(size)}</th>" for _, size in columns)
    head = (f"<tr><th class=t>damping</th><th class=t>substeps × iterations</th>{over}</tr>"
            f"<tr><th></th><th class=t>pinned ↑, N →</th>{below}</tr>")
    tables = ""
    for rounding in roundings:
        rows = ""
        for damping, solver in product(dampings, solvers):
            title = f"<th class=t rowspan={len(solvers)}>{escape(damping)}</th>"
            title = title if solver == solvers[0] else ""  # spans the rows of all solvers
            places = [Place(rounding, damping, solver, pins, size) for pins, size in columns]
            cells = [_map_cell(claim_map, place, ids.get(place), first(place.cells)) for place in places]
            rows += f"<tr>{title}<th class=t>{escape(solver)}</th>{''.join(cells)}</tr>"
        caption = f"m {rounding} (eq. 6 does not say how m becomes an integer)" if rounding else ""
        tables += scroll_table(head, rows, "Map", caption=caption, class_="map")
    return tables


def _map_cell(claim_map, place, id, first):
    """A cell of a map. `first`: a CSS class of the first cells of each group of columns, or ""."""
    if id is None:
        return f"<td class='none{first}'>–</td>"
    cell, of_torn = claim_map.cells[place], claim_map.of_torn
    good = cell.holds if not of_torn or cell.holds is None else not cell.holds
    sign = {True: "", False: "torn "} if of_torn else {True: "✓ ", False: "× "}
    text, look = sign.get(good, "") + escape(cell.text), STATUS[good] + first
    return opener(id, text, look) if cell.command else element("td", text, class_=look)
