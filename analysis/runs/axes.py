"""The axes of a sweep for charts and tables: texts of values, label, scale, unit."""
import json
from dataclasses import dataclass, field

import numpy as np

from runs.collected import flattened
from runs.sweeps import point_key

MESH = "/mesh"
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
        return all(is_number(value) for value in self.values)

    @property
    def short(self):
        """A short label."""
        return "cells" if self.pointer == CELLS else self.label

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
        if self.pointer not in run.point:
            return None
        return self.places.get(point_key({self.pointer: run.point[self.pointer]}))

    def text(self, run):
        place = self.place(run)
        return "" if place is None else self.texts[place]


def axes_of(sweep):
    """(axes of a sweep with more than one value, axes with one value)."""
    axes = [_axis(pointer, values, sweep) for pointer, values in sweep.axes.items() if values]
    return [axis for axis in axes if len(axis.values) > 1], [axis for axis in axes if len(axis.values) == 1]


def by_vertices(sweep, axis):
    """An axis of numbers of vertices, if `axis` has meshes with different numbers; otherwise `axis`."""
    if not axis.pointer.startswith(MESH) or axis.pointer == CELLS or axis.is_seed:
        return axis
    counts = [{run.summary["vertices"] for run in sweep.runs if axis.place(run) == place
               and "vertices" in run.summary} for place in range(len(axis.values))]
    if any(len(numbers) != 1 for numbers in counts) or len(set().union(*counts)) < len(counts):
        return axis
    texts = [f"{axis.short} {text}" for text in axis.texts] if axis.numeric else axis.texts
    return Axis(axis.pointer, [numbers.pop() for numbers in counts], texts, "vertices",
                meaning=f"of the meshes of {axis.pointer}", places=axis.places, counts=True)


def _axis(pointer, values, sweep):
    unit, meaning = sweep.meanings.setting(pointer)
    places = {point_key({pointer: value}): i for i, value in enumerate(values)}
    label = "cells along the width" if pointer == CELLS else _name(pointer, sweep.axes)
    return Axis(pointer, values, _texts(values), label, unit, meaning, places)


def _name(pointer, axes):
    """The end of a pointer: as many of its last parts as needed to differ from all other axes."""
    parts = pointer.split("/")[1:]
    for count in range(1, len(parts) + 1):
        end = parts[-count:]
        if not any(other != pointer and other.split("/")[1:][-count:] == end for other in axes):
            break
    return " ".join(end).replace("_", " ")


def _texts(values):
    """A short text for every value. The text of an object names the settings in which the objects differ."""
    if all(isinstance(value, dict) for value in values):
        flat = [flattened(value) for value in values]
        keys = dict.fromkeys(key for settings in flat for key in settings)
        differ = [key for key in keys if len({json.dumps(settings.get(key)) for settings in flat}) > 1]
        texts = [_object_text(settings, differ) for settings in flat]
    else:
        texts = [value_text(value) for value in values]
    return texts if len(set(texts)) == len(texts) else [json.dumps(value) for value in values]


def _object_text(flat, differ):
    named_first = [key for key in ("/model", "/method") if key in differ and key in flat]
    parts = [flat[key] for key in named_first]
    parts += [f"{key.rsplit('/', 1)[1].replace('_', ' ')} {value_text(flat[key])}" for key in differ
              if key in flat and key not in named_first]
    return ", ".join(parts) or "as it is"


def value_text(value):
    """A value as a short text; a name stays unchanged."""
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, (int, float)):
        return str(int(value)) if value == int(value) and abs(value) < 1e9 else f"{value:.6g}"
    if isinstance(value, str):
        return value
    if isinstance(value, list) and all(is_number(entry) for entry in value):
        return " ".join(map(value_text, value))
    return json.dumps(value)


def is_number(value):
    """Whether a value of JSON is a number."""
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def label_of(run, axes):
    """A run's values on the axes as text: 'adaptive, cells 64'. A number stands after the axis name."""
    parts = [axis.text(run) if axis.models or not axis.numeric else f"{axis.short} {axis.text(run)}"
             for axis in sorted(axes, key=lambda axis: axis.models is None) if axis.place(run) is not None]
    return ", ".join(parts) or run.name
