"""Error against CPU time for each solver method, at rest and in motion."""
import numpy as np

from bendlab.results import registry
from bendlab.results.load import group
from figures.accuracy import measures
from tables import looks
from tables.chart import Chart

PAPER = 1, 10  # substeps, iterations
REST = ("methods_slow", "methods_96_slow", "methods_192_slow")


def main(results, out, section):
    def complete(*names):
        runs = measures.experiment_runs(results, section, *names)
        return [run for run in runs if run.complete or run.status == "implausible"]

    rest, stiffness = complete(*REST), complete("methods_stiffness_slow")
    models, motion = complete("methods_models_slow"), complete("methods_motion_slow")
    if stiffness:
        stiffness += [run for run in rest if run.get("/mesh/cells") == 48]
    section.text += " " + _growth(rest)
    for id, runs, scene_of, title, note in (
            ("at_rest", rest, by_cells, _message(rest), "A sheet of 40 cm hangs on two patches for 3 s. "
                                                        "Times include the single factorisation of a run."),
            ("membranes", stiffness, by_stiffness, "The method matters most for a stiff membrane",
             "48 cells. Y is the membrane's stiffness."),
            ("models", models, lambda run: looks.model_name(run.model, 2), "Methods over bending models",
             "48 cells."),
            ("in_motion", motion, by_cells, "The first half second: with few iterations a method lags behind",
             "The reference is Newton's method in 12 substeps of BDF2.")):
        if not runs:
            continue
        section.tables += [_fronts(id, runs, scene_of), _table(f"{id}_levels", runs, scene_of, title)]
        section.charts.append(Chart(
            id, title, id, "ms", ["error_solver"], ["kind"], held=["scene"], y_scale="log", look="method",
            limits=[("error_solver", 1, "1 %")], note=f"{note} A curve has the runs of a method "
                                                      f"with the least time for an error.{_left_out(runs)}"))
    if rest:
        section.tables.append(_set_up_table(rest))


def by_cells(run):
    return f"{run.get('/mesh/cells'):3d} cells"


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


def _by_kind(runs):
    return sorted(group(runs, kind_of).items(),
                  key=lambda entry: (registry.method_place(entry[0].split(", ")[0]), entry[0]))


def _error(run):
    return measures.error(run, against="solver")


def _is_drawn(run):
    return _error(run) <= 1  # with an error of more than its size, a cloth has flown apart


def _left_out(runs):
    """Sentences: how many runs a chart does not show, and why."""
    unknown = sum(np.isnan(_error(run)) for run in runs)
    apart = sum(not _is_drawn(run) for run in runs) - unknown
    text = ""
    if apart:
        text += f" Not drawn: {apart} of {len(runs)} runs, whose error is larger than the sheet's size."
    if unknown:
        text += (f" {unknown} of {len(runs)} runs have no error, because they have no reference, or a "
                 "reference that is not in balance.")
    return text


def _fronts(id, runs, scene_of):
    rows = [measures.row(run) | {"scene": scene.strip(), "kind": kind, "method": kind}
            for scene, in_scene in sorted(group([run for run in runs if _is_drawn(run)], scene_of).items())
            for kind, of_kind in _by_kind(in_scene) for run in measures.front(of_kind, against="solver")]
    rows += [measures.row(run)
             | {"scene": scene_of(run).strip(), "kind": "the paper's 1 × 10", "method": "pbd"}
             for run in runs if _is_drawn(run) and kind_of(run) == "pbd"
             and (run.get("/solver/substeps"), run.get("/solver/iterations")) == PAPER]
    return measures.table(id, "", ["scene", ("kind", "method"), "settings", "ms", "error_solver"], rows)


def _cheapest(runs, level):
    run = measures.reaching(runs, level, against="solver")
    return (measures.cost(run), run) if run else (np.nan, None)


def gains(runs, level=0.01):
    """{cells: (ratio, method)}. `method` is the fastest method for an error of `level`. XPBD without coarse
    levels takes `ratio` times as long."""
    ratios = {}
    for cells, of_size in sorted(group(runs, lambda run: run.get("/mesh/cells")).items()):
        kinds = group(of_size, kind_of)
        mine, _ = _cheapest(kinds.pop("pbd", []), level)
        costs = {kind: _cheapest(own_runs, level)[0] for kind, own_runs in kinds.items()}
        known = {kind: cost for kind, cost in costs.items() if np.isfinite(cost)}
        if np.isfinite(mine) and known:
            best = min(known, key=known.get)
            ratios[cells] = (mine / known[best], best)
    return ratios


def _message(runs):
    ratios = gains(runs)
    if not ratios:
        return "Error at rest over CPU time, for each solver method"
    times = ", ".join(f"{ratio:.1f} × at {cells}" for cells, (ratio, _) in ratios.items())
    return f"For an error of 1 % at rest XPBD takes longer than the fastest method: {times} cells"


def _growth(runs):
    """A sentence: the exponents p if the time to an error of 1 % grows as verticesᵖ."""
    powers = []
    for kind, own_runs in group(runs, kind_of).items():
        points = [(len(run.rest_positions), cost) for _, of_size in group(own_runs, by_cells).items()
                  for cost, run in [_cheapest(of_size, 0.01)] if run]
        if len(points) > 2:
            powers.append(f"{measures.slope(*zip(*points)):.1f} for {kind}")
    return ("The time to an error of 1 % grows as the number of vertices to the power "
            f"{', '.join(powers)}." if powers else "")


def _settings(run):
    return f"{run.get('/solver/substeps')} × {run.get('/solver/iterations')}" if run else "not reached"


def _table(id, runs, scene_of, caption):
    rows = []
    for scene, of_size in sorted(group(runs, scene_of).items()):
        for kind, own_runs in _by_kind(of_size):
            row = {"scene": scene.strip(), "method": kind}
            for level in measures.LEVELS:
                cost, run = _cheapest(own_runs, level)
                row |= {f"ms_{100 * level:g}": cost,
                        f"settings_{100 * level:g}": _settings(run)}
            least = min(own_runs, key=lambda run: np.nan_to_num(_error(run), nan=np.inf))
            rows.append(row | {"least": 100 * _error(least), "memory": measures.row(least)["memory"]})
    columns = [part for level in measures.LEVELS for part in (
        (f"ms_{100 * level:g}", f"time to {100 * level:g} %", "", "ms per frame"),
        (f"settings_{100 * level:g}", "substeps × iterations"))]
    return measures.table(id, f"{caption}: least times to three errors; the least error of all runs, and the "
                              "memory that the method's arrays take in the run with this error", [
                              "scene", "method", *columns, ("least", "least error", "", "%"), "memory"], rows)


def _set_up_table(runs):
    """Set-up times of the cheapest run with an error of 1 %, for each method and size."""
    rows = []
    for scene, of_size in sorted(group(runs, by_cells).items()):
        for kind, own_runs in _by_kind(of_size):
            _, run = _cheapest(own_runs, 0.01)
            if run is None:
                continue
            set_up, factor = 1e3 * run.passes.get("set_up", np.nan), 1e3 * run.passes.get("factorise", 0)
            frames = measures.FRAMES_PER_SECOND * measures.simulated(run)
            rows.append({"scene": scene.strip(), "method": kind, "set_up": set_up, "factor": factor or None,
                         "without": measures.cost(run) - factor / frames, "with_factor": measures.cost(run),
                         "with_both": measures.cost(run) + set_up / frames})
    return measures.table(
        "set_up", "Set-up of the cheapest run with an error of 1 %. Set-up makes the mesh, its constraints "
                  "and their order. Factorisation is the one factorisation of quasi_newton; newton's "
                  "factorisations count as steps. The last two columns include these times, divided by the "
                  "number of frames in 3 s.",
        ["scene", "method", ("set_up", "set-up", "", "ms"), ("factor", "factorisation", "", "ms"),
         ("without", "ms per frame without both"), ("with_factor", "with the factorisation"),
         ("with_both", "with both")], rows)
