#!/usr/bin/env python3
"""Tests whether the default solver keeps cloth together, in scenes that do not choose a solver.

    scenes.py PROGRAM [--every N] [--set POINTER=VALUE]... [--jobs N]

Forty scenes, 238 runs of three seconds: six bending models, and five on tubes. Run by hand, not by ctest. The
scenes list their own effects, and state sizes, meshes, pins, densities, rigidities and time steps. No default
was chosen with these scenes. A run fails if its mean strain exceeds 0.1, or if a triangle at a pin is
stretched more than twofold. A run explodes if any triangle is stretched more than fivefold at a recorded
time, or if numbers overflow. --every 7 computes every seventh scene.
Prints a row per failed run, and exits with 1 if a run fails.
"""
import argparse
import json
import subprocess
import sys
import tempfile
from pathlib import Path

MODELS = ["crossover", "adaptive", "lod", "discrete_shells", "isometric", "bridson"]
# Models on tubes, where springs have no stated rigidity.
CURVED = ["none", "dihedral", "discrete_shells", "isometric", "bridson"]
FAILS = {"mean_strain": 0.1, "pin_max_stretch": 2.0}
EXPLODES = 5.0

GRAVITY = {"type": "gravity"}


def wind(x, y, z, **settings):
    return {"type": "wind", "velocity": [x, y, z], **settings}


def move(times, offsets, **settings):
    return {"type": "moving_pins", "times": times, "offsets": offsets, "interpolation": "smooth", **settings}


def sphere(x, y, z, radius):
    return {"type": "sphere", "centre": [x, y, z], "radius": radius}


def grid(width, height, cells, **settings):
    return {"width": width, "height": height, "cells": cells, **settings}


def scene(mesh, pins, *effects, **sections):
    winds = [effect for effect in effects if effect["type"] == "wind"]
    listed = [*winds, GRAVITY, *(effect for effect in effects if effect["type"] != "wind")]
    return {"mesh": mesh, "pins": {"vertices": pins}, "effects": listed, **sections}


def density(value):
    return {"density": value}


def rigidity(value):
    return {"flexural_rigidity": value}


def equilateral(width, height, cells):
    return grid(width, height, cells, generator="equilateral")


def delaunay(width, height, cells, seed):
    return grid(width, height, cells, generator="delaunay", seed=seed)


def disc(radius, cells):
    return {"generator": "disc", "radius": radius, "cells": cells}


def tube(radius, height, cells):
    return {"generator": "tube", "radius": radius, "height": height, "cells": cells}


CORNERS = ["upper_left", "upper_right"]
PLANE = {"type": "plane", "point": [0, 0, -0.4], "normal": [0, 0, 1]}
FRICTION = {"type": "friction", "static": 0.4, "kinetic": 0.3}

SCENES = {
    "handkerchief": scene(grid(0.3, 0.3, 20), ["upper_right"], material=density(0.08),
            bending=rigidity(2e-6)),
    "bed_sheet": scene(grid(2.4, 2.0, 36), CORNERS, material=density(0.14), bending=rigidity(6e-6)),
    "banner_breeze": scene(grid(3, 0.8, 45), ["left"], wind(4, 1, 0), material=density(0.11)),
    "banner_gale": scene(grid(3, 0.8, 30), ["left"], wind(18, 4, 0, gust_amplitude=0.4),
                         material=density(0.11), initial={"tilt": 90}),
    "towel_on_hook": scene(grid(0.5, 0.9, 18), ["upper_left"], material=density(0.45),
            bending=rigidity(2e-4)),
    "leather": scene(grid(0.8, 0.8, 24), CORNERS, material=density(0.9), bending=rigidity(3e-3)),
    "silk": scene(grid(1.1, 1.1, 40), ["upper_right"], wind(0, 2, 0.5), material=density(0.05),
                  bending=rigidity(5e-7)),
    "paper": scene(grid(0.21, 0.297, 20), ["top"], material=density(0.08), bending=rigidity(3e-4)),
    "doll_skirt": scene(tube(0.05, 0.08, 30), ["top_rim"], material=density(0.1), bending=rigidity(4e-6)),
    "wind_sock": scene(tube(0.2, 1.0, 36), ["top_rim"], wind(6, 0, 2), material=density(0.12)),
    "round_cloth": scene(disc(0.6, 16), [], sphere(0, 0, -0.45, 0.4), FRICTION, material=density(0.2)),
    "disc_by_rim": scene(disc(0.5, 14), ["circle"], material=density(0.25)),
    "disc_centre": scene(disc(0.5, 14), ["centre"], material=density(0.2), bending=rigidity(1e-5)),
    "triangle_lattice": scene(equilateral(1, 1, 24), ["upper_left"], material=density(0.2)),
    "irregular_one": scene(delaunay(1, 1, 22, 5), ["upper_right"], material=density(0.2)),
    "irregular_top": scene(delaunay(1.3, 0.7, 26, 11), ["top"], wind(0, 3, 0), material=density(0.15)),
    "long_ribbon": scene(grid(2, 0.05, 120), ["left"], material=density(0.06), bending=rigidity(3e-6)),
    "wide_ribbon": scene(grid(0.06, 1.5, 4), ["top"], wind(2, 2, 0), material=density(0.06)),
    "swing_up": scene(grid(1, 1, 28), CORNERS, move([0, 0.6], [0, 0, 0, 0, 0, 0.8]), material=density(0.2)),
    "shaken": scene(grid(1, 1, 24), ["top"], move([0, 0.2, 0.4, 0.6, 0.8],
                    [0, 0, 0, 0, 0.3, 0, 0, -0.3, 0, 0, 0.3, 0, 0, 0, 0]), material=density(0.2)),
    "jerked": scene(grid(1, 1, 32), ["upper_right"], move([0.5, 0.6], [0, 0, 0, 0.5, 0, 0.5]),
                    material=density(0.3)),
    "twirled": scene(grid(0.8, 0.8, 24), ["upper_left"], {"type": "moving_pins", "times": [0, 2],
                     "angles": [0, 540], "axis": [0, 0, 1], "interpolation": "smooth"},
                             material=density(0.2)),
    "on_ball": scene(grid(1, 1, 28), [], sphere(0, 0, -0.35, 0.3), FRICTION, material=density(0.18)),
    "on_ball_off_centre": scene(grid(1, 1, 28), ["upper_left"], sphere(0.2, 0, -0.35, 0.3),
            material=density(0.18)),
    "to_floor": scene(grid(1, 1, 24), [], PLANE, FRICTION, material=density(0.2), initial={"tilt": 60}),
    "floor_corner": scene(grid(1, 1, 24), ["upper_right"], PLANE, material=density(0.2)),
    "over_pole": scene(grid(1, 1.2, 24), [], {"type": "capsule", "a": [-1, 0.1, -0.1], "b": [1, 0.1, -0.1],
                       "radius": 0.06}, FRICTION, material=density(0.2)),
    "heavy_half": scene(grid(1, 1, 20), CORNERS, material={"density": 0.1, "density_ratio": 50}),
    "very_heavy_half": scene(grid(1, 1, 16), ["left"], material={"density": 0.1, "density_ratio": 1000}),
    "film_time_step": scene(grid(1, 1, 24), ["upper_right"], material=density(0.2), solver={"dt": 1 / 24}),
    "game_time_step": scene(grid(1, 1, 24), CORNERS, wind(0, 5, 0), material=density(0.2),
            solver={"dt": 1 / 30}),
    "fine_time_step": scene(grid(1, 1, 16), ["upper_right"], material=density(0.2), solver={"dt": 1 / 480}),
    "stamp": scene(grid(0.02, 0.02, 16), ["upper_left"], material=density(0.1), bending=rigidity(1e-7)),
    "sail": scene(grid(8, 6, 32), ["left"], wind(10, 2, 0), material=density(0.3), bending=rigidity(1e-3)),
    "marquee": scene(grid(20, 10, 40), CORNERS + ["lower_left", "lower_right"], wind(0, 0, 8),
                     material=density(0.6), bending=rigidity(5e-3)),
    "upside_down": scene(grid(1, 1, 24), ["bottom"], material=density(0.2), initial={"tilt": 90}),
    "crumpled": scene(grid(0.6, 0.6, 18), ["upper_left"], material=density(0.2), initial={"creases": 3}),
    "stretched_start": scene(grid(1, 1, 20), CORNERS, material=density(0.2), initial={"scale": [1.3, 1.3,
            1]}),
    "thrown": scene(grid(0.7, 0.7, 20), ["upper_right"], material=density(0.15), initial={"velocity": [0, 6,
            8]}),
    "four_corners_wind": scene(grid(1.5, 1.5, 30), CORNERS + ["lower_left", "lower_right"],
                               wind(0, 0, 25, gust_amplitude=0.5), material=density(0.2)),
}


def config(name):
    settings = {"name": name, "duration": 3, "allow": ["implausible"], "output": {"frames_per_second": 60},
                **SCENES[name]}
    settings["sweep"] = {"/bending/model": CURVED if settings["mesh"].get("generator") == "tube" else MODELS}
    return settings


def runs_of(program, settings, folder, asked):
    path = Path(folder) / f"{settings['name']}.json"
    path.write_text(json.dumps(settings), encoding="utf-8")
    command = [program, "run", str(path), "--json", "--out", folder, "--jobs", str(asked.jobs)]
    done = subprocess.run(command + [word for change in asked.set for word in ("--set", change)], text=True,
                          capture_output=True, check=False)
    runs = [json.loads(line) for line in done.stdout.splitlines() if line.startswith("{")]
    if len(runs) < len(settings["sweep"]["/bending/model"]):
        sys.exit(f"{settings['name']}: {len(runs)} runs\n{done.stderr[-1500:]}")
    return runs


def fault(run):
    """A text with the reason why a run fails; empty if it does not fail."""
    summary = run["summary"]
    if run["status"] not in ("complete", "implausible"):
        return f"explodes: {run['status']}"
    if not summary["worst_stretch"] <= EXPLODES:
        return f"explodes: a triangle is {summary['worst_stretch']:.3g} times as long as at rest"
    failed = [f"{name} {summary[name]:.3g}" for name, most in FAILS.items() if not summary.get(name,
            0) <= most]
    return f"fails: {', '.join(failed)}" if failed else ""


def main():
    parser = argparse.ArgumentParser(description=__doc__,
            formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--every", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--set", action="append", default=[])
    asked = parser.parse_args()
    count, faults, cpu, implausible = 0, [], 0.0, 0
    with tempfile.TemporaryDirectory() as folder:
        for name in list(SCENES)[::asked.every]:
            for run in runs_of(asked.program, config(name), folder, asked):
                count += 1
                cpu += run["step_cpu_s"]
                if run["status"] == "implausible":
                    implausible += 1
                    print(f"{name}, {run['point']['/bending/model']}: {run['message']}", file=sys.stderr)
                if text := fault(run):
                    faults.append(text)
                    print(f"{name}, {run['point']['/bending/model']}: {text}", flush=True)
    explode = sum(text.startswith("explodes") for text in faults)
    print(f"{count} runs: {len(faults)} fail, {explode} of them explode; {implausible} are implausible; "
          f"{cpu:.1f} s of CPU in steps")
    print(f"{count - len(faults)} passed, {len(faults)} failed")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
