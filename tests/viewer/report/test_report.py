#!/usr/bin/env python3
"""Tests the page of a sweep in a real browser: test_report.py PROGRAM [FOLDER]

Computes a small sweep whose texts are markup, makes its page with `bendlab report`, and runs report_test.mjs
on it. The expected values are read here from the run files with h5py. FOLDER, if it is given, keeps the
screenshots. Exit code 77: no browser, Node or playwright-core.
"""
import json
import os
import shutil
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

import h5py

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "analysis"))
from bendlab.results.facts import Facts  # noqa: E402

HERE = Path(__file__).resolve().parent
MARKUP = "<script>document.title='injected'</script>\"'</script><!--<img src=x onerror=alert(2)>"
SWEEP = {
    "name": "hostile", "description": MARKUP, "duration": 0.5, "allow": ["implausible"],
    "mesh": {"generator": "grid", "cells": 8}, "pins": {"vertices": ["upper_left"]},
    "initial": {"perturbation": 0.01}, "output": {"frames_per_second": 20},
    "expect": [{"metric": "mean_strain", "max": 1, "why": MARKUP},
               {"metric": "mean_strain", "max": 1e-9, "why": "fails " + MARKUP, "where": {"/mesh/cells": 6}}],
    "sweep": {"/bending/model": ["none", "adaptive", "dihedral"], "/mesh/cells": [4, 6, 8],
              "/initial/seed": [1, 2, 3]}}


def summaries(folder):
    """[(model, cells, seed, id, mean_strain)] of the run files."""
    rows = []
    for path in sorted(folder.glob("**/run.vtkhdf")):
        with h5py.File(path, "r") as file:
            facts = Facts(file)
            config = facts.config
            rows.append((config["bending"]["model"], config["mesh"]["cells"], config["initial"]["seed"],
                         facts.id, facts.summary["mean_strain"]))
    return rows


def expected(folder):
    """The values of mean_strain that the page has to show."""
    runs = summaries(folder)
    medians = {}
    for model in SWEEP["sweep"]["/bending/model"]:
        for cells in SWEEP["sweep"]["/mesh/cells"]:
            values = [value for m, c, _, _, value in runs if (m, c) == (model, cells)]
            medians[f"{model} {cells}"] = [statistics.median(values), min(values), max(values)]
    return {"medians": medians, "values": {entry[3]: entry[4] for entry in runs}, "count": len(runs),
            "markup": MARKUP,
            "adaptive6": sorted(entry[3] for entry in runs if entry[:2] == ("adaptive", 6))}


def main(program, shots):
    node = shutil.which("node")
    if not node:
        print("skipped: no Node")
        return 77
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        config = folder / "it's <b> \"quoted\" <!--.json"
        config.write_text(json.dumps(SWEEP), encoding="utf-8")
        subprocess.run([program, "run", config, "--out", folder / "results"], stdout=subprocess.DEVNULL,
                       stderr=subprocess.DEVNULL, check=False)  # an expectation fails
        subprocess.run([program, "report", folder / "results/hostile", "-o", folder / "page.html"],
                       check=True,
                       stdout=subprocess.DEVNULL)
        (folder / "expected.json").write_text(json.dumps(expected(folder / "results")), encoding="utf-8")
        shots = Path(shots or folder / "shots")
        shots.mkdir(parents=True, exist_ok=True)
        return subprocess.run([node, HERE / "report_test.mjs", folder, shots], env=os.environ,
                              check=False).returncode


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2] if len(sys.argv) > 2 else None))
