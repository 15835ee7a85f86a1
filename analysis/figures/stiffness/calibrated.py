"""Measured stiffness over stated physical stiffness, compared with stiffness by the paper's rule."""
import numpy as np

from bendlab.results import registry
from bendlab.results.load import group
from runs import strips
from tables.numbers import span

LIMITS = {"equilateral": 0.05, "delaunay": 0.15}
STATED = "the stiffness in the config"
NO_FIT = "from H/W; no fit is possible, because the n-ring at the clamp covers most of the strip"
RULES = "stated stiffness", "the paper's rule (k = 0.5, eq. 6)"
# Limits for hinges that are calibrated at small deflection
SMALL_LIMITS = {"equilateral": 0.03, "alternating": 0.03, "both": 0.05, "delaunay": 0.03}
# What small_deflection computes from the mesh
COMPUTED = {"small_deflection": "sheet, mean over directions", "large_deflection": "sheet held to a cylinder",
            "small_strip": "free narrow strip"}


def main(results, out, section):
    runs = strips.experiment_runs(results, section, "calibrated", "calibrated_slow", "calibrated_96_slow",
                                  "calibrated_irregular", "calibrated_irregular_slow",
                                  "calibrated_irregular_full")
    membranes = strips.experiment_runs(results, section, "membrane")
    before = strips.experiment_runs(results, section, "resolution", "resolution_slow")
    small = strips.experiment_runs(results, section, "small_deflection")
    section.text = intro_text(runs) + (f" {small_text(small)}" if small else "")
    for run in runs:
        section.checks.append(strips.check(
            run, "stiffness, measured over stated", 1, share(run), LIMITS[strips.family(run)], STATED,
            model=name(run), note=NO_FIT if np.isnan(strips.fit(run, "C")) else ""))
    for (model, family), own_runs in group(runs, lambda run: (name(run), strips.family(run))).items():
        section.add_check("largest ratio of stiffness between two resolutions", model,
                          strips.meshes_name(own_runs), 1 + LIMITS[family],
                          strips.largest_ratio(map(share, own_runs)), 0, "calibration on every mesh", "most")
    for run in small:
        if run.get("/bending/deflection") == "small" and strips.family(run) in SMALL_LIMITS:
            section.checks.append(strips.check(
                run, "stiffness at small deflection, measured over stated", 1, strips.share_of_droop(run),
                SMALL_LIMITS[strips.family(run)], STATED))
    _add_small(section, small)
    place = lambda run: (name(run), strips.family(run), strips.cells(run))
    section.add_table("calibrated", "Calibrated", [
        ("name", "model"), "mesh", ("cells", "cells along the length"),
        ("share", "stiffness, measured over stated", ".3f"), ("share_droop", "measured from H/W over stated"),
        ("p", "p of m ∝ κ^p", ".3f"), ("droop", "H/W"), ("springs", "springs", ".0f")],
        [{"name": name(run), "model": run.model, "mesh": strips.mesh_kind(run), "cells": strips.cells(run),
          "share": share(run), "share_droop": strips.share_of_droop(run), "p": strips.fit(run, "exponent"),
          "droop": strips.droop(run),
          "springs": strips.number(run, "springs") if registry.made_of(run.model) == "springs" else None}
         for run in sorted(runs, key=place)])
    ratios = _ratios(runs, RULES[0], name, share)
    if runs:
        ratios += _ratios(before, RULES[1], lambda run: run.model, strips.rigidity)
    section.add_table("summary", "Largest over smallest stiffness of all resolutions", [
        ("name", "model"), "rule", "mesh", ("cells", "cells"), ("ratio", "largest ratio", ".3f"),
        ("share", "measured over stated", ".3f"), ("p", "p of m ∝ κ^p", ".2f"),
        ("family", "family", "", "", "", False)], ratios)
    section.add_chart("summary", "Does the stiffness change with the mesh?", "name", ["ratio"],
                      ["rule", "mesh"], id="calibrated", scale="band", y_scale="log", look="", on_top=True,
                      limits=[("ratio", 1, "no change")], note="Largest over smallest stiffness of all "
                      "resolutions. Irregular meshes end at 48 cells.")
    section.add_chart("calibrated", _title(ratios), "cells", ["share"], ["name"], id="calibrated_cells",
                      held=["mesh"], scale="log2", look="model", limits=strips.as_stated("share"))
    _add_membrane(section, membranes)


def _add_small(section, runs):
    """Adds the table of small deflections."""
    place = lambda run: (strips.family(run), run.get("/mesh/rows", ""), run.get("/bending/deflection"))
    rows = []
    for run in sorted(runs, key=place):
        rows.append({"mesh": strips.mesh_name(run), "deflection": run.get("/bending/deflection"),
                     "share": strips.share_of_droop(run)})
        for kind in COMPUTED:
            value, least, most = (strips.number(run, f"model_{kind}{end}") for end in ("", "_least", "_most"))
            rows[-1] |= {kind: value, f"{kind}_range": (least, most)}
    section.add_table("small", "Small deflection: hinges (dihedral), the tip deflects by L / 1000", [
        "mesh", ("deflection", "calibrated at deflection"), ("share", "measured over stated", ".3f"),
        *(column for kind, label in COMPUTED.items()
          for column in ((kind, label, ".3f"), (f"{kind}_range", "from – to", ".3f")))], rows)


def _add_membrane(section, runs):
    """Adds the table and the chart of the influence of the membrane."""
    rows = [{"model": run.model, "mesh": strips.mesh_kind(run), "cells": strips.cells(run),
             "alpha": run.get("/material/strain/compliance"), "share": share(run),
             "share_droop": strips.share_of_droop(run)} for run in runs]
    section.add_table("membrane", "What the compliance of the membrane does", [
        "model", "mesh", ("cells", "cells"), ("alpha", "compliance α of the membrane", "", "m/N"),
        ("share", "stiffness, measured over stated", ".3f"), ("share_droop", "the same from H/W", ".3f")],
        rows)
    shares = {mesh: [row["share"] for row in own_rows]
              for mesh, own_rows in group(rows, lambda row: row["mesh"]).items()}
    ranges = ", ".join(f"{mesh} {span(own)}" for mesh, own in shares.items())
    section.add_chart(
        "membrane", f"The membrane reduces or increases the stiffness. Measured over stated: {ranges}",
        "alpha", ["share", "share_droop"], ["model", "cells"], held=["mesh"],
        limits=strips.as_stated("share", "share_droop"))


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


def lengths_text(runs):
    """A sentence: the length of the springs in cm, and in edges at every resolution, from the configs."""
    springs = [run for run in runs if run.get(f"/bending/{run.model}/radius")
               and registry.has_springs_at_rest(run.model) and strips.family(run) == "equilateral"]
    if not springs:
        return ""
    radius = max(run.get(f"/bending/{run.model}/radius") for run in springs)
    edges = {strips.cells(run): round(radius * strips.cells(run) / run.get("/mesh/width")) for run in springs}
    counts = [", ".join(map(str, sorted(numbers))) for numbers in (edges.values(), edges)]
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
    wide = run.model == "adaptive" and run.get("/bending/adaptive/pin_zone")
    return f"{run.model}, n-ring at pins" if wide else run.model


def share(run):
    """Stiffness over the stated stiffness: from the moment-curvature fit, or from H/W if there is no fit."""
    kind = "C" if registry.has_springs_at_rest(run.model) else "B"
    fit = strips.fit(run, kind) / strips.stated(run)
    return strips.share_of_droop(run) if np.isnan(fit) else fit


def _title(ratios):
    """The title: by which factors refinement changes the stiffness, with each rule."""
    stated, ruled = ([row["ratio"] for row in ratios if row["rule"] == rule] for rule in RULES)
    if not (ruled and stated):
        return "The stated stiffness, on finer meshes"
    return (f"Refinement changes the stiffness by factors of {span(ruled, 2)} with the paper's rule, and of "
            f"{min(stated):.2f} to {max(stated):.2f} with a stated stiffness")


def _ratios(runs, rule, name_of, value):
    """Rows: largest over smallest stiffness of each model on each kind of mesh."""
    rows, groups = [], group(sorted(runs, key=name_of), lambda run: (name_of(run), strips.family(run)))
    for (model, family), own_runs in groups.items():
        own_runs = [run for run in own_runs if np.isfinite(value(run))]
        values = list(map(value, own_runs))
        exponents = [p for run in own_runs if np.isfinite(p := strips.fit(run, "exponent"))]
        stated = rule == RULES[0]
        rows.append({"name": model, "rule": rule, "family": family, "mesh": strips.MESH_NAMES[family],
                     "cells": strips.cells_range(own_runs), "ratio": strips.largest_ratio(values),
                     "share": (min(values), max(values)) if stated and values else None,
                     "p": (min(exponents), max(exponents)) if stated and exponents else None})
    return [row for row in rows if np.isfinite(row["ratio"]) and row["name"] != "none"]
