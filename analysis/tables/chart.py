"""Charts of the rows of a table: the description of a chart, and the data from which pages and files draw it.

analysis/viewer/README.md describes the data of a chart.
"""
from dataclasses import dataclass, field

from bendlab.results.load import group
from tables.numbers import shortened
from tables import looks
from tables.table import cell_text


@dataclass
class Chart:
    """Curves or points of a table over the column `x`: a curve for each combination of values in the columns
    `curve`."""

    id: str
    title: str
    table: str  # the id of the table
    x: str  # a column
    ys: list  # columns of numbers to choose from
    curve: list = field(default_factory=lambda: ["model"])
    held: list = field(default_factory=list)  # columns of which one value at a time is shown
    at: str = ""  # the value of held[0] with which the page begins; "": the middle value
    scale: str = "log"  # of x: linear, log, log2 or band (the values are names)
    y_scale: str = ""  # log or linear; "": log if the numbers differ widely
    look: str = "model"  # the column that gives colours, "model" or "method"; "": by the number of the curve
    dashed: str = ""  # a column; curves with its first value are solid, curves with other values dashed
    theory: str = ""  # the id of a table with the same columns, drawn as lines without marks
    note: str = ""
    limits: list = field(default_factory=list)  # (column of ys, value, text): lines across the chart
    on_top: bool = False  # above the sections of its page
    joined: bool = True  # whether lines join the points of a curve
    legend: bool = True
    kind: str = "lines"  # or "bars": `ys` are the parts of a bar, `x` names the bars
    printed: bool = True  # whether a file for print shows it, too


def resolved(chart, tables, command):
    """The data of a chart; None if no row of its table has a number to draw. `tables`: id → Table."""
    table = tables.get(chart.table)
    rows = [row for row in table.rows
            if any(shortened(row.get(y)) is not None for y in chart.ys)] if table else []
    if not rows:
        return None
    if chart.kind == "bars":
        return _bars(chart, table, rows, command)
    x = table.column(chart.x)
    names = list(dict.fromkeys(cell_text(row[chart.x], x.form)
                               for row in rows)) if chart.scale == "band" else None
    held = [_held(table.column(id), rows) for id in chart.held]
    curves = list(dict.fromkeys(_label(chart, table, row) for row in rows))
    place_of = lambda row: [cell_text(row[id], table.column(id).form) for id in chart.held]
    by_curve = group(rows, lambda row: (_label(chart, table, row), *place_of(row)))
    series = [_series(chart, table, curves, own_rows, names,
                      [axis["texts"].index(text) for axis, text in zip(held, place)])
              for (_, *place), own_rows in by_curve.items()]
    theory = tables.get(chart.theory)
    if theory:
        series += [_series(chart, theory, [], own_rows, names, []) | {"line": True}
                   for own_rows in group(theory.rows, lambda row: _label(chart, theory, row)).values()]
    about_x = {"name": x.id, "label": x.label or x.id, "unit": x.unit, "scale": chart.scale}
    if names:
        about_x["categories"] = names
    elif chart.scale == "log2":
        about_x["ticks"] = sorted({row[chart.x] for row in rows if row[chart.x] is not None})
    ys = [{"name": id, "label": table.column(id).label or id.replace("_", " "), "unit": table.column(id).unit
           or "1",
           "meaning": table.column(id).meaning} for id in chart.ys]
    limits = [{"metric": y, "value": value, "text": text} for y, value, text in chart.limits]
    made = {"id": chart.id, "kind": "lines", "title": chart.title, "note": chart.note, "x": about_x, "ys": ys,
            "choice": 0, "series": series, "command": command, "limits": limits, "joined": chart.joined,
            "held": [{"name": axis["name"], "label": axis["label"], "values": axis["texts"],
                      "at": axis["texts"].index(chart.at) if not i and chart.at in axis["texts"]
                      else len(axis["texts"]) // 2}
                     for i, axis in enumerate(held)]}
    if chart.y_scale:
        made["y_scale"] = chart.y_scale
    if not chart.legend:
        made |= {"legend": False, "dodge": False}
    return made


def _held(column, rows):
    return {"name": column.id, "label": column.label or column.id.replace("_", " "),
            "texts": list(dict.fromkeys(cell_text(row[column.id], column.form) for row in rows))}


def _label(chart, table, row):
    """The name of a row's curve: its values in the columns `curve`. A number follows its column's name."""
    parts = []
    for column in map(table.column, chart.curve):
        value = row.get(column.id, "")
        text = cell_text(value, column.form)
        parts.append(text if isinstance(value, str) else f"{column.label or column.id} {text}")
    return ", ".join(filter(None, parts))


def _series(chart, table, curves, rows, names, held):
    x = table.column(chart.x)
    if names is None:
        rows = sorted((row for row in rows if row[chart.x] is not None), key=lambda row: row[chart.x])
    label = _label(chart, table, rows[0])
    of = lambda suffix: {y: [shortened(row.get(y + suffix)) for row in rows] for y in chart.ys
                         if any(y + suffix in row for row in rows)}
    made = {"label": label, "look": _look(chart, table, rows[0], curves.index(label)) if label in curves
            else looks.line(), "held": held, "y": of(""),
            "x": [names.index(cell_text(row[chart.x], x.form)) if names else
                                             shortened(row[chart.x]) for row in rows]}
    if any(f"{y}_low" in row for row in rows for y in chart.ys):
        made |= {"low": of("_low"), "high": of("_high")}
    if any("runs" in row for row in rows):
        made["runs"] = [row.get("runs", []) for row in rows]
    return made


def _look(chart, table, row, place):
    look = looks.of_place(place)
    if chart.look:
        look = {"model": looks.of_model, "method": looks.of_method}[chart.look](row[chart.look])
        alike = list(dict.fromkeys(_label(chart, table, other) for other in table.rows
                                   if other[chart.look] == row[chart.look]))
        look |= looks.of_variant(alike.index(_label(chart, table, row)))
    if chart.dashed:
        values = list(dict.fromkeys(other[chart.dashed] for other in table.rows))
        look |= looks.of_variant(values.index(row[chart.dashed]))
    return look


def _bars(chart, table, rows, command):
    parts = [{"label": table.column(y).label or y, "look": looks.of_place(place)} for place,
             y in enumerate(chart.ys)]
    x = table.column(chart.x)
    return {"id": chart.id, "kind": "bars", "title": chart.title, "note": chart.note, "command": command,
            "x": {"name": "value", "label": x.meaning, "unit": x.unit}, "parts": parts,
            "rows": [{"label": cell_text(row[chart.x]), "runs": row.get("runs", []),
                      "values": [shortened(row.get(y)) for y in chart.ys]} for row in rows]}
