#!/usr/bin/env python3
"""Tests the player in a real browser: test_player.py PROGRAM

Computes three small runs, writes a page with them, and runs player_test.mjs on it. The expected values are
read here from the run files with h5py. Exit code 77: no browser, Node or playwright-core.
"""
import json
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import h5py
import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))
from page import write_page  # noqa: E402

from bendlab.results.facts import Facts  # noqa: E402
from bendlab.results.load import load_runs  # noqa: E402

MARKUP = "<script>document.title='injected'</script>\"'</script><!--"
SHEET = {
    "name": "falling", "description": MARKUP, "allow": ["implausible"], "duration": 1,
    "mesh": {"generator": "grid", "cells": 12, "diagonal": "alternating"},
    "pins": {"vertices": ["upper_left", "upper_right"]},
    "bending": {"stiffness": "physical", "flexural_rigidity": 5e-5, "model": "adaptive"},
    "material": {"density": 0.2},
    "effects": [{"type": "gravity", "acceleration": [0, 0, -9.81]},
                {"type": "sphere", "centre": [0.1, -0.2, -0.4], "radius": 0.15, "velocity": [0, 0, 0.2]}],
    "output": {"frames_per_second": 30, "constraints": True}}


def compute(program, folder):
    """Three runs: two with different models, and a third with another mesh, frame rate and duration,
    which has no recorded springs."""
    third = SHEET | {"duration": 0.6, "mesh": SHEET["mesh"] | {"cells": 17},
                     "output": {"frames_per_second": 12}}
    for name, config in (("a", SHEET), ("b", SHEET | {"bending": SHEET["bending"] | {"model": "dihedral"}}),
                         ("c", third)):
        path = folder / f"{name}.json"
        path.write_text(json.dumps(config), encoding="utf-8")
        subprocess.run([program, "run", path, "--out", folder / name], check=True, stdout=subprocess.DEVNULL)
    return [load_runs(folder / name)[0] for name in "abc"]


def expected(run):
    """The values of a run that h5py reads."""
    with h5py.File(run.file, "r") as file:
        vertices, triangles = len(file["rest/positions"]), len(file["rest/triangles"])
        points = file["VTKHDF/Points"][()].reshape(-1, vertices, 3)
        cell = lambda name: file[f"VTKHDF/CellData/{name}"][()].reshape(-1, triangles)
        springs = file["constraints/distance"] if "constraints/distance" in file else ()
        metrics = dict(zip(Facts(file).columns, file["metrics/values"][()].T.tolist()))
        return {"id": run.id, "times": metrics["time"],
                "positions": points.astype(float).ravel().tolist(),
                "max_stretch": cell("max_stretch").astype(float).ravel().tolist(),
                "min_stretch": cell("min_stretch").astype(float).ravel().tolist(),
                "shape": shapes(points.astype(float), file["rest/triangles"][()]).ravel().tolist(),
                "shape_median": metrics["shape_median"],
                "triangles": file["rest/triangles"][()].ravel().tolist(),
                "springs": springs["vertices"][()].ravel().tolist() if "vertices" in springs else None,
                "pinned": np.flatnonzero(file["rest/pinned"][()]).tolist()}


def shapes(points, triangles):
    """Shape quality (F, T) of the Verdict manual: 4√3 A / (a² + b² + c²)."""
    a, b, c = (points[:, triangles[:, i]] for i in range(3))
    area = np.linalg.norm(np.cross(b - a, c - a), axis=-1) / 2
    return 4 * np.sqrt(3) * area / sum(((x - y)**2).sum(axis=-1) for x, y in ((a, b), (b, c), (c, a)))


def main(program):
    node = shutil.which("node")
    if not node:
        print("skipped: no Node")
        return 77
    formulas = subprocess.run([node, "--test", HERE / "fields_test.mjs"], check=False).returncode
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        runs = compute(program, folder)
        labels = {runs[0].id: MARKUP, runs[1].id: "dihedral", runs[2].id: "fine"}
        player = write_page(folder / "page.html", runs, labels=labels)
        bare = json.loads(json.dumps(player.data["runs"][0]))
        bare |= {"id": "bare", "frames": None, "label": "bare", "remedy": "Do this: ./bendlab run again"}
        page = (folder / "page.html").read_text(encoding="utf-8")
        bare_json = json.dumps(bare).replace("<", "\\u003c")
        (folder / "bare.html").write_text(
            page.replace('"runs": [', f'"runs": [{bare_json}, ', 1)
            .replace("data-runs='", "data-runs='bare ", 1), encoding="utf-8")
        write_page(folder / "thin.html", runs[:1], limit=8000)
        (folder / "expected.json").write_text(json.dumps([expected(run) for run in runs]), encoding="utf-8")
        in_browser = subprocess.run([node, HERE / "player_test.mjs", folder],
                                    env=os.environ, check=False).returncode
        return formulas or in_browser


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
