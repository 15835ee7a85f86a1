"""The tests of textile laboratories: ASTM D1388, Cusick's drape, and the catenary."""
import numpy as np

from runs import strips
from bendlab.results.load import group
from tables.chart import Chart
from tables.section import Check
from tables.table import Table

# (flexural rigidity in N m, this rigidity plus half of the hysteresis 2HB at a curvature of 0.5/cm, weight in
# kg/m², drape coefficient in %). Matsudaira, Masuda, Wada, Yokura 2015, J. Textile Engineering 61(6), doi
# 10.4188/jte.61.69, tables 1 and 2, copied from the transcription of another project. We have not seen the
# original and do not know the size of the specimen.
FABRICS = {"polyester faille": (1.863e-6, 2.550e-6, 0.1043, 28.3),
           "wool tropical": (6.570e-6, 9.807e-6, 0.1629, 49.8),
           "polyester tropical": (7.551e-6, 1.040e-5, 0.1165, 50.7),
           "cotton broad": (1.157e-5, 2.373e-5, 0.1238, 82.9)}
TESTERS = {0.15: "specimen 30 cm, table 18 cm", 0.127: "specimen 25.4 cm, table 12.7 cm"}
SOURCE = "Matsudaira and others 2015, by transcription"


def main(results, out, section):
    strip = strips.experiment_runs(results, section, "astm")
    drape = strips.experiment_runs(results, section, "drape", "drape_slow", "drape_small_slow")
    hanging = strips.experiment_runs(results, section, "catenary")
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
    if not drape:
        return
    inside = [check.holds for check in drape_checks(drape) if check.holds is not None
              and "30 cm" in check.mesh]
    section.tables += [_curves(drape), _drape_table(drape)]
    section.charts.append(Chart(
        "drape", f"{sum(inside)} of {len(inside)} drape coefficients are within 10 points of the "
                 "measurement, without tuning", "curves", "length", ["drape"], ["tester"], scale="linear",
        y_scale="linear",
        look="",
        note="Curves are simulated, with means over seeds. Horizontal lines are measured fabrics: a line "
             "goes from the bending length without friction to the bending length with friction. The drape "
             "of an isotropic sheet that does not stretch depends on the bending length alone."))


def bending_length(run):
    """(B/ρ g)^(1/3) in m."""
    return (run.get("/bending/flexural_rigidity") / (run.get("/material/density") * strips.GRAVITY))**(1 / 3)


def length_of(rigidity, weight):
    return (rigidity / (weight * strips.GRAVITY))**(1 / 3)


def coefficient(runs, length, radius):
    """Drape coefficient (%) at a bending length, from interpolated means over seeds; NaN outside the runs."""
    curve = curve_of(runs, radius)
    return float(np.interp(length, *curve, left=np.nan, right=np.nan)) if len(curve[0]) else np.nan


def curve_of(runs, radius):
    """(bending lengths in m, ascending; drape coefficients in %, means over seeds)."""
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
                                    SOURCE, "absolute", note="the simulation has one B for warp and weft, no "
                                    "friction, and no shear of the fabric"))
    return checks


def catenary_of(run):
    """(length of the sheet, gap between its held edges, sag below these edges) in m."""
    rest, end, pinned = run.rest_positions, run.positions(-1), run.pinned
    return np.ptp(rest[:, 0]), np.ptp(end[pinned, 0]), end[pinned, 2].max() - end[:, 2].min()


def catenary_sag(ratio):
    """Sag over gap of a chain, a (cosh(1/2a) - 1); a is from 2 a sinh(1/2a) = ratio (length over gap)."""
    low, high = 1e-3, 1e3  # of 1/2a
    for _ in range(200):
        middle = np.sqrt(low * high)
        low, high = (low, middle) if np.sinh(min(middle, 700)) / middle > ratio else (middle, high)
    return float((np.cosh(low) - 1) / (2 * low))


def _curves(runs):
    rows = [{"tester": tester, "length": 100 * length, "drape": value} for radius, tester in TESTERS.items()
            for length, value in zip(*curve_of(runs, radius))]
    rows += [{"tester": f"measured: {fabric}", "length": 100 * length_of(end, weight), "drape": measured}
             for fabric, (rigidity, rough, weight, measured) in FABRICS.items() for end in (rigidity, rough)]
    return Table.of("curves", "Drape coefficient over bending length", [
        "tester", ("length", "bending length (B/ρ g)^⅓", ".2f", "cm"),
        ("drape", "drape coefficient", ".1f", "%")],
                    rows)


def _drape_table(runs):
    rows = []
    for fabric, (rigidity, rough, weight, measured) in FABRICS.items():
        plain, friction = length_of(rigidity, weight) * (1 + 1e-6), length_of(rough, weight)
        rows.append({"fabric": fabric, "B": 1e6 * rigidity, "weight": weight, "length": 100 * plain,
                     "measured": measured} | {f"{kind}_{radius}": coefficient(runs, length, radius)
                                              for radius in TESTERS
                                              for kind, length in (("plain", plain), ("friction", friction))})
    testers = {0.15: "30 cm", 0.127: "25.4 cm"}
    return Table.of("drape", "Drape coefficient, measured and simulated; columns with friction have the "
                             "rigidity B + HB/(0.5/cm)", [
        "fabric", ("B", "B", "", "µN m"), ("weight", "weight", ".4f", "kg/m²"),
        ("length", "bending length", ".2f", "cm"), ("measured", "measured", ".1f", "%"),
        *((f"{kind}_{radius}", testers[radius] + (", friction" if kind == "friction" else ""), ".1f", "%")
          for radius in TESTERS for kind in ("plain", "friction"))], rows)
