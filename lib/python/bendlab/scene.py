"""A scene, and the cloth that is made from the scene."""
import json
import sys
import warnings

import numpy as np

from bendlab import _core
from bendlab.settings import EFFECTS, METHODS, MODELS, PARTS, SCENE, Effect, Method, Model, Part, Settings, \
    add_inner, instance_of, make_class


class Mesh(add_inner(make_class("Mesh", [PARTS["/mesh"]]), "/mesh")):
    __doc__ = ("The rest mesh: Mesh(vertices, triangles) from arrays, or a generator or a file by "
               "keywords.\n\n" + make_class("Mesh", [PARTS["/mesh"]]).__doc__)

    def __init__(self, vertices=None, triangles=None, **settings):
        super().__init__(**settings)
        if (vertices is None) != (triangles is None):
            raise TypeError("a mesh from arrays needs both arrays: Mesh(vertices, triangles)")
        self._arrays = () if vertices is None else _checked(vertices, triangles)
        beside = sorted({"generator", "file", "width", "height", "cells", "diagonal", "rows", "radius",
                         "radius_top"}
                        & set(settings)) if self._arrays else []
        if beside:
            raise TypeError(f"a mesh from arrays has its own shape, and does not read {', '.join(beside)}")

    def _arguments(self):
        arrays = zip(("vertices", "triangles"), (array.tolist() for array in self._arrays))
        return {**dict(arrays), **super()._arguments()}


def _checked(vertices, triangles):
    """The arrays as (V, 3) float64 and (T, 3) int64. If an array is wrong, raises ValueError."""
    points, corners = np.asarray(vertices), np.asarray(triangles)
    for name, array, kinds, what in (("vertices", points, "fiu", "numbers"),
                                     ("triangles", corners, "iu", "whole numbers")):
        if array.ndim != 2 or array.shape[1] != 3:
            raise ValueError(f"{name} have the shape {array.shape}, expected (n, 3)")
        if array.dtype.kind not in kinds:
            raise ValueError(f"{name} are of dtype {array.dtype}, expected {what}")
    points, corners = points.astype(np.float64), corners.astype(np.int64)
    if not np.isfinite(points).all():
        raise ValueError(f"vertex {np.flatnonzero(~np.isfinite(points).all(axis=1))[0]} is not finite")
    outside = np.flatnonzero(((corners < 0) | (corners >= len(points))).any(axis=1))
    if len(outside):
        raise ValueError(f"triangle {outside[0]} is {corners[outside[0]].tolist()}, but vertices are 0 to "
                         f"{len(points) - 1}")
    return points, corners


def grid(width, height, cells, diagonal="same"):
    """A sheet of squares, each split by a diagonal: width by height (m), `cells` squares along the width."""
    return Mesh(width=width, height=height, cells=cells, diagonal=diagonal)


def _effects(value):
    if not isinstance(value, (list, tuple)):
        raise TypeError(f"expected a list of effects, got {value!r}")
    return [_effect(effect) for effect in value]


Pins = make_class("Pins", [PARTS["/pins"]])
Initial = add_inner(make_class("Initial", [PARTS["/initial"]]), "/initial")
Material = add_inner(make_class("Material", [PARTS["/material"]]), "/material")
add_inner(Model, "/bending")


def _pins(value):
    """Makes Pins from a name of a place, an index of a vertex, or a list of names and indices."""
    if isinstance(value, Pins):
        return value
    if isinstance(value, (str, int)):
        value = [value]
    if not hasattr(value, "__iter__"):
        raise TypeError(f"expected Pins(…), or a list of names and indices of vertices, got {value!r}")
    names = [entry for entry in value if isinstance(entry, str)]
    return Pins(vertices=names, indices=[entry for entry in value if not isinstance(entry, str)])


class Scene(make_class("Scene", [SCENE])):
    """All settings of a simulation. Every setting has a default: Scene() is a sheet of 1 m that hangs from a
    corner in air. `folder`: where relative paths of files start."""

    mesh = Part(instance_of(Mesh, "Mesh(…) or grid(…)"), PARTS["/mesh"].meaning)
    pins = Part(_pins, PARTS["/pins"].meaning)
    material = Part(instance_of(Material, "Material(…)"), PARTS["/material"].meaning)
    bending = Part(instance_of(Model, f"a bending model: {', '.join(MODELS)}"), "The bending model")
    solver = Part(instance_of(Method, f"a solver method: {', '.join(METHODS)}"), "The solver method")
    effects = Part(_effects, "The effects that act on the cloth besides its constraints")
    initial = Part(instance_of(Initial, "Initial(…)"), PARTS["/initial"].meaning)

    _classes = {"mesh": Mesh, "pins": Pins, "material": Material, "bending": MODELS["DiscreteShells"],
                "solver": METHODS["QuasiNewton"], "initial": Initial,
                "effects": lambda: [EFFECTS["Gravity"](), EFFECTS["ViscousDrag"]()]}

    def __init__(self, *, folder="", **settings):
        self._folder = str(folder)
        parts = {name: settings.pop(name) if name in settings else make()
                 for name, make in self._classes.items()}
        super().__init__(**settings)
        for name, value in parts.items():
            setattr(self, name, value)

    def config(self):
        """The scene as a config of `bendlab run`, without the defaults. Raises ValueError for a mesh from
        arrays, because a config cannot contain arrays; run() accepts the scene itself."""
        if self.mesh._arrays:
            raise ValueError("a config cannot contain a mesh from arrays: give run() the scene, or write the "
                             "mesh to a file and use Mesh(file=…)")
        return self._config()

    def _config(self):
        parts = {name: getattr(self, name)._config() for name in self._classes if name != "effects"}
        config = {**self._given, **{name: part for name, part in parts.items() if part}}
        if self.effects != self._classes["effects"]():
            config["effects"] = [effect._config() for effect in self.effects]
        return config

    def simulate(self):
        """The cloth of this scene, at time 0. If the scene is wrong, raises ConfigError with all problems."""
        return Cloth(self)

    def _arguments(self):
        changed = {name: getattr(self, name) for name, make in self._classes.items()
                   if getattr(self, name) != make()}
        return {**self._given, **changed, **({"folder": self._folder} if self._folder else {})}


_effect = instance_of(Effect, f"an effect: {', '.join(EFFECTS)}")


class Cloth(_core.Cloth):
    """A cloth that moves. The cloth's arrays are views. When an array is read from the cloth again, the
    numbers in earlier views change, too; copy() stores a state. Views outlive the cloth."""

    def __init__(self, scene):
        if not isinstance(scene, Scene):
            raise TypeError(f"expected a Scene, got {scene!r}")
        text = json.dumps({"name": "scene", **scene._config()})
        super().__init__(text, scene._folder, *scene.mesh._arrays)
        self.scene = scene
        for code, message in self.warnings:
            warnings.warn(f"{code}: {message}", stacklevel=3)

    @property
    def pins(self):
        """(P, 3), m: positions of the pinned vertices, in the order of `pinned`, at the end of the next step.
        To move pins, write to this array: cloth.pins[:] = … Pins move evenly during a step."""
        return super().pins

    @pins.setter
    def pins(self, positions):
        super().pins[:] = positions

    def __repr__(self):
        return f"<Cloth of {len(self.masses)} vertices at {self.time:.6g} s>"

    def run(self, seconds, progress=False):
        """Steps until `seconds` are over, or until further steps would change nothing. Ctrl-C ends this call
        between two steps. `progress`: True shows the finished share on stderr; a function is called with the
        finished share."""
        show = progress if callable(progress) else _show if progress else None
        super().run(seconds, show)
        if show is _show:
            print(file=sys.stderr)


def _show(share):
    print(f"\r{share:4.0%}", end="", file=sys.stderr, flush=True)
