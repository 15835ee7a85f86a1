"""The axes of a sweep for charts and tables: texts of values, label, scale, unit."""
import json
from dataclasses import dataclass, field

import numpy as np

from runs.collected import flattened
from runs.sweeps import is_number, point_key

CELLS = "/mesh/cells"


@dataclass
class Axis:
    pointer: str
    values: list
    texts: list  # of the values
    label: str
    unit: str = ""
    meaning: str = ""
    places: dict = field(default_factory=dict)  # point_key of a value → its index
    counts: bool = False  # whether its values are counts, which charts show on a logarithmic scale

    @property
    def numeric(self):
        return all(map(is_number, self.values))

    @property
    def short(self):
        """A short label."""
        return "cells" if self.pointer == CELLS else self.label

    @property
    def named(self):
        """Whether its name stands before its values, because some are numbers, yes, none or the like."""
        vague = lambda value: value in ("none", "auto") or '"' not in json.dumps(value)
        return not self.models and any(map(vague, self.values))

    @property
    def is_seed(self):
        """Whether the axis is an axis of seeds: charts show the median and the range over seeds."""
        return self.pointer.endswith("/seed")

    @property
    def models(self):
        """The bending model of every value, None if the axis is no axis of models."""
        if self.pointer == "/bending/model":
            return self.values
        if self.pointer == "/bending" and all(isinstance(v, dict) and "model" in v for v in self.values):
            return [value["model"] for value in self.values]
        return None

    @property
    def scale(self):
        """The scale of the axis in a chart: band, linear, log or log2."""
        if not self.numeric:
            return "band"
        if self.pointer == CELLS:
            return "log2"
        if self.counts:
            return "log"
        numbers = np.sort(np.array(self.values, float))
        if numbers[0] <= 0:
            return "linear"
        ratios = numbers[1:] / numbers[:-1]
        even = len(ratios) > 1 and ratios.min() >= 1.5 and np.allclose(ratios, ratios[0], rtol=0.02)
        return "log" if even or numbers[-1] / numbers[0] >= 8 else "linear"

    def place(self, run):
        """The index of the run's value on this axis; None if the axis does not apply to the run's model."""
        return self.places.get(point_key(run.point[self.pointer])) if self.pointer in run.point else None

    def text(self, run):
        place = self.place(run)
        return "" if place is None else self.texts[place]


def axes_of(sweep):
    """(axes of a sweep with more than one value, axes with one value)."""
    axes = [_axis(pointer, values, sweep) for pointer, values in sweep.axes.items() if values]
    return [axis for axis in axes if len(axis.values) > 1], [axis for axis in axes if len(axis.values) == 1]


def by_vertices(sweep, axis):
    """An axis of numbers of vertices, if `axis` has meshes with different numbers; otherwise `axis`."""
    if not axis.pointer.startswith("/mesh") or axis.pointer == CELLS or axis.is_seed:
        return axis
    counts = [{run.summary["vertices"] for run in sweep.runs if axis.place(run) == place
               and "vertices" in run.summary} for place in range(len(axis.values))]
    if any(len(numbers) != 1 for numbers in counts) or len(set().union(*counts)) < len(counts):
        return axis
    texts = [f"{axis.short} {text}" for text in axis.texts] if axis.named else axis.texts
    return Axis(axis.pointer, [numbers.pop() for numbers in counts], texts, "vertices",
                meaning=f"of the meshes of {axis.pointer}", places=axis.places, counts=True)


def _axis(pointer, values, sweep):
    unit, meaning = sweep.meanings.setting(pointer)
    places = {point_key(value): i for i, value in enumerate(values)}
    label = "cells along the width" if pointer == CELLS else _name(pointer, sweep.axes)
    return Axis(pointer, values, _texts(values), label, unit, meaning, places)


def _name(pointer, axes):
    """The end of a pointer: as many of its last parts as needed to differ from all other axes."""
    others = [other for other in axes if other != pointer]
    parts, end = pointer.split("/")[1:], ""
    while parts and (not end or any(other.endswith(end) for other in others)):
        end = f"/{parts.pop()}{end}"
    return end[1:].replace("/", " ").replace("_", " ")


def _texts(values):
    """A short text for every value. The text of an object names the settings in which the objects differ. The
    text of a list of objects names all their types, too."""
    flat = [flattened(value) for value in values]
    keys = dict.fromkeys(key for settings in flat for key in settings)
    differ = [key for key in keys if len({json.dumps(settings.get(key)) for settings in flat}) > 1]
    texts = [_object_text(settings, differ) for settings in flat]
    return texts if len(set(texts)) == len(texts) else [json.dumps(value) for value in values]


def _object_text(flat, differ):
    if flat.get("", {}) != {}:  # not an object
        return value_text(flat[""])
    last = lambda key: key.rsplit("/", 1)[-1]
    names = [value_text(flat[key]) for key in flat
             if last(key) == "type" or (key in differ and key in ("/model", "/method"))]
    others = [f"{last(key).replace('_', ' ')} {value_text(flat[key])}" for key in differ
              if key and key in flat and last(key) != "type" and key not in ("/model", "/method")]
    return ", ".join([*names, *others]) or "as it is"


def value_text(value):
    """A value as a short text; a name stays unchanged."""
    if value is None:
        return "absent"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, (int, float)):
        return str(int(value)) if value == int(value) and abs(value) < 1e9 else f"{value:.6g}"
    if isinstance(value, str):
        return value
    if isinstance(value, list) and not any(isinstance(entry, (dict, list)) for entry in value):
        return (" " if all(map(is_number, value)) else ", ").join(map(value_text, value)) or "none"
    return json.dumps(value)


def label_of(run, axes):
    """A run's values on the axes as text: 'adaptive, cells 64'. A number stands after the axis name."""
    parts = [f"{axis.short} {axis.text(run)}" if axis.named else axis.text(run)
             for axis in sorted(axes, key=lambda axis: axis.models is None) if axis.place(run) is not None]
    return ", ".join(parts) or run.name
