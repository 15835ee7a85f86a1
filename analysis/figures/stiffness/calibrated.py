"""Measured stiffness over stated physical stiffness, compared with stiffness by the paper's rule."""
import numpy as np

from tables.numbers import number
from bendlab.results import registry
from runs import strips
from bendlab.results.load import group
from tables.chart import Chart
from tables.section import Check
from tables.table import Table

LIMITS = {"equilateral": 0.05, "delaunay": 0.15}
STATED = "the stiffness in the config"
RULES = "stated stiffness", "the paper's rule (k = 0.5, eq. 6)"
# Limits for hinges that are calibrated at small deflection
SMALL_LIMITS = {"equilateral": 0.03, "alternating": 0.03, "both": 0.05, "delaunay": 0.03}


def main(results, out, section):
    runs = strips.experiment_runs(results, section, "calibrated", "calibrated_slow", "calibrated_96_slow",
                                  "calibrated_irregular", "calibrated_irregular_slow",
                                  "calibrated_irregular_full")
    membranes = strips.experiment_runs(results, section, "membrane")
    before = strips.experiment_runs(results, section, "resolution", "resolution_slow")
    small = strips.experiment_runs(results, section, "small_deflection")
    section.text = intro_text(runs)
    section.checks = [*_checks(runs), *_small_checks(small)]
    if small:
        section.text += " " + small_text(small)
        section.tables.append(_small_table(small))
    section.tables += [_table(runs), _summary(runs, before)] if runs else []
    section.tables += [_membrane_table(membranes)] if membranes else []
    section.charts = [
        Chart("calibrated", "Does the stiffness change with the mesh?", "summary", "name", ["ratio"],
              ["rule", "mesh"],
              scale="band", y_scale="log", look="", on_top=True, limits=[("ratio", 1, "no change")],
              note="Largest over smallest stiffness of all resolutions. Irregular meshes end at 48 cells."),
        Chart("calibrated_cells", _title(section.table("summary")), "calibrated", "cells", ["share"],
              ["name"],
              held=["mesh"], scale="log2", look="model", limits=strips.as_stated("share")),
        Chart("membrane", _membrane_title(section.table("membrane")), "membrane", "alpha",
              ["share", "share_droop"],
              ["model", "cells"], held=["mesh"], limits=strips.as_stated("share", "share_droop"))]


def intro_text(runs):
    """The section's text: what is measured, with numbers from the runs and the limits."""
    return ("From the mesh, each model computes the compliances with which its constraints should have the "
            f"stated B (hinges) or C (springs at rest). {lengths_text(runs)} Springs that push in the flat "
            "sheet (prestressed) have a B, like hinges. All runs are static equilibria. The stiffness is "
            "measured by a fit of moment against curvature, or from H/W if springs reach too far for a fit. "
            f"The goal is the stated stiffness within {100 * LIMITS['equilateral']:g} % on the lattice and "
            f"{100 * LIMITS['delaunay']:g} % on irregular meshes. Two effects prevent an exact result. The "
            "springs of a bent sheet stretch a soft membrane, which reduces the stiffness. An irregular "
            "mesh has no straight lines along which it could fold, so that a stiff membrane must stretch in "
            "order to bend, most of all at the ragged edge of the clamp. On irregular meshes H/W is more "
            "reliable than the fit, because the fit leaves out the clamp. So the membrane's compliance is "
            "10⁻⁷ m/N on the lattice and 10⁻⁶ m/N on the irregular mesh. The last chart shows the effect of "
            "this compliance.")


def _checks(runs):
    checks = []
    for run in runs:
        goal = LIMITS[strips.family(run)]
        checks.append(Check("stiffness, measured over stated", name(run), strips.mesh_name(run), 1,
                            share(run), goal, STATED, note=_note(run)))
    for (model, family), own_runs in group(runs, lambda run: (name(run), strips.family(run))).items():
        cells = sorted(strips.cells(run) for run in own_runs)
        mesh = f"{strips.MESH_NAMES[family]}, {cells[0]} to {cells[-1]} cells"
        checks.append(Check("largest ratio of stiffness between two resolutions", model, mesh,
                            1 + LIMITS[family], strips.largest_ratio(map(share, own_runs)), 0,
                            "calibration on every mesh", "most"))
    return checks


def _small_checks(small):
    checks = []
    for run in small:
        goal = SMALL_LIMITS.get(strips.family(run))
        if run.get("/bending/deflection") == "small" and goal:
            checks.append(Check("stiffness at small deflection, measured over stated", run.model,
                                strips.mesh_name(run), 1, share_of_droop(run), goal, STATED))
    return checks


def lengths_text(runs):
    """A sentence: the length of the springs in cm, and in edges at every resolution, from the configs."""
    springs = [run for run in runs if run.get(f"/bending/{run.model}/radius")
               and registry.has_springs_at_rest(run.model) and strips.family(run) == "equilateral"]
    if not springs:
        return ""
    radius = max(run.get(f"/bending/{run.model}/radius") for run in springs)
    edges = {strips.cells(run): round(radius * strips.cells(run) / run.get("/mesh/width")) for run in springs}
    counts = [", ".join(map(str, numbers)) for numbers in (sorted(edges.values()), sorted(edges))]
    return (f"Springs have one length, {100 * radius:.3g} cm, at every resolution ({counts[0]} edges at "
            f"{counts[1]} cells).")


def small_text(runs):
    """Text: the stiffness at small deflections; the runs give the energy on alternating diagonals."""
    left = [strips.number(run, "model_small_deflection") / strips.number(run, "model_large_deflection")
            for run in runs if strips.family(run) == "alternating"
            and run.get("/bending/deflection") == "large"]
    share = f"{left[0]:.2f}" if left else "–"
    return ("At small deflections a sheet takes shapes of lower energy than the cylinder on which a model "
            "is calibrated. On alternating diagonals, vertices with four neighbours take other heights than "
            f"vertices with eight neighbours, and the bending energy is {share} of the cylinder's, in every "
            "direction. A stiff membrane prevents shapes of lower energy above a curvature of about 4 √(B / "
            "Y) / h² (Y: stiffness of the membrane in N/m, h: length of an edge; an estimate, "
            "lib/bendlab/bending/sheet_response.hpp). So the stiffness at small deflections differs from "
            "the stiffness at large deflections, by a factor that depends on the mesh. The setting "
            "/bending/deflection chooses for which deflections the stated B is exact.")


def name(run):
    """The name of a run's model, and whether the run's pins have the paper's larger ring."""
    return f"{run.model}, n-ring at pins" if run.model == "adaptive" and run.get(
        "/bending/adaptive/pin_zone") else run.model


def _note(run):
    """A note if the stiffness of a run comes from H/W, with the reason."""
    if np.isnan(strips.number(run, "stiffness_fit_C")):
        return "from H/W; no fit is possible, because the n-ring at the clamp covers most of the strip"
    return ""


def share_of_droop(run):
    """Stiffness from H/W over the stated stiffness."""
    return strips.measured(run) / strips.stated(run)


def share(run):
    """Stiffness over the stated stiffness: from the moment-curvature fit, or from H/W if there is no fit."""
    kind = "C" if registry.has_springs_at_rest(run.model) else "B"
    fit = strips.number(run, f"stiffness_fit_{kind}") / strips.stated(run)
    return share_of_droop(run) if np.isnan(fit) else fit


def _title(rows):
    """The title: by which factors refinement changes the stiffness, with each rule."""
    of = lambda rule: [row["ratio"] for row in rows if row["rule"] == rule and np.isfinite(row["ratio"])]
    ruled, stated = of(RULES[1]), of(RULES[0])
    if not (ruled and stated):
        return "The stated stiffness, on finer meshes"
    return (f"Refinement changes the stiffness by factors of {number(min(ruled), 2)} to "
            f"{number(max(ruled), 2)} with the paper's rule, and of {min(stated):.2f} to {max(stated):.2f} "
            "with a stated stiffness")


def _membrane_title(rows):
    parts = [f"{mesh} {min(values):.2f} to {max(values):.2f}" for mesh, own_rows in group(
        rows, lambda row: row["mesh"]).items() if (values := [row["share"] for row in own_rows])]
    return f"The membrane reduces or increases the stiffness. Measured over stated: {', '.join(parts)}"


def _membrane_table(runs):
    rows = [{"model": run.model, "mesh": strips.MESH_NAMES[strips.family(run)], "cells": strips.cells(run),
             "alpha": run.get("/material/strain/compliance"), "share": share(run),
             "share_droop": share_of_droop(run)} for run in runs]
    return Table.of("membrane", "What the compliance of the membrane does", [
        "model", "mesh", ("cells", "cells"), ("alpha", "compliance α of the membrane", "", "m/N"),
        ("share", "stiffness, measured over stated", ".3f"), ("share_droop", "the same from H/W", ".3f")],
                    rows)


def _summary(runs, before):
    """Largest over smallest stiffness of each model on each kind of mesh, with each rule."""
    rows = []
    for rule, rule_runs, called, value in ((RULES[0], runs, name, share),
                                           (RULES[1], before, lambda run: run.model, strips.rigidity)):
        for (model, family), own_runs in group(sorted(rule_runs, key=called),
                                               lambda run: (called(run), strips.family(run))).items():
            numbers = list(map(value, own_runs))
            exponents = [p for run in own_runs
                         if np.isfinite(p := strips.number(run, "stiffness_fit_exponent"))]
            stated = rule == RULES[0]
            rows.append({"name": model, "rule": rule, "family": family, "mesh": strips.MESH_NAMES[family],
                         "cells": (min(map(strips.cells, own_runs)), max(map(strips.cells, own_runs))),
                         "ratio": strips.largest_ratio(numbers),
                         "share": (min(numbers), max(numbers)) if stated else None,
                         "p": (min(exponents), max(exponents)) if stated and exponents else None})
    rows = [row for row in rows if np.isfinite(row["ratio"]) and row["name"] != "none"]
    return Table.of("summary", "Largest over smallest stiffness of all resolutions", [
        ("name", "model"), "rule", "mesh", ("cells", "cells"), ("ratio", "largest ratio", ".3f"),
        ("share", "measured over stated", ".3f"), ("p", "p of m ∝ κ^p", ".2f"),
        ("family", "family", "", "", "", False)], rows)


def _small_table(runs):
    rows = []
    for run in sorted(runs, key=lambda run: (strips.family(run), run.get("/mesh/rows", ""),
                                             run.get("/bending/deflection"))):
        of = lambda kind: {kind: strips.number(run, f"model_{kind}"),
                           f"{kind}_range": tuple(strips.number(run, f"model_{kind}_{end}")
                                                  for end in ("least", "most"))}
        rows.append({"mesh": strips.mesh_name(run), "deflection": run.get("/bending/deflection"),
                     "share": share_of_droop(run), **of("small_deflection"), **of("large_deflection"),
                     **of("small_strip")})
    kinds = {"small_deflection": "sheet, mean over directions",
             "large_deflection": "sheet held to a cylinder",
             "small_strip": "free narrow strip"}
    return Table.of("small", "Small deflection: hinges (dihedral), the tip deflects by L / 1000", [
        "mesh", ("deflection", "calibrated at deflection"), ("share", "measured over stated", ".3f"),
        *(column for kind, label in kinds.items()
          for column in ((kind, label, ".3f"), (f"{kind}_range", "from – to", ".3f")))], rows)


def _table(runs):
    rows = [{"name": name(run), "model": run.model, "mesh": strips.MESH_NAMES[strips.family(run)],
             "cells": strips.cells(run), "share": share(run), "share_droop": share_of_droop(run),
             "p": strips.number(run, "stiffness_fit_exponent"), "droop": strips.droop(run),
             "springs": strips.number(run, "springs") if registry.made_of(run.model) == "springs" else None}
            for run in sorted(runs, key=lambda run: (name(run), strips.family(run), strips.cells(run)))]
    return Table.of("calibrated", "Calibrated", [
        ("name", "model"), "mesh", ("cells", "cells along the length"),
        ("share", "stiffness, measured over stated", ".3f"), ("share_droop", "measured from H/W over stated"),
        ("p", "p of m ∝ κ^p", ".3f"), ("droop", "H/W"), ("springs", "springs", ".0f")], rows)
