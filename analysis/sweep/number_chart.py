"""A chart of two metrics or settings of a sweep's runs, for example of the error against the time."""
import difflib
import math

import numpy as np

from bendlab.results.load import group
from draw.chart_files import scale_of
from runs.axes import label_of
from runs.sweeps import is_number
from sweep.charts import CPU, about_number, described, number_of, own_looks
from tables import looks
from tables.numbers import shortened

OF_A_RUN = {"cpu_s": ("CPU time of the run", "s"), "step_cpu_s": ("CPU time of the steps", "s"),
            "wall_s": ("time of the run on the clock", "s"), "vertices": ("vertices", ""),
            "triangles": ("triangles", ""), "edge_length": ("mean edge length", "m"),
            "springs": ("springs", ""), "memory_bytes": ("memory of the solver", "B")}  # name → (label, unit)
SECTIONS = ("mesh", "solver", "bending", "material", "material/strain", "pins", "initial", "output")


def value_of(run, name):
    """The value of a run's metric, or of the setting with this pointer. NaN: the run has no such value;
    infinite: the run diverged."""
    if name.startswith("/"):
        value = run.get(name)
        return float(value) if is_number(value) else math.nan
    if name in ("cpu_s", "step_cpu_s", "wall_s"):
        return getattr(run, name) or math.nan
    return number_of(run, name)


def about(name, meanings):
    """{name, label, unit, meaning} of a metric or a setting."""
    if name.startswith("/"):
        return described(name, *meanings.setting(name), name.rsplit("/", 1)[1].replace("_", " "))
    description = about_number(name, meanings)
    if name in OF_A_RUN:
        description["label"], description["unit"] = OF_A_RUN[name]
    return description


def number_chart(sweep, axes, x, y, command, name):
    """The chart of y against x. Runs that differ only in their seeds are one point, at their median. A curve
    joins the points that differ only in the numeric axis with the most values. None if no run has x and y;
    ValueError for an unknown name."""
    runs = [run for run in sweep.runs if run.summary]
    for wanted in (x, y):
        if runs and not any(math.isfinite(value_of(run, wanted)) for run in runs):
            raise ValueError(_unknown(wanted, runs))
    axes = [axis for axis in axes if not axis.is_seed]
    along = max((axis for axis in axes if axis.numeric), key=lambda axis: len(axis.values), default=None)
    curve_axes = [axis for axis in axes if axis is not along]
    by_model = len(curve_axes) == 1 and own_looks(curve_axes[0])
    series = []
    for same_curve in group(runs, lambda run: tuple(axis.place(run) for axis in curve_axes)).values():
        points = _points(same_curve, along, x, y)
        if points:
            label = label_of(same_curve[0], curve_axes) if curve_axes else sweep.name
            look = looks.of_model(same_curve[0].model) if by_model else looks.of_place(len(series))
            xs, ys, ids, texts = map(list, zip(*points))
            series.append({"label": label, "look": look, "x": [shortened(value) for value in xs],
                           "y": {y: [shortened(value) for value in ys]}, "runs": ids, "texts": texts})
    if not series:
        return None
    about_x, about_y = about(x, sweep.meanings), about(y, sweep.meanings)
    about_x["scale"] = scale_of([value for curve in series for value in curve["x"]])
    return {"id": name, "kind": "lines", "title": f"{about_y['label']} against {about_x['label']}",
            "note": f"A curve joins runs that differ in {along.label}." if along else "",
            "texts": along.label if along else "", "x": about_x, "ys": [about_y], "choice": 0,
            "series": series, "command": command, "held": [], "limits": [], "dodge": False}


def _points(runs, along, x, y):
    """[(x, y, run ids, value as text)] for each value of an axis, sorted by x. x and y are medians over the
    runs with this value."""
    points = []
    for same_place in group(runs, lambda run: along.place(run) if along else run.id).values():
        pairs = [(value_of(run, x), value_of(run, y)) for run in same_place]
        known = [pair for pair in pairs if all(map(math.isfinite, pair))]
        if known:
            points.append((*map(float, np.median(known, axis=0)), [run.id for run in same_place],
                           along.text(same_place[0]) if along else ""))
    return sorted(points, key=lambda point: point[:2])


def _unknown(name, runs):
    if name.startswith("/"):
        return f"the setting {name} is not a number in any run"
    known = sorted({*OF_A_RUN, CPU, *(key for run in runs for key in run.summary)})
    settings = [f"/{section}/{name}" for section in SECTIONS
                if any(math.isfinite(value_of(run, f"/{section}/{name}")) for run in runs)]
    if settings:
        return f"no run has the number '{name}'; did you mean the setting {' or '.join(settings)}?"
    near = difflib.get_close_matches(name, known, 3, 0.5)
    return f"no run has the number '{name}'" + (f"; did you mean {' or '.join(near)}?" if near else
                                                f"; these are known: {', '.join(known)}")
