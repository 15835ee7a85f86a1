"""Verdicts as HTML: claims, checks, maps of claims, and the data of their cells."""
from tables.claim_map import Place, answer_rank
from web.html_parts import escape, folded, table_html
from bendlab.results.load import group
from tables.table import Table, cell_text

KIND = {"yes": "holds", "no": "fails", "open": "none"}  # CSS class of a verdict → class of a status


def mark(claim):
    """(CSS class, text) of the verdict of a claim or a check."""
    if claim.holds is None:
        return "open", "no runs"
    return ("yes", "holds") if claim.holds else ("no", "does not hold")


def verdict_html(kind, text):
    return f"<span class='verdict {kind}'>{escape(text)}</span>"


def cards_html(rows):
    """A table of rows (name, text, (CSS class, text) of the verdict). On a phone, each row is a card."""
    body = "".join(f"<tr><td class='t'>{name}</td><td class='t text'>{text}</td><td class='t'>"
                   f"{verdict_html(*verdict)}</td></tr>" for name, text, verdict in rows)
    return f"<div class='scroll'><table class='overview cards'><tbody>{body}</tbody></table></div>"


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
    failed = [check for check in checks if check.holds is False]
    rest = [check for check in checks if check.holds is not False]
    kind, text = tally(checks)
    return f"<p>{verdict_html(kind, text)}</p>" + folded(
        f"All {len(checks)} checks" + (", failed checks first" if failed else ""),
        table_html(_checks_table(failed + rest)))


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
    rows = [{"check": check.check, "model": check.model, "mesh": check.mesh, "expected": check.expected,
             "measured": check.measured, "tolerance": check.bound, "verdict": mark(check)[1],
             "source": check.source,
             "note": check.note}
            for same_check in group(checks, lambda check: (check.holds is not False, check.check,
                                                           check.model)).values() for check in same_check]
    noted = ["note"] if any(check.note for check in checks) else []
    return Table.of("checks", "Checks",
                    ["check", "model", "mesh", "expected", "measured", "tolerance", "verdict",
                     "source", *noted], rows)


# --- maps --------------------------------------------------------------------------------------------------

def map_mark(claim_map):
    """(CSS class, text) of the verdict of a map: one to three words. The full sentence is below."""
    if claim_map.holds is None:
        return "open", "open"
    if isinstance(claim_map.holds, float):
        return "open", "holds in part"
    return ("yes", "holds") if claim_map.holds else ("no", "does not hold")


def map_html(claim_map, name):
    """The map of a claim as HTML: its sentence, its rule, and a table. Ids of cells begin with `name`."""
    kind, verdict = map_mark(claim_map)
    korean = f"<p class='korean' lang='ko'>{escape(claim_map.korean)}</p>" if claim_map.korean else ""
    note = f"<p>{escape(claim_map.note)}</p>" if claim_map.note else ""
    quoted = "“{}”" if claim_map.korean else "{}"  # without the paper's sentence the claim is ours
    return (f"<div class='claim {kind}'><p>{quoted.format(escape(claim_map.english))} "
            f"{verdict_html(kind, verdict)}</p>{korean}<p><b>{escape(claim_map.sentence)}</b></p>"
            f"{_map_table(claim_map, name)}<p class='rule'>The claim holds in a box "
            f"({'torn' if claim_map.of_torn else '✓'}) if "
            f"{escape(claim_map.rule)}. The number in a box: {escape(claim_map.number)}. Click a box to "
            f"see the commands that repeat it.</p>{note}</div>")


def map_cells(claim_map, name):
    """The data of the cells of a map for the page's scripts."""
    for number, (place, cell) in enumerate(sorted(claim_map.cells.items())):
        if cell.command:
            status = {True: "holds", False: "fails", None: "none"}[cell.holds]
            yield {"id": f"{name}-{number}", "title": _place_text(place), "status": status,
                   "told": cell.seeds_text if cell.seeds else "", "command": cell.command,
                   "worst": {"label": claim_map.number, "text": cell.text, "held": cell.holds,
                             "note": claim_map.rule}}


def _place_text(place):
    parts = [f"m {place.rounding}"] if place.rounding else []
    return ", ".join([*parts, f"pinned: {place.pins}", f"N = {place.cells}", f"damping: {place.damping}",
                      f"substeps × iterations: {place.solver}"])


def _map_table(claim_map, name):
    ordered = lambda name: sorted({getattr(place, name) for place in claim_map.cells}, key=answer_rank(name))
    blocks, rows, columns, cells = map(ordered, ("rounding", "damping", "pins", "cells"))
    solvers, parts = ordered("solver"), []
    numbers = {place: f"{name}-{i}" for i, place in enumerate(sorted(claim_map.cells))}
    for block in blocks:
        head = "".join(f"<th class='group first' colspan={len(cells)}>{escape(pins)}</th>"
                       for pins in columns)
        sizes = "".join(f"<th{_first(i)}>{escape(n)}</th>" for _ in columns for i, n in enumerate(cells))
        body = ""
        for damping in rows:
            for i, solver in enumerate(solvers):
                title = f"<th class=t rowspan={len(solvers)}>{escape(damping)}</th>" if i == 0 else ""
                places = [(i, Place(block, damping, solver, pins, n)) for pins in columns
                          for i, n in enumerate(cells)]
                body += f"<tr>{title}<th class=t>{escape(solver)}</th>" + "".join(
                    _map_cell(claim_map.cells.get(place), i, numbers.get(place), claim_map.of_torn)
                    for i, place in places) + "</tr>"
        title = (f"<caption>m {escape(block)} (eq. 6 does not say how m becomes an integer)</caption>"
                 if block else "")
        parts.append(f"<div class='scroll' tabindex='0' role='region' aria-label='Map'><table class='map'>"
                     f"{title}<thead><tr><th class=t>damping</th><th class=t>substeps × iterations</th>{head}"
                     f"</tr><tr><th></th><th class=t>pinned ↑, N →</th>{sizes}</tr></thead><tbody>{body}"
                     "</tbody></table></div>")
    return "".join(parts)


def _first(column):
    return " class=first" if column == 0 else ""


def _map_cell(cell, column, name, of_torn):
    first = " first" if column == 0 else ""
    if cell is None:
        return f"<td class='none{first}'>–</td>"
    good = cell.holds if not of_torn or cell.holds is None else not cell.holds
    kind = {True: "holds", False: "fails", None: "none"}[good]
    sign = {True: "", False: "torn "} if of_torn else {True: "✓ ", False: "× "}
    text = sign.get(good, "") + escape(cell.text)
    if not cell.command:
        return f"<td class='{kind}{first}'>{text}</td>"
    return (f"<td class='{kind}{first}' data-run='{name}'><button type='button' class='opens'>{text}"
            "</button></td>")
