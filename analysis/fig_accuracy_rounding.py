"""Rounding errors of single precision in short substeps: a fall, a hanging strip, a soft strip."""
import right_python  # noqa: F401  (first: it may hand over to another Python)
import matplotlib.pyplot as plt
import numpy as np

import accuracy
import style
from report import Section, figure_main

GRAVITY, DENSITY, COMPLIANCE = 9.81, 0.2, 0.01  # m/s², kg/m², m/N, as in the configs
LOOKS = {"single": dict(marker="o", color="#0072b2"),
         "double": dict(marker="s", color="#d55e00", linestyle="--", markerfacecolor="none")}


def fall_error(run):
    """Relative to g t (t + h) / 2, the exact fall in substeps of h."""
    time = float(run.metrics["time"][-1])
    substep = run.get("/solver/dt") / run.get("/solver/substeps")
    expected = GRAVITY * time * (time + substep) / 2
    return abs(run.summary["drop_last"] / expected - 1)


def length_error(run):
    """Relative to 1 m."""
    return abs(run.summary["drop_last"] - 1)


def elongation_error(run):
    """Relative to the elongation ρ g L² / 2Y of a strip of L = 1 m."""
    expected = DENSITY * GRAVITY * COMPLIANCE / 2
    return abs((run.summary["drop_last"] - 1) / expected - 1)


PANELS = (("rounding_fall", "free fall of 0.5 s", fall_error, 1e-4),
          ("rounding_strip", "length of a hanging strip", length_error, 1e-3),
          ("rounding_membrane", "elongation of a soft strip", elongation_error, 1e-2))


def main(results, out):
    section = Section("Short substeps in single precision", "accuracy_rounding")
    panels = [(title, error, goal, accuracy.experiment_runs(results, section, name))
              for name, title, error, goal in PANELS]
    if all(runs for *_, runs in panels):
        section.text = ("In a substep h gravity moves a vertex by g h². With 4096 substeps this is 10⁻¹⁰ m, "
                        "far below the last digit of a coordinate in single precision (10⁻⁷ m). The solver "
                        "therefore stores the displacements of a substep apart from the positions, and the "
                        "low digits of velocities apart from the high ones.")
        section.pictures.append((_errors(panels, out), "Error relative to the closed form. Dotted: the "
                                 f"bound for single precision. Up to {alike_until(panels)} substeps both "
                                 "precisions have the same error within 10 %: it is the solver's and not "
                                 "rounding."))
    return section


def alike_until(panels):
    """The most substeps up to which the errors of both precisions differ by less than a tenth, on all
    panels."""
    ends = []
    for _, error, _, runs in panels:
        found = {(run.get("/solver/precision"), run.get("/solver/substeps")): error(run) for run in runs}
        end = 0
        for substeps in sorted({substeps for _, substeps in found}):
            single, double = (found.get((precision, substeps), np.nan) for precision in ("single", "double"))
            if not abs(single - double) <= 0.1 * double:
                break
            end = substeps
        ends.append(end)
    return min(ends)


def _errors(panels, out):
    figure, axes = plt.subplots(1, len(panels), figsize=(10.4, 3.9), layout="constrained")
    worst = []
    for panel, (title, error, goal, runs) in zip(axes, panels):
        for precision, look in LOOKS.items():
            line = sorted((run.get("/solver/substeps"), max(error(run), 1e-9)) for run in runs
                          if run.get("/solver/precision") == precision)
            panel.plot(*zip(*line), label=precision, **look)
            if precision == "single":
                worst.append(line[-1][1] / goal)
        panel.axhline(goal, color="0.5", linestyle=":")
        panel.set_xscale("log", base=4), panel.set_yscale("log")
        panel.xaxis.set_major_formatter("{x:.0f}")
        panel.set_xlabel("substeps of 1/60 s")
        panel.set_title(title, fontsize=10)
    axes[0].set_ylabel("relative error")
    axes[0].legend()
    kept = int(np.sum(np.array(worst) <= 1))
    figure.suptitle(f"With 4096 substeps single precision stays within {kept} of {len(worst)} bounds", x=0.01,
                    ha="left", fontsize=11.5)
    return style.save(figure, out, "fig_accuracy_rounding")


if __name__ == "__main__":
    figure_main(main)
