"""Verdicts of the hard cases with every bending model, and pictures of runs that failed."""
import textwrap

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection

from bendlab.results.load import group
from draw import cloth, frames, render, style
from runs.stability_cases import CASES, FOLDER, GREEN, RED, SECTIONS, judge
from runs.stability_reasons import explain
from runs.sweeps import load_experiment
from tables.numbers import number, rounded, unit_text
from tables.section import address

# Sizes in pixels: picture, text above, text below, gap, colour bar
STILL, HEAD, FOOT, GAP, BAR = 220, 61, 52, 14, 64
COLUMNS, DPI, TEXT = 4, 100, 8


def main(results, out, section):
    """Judges every run. The section's data are the runs as JSON objects. The section's frames are from the
    worst red run of each case and model. Draws a picture of each group of cases, a file beside the page."""
    cells = cells_of(results, section, CASES, FOLDER, lambda run: (run.model, run.get("/solver/precision")))
    explain(cells)
    objects = {key: as_json(cell) for key, cell in cells.items()}
    section.data = [*objects.values()]
    red = group((key for key, cell in cells.items() if cell.verdict == RED and cell.run.frames),
                lambda key: key[:2])
    worst = [max(keys, key=lambda key: cells[key].worst.excess) for keys in red.values()]
    section.frames = frames.of_runs({id_of(objects[key]): cells[key].run for key in worst}, 2)
    for title, cases in SECTIONS.items():
        if failed := shown(cells, cases):
            _stills(title, failed, out)


def as_json(cell):
    seen = lambda name: cell.run.summary.get(f"stability_{name}", np.nan)
    return rounded({
        "case": cell.case.name, "title": cell.case.title, "model": cell.model, "precision": cell.precision,
        "verdict": cell.verdict, "worst": cell.worst.as_json(), "seconds": cell.run.cpu_s,
        "recovered_s": seen("recovered_at"), "energy_rises": seen("energy_rises"), "why": cell.why})


def kind_of(run):
    """The words that tell a run of a case from the others, besides its model: the precision or, if the run
    states them, its solver method and its bending law. `run` is a JSON object."""
    return [run.get("method") or run["precision"], *filter(None, [run.get("law")])]


def id_of(run):
    """The address of a run in the page, for example start-creased.adaptive.single; `run` is a JSON object."""
    return ".".join([address(run["case"]), run["model"], *map(address, kind_of(run))])


def cells_of(results, section, cases, folder, key_of):
    """(case name, *key_of(run)) → the judged run, for the existing runs of these cases in configs/<folder>. A
    run is compared with the undisturbed run that has the same key."""
    cells, experiments = {}, {}
    for case in cases:
        control = case.control_config or case.config
        for config in (case.config, control):
            if config not in experiments:
                experiments[config] = load_experiment(results, f"{folder}/{config}")
                section.uses(experiments[config])
        controls = _at(experiments[control], case.control, key_of)
        for key, run in _at(experiments[case.config], case.where, key_of).items():
            cells[case.name, *key] = judge(run, controls.get(key), case)
    return cells


def _at(experiment, where, key_of):
    """key_of(run) → run, for the runs with these values of swept settings. The long values of /effects are
    given by their index."""
    place = {pointer: experiment.sweep[pointer][value] if pointer == "/effects" else value
             for pointer, value in where.items()}
    return {key_of(run): run for run in experiment.runs if run.over and place.items() <= run.point.items()}


def shown(cells, cases):
    """[(cell, number of models that fail the same criterion)] to draw: the worst red cell for each criterion,
    or the worst amber cell of a case without red cells."""
    drawn = []
    for case in cases:
        failed = [cell for key, cell in cells.items() if key[0] == case.name and cell.verdict != GREEN]
        red = [cell for cell in failed if cell.verdict == RED]
        for alike in group(red or failed, lambda cell: cell.worst.name if red else "").values():
            worst = max(alike, key=lambda cell: cell.worst.excess)
            drawn.append((worst, len({cell.model for cell in alike})))
    return drawn


def _stills(title, failed, out):
    """Draws all pictures as one image, because separate axes would take longer to draw than the cloths."""
    columns = min(COLUMNS, len(failed))
    height, width = -(-len(failed) // columns) * (HEAD + STILL + FOOT), columns * (STILL + GAP)
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
    style.save(figure, out, "fig_stability_" + title.lower().replace(" ", "_"), dpi=DPI, tight=False)


def _still(axes, sheet, cell, alike, left, top):
    """Draws a run's last frame at (left, top) of the image; name above, worst number and extent below.
    `alike`: how many models fail the same criterion."""
    run, frame, worst = cell.run, cell.run.frames - 1, cell.worst
    positions, triangles = run.positions(frame), run.triangles
    camera = render.camera_around(positions, run.size / 2)
    excess = run.cell("max_stretch", frame) - 1
    colours = cloth.stretch_colours(excess)
    sheet[top:top + STILL, left:left + STILL] = render.render(positions, triangles, colours, camera, STILL)
    places = np.array([left, top]) + camera.project(positions, (STILL, STILL))[0]
    axes.add_collection(_slivers(places, triangles[excess > 1], colours[excess > 1]))
    axes.scatter(*places[run.pinned].T, s=4, c="#111418", edgecolors="white", linewidths=0.25, zorder=3)
    corner = cloth.free_corner(places - [left, top], (STILL, STILL))
    axes.text(left + corner["xy"][0] * STILL, top + 5, cloth.time_text(run, frame), ha=corner["ha"], va="top",
              fontsize=TEXT, bbox=cloth.LABEL)
    of_models = f" (worst of {alike} models)" if alike > 1 else ""
    lines = [cell.case.title, f"{cell.model}, {cell.precision}{of_models}"]
    axes.text(left, top - 4, "\n".join(textwrap.fill(line, 38) for line in lines), va="bottom", fontsize=TEXT)
    finite = positions[np.isfinite(positions).all(axis=1)]
    reach = np.linalg.norm(finite - (finite.min(axis=0) + finite.max(axis=0)) / 2, axis=1).max()
    worst_text = textwrap.fill(f"{worst.name} {number(worst.value)}{unit_text(worst.unit)}", 34)
    axes.text(left, top + STILL + 4, f"{worst_text}\n{number(2 * reach / run.size)} sizes across", va="top",
              fontsize=TEXT, color="#8a1538" if cell.verdict == RED else "#6d5200")


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
