"""The charts of a sweep: metrics against each axis, metrics over time, and time of each pass of a step."""
import math
import statistics
from collections import Counter

from bendlab.results.load import by_model, group, spread
from runs.axes import by_vertices, label_of
from runs.expectations import expected_of
from tables import looks
from tables.numbers import evenly, shortened

# what most people look at, in this order
FIRST = ["mean_strain", "pin_max_stretch", "max_stretch", "drop", "effective_bending_stiffness",
         "effective_membrane_stiffness", "error_physical_rms", "error_solver_rms",
         "stiffness_flexural_rigidity", "drape_coefficient", "worst_stretch", "kinetic_energy"]
FRAME_S = 1 / 60  # simulated time for which CPU times are given
CPU = "ms_per_frame"
MOST_NUMBERS, MOST_ROWS, MOST_TIMES, MOST_PARTS = 12, 24, 300, 4
NOT_OF_STEPS = ("recording", "set_up")  # passes outside of the steps: in the data, but hidden at first
OF_COURSE = ("vertices", "triangles", "size", "edge_length", "memory_bytes")  # chosen, not measured
COUNTED = ("springs", "springs_beyond_ring_1", "bending_constraints", "pinned_vertices", "projections",
           "substeps")


def cpu_ms(run):
    """CPU time of the steps per FRAME_S of simulated time, in ms; NaN if the time is not known."""
    seconds = simulated_s(run)
    return 1e3 * FRAME_S * run.step_cpu_s / seconds if seconds > 0 and run.step_cpu_s > 0 else math.nan


def simulated_s(run):
    """Simulated time of a run, in s. Does not open the file of a run that went to its end."""
    if run.complete and not run.get("/settled_speed") and run.get("/duration"):
        return float(run.get("/duration"))
    return float(run.metrics["time"][-1]) if run.frames else 0.0


def number_of(run, name):
    """A metric of a run; NaN if the run lacks it. Metrics of the motion of a diverged run are infinite: the
    summary has their values in the frames before."""
    if name == CPU:
        return cpu_ms(run)
    at_rest = name in (*OF_COURSE, *COUNTED) or name.startswith(("rest_", "model_"))
    return math.inf if run.status == "diverged" and not at_rest else run.summary.get(name, math.nan)


def digits_of(numbers, digits):
    """The digits with which number_text() writes these numbers; whole numbers are then written exactly."""
    whole = all(number == round(number) and abs(number) < 1e5 for number in numbers if math.isfinite(number))
    return 1 if whole else digits


def numbers_of(sweep, most=MOST_NUMBERS, equal=False):
    """[{name, label, unit, meaning}] of at most `most` metrics that vary, expected metrics first, and with
    `equal` then of the other metrics."""
    names = {name for run in sweep.runs for name in run.summary}
    expected = [bound.metric for bound in expected_of(sweep.settings)]
    further = sorted(name for name in names if not name.startswith("rest_") and name not in OF_COURSE)
    ordered = dict.fromkeys([*expected, *FIRST, *further])
    twice = {f"{name}_last" for name in names}  # the value in the last frame, beside another value
    values = lambda name: {number_of(run, name) for run in sweep.runs if name in run.summary}
    varies = lambda name: name in expected or len(sweep.runs) == 1 or len(values(name)) > 1
    known = [name for name in ordered if name in names - twice]
    wanted = [*filter(varies, known), *(name for name in known if equal and not varies(name))]
    metrics = [about_number(name, sweep.meanings) for name in wanted[:most]]
    timed = any(cpu_ms(run) > 0 for run in sweep.runs)
    return [*metrics, about_number(CPU, sweep.meanings)] if timed else metrics


def about_number(name, meanings):
    if name == CPU:
        meaning = "CPU time of the steps for 1/60 s of simulated time"
        return described(CPU, "ms", meaning, "CPU time per frame")
    return described(name, *meanings.number(name))


def described(name, unit, meaning, label=""):
    """What a chart states of a metric or a setting."""
    return {"name": name, "label": label or name.replace("_", " "), "unit": unit, "meaning": meaning}


# --- against an axis ---------------------------------------------------------------------------------------

def axis_charts(sweep, axes, numbers, command, prefix):
    """A chart for every axis except axes of seeds: medians and ranges over seeds."""
    if not numbers:
        return []
    wanted = [by_vertices(sweep, axis) for axis in axes if not axis.is_seed]
    ordered = sorted(wanted, key=lambda axis: (axis.scale == "band", axis.pointer != "/mesh/cells"))
    charts = [_axis_chart(sweep, axis, wanted, numbers, command, f"{prefix}against-{i + 1}")
              for i, axis in enumerate(ordered)]
    return [chart for chart in charts if chart["series"]]


def _axis_chart(sweep, axis, axes, numbers, command, name):
    other_axes = [other for other in axes if other is not axis]
    curves = _curve_axis(other_axes)
    held = [other for other in other_axes if other is not curves]
    curve_of = lambda runs: curves.place(runs[0]) if curves else None
    same_curve = group(sweep.runs, lambda run: tuple(other.place(run) for other in other_axes)).values()
    series = []
    for runs in sorted(same_curve, key=lambda runs: -1 if curve_of(runs) is None else curve_of(runs)):
        points = _series(runs, axis, numbers)
        if points:
            label, look = _curve_name(curves, curve_of(runs), sweep)
            places = [other.place(runs[0]) for other in held]
            series.append({"label": label, "look": look, "held": places, **points})
    if axis.models and len({curve["label"] for curve in series}) == 1:
        series = [part for curve in series for part in _by_model(curve, axis)]
    most = max((len(runs) for curve in series for runs in curve["runs"]), default=1)
    note = f"Median and range over {most} runs with different seeds." if most > 1 else ""
    x = {"name": axis.pointer, "label": axis.label, "unit": "" if axis.unit == "1" else axis.unit,
         "scale": axis.scale}
    x |= {"categories": axis.texts} if axis.scale == "band" else {"ticks": axis.values}
    chart = {"id": name, "kind": "lines", "title": f"Against {axis.label}", "note": note, "x": x,
             "ys": numbers, "choice": 0, "series": series, "command": command, "limits": _limits(sweep)}
    if axis.models and len(series) > 1 and all(len(curve["x"]) == 1 for curve in series):
        chart |= {"legend": False, "dodge": False}
    first = _first_shown(series, sweep.runs, held)
    return chart | {"held": [{"name": other.pointer, "label": other.label, "values": other.texts,
                              "at": at or 0, "named": other.named} for other, at in zip(held, first)]}


def _first_shown(series, runs, held):
    """The indices of the values of the held axes with most points. Ties go to the middle values."""
    middles, points = [_middle(runs, axis) for axis in held], Counter()
    for curve in series:
        points[tuple(curve["held"])] += len(curve["x"])
    distance = lambda places: sum(abs((at or 0) - middle) for at, middle in zip(places, middles))
    return min(points, key=lambda places: (None in places, -points[places], distance(places)), default=())


def _curve_axis(axes):
    """The axis with a curve for each value: the axis of models, or else the axis with fewest values."""
    models = [axis for axis in axes if axis.models]
    return (models or sorted(axes, key=lambda axis: (len(axis.values) > 12, len(axis.values))) or [None])[0]


def _curve_name(axis, place, sweep):
    if axis is None or place is None:
        models = list(by_model([run for run in sweep.runs if run.config]))
        return sweep.name, looks.of_model(models[0]) if len(models) == 1 else looks.of_place(0)
    text = axis.texts[place]
    return f"{axis.short} {text}" if axis.named and not axis.counts else text, _look(axis, place)


def own_looks(axis):
    """Whether the values of an axis are different models, which have different colours."""
    return bool(axis.models) and len(set(axis.models)) == len(axis.models)


def _look(axis, place):
    return looks.of_model(axis.models[place]) if own_looks(axis) else looks.of_place(place)


def _by_model(series, axis):
    """One series per point, in the colour and marker of the point's model."""
    for i, place in enumerate(series["x"]):
        numbers = {part: {name: [values[i]] for name, values in series[part].items()}
                   for part in ("y", "low", "high") if part in series}
        yield series | {"label": axis.texts[place], "look": _look(axis, place), "x": [place],
                        "runs": [series["runs"][i]], **numbers}


def _series(runs, axis, numbers):
    """The values of an axis with their runs and metrics; None without any runs."""
    known = [run for run in runs if axis.place(run) is not None]
    at = {place: same_place for place, same_place in group(known, axis.place).items()
          if any(run.summary or run.status == "diverged" for run in same_place)}
    if not at:
        return None
    x = {place: place if axis.scale == "band" else axis.values[place] for place in sorted(at)}
    places = sorted(x, key=x.get)
    points = {"x": [x[place] for place in places],
              "runs": [[run.id for run in at[place]] for place in places], "y": {}}
    if any(len(same_place) > 1 for same_place in at.values()):
        points |= {"low": {}, "high": {}}
    for number in numbers:
        name = number["name"]
        values = [[number_of(run, name) + 0.0 for run in at[place]] for place in places]  # + 0.0: no -0.0
        spreads = [spread([x for x in own if not math.isnan(x)]) for own in values]
        for part, end in (("y", "median"), ("low", "low"), ("high", "high")):
            if part in points:
                points[part][name] = [shortened(getattr(own, end)) for own in spreads]
    return points


def _middle(runs, axis):
    """The index of the value of the axis that most runs have. Ties go to the middle index."""
    places = sorted(axis.place(run) for run in runs if axis.place(run) is not None)
    most = statistics.multimode(places) or [0]
    return most[len(most) // 2 if axis.numeric else 0]


def _limits(sweep):
    """The bounds in expectations that apply to every run."""
    return [{"metric": expected.metric, "value": bound, "text": f"expected {word} {bound:g}"}
            for expected in expected_of(sweep.settings) if not expected.where
            for bound, word in ((expected.minimum, "at least"), (expected.maximum, "at most"))
            if bound is not None]


# --- metrics over time, and time per pass ------------------------------------------------------------------

TIMES = ["mean_strain", "max_stretch", "pin_max_stretch", "drop", "kinetic_energy", "pin_region_stretch",
         "linear_momentum", "angular_momentum", "degenerate_triangles"]


def time_chart(runs, labels, run_looks, command, name):
    """A chart of the metrics that these runs recorded over time; None if they recorded none."""
    series, about = [], {}
    for run in runs:
        times = run.metrics["time"] if run.frames else []
        if len(times) < 2:
            continue
        every = evenly(len(times), MOST_TIMES)
        own = [metric for metric in [*TIMES, *sorted(m for m in run.metrics if m not in TIMES)]
               if metric in run.metrics and metric != "time" and not _is_quality(metric)][:MOST_NUMBERS]
        new = [metric for metric in own if metric not in about]
        about |= {metric: described(metric, *run.metrics.about(metric)) for metric in new}
        series.append({"label": labels[run.id], "look": run_looks[run.id], "run": run.id,
                       "x": [shortened(float(t)) for t in times[every]],
                       "y": {metric: [shortened(float(v), 4) for v in run.metrics[metric][every]]
                             for metric in own}})
    if not series:
        return None
    moves = lambda metric: len({value for curve in series for value in curve["y"].get(metric, [])}) > 1
    changing = [about[metric] for metric in about if metric not in series[0]["y"] or moves(metric)]
    return {"id": name, "kind": "lines", "title": "Over time",
            "x": {"name": "time", "label": "time", "unit": "s", "scale": "linear"},
            "ys": changing or list(about.values()), "choice": 0, "series": series, "command": command,
            "dodge": False}


def _is_quality(metric):
    return metric.endswith(("_minimum", "_maximum", "_median", "_percentile_1", "_percentile_99")) \
        or metric in ("caps", "collinear", "needles", "small_angles")


def pass_chart(sweep, axes, command, name):
    """Time per pass (a part of a step), a bar per run. Bars are medians over seeds, and if there are too many
    bars, also over the axes with the most values."""
    runs = [run for run in sweep.runs if run.passes and simulated_s(run) > 0]
    if not runs:
        return None
    axes = [axis for axis in axes if not axis.is_seed]
    kept, rows = axes, group(runs, lambda run: label_of(run, axes) if axes else run.id)
    while len(rows) > MOST_ROWS and len(kept) > 1:
        widest = max((axis for axis in kept if not axis.models), key=lambda axis: len(axis.values))
        kept = [axis for axis in kept if axis is not widest]
        rows = group(runs, lambda run: label_of(run, kept))
    left_out = max(0, len(rows) - 2 * MOST_ROWS)
    rows = dict(list(rows.items())[:2 * MOST_ROWS])
    ms = lambda run, part: 1e3 * FRAME_S * run.passes.get(part, 0.0) / simulated_s(run)
    parts = sorted({part for run in runs for part in run.passes},
                   key=lambda part: (part in NOT_OF_STEPS, -sum(ms(run, part) for run in runs), part))
    medians = {part: [statistics.median(ms(run, part) for run in pooled) for pooled in rows.values()]
               for part in parts}
    of_steps = [part for part in parts if part not in NOT_OF_STEPS]
    total = sum(sum(medians[part]) for part in of_steps) or 1
    main = [part for part in of_steps if sum(medians[part]) >= 0.01 * total][:MOST_PARTS]
    others = [medians[part] for part in of_steps if part not in main]
    hidden = [part for part in parts if part in NOT_OF_STEPS]
    columns = [(part, place, medians[part]) for place, part in enumerate(main)]
    if others:
        columns.append(("others", 6, [sum(values) for values in zip(*others)]))
    columns += [(part, MOST_PARTS + place, medians[part]) for place, part in enumerate(hidden)]
    bars = [{"label": part.replace("_", " "), "look": looks.of_place(place)}
            | ({"hidden": True} if part in hidden else {}) for part, place, _ in columns]
    entries = [{"label": label if axes else pooled[0].name, "runs": [run.id for run in pooled][:50],
                "values": [shortened(value, 4) for value in values]}
               for (label, pooled), values in zip(rows.items(), zip(*(values for *_, values in columns)))]
    pooled = [axis.label for axis in axes if axis not in kept]
    note = f"Medians over {', '.join(pooled)}." if pooled else ""
    if left_out:
        note += f" {left_out} more bars are left out."
    return {"id": name, "kind": "bars", "title": "Time per pass", "note": note, "command": command,
            "x": {"name": "ms", "label": "time for 1/60 s of cloth", "unit": "ms",
                  "rows": ", ".join(axis.label for axis in kept)}, "parts": bars, "rows": entries}
