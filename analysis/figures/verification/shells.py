"""Benchmarks of shells: loads, moments, rings, roofs, twisted beams."""
import json

import numpy as np

from runs import verified
from tables.committed import COMMITTED
from truths import cantilevers, shells


def main(results, out, section):
    rows = []
    for run_rows in (end_shear, end_moment, slit, roof, pinched, hemispheres, twisted):
        rows += run_rows(results, section)
    section.add_table("shells", "Displacements over published or exact values", [
        "benchmark", ("quantity", "displacement"), "model", ("family", "mesh"),
        ("truth", "expected (in the unit of length of the benchmark)", ".6g"),
        *verified.columns(), "source"], rows)
    section.text += independent(rows)
    oracle(section)
    bars = [row for row in rows if row["benchmark"] == "end shear" and row["family"] == "alternating"]
    section.add_table("shear", "", ["model", "quantity", ("off", "error of the finest mesh", "+.2f", "%")],
                      bars)
    section.add_chart("shear", "Cantilever with end shear: error of the tip's displacement", "quantity",
                      ["off"], scale="band", joined=False, y_scale="linear")


def independent(rows):
    """A sentence: how near the limits of two models with different unknowns are on the slit ring, for which
    no exact solution is known."""
    limits = {}
    for row in rows:
        if row["benchmark"] == "slit ring" and row["model"] in ("mid_edge", "dkt"):
            limits.setdefault(row["quantity"], []).append(row["limit"])
    apart = [100 * abs(pair[0] / pair[1] - 1) for pair in limits.values() if len(pair) == 2]
    if not apart or not np.isfinite(apart).all():
        return ""
    return (" No exact solution of the slit ring is known, but mid_edge and dkt, which have different "
            f"unknowns, converge to numbers that differ by at most {max(apart):.3f} %.")


def _rows(benchmark, quantity, runs, value, truth, source, *more):
    """A row for each model and family of meshes. `value`: run → displacement."""
    rows = []
    for (model, family, *_), own in verified.by_model_and_family(runs, *more).items():
        made = verified.converging(own, value, truth)
        rows.append({"benchmark": benchmark, "quantity": quantity, "model": model, "family": family,
                     "truth": truth, "source": source} | made.cells())
    return rows


def _tip(run):
    """The mean displacement of the free end: the vertices with the largest x at rest."""
    rest = run.rest_positions
    end = rest[:, 0] > rest[:, 0].max() - 1e-6
    return (run.positions(-1) - rest)[end].mean(0)


def end_shear(results, section):
    runs = verified.runs_of(results, section, "end_shear")
    rows = []
    for share, force in ((0.5, -2), (1.0, -4)):
        own = [run for run in runs if run.get("/effects/0/force")[2] == force]
        for axis, (target, name) in enumerate(zip(shells.SHEARED.targets, ("down", "in"))):
            value = (lambda run: -_tip(run)[2]) if axis == 0 else (lambda run: -_tip(run)[0])
            exact = 10 * cantilevers.end_shear(4 * share)[axis]
            rows += _rows("end shear", f"{name}, {share:g} of the load", own, value, exact,
                          "exact elastica; Sze, Liu and Lo 2004, as copied in Project Chrono: "
                          f"{target.values[share]}")
    return rows


def end_moment(results, section):
    runs = verified.runs_of(results, section, "end_moment")
    whole = shells.ROLLED.loads[0].size
    rows = []
    for share in (0.25, 0.5, 1.0):
        own = [run for run in runs if abs(run.get("/effects/0/moment") / whole - share) < 1e-9]
        up, back = cantilevers.end_moment(share)[:2]
        if share < 1:
            rows += _rows("end moment", f"across, {share:g} of the circle", own,
                          lambda run: abs(_tip(run)[2]), 12 * abs(up), "closed form")
        rows += _rows("end moment", f"in, {share:g} of the circle", own, lambda run: -_tip(run)[0],
                      12 * abs(back), "closed form")
    return rows


def slit(results, section):
    runs = verified.runs_of(results, section, "slit_annulus", "slit_annulus_slow")
    rows = []
    for share, force in ((0.5, 1.6), (1.0, 3.2)):
        own = [run for run in runs if run.get("/effects/0/force")[2] == force]
        for radius, target in zip((6, 10), shells.SLIT.targets):
            def value(run, radius=radius):
                angle = np.radians(run.get("/mesh/surface/sweep"))
                rest = run.rest_positions
                place = radius * np.array([np.cos(angle), np.sin(angle), 0])
                near = np.argsort(np.linalg.norm(rest - place, axis=1))[:8]
                moved = (run.positions(-1) - rest)[near]
                exact = np.linalg.norm(rest[near] - place, axis=1) < 1e-6
                return float(np.abs(moved[exact][:, 2]).max())
            rows += _rows("slit ring", f"at radius {radius}, {share:g} of the load", own, value,
                          target.values[share], "Sze, Liu and Lo 2004, as copied in Project Chrono")
    return rows


def roof(results, section):
    runs = verified.runs_of(results, section, "roof")
    angle = np.radians(40)
    place = (25 * np.sin(angle), 0, 25 * (1 - np.cos(angle)))
    value = lambda run: 100 * verified.corner_displacement(
        run, np.array(place) + [0, run.rest_positions[:, 1].mean(), 0])[2]
    return _rows("Scordelis-Lo roof", "of a free edge", runs, value, shells.ROOF.targets[0].computed(),
                 "thin-shell theory (analysis/truths)")


def pinched(results, section):
    runs = verified.runs_of(results, section, "pinched_cylinder", "pinched_cylinder_slow")

    def value(run):
        """The displacement along the load, for a load of 1."""
        force = np.array(run.get("/effects/0/force"))
        moved = verified.displacement(run, run.get("/effects/0/indices")[0])
        return float(moved @ force / (force @ force))
    return _rows("pinched cylinder", "of a load", runs, value, shells.PINCHED.targets[0].computed(),
                 "thin-shell theory (analysis/truths); Belytschko and others 1985: 1.8248e-5")


def hemispheres(results, section):
    rows = []
    value = lambda run: 100 * verified.displacement(run, run.get("/effects/0/indices")[0])[0]
    for benchmark, name, configs in (
            (shells.HOLED, "hemisphere with a hole", ["hemisphere_hole"]),
            (shells.CLOSED, "hemisphere", [f"hemisphere_closed_{rings}" for rings in (8, 16, 32)])):
        target = benchmark.targets[0]
        rows += _rows(name, "of a load", verified.runs_of(results, section, *configs), value,
                      target.computed(),
                      f"thin-shell theory (analysis/truths); published: {target.values[1.0]}")
    return rows


def twisted(results, section):
    runs = verified.runs_of(results, section, "twisted_beam")
    rows = []
    for benchmark, force in ((shells.IN_PLANE, [0, 1, 0]), (shells.OUT_OF_PLANE, [0, 0, 1])):
        own = [run for run in runs if run.get("/effects/0/force") == force]
        for target in benchmark.targets:
            direction = lambda run: np.array(run.get("/effects/0/force"))
            rows += _rows("twisted beam", benchmark.name.rpartition(" ")[2], own,
                          lambda run: float(_tip(run) @ direction(run)), target.values[1.0],
                          "MacNeal and Harder 1985")
    return rows


def oracle(section):
    """The results of CalculiX, which analysis/solve_oracle.py made."""
    file = COMMITTED / "verification" / "calculix.json"
    if not file.exists():
        section.missing.append("results/verification/calculix.json, which python3 analysis/solve_oracle.py "
                               "makes")
        return
    stored = json.loads(file.read_text(encoding="utf-8"))
    rows = [{**row, "off": 100 * (row["value"] / row["truth"] - 1) if row["truth"] else np.nan}
            for row in stored["rows"]]
    section.add_table("calculix", f"CalculiX {stored['version']}, from the input files in "
                      "results/verification/calculix", [
                          "benchmark", "element", "mesh", ("load", "share of the load"), "quantity",
                          ("value", "CalculiX", ".5g"), ("truth", "expected", ".5g"),
                          ("off", "difference", "+.2f", "%")], rows)
