"""The charts of a sweep: metrics against each axis, metrics over time, and time of each pass of a step."""
import math

import numpy as np

from tables import looks
from runs.expectations import expected_of
from bendlab.results.load import by_model, group
from tables.numbers import shortened
from runs.axes import by_vertices, label_of

FIRST = ["mean_strain", "pin_max_stretch", "max_stretch", "drop", "effective_bending_stiffness",
         "effective_membrane_stiffness", "error_physical_rms", "error_solver_rms",
         "stiffness_flexural_rigidity", "drape_coefficient", "worst_stretch",
         "kinetic_energy"]  # what most people look at, in this order
FRAME_S = 1 / 60  # simulated time for which CPU times are given
CPU = "ms_per_frame"
MOST_NUMBERS, MOST_ROWS, MOST_TIMES, MOST_PARTS = 12, 24, 300, 4
NOT_OF_STEPS = ("recording", "set_up")  # passes outside of the steps: in the data, but hidden at first
OF_COURSE = ("vertices", "triangles", "size", "edge_length", "memory_bytes")  # chosen, not measured


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
    """A metric of a run: infinite if the run diverged, NaN if the run lacks the metric."""
    if name == CPU:
        return cpu_ms(run)
    return run.summary.get(name, math.inf if run.status == "diverged" else math.nan)


def numbers_of(sweep, most=MOST_NUMBERS):
    """[{name, label, unit, meaning}] of at most `most` metrics that vary; expected metrics come first."""
    names = {name for run in sweep.runs for name in run.summary}
    expected = [bound.metric for bound in expected_of(sweep.settings)]
    further = sorted(name for name in names if not name.startswith("rest_") and name not in OF_COURSE)
    ordered = dict.fromkeys([*expected, *FIRST, *further])
    last = {name.removesuffix("_last") for name in ordered if name.endswith("_last")}
    wanted = [name for name in ordered if name in names and (name in expected or _varies(sweep.runs, name))
              and not (name.endswith("_last") and name.removesuffix("_last") in last & names)]
    metrics = [about_number(name, sweep.meanings) for name in wanted[:most]]
    timed = any(cpu_ms(run) > 0 for run in sweep.runs)
    return [*metrics, about_number(CPU, sweep.meanings)] if timed else metrics


def about_number(name, meanings):
    if name == CPU:
        return {"name": CPU, "label": "CPU time per frame", "unit": "ms",
                "meaning": "CPU time of the steps for 1/60 s of simulated time"}
    unit, meaning = meanings.number(name)
    return {"name": name, "label": name.replace("_", " "), "unit": unit, "meaning": meaning}


def _varies(runs, name):
    values = {run.summary[name] for run in runs if name in run.summary}
    return len(runs) == 1 or len(values) > 1


# --- against an axis ---------------------------------------------------------------------------------------

def axis_charts(sweep, axes, numbers, command, prefix):
    """A chart for every axis except axes of seeds: medians and ranges over seeds."""
    if not numbers:
        return []
    wanted = [axis for axis in axes if not axis.is_seed]
    wanted = [by_vertices(sweep, axis) for axis in wanted]
    ordered = sorted(wanted, key=lambda axis: (axis.scale == "band", axis.pointer != "/mesh/cells"))
    charts = [_axis_chart(sweep, axis, wanted, numbers, command, f"{prefix}against-{i + 1}")
              for i, axis in enumerate(ordered)]
    return [chart for chart in charts if chart["series"]]


def _axis_chart(sweep, axis, axes, numbers, command, name):
    other_axes = [other for other in axes if other is not axis]
    curves = _curve_axis(other_axes)
    held = [other for other in other_axes if other is not curves]
    series = []
    for key, runs in group(sweep.runs, lambda run: tuple(other.place(run) for other in other_axes)).items():
        places = dict(zip([other.pointer for other in other_axes], key))
        points = _series(runs, axis, numbers)
        if not points:
            continue
        place = places[curves.pointer] if curves else None
        label, look = _curve_name(curves, place, sweep)
        series.append({"label": label, "look": look, "held": [places[other.pointer] for other in held],
                       "order": -1 if place is None else place, **points})
    series.sort(key=lambda curve: curve.pop("order"))
    if axis.models and len({curve["label"] for curve in series}) == 1:
        series = [part for curve in series for part in _by_model(curve, axis)]
    seeds = {run.point[pointer] for run in sweep.runs for pointer in run.point if pointer.endswith("/seed")}
    spread = f"Median and range over {len(seeds)} seeds." if len(seeds) > 1 else ""
    x = {"name": axis.pointer, "label": axis.label, "unit": "" if axis.unit == "1" else axis.unit,
         "scale": axis.scale}
    x |= {"categories": axis.texts} if axis.scale == "band" else {"ticks": axis.values}
    return {"id": name, "kind": "lines", "title": f"Against {axis.label}", "note": spread, "x": x,
            "ys": numbers, "choice": 0, "series": series, "command": command,
            "limits": _limits(sweep), **({"legend": False, "dodge": False} if axis.models and len(series) > 1
                                         and all(len(curve["x"]) == 1 for curve in series) else {}),
            "held": [{"name": other.pointer, "label": other.label, "values": other.texts,
                      "at": _middle(sweep.runs, other)} for other in held]}


def _curve_axis(axes):
    """The axis with a curve for each value: the axis of models, or else the axis with fewest values."""
    models = [axis for axis in axes if axis.models]
    return (models or sorted(axes, key=lambda axis: (len(axis.values) > 12, len(axis.values))) or [None])[0]


def _curve_name(axis, place, sweep):
    if axis is None or place is None:
        models = list(by_model([run for run in sweep.runs if run.config]))
        return sweep.name, looks.of_model(models[0]) if len(models) == 1 else looks.of_place(0)
    look = looks.of_model(axis.models[place]) if axis.models and _own_looks(axis) else looks.of_place(place)
    text = axis.texts[place]
    return (text if axis.scale == "band" or axis.counts else f"{axis.short} {text}"), look


def _own_looks(axis):
    """Whether all values of an axis of models are different models, which have different colours."""
    return len(set(axis.models)) == len(axis.models)


def _by_model(series, axis):
    """One series per point, in the colour and marker of the point's model."""
    for i, place in enumerate(series["x"]):
        at = lambda numbers: {name: [values[i]] for name, values in numbers.items()}
        look = looks.of_model(axis.models[place]) if _own_looks(axis) else looks.of_place(place)
        yield series | {"label": axis.texts[place], "look": look, "x": [place], "runs": [series["runs"][i]],
                        "y": at(series["y"]), **({"low": at(series["low"]), "high": at(series["high"])}
                                                 if "low" in series else {})}


def _series(runs, axis, numbers):
    """The values of an axis with their runs and metrics; None without any runs."""
    at = {place: same_place for place, same_place in sorted(group(
        [run for run in runs if axis.place(run) is not None], axis.place).items()) if any(
            run.summary or run.status == "diverged" for run in same_place)}
    if not at:
        return None
    points = {"x": [place if axis.scale == "band" else axis.values[place] for place in at],
              "runs": [[run.id for run in same_place] for same_place in at.values()], "y": {}}
    if axis.scale != "band":
        order = np.argsort(points["x"], kind="stable")
    else:
        order = np.arange(len(points["x"]))
    points["x"] = [points["x"][i] for i in order]
    points["runs"] = [points["runs"][i] for i in order]
    several = any(len(same_place) > 1 for same_place in at.values())
    if several:
        points |= {"low": {}, "high": {}}
    groups = [list(at.values())[i] for i in order]
    for number in numbers:
        spreads = [_spread([number_of(run, number["name"]) for run in same_place]) for same_place in groups]
        for part, place in (("y", 0), ("low", 1), ("high", 2)) if several else (("y", 0),):
            points[part][number["name"]] = [shortened(entry[place]) for entry in spreads]
    return points


def _spread(numbers):
    """(median, lowest, highest) of the known numbers."""
    known = np.array([number for number in numbers if not math.isnan(number)])
    if not len(known):
        return math.nan, math.nan, math.nan
    with np.errstate(invalid="ignore"):
        return float(np.median(known)), float(known.min()), float(known.max())


def _middle(runs, axis):
    """The index of the value of the axis that most runs have. Ties go to the middle index."""
    places = [axis.place(run) for run in runs if axis.place(run) is not None]
    counts = np.bincount(places, minlength=len(axis.values)) if places else np.zeros(1, int)
    most = np.flatnonzero(counts == counts.max())
    return int(most[len(most) // 2] if axis.numeric else most[0])


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
    series, names = [], []
    for run in runs:
        times = run.metrics["time"] if run.frames else []
        if len(times) < 2:
            continue
        every = np.unique(np.linspace(0, len(times) - 1, MOST_TIMES).round().astype(int))
        own = [metric for metric in [*TIMES, *sorted(m for m in run.metrics if m not in TIMES)]
               if metric in run.metrics and metric != "time" and not _is_quality(metric)][:MOST_NUMBERS]
        names += [metric for metric in own if metric not in names]
        series.append({"label": labels[run.id], "look": run_looks[run.id], "run": run.id,
                       "x": [shortened(float(t)) for t in times[every]],
                       "y": {metric: [shortened(float(v), 4) for v in run.metrics[metric][every]]
                             for metric in own}})
    if not series:
        return None
    first = next(run for run in runs if run.id == series[0]["run"])
    about = {}
    for metric in names:
        run = next(run for run in [first, *runs] if metric in run.metrics)
        unit, meaning = run.metrics.about(metric)
        about[metric] = {"name": metric, "label": metric.replace("_", " "), "unit": unit, "meaning": meaning}
    changing = [about[metric] for metric in names if metric not in series[0]["y"] or _moves(series, metric)]
    return {"id": name, "kind": "lines", "title": "Over time",
            "x": {"name": "time", "label": "time", "unit": "s", "scale": "linear"},
            "ys": changing or list(about.values()), "choice": 0, "series": series, "command": command,
            "dodge": False}


def _is_quality(metric):
    return metric.endswith(("_minimum", "_maximum", "_median", "_percentile_1", "_percentile_99")) \
        or metric in ("caps", "collinear", "needles", "small_angles")


def _moves(series, metric):
    return len({value for curve in series for value in curve["y"].get(metric, [])}) > 1


def pass_chart(sweep, axes, command, name):
    """Time per pass (a part of a step), a bar per run. Bars are medians over seeds, and if there are too many
    bars, also over the axes with the most values."""
    runs = [run for run in sweep.runs if run.passes and simulated_s(run) > 0]
    if not runs:
        return None
    axes = [axis for axis in axes if not axis.is_seed]
    rows, kept = group(runs, lambda run: label_of(run, axes) if axes else run.id), axes
    while len(rows) > MOST_ROWS and len(kept) > 1:
        widest = max((axis for axis in kept if not axis.models), key=lambda axis: len(axis.values))
        kept = [axis for axis in kept if axis is not widest]
        rows = group(runs, lambda run: label_of(run, kept))
    left_out = max(0, len(rows) - 2 * MOST_ROWS)
    rows = dict(list(rows.items())[:2 * MOST_ROWS])
    ms = lambda run, part: 1e3 * FRAME_S * run.passes.get(part, 0.0) / simulated_s(run)
    parts = sorted({part for run in runs for part in run.passes},
                   key=lambda part: (part in NOT_OF_STEPS, -sum(ms(run, part) for run in runs)))
    values = {label: [float(np.median([ms(run, part) for run in pooled_runs])) for part in parts]
              for label, pooled_runs in rows.items()}
    of_steps = [i for i, part in enumerate(parts) if part not in NOT_OF_STEPS]
    sums = [sum(times[i] for times in values.values()) for i in range(len(parts))]
    total = sum(sums[i] for i in of_steps) or 1
    main = [i for i in of_steps if sums[i] >= 0.01 * total][:MOST_PARTS]
    rest = [i for i in of_steps if i not in main]
    besides = [i for i in range(len(parts)) if i not in of_steps]
    described = lambda i, place: {"label": parts[i].replace("_", " "), "look": looks.of_place(place)}
    described_parts = [described(i, n) for n, i in enumerate(main)]
    if rest:
        described_parts.append({"label": "others", "look": looks.of_place(6)})
    described_parts += [described(i, MOST_PARTS + n) | {"hidden": True} for n, i in enumerate(besides)]
    entries = [{"label": label if axes else pooled_runs[0].name, "runs": [run.id for run in pooled_runs][:50],
                "values": [shortened(values[label][i], 4) for i in main]
                + ([shortened(sum(values[label][i] for i in rest), 4)] if rest else [])
                + [shortened(values[label][i], 4) for i in besides]}
               for label, pooled_runs in rows.items()]
    pooled = [axis.label for axis in axes if axis not in kept]
    note = f"Medians over {', '.join(pooled)}." if pooled else ""
    if left_out:
        note += f" {left_out} more bars are left out."
    return {"id": name, "kind": "bars", "title": "Time per pass", "note": note, "command": command,
            "x": {"name": "ms", "label": "time for 1/60 s of cloth", "unit": "ms"}, "parts": described_parts,
            "rows": entries}
