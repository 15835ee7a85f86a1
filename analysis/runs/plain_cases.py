"""The plain matrix (simple scenes): its varied settings, and bounds that are true for any correct cloth.

The bounds are checked on the recorded frames. The program's own verdict is not used, because the bounds test
the verdict: no run should break a bound without a warning. Lengths are in sizes: a size is the diagonal of
the rest box.
"""
import numpy as np

from bendlab.results import registry
from bendlab.results.load import method_name
from runs import repeat
from runs.fabric_laws import law_of
from runs.stability_cases import Criterion
from runs.stretch import areas, principal_stretches
from runs.sweeps import read_config

FOLDER = "plain"  # below configs/
CONFIGS = ("first", "metres", "millimetres", "millimetres_in_metres", "methods", "fabrics",
           "fabrics_map")
TWINS = ("millimetres", "millimetres_in_metres")  # the same scenes in two units

SOUND, WARNED, SILENT, ALARM = "sound", "warned", "silent", "false alarm"

FALL = 1e-3  # share of the distance that a cloth without pins falls
WAY = 0.1  # strain; woven cloth resists above a tenth (Provot 1995), cloth here is stated not to stretch
NEAR = 0.02  # sizes; allowed in addition to WAY, for the few triangles at a pin
MEAN_STRAIN = 0.1  # the same as WAY
STRETCH = 3.0  # of one triangle; at a single pinned vertex the paper's scene briefly has 2.2
# Times v0 + g t; at this limit, the energy is 16 times the energy of a free fall. The free end of a swinging
# cloth can be faster: 3.1 times for a sheet 4 m long that hangs from its top edge (symmetric sweep, mean
# strain 4e-4).
SPEED = 4.0
# Share of the scale (kinetic energy at the start plus weight times size); forward sweeps add a little energy
ENERGY = 0.02
# Share of the duration; the last step may end slightly earlier, but a run that diverges stops much earlier
UNFINISHED = 0.05
ROUNDING = 1e-6  # sizes; rounding error of a coordinate in single precision, some sizes from the origin


# The axes: a name → a function that gives the value as text, from a resolved config.

def _mesh(config):
    mesh = config["mesh"]
    kind = mesh["generator"]
    which = {"grid": "diagonal", "equilateral": "rows"}.get(kind)
    return f"{kind}, {mesh[which]}" if which else kind


def _pins(config):
    names = config["pins"]["vertices"]
    name = "corners" if len(names) > 1 else "".join(names)
    return {"": "none", "upper_right": "a corner", "top": "an edge"}.get(name, name)


def _bending(config):
    """The stiffness as text, converted to metres. On a mesh scaled by s, a config has the compliances of
    springs times s⁻² and of hinges times s⁻⁴ (configs/plain)."""
    bending, scale = config["bending"], config["mesh"]["scale"]
    if bending["stiffness"] == "physical":
        rigidity = bending.get("flexural_rigidity")
        return f"physical {rigidity / scale ** 4:g}" if rigidity else "physical, by direction"
    if bending["stiffness"] == "compliance":
        springs = bending["compliance"] * scale ** 2
        return f"compliance {springs if springs < 1 else bending['compliance'] * scale ** 4:g}"
    return f"{bending['stiffness']} {bending['k']:g}"


def _start(config):
    tilt = config["initial"]["tilt"]
    known = {0: "flat", 90: "hanging, pushed", 30: "tilted, thrown"}
    return "turning" if any(config["initial"]["spin"]) else known.get(tilt, f"tilt {tilt:g}")


NOT_READ = "not read"  # an unread setting: the run's method does not use it, and the run's config lacks it

AXES = {
    "method": lambda config: method_name(config["solver"]),
    "mesh": _mesh,
    "cells": lambda config: int(config["mesh"]["cells"]),
    "height / width": lambda config: f"{config['mesh']['height'] / config['mesh']['width']:g}",
    "pins": _pins,
    "rings pinned": lambda config: int(config["pins"]["ring"]),
    "model": lambda config: config["bending"]["model"],
    "bending": _bending,
    "bending law": law_of,
    "strain form": lambda config: config["material"]["strain"]["form"],
    "strain stiffness": lambda config: config["material"]["strain"]["stiffness"],
    "start": _start,
    "substeps × iterations": lambda config: "{substeps:g} × {iterations:g}".format(**config["solver"]),
    "order": lambda config: config["solver"].get("order", NOT_READ),
    "sweep": lambda config: config["solver"].get("sweep", NOT_READ),
    # newton and vbd always use double
    "precision": lambda config: config["solver"].get("precision", "double"),
    "units": lambda config: "m" if config["mesh"]["scale"] == 1 else "mm",
}


def settings_of(config):
    return {name: read(config) for name, read in AXES.items()}


# The bounds.

class Scene:
    """Data of a run that the bounds need: frames (F, V, 3), rest shape, loads, and velocities at the start
    (V, 3), which are 0 for pinned vertices. Lengths in m."""

    def __init__(self, run):
        self.run, self.size, self.pins = run, run.size, np.flatnonzero(run.pinned)
        self.frames, self.time = run.trajectory(), np.asarray(run.metrics["time"], float)
        self.rest, self.triangles = run.rest_positions, run.triangles
        gravity = [effect["acceleration"] for effect in run.config["effects"] if effect["type"] == "gravity"]
        self.gravity = np.array(gravity[0], float) if gravity else np.zeros(3)
        self.h = run.get("/solver/dt") / run.get("/solver/substeps")
        self.second_order = run.get("/solver/integrator") == "bdf2"
        self.mass = masses(self.rest, self.triangles)
        arm = self.frames[0] - (self.rest.min(axis=0) + self.rest.max(axis=0)) / 2
        self.velocity = run.get("/initial/velocity") + np.cross(run.get("/initial/spin"), arm)
        self.velocity[self.pins] = 0


def masses(rest, triangles):
    """(V) share of the mass at every vertex: a third of the area of its triangles."""
    mass = np.bincount(triangles.ravel(), np.repeat(areas(rest, triangles) / 3, 3), len(rest))
    return mass / mass.sum()


def bounds_of(run):
    """Every bound of a run, from its recorded frames."""
    scene = Scene(run)
    if not np.isfinite(scene.frames).all():
        count = float((~np.isfinite(scene.frames)).sum())
        return [Criterion("coordinates that are not numbers", count, 0.5, "1")]
    strain, stretch = strains(scene)
    bounds = [("time not simulated", 1 - scene.time[-1] / run.get("/duration"), UNFINISHED, "of the run"),
              ("mean strain", strain, MEAN_STRAIN, "1"), ("largest stretch", stretch, STRETCH, "1")]
    if not registry.is_prestressed(run.model) and len(scene.time) > 1:  # such springs push at once
        bounds += [("speed over v0 + g t", speed(scene), SPEED, "1"),
                   ("energy gained", energy_gain(scene), ENERGY, "of the scale")]
    if len(scene.pins):
        moved = np.linalg.norm(scene.frames[:, scene.pins] - scene.frames[0, scene.pins], axis=2).max()
        bounds += [("movement of a pin", moved / scene.size, ROUNDING, "sizes"),
                   ("beyond reach of the pins", beyond_reach(scene), NEAR, "sizes")]
    else:
        bounds.append(("distance from free fall", fall_error(scene), FALL, "of the fall"))
    return [Criterion(*bound) for bound in bounds]


def strains(scene):
    """(mean over triangles of max(|σ₁ - 1|, |σ₂ - 1|), largest σ₁); both are maxima over all frames."""
    stretches = principal_stretches(scene.rest, scene.frames, scene.triangles)
    return float(abs(stretches - 1).max(axis=0).mean(axis=1).max()), float(stretches.max())


def speed(scene):
    """Largest mean speed of a vertex between two frames, over the largest speed at the start plus g t."""
    steps = np.linalg.norm(np.diff(scene.frames, axis=0), axis=2).max(axis=1) / np.diff(scene.time)
    start = np.linalg.norm(scene.velocity, axis=1).max()
    return float((steps / (start + np.linalg.norm(scene.gravity) * scene.time[1:])).max())


def energy_gain(scene):
    """Rise of kinetic plus potential energy above the start, over the scale of energy (see ENERGY). The rise
    of all energy is at least as large: speeds between frames are means, and the elastic energy is 0 at the
    start and positive later."""
    weight = np.linalg.norm(scene.gravity)
    height = -(scene.frames @ scene.gravity) @ scene.mass
    kinetic = 0.5 * (np.diff(scene.frames, axis=0) ** 2).sum(axis=2) @ scene.mass / np.diff(scene.time) ** 2
    at_start = 0.5 * (scene.velocity ** 2).sum(axis=1) @ scene.mass
    middle = (height[1:] + height[:-1]) / 2  # height at the time of the mean speed
    return float((kinetic + middle - height[0] - at_start).max() / (at_start + weight * scene.size))


def beyond_reach(scene):
    """Largest distance of a vertex from its pin, minus (1 + WAY) times the path along edges, in sizes."""
    way, pin = ways_from(scene)
    reached = (way < np.inf) & ~scene.run.pinned
    beyond = np.linalg.norm(scene.frames - scene.frames[0][pin], axis=2) - (1 + WAY) * way
    return float(beyond[:, reached].max() / scene.size) if reached.any() else 0.0


def ways_from(scene):
    """(V) length of the shortest path along edges to a pin, and (V) index of this pin."""
    edges = scene.triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2)
    edges = np.unique(np.sort(edges, axis=1), axis=0)
    edges = np.concatenate([edges, edges[:, ::-1]])
    length = np.linalg.norm(scene.rest[edges[:, 0]] - scene.rest[edges[:, 1]], axis=1)
    way, pin = np.full(len(scene.rest), np.inf), np.full(len(scene.rest), scene.pins[0])
    way[scene.pins], pin[scene.pins] = 0, scene.pins
    while True:
        through = way[edges[:, 0]] + length
        order = np.argsort(-through, kind="stable")  # the shortest is written last
        shorter = order[through[order] < way[edges[order, 1]] * (1 - 1e-12)]
        if not len(shorter):
            return way, pin
        way[edges[shorter, 1]], pin[edges[shorter, 1]] = through[shorter], pin[edges[shorter, 0]]


def fall_error(scene):
    """Largest distance of the centre of mass from a free fall in steps of h, over the length of the fall."""
    centre = np.einsum("fvi,v->fi", scene.frames, scene.mass)
    t = scene.time[:, None]
    exact = centre[0] + t * (scene.mass @ scene.velocity)
    exact += fallen(t, scene.h, scene.second_order) * scene.gravity
    fall = 0.5 * np.linalg.norm(scene.gravity) * scene.time[-1] ** 2
    return float(np.maximum(np.linalg.norm(centre - exact, axis=1) - ROUNDING * scene.size, 0).max() / fall)


def fallen(t, h, second_order):
    """Length of a free fall from rest after time t, over g, in exact steps of h. Backward Euler falls farther
    than t² / 2 by h t / 2. BDF2 with a first step of backward Euler falls farther by up to 3/4 h²."""
    ahead = 0.75 * h ** 2 * (1 - 3.0 ** (-t / h)) if second_order else h * t / 2
    return t ** 2 / 2 + ahead


# The program's warnings.

NO_ANSWER = ("inert_seed", "units", "piece_without_pin")  # warnings that have nothing to do with these bounds


def warnings_of(run):
    """What the program reports on a run: the status implausible or diverged, or the warnings, or ""."""
    codes = dict.fromkeys(warning["code"] for warning in run.warnings if warning["code"] not in NO_ANSWER)
    return run.status if run.status in ("implausible", "diverged") else ", ".join(codes)


def verdict_of(status, bounds, warnings):
    """The verdict on a run with this status, from its bounds and from what the program reports on it."""
    if all(bound.holds for bound in bounds):
        return ALARM if status in ("implausible", "diverged") else SOUND
    return WARNED if warnings else SILENT


def judge(run, config_name):
    """A run as an object of summary.json."""
    bounds, warnings = sorted(bounds_of(run), key=lambda bound: -bound.excess), warnings_of(run)
    broken, config = [bound.name for bound in bounds if not bound.holds], f"{FOLDER}/{config_name}"
    return {"config": config_name, "settings": settings_of(run.config),
            "verdict": verdict_of(run.status, bounds, warnings), "status": run.status,
            "worst": bounds[0].as_json(), "broken": broken, "warnings": warnings, "seconds": run.cpu_s,
            "command": repeat.command(f"configs/{config}.json", run.point, read_config(config)["sweep"])}
