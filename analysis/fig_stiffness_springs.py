"""Ring springs: moment ∝ κ³ and its coefficient, the membrane's effect on both, and droop over gravity."""
import right_python  # noqa: F401  (first: it may hand over to another Python)
import matplotlib.pyplot as plt
import numpy as np

from bendlab.results import registry
import strips
import style
from bendlab.results.load import group
from report import Check, Section, Table, figure_main

RATIO = 2e5  # R⁴ / (α C); from here on the membrane reduces C by at most about 1 %
RING_COLOURS = {2: "#009e73", 3: "#0072b2", 4: "#b0579b"}
SOURCE = "shortening of every spring on a polyhedral cylinder (analysis/strips.py)"


def ring(run):
    return run.get("/bending/k_ring/k")


def place(run):
    return strips.cells(run), ring(run)


def expected_quartic(run):
    """C of the strip's own springs, N m³."""
    return strips.expected_quartic(run.rest_positions, run.triangles, run.pinned, ring(run),
                                   1 / run.get("/bending/compliance"))


def membrane_ratio(run, quartic):
    """R⁴ / (α C): stiffness of the membrane (compliance α, m/N) relative to springs of length R."""
    edge = run.get("/mesh/width") / run.get("/mesh/cells")
    return (ring(run) * edge)**4 / (run.get("/material/strain/compliance") * quartic)


def main(results, out):
    section = Section("Ring springs: does the moment grow as κ³?", "springs")
    runs = strips.experiment_runs(results, section, "springs", "springs_slow")
    sweep = strips.experiment_runs(results, section, "gravity")
    ratio = f"{RATIO:,.0f}".replace(",", " ")
    section.text = ("Springs to ring t alone on an equilateral lattice. On a sheet of curvature κ a spring "
                    "of t edges of length a is shorter by t (t² − 1) a³ κ²/24. So the moment is C κ³ with C "
                    "= c_t k a⁴. On an infinite lattice c_2 = 0.1522, c_3 = 3.393, c_4 = 27.51; here C is "
                    "summed over the strip's own springs, which end at its free sides. This holds while the "
                    "edges keep their lengths. A soft membrane yields to the springs instead of bending, "
                    f"and C is reduced. C and p are taken where R⁴/(α C) is nearest to {ratio} for all three "
                    "rings: α is the membrane's compliance, R the springs' length.")
    quartic_of = {key: expected_quartic(some[0]) for key,
                  some in group(runs, place).items()}  # depends on the mesh, not on the membrane
    points = [(run, quartic_of[place(run)], membrane_ratio(run, quartic_of[place(run)])) for run in runs]
    for _, some in group(points, lambda point: place(point[0])).items():
        section.checks += _checks(*min(some, key=lambda point: abs(np.log(point[2] / RATIO))))
    section.checks += slopes(sweep)
    if points:
        section.pictures.append((_picture(points, out), "C from the moment-curvature fit over C of the "
                                 "strip's springs, and the exponent, over the membrane's stiffness. Open: 48 "
                                 "cells. Bands: tolerances."))
        section.tables.append(_table(points))
    if sweep:
        section.pictures.append((_gravity_picture(sweep, results, out),
                                 "H/W over gravity while H/W is small. Hinges: discrete_shells."))
    return section


def _checks(run, quartic, ratio):
    name, mesh = f"k_ring, ring {ring(run)}", strips.mesh_name(run)
    return [Check("C from m(κ) (N m³)", name, mesh, quartic, strips.number(run, "stiffness_fit_C"), 0.03,
                  SOURCE, note=f"R⁴/(α C) = {ratio:.2g}"),
            Check("exponent p of m ∝ κ^p", name, mesh, 3, strips.number(run, "stiffness_fit_exponent"), 0.15,
                  "shortening ∝ κ²", "absolute")]


def slopes(runs):
    """Checks of d ln(H/W) / d ln g at H/W below 0.3."""
    checks = []
    for label, some in group(runs, line_name).items():
        small = [run for run in some if strips.droop(run) < 0.3]
        slope = np.polyfit(np.log([strips.gravity(run) for run in small]),
                           np.log([strips.droop(run) for run in small]), 1)[0] if len(small) > 1 else np.nan
        at_rest = registry.has_springs_at_rest(some[0].model)
        checks.append(Check("slope of ln H/W over ln g at H/W < 0.3", label, strips.mesh_name(some[0]),
                            1 / 3 if at_rest else 1, float(slope), 0.02, "m = C κ³" if at_rest else "m = B κ",
                            "absolute"))
    return checks


def line_name(run):
    return f"k_ring, ring {ring(run)}" if run.model == "k_ring" else run.model


def _picture(points, out):
    figure, (left, right) = plt.subplots(1, 2, figsize=(10.4, 4.1), layout="constrained")
    for (cells, t), some in sorted(group(points, lambda point: place(point[0])).items()):
        some.sort(key=lambda point: point[2])
        x = [point[2] for point in some]
        look = dict(color=RING_COLOURS[t], marker="o", markerfacecolor="none" if cells > 24
                    else RING_COLOURS[t], linewidth=1, linestyle="--" if cells > 24 else "-",
                    label=f"t = {t}, {cells} cells")
        left.plot(x, [strips.number(run, "stiffness_fit_C") / quartic for run, quartic, _ in some], **look)
        right.plot(x, [strips.number(run, "stiffness_fit_exponent") for run, *_ in some], **look)
    left.axhspan(0.97, 1.03, color="#e8f1ea"), right.axhspan(2.85, 3.15, color="#e8f1ea")
    for panel in (left, right):
        panel.axvline(RATIO, color=style.GREY, linewidth=0.8, linestyle=":")
        panel.set_xscale("log")
        panel.set_xlabel("R⁴ / (α C): stiffness of the membrane relative to the springs")
    left.set_ylim(0, 1.4), right.set_ylim(0, 3.4)
    left.set_ylabel("C measured / C of the springs"), right.set_ylabel("exponent p of m ∝ κ^p")
    right.legend()
    shares = [(ratio, 100 * strips.number(run, "stiffness_fit_C") / quartic)
              for run, quartic, ratio in points]
    plateau = [share for ratio, share in shares if RATIO / 3 < ratio < RATIO * 3]
    soft = [share for ratio, share in shares if ratio < RATIO / 30]
    title = "C of springs"
    if plateau:
        title = f"With a stiff membrane C is {min(plateau):.0f} to {max(plateau):.0f} % of the springs' C"
    title += f", with one at least 30 times softer {min(soft):.0f} to {max(soft):.0f} %" if soft else ""
    figure.suptitle(title, x=0.01, ha="left", fontsize=11.5)
    return style.save(figure, out, "fig_stiffness_springs")


def _gravity_picture(runs, results, out):
    figure, axes = plt.subplots(figsize=(6.8, 4), layout="constrained")
    hinges = [run for run in strips.experiment_runs(results, Section("", ""), "hinges")
              if run.model == "discrete_shells" and strips.cells(run) == 24]
    lines = group(runs, line_name) | ({"hinges": hinges} if hinges else {})
    found = {}
    for name, some in lines.items():
        some = sorted((run for run in some if strips.droop(run) < 1), key=strips.gravity)
        g, droop = np.array([strips.gravity(run)
                             for run in some]), np.array([strips.droop(run) for run in some])
        model = some[0].model
        look = style.look(model) | ({"color": RING_COLOURS[ring(some[0])]} if model == "k_ring" else {})
        small = droop < 0.3
        slope = np.polyfit(np.log(g[small]), np.log(droop[small]), 1)[0] if small.sum() > 1 else np.nan
        axes.plot(g, droop, label=f"{name}: slope {slope:.3f}", **look)
        found.setdefault("springs at rest" if registry.has_springs_at_rest(model) else style.family(model),
                         []).append(slope)
    axes.set_xscale("log"), axes.set_yscale("log")
    axes.set_xlabel("gravity (m/s²)"), axes.set_ylabel("H/W of the free end")
    powers = {kind: " to ".join(sorted({f"{power:.2f}" for power in (min(some), max(some))}))
              for kind, some in found.items()}
    axes.set_title("Droop grows as g to the power:\n"
                   + ", ".join(f"{kind} {power}" for kind, power in powers.items()))
    style.label_ends(axes)
    return style.save(figure, out, "fig_stiffness_gravity")


def _table(points):
    rows = [[ring(run), strips.cells(run), style.number(run.get("/material/strain/compliance")),
             style.number(ratio), style.number(quartic),
             f"{strips.number(run, 'stiffness_fit_C') / quartic:.3f}",
             f"{strips.number(run, 'stiffness_quartic') / quartic:.3f}",
             f"{strips.number(run, 'stiffness_fit_exponent'):.3f}"]
            for run, quartic, ratio in sorted(points,
                                              key=lambda point: (strips.cells(point[0]), ring(point[0]),
                                                                 point[2]))]
    return Table("Ring springs", ["ring t", "cells", "membrane α (m/N)", "R⁴/(α C)",
                                  "C of the springs (N m³)", "C from m(κ) over C of the springs",
                                  "C from H/W over C of the springs", "p"], rows)


if __name__ == "__main__":
    figure_main(main)
