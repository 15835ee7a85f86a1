"""Error against time, over solver methods: the pose at rest, and motion."""
import right_python  # noqa: F401  (first: it may hand over to another Python)
import matplotlib.pyplot as plt
import numpy as np

import accuracy
from bendlab.results import registry
import style
from bendlab.results.load import group
from report import Section, Table, figure_main

PAPER = (1, 10)  # substeps, iterations
REST = ("methods_slow", "methods_96_slow", "methods_192_slow")


def main(results, out):
    section = Section("Solver methods", "accuracy_methods")

    def complete(*names):
        runs = accuracy.experiment_runs(results, section, *names)
        return [run for run in runs if run.complete or run.status == "implausible"]

    rest, stiffness = complete(*REST), complete("methods_stiffness_slow")
    models, motion = complete("methods_models_slow"), complete("methods_motion_slow")
    section.text = (
        "The same cloth, energies and forces with each solver method. Every method but XPBD comes to rest "
        "where the forces balance, but few iterations lag behind the motion, and take longer to come there. "
        "Membrane auto softens the membrane by as much as 0.3 % of the size allows. Levels are coarse ones, "
        "as many as the mesh has. " + _growth(rest))
    if rest:
        _draw(section, _fronts(rest, out, "fig_accuracy_methods", by_cells, AT_REST, _message(rest)),
              "The sheet of 40 cm hangs on two patches for 3 s. A star is the paper's setting, 1 × 10. Times "
              "include the one factorisation.", rest)
        section.tables += [_table(rest, by_cells, "At rest, over sizes"), _set_up_table(rest)]
    if stiffness:
        stiffness += [run for run in rest if run.get("/mesh/cells") == 48]
        _draw(section, _fronts(stiffness, out, "fig_accuracy_methods_stiffness", by_stiffness, AT_REST,
                               "The stiffer the membrane, the more its method matters"),
              "48 cells. Y is the membrane's stiffness.", stiffness)
        section.tables.append(_table(stiffness, by_stiffness, "At rest, over membranes"))
    if models:
        section.tables.append(_table(models, lambda run: style.model_name(run.model, 2),
                                     "At rest, over bending models, 48 cells"))
    if motion:
        _draw(section, _fronts(motion, out, "fig_accuracy_methods_motion", by_cells,
                               "distance from the motion (% of size)",
                               "The first half second: few iterations lag behind"),
              "The reference is Newton's method in 12 substeps of BDF2.", motion)
        section.tables.append(_table(motion, by_cells, "In motion"))
    return section


AT_REST = "distance from the equilibrium (% of size)"


def by_cells(run):
    return f"{run.get('/mesh/cells'):3d} cells"


def by_stiffness(run):
    return f"Y = 10{'⁰¹²³⁴⁵⁶⁷⁸⁹'[round(-np.log10(run.get('/material/strain/compliance')))]} N/m"


def kind_of(run):
    """The method of a run, with what changes its results."""
    method = run.get("/solver/method")
    if run.get("/solver/membrane") == "auto":
        return f"{method}, membrane auto"
    if run.get("/solver/levels"):
        return f"{method}, levels"
    by_euler = run.get("/solver/integrator") == "euler" and registry.usual(method, "integrator") != "euler"
    return f"{method}, euler" if by_euler else method


def look_of(kind):
    """(colour, mark) of a kind of runs."""
    method, *more = kind.split(", ")
    return style.method_look(method, len(more))


def _by_kind(runs):
    return sorted(group(runs, kind_of).items(),
                  key=lambda each: (registry.method_place(each[0].split(", ")[0]), each[0]))


def _error(run):
    return accuracy.error(run, against="solver")


def _is_drawn(run):
    return _error(run) <= 1  # farther than its size a cloth has flown apart


def _draw(section, picture, caption, runs):
    """Adds the picture of these runs, if there is one, and says how many it leaves out."""
    unknown = sum(np.isnan(_error(run)) for run in runs)
    apart = sum(not _is_drawn(run) for run in runs) - unknown
    left_out = ""
    if apart:
        left_out += f" Not drawn: {apart} of {len(runs)} runs, which are farther off than the sheet's size."
    if unknown:
        left_out += (f" {unknown} of {len(runs)} runs have no error: they were not compared, or their "
                     "reference is not balanced.")
    if picture:
        section.pictures.append((picture, caption + left_out))
    else:
        section.text += left_out


def _fronts(runs, out, name, of_panel, ylabel, title):
    runs = [run for run in runs if _is_drawn(run)]
    if not runs:
        return None
    panels_of = sorted(group(runs, of_panel).items())
    figure, panels = plt.subplots(1, len(panels_of), figsize=(1.2 + 2.9 * len(panels_of), 4.2),
                                  layout="constrained", sharey=True, squeeze=False)
    for axes, (panel, of_size) in zip(panels[0], panels_of):
        for kind, some in _by_kind(of_size):
            colour, mark = look_of(kind)
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
        axes.set_xlabel("CPU time per frame of 1/60 s (ms)"), axes.set_title(panel.strip())
    panels[0][0].set_ylabel(ylabel)
    named = {label: handle for axes in panels[0] for handle, label in
             zip(*axes.get_legend_handles_labels())}  # each kind once, whichever panel has it
    panels[0][0].legend(named.values(), named.keys(), loc="lower left", fontsize=7)
    figure.suptitle(title, x=0.01, ha="left", fontsize=11)
    return style.save(figure, out, name)


def _cheapest(runs, level):
    run = accuracy.reaching(runs, level, against="solver")
    return (accuracy.cost(run), run) if run else (np.nan, None)


def gains(runs, level=0.01):
    """By cells: the time of XPBD without levels to a level over that of the fastest other method, and it."""
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
    times = ", ".join(f"{ratio:.1f} × at {cells}" for cells, (ratio, _) in found.items())
    return f"To 1 % at rest the fastest method takes less time than XPBD: {times} cells"


def _growth(runs):
    """With what power of the vertices the time to 1 % grows, as a sentence."""
    told = []
    for kind, some in group(runs, kind_of).items():
        points = [(len(run.rest_positions), cost) for _, of_size in group(some, by_cells).items()
                  for cost, run in [_cheapest(of_size, 0.01)] if run]
        if len(points) > 2:
            told.append(f"{accuracy.slope(*zip(*points)):.1f} for {kind}")
    return f"Time to 1 % grows with the vertices to the power of {', '.join(told)}." if told else ""


def _table(runs, of_row, caption):
    rows = []
    for row, of_size in sorted(group(runs, of_row).items()):
        for kind, some in _by_kind(of_size):
            cells_of_row = [row.strip(), kind]
            for level in accuracy.LEVELS:
                cost, run = _cheapest(some, level)
                cells_of_row.append(f"{style.number(cost)} ({run.get('/solver/substeps')} × "
                                    f"{run.get('/solver/iterations')})" if run else "not reached")
            least = min(some, key=lambda run: np.nan_to_num(_error(run), nan=np.inf))
            rows.append(cells_of_row + [style.number(100 * _error(least), 2),
                                        style.number(least.summary["memory_bytes"] / 1e6, 2)])
    return Table(f"{caption}: ms per frame to each error, with substeps × iterations; the least error of "
                 "any run of the sweep, and the memory of the method's arrays in that run.",
                 ["scene", "method", *(f"to {100 * level:g} %" for level in accuracy.LEVELS),
                  "least error (%)", "memory (MB)"], rows)


def _set_up_table(runs):
    """What comes before the first step, of the cheapest run to 1 % of every method and size."""
    rows = []
    for row, of_size in sorted(group(runs, by_cells).items()):
        for kind, some in _by_kind(of_size):
            _, run = _cheapest(some, 0.01)
            if run is None:
                continue
            set_up, factor = run.passes.get("set_up", np.nan), run.passes.get("factorise", 0)
            frames = accuracy.FRAMES_PER_SECOND * accuracy.simulated(run)
            per_frame = accuracy.cost(run)
            rows.append([row.strip(), kind, style.number(1e3 * set_up),
                         style.number(1e3 * factor) if factor else "–",
                         style.number(per_frame - 1e3 * factor / frames), style.number(per_frame),
                         style.number(per_frame + 1e3 * set_up / frames)])
    return Table("Set-up apart and amortised, of the cheapest run to 1 %. Set-up is the mesh, its "
                 "constraints and their order. The factorisation is that of quasi_newton's metric, once; "
                 "the matrices of newton are a part of its steps. The last two columns spread these over "
                 "the 3 s of the run.",
                 ["scene", "method", "set-up (ms)", "factorisation (ms)", "ms per frame without both",
                  "with the factorisation", "with both"], rows)


if __name__ == "__main__":
    figure_main(main)
