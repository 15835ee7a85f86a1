#!/usr/bin/env python3
"""Measures how much data the player can show: limits.py PROGRAM [FOLDER]

Computes eight runs of 4 096 vertices × 151 frames and a run of 66 049 × 61 into FOLDER (default: a temporary
folder). Existing runs in FOLDER are not computed again. Writes a page of each sweep, and measures it with
software graphics: bytes, time to the first frame, frames per second. Exit code 1 if a goal is missed, 77
without a browser. As other programs slow the measurement down, the load is printed.
"""
import json
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
from page import write_page  # noqa: E402

from bendlab.results.load import load_runs  # noqa: E402

MODELS = ["crossover", "k_ring", "adaptive", "lod", "dihedral", "bridson", "discrete_shells", "isometric"]
SHEET = {
    "name": "limits", "description": "A sheet that falls from horizontal and swings below two corners.",
    "allow": ["implausible"], "duration": 5, 
    "mesh": {"generator": "grid", "cells": 63, "diagonal": "alternating"},
    "pins": {"vertices": ["upper_left", "upper_right"]}, "material": {"density": 0.2},
    "bending": {"stiffness": "physical", "flexural_rigidity": 5e-5},
    "effects": [{"type": "gravity", "acceleration": [0, 0, -9.81]}, {"type": "tethers"},
                {"type": "constraint_damping", "rate": 2}],
    "output": {"frames_per_second": 30}, "sweep": {"/bending/model": MODELS}}
LARGE = SHEET | {"name": "limits_large", "duration": 2, "mesh": SHEET["mesh"] | {"cells": 256},
                 "sweep": {"/bending/model": ["discrete_shells"]}}


def page_of(program, folder, config):
    """Computes the runs of a config, and writes their page."""
    name = config["name"]
    (folder / f"{name}.json").write_text(json.dumps(config), encoding="utf-8")
    subprocess.run([program,
                    "run",
                    folder / f"{name}.json",
                    "--out",
                    folder],
                   check=True,
                   stdout=subprocess.DEVNULL,
                   stderr=subprocess.DEVNULL)
    page = folder / f"{name}.html"
    write_page(page, load_runs(folder / name))
    return page


def main(program, folder):
    node = shutil.which("node")
    if not node:
        print("skipped: no Node")
        return 77
    pages = [page_of(program, folder, config) for config in (SHEET, LARGE)]
    print(f"load average {os.getloadavg()[0]:.1f} on {os.cpu_count()} hardware threads")
    return subprocess.run([node, HERE / "limits.mjs", *pages], check=False).returncode


if __name__ == "__main__":
    if len(sys.argv) > 2:
        sys.exit(main(sys.argv[1], Path(sys.argv[2])))
    with tempfile.TemporaryDirectory() as temporary:
        sys.exit(main(sys.argv[1], Path(temporary)))
