"""What single precision loses in short substeps: a fall, the length of a hanging strip, the elongation of a soft one."""
import matplotlib.pyplot as plt
import numpy as np

import accuracy
import style
from report import Section, figure_main

GRAVITY, DENSITY, COMPLIANCE = 9.81, 0.2, 0.01  # m/s², kg/m², m/N, as the configs have them
LOOKS = {"single": dict(marker="o", color="#0072b2"), "double": dict(marker="s", color="#d55e00", linestyle="--", markerfacecolor="none")}


def fall_error(run):
    """Against g t (t + h) / 2, the sum of h times the speeds."""
    time = float(run.metrics["time"][-1])
    substep = run.get("/solver/dt") / run.get("/solver/substeps")
    expected = GRAVITY * time * (time + substep) / 2
    return abs(run.summary["drop_last"] / expected - 1)


def length_error(run):
    """Against 1 m."""
    return abs(run.summary["drop_last"] - 1)


def elongation_error(run):
    """Against ρ g L² / 2Y of a strip of 1 m."""
    expected = DENSITY * GRAVITY * COMPLIANCE / 2
    return abs((run.summary["drop_last"] - 1) / expected - 1)


PANELS = (("rounding_fall", "free fall of 0.5 s", fall_error, 1e-4),
          ("rounding_strip", "length of a hanging strip", length_error, 1e-3),
          ("rounding_membrane", "elongation of a soft strip", elongation_error, 1e-2))


def main(results, out):
    section = Section("Short substeps in single precision", "accuracy_rounding")
    panels = [(title, error, goal, accuracy.experiment_runs(results, section, name)) for name, title, error, goal in PANELS]
    if all(runs for *_, runs in panels):
        section.text = ("In a substep h gravity moves a vertex by g h², with 4096 substeps 10⁻¹⁰ m, far below the last digit of a coordinate in "
                        "single precision (10⁻⁷ m). What a substep changes is kept apart from where the cloth is, and so are the digits of "
                        "velocities that a number has no room for.")
        section.pictures.append((_errors(panels, out), "Error against the closed form. Dotted: the bound that single precision has to keep. Below about 64 "
                                 "substeps both precisions are as far off: that is the solver."))
    return section


def _errors(panels, out):
    figure, axes = plt.subplots(1, len(panels), figsize=(10.4, 3.9), layout="constrained")
    worst = []
    for panel, (title, error, goal, runs) in zip(axes, panels):
        for precision, look in LOOKS.items():
            line = sorted((run.get("/solver/substeps"), max(error(run), 1e-9)) for run in runs if run.get("/solver/precision") == precision)
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
    figure.suptitle(f"With 4096 substeps single precision keeps {kept} of {len(worst)} bounds", x=0.01, ha="left", fontsize=11.5)
    return style.save(figure, out, "fig_accuracy_rounding")


if __name__ == "__main__":
    figure_main(main)
