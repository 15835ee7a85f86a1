"""Fabrics: a rigidity by direction, a moment that softens, internal friction, folds that stay, and maps."""
import numpy as np

from bendlab.results.load import group, select
from figures.stiffness import textile
from runs import strips
from truths import fabrics, validation

CUT = {(1, 0): 0, (0.866025, -0.5): 30, (1, -1): 45, (0.5, -0.866025): 60, (0, -1): 90}
LENGTH = 0.08  # m, of the strips that hang, beyond their clamp
CLOSE = 0.03  # tolerance of rigidities and of the depth, relative: that of the models' calibration
PARTS = ["first bending", "to the other side", "and back", "let go"]  # of a loop
PLAIN, FRICTION = "one B, no friction", "with friction"
COTTON = "cotton broad"
LOOP = {"width": 0.01, "moment": 4e-6}  # m and N m, of configs/stiffness/fabric_loop.json


def main(results, out, section):
    directions(strips.experiment_runs(results, section, "fabric_directions"), section)
    softening(strips.experiment_runs(results, section, "fabric_softening"), section)
    loops(strips.experiment_runs(results, section, "fabric_loop"), section)
    steps(strips.experiment_runs(results, section, "fabric_map"), section)
    isotropic = select(strips.experiment_runs(results, section, "drape", "drape_slow"), mesh__radius=0.15,
                       mesh__cells=textile.USUAL)
    drapes(strips.experiment_runs(results, section, "drape_friction", "drape_direction"),
           textile.curve_of(isotropic), section)


def angle_of(run):
    """The angle in degrees between the strip, which lies along x, and its warp."""
    x, y, _ = run.get("/material/warp_direction")
    return CUT[(x, y)]


def directions(runs, section):
    """Strips cut at five angles, against the rigidity 1/S11 of a narrow strip of an orthotropic sheet."""
    rows = []
    for run in runs:
        stated = run.get("/bending/rigidity")
        plate = fabrics.plate(stated["warp"], stated["weft"], stated["bias"])
        theory, wide = fabrics.strip(plate, angle_of(run)), fabrics.cylinder(plate, angle_of(run))
        section.checks.append(strips.check(
            run, f"rigidity of a strip cut at {angle_of(run)}° (N m)", theory, strips.rigidity(run), CLOSE,
            "orthotropic plate, 1/S11(φ)"))
        rows.append({"model": run.model, "mesh": strips.mesh_kind(run), "angle": angle_of(run),
                     "theory": 1e6 * theory, "wide": 1e6 * wide, "measured": 1e6 * strips.rigidity(run),
                     "share": strips.rigidity(run) / theory})
    rows.sort(key=lambda row: (row["model"], row["mesh"], row["angle"]))
    section.add_table("directions", "Strips cut at an angle φ to the warp hang from a clamp", [
        "model", "mesh", ("angle", "φ", "", "°"), ("theory", "strip, 1/S11(φ)", ".2f", "µN m"),
        ("wide", "wide sheet, D(φ)", ".2f", "µN m"), ("measured", "measured B", ".2f", "µN m"),
        ("share", "measured over strip", ".3f")], rows)
    if rows:
        best = max(abs(row["share"] - 1) for row in rows if row["model"] == "mid_edge")
        section.add_chart(
            "directions", f"mid_edge agrees with 1/S11(φ) at every angle within {100 * best:.1f} %",
            "angle", ["share"], ["model"], held=["mesh"], scale="linear", y_scale="linear",
            limits=[("share", 1 + CLOSE, "tolerance"), ("share", 1 - CLOSE, "")])


def shape_of(run):
    """(reach, depth) in m of the free end, from the clamp's edge."""
    rest, end = run.rest_positions, run.positions(-1)
    clamp = rest[run.pinned][:, 0].max()
    tip = np.isclose(rest[:, 0], rest[:, 0].max())
    return float(end[tip, 0].mean() - clamp), float(-end[tip, 2].mean())


def softening(runs, section):
    """Strips whose moment softens, against the elastica of the same law."""
    rows = []
    for run in runs:
        law, rigidity = run.get("/bending/softening"), run.get("/bending/flexural_rigidity")
        table = law.get("curvatures")
        curvature = (fabrics.table(table, law["moments"]) if table
                     else fabrics.softening(rigidity, law["half_at"]))
        theory = fabrics.cantilever(LENGTH, run.get("/material/density") * strips.gravity(run), curvature)[-1]
        reach, depth = shape_of(run)
        name = "table" if table else "none" if law["half_at"] > 1e4 else f"κ½ = {law['half_at']:g} /m"
        section.checks.append(strips.check(run, f"depth of the free end, softening {name} (m)", -theory[1],
                                           depth, CLOSE, "our elastica (analysis/truths/fabrics.py)"))
        rows.append({"model": run.model, "softening": name, "theory": -100 * theory[1], "depth": 100 * depth,
                     "off": 100 * (depth / -theory[1] - 1)})
    section.add_table("softening", "Strips of 8 cm whose moment softens hang from a clamp", [
        "model", "softening", ("theory", "depth of the free end, elastica", ".3f", "cm"),
        ("depth", "depth, measured", ".3f", "cm"), ("off", "error", "+.2f", "%")], rows)


def bent(run, frame):
    """Curvature in 1/m of the middle half of the strip, from the angles of its tangents, with a sign."""
    rest, now = run.rest_positions, run.positions(frame)
    low, high = rest[~run.pinned][:, 0].min(), rest[:, 0].max()
    middle = np.isclose(rest[:, 1], rest[np.abs(rest[:, 1]).argmin(), 1])
    order = np.argsort(rest[middle, 0])
    x, line = rest[middle, 0][order], now[middle][order]
    angle = np.unwrap(np.arctan2(np.diff(line[:, 2]), np.diff(line[:, 0])))
    s = (x[1:] + x[:-1]) / 2
    inside = (s > low + (high - low) / 4) & (s < high - (high - low) / 4)
    return float(np.polyfit(s[inside], angle[inside], 1)[0])


def loops(runs, section):
    """Moment over curvature of a strip that is bent to both sides."""
    rows, summary = [], []
    for run in runs:
        load = run.get("/effects/0")
        times = run.metrics["time"]
        moments = np.interp(times, load["times"], load["factors"]) * LOOP["moment"] / LOOP["width"]
        curvatures = np.array([bent(run, frame) for frame in range(len(times))])
        curvatures *= np.sign(curvatures @ moments)
        friction, fold = run.get("/bending/hysteresis"), run.get("/bending/plasticity")
        rigidity, most = run.get("/bending/flexural_rigidity"), LOOP["moment"] / LOOP["width"]
        law = "internal friction" if friction else "folds that stay" if fold else "elastic"
        name = f"{law}, {run.model}"
        part = np.searchsorted([load["times"][k] for k in (2, 3, 4)], times)
        rows += [{"strip": name, "part": PARTS[p], "time": t, "curvature": k, "moment": 1e3 * m}
                 for p, t, k, m in zip(part, times, curvatures, moments)]
        # From the largest moment, which is held for a while, to the opposite moment and back: a closed loop.
        loop = (times >= load["times"][2]) & (times <= load["times"][4])
        area = float(abs(np.trapz(moments[loop], curvatures[loop])))
        left = float(curvatures[-1])
        if friction:
            hb, slip = friction["hb"], friction["slip"]
            top = (most - hb) / rigidity  # the elastic part carries the rest of the moment
            section.checks += [
                strips.check(run, "area of the loop (N/m)", 4 * hb * (top - slip), area, 0.05,
                             "M = B κ ± HB"),
                strips.check(run, "curvature that is left (1/m)", hb / rigidity, left, 0, "HB/B", "most")]
        if fold:
            reached = (most / rigidity - (1 - fold["hardening"]) * fold["yield_at"]) / fold["hardening"]
            first = (1 - fold["hardening"]) * (reached - fold["yield_at"])
            peak = int(np.argmin(np.abs(times - load["times"][2])))
            let_go = (load["times"][2] + load["times"][3]) / 2  # the moment is 0 on its way to the other side
            section.checks += [
                strips.check(run, "curvature when the moment first reaches its maximum (1/m)", reached,
                             float(curvatures[peak]), 0.05, "M = B κy + h B (κ - κy)"),
                strips.check(run, "curvature that stays without a moment (1/m)", first,
                             float(np.interp(let_go, times, curvatures)), 0.05, "(1 - h)(κ - κy)")]
        summary.append({"strip": name, "area": area, "left": left,
                        "bound": friction["hb"] / rigidity if friction else np.nan})
    if not rows:
        return
    section.add_table("loop_areas", "Loops of moment over curvature, after the first bending", [
        "strip", ("area", "area of the loop", ".4f", "N/m"), ("left", "curvature that is left", ".2f", "1/m"),
        ("bound", "HB/B", ".1f", "1/m")], summary)
    section.add_table("loops", "", ["strip", "part", ("time", "time", "", "s"),
                                    ("curvature", "curvature", "", "1/m"),
                                    ("moment", "moment", "", "mN")], rows)
    section.add_chart("loops", "Moment over curvature of a strip that is bent to both sides", "curvature",
                      ["moment"], ["part"], held=["strip"], scale="linear", y_scale="linear", look="")


def steps(runs, section):
    """A strip with a step in its rigidity, against the elastica with this step."""
    rows = []
    for run in runs:
        rigidity = run.get("/bending/flexural_rigidity")
        curvature = fabrics.linear(lambda s: 3 * rigidity if s < LENGTH / 2 else rigidity)
        theory = fabrics.cantilever(LENGTH, run.get("/material/density") * strips.gravity(run), curvature)[-1]
        _, depth = shape_of(run)
        section.checks.append(strips.check(run, "depth of the free end of a strip with a step in B (m)",
                                           -theory[1], depth, CLOSE,
                                           "our elastica (analysis/truths/fabrics.py)"))
        rows.append({"model": run.model, "cells": strips.cells(run), "theory": -100 * theory[1],
                     "depth": 100 * depth, "off": 100 * (depth / -theory[1] - 1)})
    section.add_table("steps", "A strip with three times the rigidity in the half at its clamp", [
        "model", ("cells", "cells along the strip"),
        ("theory", "depth of the free end, elastica", ".3f", "cm"), ("depth", "depth, measured", ".3f", "cm"),
        ("off", "error", "+.2f", "%")],
        sorted(rows, key=lambda row: (row["model"], row["cells"])))


def fabric_of(run):
    """The fabric of textile.FABRICS whose B/ρ a run has."""
    stated = run.get("/bending/rigidity") or {}
    rigidity = (stated["warp"] + stated["weft"]) / 2 if stated else run.get("/bending/flexural_rigidity")
    ratio = rigidity / run.get("/material/density")
    return min(textile.FABRICS, key=lambda fabric: abs(textile.FABRICS[fabric][0] / textile.FABRICS[fabric][2]
                                                       - ratio))


def law_of(run):
    """What a run of a drape has besides one rigidity, in words."""
    friction, stated = run.get("/bending/hysteresis"), run.get("/bending/rigidity")
    if friction:
        return FRICTION
    if not stated:
        return PLAIN
    huber = fabrics.bias_of_huber(stated["warp"], stated["weft"])
    bias = stated.get("bias") or huber
    return f"warp over weft {stated['warp'] / stated['weft']:.3g}, bias {bias / huber:.2g} × Huber's"


def drapes(runs, curve, section):
    """Cusick's drape with friction, and with a rigidity that depends on the direction, validated against the
    measured drape. `curve`: that of an isotropic sheet without friction, for the effect of uncertain inputs.
    """
    cells = {number: group([run for run in runs if strips.cells(run) == number],
                           lambda run: (fabric_of(run), law_of(run)))
             for number in (textile.COARSE, textile.USUAL)}
    coarse, usual = ({key: [100 * strips.number(run, "drape_coefficient") for run in own]
                      for key, own in groups.items()} for groups in cells.values())
    if not usual:
        return
    scatter = validation.scatter(usual.values())
    both = [np.mean(usual[key]) - np.mean(coarse[key]) for key in usual if key in coarse]
    mesh = (validation.mesh_uncertainty(both, textile.USUAL / textile.COARSE, textile.ORDER) if both
            else np.nan)
    rows = []
    for (name, law), values in sorted(usual.items()):
        rigidity, rough, weight, measured = textile.FABRICS[name]
        directions = textile.DIRECTIONS if law in (PLAIN, FRICTION) else 0
        friction = 0 if law == FRICTION else textile.u_friction(curve, rigidity, rough, weight)
        case = validation.Validation(measured, float(np.mean(values)),
                                     float(np.hypot(scatter / np.sqrt(len(values)), mesh)),
                                     float(np.hypot(friction, textile.u_input(curve, rigidity, weight,
                                                                              directions))),
                                     textile.DRAPE * measured)
        if law != PLAIN and case.holds is not None:
            section.add_check(f"drape coefficient of {name} (%), {law}", "mid_edge",
                              textile.TESTERS[0.15][1], case.data, case.simulation, round(case.u_val, 2),
                              "Matsudaira and others 2015, by transcription", "absolute",
                              f"validation by ASME V&V 20: {case.verdict('points')}")
        rows.append({"fabric": name, "law": law, "data": case.data, "simulation": case.simulation,
                     "error": case.error, "u_num": case.u_num, "u_input": case.u_input,
                     "u_data": case.u_data, "u_val": case.u_val, "ratio": abs(case.error) / case.u_val,
                     "verdict": case.verdict("points")})
    of = lambda law: next((row["simulation"] for row in rows if (row["fabric"], row["law"]) == (COTTON, law)),
                          np.nan)
    answer = (f"friction raises {COTTON} from {of(PLAIN):.1f} to {of(FRICTION):.1f} %, "
              f"measured {textile.FABRICS[COTTON][-1]} %")
    farther = sum(row["law"] == FRICTION and abs(row["error"]) > abs(plain["error"]) for row in rows
                  for plain in rows if (plain["fabric"], plain["law"]) == (row["fabric"], PLAIN))
    if farther:
        answer += f"; it moves {farther} of {len(textile.FABRICS)} fabrics away from the measurement"
    section.add_table(
        "drapes",
        "Drape with friction, and by direction (diameters: specimen 30 cm, table 18 cm): " + answer, [
            "fabric", ("law", "bending"), ("data", "D, measured", ".1f", "%"),
            ("simulation", f"S, simulated on {textile.USUAL} cells", ".1f", "%"),
            ("error", "E = S − D", "+.1f", "points"), ("u_num", "u_num", ".1f", "points"),
            ("u_input", "u_input", ".1f", "points"), ("u_data", "u_D", ".1f", "points"),
            ("u_val", "u_val", ".1f", "points"), ("ratio", "|E|/u_val", ".2f"), "verdict"], rows)
