#!/usr/bin/env python3
"""Checks that two builds of the program do the same, after changes that only move code.

    same_as.py OLD NEW [--bits]

Compares the output of `plan --json` for every config in configs/, under every choice of /defaults: the
settings of all runs, with defaults filled in. --bits also runs 92 small scenes with both programs (every
bending model, every method, both precisions, bending laws of fabrics, effects, folds) and compares the
positions in all frames, bit by bit. Bits agree only between programs that were built for the same processor.
Run by hand, not by ctest, because it needs the old program. Prints the differences, and exits with 1 if there
are any.
"""
import argparse
import json
import subprocess
import sys
import tempfile
from pathlib import Path

root = Path(__file__).resolve().parents[2]
RECIPES = [None, "recommended", "fast", "reference", "paper"]

GRAVITY = {"type": "gravity"}
DRAG = {"type": "viscous_drag", "coefficient": 0.5}
BALL = {"type": "sphere", "centre": [0.5, 0.5, -0.3], "radius": 0.25}
TWO_CORNERS = {"vertices": ["upper_left", "upper_right"]}


def modelled(model, **settings):
    return {"bending": {"model": model, **settings}}


def solved(method, **settings):
    return {"solver": {"method": method, **settings}}


SCENES = {
    **{f"model {model}": {**modelled(model, k=0.5), "pins": TWO_CORNERS} for model in
       ["none", "crossover", "k_ring", "adaptive", "lod", "sparse_lod", "dihedral", "bridson",
        "discrete_shells", "choi_ko", "isometric"]},
    **{f"stiff {model}, {method}, {precision}": {**modelled(model, flexural_rigidity=1e-4),
                                                 **solved(method, precision=precision)}
       for model in ["crossover", "prestressed", "dihedral", "bridson", "discrete_shells",
                     "corotational_edge", "mid_edge", "mid_edge_average", "corotational_face", "isometric",
                     "laplacian", "dkt"]
       for method in ["pbd", "quasi_newton"] for precision in ["single", "double"]
       if (model, method) != ("dkt", "pbd")},
    **{f"{name}, {model}, {method}": {**modelled(model, flexural_rigidity=1e-4, **law), **solved(method)}
       for model in ["discrete_shells", "mid_edge"] for method in ["pbd", "quasi_newton"]
       for name, law in {"softening": {"softening": {"half_at": 5}}, "friction": {"hysteresis": {"hb": 5e-3}},
                         "folds": {"plasticity": {"yield_at": 2, "hardening": 0.2}}}.items()},
    # The cloth swings for long, so that its motion amplifies a difference in the last bit.
    **{f"swing, {method}, {precision}": {**solved(method, precision=precision, **settings), "duration": 2,
                                         "mesh": {"cells": 32}}
       for method, settings in {"pbd": {"substeps": 16, "iterations": 1}, "quasi_newton": {}}.items()
       for precision in ["single", "double"]},
    "pbd, double": solved("pbd", precision="double", levels=4),
    "pbd, symmetric": solved("pbd", sweep="symmetric", substeps=4, order="pins"),
    "kang_cho": {**solved("kang_cho"), **modelled("crossover", compliance=1e-3)},
    "equilibrium": solved("equilibrium"),
    "newton": solved("newton", substeps=2),
    "newton, dkt": {**modelled("dkt", flexural_rigidity=1e-4), **solved("newton"), "mesh": {"cells": 6}},
    "quasi_newton, single": solved("quasi_newton", precision="single"),
    "quasi_newton, double": solved("quasi_newton", precision="double", membrane="stated"),
    "vbd": {**solved("vbd"), "material": {"strain": {"compliance": 1e-3}}},
    "ball and floor": {"effects": [GRAVITY, BALL, {"type": "plane", "point": [0, 0, -0.6]},
                                   {"type": "friction"}],
                       "pins": {"vertices": []}},
    "capsule, disc": {"effects": [GRAVITY, DRAG, {"type": "capsule"}, {"type": "disc"}]},
    "wind on projections": {"effects": [GRAVITY, {"type": "wind", "gust_amplitude": 0.3},
                                        {"type": "tethers"}, {"type": "strain_limiting"},
                                        {"type": "rigid_damping"}],
                            **solved("pbd", levels=2)},
    "moving pins": {"effects": [GRAVITY, {"type": "moving_pins", "times": [0, 0.2],
                                          "offsets": [0, 0, 0, 0.1, 0, 0.1]}]},
    "folded": {"initial": {"folds": 2, "fold_gap": 0.02, "perturbation": 1e-3},
               "effects": [GRAVITY, {"type": "self_collision"}], **solved("pbd", substeps=4)},
    "damping, mesh": {"effects": [GRAVITY, {"type": "constraint_damping", "rate": 4},
                                  {"type": "mesh_obstacle", "file": str(root / "configs/scenes/chair.obj"),
                                   "offset": [0.5, 0.5, -0.6]}, {"type": "friction"}],
                      "mesh": {"width": 1.5, "height": 1.5, "cells": 60}, "initial": {"perturbation": 1e-4},
                      "pins": {"vertices": []}},
    "damping, disc": {"effects": [GRAVITY, {"type": "constraint_damping", "rate": 4}, {"type": "friction"},
                                  {"type": "disc", "centre": [0.5, 0.5, -0.05], "radius": 0.3},
                                  {"type": "self_collision"}],
                      "mesh": {"cells": 40}, "initial": {"perturbation": 1e-4}, "pins": {"vertices": []}},
    "loads": {"effects": [GRAVITY, {"type": "load", "vertices": ["bottom"], "force": [0, 0.01, 0]},
                          {"type": "moment", "vertices": ["bottom"], "moment": 1e-3}]},
    "irregular mesh": {"mesh": {"generator": "delaunay"}, "effects": [GRAVITY, DRAG]},
    "tube": {"mesh": {"generator": "tube", "radius": 0.2, "height": 0.5, "cells": 16},
             "pins": {"vertices": ["top_rim"]}, "effects": [GRAVITY, {"type": "pressure", "pressure": 2}]},
}


def settings_of(program, config, recipe):
    """The resolved settings of each run, and the output on stderr. 1 and 1.0 are equal."""
    overrides = ["--set", f"/defaults={recipe}"] if recipe else []
    done = subprocess.run([program, "plan", config, "--json", "--out", "/nonexistent", *overrides],
                          capture_output=True, text=True)
    lines = done.stdout.splitlines()
    return [json.loads(line)["config"] for line in lines], done.stderr


def first_difference(old, new, pointer=""):
    if isinstance(old, dict) and isinstance(new, dict):
        for key in [*old, *(key for key in new if key not in old)]:
            if old.get(key) != new.get(key):
                return first_difference(old.get(key), new.get(key), f"{pointer}/{key}")
    return f"{pointer}: {old} → {new}"


def compare_settings(old, new):
    differ = 0
    configs = sorted(path for path in (root / "configs").rglob("*.json") if path.name != "schema.json")
    for config in configs:
        for recipe in RECIPES:
            (before, old_errors), (after, new_errors) = (settings_of(program, config, recipe)
                                                         for program in (old, new))
            if before == after and bool(old_errors) == bool(new_errors):
                continue
            differ += 1
            pair = next(((a, b) for a, b in zip(before, after) if a != b), None)
            difference = first_difference(*pair) if pair else \
                f"{len(before)} runs → {len(after)}: {new_errors}"
            print(f"{config.relative_to(root)}, {recipe}: {difference}")
    print(f"settings: {len(configs)} configs under {len(RECIPES)} defaults, {differ} differ")
    return differ


def frames_of(program, name, scene, folder):
    import h5py  # only here: settings are compared without it
    config = {"name": "scene", "duration": 0.4, "allow": ["implausible"], **scene}
    config["mesh"] = {"cells": 12, **config.get("mesh", {})}
    folder.mkdir(parents=True)
    (folder / "config.json").write_text(json.dumps(config))
    done = subprocess.run([program, "run", "config.json", "--out", "results"], cwd=folder,
                          capture_output=True, text=True)
    files = list((folder / "results").rglob("*.vtkhdf"))
    if len(files) != 1:
        raise SystemExit(f"{name}: {program} gives no run: {done.stderr}")
    with h5py.File(files[0]) as file:
        return file["VTKHDF/Points"][()].tobytes()


def compare_bits(old, new):
    differ = 0
    with tempfile.TemporaryDirectory() as place:
        for number, (name, scene) in enumerate(SCENES.items()):
            frames = [frames_of(program, name, scene, Path(place) / f"{number}-{which}")
                      for which, program in enumerate((old, new))]
            if frames[0] != frames[1]:
                differ += 1
                print(f"{name}: bits differ")
    print(f"bits: {len(SCENES)} scenes, {differ} differ")
    return differ


def main():
    raw = argparse.RawDescriptionHelpFormatter
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=raw)
    parser.add_argument("old"), parser.add_argument("new")
    parser.add_argument("--bits", action="store_true")
    options = parser.parse_args()
    old, new = (str(Path(program).resolve()) for program in (options.old, options.new))
    differ = compare_settings(old, new)
    if options.bits:
        differ += compare_bits(old, new)
    sys.exit(1 if differ else 0)


main()
