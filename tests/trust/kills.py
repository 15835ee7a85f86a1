"""Kills runs after a checkpoint at a random moment, and starts them again. The files must equal the files of
runs that were not killed, to the bit.

    kills.py PROGRAM [ROUNDS]      kills per scene; exit 1 if a file differs
"""
import random
import signal
import sys
import tempfile
import time
from pathlib import Path

from program import differences, fresh, run, run_files, start, times_gone_on, write_config

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


def kill_once(program, folder, scene, interval, how):
    """Kills the run after its first checkpoint, `interval` seconds after its start. Whether it was killed."""
    child = start(program, "run", f"{scene}.json", "--out", "killed", "--checkpoint", interval, folder=folder)
    while child.poll() is None and not list((folder / "killed").glob("**/run.checkpoint")):
        time.sleep(0.002)
    killed = child.poll() is None
    child.send_signal(how)
    _, errors = child.communicate()
    if not killed and child.returncode:
        raise SystemExit(f"{scene}: exit code {child.returncode}: {errors}")
    return killed


def compared(folder):
    """(how often runs continued from a checkpoint, differences) for complete runs."""
    names = [{str(file.relative_to(folder / out)) for file in run_files(folder / out)} for out in OUTS]
    differing = [f"{name} is missing on one side" for name in sorted(names[0] ^ names[1])]
    went_on = 0
    for name in sorted(names[0] & names[1]):
        differing += [f"{name}: {part}" for part in differences(*(folder / out / name for out in OUTS))]
        went_on += times_gone_on(folder / "killed" / name)
    return went_on, differing


def check(program, folder, scene, rounds, chance):
    """(kills, how often runs continued from a checkpoint, differences) for a scene."""
    write_config(folder, scene, allow=["implausible"], **SCENES[scene])
    fresh(folder / "whole")
    begin = time.monotonic()
    whole = run(program, "run", f"{scene}.json", "--out", "whole", folder=folder)
    took = time.monotonic() - begin
    if whole.returncode:
        raise SystemExit(f"{scene}: {whole.stderr}{whole.stdout}")
    killed = went_on = 0
    differing = []
    for _ in range(rounds):
        fresh(folder / "killed")
        how = chance.choice([signal.SIGKILL, signal.SIGKILL, signal.SIGTERM, signal.SIGINT])
        killed += kill_once(program, folder, scene, chance.uniform(0.05, 0.7) * took, how)
        run(program, "run", f"{scene}.json", "--out", "killed", folder=folder)
        times, parts = compared(folder)
        went_on += times
        differing += parts
    return killed, went_on, differing


def main(program, rounds=4, seed=1):
    chance = random.Random(seed)
    total = resumed = wrong = 0
    with tempfile.TemporaryDirectory() as place:
        Path(place, "pyramid.obj").write_text(MESH, encoding="utf-8")
        for scene in SCENES:
            killed, went_on, differing = check(program, Path(place), scene, rounds, chance)
            total, resumed, wrong = total + killed, resumed + went_on, wrong + bool(differing)
            print(f"{scene}: {killed} kills, continued {went_on} times; "
                  f"{'the same bits' if not differing else 'DIFFERS: ' + ', '.join(differing[:6])}",
                  flush=True)
    print(f"{total} kills, {resumed} continued runs; {wrong} of {len(SCENES)} scenes differ")
    return 1 if wrong or not resumed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], *map(int, sys.argv[2:])))
