"""Hard cases × bending models: a matrix of verdicts, and pictures of runs that failed."""
import right_python  # noqa: F401  (first: it may hand over to another Python)
import itertools
import textwrap

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.patches import Patch

from bendlab.results import registry
import render
import style
from bendlab.results.load import group
from report import Section, figure_main
from stability_cases import AMBER, CASES, FOLDER, GREEN, MOVES_LIMITED, RED, SECTIONS, judge
from stability_reasons import explain
from sweeps import load_experiment

COLOURS = {GREEN: "#4da57c", AMBER: "#f0bf4f", RED: "#c8402f"}
MISSING = "#eceff1"
MARKS = {AMBER: "–", RED: "×"}  # for readers who can't distinguish the colours
PRECISIONS = ("single", "double")
ROW = 0.172  # inches
# Pixels: picture, text above, text below, gap, colour bar
STILL, HEAD, FOOT, GAP, BAR = 220, 49, 40, 14, 64
COLUMNS, DPI, TEXT = 4, 100, 8


def main(results, out):
    """Draws the matrix and a sheet of pictures per section. The section gets cells and stills."""
    section = Section("What is stable", "stability")
    section.cells, section.stills = cells_of(results, section, CASES, FOLDER, _model_and_precision), {}
    explain(section.cells)
    if section.cells:
        section.pictures.append((_matrix(section.cells, out), caption(section.cells)))
        for title, cases in SECTIONS.items():
            failed = shown(section.cells, cases)
            if failed:
                section.stills[title] = _stills(title, failed, out)
    return section


def cells_of(results, section, cases, folder, key_of):
    """(case name, *key_of(run)) → judged cell, for every run of these cases in configs/<folder> that exists.
    A run is compared with the undisturbed one of the same key."""
    cells, experiments = {}, {}
    for case in cases:
        for config in (case.config, case.control_config or case.config):
            if config not in experiments:
                experiments[config] = load_experiment(results, f"{folder}/{config}")
                section.uses(experiments[config])
        runs = _at(experiments[case.config], case.where, key_of)
        controls = _at(experiments[case.control_config or case.config], case.control, key_of)
        for key, run in runs.items():
            cells[case.name, *key] = judge(run, controls.get(key), case)
    return cells


def _model_and_precision(run):
    return run.model, run.get("/solver/precision")


def _swept(experiment, pointer, value):
    """A value of the sweep. For /effects, whose values are long, `value` is its index."""
    return experiment.sweep[pointer][value] if pointer == "/effects" else value


def _at(experiment, where, key_of):
    """key_of(run) → the run, for those at a point of the sweep."""
    here = lambda run: all(run.point.get(pointer) == _swept(experiment, pointer, value)
                           for pointer, value in where.items())
    return {key_of(run): run for run in experiment.runs if run.over and here(run)}


def count(cells, verdict, model=None):
    return sum(cell.verdict == verdict and model in (None, cell.model) for cell in cells.values())


def caption(cells):
    return (f"{len(cells)} runs: {count(cells, GREEN)} green (pass), {count(cells, AMBER)} amber (stable, "
            f"but not recovered), {count(cells, RED)} red (not a number, flown apart, or momentum or energy "
            "gained). Each cell has two halves: single precision upper left, double precision lower right. "
            f"Cases in which all runs have one colour are counted in grey. {MOVES_LIMITED}")


def folded(cells, cases):
    """(cases that tell runs apart, verdict → cases all of whose runs have it). Cases without runs are left
    out."""
    telling, alike = [], {}
    for case in cases:
        verdicts = {cell.verdict for key, cell in cells.items() if key[0] == case.name}
        if len(verdicts) > 1:
            telling.append(case)
        elif verdicts:
            alike.setdefault(verdicts.pop(), []).append(case)
    return telling, alike


def alike_text(alike):
    """'not shown: 2 all green, 1 all red' of the cases that are folded away."""
    return "not shown: " + ", ".join(f"{len(alike[verdict])} all {verdict}"
                                     for verdict in (GREEN, AMBER, RED) if verdict in alike)


def _matrix(cells, out):
    """Draws a row for each case that tells runs apart, and below each section how many are folded away."""
    places, notes, heads, height = _rows(cells)
    models = sorted({cell.model for cell in cells.values()}, key=registry.model_place)
    figure, axes = plt.subplots(figsize=(9.3, ROW * height + 1.2), layout="constrained")
    halves, colours = [], []
    for place, case in places:
        axes.text(-0.15, place + 0.5, case.title, ha="right", va="center", fontsize=8)
        for (column, model), precision in itertools.product(enumerate(models), PRECISIONS):
            cell = cells.get((case.name, model, precision))
            halves.append(_half(column, place, precision))
            colours.append(COLOURS[cell.verdict] if cell else MISSING)
            if cell and cell.verdict in MARKS:
                _mark(axes, column, place, precision, cell.verdict)
    axes.add_collection(PolyCollection(halves, facecolors=colours, edgecolors="face", linewidths=0.3))
    for place, title in heads:
        axes.text(-0.15, place + 0.5, title, ha="right", va="center", fontsize=8.6, fontweight="bold")
    for place, note in notes:
        axes.text(0.04, place + 0.5, note, va="center", fontsize=8, color=style.GREY)
    _label_matrix(axes, models, height)
    return style.save(figure, out, "fig_stability")


def _rows(cells):
    """(place, case), (place, note on folded cases) and (place, section) from the top, and the height."""
    y, places, notes, heads = 0.0, [], [], []
    for title, cases in SECTIONS.items():
        telling, alike = folded(cells, cases)
        if not telling and not alike:
            continue
        heads.append((y, title))
        if alike:
            notes.append((y, alike_text(alike) + ("" if telling else "; none tells the models apart")))
        places += [(y + 1 + i, case) for i, case in enumerate(telling)]
        y += len(telling) + 1.35
    return places, notes, heads, y


def _label_matrix(axes, models, height):
    """Names the columns and the colours."""
    axes.set_xlim(0, len(models)), axes.set_ylim(height, -0.1)
    axes.set_xticks(np.arange(len(models)) + 0.5, [style.model_name(model) for model in models],
                    rotation=35, ha="left")
    axes.xaxis.tick_top()
    axes.tick_params(length=0)
    axes.set_yticks([])
    axes.grid(False)
    for side in axes.spines.values():
        side.set_visible(False)
    names = {GREEN: "passes", AMBER: "stable, not recovered", RED: "unstable"}
    axes.legend(handles=[Patch(color=COLOURS[verdict], label=f"{MARKS.get(verdict, '')} {name}".strip())
                         for verdict, name in names.items()], ncol=3, loc="upper center",
                bbox_to_anchor=(0.4, 0.0), fontsize=8.5)


def _half(column, place, precision):
    """Corners of a triangle: upper left half of a cell for single precision, lower right for double."""
    left, right, top, bottom = column + 0.04, column + 0.96, place + 0.05, place + 0.95
    return [(left, top), (right, top),
            (left, bottom)] if precision == "single" else [(right, bottom), (left, bottom), (right, top)]


def _mark(axes, column, place, precision, verdict):
    x, y = (0.27, 0.36) if precision == "single" else (0.73, 0.68)
    axes.text(column + x, place + y, MARKS[verdict], fontsize=5.5, color="white" if verdict == RED
              else style.INK, ha="center", va="center")


def shown(cells, cases):
    """(cell, number of models that fail alike) to draw: the worst cell of each way in which a case turns red.

    A case without any red cell has its worst amber cell.
    """
    found = []
    for case in cases:
        of_case = [cell for key, cell in cells.items() if key[0] == case.name and cell.verdict != GREEN]
        red = [cell for cell in of_case if cell.verdict == RED]
        ways = group(red, lambda cell: cell.worst.name) if red else {"": of_case} if of_case else {}
        for some in ways.values():
            worst = max(some, key=lambda cell: np.nan_to_num(cell.worst.excess, nan=np.inf))
            found.append((worst, len({cell.model for cell in some})))
    return found


def _stills(title, failed, out):
    """Draws a sheet of pictures as one image: that many axes would take longer than the cloths."""
    columns = min(COLUMNS, len(failed))
    rows = -(-len(failed) // columns)
    height, width = rows * (HEAD + STILL + FOOT), columns * (STILL + GAP)
    figure = plt.figure(figsize=(width / DPI, (height + BAR) / DPI))
    axes = figure.add_axes([0, BAR / (height + BAR), 1, height / (height + BAR)])
    beside = (width - STILL) / 2 / width
    style.stretch_bar(figure, None, orientation="horizontal",
                      cax=figure.add_axes([beside, 44 / (height + BAR), 1 - 2 * beside, 9 / (height + BAR)]))
    sheet = np.ones((height, width, 3))
    for place, (cell, alike) in enumerate(failed):
        row, column = divmod(place, columns)
        _still(axes, sheet, cell, alike, column * (STILL + GAP) + GAP // 2,
               row * (HEAD + STILL + FOOT) + HEAD)
    axes.imshow(sheet, interpolation="none", extent=(0, width, height, 0))
    axes.set_axis_off()
    name = "fig_stability_" + title.lower().replace(" ", "_")
    return style.save(figure, out, name, dpi=DPI, tight=False)


def _still(axes, sheet, cell, alike, left, top):
    """Draws a run's last frame at (left, top) of the sheet; name above, worst number and extent below.

    `alike`: how many models fail in the same way.
    """
    run, frame = cell.run, cell.run.frames - 1
    positions, size = run.positions(frame), run.size
    camera = render.camera_around(positions, size / 2)
    triangles, excess = run.triangles, run.cell("max_stretch", frame) - 1
    colours = style.stretch_colours(excess)
    sheet[top:top + STILL, left:left + STILL] = render.render(positions, triangles, colours, camera, STILL)
    places = np.array([left, top]) + camera.project(positions, (STILL, STILL))[0]
    drawn_out = excess > 1
    axes.add_collection(_slivers(places, triangles[drawn_out], colours[drawn_out]))
    axes.scatter(*places[run.pinned].T, s=4, c="#111418", edgecolors="white", linewidths=0.25, zorder=3)
    corner = style.free_corner(places - [left, top], (STILL, STILL))
    axes.text(left + corner["xy"][0] * STILL, top + 5, style.time_text(run, frame), ha=corner["ha"], va="top",
              fontsize=TEXT, bbox=style.LABEL)
    others = f" (worst of {alike} models)" if alike > 1 else ""
    axes.text(left, top - 4, f"{textwrap.fill(cell.case.title, 38)}\n{style.model_name(cell.model)}, "
              f"{cell.precision}{others}", va="bottom", fontsize=TEXT)
    axes.text(left, top + STILL + 4, f"{number_text(cell.worst)}\n{style.number(_across(positions) / size)} "
              "sizes across", va="top", fontsize=TEXT, color="#8a1538" if cell.verdict == RED else "#6d5200")


def _across(positions):
    """Twice the largest distance from the middle of the box around all finite vertices."""
    finite = positions[np.isfinite(positions).all(axis=1)]
    return 2 * np.linalg.norm(finite - (finite.min(axis=0) + finite.max(axis=0)) / 2, axis=1).max()


def _slivers(places, triangles, colours):
    """Triangles too thin to cover a pixel, as lines along their longest edges: keeps threads visible."""
    corners = places[triangles]
    edges = np.roll(corners, -1, axis=1) - corners
    lengths = np.linalg.norm(edges, axis=2)
    area = np.abs(edges[:, 0, 0] * edges[:, 1, 1] - edges[:, 0, 1] * edges[:, 1, 0])
    longest, rows = lengths.argmax(axis=1), np.arange(len(triangles))
    thin = (lengths.max(axis=1) > 4) & (area < lengths.max(axis=1))  # pixels
    lines = np.stack([corners[rows, longest], corners[rows, (longest + 1) % 3]], axis=1)
    return LineCollection(lines[thin], colors=colours[thin], linewidths=0.5)


def number_text(criterion):
    unit = "" if criterion.unit == "1" else " " + criterion.unit
    return f"{criterion.name} {style.number(criterion.value)}{unit}"


if __name__ == "__main__":
    figure_main(main)
