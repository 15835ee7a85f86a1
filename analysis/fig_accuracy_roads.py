"""Different methods that should give the same reference, and the cost of each remedy for a single pin."""
import right_python  # noqa: F401  (first: it may hand over to another Python)
import matplotlib.pyplot as plt
import numpy as np

import accuracy
import style
from bendlab.results.load import by_model, group
from report import Check, Section, Table, figure_main

AGREE = 0.005  # largest distance between two methods, in sizes
# m; free end of the heavy elastica of configs/accuracy/cantilever.json
REACH, DROP, LENGTH = 0.03520, 0.06745, 0.08083
EFFECTS = {"tethers": "tethers", "strain_limiting": "strain limits"}


def main(results, out):
    section = Section("Methods that give the reference, and the single pin", "accuracy_roads")
    section.text = ("A reference is trustworthy if different methods give it: Newton's method, the same "
                    "scene run to rest with many substeps, and for the cantilever the heavy elastica. A "
                    "drape and a sheet on one pin have many equilibria: there Newton's method starts at the "
                    "run's end.")
    for name in ("cantilever", "curtain", "drape", "one_pin"):
        runs = [run for run in accuracy.experiment_runs(results, section, name) if run.complete]
        section.checks += road_checks(name, runs)
    section.checks += elastica_checks([run for run in accuracy.experiment_runs(results, section, "cantilever")
                                       if run.complete])
    section.commands = list(dict.fromkeys(section.commands))
    pin = [run for run in accuracy.experiment_runs(results, section, "pin") if run.complete]
    if pin:
        section.pictures.append((_pin(pin, out), "Hinges with the stated cloth on a sheet of 30 cm that "
                                 "hangs from one pin: distance to the equilibrium of that cloth nearest to "
                                 "the run's end, after the best rotation about the vertical."))
        section.tables.append(_pin_table(pin))
    return section


def road_checks(name, runs):
    """Compares XPBD with the most substeps with Newton's method, for every model, from one starting point."""
    moving = [run for run in runs if run.get("/solver/method") == "pbd"
              and run.get("/accuracy/start_from_end") in (name in ("drape", "one_pin"), None)]
    finest = [max(some, key=lambda run: run.get("/solver/substeps"))
              for some in by_model(moving).values()]
    return [Check(f"{name.replace('_', ' ')}: XPBD with {run.get('/solver/substeps')} substeps from Newton's "
                  "equilibrium", run.model, f"{run.get('/mesh/cells')} cells", AGREE,
                  accuracy.error(run, against="solver"), 0, "the same energies", "most") for run in finest]


def elastica_checks(runs):
    """Compares H/W of hinges in static equilibrium with the heavy elastica."""
    return [Check("cantilever: H/W against the heavy elastica", run.model, f"{run.get('/mesh/cells')} cells",
                  DROP / REACH, run.summary.get("stiffness_height_over_width", np.nan),
                  AGREE * LENGTH * (1 / DROP + 1 / REACH), "strip of Bickley 1934; 0.5 % of its length in "
                  "height and width") for run in runs if run.get("/solver/method") == "equilibrium"
            and run.model in ("dihedral", "isometric")]


def effect_of(run):
    """The effect that is a remedy for the pin, "" if there is none."""
    return next((effect["type"] for effect in run.get("/effects") if effect["type"] in EFFECTS), "")


def remedy(run):
    """The remedies of a run as text."""
    names = [EFFECTS[effect["type"]] for effect in run.get("/effects") if effect["type"] in EFFECTS]
    substeps, iterations = run.get("/solver/substeps"), run.get("/solver/iterations")
    if (substeps, iterations) != (1, 10):
        names.append(f"{substeps} × {iterations}" if substeps > 1 else f"{iterations} iterations")
    if run.get("/solver/order") != "colour":
        names.append("order from the pin")
    if run.get("/solver/flight_limit"):
        names.append("cut steps")
    return ", ".join(names) or "plain, 1 × 10"


def _pin(runs, out):
    runs = sorted(runs, key=accuracy.error, reverse=True)
    figure, axes = plt.subplots(1, 3, figsize=(10.4, 0.25 * len(runs) + 1), layout="constrained", sharey=True)
    numbers = (("distance from equilibrium (% of size)", lambda run: 100 * accuracy.error(run)),
               ("CPU time per frame of 1/60 s (ms)", accuracy.cost),
               ("strain (RMS, %)", lambda run: 100 * accuracy.error(run, "strain")))
    for panel, (label, number) in zip(axes, numbers):
        for (kind, some), colour in zip(sorted(group(runs, effect_of).items()), style.SEQUENCE):
            panel.plot([number(run) for run in some], [runs.index(run) for run in some], "o", color=colour,
                       label=EFFECTS.get(kind, "no effect"))
        panel.set_xscale("log")
        panel.set_xlabel(label)
    axes[0].set_yticks(range(len(runs)), labels=[remedy(run) for run in runs])
    axes[0].invert_yaxis()
    style.legend_below(figure, axes[0], 3)
    plain = next(run for run in runs if remedy(run).startswith("plain"))
    best = min(runs, key=lambda run: accuracy.error(run) * accuracy.cost(run))
    figure.suptitle(f"At one pin: compared with plain iterations, '{remedy(best)}' divides the error by "
                    f"{style.number(accuracy.error(plain) / accuracy.error(best), 2)} and takes "
                    f"{style.number(accuracy.cost(best) / accuracy.cost(plain), 2)} × the time", x=0.01,
                    ha="left", fontsize=11.5)
    return style.save(figure, out, "fig_accuracy_pin")


def _pin_table(runs):
    return Table("Remedies at the pin", ["remedy", "ms per frame", "distance (%)",
                                         "largest stretch at the pin", "strain (RMS, %)"],
                 [[remedy(run), style.number(accuracy.cost(run)), style.number(100 * accuracy.error(run)),
                   style.number(run.summary.get("pin_max_stretch", np.nan)),
                   style.number(100 * accuracy.error(run, "strain"))]
                  for run in sorted(runs, key=accuracy.cost)])


if __name__ == "__main__":
    figure_main(main)
