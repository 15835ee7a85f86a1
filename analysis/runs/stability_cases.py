"""The hard cases: their runs, the undisturbed runs for comparison, and the rules for passing."""
from dataclasses import dataclass, field, replace

import numpy as np

from bendlab.results import registry

GREEN, AMBER, RED = "green", "amber", "red"
FOLDER = "stability"  # below configs/
METHODS = "methods"  # below configs/: a part of the cases, with other solver methods
BY_NEWTON = "_newton_slow"  # end of the names of configs in that folder whose runs take long

# Lengths are in sizes (diagonals of the rest box). Reach: largest distance of a vertex from the centre.
NEAR = 0.01  # RMS distance from the rest shape; a cloth that is nearer has recovered
NOT_BACK = 0.05  # largest limit of this distance, even if the undisturbed run ends farther away
APART = 5.0  # times the reach at the start (at least a size); a cloth with a larger reach has flown apart
FAR = 2.0  # largest reach at the end; at rest it is half a size
STRAIN_FLOOR, STRAIN_CEILING = 0.01, 0.1  # range to which the undisturbed run's mean strain is clamped
ENERGY = 1e-3  # share of the energy scale
CREEP = 1e-3  # sizes; motion in the second half of ten minutes
MOMENTUM = 8  # times the random walk of rounding errors


@dataclass(frozen=True)
class Case:
    """One row of the matrix: the runs at one point of a config's sweep, and the undisturbed runs."""

    name: str
    title: str
    config: str
    where: dict  # swept pointer → value
    control: dict
    recovers: bool = True  # whether the rest shape can be reached
    # whether energy is checked: nothing adds energy to the cloth, and the whole energy is known
    energy: bool = False
    creep: bool = False
    control_config: str = ""  # config of the undisturbed runs, if not `config`

    @property
    def rule(self):
        """The rule for green, as text."""
        parts = ["mean strain at most twice the mean strain of the undisturbed run (clamped to "
                 f"{STRAIN_FLOOR:g} to {STRAIN_CEILING:g})"]
        if self.recovers:
            parts.append(f"RMS distance from the rest shape below {100 * NEAR:g} % of the size or twice the "
                         "distance in the undisturbed run")
        if self.energy:
            parts.append("energy never above its value at the start")
        if self.creep:
            parts.append(f"moves less than {CREEP:g} sizes in the second half of the run")
        return ", ".join(parts)


@dataclass
class Criterion:
    """A number and its limit; `severity` is the verdict if the number exceeds the limit."""

    name: str
    value: float
    limit: float
    unit: str
    severity: str

    @property
    def holds(self):
        return self.value <= self.limit  # NaN fails

    @property
    def excess(self):
        return self.value / self.limit if self.limit > 0 else np.inf

    def as_json(self):
        return {"what": self.name, "value": self.value, "limit": self.limit, "unit": self.unit}


@dataclass
class Cell:
    """One run of a case, with its verdict."""

    case: Case
    run: object
    verdict: str
    worst: Criterion
    why: str = ""
    others: list = field(default_factory=list)  # other criteria that fail

    @property
    def model(self):
        return self.run.model

    @property
    def precision(self):
        return self.run.get("/solver/precision")


def criteria(run, control, case):
    """Every criterion of the case. `control` is the undisturbed run, None if it is missing or diverged."""
    metric = lambda name: run.summary.get(f"stability_{name}", np.nan)
    strain = run.summary.get("mean_strain", np.nan)
    calm = control.summary.get("mean_strain", np.nan) if control is not None and control.complete else np.nan
    calm = min(max(calm, STRAIN_FLOOR), STRAIN_CEILING) if np.isfinite(calm) else STRAIN_FLOOR
    listed = [Criterion("largest reach", metric("reach"), APART * max(metric("reach_start"), 1), "sizes",
                        RED),
              Criterion("reach at the end", metric("reach_end"), FAR, "sizes", RED),
              Criterion("mean strain", strain, 2 * calm, "1", AMBER if np.isfinite(strain) else RED)]
    if "stability_momentum_drift" in run.summary:
        # Each projection rounds at most four points independently: a random walk, averaged over the vertices.
        roundings = np.sqrt(4 * run.summary["projections"]) / run.summary["vertices"]
        listed.append(Criterion("momentum gained, as a speed", metric("momentum_drift"),
                                MOMENTUM * max(roundings, 1) * metric("rounding_speed"), "m/s", RED))
    if case.energy and energy_known(run):
        listed.append(Criterion("energy gained", metric("energy_gain"), ENERGY, "of the scale", RED))
    if case.recovers:
        undisturbed = control.summary.get("stability_rest_distance",
                                          0) if control is not None and control.complete else 0
        listed.append(Criterion("distance from rest", metric("rest_distance"),
                                min(max(NEAR, 2 * undisturbed), NOT_BACK), "sizes", AMBER))
    if case.creep:
        listed.append(Criterion("creep", metric("creep"), CREEP, "sizes", AMBER))
    return listed


def energy_known(run):
    """Whether all energy is known: prestressed springs with a stiffness k store an unknown energy."""
    hidden = registry.is_prestressed(run.model) and run.get("/bending/stiffness") == "k"
    return "stability_energy_gain" in run.summary and not hidden


def judge(run, control, case):
    if not run.complete:
        time = float(run.metrics["time"][-1])
        return Cell(case, run, RED, Criterion(f"{run.status} after", time, 0.0, "s", RED))
    checked = criteria(run, control, case)
    for verdict in (RED, AMBER):
        failed = [criterion for criterion in checked if criterion.severity == verdict and not criterion.holds]
        if failed:
            worst = max(failed, key=lambda criterion: np.nan_to_num(criterion.excess, nan=np.inf))
            others = [criterion for criterion in checked if not criterion.holds and criterion is not worst]
            return Cell(case, run, verdict, worst, others=others)
    return Cell(case, run, GREEN, max(checked, key=lambda criterion: criterion.excess))


def _of(config, pointer, rows, control, **also):
    return [Case(f"{config.removesuffix('_slow')}: {name}", title, config, {pointer: value},
                 {pointer: control}, **also) for name, title, value in rows]


def _flaws():
    names = {"needles": "needles, edges 1 : 1000", "caps": "caps of 179.9°",
             "degenerate": "triangles without area", "duplicate_vertices": "edges without length",
             "duplicate_faces": "duplicate faces", "non_manifold_edge": "three triangles at an edge",
             "bow_tie": "bow-tie vertices", "isolated_vertices": "isolated vertices", "pieces": "two pieces",
             "mixed_orientation": "mixed orientation", "hole": "a hole"}
    return [(name, title, name) for name, title in names.items()]


def _mended():
    rows = (("degenerate", "membrane_off"), ("degenerate", "repair"), ("duplicate_vertices", "membrane_off"),
            ("duplicate_vertices", "repair"), ("non_manifold_edge", "repair"), ("bow_tie", "repair"),
            ("mixed_orientation", "repair"), ("pieces", "repair"))
    titles = {flaw: title for flaw, title, _ in _flaws()}
    return [(f"{flaw}, {policy}", f"{titles[flaw]}: {policy.replace('_', ' ')}",
             {"flaw": flaw, "bad_triangles": policy}) for flaw, policy in rows]


BALL = {"generator": "sphere", "radius": 0.5, "cells": 16}
ONE, SIDE = {"vertices": ["upper_right"], "ring": 1}, {"vertices": ["top"], "ring": 1}
TWO = {"vertices": ["upper_left", "upper_right"], "ring": 1}

# Section → cases, in the order of the page. "Moves limited": /solver/flight_limit cuts a time step into parts
# if its forces would deform a triangle by more than 5 %.
SECTIONS = {
    "Start poses": _of("start", "/initial", [
        ("point", "collapsed to a point", {"scale": [0, 0, 0]}),
        ("line", "collapsed to a line", {"scale": [1, 0, 0]}),
        ("inverted", "scaled by −0.1", {"scale": [-0.1, -0.1, -0.1]}),
        ("mirrored", "mirrored", {"scale": [-1, 1, 1]}),
        ("creased", "every second column flipped", {"creases": 31}),
        ("stretched", "stretched 100×", {"scale": [100, 1, 1]}),
        ("stretched twice", "stretched 100× in both directions", {"scale": [100, 100, 1]}),
        ("compressed", "compressed to 1 %", {"scale": [0.01, 1, 1]}),
        ("compressed twice", "compressed to 1 % in both directions", {"scale": [0.01, 0.01, 1]}),
        ("random", "at random in a box of its size", {"random": 1}),
        ("random 10", "at random in a box of 10 sizes", {"random": 10}),
        ("undisturbed", "the rest shape", {})], {}),
    "Curved rest shape": _of("curved_slow", "/initial", [
        ("flattened", "a tube, flattened", {"scale": [1, 0, 1]}),
        ("mirrored", "a tube, mirrored", {"scale": [-1, 1, 1]}),
        ("inverted", "a tube, scaled by −0.1", {"scale": [-0.1, -0.1, -0.1]}),
        ("undisturbed", "a tube at rest", {})], {}),
    "Pins and loads": [
        *_of("pins", "/pins", [("one", "one corner and its ring", ONE),
                               ("one bare", "one vertex", {**ONE, "ring": 0, "distance": 0}),
                               ("two", "two corners", TWO), ("side", "a whole side", SIDE)], SIDE,
             recovers=False, energy=True),
        *_of("pins", "/pins",
             [("all", "all pinned", {"vertices": ["upper_right"], "ring": 0, "distance": 2})], SIDE,
             energy=True),
        *_of("published_slow", "/pins", [("one", "one corner, strain as published", ONE),
                                    ("two", "two corners, strain as published", TWO)], SIDE, recovers=False,
             energy=True),
        Case("pulled: apart", "corners pulled to twice their distance", "pulled", {"/effects": 0},
             {"/effects": 1}, recovers=False),
        Case("gust: gale", "a gale of 100× the weight", "gust", {"/effects": 0}, {"/effects": 1},
             recovers=False),
        Case("gust_cut: gale", "a gale of 100× the weight, moves limited (flight_limit)", "gust_cut_slow",
             {"/effects": 0}, {"/effects": 1}, recovers=False),
        *_of("mass", "/material/density_ratio", [("free", "one half 10⁶ times as heavy", 1e6)], 1),
        *_of("mass_hanging", "/material/density_ratio",
             [("hanging", "hanging from a half 10⁶ times lighter", 1e6)], 1, recovers=False),
        *_of("mass_tethered", "/material/density_ratio",
             [("hanging", "hanging from a half 10⁶ times lighter, with tethers", 1e6)], 1, recovers=False)],
    "Solver": [
        *_of("time_step", "/solver/dt", [("0.1 s", "dt 0.1 s", 0.1), ("1 s", "dt 1 s", 1)], 1 / 60,
             recovers=False, energy=True),
        *_of("time_step_cut_slow", "/solver/dt",
             [("0.1 s", "dt 0.1 s, moves limited (flight_limit)", 0.1),
              ("1 s", "dt 1 s, moves limited (flight_limit)", 1)], 1 / 60, recovers=False, energy=True,
             control_config="time_step"),
        *_of("iterations", "/solver/iterations", [("one", "1 iteration", 1)], 10, recovers=False,
             energy=True),
        *_of("iterations_cut_slow", "/solver/iterations",
             [("one", "1 iteration, moves limited (flight_limit)", 1)], 10, recovers=False, energy=True,
             control_config="iterations"),
        *_of("iterations_slow", "/solver/iterations", [("1000", "1000 iterations", 1000)], 10, recovers=False,
             energy=True),
        *_of("stiff", "/bending/k", [("k = 1", "k = 1 everywhere", 1)], 0.5, recovers=False, energy=True)],
    "Flawed meshes": [*_of("flaws", "/mesh/flaw", _flaws(), "none"),
                      *_of("flaws_mended_slow", "/mesh", _mended(), {"flaw": "none"})],
    "Meshes and units": [
        *_of("meshes", "/mesh", [("strip", "a strip one triangle wide", {"cells": 64, "height": 0.015625}),
                                 ("delaunay", "irregular", {"generator": "delaunay", "cells": 32}),
                                 ("ball", "closed", BALL),
                                 ("shuffled 1", "numbered at random", {"shuffle": 1}),
                                 ("shuffled 2", "numbered at random again", {"shuffle": 2}),
                                 ("grid", "the plain grid", {"cells": 32})], {"cells": 32}),
        *_of("order_slow", "/mesh", [("1", "projected in random order", {"shuffle": 1}),
                                ("2", "projected in another random order", {"shuffle": 2})], {"cells": 32}),
        *_of("units_slow", "/mesh", [("mm", "a millimetre wide", {"cells": 32, "scale": 0.001}),
                                ("km", "a kilometre wide", {"cells": 32, "scale": 1000}),
                                ("far", "10⁶ m from the origin", {"cells": 32, "offset": [1e6, 1e6, 1e6]})],
             {"cells": 32}),
        Case("rings: wider", "rings wider than the mesh", "rings", {}, {}),
        *_of("rings_across", "/mesh", [("hole", "5 rings across a hole", {"flaw": "hole"}),
                                       ("ball", "5 rings around a ball", BALL)],
             {"cells": 32})],
    "Moving freely": [
        *_of("falling", "/initial", [("spinning", "falling, spinning", {"spin": [0, 0, 5]}),
                                     ("flying", "falling, flying", {"velocity": [3, 2, 1]}),
                                     ("falling", "falling", {})],
             {}, energy=True),
        *_of("falling", "/initial", [("tumbling", "falling, tumbling", {"spin": [5, 0, 0]})], {},
             recovers=False, energy=True),
        *_of("energy_slow", "/initial", [("stretched", "elastic, stretched", {"scale": [1.2, 1.2, 1]}),
                                    ("crumpled", "elastic, crumpled", {"perturbation": 0.02}),
                                    ("tumbling", "elastic, tumbling", {"spin": [3, 0, 0]})], {},
             recovers=False, energy=True),
        Case("rest_slow: ten minutes", "a curtain for ten minutes", "rest_slow", {}, {}, recovers=False,
             energy=True, creep=True)],
}
CASES = [case for cases in SECTIONS.values() for case in cases]


def _by_methods(case):
    """The same case in two configs of configs/methods, whose sheets have 16 columns."""
    where = {"/initial": {"creases": 15}} if case.name == "start: creased" else case.where
    return [replace(case, config=case.config + end, where=where) for end in ("", BY_NEWTON)]


REPEATED = ("start", "pins", "gust", "mass_hanging", "time_step", "iterations", "falling")
METHOD_CASES = [repeated for case in CASES if case.config in REPEATED for repeated in _by_methods(case)]
