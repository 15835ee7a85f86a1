"""Verdicts of the hard cases with every bending model, and pictures of runs that failed."""
import re
import textwrap

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection

from draw import cloth, page_frames
from tables.numbers import number, rounded
from tables import looks
from draw import render
from draw import style
from bendlab.results.load import group
from runs.stability_cases import CASES, FOLDER, GREEN, RED, SECTIONS, judge
from runs.stability_reasons import explain
from runs.sweeps import load_experiment

# Sizes in pixels: picture, text above, text below, gap, colour bar
STILL, HEAD, FOOT, GAP, BAR = 220, 49, 40, 14, 64
COLUMNS, DPI, TEXT = 4, 100, 8


def main(results, out, section):
    """Judges every run. The section's data are the runs as JSON objects. The section's frames are from the
    worst red run of each case and model. Draws a picture of each group of cases, a file beside the page."""
    cells = cells_of(results, section, CASES, FOLDER, _model_and_precision)
    explain(cells)
    section.data = [as_json(cell) for cell in cells.values()]
    section.frames = page_frames.of_runs(_worst_runs(cells), 2)
    for title, cases in SECTIONS.items():
        failed = shown(cells, cases)
        if failed:
            _stills(title, failed, out)


def as_json(cell):
    seen = lambda name: cell.run.summary.get(f"stability_{name}", np.nan)
    return {"case": cell.case.name, "title": cell.case.title, "model": cell.model,
            "precision": cell.precision, "verdict": cell.verdict, "worst": rounded(cell.worst.as_json()),
            "seconds": rounded(cell.run.cpu_s), "recovered_s": rounded(seen("recovered_at")),
            "energy_rises": rounded(seen("energy_rises")), "why": cell.why}


def id_of(run):
    """The address of a run in the page, for example start-creased.adaptive.single; `run` is a JSON object. If
    the run states a solver method, the method replaces the precision."""
    words = lambda text: re.sub(r"[^a-z0-9]+", "-", text.lower()).strip("-")
    return f"{words(run['case'])}.{run['model']}.{words(run.get('method') or run['precision'])}"


def _worst_runs(cells):
    """Address → run: the worst red run of every case and model."""
    worst = {}
    for cell in cells.values():
        place = cell.case.name, cell.model
        if cell.verdict == RED and cell.run.frames and not worst.get(place, cell).worst.excess > \
                cell.worst.excess:
            worst[place] = cell
    return {id_of(as_json(cell)): cell.run for cell in worst.values()}


def cells_of(results, section, cases, folder, key_of):
    """(case name, *key_of(run)) → the judged run, for the existing runs of these cases in configs/<folder>. A
    run is compared with the undisturbed run that has the same key."""
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
    """A value of the sweep: `value`, or for the long values of /effects the value with this index."""
    return experiment.sweep[pointer][value] if pointer == "/effects" else value


def _at(experiment, where, key_of):
    """key_of(run) → run, for the runs with these values of swept settings."""
    here = lambda run: all(run.point.get(pointer) == _swept(experiment, pointer, value)
                           for pointer, value in where.items())
    return {key_of(run): run for run in experiment.runs if run.over and here(run)}


def shown(cells, cases):
    """[(cell, number of models that fail the same criterion)] to draw: the worst red cell for each criterion.

    A case without red cells has its worst amber cell.
    """
    drawn = []
    for case in cases:
        of_case = [cell for key, cell in cells.items() if key[0] == case.name and cell.verdict != GREEN]
        red = [cell for cell in of_case if cell.verdict == RED]
        ways = group(red, lambda cell: cell.worst.name) if red else {"": of_case} if of_case else {}
        for alike in ways.values():
            worst = max(alike, key=lambda cell: np.nan_to_num(cell.worst.excess, nan=np.inf))
            drawn.append((worst, len({cell.model for cell in alike})))
    return drawn


def _stills(title, failed, out):
    """Draws all pictures as one image, because separate axes would take longer to draw than the cloths."""
    columns = min(COLUMNS, len(failed))
    rows = -(-len(failed) // columns)
    height, width = rows * (HEAD + STILL + FOOT), columns * (STILL + GAP)
    figure = plt.figure(figsize=(width / DPI, (height + BAR) / DPI))
    axes = figure.add_axes([0, BAR / (height + BAR), 1, height / (height + BAR)])
    beside = (width - STILL) / 2 / width
    cloth.stretch_bar(figure, None, orientation="horizontal",
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
    """Draws a run's last frame at (left, top) of the image; name above, worst number and extent below.

    `alike`: how many models fail the same criterion.
    """
    run, frame = cell.run, cell.run.frames - 1
    positions, size = run.positions(frame), run.size
    camera = render.camera_around(positions, size / 2)
    triangles, excess = run.triangles, run.cell("max_stretch", frame) - 1
    colours = cloth.stretch_colours(excess)
    sheet[top:top + STILL, left:left + STILL] = render.render(positions, triangles, colours, camera, STILL)
    places = np.array([left, top]) + camera.project(positions, (STILL, STILL))[0]
    drawn_out = excess > 1
    axes.add_collection(_slivers(places, triangles[drawn_out], colours[drawn_out]))
    axes.scatter(*places[run.pinned].T, s=4, c="#111418", edgecolors="white", linewidths=0.25, zorder=3)
    corner = cloth.free_corner(places - [left, top], (STILL, STILL))
    axes.text(left + corner["xy"][0] * STILL, top + 5, cloth.time_text(run, frame), ha=corner["ha"], va="top",
              fontsize=TEXT, bbox=cloth.LABEL)
    of_models = f" (worst of {alike} models)" if alike > 1 else ""
    axes.text(left, top - 4, f"{textwrap.fill(cell.case.title, 38)}\n{looks.model_name(cell.model)}, "
              f"{cell.precision}{of_models}", va="bottom", fontsize=TEXT)
    axes.text(left, top + STILL + 4, f"{number_text(cell.worst)}\n{number(_across(positions) / size)} "
              "sizes across", va="top", fontsize=TEXT, color="#8a1538" if cell.verdict == RED else "#6d5200")


def _across(positions):
    """Twice the largest distance from the middle of the box around all finite vertices."""
    finite = positions[np.isfinite(positions).all(axis=1)]
    return 2 * np.linalg.norm(finite - (finite.min(axis=0) + finite.max(axis=0)) / 2, axis=1).max()


def _slivers(places, triangles, colours):
    """Lines along the longest edges of triangles that are too thin to cover a pixel."""
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
    return f"{criterion.name} {number(criterion.value)}{unit}"
