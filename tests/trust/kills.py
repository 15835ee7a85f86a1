"""Kills runs at random moments and starts them again until they are complete. The files must equal the files
of runs that were not killed, to the bit.

    kills.py PROGRAM [KILLS]      exit 1 if a file differs
"""
import random
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from program import differences, fresh, run, run_files, start, times_gone_on, write_config

CHECKPOINT = 0.005  # s
OUTS = ("whole", "killed")
GRAVITY = {"type": "gravity"}
MESH = """v -0.3 -0.3 -0.4\nv 0.3 -0.3 -0.4\nv 0.3 0.3 -0.4\nv -0.3 0.3 -0.4\nv 0 0 -0.1
f 3 2 1\nf 4 3 1\nf 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n"""
SHEET = {"mesh": {"cells": 40}, "duration": 4.0, "output": {"measures": ["stability"]}}
HINGES = {"bending": {"model": "dihedral", "flexural_rigidity": 1e-5},
          "material": {"strain": {"stiffness": "compliance", "compliance": 1e-4}}}

# Every method, both precisions, and every effect and measure that keeps state between steps.
SCENES = {
    "pbd_float": {**SHEET, "defaults": "paper", "solver": {"precision": "single", "substeps": 4}},
    "pbd_double": {**SHEET, "bending": {"model": "adaptive"}, "solver": {"precision": "double"}},
    "flight": {**SHEET, "solver": {"flight_limit": 0.05, "sweep": "symmetric"}},
    "kang_cho": {**SHEET, "mesh": {"cells": 24}, "effects": [GRAVITY],
                 "bending": {"model": "crossover", "stiffness": "compliance", "compliance": 1.0},
                 "material": {"strain": {"stiffness": "compliance", "compliance": 1e-2}},
                 "solver": {"method": "kang_cho", "substeps": 8}},
    "equilibrium": {"mesh": {"cells": 40}, "duration": 4.0, "effects": [GRAVITY], **HINGES,
                    "solver": {"method": "equilibrium"}},
    "quasi_newton": {**SHEET, **HINGES, "solver": {"method": "quasi_newton", "membrane": "auto"},
                     "effects": [GRAVITY, {"type": "sphere", "centre": [0, 0, -0.3], "radius": 0.2},
                                 {"type": "friction"}]},
    "newton": {"mesh": {"cells": 8}, "duration": 2.0, **HINGES,
               "solver": {"method": "newton", "substeps": 2, "iterations": 3}},
    "vbd": {"mesh": {"cells": 8}, "duration": 2.0, **HINGES, "solver": {"method": "vbd", "iterations": 20}},
    "over_time": {"mesh": {"cells": 16}, "duration": 3.0, "bending": {"model": "dihedral"},
                  "accuracy": {"solver": ["/solver/substeps=32"], "over_time": True}},
    "moving_pins": {**SHEET, "pins": {"vertices": ["top"]},
                    "effects": [GRAVITY, {"type": "wind", "velocity": [1, 2, 0], "gust_amplitude": 1},
                                {"type": "moving_pins", "times": [0, 1, 2],
                                 "offsets": [0, 0, 0, 0.1, 0.2, 0, 0, 0, 0]}]},
    "self_collision": {"mesh": {"cells": 16}, "duration": 1.5, "pins": {"vertices": []},
                       "initial": {"perturbation": 1e-3},
                       "effects": [GRAVITY, {"type": "self_collision", "thickness": 0.01},
                                   {"type": "sphere", "centre": [0, 0, -0.25], "radius": 0.1},
                                   {"type": "plane", "point": [0, 0, -0.5]}, {"type": "friction"}]},
    "mesh_obstacle": {"mesh": {"cells": 24}, "duration": 1.5, "pins": {"vertices": []},
                      "effects": [GRAVITY, {"type": "rigid_damping"}, {"type": "friction"},
                                  {"type": "mesh_obstacle", "file": "pyramid.obj"}]},
    "settles": {"mesh": {"cells": 24}, "duration": 20.0, "settled_speed": 0.05,
                "effects": [GRAVITY, {"type": "viscous_drag", "coefficient": 10}]},
}


def kill_once(program, folder, scene, after, how):
    """Whether the run was killed before its end."""
    child = start(program, "run", f"{scene}.json", "--out", "killed", "--checkpoint", CHECKPOINT,
                  folder=folder)
    try:
        _, errors = child.communicate(timeout=after)
    except subprocess.TimeoutExpired:
        child.send_signal(how)
        child.communicate()
        return True
    if child.returncode:
        raise SystemExit(f"{scene}: exit code {child.returncode}: {errors}")
    return False


def compared(folder):
    """(how often runs continued from a checkpoint, differences) for complete runs."""
    names = [{str(file.relative_to(folder / out)) for file in run_files(folder / out)} for out in OUTS]
    differing = [f"{name} is missing on one side" for name in sorted(names[0] ^ names[1])]
    went_on = 0
    for name in sorted(names[0] & names[1]):
        differing += [f"{name}: {part}" for part in differences(*(folder / out / name for out in OUTS))]
        went_on += times_gone_on(folder / "killed" / name)
    return went_on, differing


def check(program, folder, scene, kills, chance):
    """(kills, how often runs continued from a checkpoint, differences) for a scene."""
    for out in OUTS:
        fresh(folder / out)
    write_config(folder, scene, allow=["implausible"], **SCENES[scene])
    begin = time.monotonic()
    whole = run(program, "run", f"{scene}.json", "--out", "whole", folder=folder)
    took = time.monotonic() - begin
    if whole.returncode:
        raise SystemExit(f"{scene}: {whole.stderr}{whole.stdout}")
    killed = went_on = 0
    differing = []
    while killed < kills or run_files(folder / "killed") == []:
        how = chance.choice([signal.SIGKILL, signal.SIGKILL, signal.SIGTERM, signal.SIGINT])
        if killed < kills and kill_once(program, folder, scene, chance.uniform(0.02, 1.1 * took), how):
            killed += 1
            continue
        run(program, "run", f"{scene}.json", "--out", "killed", folder=folder)
        times, parts = compared(folder)
        went_on += times
        differing += parts
        if killed < kills:
            fresh(folder / "killed")
    return killed, went_on, differing


def main(program, kills=50, seed=1):
    chance = random.Random(seed)
    kills_per_scene = -(-kills // len(SCENES))
    total = resumed = wrong = 0
    with tempfile.TemporaryDirectory() as place:
        Path(place, "pyramid.obj").write_text(MESH, encoding="utf-8")
        for scene in SCENES:
            killed, went_on, differing = check(program, Path(place), scene, kills_per_scene, chance)
            total, resumed, wrong = total + killed, resumed + went_on, wrong + bool(differing)
            print(f"{scene}: {killed} kills, continued {went_on} times; "
                  f"{'the same bits' if not differing else 'DIFFERS: ' + ', '.join(differing[:6])}",
                  flush=True)
    print(f"{total} kills, {resumed} continued runs; {wrong} of {len(SCENES)} scenes differ")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], *map(int, sys.argv[2:])))
