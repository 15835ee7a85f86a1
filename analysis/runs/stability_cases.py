"""The hard cases: their runs, the undisturbed runs for comparison, and the rules for passing."""
from dataclasses import dataclass, replace

import numpy as np

from bendlab.results import registry
from tables.numbers import known_values

GREEN, AMBER, RED = "green", "amber", "red"
FOLDER = "stability"  # below configs/
METHODS = "methods"  # below configs/: a part of the cases, with other solver methods
FABRICS = "fabrics"  # below configs/: a part of the cases, with the bending laws of fabrics
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
    energy: bool = False  # whether it is checked: nothing adds energy to the cloth, and all energy is known
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
    """A number of a run and its limit; `severity` is the verdict if the number exceeds the limit."""

    name: str
    value: float
    limit: float
    unit: str
    severity: str = ""

    @property
    def holds(self):
        return self.value <= self.limit  # NaN fails

    @property
    def excess(self):
        return self.value / self.limit if self.limit > 0 and np.isfinite(self.value) else np.inf

    def as_json(self):
        return {"what": self.name, "value": self.value, "limit": self.limit, "unit": self.unit}


def worst_of(run):
    """The worst number of a run with its limit; `run` is an object of summary.json."""
    return Criterion(*known_values(run["worst"]).values())


@dataclass
class Cell:
    """One run of a case, with its verdict."""

    case: Case
    run: object
    verdict: str
    worst: Criterion
    why: str = ""

    @property
    def model(self):
        return self.run.model

    @property
    def precision(self):
        return self.run.get("/solver/precision")


def criteria(run, control, case):
    """Every criterion of the case. `control` is the undisturbed run, None if it is missing or diverged."""
    metric = lambda name: run.summary.get(f"stability_{name}", np.nan)
    undisturbed = control.summary if control is not None and control.complete else {}
    strain, calm = run.summary.get("mean_strain", np.nan), undisturbed.get("mean_strain", np.nan)
    calm = min(max(calm, STRAIN_FLOOR), STRAIN_CEILING) if np.isfinite(calm) else STRAIN_FLOOR
    listed = [("largest reach", metric("reach"), APART * max(metric("reach_start"), 1), "sizes", RED),
              ("reach at the end", metric("reach_end"), FAR, "sizes", RED),
              ("mean strain", strain, 2 * calm, "1", AMBER if np.isfinite(strain) else RED)]
    if "stability_momentum_drift" in run.summary:
        # Each projection rounds at most four points independently: a random walk, averaged over the vertices.
        roundings = np.sqrt(4 * run.summary["projections"]) / run.summary["vertices"]
        limit = MOMENTUM * max(roundings, 1) * metric("rounding_speed")
        listed.append(("momentum gained, as a speed", metric("momentum_drift"), limit, "m/s", RED))
    # Prestressed springs with a stiffness k store an unknown energy.
    hidden = registry.is_prestressed(run.model) and run.get("/bending/stiffness") == "k"
    if case.energy and "stability_energy_gain" in run.summary and not hidden:
        listed.append(("energy gained", metric("energy_gain"), ENERGY, "of the scale", RED))
    if case.recovers:
        limit = min(max(NEAR, 2 * undisturbed.get("stability_rest_distance", 0)), NOT_BACK)
        listed.append(("distance from rest", metric("rest_distance"), limit, "sizes", AMBER))
    if case.creep:
        listed.append(("creep", metric("creep"), CREEP, "sizes", AMBER))
    return [Criterion(*criterion) for criterion in listed]


def judge(run, control, case):
    if not run.complete:
        time = float(run.metrics["time"][-1])
        return Cell(case, run, RED, Criterion(f"{run.status} after", time, 0.0, "s", RED))
    checked = criteria(run, control, case)
    excess = lambda criterion: criterion.excess
    for verdict in (RED, AMBER):
        failed = [criterion for criterion in checked if criterion.severity == verdict and not criterion.holds]
        if failed:
            return Cell(case, run, verdict, max(failed, key=excess))
    return Cell(case, run, GREEN, max(checked, key=excess))


def _of(config, pointer, control, *rows, **also):
    """Cases that differ in one setting of a config. `rows`: (name, title, value of the setting); `control`:
    the value in the undisturbed runs."""
    return [Case(f"{config.removesuffix('_slow')}: {name}", title, config, {pointer: value},
                 {pointer: control}, **also) for name, title, value in rows]


FLAWS = {"needles": "needles, edges 1 : 1000", "caps": "caps of 179.9°",
         "degenerate": "triangles without area", "duplicate_vertices": "edges without length",
         "duplicate_faces": "duplicate faces", "non_manifold_edge": "three triangles at an edge",
         "bow_tie": "bow-tie vertices", "isolated_vertices": "isolated vertices", "pieces": "two pieces",
         "mixed_orientation": "mixed orientation", "hole": "a hole"}
MENDED = {"degenerate": ("membrane_off", "repair"), "duplicate_vertices": ("membrane_off", "repair"),
          "non_manifold_edge": ("repair",), "bow_tie": ("repair",), "mixed_orientation": ("repair",),
          "pieces": ("repair",)}  # flaw → settings for bad triangles
PLAIN = {"cells": 32}
BALL = {"generator": "sphere", "radius": 0.5, "cells": 16}
ONE, SIDE = {"vertices": ["upper_right"], "ring": 1}, {"vertices": ["top"], "ring": 1}
TWO = {"vertices": ["upper_left", "upper_right"], "ring": 1}
HELD = {"recovers": False, "energy": True}
GALE = ({"/effects": 0}, {"/effects": 1})

# Section → cases, in the order of the page. "Moves limited": /solver/flight_limit cuts a time step into parts
# if its forces would deform a triangle by more than 5 %.
SECTIONS = {
    "Start poses": _of(
        "start", "/initial", {},
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
        ("undisturbed", "the rest shape", {})),
    "Curved rest shape": _of(
        "curved_slow", "/initial", {},
        ("flattened", "a tube, flattened", {"scale": [1, 0, 1]}),
        ("mirrored", "a tube, mirrored", {"scale": [-1, 1, 1]}),
        ("inverted", "a tube, scaled by −0.1", {"scale": [-0.1, -0.1, -0.1]}),
        ("undisturbed", "a tube at rest", {})),
    "Pins and loads": [
        *_of("pins", "/pins", SIDE, ("one", "one corner and its ring", ONE),
             ("one bare", "one vertex", {**ONE, "ring": 0, "distance": 0}),
             ("two", "two corners", TWO), ("side", "a whole side", SIDE), **HELD),
        *_of("pins", "/pins", SIDE, ("all", "all pinned", {**ONE, "ring": 0, "distance": 2}), energy=True),
        *_of("published_slow", "/pins", SIDE, ("one", "one corner, strain as published", ONE),
             ("two", "two corners, strain as published", TWO), **HELD),
        Case("pulled: apart", "corners pulled to twice their distance", "pulled", *GALE, recovers=False),
        Case("gust: gale", "a gale of 100× the weight", "gust", *GALE, recovers=False),
        Case("gust_cut: gale", "a gale of 100× the weight, moves limited (flight_limit)", "gust_cut_slow",
             *GALE, recovers=False),
        *_of("mass", "/material/density_ratio", 1, ("free", "one half 10⁶ times as heavy", 1e6)),
        *_of("mass_hanging", "/material/density_ratio", 1,
             ("hanging", "hanging from a half 10⁶ times lighter", 1e6), recovers=False),
        *_of("mass_tethered", "/material/density_ratio", 1,
             ("hanging", "hanging from a half 10⁶ times lighter, with tethers", 1e6), recovers=False)],
    "Solver": [
        *_of("time_step", "/solver/dt", 1 / 60, ("0.1 s", "dt 0.1 s", 0.1), ("1 s", "dt 1 s", 1), **HELD),
        *_of("time_step_cut_slow", "/solver/dt", 1 / 60,
             ("0.1 s", "dt 0.1 s, moves limited (flight_limit)", 0.1),
             ("1 s", "dt 1 s, moves limited (flight_limit)", 1), **HELD, control_config="time_step"),
        *_of("iterations", "/solver/iterations", 10, ("one", "1 iteration", 1), **HELD),
        *_of("iterations_cut_slow", "/solver/iterations", 10,
             ("one", "1 iteration, moves limited (flight_limit)", 1), **HELD, control_config="iterations"),
        *_of("iterations_slow", "/solver/iterations", 10, ("1000", "1000 iterations", 1000), **HELD),
        *_of("stiff", "/bending/k", 0.5, ("k = 1", "k = 1 everywhere", 1), **HELD)],
    "Flawed meshes": [
        *_of("flaws", "/mesh/flaw", "none", *((flaw, title, flaw) for flaw, title in FLAWS.items())),
        *_of("flaws_mended_slow", "/mesh", {"flaw": "none"},
             *((f"{flaw}, {policy}", f"{FLAWS[flaw]}: {policy.replace('_', ' ')}",
                {"flaw": flaw, "bad_triangles": policy}) for flaw in MENDED for policy in MENDED[flaw]))],
    "Meshes and units": [
        *_of("meshes", "/mesh", PLAIN,
             ("strip", "a strip one triangle wide", {"cells": 64, "height": 0.015625}),
             ("delaunay", "irregular", {"generator": "delaunay", "cells": 32}), ("ball", "closed", BALL),
             ("shuffled 1", "numbered at random", {"shuffle": 1}),
             ("shuffled 2", "numbered at random again", {"shuffle": 2}), ("grid", "the plain grid", PLAIN)),
        *_of("order_slow", "/mesh", PLAIN, ("1", "projected in random order", {"shuffle": 1}),
             ("2", "projected in another random order", {"shuffle": 2})),
        *_of("units_slow", "/mesh", PLAIN, ("mm", "a millimetre wide", {**PLAIN, "scale": 0.001}),
             ("km", "a kilometre wide", {**PLAIN, "scale": 1000}),
             ("far", "10⁶ m from the origin", {**PLAIN, "offset": [1e6, 1e6, 1e6]})),
        Case("rings: wider", "rings wider than the mesh", "rings", {}, {}),
        *_of("rings_across", "/mesh", PLAIN, ("hole", "5 rings across a hole", {"flaw": "hole"}),
             ("ball", "5 rings around a ball", BALL))],
    "Moving freely": [
        *_of("falling", "/initial", {}, ("spinning", "falling, spinning", {"spin": [0, 0, 5]}),
             ("flying", "falling, flying", {"velocity": [3, 2, 1]}), ("falling", "falling", {}), energy=True),
        *_of("falling", "/initial", {}, ("tumbling", "falling, tumbling", {"spin": [5, 0, 0]}), **HELD),
        *_of("energy_slow", "/initial", {}, ("stretched", "elastic, stretched", {"scale": [1.2, 1.2, 1]}),
             ("crumpled", "elastic, crumpled", {"perturbation": 0.02}),
             ("tumbling", "elastic, tumbling", {"spin": [3, 0, 0]}), **HELD),
        Case("rest_slow: ten minutes", "a curtain for ten minutes", "rest_slow", {}, {}, **HELD, creep=True)],
}
CASES = [case for cases in SECTIONS.values() for case in cases]


# The same cases in two configs of configs/methods, whose sheets have 16 columns.
REPEATED = ("start", "pins", "gust", "mass_hanging", "time_step", "iterations", "falling")
METHOD_CASES = [replace(case, config=case.config + end, where={"/initial": {"creases": 15}}
                        if case.name == "start: creased" else case.where)
                for case in CASES if case.config in REPEATED for end in ("", BY_NEWTON)]
# Those cases with the bending laws of fabrics. The energy of friction, folds and keyframes does not follow
# from the pose. To compare all laws by the same rules, the energy is checked for none of them.
WITH_FABRICS = ("start", "pins", "gust", "time_step", "falling")
FABRIC_CASES = [replace(case, energy=False) for case in METHOD_CASES if case.config in WITH_FABRICS]
