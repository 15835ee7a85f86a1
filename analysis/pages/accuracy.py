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

NEAR = 0.01  # the error of the answer
FIGURES = [
    Figure(fronts, "Error against time", "Error and time",
           "A sheet of 40 cm hangs at two pins, and a strip of 8 cm is clamped at one end. Every model is "
           "given the same cloth (B = 5·10⁻⁵ N m, 0.2 kg/m²). The physical error is the distance to that "
           "cloth. Its reference is a static equilibrium of calibrated hinges on finer cells: 96 for the "
           "curtain, 194 for the cantilever, clamped where the strip of 12 cells is. Errors below the "
           "distance between this reference and a reference on half as many cells are not known. The solver "
           "error is the distance to the equilibrium of the model's own energies on the same mesh. Distances "
           "are root mean squares over the sheet, in diagonals of its rest shape. Time is the CPU time of "
           "the steps for a frame of 1/60 s. Gravity gives the curtain most of its shape, bending little; "
           "the strip is held up by bending alone. A drape and a sheet on one pin have many equilibria: "
           "Newton's method starts at each run's end and finds an equilibrium of the stated cloth on the "
           "same mesh; the error is the distance to it after the best rotation about the vertical. Models "
           "without an equilibrium from Newton's method (choi_ko) have no solver error; nor has the paper's "
           "setting (10 iterations, 1/60 s, k = 0.5), because it defines no cloth."),
    Figure(beat, "Nearer than the paper, for less", "Nearer for less"),
    Figure(solver, "The same work, spent differently", "Same work",
           "Work is substeps times iterations; each iteration projects all constraints once. Errors are "
           "distances from the equilibrium of the run's own energies, so that they are the solver's alone."),
    Figure(rounding, "Short substeps in single precision", "Substeps",
           "In a substep h gravity moves a vertex by g h². With 4096 substeps this is 10⁻¹⁰ m, far below the "
           "last digit of a coordinate in single precision (10⁻⁷ m). The solver therefore stores the "
           "displacements of a substep apart from the positions, and the low digits of velocities apart from "
           "the high ones."),
    Figure(scaling, "Larger meshes, and motion", "Scaling",
           "A finer mesh has more constraints and needs more substeps for the same error, so that cost is "
           "compared at equal error. Motion is compared frame by frame with the same scene in 4096 substeps, "
           "the reference; the table says how far the reference is from a reference in 2048 substeps, and "
           "which errors are at least ten times that distance."),
    Figure(roads, "Methods that give the reference, and the single pin", "References",
           "A reference is trustworthy if different methods give it: Newton's method, the same scene run to "
           "rest with many substeps, and for the cantilever the heavy elastica. A drape and a sheet on one "
           "pin have many equilibria: there Newton's method starts at the run's end."),
    Figure(methods, "Solver methods", "Methods",
           "The same cloth, energies and forces with each solver method. Every method except XPBD comes to "
           "rest where the forces balance. With few iterations a method lags behind the motion, and takes "
           "longer to come to rest. Membrane auto softens the membrane as far as an error of 0.3 % of the "
           "size allows. Levels are coarse levels, as many as the mesh has."),
]


def write_data(sections, results, out):
    """summary.json: an object per run. `on_front`: no run of its scene is both cheaper and better."""
    single = {config.stem for config in (CONFIGS / "accuracy").glob("*.json")}.difference(*measures.FRONTS)
    objects = []
    for configs in [*measures.FRONTS, *((name,) for name in sorted(single))]:
        runs = [run for name in configs for run in load_experiment(results, f"accuracy/{name}").runs]
        front = {run.id for run in measures.front([run for run in runs if run.complete])}
        objects += [measures.as_json(run, run.id in front) for run in runs]
    write_objects(out / "summary.json", objects)


def content(sections, out):
    runs = summary(out)
    parts = [Part("runs", "Every run", folded(f"{len(runs)} runs", runs_html(runs)), "Runs"),
             Part("rules", "What an error is",
                  table_html(Table.of("errors", "", ["error", ("meaning", "what it is")], [
                 {"error": error, "meaning": meaning} for error, meaning in measures.MEANING.items()])),
                  "Errors"),
             Part("data", "As data", "<p><a href='summary.json'>summary.json</a>: every run.</p>", "Data")]
    return Content(answer(runs), parts=parts, data=accuracy_runs.data(runs),
                   verdicts=lambda section: [checks_html(section.checks)])


def answer(runs):
    """The cheapest measured run near the stated cloth in the first two scenes, and the error and time of the
    paper's setting. The start page shows the same runs."""
    chosen, best = accuracy_runs.candidates(runs), []
    for scene in list(accuracy_runs.SCENES)[:2]:
        if run := accuracy_runs.cheapest(chosen, scene, NEAR):
            best.append(f"for a cloth that {scene.split(':')[0]} <a href='#run-{escape(run['id'])}'>"
                        f"{escape(run['model'])}</a> on {run['cells']} cells in "
                        f"<b>{number_text(run['ms_per_frame'], 2)} ms</b> per frame")
    text = f"The cheapest within {100 * NEAR:g} % of the stated cloth: {', and '.join(best)}." if best else ""
    paper = next((run for run in runs if run["experiment"] == "accuracy_paper_64"
                  and run["model"] == "adaptive" and run.get("error_physical_rms")), None)
    if paper:
        text += (f" The paper's setting on 64 cells is {number_text(100 * paper['error_physical_rms'], 3)} % "
                 f"off, at {number_text(paper['ms_per_frame'], 2)} ms.")
    return text or "There are no runs yet."


def runs_html(runs):
    """Every run in a table; each row opens its run."""
    percent = lambda run, name: 100 * run[name] if isinstance(run.get(name), (int, float)) else None
    rows = [{"run": run["id"], "scene": accuracy_runs.scene(run), "model": run["model"],
             "cells": run["cells"],
             "work": accuracy_runs.work(run), "precision": run["settings"].get("precision", ""),
             "physical": percent(run, "error_physical_rms"), "solver": percent(run, "error_solver_rms"),
             "ms": run.get("ms_per_frame"), "status": run["status"]} for run in runs]
    return table_html(Table.of("runs", "Every run", [
        "run", "scene", "model", "cells", ("work", "substeps × iterations"), "precision",
        ("physical", "error from the stated", "", "%"), ("solver", "error from its own", "", "%"),
        ("ms", "time per frame", "", "ms"), "status"], rows), opens="run") or "<p>There are no runs.</p>"


PAGE = Page("accuracy", "What does accuracy cost?", "./bendlab reproduce accuracy", FIGURES, content,
            write_data)
