"""Charts of the rows of a table: the description of a chart, and the data from which pages and files draw it.

analysis/viewer/README.md describes the data of a chart.
"""
import math
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
    """The data of a chart; None if no row of its table has a number to draw. `tables`: id → Table. ValueError
    if the chart names a table, a column or a metric that does not exist."""
    if unknown := {chart.table, chart.theory} - {"", *tables}:
        raise ValueError(f"the chart {chart.id} needs the table {unknown}, but there are {', '.join(tables)}")
    table, theory = tables[chart.table], tables.get(chart.theory)
    for column in (chart.x, *chart.ys, *chart.held, *(chart.curve if chart.kind != "bars" else [])):
        table.column(column)
    if unknown := {metric for metric, *_ in chart.limits} - {*chart.ys}:
        raise ValueError(f"the chart {chart.id} has limits of {unknown}, but shows {', '.join(chart.ys)}")
    rows = [row for row in table.rows if any(shortened(row.get(y)) is not None for y in chart.ys)]
    if not rows:
        return None
    about = {"id": chart.id, "kind": chart.kind, "title": chart.title, "note": chart.note}
    x = table.column(chart.x)
    if chart.kind == "bars":
        return about | {"command": command} | _bars(chart, table, x, rows)
    about["x"] = {"name": x.id, "label": x.name, "unit": x.unit, "scale": chart.scale}
    names = _texts(x, rows) if chart.scale == "band" else []
    if names:
        about["x"]["categories"] = names
    elif chart.scale == "log2":
        about["x"]["ticks"] = sorted({row[x.id] for row in rows if _is_finite(row[x.id])})
    held = [(column, _texts(column, rows)) for column in map(table.column, chart.held)]
    place_of = lambda row: [texts.index(column.text(row)) for column, texts in held]
    by_curve = group(rows, lambda row: (_label(chart, table, row), *place_of(row)))
    curves = list(dict.fromkeys(label for label, *_ in by_curve))
    series = [{"label": label, "look": _look(chart, table, own_rows[0], curves.index(label)), "held": place}
              | _points(chart, x, names, own_rows) for (label, *place), own_rows in by_curve.items()]
    if theory:
        series += [{"label": label, "look": looks.line(), "held": []}
                   | _points(chart, x, names, own_rows) | {"line": True}
                   for label, own_rows in group(theory.rows, lambda row: _label(chart, theory, row)).items()]
    made = about | {
        "ys": [{"name": y.id, "label": y.name, "unit": y.unit or "1", "meaning": y.meaning}
               for y in map(table.column, chart.ys)],
        "choice": 0, "series": series, "command": command,
        "limits": [{"metric": y, "value": value, "text": text} for y, value, text in chart.limits],
        "joined": chart.joined,
        "held": [{"name": column.id, "label": column.name, "values": texts,
                  "at": texts.index(chart.at) if column.id == chart.held[0] and chart.at in texts
                  else len(texts) // 2} for column, texts in held]}
    if chart.y_scale:
        made["y_scale"] = chart.y_scale
    return made if chart.legend else made | {"legend": False, "dodge": False}


def _is_finite(value):
    return value is not None and math.isfinite(value)


def _bars(chart, table, x, rows):
    return {"x": {"name": "value", "label": x.meaning, "unit": x.unit, "rows": x.label},
            "parts": [{"label": table.column(y).name, "look": looks.of_place(place)}
                      for place, y in enumerate(chart.ys)],
            "rows": [{"label": x.text(row), "runs": row.get("runs", []),
                      "values": [shortened(row.get(y)) for y in chart.ys]} for row in rows]}


def _texts(column, rows):
    """The different values of a column as texts, in the order of the rows."""
    return list(dict.fromkeys(map(column.text, rows)))


def _label(chart, table, row):
    """The name of a row's curve: its values in the columns `curve`. A number follows its column's name."""
    parts = []
    for column in map(table.column, chart.curve):
        value = row.get(column.id, "")
        text = cell_text(value, column.form)
        parts.append(text if isinstance(value, str) else f"{column.name} {text}")
    return ", ".join(filter(None, parts))


def _points(chart, x, names, rows):
    """The points of a curve. `names`: the values of a band, in place of numbers."""
    if not names:
        rows = sorted((row for row in rows if _is_finite(row[x.id])), key=lambda row: row[x.id])
    of = lambda suffix: {y: [shortened(row.get(y + suffix)) for row in rows] for y in chart.ys
                         if any(y + suffix in row for row in rows)}
    made = {"y": of(""), "x": [names.index(x.text(row)) if names else shortened(row[x.id]) for row in rows]}
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
        look = looks.variant(look, alike.index(_label(chart, table, row)))
    if chart.dashed:
        values = list(dict.fromkeys(other[chart.dashed] for other in table.rows))
        look = looks.variant(look, values.index(row[chart.dashed]))
    return look
