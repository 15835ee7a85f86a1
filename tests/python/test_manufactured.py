"""A manufactured solution: the virtual work of the elastic forces of a smooth pose, against the exact work.

    test_manufactured.py [--write]

--write replaces results/verification/manufactured.json, which the page of verification reads. Without it the
test compares the file with what the program computes now."""
import json
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np

import bendlab as bl

ROOT = Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "analysis"))
from truths import manufactured, order  # noqa: E402

STORED = ROOT / "results/verification/manufactured.json"
MEMBRANE, RIGIDITY = 1000.0, 1.0  # N/m and N m
CELLS = (8, 16, 32, 64)
CELLS_DKT = (4, 8, 16)  # dkt has no kernel
FAMILIES = {"same": {"diagonal": "same"}, "alternating": {"diagonal": "alternating"},
            "delaunay": {"generator": "delaunay", "seed": 1}}
MODELS = {"mid_edge": bl.MidEdge, "mid_edge_average": bl.MidEdgeAverage, "dkt": bl.Dkt,
          "corotational_face": bl.CorotationalFace, "discrete_shells": bl.DiscreteShells}


def works(model, family, cells):
    """{part: {displacement: work in J}}; parts are "membrane" and "bending"."""
    settings = {"width": 1.0, "height": 1.0, "cells": cells, **FAMILIES[family]}
    scene = bl.Scene(mesh=bl.Mesh(**settings), pins=[], effects=[], solver=bl.Newton(),
                     bending=MODELS[model](flexural_rigidity=RIGIDITY),
                     material=bl.Material(poisson_ratio=manufactured.POISSON, strain=bl.Strain(
                         form="stvk", membrane_stiffness=MEMBRANE)))
    flat = scene.simulate()
    low, triangles = flat.positions.min(0), flat.triangles
    x, y = (flat.positions - low)[:, :2].T
    with tempfile.NamedTemporaryFile("w", suffix=".obj") as file:
        np.savetxt(file, manufactured.pose(x, y).T, "v %.17g %.17g %.17g")
        np.savetxt(file, triangles + 1, "f %d %d %d")
        file.flush()
        scene.initial = bl.Initial(file=file.name)
        forces = scene.simulate().forces()
    return {("membrane" if part == "strain" else "bending"): {
        name: float((force * displacement(x, y).T).sum())
        for name, displacement in manufactured.DISPLACEMENTS.items()} for part, force in forces.items()}


def exact():
    """{part: {displacement: work in J}}"""
    of = {"membrane": (MEMBRANE, 0.0), "bending": (0.0, RIGIDITY)}
    return {part: {name: manufactured.virtual_work(displacement, *stiffness)
                   for name, displacement in manufactured.DISPLACEMENTS.items()}
            for part, stiffness in of.items()}


def rows():
    """A row for each model, kind of mesh, part and displacement, with the work on each mesh."""
    truth, found = exact(), []
    for family in FAMILIES:
        for model in MODELS:
            if model == "dkt" and family != "alternating":
                continue  # to save time
            meshes = CELLS_DKT if model == "dkt" else CELLS
            on_meshes = [works(model, family, cells) for cells in meshes]
            # Bending does next to no work on displacements along the sheet.
            for part, name in [("bending", "across")] + [
                    ("membrane", name) for name in truth["membrane"] if model == "mid_edge"]:
                found.append({"part": part, "model": model if part == "bending" else "stvk",
                              "family": family, "displacement": name, "cells": meshes,
                              "truth": truth[part][name],
                              "work": [float(f"{on_mesh[part][name]:.9g}") for on_mesh in on_meshes]})
    return found


def convergence(row):
    return order.converge([1 / cells for cells in row["cells"][-3:]], row["work"][-3:])


class Manufactured(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.rows = rows()

    def test_the_forces_converge_to_the_exact_work(self):
        """Linear triangles and Morley's triangle have errors ∝ h². So halving a regular mesh shows the order
        2, and the value extrapolated with this order is nearer to the truth by more than a factor of 10.
        Irregular meshes, and dkt on its coarse meshes, have to gain at least a factor of 2 per halving."""
        for row in self.rows:
            if row["model"] not in ("mid_edge", "dkt", "stvk"):
                continue
            with self.subTest(**{name: row[name] for name in ("model", "family", "displacement")}):
                errors = [abs(work / row["truth"] - 1) for work in row["work"]]
                self.assertLess(errors[-1], errors[0] / 2**(len(errors) - 1))
                if row["family"] != "delaunay" and row["model"] != "dkt":
                    self.assertAlmostEqual(convergence(row).order, 2, delta=0.3)
                    limit = order.extrapolated([2, 1], row["work"][-2:], 2)
                    self.assertLess(abs(limit / row["truth"] - 1), errors[-1] / 10)

    def test_the_stored_rows_are_those_of_the_program(self):
        stored = json.loads(STORED.read_text(encoding="utf-8"))["rows"]
        for row, old in zip(self.rows, stored, strict=True):
            np.testing.assert_allclose(row["work"], old["work"], rtol=1e-6)  # 9 digits are stored


if __name__ == "__main__":
    if "--write" in sys.argv:
        lines = ",\n".join(json.dumps(row) for row in rows())
        STORED.write_text(f'{{"rows": [\n{lines}\n]}}\n', encoding="utf-8")
    else:
        sys.argv[1:] = []
        unittest.main()
