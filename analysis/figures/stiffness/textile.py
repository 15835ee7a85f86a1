"""The tests of textile laboratories: ASTM D1388, Cusick's drape, and the catenary."""
import numpy as np

from bendlab.results.load import group, select
from runs import strips

# (flexural rigidity in N m, this rigidity plus half of the hysteresis 2HB at a curvature of 0.5/cm, weight in
# kg/m², drape coefficient in %). Matsudaira, Masuda, Wada, Yokura 2015, J. Textile Engineering 61(6), doi
# 10.4188/jte.61.69, tables 1 and 2, copied from the transcription of another project. We have not seen the
# original and do not know the size of the specimen.
FABRICS = {"polyester faille": (1.863e-6, 2.550e-6, 0.1043, 28.3),
           "wool tropical": (6.570e-6, 9.807e-6, 0.1629, 49.8),
           "polyester tropical": (7.551e-6, 1.040e-5, 0.1165, 50.7),
           "cotton broad": (1.157e-5, 2.373e-5, 0.1238, 82.9)}
# Radius of the specimen in m → (diameter, specimen and table)
TESTERS = {0.15: ("30 cm", "specimen 30 cm, table 18 cm"),
           0.127: ("25.4 cm", "specimen 25.4 cm, table 12.7 cm")}


def main(results, out, section):
    for run in strips.experiment_runs(results, section, "astm"):
        angle = np.degrees(np.arctan(strips.droop(run)))
        section.checks.append(strips.check(run, "angle of the chord at Γ = 8.004 (degrees)", 41.5, angle, 0.3,
                                           "ASTM D1388", "absolute"))
    drape = strips.experiment_runs(results, section, "drape", "drape_slow", "drape_small_slow")
    curves = {radius: curve_of(select(drape, mesh__radius=radius)) for radius in TESTERS}
    rows = []
    for fabric, (rigidity, rough, weight, measured) in FABRICS.items():
        lengths = {"plain": length_of(rigidity, weight) * (1 + 1e-6), "friction": length_of(rough, weight)}
        rows.append({"fabric": fabric, "B": 1e6 * rigidity, "weight": weight,
                     "length": 100 * lengths["plain"], "measured": measured}
                    | {f"{kind}_{radius}": coefficient(curve, length) for radius, curve in curves.items()
                       for kind, length in lengths.items()})
    for radius, (_, tester) in TESTERS.items():
        for row in rows if curves[radius] or radius == 0.15 else []:
            section.add_check(
                f"drape coefficient of {row['fabric']} (%)", "discrete_shells", tester, row["measured"],
                row[f"plain_{radius}"], 10, "Matsudaira and others 2015, by transcription", "absolute",
                "the simulation has one B for warp and weft, no friction, and no shear of the fabric")
    for run in strips.experiment_runs(results, section, "catenary"):
        rest, end, pinned = run.rest_positions, run.positions(-1), run.pinned
        length, gap = np.ptp(rest[:, 0]), np.ptp(end[pinned, 0])  # of the sheet, between its held edges
        sag = end[pinned, 2].max() - end[:, 2].min()
        section.checks.append(strips.check(
            run, f"sag over gap, sheet {length / gap:.3f} times as long as the gap",
            catenary_sag(length / gap), sag / gap, 0.01, "catenary"))
    if not drape:
        return
    points = [{"tester": tester, "length": 100 * length, "drape": value}
              for radius, (_, tester) in TESTERS.items() for length, value in curves[radius].items()]
    points += [{"tester": f"measured: {fabric}", "length": 100 * length_of(end, weight), "drape": measured}
               for fabric, (*ends, weight, measured) in FABRICS.items() for end in ends]
    section.add_table("curves", "Drape coefficient over bending length", [
        "tester", ("length", "bending length (B/ρ g)^⅓", ".2f", "cm"),
        ("drape", "drape coefficient", ".1f", "%")], points)
    section.add_table("drape", "Drape coefficient, measured and simulated; columns with friction have the "
                               "rigidity B + HB/(0.5/cm)", [
        "fabric", ("B", "B", "", "µN m"), ("weight", "weight", ".4f", "kg/m²"),
        ("length", "bending length", ".2f", "cm"), ("measured", "measured", ".1f", "%"),
        *((f"{kind}_{radius}", size + suffix, ".1f", "%") for radius, (size, _) in TESTERS.items()
          for kind, suffix in (("plain", ""), ("friction", ", friction")))], rows)
    inside = [check.holds for check in section.checks if check.holds is not None and "30 cm" in check.mesh]
    section.add_chart(
        "curves", f"{sum(inside)} of {len(inside)} drape coefficients are within 10 points of the "
        "measurement, without tuning", "length", ["drape"], ["tester"], id="drape", scale="linear",
        y_scale="linear", look="",
        note="Curves are simulated, with means over seeds. Horizontal lines are measured fabrics: a line "
             "goes from the bending length without friction to the bending length with friction. The drape "
             "of an isotropic sheet that does not stretch depends on the bending length alone.")


def length_of(rigidity, weight):
    """The bending length (B/ρ g)^(1/3) in m."""
    return (rigidity / (weight * strips.GRAVITY))**(1 / 3)


def curve_of(runs):
    """Bending length in m, ascending → drape coefficient in %, the mean over seeds."""
    groups = group(runs, lambda run: round(length_of(run.get("/bending/flexural_rigidity"),
                                                     run.get("/material/density")), 6))
    return {length: 100 * np.mean([strips.number(run, "drape_coefficient") for run in own_runs])
            for length, own_runs in sorted(groups.items())}


def coefficient(curve, length):
    """Drape coefficient (%) at a bending length, interpolated; NaN outside the runs."""
    if not curve:
        return np.nan
    return float(np.interp(length, list(curve), list(curve.values()), left=np.nan, right=np.nan))


def catenary_sag(ratio):
    """Sag over gap of a chain, a (cosh(1/2a) - 1); a is from 2 a sinh(1/2a) = ratio (length over gap)."""
    low, high = 1e-3, 1e3  # of 1/2a
    for _ in range(200):
        middle = np.sqrt(low * high)
        low, high = (low, middle) if np.sinh(min(middle, 700)) / middle > ratio else (middle, high)
    return float((np.cosh(low) - 1) / (2 * low))
