"""Error against time, over solver methods: the pose at rest, and motion."""
import matplotlib.pyplot as plt
import numpy as np

import accuracy
import style
from load import group
from report import Section, Table, figure_main

LOOKS = {"pbd": ("#d55e00", "o"), "quasi_newton": ("#0072b2", "s"),
         "quasi_newton, membrane auto": ("#56b4e9", "D"), "newton": ("#009e73", "^"),
         "newton, euler": ("#8a4b08", "v"), "vbd": ("#cc79a7", "P")}
PAPER = (1, 10)  # substeps, iterations


def main(results, out):
    section = Section("Solver methods", "accuracy_methods")
    rest, motion = ([run for run in accuracy.experiment_runs(results, section, name) if run.complete]
                    for name in ("methods_slow", "methods_motion_slow"))
    section.text = ("The same cloth, energies and forces with each solver method. At rest every method but "
                    "XPBD ends where the forces balance, however few its iterations; in motion few "
                    "iterations lag behind. Membrane auto softens the membrane by as much as 0.3 % of the "
                    "size allows.")
    if rest:
        section.pictures.append((_fronts(rest, out, "fig_accuracy_methods",
                                         "distance from the equilibrium (% of size)", _message(rest)),
                                 "The sheet of 40 cm hangs on two patches for 3 s. A star is the paper's "
                                 "setting, 1 × 10."))
        section.tables.append(_table(rest, "At rest"))
    if motion:
        section.pictures.append((_fronts(motion, out, "fig_accuracy_methods_motion",
                                         "distance from the motion (% of size)",
                                         "The first half second: few iterations lag behind"),
                                 "The reference is Newton's method in 32 substeps of BDF2."))
        section.tables.append(_table(motion, "In motion"))
    return section


def kind_of(run):
    """The method of a run, with what changes its results."""
    method = run.get("/solver/method")
    if run.get("/solver/membrane") == "auto":
        return f"{method}, membrane auto"
    return f"{method}, euler" if run.get("/solver/integrator") == "euler" and method == "newton" else method


def _error(run):
    return accuracy.error(run, against="solver")


def _fronts(runs, out, name, ylabel, title):
    sizes = group(runs, lambda run: run.get("/mesh/cells"))
    figure, panels = plt.subplots(1, len(sizes), figsize=(3.6 * len(sizes), 4.2), layout="constrained",
                                  sharey=True, squeeze=False)
    for axes, (cells, of_size) in zip(panels[0], sorted(sizes.items())):
        for kind, some in group(of_size, kind_of).items():
            colour, mark = LOOKS[kind]
            axes.scatter([accuracy.cost(run) for run in some], [100 * _error(run) for run in some], s=16,
                         color=colour, marker=mark, zorder=2)
            best = accuracy.front(some, against="solver")
            axes.plot([accuracy.cost(run) for run in best], [100 * _error(run) for run in best],
                      color=colour, linewidth=1.2, marker=mark, markersize=4, label=kind)
        for run in of_size:
            if run.get("/solver/method") == "pbd" and (run.get("/solver/substeps"),
                                                       run.get("/solver/iterations")) == PAPER:
                axes.plot(accuracy.cost(run), 100 * _error(run), "*", color=style.INK, markersize=13,
                          label="the paper's 1 × 10", zorder=3)
        axes.axhline(1, color=style.GREY, linewidth=0.8)
        axes.set_xscale("log"), axes.set_yscale("log")
        axes.set_xlabel("CPU time per frame of 1/60 s (ms)"), axes.set_title(f"{cells} cells")
    panels[0][0].set_ylabel(ylabel)
    panels[0][0].legend(loc="lower left", fontsize=7)
    figure.suptitle(title, x=0.01, ha="left", fontsize=11)
    return style.save(figure, out, name)


def _cheapest(runs, level):
    run = accuracy.reaching(runs, level, against="solver")
    return (accuracy.cost(run), run) if run else (np.nan, None)


def gains(runs, level=0.01):
    """By cells: the time of XPBD to a level over that of the fastest other method, and that method."""
    found = {}
    for cells, of_size in sorted(group(runs, lambda run: run.get("/mesh/cells")).items()):
        kinds = group(of_size, kind_of)
        mine, _ = _cheapest(kinds.pop("pbd", []), level)
        others = {kind: _cheapest(some, level)[0] for kind, some in kinds.items()}
        known = {kind: cost for kind, cost in others.items() if np.isfinite(cost)}
        if np.isfinite(mine) and known:
            best = min(known, key=known.get)
            found[cells] = (mine / known[best], best)
    return found


def _message(runs):
    found = gains(runs)
    if not found:
        return "Error at rest over time, for each solver method"
    times = ", ".join(f"{ratio:.1f} × at {cells} cells" for cells, (ratio, _) in found.items())
    return f"To 1 % at rest the fastest method takes less time than XPBD: {times}"


def _table(runs, caption):
    rows = []
    for cells, of_size in sorted(group(runs, lambda run: run.get("/mesh/cells")).items()):
        for kind, some in group(of_size, kind_of).items():
            cells_of_row = [cells, kind]
            for level in accuracy.LEVELS:
                cost, run = _cheapest(some, level)
                cells_of_row.append(f"{style.number(cost)} ({run.get('/solver/substeps')} × "
                                    f"{run.get('/solver/iterations')})" if run else "not reached")
            least = min(some, key=_error)
            rows.append(cells_of_row + [style.number(100 * _error(least), 2),
                                        style.number(least.summary["memory_bytes"] / 1e6, 2)])
    return Table(f"{caption}: ms per frame to each error, with substeps × iterations; the least error of "
                 "any run of the sweep, and the memory of the method's arrays in that run.",
                 ["cells", "method", *(f"to {100 * level:g} %" for level in accuracy.LEVELS),
                  "least error (%)", "memory (MB)"], rows)


if __name__ == "__main__":
    figure_main(main)
