"""The tests of textile laboratories: ASTM D1388, Cusick's drape, and the catenary."""
import right_python  # noqa: F401  (first: it may hand over to another Python)
import matplotlib.pyplot as plt
import numpy as np

import strips
import style
from bendlab.results.load import group
from report import Check, Section, Table, figure_main

# Flexural rigidity (N m), the same plus half the hysteresis 2HB at 0.5/cm, weight (kg/m²), drape coefficient
# (%). Matsudaira, Masuda, Wada, Yokura 2015, J. Textile Engineering 61(6), doi 10.4188/jte.61.69, tables 1
# and 2, from another
# project's transcription. We have not seen the original and do not know its specimen size.
FABRICS = {"polyester faille": (1.863e-6, 2.550e-6, 0.1043, 28.3),
           "wool tropical": (6.570e-6, 9.807e-6, 0.1629, 49.8),
           "polyester tropical": (7.551e-6, 1.040e-5, 0.1165, 50.7),
           "cotton broad": (1.157e-5, 2.373e-5, 0.1238, 82.9)}
TESTERS = {0.15: "specimen 30 cm, table 18 cm", 0.127: "specimen 25.4 cm, table 12.7 cm"}
SOURCE = "Matsudaira and others 2015, by transcription"


def main(results, out):
    section = Section("Textile tests: bending length, drape, catenary", "textile")
    strip = strips.experiment_runs(results, section, "astm")
    drape = strips.experiment_runs(results, section, "drape", "drape_slow", "drape_small_slow")
    hanging = strips.experiment_runs(results, section, "catenary")
    section.text = ("ASTM D1388: a strip hangs at 41.5° if its overhang is twice the bending length. Drape: "
                    "a round specimen lies on a round table; the drape coefficient is the share of the "
                    "overhanging ring that its shadow covers. Nothing is tuned: bending rigidity and weight "
                    "of four fabrics are the published ones, and the drape coefficient is a result. Real "
                    "fabrics have friction between their yarns (2HB in the same tables), this model has "
                    "none: bars reach to the bending length with half of 2HB at 0.5/cm added. We do not know "
                    "which tester was used, so both are simulated. A sheet without bending between two lines "
                    "hangs as a catenary.")
    for run in strip:
        angle = np.degrees(np.arctan(strips.droop(run)))
        section.checks.append(Check("angle of the chord at Γ = 8.004 (degrees)", run.model,
                                    strips.mesh_name(run), 41.5, angle, 0.3, "ASTM D1388", "absolute"))
    section.checks += drape_checks(drape)
    for run in hanging:
        length, gap, sag = catenary_of(run)
        section.checks.append(Check(f"sag over gap, sheet {length / gap:.3f} times as long as the gap",
                                    "none", strips.mesh_name(run), catenary_sag(length / gap), sag / gap,
                                    0.01, "catenary"))
    if drape:
        section.pictures.append((_drape_picture(drape, out), "Lines: simulated, means over seeds. Points: "
                                 "measured, at the bending length from B; bars end at the bending length "
                                 "with friction. The drape of an isotropic sheet that does not stretch "
                                 "depends on the bending length alone."))
        section.tables.append(_drape_table(drape))
    return section


def bending_length(run):
    """(B/ρ g)^(1/3) in m."""
    return (run.get("/bending/flexural_rigidity") / (run.get("/material/density") * strips.GRAVITY))**(1 / 3)


def length_of(rigidity, weight):
    return (rigidity / (weight * strips.GRAVITY))**(1 / 3)


def coefficient(runs, length, radius):
    """Drape coefficient (%) at a bending length: mean over seeds, interpolated; NaN outside the runs."""
    curve = curve_of(runs, radius)
    return float(np.interp(length, *curve, left=np.nan, right=np.nan)) if len(curve[0]) else np.nan


def curve_of(runs, radius):
    """Bending lengths in m, ascending, and drape coefficients in %."""
    groups = group([run for run in runs if run.get("/mesh/radius") == radius],
                   lambda run: round(bending_length(run), 6))
    lengths = np.array(sorted(groups))
    means = [np.mean([strips.number(run, "drape_coefficient") for run in groups[length]])
             for length in lengths]
    return lengths, 100 * np.array(means)


def drape_checks(runs):
    checks = []
    for radius, tester in TESTERS.items():
        if any(run.get("/mesh/radius") == radius for run in runs) or radius == 0.15:
            for fabric, (rigidity, _, weight, measured) in FABRICS.items():
                checks.append(Check(f"drape coefficient of {fabric} (%)", "discrete_shells", tester, measured,
                                    coefficient(runs, length_of(rigidity, weight) * (1 + 1e-6), radius), 10,
                                    SOURCE, "absolute", note="one B for warp and weft, no friction, no shear "
                                    "of the fabric"))
    return checks


def catenary_of(run):
    """(length of the sheet, gap between its held edges, sag below them) in m."""
    rest, end, pinned = run.rest_positions, run.positions(-1), run.pinned
    return np.ptp(rest[:, 0]), np.ptp(end[pinned, 0]), end[pinned, 2].max() - end[:, 2].min()


def catenary_sag(ratio):
    """Sag over gap of a chain, length over gap `ratio`: 2 a sinh(1/2a) = ratio, sag a (cosh(1/2a) - 1)."""
    low, high = 1e-3, 1e3  # of 1/2a
    for _ in range(200):
        middle = np.sqrt(low * high)
        low, high = (low, middle) if np.sinh(min(middle, 700)) / middle > ratio else (middle, high)
    return float((np.cosh(low) - 1) / (2 * low))


def _drape_picture(runs, out):
    figure, axes = plt.subplots(figsize=(7.4, 4.6), layout="constrained")
    for (radius, tester), colour in zip(TESTERS.items(), ("#0072b2", "#e69f00")):
        lengths, values = curve_of(runs, radius)
        if len(lengths):
            axes.plot(100 * lengths, values, "o-", color=colour, label=f"simulated: {tester}")
    for i, (fabric, (rigidity, rough, weight, measured)) in enumerate(FABRICS.items()):
        low, high = 100 * length_of(rigidity, weight), 100 * length_of(rough, weight)
        axes.plot([low, high], [measured, measured], color=style.INK, linewidth=2.2, solid_capstyle="butt",
                  label="measured, with friction" if i == 0 else None)
        axes.plot(low, measured, "s", color=style.INK, label="measured" if i == 0 else None)
        axes.annotate(fabric, (low, measured), xytext=(0, 7 if fabric == "polyester tropical" else -14),
                      textcoords="offset points", fontsize=8.5)
    inside = [check.holds for check in drape_checks(runs) if check.holds is not None
              and "30 cm" in check.mesh]
    axes.set_xlabel("bending length (B/ρ g)^⅓ (cm)"), axes.set_ylabel("drape coefficient (%)")
    axes.set_ylim(0, 100)
    axes.legend(loc="lower right")
    axes.set_title(f"{sum(inside)} of {len(inside)} fabrics drape within 10 points of the measured "
                   "coefficient, nothing tuned")
    return style.save(figure, out, "fig_stiffness_drape")


def _drape_table(runs):
    rows = []
    for fabric, (rigidity, rough, weight, measured) in FABRICS.items():
        plain, friction = length_of(rigidity, weight) * (1 + 1e-6), length_of(rough, weight)
        rows.append([fabric, style.number(1e6 * rigidity), f"{weight:.4f}", f"{100 * plain:.2f}", measured]
                    + [f"{coefficient(runs, length, radius):.1f}" for radius in TESTERS
                       for length in (plain, friction)])
    return Table("Drape coefficient (%), measured and simulated; with friction: B + HB/(0.5/cm)",
                 ["fabric", "B (µN m)", "weight (kg/m²)", "bending length (cm)", "measured", "30 cm",
                  "30 cm, friction", "25.4 cm", "25.4 cm, friction"], rows)


if __name__ == "__main__":
    figure_main(main)
