"""The charts of a report as files for papers: SVG, PDF or PNG, a file for each chart and number."""
import re
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import NullLocator

import style
from number_chart import scale_of

MOST_TEXTS = 30  # points of a figure that get a text each
SIZE = (4.4, 3.1)  # inches, of the axes with their labels
MOST_MARKS = 60  # points of a curve; one with more is a line alone
NO_DATE = {"pdf": {"CreationDate": None}, "svg": {"Date": None}, "png": {}}  # equal charts are equal files

plt.rcParams.update({"svg.fonttype": "none",  # texts of an SVG stay texts
                     "svg.hashsalt": "bendlab"})  # equal names in equal files


def write(charts, folder, kind):
    """Writes the charts into a folder; returns the files."""
    folder.mkdir(parents=True, exist_ok=True)
    files = []
    for chart in charts:
        if chart["kind"] == "bars":
            files.append(_saved(_bars(chart), folder, _name(chart), kind))
            continue
        for number in chart["ys"]:
            figure = _lines(chart, number)
            if figure:
                files.append(_saved(figure, folder, _name(chart, number), kind))
    return files


def _name(chart, number=None):
    """A file's name: what is drawn, against what."""
    sweep = re.match(r"s(\d+)-", chart["id"])
    parts = [f"sweep{sweep[1]}" if sweep and sweep[1] != "1" else "",
             f"{number['name']} against {chart['x']['label']}" if number else chart["title"]]
    return re.sub(r"[^a-zA-Z0-9]+", "-", " ".join(filter(None, parts))).strip("-")


def _saved(figure, folder, name, kind):
    file = Path(folder) / f"{name}.{kind}"
    figure.savefig(file, bbox_inches="tight", pad_inches=0.05, facecolor="white", dpi=200,
                   metadata=NO_DATE[kind])
    plt.close(figure)
    return file


def _titled(about):
    """A number's label with its unit."""
    unit = about.get("unit", "")
    return f"{about['label']} ({unit})" if unit and unit != "1" else about["label"]


# --- curves ------------------------------------------------------------------------------------------------

def _lines(chart, number):
    """A figure of one number of a chart of curves; None if no curve has it."""
    held = [each["at"] for each in chart.get("held", [])]
    shown = [each for each in chart["series"]
             if each.get("held", held) == held and number["name"] in each["y"]]
    curves = [(each, *_known(each, number["name"])) for each in shown]
    curves = [curve for curve in curves if len(curve[1])]
    if not curves:
        return None
    figure, axes = plt.subplots(figsize=SIZE)
    for each, x, y, spread in curves:
        _curve(axes, each, x, y, spread, chart["x"]["scale"] == "band")
    for limit in chart.get("limits", []):
        if limit["metric"] == number["name"]:
            axes.axhline(limit["value"], color=style.GREY, linewidth=1, linestyle=(0, (4, 3)))
            axes.annotate(limit["text"], (1, limit["value"]), xycoords=axes.get_yaxis_transform(), ha="right",
                          xytext=(0, 3), textcoords="offset points", fontsize=7.5, color=style.GREY)
    _scales(axes, chart["x"], [x for _, x, *_ in curves], [y for _, _, y, _ in curves])
    axes.set_xlabel(_titled(chart["x"]))
    axes.set_ylabel(_titled(number))
    if len(shown) > 1:
        axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1.02), fontsize=7.5, ncol=1 + (len(curves) > 18))
    texts = _write_texts(axes, chart, curves)
    axes.set_title(", ".join(filter(None, [_held_text(chart), texts])), fontsize=8, color=style.GREY)
    return figure


def _known(series, name):
    """x, y and the (low, high) of the points whose numbers are finite."""
    number = lambda value: np.nan if value in (None, "∞", "-∞") else float(value)
    x, y = (np.array([number(value) for value in values]) for values in (series["x"], series["y"][name]))
    known = np.isfinite(x) & np.isfinite(y)
    spread = None
    if "low" in series and name in series["low"]:
        ends = np.array([[number(value) for value in series[end][name]] for end in ("low", "high")])
        spread = ends[:, known]
    return x[known], y[known], spread


def _curve(axes, series, x, y, spread, band):
    look = series["look"]
    colour = look["light"]
    dash = (0, tuple(map(float, look["dash"].split()))) if "dash" in look else "-"
    axes.plot(x, y, color=colour, label=series["label"], linestyle="none" if band else dash, linewidth=1.3,
              marker=look["mark"] if len(x) <= MOST_MARKS else None, markersize=4.5, markeredgecolor=colour,
              markerfacecolor="white" if look.get("hollow") else colour)
    if spread is not None:
        axes.vlines(x, *spread, color=colour, linewidth=0.9)


def _write_texts(axes, chart, curves):
    """Writes beside each point which it is, if they are few; returns what these texts are."""
    if not chart.get("texts") or sum(len(x) for _, x, *_ in curves) > MOST_TEXTS:
        return ""
    for each, x, y, _ in curves:
        for a, b, text in zip(x, y, each["texts"]):
            axes.annotate(text, (a, b), xytext=(4, 3), textcoords="offset points", fontsize=6.5,
                          color=style.GREY)
    return f"at the points: {chart['texts']}"


def _scales(axes, x, xs, ys):
    """Scales and ticks: those of the chart along x, logarithmic along y where the numbers span decades."""
    if scale_of(np.concatenate(ys)) == "log":
        style.plain_log(axes)
    if x["scale"] == "band":
        labels = x["categories"]
        turned = sum(map(len, labels)) > 45
        axes.set_xticks(range(len(labels)), labels=labels, rotation=30 if turned else 0,
                        ha="right" if turned else "center")
        axes.set_xlim(-0.5, len(labels) - 0.5)
    elif x.get("ticks") and x["scale"] != "linear":
        axes.set_xscale("log")
        ticks = _apart(sorted({value for some in xs for value in some}))
        axes.set_xticks(ticks, labels=[f"{tick:,.6g}" for tick in ticks])
        axes.xaxis.set_minor_locator(NullLocator())
    elif x["scale"] == "log":
        style.plain_log(axes, "x")


def _apart(values, least=1.35):
    """The values of a logarithmic axis that have room for their labels."""
    kept = []
    for value in values:
        if not kept or value >= least * kept[-1]:
            kept.append(value)
    return kept


def _held_text(chart):
    """What the other axes are, "" without any."""
    return ", ".join(f"{each['label']} {each['values'][each['at']]}" for each in chart.get("held", []))


# --- bars --------------------------------------------------------------------------------------------------

def _bars(chart):
    rows = chart["rows"]
    figure, axes = plt.subplots(figsize=(SIZE[0], 0.6 + 0.26 * len(rows)))
    left = np.zeros(len(rows))
    for i, part in enumerate(chart["parts"]):
        if part.get("hidden"):
            continue
        width = np.array([row["values"][i] or 0 for row in rows], float)
        axes.barh(range(len(rows)), width, left=left, height=0.7, color=part["look"]["light"],
                  label=part["label"])
        left += width
    axes.set_yticks(range(len(rows)), labels=[row["label"] for row in rows])
    axes.invert_yaxis()
    axes.grid(False, axis="y")
    axes.set_xlabel(_titled(chart["x"]))
    axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1.02), fontsize=7.5)
    return figure
