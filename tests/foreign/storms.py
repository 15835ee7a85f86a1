#!/usr/bin/env python3
"""Tests whether large forces tear cloth with the default solver: random storms, and pins that move fast.

    storms.py PROGRAM [--scenes N] [--seed S] [--set POINTER=VALUE]...

Each scene has a random sheet, model, pins and rigidity. Half of the scenes have a wind of up to 50 m/s with
gusts. In the other scenes, the pins are moved by up to the length of the sheet within 0.05 to 0.3 s. A run
explodes if numbers overflow, or if a triangle is stretched more than threefold at any time and also more than
1.5 times as far as with converged steps. The second condition is needed because a storm stretches a triangle
of a 10 m² sheet that hangs by single vertices sevenfold even with converged steps. Prints the largest
stretches, and exits with 1 if a run explodes or ends with an error. Run by hand, not by ctest.
"""
import argparse
import json
import random
import subprocess
import sys
import tempfile
from pathlib import Path

MODELS = ["crossover", "k_ring", "adaptive", "lod", "sparse_lod", "prestressed", "dihedral", "bridson",
          "discrete_shells", "isometric", "none"]
PINS = [["upper_right"], ["upper_left", "upper_right"], ["left"], ["top"], ["top", "bottom"], ["centre"],
        ["upper_left", "upper_right", "lower_left", "lower_right"], ["left", "right"]]
LARGE, EXPLODES = 3.0, 1.5  # stretch; ratio to the stretch with CONVERGED
CONVERGED = ["/solver/method=quasi_newton", "/solver/membrane=stated", "/solver/substeps=8",
             "/solver/iterations=20"]


def direction(random_numbers):
    """A random unit vector."""
    vector = [random_numbers.gauss(0, 1) for _ in range(3)]
    length = sum(x * x for x in vector) ** 0.5
    return [x / length for x in vector]


def scene(random_numbers):
    """A config of a random scene."""
    size = 10 ** random_numbers.uniform(-0.7, 0.5)
    pins = random_numbers.choice(PINS)
    effects = [{"type": "gravity"}]
    if random_numbers.random() < 0.5:
        speed = 50 * random_numbers.random()
        effects.append({"type": "wind", "velocity": [speed * x for x in direction(random_numbers)],
                        "gust_amplitude": random_numbers.random()})
    else:
        start, length = random_numbers.uniform(0.1, 0.6), size * random_numbers.uniform(0.2, 1)
        end = start + random_numbers.uniform(0.05, 0.3)
        effects.append({"type": "moving_pins", "times": [start, end], "interpolation": "smooth",
                        "offsets": [0, 0, 0, *(length * x for x in direction(random_numbers))]})
    mesh = {"width": size, "height": size * random_numbers.choice([0.5, 1, 1, 2]),
            "cells": random_numbers.choice([8, 16, 24, 32]),
            "generator": random_numbers.choice(["grid", "grid", "equilateral", "delaunay"])}
    return {"name": "storms", "duration": 1.5, "mesh": mesh, "pins": {"vertices": pins},
            "material": {"density": 10 ** random_numbers.uniform(-1.3, 0)},
            "bending": {"model": random_numbers.choice(MODELS),
                        "flexural_rigidity": 10 ** random_numbers.uniform(-7, -4)},
            "effects": effects}


def run(program, file, settings):
    """The run of a config, as the program prints it with --json; None if the run fails."""
    call = [program, "run", file, "--out", file.with_suffix(""), "--json",
            *(word for setting in settings for word in ("--set", setting))]
    done = subprocess.run(call, capture_output=True, text=True)
    try:
        result = json.loads(done.stdout.splitlines()[0])
        return result if result["status"] in ("complete", "implausible") else None
    except (ValueError, IndexError):
        return None


def main():
    parser = argparse.ArgumentParser(description=__doc__,
            formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path)
    parser.add_argument("--scenes", type=int, default=500)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--set", action="append", default=[])
    asked = parser.parse_args()
    random_numbers = random.Random(asked.seed)
    worst, wrong = [], 0
    with tempfile.TemporaryDirectory() as place:
        for number in range(asked.scenes):
            config = scene(random_numbers)
            file = Path(place) / f"{number}.json"
            file.write_text(json.dumps(config), encoding="utf-8")
            result = run(asked.program, file, asked.set)
            stretch = result["summary"]["worst_stretch"] if result else float("nan")
            worst.append((stretch, number))
            if stretch <= LARGE:
                continue
            converged = run(asked.program, file, CONVERGED)
            expected = converged["summary"]["worst_stretch"] if converged else float("nan")
            if not stretch <= EXPLODES * expected:
                wrong += 1
                print(f"{number}: stretch {stretch:.3g}, converged {expected:.3g}: {json.dumps(config)}",
                      flush=True)
    worst.sort(reverse=True)
    print("largest stretches:", ", ".join(f"{stretch:.3g} ({number})" for stretch, number in worst[:10]))
    print(f"{asked.scenes - wrong} passed, {wrong} failed")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
