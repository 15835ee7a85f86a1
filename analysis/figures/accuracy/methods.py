"""Error against CPU time for each solver method, at rest and in motion."""
import numpy as np

from bendlab.results import registry
from bendlab.results.load import group
from figures.accuracy.measures import (LEVEL_COLUMNS, LEVELS, cells, complete_runs, cost, frames,
                                       front_rows, level_cells, name_of, reaching, row, solver_error, table,
                                       work)
from tables.numbers import slope

LEVEL = 1  # %; the error to which the title, the text and the set-up table refer


def main(results, out, section):
    rest, stiffness, models, motion = (complete_runs(results, section, *names) for names in (
        ("methods_slow", "methods_96_slow", "methods_192_slow"), ("methods_stiffness_slow",),
        ("methods_models_slow",), ("methods_motion_slow",)))
    if stiffness:
        stiffness += [run for run in rest if cells(run) == 48]
    section.text += " " + _growth(rest)
    for id, runs, scene_of, title, note in (
            ("at_rest", rest, by_cells, _message(rest),
             "A sheet of 40 cm hangs on two patches. Times include the single factorisation of a run."),
            ("membranes", stiffness, by_stiffness, "The method matters most for a stiff membrane",
             "48 cells. Y is the membrane's stiffness."),
            ("models", models, lambda run: name_of(run.model), "Methods over bending models", "48 cells."),
            ("in_motion", motion, by_cells, "The first half second: with few iterations a method lags behind",
             "The reference is Newton's method in 12 substeps of BDF2.")):
        if runs:
            section.add_chart(
                _fronts(id, runs, scene_of), title, "ms", ["error_solver"], ["kind"], held=["scene"],
                y_scale="log", look="method", limits=[("error_solver", LEVEL, f"{LEVEL} %")],
                note=f"{note} A curve has the runs of a method with the least time for an error."
                     f"{_left_out(runs)}")
            section.tables.append(_levels(f"{id}_levels", runs, scene_of, title))
    if rest:
        section.tables.append(_set_up_table(rest))


def by_cells(run):
    return f"{cells(run):3d} cells"


def by_stiffness(run):
    return f"Y = 10{'⁰¹²³⁴⁵⁶⁷⁸⁹'[round(-np.log10(run.get('/material/strain/compliance')))]} N/m"


def kind_of(run):
    """The solver method of a run. A setting that changes the results of the method follows after a comma."""
    method = run.get("/solver/method")
    if run.get("/solver/membrane") == "auto":
        return f"{method}, membrane auto"
    if run.get("/solver/levels"):
        return f"{method}, levels"
    by_euler = run.get("/solver/integrator") == "euler" and registry.usual(method, "integrator") != "euler"
    return f"{method}, euler" if by_euler else method


def by_kind(runs, scene_of):
    """[(scene, method, runs)] in the order of scenes and of the program's methods."""
    place = lambda entry: (entry[0][0], registry.method_place(entry[0][1].split(", ")[0]), entry[0][1])
    groups = group(runs, lambda run: (scene_of(run), kind_of(run)))
    return [(scene.strip(), kind, own_runs) for (scene, kind), own_runs in sorted(groups.items(), key=place)]


def is_drawn(run):
    return solver_error(run) <= 1  # with an error of more than its size, a cloth has flown apart


def _left_out(runs):
    """Sentences: how many runs a chart does not show, and why."""
    unknown = sum(np.isnan(solver_error(run)) for run in runs)
    apart = sum(not is_drawn(run) for run in runs) - unknown
    text = ""
    if apart:
        text += f" Not drawn: {apart} of {len(runs)} runs, whose error is larger than the sheet's size."
    if unknown:
        text += (f" {unknown} of {len(runs)} runs have no error, because they have no reference, or a "
                 "reference that is not in balance.")
    return text


def _fronts(id, runs, scene_of):
    drawn = [run for run in runs if is_drawn(run)]
    rows = []
    for scene, kind, own_runs in by_kind(drawn, scene_of):
        rows += front_rows(own_runs, "solver", scene=scene, kind=kind, method=kind)
    rows += [row(run) | {"scene": scene_of(run).strip(), "kind": "the paper's 1 × 10", "method": "pbd"}
             for run in drawn if kind_of(run) == "pbd" and work(run) == "1 × 10"]
    return table(id, "", ["scene", ("kind", "method"), "settings", "ms", "error_solver"], rows)


def cheapest(runs, level=LEVEL):
    return reaching(runs, level, "solver")


def _message(runs):
    """The title: how much longer than the fastest other method XPBD takes for an error of LEVEL."""
    times = []
    for count, of_size in sorted(group(runs, cells).items()):
        costs = {kind: cost(run) for kind, own_runs in group(of_size, kind_of).items()
                 if (run := cheapest(own_runs))}
        xpbd = costs.pop("pbd", None)
        if xpbd and costs:
            times.append(f"{xpbd / min(costs.values()):.1f} × at {count}")
    if not times:
        return "Error at rest over CPU time, for each solver method"
    return (f"For an error of {LEVEL} % at rest XPBD takes longer than the fastest method: "
            f"{', '.join(times)} cells")


def _growth(runs):
    """A sentence: the exponents p if the time to an error of LEVEL grows as verticesᵖ."""
    powers = []
    for kind, own_runs in group(runs, kind_of).items():
        points = [(len(run.rest_positions), cost(run))
                  for of_size in group(own_runs, by_cells).values() if (run := cheapest(of_size))]
        if len(points) > 2:
            powers.append(f"{slope(*zip(*points)):.1f} for {kind}")
    return (f"The time to an error of {LEVEL} % grows as the number of vertices to the power "
            f"{', '.join(powers)}." if powers else "")


def _levels(id, runs, scene_of, caption):
    rows = []
    for scene, kind, own_runs in by_kind(runs, scene_of):
        rows.append({"scene": scene, "method": kind})
        for level in LEVELS:
            run = cheapest(own_runs, level)
            rows[-1] |= level_cells(level, run, work(run) if run else "not reached")
        least = min(own_runs, key=lambda run: np.nan_to_num(solver_error(run), nan=np.inf))
        rows[-1] |= {"least": 100 * solver_error(least), "memory": row(least)["memory"]}
    return table(id, f"{caption}: least times to three errors; the least error of all runs, and the memory "
                     "that the method's arrays take in the run with this error", [
        "scene", "method", *LEVEL_COLUMNS, ("least", "least error", "", "%"), "memory"], rows)


def _set_up_table(runs):
    """Set-up times of the cheapest run with an error of LEVEL, for each method and size."""
    rows = []
    for scene, kind, own_runs in by_kind(runs, by_cells):
        if run := cheapest(own_runs):
            set_up, factor = 1e3 * run.passes.get("set_up", np.nan), 1e3 * run.passes.get("factorise", 0)
            rows.append({"scene": scene, "method": kind, "set_up": set_up, "factor": factor or None,
                         "without": cost(run) - factor / frames(run), "with_factor": cost(run),
                         "with_both": cost(run) + set_up / frames(run)})
    return table(
        "set_up", f"Set-up of the cheapest run with an error of {LEVEL} %. Set-up makes the mesh, its "
                  "constraints and their order. Factorisation is the one factorisation of quasi_newton; "
                  "newton's factorisations count as steps. The last two columns include these times, divided "
                  "by the run's number of frames.",
        ["scene", "method", ("set_up", "set-up", "", "ms"), ("factor", "factorisation", "", "ms"),
         ("without", "ms per frame without both"), ("with_factor", "with the factorisation"),
         ("with_both", "with both")], rows)
