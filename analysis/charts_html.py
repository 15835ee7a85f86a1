"""Charts of the project's own pages: series, looks, place in a page. viewer/README.md has their shape."""
import looks
from html_parts import escape
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


def model_look(model):
    """A model's look, by the first word of its name: adaptive, n-ring at pins."""
    return looks.of_model(model.split(",")[0].split(" ")[0])


def lines(name, section, title, x, ys, some, command, **more):
    """A chart of curves. `section`: the title of its section, "" on top of the page."""
    return {"id": name, "section": section, "kind": "lines", "title": title, "x": x, "ys": ys, "choice": 0,
            "series": some, "command": command, "held": [], "limits": []} | more
