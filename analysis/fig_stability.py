"""Hard cases × bending models: a matrix of verdicts, and stills of what failed."""
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.patches import Patch, Polygon

import render
import style
from load import MODELS, group, load_experiment, swept_value
from report import Section, Table, figure_main
from stability_cases import AMBER, CASES, FOLDER, GREEN, RED, SECTIONS, judge
from stability_reasons import reason

COLOURS = {GREEN: "#4da57c", AMBER: "#f0bf4f", RED: "#c8402f"}
MISSING = "#eceff1"
MARKS = {AMBER: "–", RED: "×"}  # for those who can't tell the colours
PRECISIONS = ("single", "double")
STILL_WIDTH, COLUMNS = 190, 6  # pixels; stills side by side


def main(results, out):
    """Draws the matrix and a sheet of stills per section; the section's cells are left in `cells`."""
    section = Section("What is stable", "stability")
    section.cells, section.stills = cells_of(results, section), {}
    if section.cells:
        section.pictures.append((_matrix(section.cells, out), caption(section.cells)))
        for title, cases in SECTIONS.items():
            failed = shown(section.cells, cases)
            if failed:
                section.stills[title] = _stills(title, failed, out)
        section.tables.append(_table(section.cells))
    return section


def cells_of(results, section):
    """(case name, model, precision) → cell of every run that is there."""
    cells, experiments = {}, {}
    for case in CASES:
        if case.config not in experiments:
            experiments[case.config] = load_experiment(results, f"{FOLDER}/{case.config}")
            section.uses(experiments[case.config])
        experiment = experiments[case.config]
        place = lambda wanted: {pointer: _swept(experiment, pointer, value) for pointer, value in wanted.items()}
        runs, controls = _at(experiment, place(case.where)), _at(experiment, place(case.control))
        for key, run in runs.items():
            cell = judge(run, controls.get(key), case)
            cell.why = reason(cell) if cell.verdict != GREEN else ""
            cells[case.name, *key] = cell
    return cells


def _swept(experiment, pointer, value):
    """A value of the sweep, or the one at that place of it where values are long."""
    return experiment.sweep[pointer][value] if pointer == "/effects" else value


def _at(experiment, where):
    """(model, precision) → the run at a place of the sweep."""
    here = lambda run: all(swept_value(run.config, pointer, experiment.sweep) == value for pointer, value in where.items())
    return {(run.model, run.get("/solver/precision")): run for run in experiment.runs
            if run.status in ("complete", "diverged") and here(run)}


def count(cells, verdict, model=None):
    return sum(cell.verdict == verdict and model in (None, cell.model) for cell in cells.values())


def caption(cells):
    return (f"{len(cells)} runs: {count(cells, GREEN)} green (pass), {count(cells, AMBER)} amber (stable, not recovered), "
            f"{count(cells, RED)} red (not a number, flown apart, torn, or momentum or energy gained). Each cell is cut in two: "
            "upper left single, lower right double precision.")


def _matrix(cells, out):
    rows = [(title, case) for title, cases in SECTIONS.items() for case in cases if any(key[0] == case.name for key in cells)]
    y, places, heads, last = 0.0, [], [], None
    for title, case in rows:
        if title != last:
            y += 1.25 if last else 0.6
            heads.append((y - 0.28, title))
            last = title
        places.append((y, case))
        y += 1
    figure, axes = plt.subplots(figsize=(9.6, 0.205 * y + 1.5), layout="constrained")
    for place, case in places:
        axes.text(-0.15, place + 0.5, case.title, ha="right", va="center", fontsize=8)
        for column, model in enumerate(MODELS):
            for precision in PRECISIONS:
                _half(axes, column, place, precision, cells.get((case.name, model, precision)))
    for place, title in heads:
        axes.text(-0.15, place + 0.12, title, ha="right", va="center", fontsize=8.6, fontweight="bold")
    axes.set_xlim(0, len(MODELS)), axes.set_ylim(y + 0.1, -0.1)
    axes.set_xticks(np.arange(len(MODELS)) + 0.5, [style.MODEL_NAMES.get(model, model).replace(" (k_ring 1)", "") for model in MODELS],
                    rotation=35, ha="left")
    axes.xaxis.tick_top()
    axes.tick_params(length=0)
    axes.set_yticks([])
    axes.grid(False)
    for side in axes.spines.values():
        side.set_visible(False)
    names = {GREEN: "passes", AMBER: "stable, not recovered", RED: "unstable"}
    axes.legend(handles=[Patch(color=COLOURS[verdict], label=f"{MARKS.get(verdict, '')} {name}".strip())
                         for verdict, name in names.items()], ncol=3, loc="upper center", bbox_to_anchor=(0.4, 0.0), fontsize=8.5)
    return style.save(figure, out, "fig_stability")


def _half(axes, column, place, precision, cell):
    """A triangle: the upper left half of a cell for single precision, the lower right one for double."""
    left, right, top, bottom = column + 0.04, column + 0.96, place + 0.05, place + 0.95
    corners = [(left, top), (right, top), (left, bottom)] if precision == "single" else [(right, bottom), (left, bottom), (right, top)]
    axes.add_patch(Polygon(corners, color=COLOURS[cell.verdict] if cell else MISSING, linewidth=0))
    if cell and cell.verdict in MARKS:
        x = 0.27 if precision == "single" else 0.73
        axes.text(column + x, place + (0.36 if precision == "single" else 0.68), MARKS[cell.verdict], fontsize=5.5, color="white" if
                  cell.verdict == RED else style.INK, ha="center", va="center")


def shown(cells, cases):
    """The red cells of these cases, one of a model; of a case that has none the amber one that is farthest from its limit."""
    found = []
    for case in cases:
        of_case = [cell for key, cell in cells.items() if key[0] == case.name and cell.verdict != GREEN]
        red = group([cell for cell in of_case if cell.verdict == RED], lambda cell: cell.model)
        found += [some[0] for some in red.values()] or sorted(of_case, key=lambda cell: -cell.worst.excess)[:1]
    return found


def _stills(title, failed, out):
    rows = -(-len(failed) // COLUMNS)
    figure, axes = plt.subplots(rows, COLUMNS, figsize=(1.9 * COLUMNS, 2.35 * rows), squeeze=False, layout="constrained")
    for panel in axes.ravel():
        panel.set_axis_off()
    for panel, cell in zip(axes.ravel(), failed):
        _still(panel, cell)
    name = "fig_stability_" + title.lower().replace(" ", "_")
    return style.save(figure, out, name, dpi=100)


def _still(axes, cell):
    run, frame = cell.run, cell.run.frames - 1
    positions = run.positions(frame)
    middle = np.median(positions, axis=0)
    camera = render.camera_for([positions], middle, run.size, aspect=1.0, zoom=0.42)  # alike in all, a point too
    style.draw_cloth(axes, (run, frame), camera, STILL_WIDTH)
    axes.set_title(f"{cell.case.title}\n{style.MODEL_NAMES.get(cell.model, cell.model)}, {cell.precision}", fontsize=6.5, pad=2)
    axes.text(0.5, -0.02, number_text(cell.worst), transform=axes.transAxes, ha="center", va="top", fontsize=6.5,
              color="#8a1538" if cell.verdict == RED else "#6d5200")


def number_text(criterion):
    unit = "" if criterion.unit == "1" else " " + criterion.unit
    return f"{criterion.name} {style.number(criterion.value)}{unit}"


def _table(cells):
    rows = [[cell.case.title, cell.model, cell.precision, cell.verdict, number_text(cell.worst), style.number(cell.worst.limit),
             style.number(cell.run.summary.get("stability_recovered_at", np.nan)),
             style.number(100 * cell.run.summary.get("stability_energy_rises", np.nan)), f"{cell.run.cpu_s:.2f}"]
            for cell in cells.values()]
    return Table("Every run", ["case", "model", "precision", "verdict", "worst number", "its limit", "recovered at (s)",
                               "steps in which energy rose (%)", "processor time (s)"], rows)


if __name__ == "__main__":
    figure_main(main)
