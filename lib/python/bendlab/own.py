"""Bending models, effects and measures that are written in Python.

A subclass of Model, Effect or Measure becomes part of bendlab as soon as Python has read the class. Scene and
run() know the class by its name in snake case ("EdgeHinge" is "edge_hinge"). If two classes have the same
name, the later class replaces the earlier class.
"""
import hashlib
import inspect
import math
import re
import sys
import uuid
from pathlib import Path
from types import SimpleNamespace

import numpy as np

from bendlab import _core


_defined = set()  # (module, name) of each class so far


class Setting:
    """A setting of your own class: power = Setting(1.0, unit="1", meaning="p of |e|^p", minimum=0). The type
    of the setting is the type of its default: bool, int, float, str, or a list of numbers."""

    def __init__(self, default, unit="", meaning="", minimum=-math.inf, maximum=math.inf, above=False):
        self.default, self.unit, self.meaning = default, unit, meaning
        self.minimum, self.maximum, self.above = minimum, maximum, above

    def row(self, name):
        kind = type(self.default)
        if kind not in (bool, int, float, str, list, tuple):
            raise TypeError(f"{name}: a setting is a bool, int, float, str or list of numbers, not "
                            f"{self.default!r}")
        if kind in (int, float) and not self.minimum <= self.default <= self.maximum:
            raise ValueError(f"{name}: the default {self.default} is outside the range from "
                             f"{self.minimum} to {self.maximum}")
        return {"name": name, "unit": self.unit, "meaning": self.meaning or name,
                "type": "list" if kind is tuple else kind.__name__, "default": self.default,
                "minimum": self.minimum, "maximum": self.maximum, "above": self.above}


def snake_name(name):
    """"EdgeHinge" → "edge_hinge"."""
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", name).lower()


def _code_of(cls):
    """A text that identifies the version of a class. If the text changes, a run is computed again. A class
    without a file (in a notebook, for example) and a class that a function makes get a new text whenever the
    class is defined."""
    functions = [member for member in vars(cls).values() if inspect.isfunction(member)]
    takes_from_outside = any(set(function.__code__.co_freevars) - {"__class__"} for function in functions)
    place = (cls.__module__, cls.__qualname__)
    is_second = place in _defined
    _defined.add(place)
    try:
        text = Path(inspect.getfile(cls)).read_bytes()
    except (TypeError, OSError):
        return uuid.uuid4().hex
    if takes_from_outside or is_second:
        return uuid.uuid4().hex
    return hashlib.sha256(text).hexdigest() + cls.__qualname__


def about(cls):
    """What the program has to know about a class."""
    summary = (inspect.getdoc(cls) or cls.__name__).split("\n\n")[0].replace("\n", " ")
    return {"name": snake_name(cls.__name__), "label": getattr(cls, "label", cls.__name__),
            "summary": summary, "source": getattr(cls, "source", ""), "code": _code_of(cls),
            "damps": getattr(cls, "damps", False), "keeps_momentum": getattr(cls, "keeps_momentum", False)}


def setting_rows(cls):
    return [setting.row(name) for name, setting in vars(cls).items() if isinstance(setting, Setting)]


# ---- bending models

class Rest:
    """The mesh at rest, for a model or a measure. Arrays: `positions` (V, 3) in m, `triangles` (T, 3),
    `pinned` (V) bool, `areas` (T) in m², and `hinges` (H, 4): for each edge between two triangles,
    the two ends of the edge, then the two vertices opposite the edge. Hinges whose vertices are all pinned
    are left out. A measure also gets `masses` (V) in kg."""

    def __init__(self, arrays):
        vars(self).update(arrays)


class Elements:
    """The elements that a model makes from a mesh. `vertices` (E, k): the vertices of each element.
    `softness` (E): is multiplied by the scene's compliance, or by 1/B if the scene states a flexural_rigidity
    B. `rest`: further arrays of the model, with E rows each; `constraint` or `energy` reads these arrays as
    members of its argument `rest`."""

    def __init__(self, vertices, softness=1.0, **rest):
        self.vertices = np.ascontiguousarray(vertices)
        if self.vertices.ndim != 2 or self.vertices.dtype.kind not in "iu":
            raise ValueError(f"vertices have the shape {self.vertices.shape} and dtype "
                             f"{self.vertices.dtype}, expected (E, k) whole numbers: the k vertices of each "
                             "element")
        count = len(self.vertices)
        softness = np.asarray(softness, float)
        if softness.shape not in ((), (count,)):
            raise ValueError(f"softness has the shape {softness.shape}, expected a number or ({count},)")
        self.softness = np.broadcast_to(softness, (count,))
        if not (np.isfinite(self.softness) & (self.softness > 0)).all():
            raise ValueError("every softness has to be a number above 0")
        self.rest = {name: np.asarray(array) for name, array in rest.items()}
        for name, array in self.rest.items():
            if len(array) != count:
                raise ValueError(f"{name} has {len(array)} rows, but there are {count} elements")

    def check(self, vertex_count):
        outside = (self.vertices < 0) | (self.vertices >= vertex_count)
        if outside.any():
            raise ValueError(f"an element has the vertex {self.vertices[outside][0]}, but vertices are 0 to "
                             f"{vertex_count - 1}")


def _evaluator(model, elements):
    """The function(which, corners) → (values, gradients) that the solver calls. It checks the shapes."""
    is_energy = hasattr(model, "energy")
    function = model.energy if is_energy else model.constraint
    name = f"{type(model).__name__}.{'energy' if is_energy else 'constraint'}"

    def evaluate(which, corners):
        rest = SimpleNamespace(**{key: array[which] for key, array in elements.rest.items()})
        result = function(corners, rest)
        if not isinstance(result, tuple) or len(result) != 2:
            raise TypeError(f"{name}() returned {type(result).__name__}, expected (values, gradients)")
        values, gradients = (np.asarray(array, float) for array in result)
        if values.shape != which.shape or gradients.shape != corners.shape:
            raise ValueError(f"{name}() returned arrays of shapes {values.shape} and {gradients.shape}, "
                             f"expected {which.shape} and {corners.shape}")
        wrong = np.isfinite(values) & ~np.isfinite(gradients).all(axis=(1, 2))
        if wrong.any():
            raise ValueError(f"{name}() returned a gradient that is not finite, of element {which[wrong][0]}")
        return values, gradients

    return evaluate


def build_elements(model, arrays):
    """(vertices, softness, evaluate, is_energy) of a model on a mesh, for the extension module."""
    elements = model.elements(Rest(arrays))
    if not isinstance(elements, Elements):
        raise TypeError(f"{type(model).__name__}.elements() returned {type(elements).__name__}, "
                        "expected Elements")
    elements.check(len(arrays["positions"]))
    return elements.vertices, elements.softness, _evaluator(model, elements), hasattr(model, "energy")


def _small_sheet():
    """An irregular sheet of 3 by 3 squares of 0.1 m: vertices (V, 3) at rest, triangles (T, 3)."""
    n = 4
    random = np.random.default_rng(1)
    x, y = np.meshgrid(np.arange(n), np.arange(n))
    vertices = np.stack([x.ravel(), y.ravel(), np.zeros(n * n)], axis=1) * 0.1
    vertices[:, :2] += random.uniform(-0.02, 0.02, (n * n, 2))
    corner = np.array([j * n + i for j in range(n - 1) for i in range(n - 1)])
    return vertices, np.concatenate([np.stack([corner, corner + 1, corner + n + 1], 1),
                                     np.stack([corner, corner + n + 1, corner + n], 1)])


def check_gradient(model):
    """Compares a model's gradients with central differences, on a sheet of 0.1 m edges whose vertices are
    moved by up to 1 cm. Raises ValueError if a gradient is wrong by more than 10⁻⁵ of the largest central
    difference."""
    vertices, triangles = _small_sheet()
    arrays = _core.rest_of(vertices, triangles.astype(np.int32))
    corners_of, _, evaluate, _ = build_elements(model, arrays)
    if len(corners_of) == 0:
        return
    moved = vertices + np.random.default_rng(2).uniform(-0.01, 0.01, vertices.shape)
    corners, which = moved[corners_of], np.arange(len(corners_of), dtype=np.int32)
    values, gradients = evaluate(which, corners.copy())
    if not (np.isfinite(values).all() and np.isfinite(gradients).all()):
        raise ValueError(f"{type(model).__name__}: a value or a gradient is not finite on a small test "
                         "sheet without flaws")
    step = 1e-6
    differences = np.empty_like(gradients)
    for corner in range(corners.shape[1]):
        for axis in range(3):
            ahead, behind = corners.copy(), corners.copy()
            ahead[:, corner, axis] += step
            behind[:, corner, axis] -= step
            differences[:, corner, axis] = (evaluate(which, ahead)[0] -
                                            evaluate(which, behind)[0]) / (2 * step)
    allowed = 1e-5 * np.abs(differences).max() + 1e-9 * np.abs(values).max()
    wrong = np.abs(gradients - differences)
    if wrong.max() <= allowed:
        moved = np.abs(gradients.sum(axis=1))
        if moved.max() > allowed:
            element = moved.max(axis=1).argmax()
            raise ValueError(f"{type(model).__name__}: the value of element {element} changes if all its "
                             "vertices move by the same vector: the gradients do not sum to zero")
        return
    element, corner, axis = np.unravel_index(wrong.argmax(), wrong.shape)
    raise ValueError(
        f"{type(model).__name__}: the returned gradient is not the gradient of the value. Element {element}, "
        f"vertex {corner} of {corners.shape[1]}, d/d{'xyz'[axis]}: returned "
        f"{gradients[element, corner, axis]:.6g}, central differences give "
        f"{differences[element, corner, axis]:.6g}")


# ---- effects

def acceleration_of(effect, x, v, t, masses):
    """The acceleration by an effect, (V, 3) in m/s², for the extension module."""
    if hasattr(effect, "acceleration"):
        acceleration = np.asarray(effect.acceleration(x, v, t), float)
        return np.broadcast_to(_checked(acceleration, x, effect, "acceleration"), x.shape)
    force = np.asarray(effect.force(x, v, t), float)
    return np.broadcast_to(_checked(force, x, effect, "force"), x.shape) / np.asarray(masses)[:, None]


def _checked(vectors, x, effect, name):
    if vectors.shape not in (x.shape, (3,)):
        raise ValueError(f"{type(effect).__name__}.{name}() returned an array of the shape {vectors.shape}, "
                         f"expected {x.shape} or (3,)")
    if not np.isfinite(vectors).all():
        raise ValueError(f"{type(effect).__name__}.{name}() returned a number that is not finite")
    return vectors


# ---- measures

class Measure:
    """Base class of your own measures. A config lists its measures in "output": {"measures": […]}.

        class Height(bl.Measure):
            '''where the cloth is'''
            columns = {"top": ("m", "largest z of the vertices")}            # metrics of every frame
            numbers = {"height": ("m", "mean z of the vertices at the end")}  # metrics of the run

            def begin(self, rest):         # may be left out; see Rest
                self.area = rest.areas.sum()

            def frame(self, x, t):         # x (V, 3) in m, t in s
                return {"top": x[:, 2].max()}

            def finish(self, x):
                return {"height": x[:, 2].mean()}

    A measure has to store what it needs in later frames in its attributes, and pickle has to be able to write
    these attributes, because a stopped run continues with them.
    """

    columns, numbers = {}, {}

    def __init_subclass__(cls, **arguments):
        super().__init_subclass__(**arguments)
        for names, method in ((cls.columns, "frame"), (cls.numbers, "finish")):
            if names and not hasattr(cls, method):
                raise TypeError(f"{cls.__name__} names metrics of {method}(), but has no method {method}()")
        cls.name = snake_name(cls.__name__)
        rows = [[(name, *texts) for name, texts in names.items()] for names in (cls.columns, cls.numbers)]
        _core.register_measure(cls, about(cls), *rows)

    def begin(self, rest):
        pass


def begin_measure(measure, arrays):
    measure.begin(Rest(arrays))


def measured_frame(measure, x, t):
    return [float(value) for value in _named(measure, "frame", measure.frame(x, t), measure.columns)]


def _named(measure, method, metrics, names):
    """The values of `metrics`, in the order of `names`."""
    if not isinstance(metrics, dict) or set(metrics) != set(names):
        raise ValueError(f"{type(measure).__name__}.{method}() returned {metrics!r}, expected a dict of "
                         f"{', '.join(names)}; None stands for a metric that could not be computed")
    return [metrics[name] for name in names]


def measured_end(measure, x):
    metrics = _named(measure, "finish", measure.finish(x), measure.numbers)
    return [None if value is None else float(value) for value in metrics]
