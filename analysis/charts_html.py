"""Charts of the project's own pages: series, looks, place in a page. viewer/README.md has their shape."""
import math

import looks
from html_parts import escape
from bendlab.results.load import group
from sweep_charts import shortened


def chart_html(chart, note=""):
    """The place of a chart in the page."""
    text = " ".join(part for part in (chart.get("note", ""), note) if part)
    told = f"<span>{escape(text)}</span>" if text else ""
    return (f"<figure class='chart' data-chart='{chart['id']}' id='{chart['id']}'><figcaption><b>"
            f"{escape(chart['title'])}</b>{told}</figcaption></figure>")


def placed(charts, section):
    """How section_part() shows the charts of a section."""
    return {"charts": [chart_html(chart) for chart in charts if chart["section"] == section.title],
            "printed": {name for chart in charts for name in chart.get("printed", ())}}


def number(name, label, unit="1", meaning=""):
    """A number that a chart shows."""
    return {"name": name, "label": label, "unit": unit, "meaning": meaning}


def series(label, look, x, y, **more):
    """A curve, or points; y: name of a number → values."""
    return {"label": label, "look": look, "x": [shortened(value) for value in x],
            "y": {name: [shortened(value) for value in values] for name, values in y.items()}, **more}


def model_look(name):
    """A model's look, by the first word of its name; dashed if more is said of it: adaptive, n-ring at
    pins."""
    model = name.split(",")[0]
    return looks.of_model(model) | ({"dash": "6 4"} if name != model else {})


def lines(name, section, title, x, ys, some, command, **more):
    """A chart of curves. `section`: the title of its section, "" on top of the page."""
    return {"id": name, "section": section, "kind": "lines", "title": title, "x": x, "ys": ys, "choice": 0,
            "series": some, "command": command, "held": [], "limits": []} | more


# --- of the tables of sections -----------------------------------------------------------------------------

def table_of(sections, title, caption):
    """(rows as {column: text}) of a table whose caption begins so in the section of a title; [] without."""
    for section in sections:
        for table in section.tables if section.title == title else []:
            if table.caption.startswith(caption):
                return [dict(zip(table.columns, row)) for row in table.rows]
    return []


def value(text):
    """The number that a cell of a table shows; NaN for none."""
    try:
        return float(str(text).replace(",", "").replace("−", "-"))
    except ValueError:
        return math.nan


def of_rows(rows, curve, x, ys, held, look):
    """(series, held axis) of the rows of a table: a curve per value of a column, over another one, while a
    third is held. `ys`: name of a number → its column; look(value of the curve, its place)."""
    places = list(dict.fromkeys(row[held] for row in rows))
    curves = list(dict.fromkeys(row[curve] for row in rows))
    some = []
    for (name, place), own in group(rows, lambda row: (row[curve], row[held])).items():
        own = sorted(own, key=lambda row: value(row[x]))
        some.append(series(name, look(name, curves.index(name)), [value(row[x]) for row in own],
                           {y: [value(row[column]) for row in own] for y, column in ys.items()},
                           held=[places.index(place)]))
    some.sort(key=lambda one: curves.index(one["label"]))
    return some, {"name": held, "label": held, "values": places, "at": len(places) // 2}
