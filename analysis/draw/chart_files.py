"""The charts of a report as SVG, PDF or PNG files for papers, with a file for each metric of a chart. A held
axis of a chart is a swept setting that has one value in each panel.
"""
import itertools
import re
import textwrap
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import NullLocator

from draw import style

MOST_TEXTS = 30  # a figure with more points has no texts beside its points
MOST_PANELS = 18  # with a value of a held axis each, in one file
DECADE = 10  # an axis is logarithmic if its numbers span at least this factor
SIZE = (4.4, 3.1)  # inches, of the axes with their labels
MOST_MARKS = 60  # a curve with more points is a line without marks
NO_DATE = {"pdf": {"CreationDate": None}, "svg": {"Date": None}, "png": {}}  # equal charts are equal files

plt.rcParams.update({"svg.fonttype": "none",  # texts of an SVG stay texts
                     "svg.hashsalt": "bendlab"})  # equal names in equal files


def write(charts, folder, kind):
    """Writes the charts into a folder, and returns the paths of the files."""
    folder.mkdir(parents=True, exist_ok=True)
    files = []
    for chart in charts:
        for number in [None] if chart["kind"] == "bars" else chart["ys"]:
            figure = _lines(chart, number) if number else _bars(chart)
            if figure:
                files.append(Path(folder) / f"{_name(chart, number)}.{kind}")
                figure.savefig(files[-1], bbox_inches="tight", pad_inches=0.05, facecolor="white", dpi=200,
                               metadata=NO_DATE[kind])
                plt.close(figure)
    return files


def _name(chart, number):
    """The name of a chart's file, for example `max-stretch-against-cells`."""
    sweep = re.match(r"s(\d+)-", chart["id"])
    parts = [f"sweep{sweep[1]}" if sweep and sweep[1] != "1" else "",
             f"{number['name']} against {chart['x']['label']}" if number else chart["title"]]
    return re.sub(r"[^a-zA-Z0-9]+", "-", " ".join(filter(None, parts))).strip("-")


def _titled(about):
    return about["label"] + (f" ({about['unit']})" if about.get("unit", "1") not in ("", "1") else "")


# --- curves ------------------------------------------------------------------------------------------------

def write_chart(chart, folder, name):
    """Writes a chart of a page as folder/name.png: a panel for each value of the first held axis, or for each
    metric. Returns the name of the file. Returns None and writes no file if no number is finite."""
    if chart["kind"] == "bars":
        return style.save(_bars(chart), folder, name, large=0)
    if chart["held"]:
        first, *others = chart["held"]
        panels = [(chart["ys"][0], [at, *(axis["at"] for axis in others)])
                  for at in range(len(first["values"]))]
    else:
        panels = [(number, []) for number in chart["ys"]]
    panels = [panel for panel in panels if _curves(chart, *panel)]
    if not panels:
        return None
    panels, left_out = (panels[:MOST_PANELS], panels[MOST_PANELS:]) if chart["held"] else (panels, [])
    columns = min(len(panels), 3 if len(panels) != 4 else 2)
    rows = -(-len(panels) // columns)
    band = chart["x"]["scale"] == "band"
    categories = [_categories(chart, _curves(chart, *panel)) for panel in panels]
    longest, alike = max(map(len, categories)), all(own == categories[0] for own in categories)
    tall = max(SIZE[1] * (0.5 if chart["held"] else 1), 0.6 + 0.24 * longest) if band else SIZE[1]
    figure, grid = plt.subplots(rows, columns, figsize=(SIZE[0] * columns, tall * rows), squeeze=False,
                                layout="constrained", sharey=bool(chart["held"]) and not band)
    handles = {}
    for axes, panel in itertools.zip_longest(grid.flat, panels):
        if not panel:
            axes.set_axis_off()
            continue
        _panel(axes, chart, *panel)
        axes.set_title(_held_text(chart, panel[1]), fontsize=8.5)
        if not axes.get_subplotspec().is_first_col() and (alike if band else chart["held"]):
            axes.set_ylabel("")
            axes.tick_params(labelleft=False)
        handles |= {label: handle for handle, label in zip(*axes.get_legend_handles_labels())}
    if len(handles) > 1 and chart.get("legend", True):
        figure.legend(handles.values(), handles, loc="upper left", bbox_to_anchor=(1, 0.95), fontsize=8)
    more = f" (not drawn: {len(left_out)} more values of {first['label']})" if left_out else ""
    title = textwrap.fill(chart["title"] + more, int(13 * SIZE[0] * columns))
    figure.suptitle(title, x=0.01, ha="left", fontsize=11)
    return style.save(figure, folder, name, large=0)


def _lines(chart, number):
    """A figure that shows one metric of a chart with curves. None if no curve has this metric."""
    held = [axis["at"] for axis in chart.get("held", [])]
    curves = _curves(chart, number, held)
    if not curves:
        return None
    figure, axes = plt.subplots(figsize=SIZE)
    texts = _panel(axes, chart, number, held)
    if chart["x"]["scale"] == "band":
        axes.set_ylabel(_titled(chart["x"]))
    if len(curves) > 1:
        axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1.02), fontsize=7.5, ncol=1 + (len(curves) > 18))
    axes.set_title(", ".join(filter(None, [_held_text(chart, held), texts])), fontsize=8, color=style.GREY)
    return figure


def _curves(chart, number, held):
    """(series, x, y, ranges) of each curve of a metric. `held`: index of the value of each held axis."""
    visible = [series for series in chart["series"] if number["name"] in series["y"]
               and series.get("held", []) in (held, [])]
    curves = [(series, *_known(series, number["name"])) for series in visible]
    return [curve for curve in curves if len(curve[1])]


def _panel(axes, chart, number, held):
    """Draws one metric of a chart. Returns the meaning of the texts beside the points."""
    curves, band = _curves(chart, number, held), chart["x"]["scale"] == "band"
    categories = _categories(chart, curves)
    if band:
        curves = [(series, np.array([categories.index(at) for at in x]), *rest)
                  for series, x, *rest in curves]
    for series, x, y, ranges in curves:
        _curve(axes, series, *((y, x) if band else (x, y)), ranges, band, chart.get("joined", True))
    for limit in [limit for limit in chart.get("limits", []) if limit["metric"] == number["name"]]:
        (axes.axvline if band else axes.axhline)(limit["value"], color=style.GREY, linewidth=1,
                                                 linestyle=(0, (4, 3)))
        if not band:
            axes.annotate(limit["text"], (1, limit["value"]), xycoords=axes.get_yaxis_transform(), ha="right",
                          xytext=(0, 3), textcoords="offset points", fontsize=7.5, color=style.GREY)
    values = np.concatenate([y for _, _, y, _ in curves])
    _scales(axes, chart, [x for _, x, *_ in curves], values, categories)
    axes.set_ylabel("" if band else textwrap.fill(_titled(number), 34))
    axes.set_xlabel(_titled(number if band else chart["x"]))
    return _write_texts(axes, chart, curves)


def _known(series, name):
    """(x, y, (low, high)) of the points of a series whose x and y are finite."""
    numbers = lambda values: np.array([np.nan if value in (None, "∞", "-∞") else value for value in values],
                                      float)
    x, y = numbers(series["x"]), numbers(series["y"][name])
    known = np.isfinite(x) & np.isfinite(y)
    has_ranges = name in series.get("low", {})
    ranges = [numbers(series[end][name])[known] for end in ("low", "high")] if has_ranges else None
    return x[known], y[known], ranges


def _curve(axes, series, x, y, ranges, band, joined):
    look, only_line = series["look"], series.get("line", False)
    colour = look["light"]
    dash = (0, tuple(map(float, look["dash"].split()))) if "dash" in look else "-"
    axes.plot(x, y, color=colour, label=series["label"], linewidth=1 if only_line else 1.3,
              linestyle="none" if (band or not joined) and not only_line else dash,
              marker=look["mark"] if len(x) <= MOST_MARKS and not only_line else None, markersize=4.5,
              markeredgecolor=colour, markerfacecolor="white" if look.get("hollow") else colour)
    if ranges is not None:
        (axes.hlines if band else axes.vlines)(y if band else x, *ranges, color=colour, linewidth=0.9)


def _write_texts(axes, chart, curves):
    """Writes a text beside each point if there are few points. Returns the meaning of these texts."""
    if not chart.get("texts") or sum(len(x) for _, x, *_ in curves) > MOST_TEXTS:
        return ""
    for series, x, y, _ in curves:
        for a, b, text in zip(x, y, series["texts"]):
            axes.annotate(text, (a, b), xytext=(4, 3), textcoords="offset points", fontsize=6.5,
                          color=style.GREY)
    return f"at the points: {chart['texts']}"


def _categories(chart, curves):
    """The sorted indices of the categories in these curves. All categories if the chart has no held axis."""
    if chart["x"]["scale"] != "band":
        return []
    used = {int(at) for _, x, *_ in curves for at in x}
    return sorted(used) if chart.get("held") else list(range(len(chart["x"]["categories"])))


def _scales(axes, chart, xs, values, categories):
    """Sets scales and ticks. If the chart states no scale for y, the numbers decide."""
    x, wanted = chart["x"], chart.get("y_scale") or scale_of(values)
    band = x["scale"] == "band"
    if wanted == "log":
        style.plain_log(axes, "x" if band else "y")
    if band:
        axes.set_yticks(range(len(categories)), labels=[x["categories"][at] for at in categories])
        axes.set_ylim(len(categories) - 0.5, -0.5)
    elif x.get("ticks") and x["scale"] != "linear":
        axes.set_xscale("log")
        ticks = _apart(sorted({value for numbers in xs for value in numbers}))
        axes.set_xticks(ticks, labels=[f"{tick:,.6g}" for tick in ticks])
        axes.xaxis.set_minor_locator(NullLocator())
    elif x["scale"] in ("log", "log2"):
        style.plain_log(axes, "x")


def scale_of(values):
    """'log' if all finite numbers are positive and span a factor of DECADE; otherwise 'linear'."""
    known = [value for value in values if np.isfinite(value)]
    return "log" if known and min(known) > 0 and max(known) >= DECADE * min(known) else "linear"


def _apart(values, least=1.35):
    """The values that get a label on a logarithmic axis, so that labels do not overlap."""
    kept = []
    for value in values:
        if not kept or value >= least * kept[-1]:
            kept.append(value)
    return kept if len(kept) > 1 else sorted({*values[:1], *values[-1:]})


def _held_text(chart, held):
    """The values of the held axes. The name of an axis stands before a number."""
    values = [(axis, str(axis["values"][at])) for axis, at in zip(chart.get("held", []), held)]
    return ", ".join(f"{axis['label']} {value}"
                     if axis.get("named", value[:1].isdigit() and " " not in value) else value
                     for axis, value in values)


# --- bars --------------------------------------------------------------------------------------------------

def _bars(chart):
    rows = chart["rows"]
    figure, axes = plt.subplots(figsize=(SIZE[0], 0.6 + 0.26 * len(rows)))
    left = np.zeros(len(rows))
    for part, *values in zip(chart["parts"], *(row["values"] for row in rows)):
        if not part.get("hidden"):
            width = np.array([value if isinstance(value, (int, float)) else 0 for value in values], float)
            axes.barh(range(len(rows)), width, left=left, height=0.7, color=part["look"]["light"],
                      label=part["label"])
            left += width
    axes.set_yticks(range(len(rows)), labels=[
        row["label"] + (", ∞" if "∞" in row["values"] else "") for row in rows])
    axes.invert_yaxis()
    axes.set_title(textwrap.fill(chart["title"], 60))
    axes.grid(False, axis="y")
    axes.set_xlabel(_titled(chart["x"]))
    axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1.02), fontsize=7.5)
    return figure
