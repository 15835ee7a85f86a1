"""The tests of textile laboratories: ASTM D1388, Cusick's drape, and the catenary."""
import numpy as np

from bendlab.results.load import select
from runs import strips
from truths import validation

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
COARSE, USUAL, FINE = 20, 30, 40  # cells along the radius. USUAL: for curves; FINE: for S in the validation
ORDER = 2  # of the error in the mesh size, in theory; the scatter over seeds hides the observed order
# Relative standard uncertainties of B/ρ, beside friction. DIRECTIONS: of B if only the mean of warp and weft
# is known. (We take B to be this mean. The mean over all directions is (warp + weft)/4 + bias/2.) It is the
# root mean square in the 251 distinct rows of dataset.csv (618 rows) of Feng and others 2022, doi
# 10.1145/3550454.3555464; there, the larger of warp and weft is 1.67 times the smaller at the median.
# RIGIDITY and WEIGHT: of the measurements of B and ρ; our assumptions, because we found no published
# repeatability.
DIRECTIONS, RIGIDITY, WEIGHT = 0.27, 0.05, 0.01
# Relative standard uncertainty of D: our assumption. Kenkare and others 2008, doi 10.1080/00405000701489222,
# call drape "highly variable", but we found no number. Our simulations scatter by 2 to 4 % over seeds.
DRAPE = 0.05


def main(results, out, section):
    for run in strips.experiment_runs(results, section, "astm"):
        angle = np.degrees(np.arctan(strips.droop(run)))
        section.checks.append(strips.check(run, "angle of the chord at Γ = 8.004 (degrees)", 41.5, angle, 0.3,
                                           "ASTM D1388", "absolute"))
    drape = strips.experiment_runs(results, section, "drape", "drape_slow", "drape_small_slow",
                                   "drape_cells_slow", "drape_small_cells_slow")
    curves = {radius: curve_of(select(drape, mesh__radius=radius, mesh__cells=USUAL)) for radius in TESTERS}
    rows = []
    for fabric, (rigidity, rough, weight, measured) in FABRICS.items():
        lengths = {"plain": length_of(rigidity, weight), "friction": length_of(rough, weight)}
        rows.append({"fabric": fabric, "B": 1e6 * rigidity, "weight": weight,
                     "length": 100 * lengths["plain"], "measured": measured}
                    | {f"{kind}_{radius}": coefficient(curve, length) for radius, curve in curves.items()
                       for kind, length in lengths.items()})
    cases = []
    for radius, (_, tester) in TESTERS.items():
        for fabric, case in validations(select(drape, mesh__radius=radius)).items():
            section.add_check(
                f"drape coefficient of {fabric} (%)", "discrete_shells", tester, case.data,
                case.simulation if case.holds is not None else np.nan, round(case.u_val, 2),
                "Matsudaira and others 2015, by transcription", "absolute",
                f"validation by ASME V&V 20: {case.verdict('points')}")
            cases.append({"fabric": fabric, "tester": tester, "error": case.error, "u_val": case.u_val,
                          "ratio": abs(case.error) / case.u_val, "verdict": case.verdict("points")}
                         | vars(case))
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
    section.add_table("drape", f"Drape coefficient, measured and simulated on {USUAL} cells; columns with "
                               "friction have the rigidity B + HB/(0.5/cm)", [
        "fabric", ("B", "B", "", "µN m"), ("weight", "weight", ".4f", "kg/m²"),
        ("length", "bending length", ".2f", "cm"), ("measured", "measured", ".1f", "%"),
        *((f"{kind}_{radius}", size + suffix, ".1f", "%") for radius, (size, _) in TESTERS.items()
          for kind, suffix in (("plain", ""), ("friction", ", friction")))], rows)
    section.add_table("validation", f"Validation: simulation S on {FINE} cells, measurement D", [
        "fabric", "tester", ("data", "D", ".1f", "%"), ("simulation", "S", ".1f", "%"),
        ("error", "E = S − D", "+.1f", "points"), ("u_num", "u_num", ".1f", "points"),
        ("u_input", "u_input", ".1f", "points"), ("u_data", "u_D", ".1f", "points"),
        ("u_val", "u_val", ".1f", "points"), ("ratio", "|E|/u_val", ".2f"), "verdict"], cases)
    inside = [case["ratio"] <= 1 for case in cases if case["ratio"] == case["ratio"]]
    title = (f"{sum(inside)} of {len(inside)} drape coefficients agree with the measurement within the "
             "uncertainty u_val, without tuning" if inside else "Drape coefficient over bending length")
    section.add_chart(
        "curves", title, "length", ["drape"], ["tester"], id="drape", scale="linear",
        y_scale="linear", look="",
        note="Curves are simulated, with means over seeds. Horizontal lines are measured fabrics: a line "
             "goes from the bending length without friction to the bending length with friction. The drape "
             "of an isotropic sheet that does not stretch depends on the bending length alone.")


def length_of(rigidity, weight):
    """The bending length (B/ρ g)^(1/3) in m."""
    return (rigidity / (weight * strips.GRAVITY))**(1 / 3)


def seeds_of(runs):
    """Bending length in m, ascending → seed → drape coefficient in %."""
    values = {}
    for run in runs:
        length = length_of(run.get("/bending/flexural_rigidity"), run.get("/material/density"))
        drape = 100 * strips.number(run, "drape_coefficient")
        values.setdefault(round(length, 6), {})[run.get("/initial/seed")] = drape
    return dict(sorted(values.items()))


def curve_of(runs):
    """Bending length in m, ascending → drape coefficient in %, the mean over seeds."""
    return {length: np.mean(list(seeds.values())) for length, seeds in seeds_of(runs).items()}


def coefficient(curve, length):
    """Drape coefficient (%) at a bending length, interpolated; NaN outside the runs. Lengths of curves are
    rounded to 1 µm, so that a length outside by 1 µm counts as inside."""
    if not curve or not min(curve) - 1e-6 <= length <= max(curve) + 1e-6:
        return np.nan
    return float(np.interp(length, list(curve), list(curve.values())))


def validations(runs):
    """Fabric → truths.validation.Validation of the drape coefficient in %, from the runs of one tester."""
    usual, fine = (seeds_of(select(runs, mesh__cells=cells)) for cells in (USUAL, FINE))
    curves = {cells: curve_of(select(runs, mesh__cells=cells)) for cells in (COARSE, USUAL, FINE)}
    at = lambda cells: np.array([coefficient(curves[cells], length_of(rigidity, weight))
                                 for rigidity, _, weight, _ in FABRICS.values()])
    scatter = validation.scatter([list(usual[length].values()) for length in fine if length in usual])
    mesh = validation.mesh_uncertainty(at(FINE) - at(COARSE), FINE / COARSE, ORDER)
    u_num = np.hypot(scatter / np.sqrt(min(map(len, fine.values()), default=1)), mesh)
    return {fabric: validation.Validation(
                data, float(simulation), float(u_num),
                float(np.hypot(u_input(curves[USUAL], rigidity, weight),
                               u_friction(curves[USUAL], rigidity, rough, weight))), DRAPE * data)
            for (fabric, (rigidity, rough, weight, data)), simulation in zip(FABRICS.items(), at(FINE))}


def u_input(curve, rigidity, weight, directions=DIRECTIONS):
    """Standard uncertainty of the drape coefficient in points, from the uncertain inputs B and ρ.
    `directions`: as DIRECTIONS; 0 if the simulation has a rigidity by direction."""
    if not curve:
        return np.nan
    length = length_of(rigidity, weight)
    share = np.sqrt(directions**2 + RIGIDITY**2 + WEIGHT**2) / 3  # of the length, which is ∝ (B/ρ)^(1/3)
    low, high = np.clip([length * (1 - share), length * (1 + share)], min(curve), max(curve))
    slope = (coefficient(curve, high) - coefficient(curve, low)) / np.log(high / low)
    return float(slope * share)


def u_friction(curve, rigidity, rough, weight):
    """Standard uncertainty of the drape coefficient in points, from internal friction that a simulation with
    B = `rigidity` leaves out: B lies between `rigidity` and `rough`, all values equally likely."""
    ends = (coefficient(curve, length_of(end, weight)) for end in (rigidity, rough))
    return float(abs(np.subtract(*ends)) / np.sqrt(3))


def catenary_sag(ratio):
    """Sag over gap of a chain, a (cosh(1/2a) - 1); a is from 2 a sinh(1/2a) = ratio (length over gap)."""
    low, high = 1e-3, 1e3  # of 1/2a
    for _ in range(200):
        middle = np.sqrt(low * high)
        low, high = (low, middle) if np.sinh(min(middle, 700)) / middle > ratio else (middle, high)
    return float((np.cosh(low) - 1) / (2 * low))
