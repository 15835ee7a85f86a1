"""The page of accuracy and its cost."""
from figures.accuracy import beat, fronts, measures, methods, roads, rounding, scaling, solver
from pages.project import Content, Figure, Page, summary
from runs import accuracy_runs
from runs.sweeps import CONFIGS, load_experiment
from tables.numbers import number_text
from tables.section import write_objects
from tables.table import Table
from web.html_parts import Part, escape, folded, table_html
from web.verdicts import checks_html

NEAR = 0.01  # largest error of the runs in the answer
FIGURES = [
    Figure(fronts, "Error against time", "Error and time",
           "A sheet of 40 cm hangs at two pins, and a strip of 8 cm is clamped at one end. All models have "
           "the same stated cloth (B = 5·10⁻⁵ N m, 0.2 kg/m²). The physical error is the distance to a "
           "reference for this cloth: a static equilibrium of mid_edge on finer cells (96 for the "
           "curtain; 194 for the cantilever, clamped at the same place as the strip of 12 cells). Errors are "
           "not known if they are smaller than the distance between this reference and a reference on half "
           "as many cells. The solver error is the distance to the equilibrium of the model's own energies "
           "on the same mesh. Distances are root mean squares over the sheet, relative to the diagonal of "
           "its rest shape. Time is the CPU time of the steps for a frame of 1/60 s. The shape of the "
           "curtain depends mostly on gravity and little on bending. Bending alone holds the strip up. A "
           "draped sheet and a sheet on one pin have many equilibria. For each run of these scenes, Newton's "
           "method starts at the last frame and finds an equilibrium of the stated cloth on the same mesh. "
           "The error is the distance to this equilibrium after the best rotation about the vertical. The "
           "solver error is missing for models without an equilibrium from Newton's method (choi_ko), and "
           "for the paper's setting (10 iterations, 1/60 s, k = 0.5), because k defines no energy."),
    Figure(beat, "More accurate than the paper's setting, in less time", "Against the paper"),
    Figure(solver, "More substeps or more iterations? The same work", "Same work",
           "Work is substeps times iterations; each iteration projects all constraints once. Errors are "
           "distances from the equilibrium of the run's own energies, so that only the solver causes "
           "errors."),
    Figure(rounding, "Short substeps in single precision", "Substeps",
           "In a substep of length h, gravity moves a vertex by g h². With 4096 substeps this displacement "
           "is 10⁻¹⁰ m, far below the last digit of a coordinate in single precision (10⁻⁷ m). The solver "
           "therefore stores the displacements of a substep separately from the positions, and the low "
           "digits of velocities separately from the high digits."),
    Figure(scaling, "Larger meshes, and motion", "Scaling",
           "A finer mesh has more constraints and needs more substeps for the same error. So costs are "
           "compared at equal errors. The motion is compared frame by frame with a reference, the same scene "
           "in 4096 substeps. The table gives the distance of this reference from a reference in 2048 "
           "substeps, and which errors are at least ten times this distance."),
    Figure(roads, "Do different methods give the same reference?", "References",
           "A reference is reliable if different methods agree: Newton's method, the same scene run to rest "
           "with many substeps, and for the cantilever the heavy elastica. A draped sheet and a sheet on one "
           "pin have many equilibria. In these scenes Newton's method starts at the last frame of the run."),
    Figure(methods, "Solver methods", "Methods",
           "Each solver method computes the same cloth, with the same energies and forces. Every method "
           "except XPBD comes to rest where the forces balance. With few iterations a method lags behind the "
           "motion, and takes longer to come to rest. With 'membrane auto' the membrane is as soft as an "
           "error of 0.3 % of the cloth's size allows. With 'levels' the solver has coarse levels, as many "
           "as the mesh allows."),
]


def write_data(sections, results, out):
    """summary.json: an object per run. `on_front`: no other run of the scene is faster and more accurate."""
    single = {config.stem for config in (CONFIGS / "accuracy").glob("*.json")}.difference(*measures.FRONTS)
    objects = []
    for configs in [*measures.FRONTS, *((name,) for name in sorted(single))]:
        runs = [run for name in configs for run in load_experiment(results, f"accuracy/{name}").runs]
        front = {run.id for run in measures.front([run for run in runs if run.complete])}
        objects += [measures.as_json(run, run.id in front) for run in runs]
    write_objects(out / "summary.json", objects)


def content(sections, out):
    runs = summary(out)
    errors = Table.of("errors", "", ["error", ("meaning", "what it is")], [
        {"error": error, "meaning": meaning} for error, meaning in measures.MEANING.items()])
    parts = [Part("runs", "Every run", folded(f"{len(runs)} runs", runs_html(runs)), "Runs"),
             Part("rules", "What an error is", table_html(errors), "Errors"),
             Part("data", "As data", "<p><a href='summary.json'>summary.json</a>: every run.</p>", "Data")]
    return Content(answer(runs), parts=parts, data=accuracy_runs.data(runs),
                   verdicts=lambda section: [checks_html(section.checks)])


def answer(runs):
    """The page's answer: the fastest run with an error of at most NEAR in each of the first two scenes (as on
    the start page), and the error and time of the paper's setting."""
    chosen, best, text = accuracy_runs.candidates(runs), [], ""
    for scene in list(accuracy_runs.SCENES)[:2]:
        if run := accuracy_runs.cheapest(chosen, scene, NEAR):
            best.append(f"for a cloth that {scene.split(':')[0]}, <a href='#run-{escape(run['id'])}'>"
                        f"{escape(run['model'])}</a> on {run['cells']} cells in "
                        f"<b>{number_text(run['ms_per_frame'], 2)} ms</b> per frame")
    if best:
        text = f"The fastest runs with an error of at most {100 * NEAR:g} %: {', and '.join(best)}."
    paper = next((run for run in runs if run["experiment"] == "accuracy_paper_64"
                  and run["model"] == "adaptive" and run.get("error_physical_rms")), None)
    if paper:
        text += (" The paper's setting on 64 cells has an error of "
                 f"{number_text(100 * paper['error_physical_rms'], 3)} % and takes "
                 f"{number_text(paper['ms_per_frame'], 2)} ms.")
    return text or (f"The answer needs more runs. None of the {len(runs)} runs is known to have an error of "
                    f"at most {100 * NEAR:g} % for a cloth that "
                    f"{' or '.join(scene.split(':')[0] for scene in list(accuracy_runs.SCENES)[:2])}."
                    if runs else "There are no runs yet.")


def runs_html(runs):
    """A table of all runs; a click on a row opens the run."""
    percent = lambda run, name: 100 * run[name] if isinstance(run.get(name), (int, float)) else None
    rows = [{"run": run["id"], "scene": accuracy_runs.scene(run), "model": run["model"],
             "cells": run["cells"], "work": accuracy_runs.work(run),
             "precision": run["settings"].get("precision", ""),
             "physical": percent(run, "error_physical_rms"), "solver": percent(run, "error_solver_rms"),
             "ms": run.get("ms_per_frame"), "status": run["status"]} for run in runs]
    table = Table.of("runs", "Every run", [
        "run", "scene", "model", "cells", ("work", "substeps × iterations"), "precision",
        ("physical", "physical error", "", "%"), ("solver", "solver error", "", "%"),
        ("ms", "time per frame", "", "ms"), ("status", "verdict")], rows)
    return table_html(table, opens="run") or "<p>There are no runs.</p>"


PAGE = Page("accuracy", "What does accuracy cost?", "./bendlab reproduce accuracy", FIGURES, content,
            write_data)
