"""Strips of hinges against the heavy elastica (a strip that bends under its weight, in theory)."""
import numpy as np

from bendlab.results.load import group
from runs import strips

GIVEN = 1.5696e-3  # N m; B of every model with the compliances in the config
CURVE = "heavy elastica, Runge-Kutta (analysis/runs/strips.py)"
# Width of the strip in cm → B from H/W over the stated B, at 0.003 g, measured with REPEAT. The ratio
# approaches 1 as the width grows. In theory, a narrow beam has a ratio of 1 - ν² = 0.889.
WIDTHS = {3: 0.928, 6: 0.944, 12: 0.964, 20: 0.978, 40: 0.989}
REPEAT = ("./bendlab run configs/stiffness/gravity.json --out /tmp/widths --set /mesh/height=0.03 "
          "--set '/bending={\"model\":\"discrete_shells\",\"stiffness\":\"physical\","
          "\"flexural_rigidity\":0.0015696}'")
ACROSS = ("under small loads the free edges also bend across the strip, so that a narrow strip has a "
          "smaller B than a wide sheet. In separate runs at 0.003 g, B from H/W over the stated B is "
          f"{', '.join(f'{share:.3f}' for share in WIDTHS.values())} for widths of "
          f"{', '.join(map(str, WIDTHS))} cm ({REPEAT}, and with other values of /mesh/height)")


def main(results, out, section):
    """Measures all hinge models, with compliances that give one flexural rigidity."""
    runs = strips.experiment_runs(results, section, "hinges", "hinges_slow")
    control = strips.experiment_runs(results, section, "control")
    loads = [strips.load_number(run, GIVEN) for run in runs]
    points = list(zip(runs, loads, strips.elastica_droop(loads)))
    section.checks = [check for point in points for check in _checks(*point)]
    for own_runs in group(runs, lambda run: (run.model, strips.cells(run))).values():
        check = strips.exponent_check(own_runs[0].model, own_runs, 1, "linear elasticity")
        section.checks += [check] if np.isfinite(check.measured) else []
    # The membrane without bending has a small B, which is an error of every measured B.
    section.checks += [strips.check(run, "B of the membrane without bending (N m), from H/W", 0.02 * GIVEN,
                                    floor_rigidity(run), 0, "2 % of the stated B of hinges", "most",
                                    note="no straight lines to fold along"
                                    if strips.family(run) == "delaunay" else "") for run in control]
    floor = {strips.cells(run): floor_rigidity(run) for run in control if strips.family(run) == "equilateral"}
    place = lambda point: (point[0].model, strips.cells(point[0]), strips.gravity(point[0]))
    rows = [{"model": run.model, "cells": strips.cells(run), "load": load, "droop": strips.droop(run),
             "off": 100 * (strips.droop(run) / theory - 1), "B_droop": strips.rigidity(run) / GIVEN,
             "B_moment": strips.fit(run, "B") / GIVEN, "p": strips.fit(run, "exponent"),
             "floor": floor.get(strips.cells(run), np.nan) / GIVEN}
            for run, load, theory in sorted(points, key=place)]
    section.add_table("hinges", "Hinges; B over the stated B", [
        "model", ("cells", "cells along the strip"), ("load", "Γ = ρ g L³ / B"),
        ("droop", "H/W of the free end", ".4f"), ("off", "H/W over theory − 1", "+.2f", "%"),
        ("B_droop", "B from H/W over B", ".3f"),
        ("B_moment", "B from m(κ) over B", ".3f", "", "from moment and curvature along the strip"),
        ("p", "p of m ∝ κ^p", ".3f"), ("floor", "control: B without bending over B")], rows)
    loads = np.geomspace(0.2, 200, 60)
    section.add_table("elastica", "", ["model", "load", "droop"], [
        {"model": "heavy elastica", "load": load, "droop": droop}
        for load, droop in zip(loads, strips.elastica_droop(loads))])
    off = [abs(row["off"]) for row in rows if is_resolved(row["load"], row["cells"])]
    title = (f"{len({run.model for run in runs})} hinge models are within {max(off):.1f} % of the heavy "
             "elastica where the mesh resolves the fold"
             if off else "How far strips of hinges hang down, compared with theory")
    section.add_chart("hinges", title, "load", ["droop", "off"], held=["cells"], theory="elastica",
                      limits=[("off", 1, "tolerance"), ("off", -1, "tolerance")])
    section.add_chart("hinges", "Measured flexural rigidity of hinges over the stated rigidity", "load",
                      ["B_droop", "B_moment"], id="hinges_rigidity", held=["cells"],
                      limits=strips.as_stated("B_droop", "B_moment"))


def is_resolved(load, cells):
    """Whether a mesh resolves the fold at the clamp."""
    return load < 60 or cells >= 48


def _checks(run, load, droop):
    """The checks of a run; `droop`: H/W of theory."""
    if not is_resolved(load, strips.cells(run)):
        return []
    at = f"at Γ = {load:.3g}"
    checks = [strips.check(run, f"H/W {at}", droop, strips.droop(run), 0.01, CURVE)] if load > 0.7 else []
    return checks + [
        strips.check(run, f"B from H/W {at} (N m)", GIVEN, strips.rigidity(run), 0.02, "the compliance"),
        strips.check(run, f"B from m(κ) {at} (N m)", GIVEN, strips.fit(run, "B"), 0.02, "the compliance",
                     note=ACROSS if load < 0.2 else ""),
        strips.check(run, f"exponent p of m ∝ κ^p {at}", 1, strips.fit(run, "exponent"), 0.02,
                     "linear elasticity", "absolute")]


def floor_rigidity(run):
    """B from H/W; 0 if the strip hangs straight down or past the vertical, where no elastica has this H/W."""
    return float(np.nan_to_num(strips.rigidity(run)))
