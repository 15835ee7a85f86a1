"""The plain matrix: runs that broke a bound, with or without a warning, by value and by pair of values."""
import right_python  # noqa: F401  (first: it may hand over to another Python)
import itertools
from collections import Counter

import matplotlib.pyplot as plt
import numpy as np

from bendlab.results import registry
import style
from bendlab.results.load import group
from plain_cases import ALARM, AXES, CONFIGS, FOLDER, NOT_READ, SILENT, SOUND, TOLD, TWINS, judge
from report import Section, figure_main
from sweeps import load_experiment

COLOURS = {SILENT: "#c8402f", TOLD: "#f0bf4f", ALARM: "#6f8fc7", SOUND: "#dfe8e3"}
NAMES = {SILENT: "wrong without a warning", TOLD: "wrong with a warning",
         ALARM: "sound, but reported as implausible", SOUND: "sound"}
WRONG = (SILENT, TOLD)
MODELS_PICTURE = "fig_plain_models.png"  # for papers and the start page; the page has its matrix as HTML
MIXED = ("metres", "millimetres", "methods")  # covering arrays: their values are mixed evenly
PLACE = {"model": registry.model_place, "method": lambda name: registry.method_place(name.split(", ")[0])}
ORDER = {"mesh": ["grid, same", "grid, alternating", "grid, both", "equilateral, parallel",
                  "equilateral, perpendicular", "delaunay", "disc", "tube", "sphere"],
         "pins": ["none", "centre", "circle", "interior", "a corner", "corners", "an edge"],
         "height / width": ["0.25", "1", "4"],
         "start": ["flat", "tilted, thrown", "hanging, pushed", "turning"],
         "strain form": ["normalised", "green", "angle"],
         "substeps × iterations": ["1 × 1", "1 × 3", "1 × 10", "1 × 20", "1 × 100", "4 × 10", "8 × 1",
                                   "64 × 1"],
         "order": ["colour", "mesh", "pins", NOT_READ], "sweep": ["forward", "symmetric", NOT_READ],
         "precision": ["single", "double"]}
FEWEST = 4  # runs; a pair of values is listed if at least this many broke a bound
TWICE = 2.0  # and if they are at least this many times the number expected from its two values


def main(results, out):
    """Draws shares per value and per model and mesh. The section gets judged, covered and twins."""
    section = Section("What fails, and where", "plain")
    section.judged, section.covered, section.twins = [], [], Twins()
    for name in CONFIGS:
        experiment = load_experiment(results, f"{FOLDER}/{name}")
        runs = [run for run in section.uses(experiment) if run.over]
        section.judged += [judge(run, name) for run in runs]
        if "cover" in experiment.settings and runs:
            section.covered.append((name, len(runs), *coverage(experiment, runs)))
        if name in TWINS:
            section.twins.add(name, experiment, runs)
    mixed = [one for one in section.judged if one.config in MIXED]
    if mixed:
        section.pictures.append((_shares(mixed, out), _caption(mixed)))
        section.pictures.append((_models_and_meshes(mixed, out), "Runs that broke a bound, of all runs with "
                                 "this model on this mesh; darker is a larger share. A ring marks runs that "
                                 "were wrong without a warning."))
    return section


def coverage(experiment, runs):
    """(strength, combinations of values in the runs, all combinations, list of the missing ones)."""
    cover = experiment.settings["cover"]
    strength = cover if isinstance(cover, int) else cover["strength"]
    sweep = experiment.sweep
    places = [tuple(sweep[pointer].index(run.point[pointer]) for pointer in sweep) for run in runs]
    held, wanted, absent = 0, 0, []
    for axes in itertools.combinations(range(len(sweep)), strength):
        there = {tuple(place[axis] for axis in axes) for place in places}
        held += len(there)
        wanted += int(np.prod([len(list(sweep.values())[axis]) for axis in axes]))
        if wanted - held > len(absent):
            pointers = [list(sweep)[axis] for axis in axes]
            every = itertools.product(*(range(len(sweep[pointer])) for pointer in pointers))
            absent += [tuple((pointer, sweep[pointer][index]) for pointer, index in zip(pointers, point))
                       for point in every if point not in there]
    return strength, held, wanted, absent


class Twins:
    """Scenes computed in two units of length, and the distance of both runs after scaling."""

    def __init__(self):
        self.places, self.pairs, self.apart = {}, 0, []

    def add(self, name, experiment, runs):
        for run in runs:
            place = tuple(experiment.sweep[pointer].index(run.point[pointer])
                          for pointer in experiment.sweep)
            other = self.places.setdefault(place, {})
            other[name] = run
            if len(other) == 2 and same_stiffness(run):
                self._compare(*(other[twin] for twin in TWINS))

    def _compare(self, small, large):
        self.pairs += 1
        scale = small.get("/mesh/scale") / large.get("/mesh/scale")
        frames = min(small.frames, large.frames)
        apart = np.abs(small.trajectory()[:frames] / scale - large.trajectory()[:frames]).max() / large.size
        if not apart == 0:
            self.apart.append((float(apart), small, large))


def same_stiffness(run):
    """Whether both units state the same stiffness. A compliance scales differently for springs and hinges,
    and a config has one number for both: it is right for one kind only."""
    if run.get("/bending/stiffness") != "compliance" or run.model == "none":
        return True
    for_springs = run.get("/bending/compliance") * run.get("/mesh/scale") ** 2 < 1
    return registry.made_of(run.model) == ("springs" if for_springs else "hinges")


def count(judged, verdict):
    return sum(one.verdict == verdict for one in judged)


def _caption(judged):
    parts = ", ".join(f"{count(judged, verdict)} {NAMES[verdict]}"
                      for verdict in (SOUND, TOLD, SILENT, ALARM))
    return (f"{len(judged)} runs of the covering arrays: {parts}. A bar is the share of the runs with that "
            "value that broke a bound (red: without a warning; yellow: with one), or that were reported "
            "without breaking one (blue). Beside the bar: this share, and the number of runs with the value. "
            "In each array the values of all other settings are mixed evenly; that over methods has no "
            "stiffness as k.")


def values_of(judged, axis):
    """The values of an axis in the runs, in order."""
    return in_order(axis, {one.settings[axis] for one in judged})


def in_order(axis, values):
    """These values of an axis: models and methods as the program lists them, others in the order of ORDER and
    those that it lacks after them."""
    known = ORDER.get(axis, [])
    place = PLACE.get(axis, lambda value: known.index(value) if value in known else len(known))
    return sorted(sorted(values), key=place)


def _shares(judged, out):
    """Draws one panel per axis with one bar per value."""
    panels = [(axis, values_of(judged, axis)) for axis in AXES]
    columns = [[], [], []]
    # Longest first, each into the shortest column
    for panel in sorted(panels, key=lambda panel: -len(panel[1])):
        min(columns, key=lambda column: sum(len(values) + 2.2 for _, values in column)).append(panel)
    height = max(sum(len(values) + 2.2 for _, values in column) for column in columns)
    largest = max(sum(one.verdict != SOUND for one in some) / len(some)
                  for axis, _ in panels for some in group(judged, lambda one: one.settings[axis]).values())
    reach = max(1.12 * largest, 0.02)
    figure, all_axes = plt.subplots(1, 3, figsize=(9.6, 0.185 * height + 0.7), layout="constrained")
    for axes, column in zip(all_axes, columns):
        place = 0
        for axis, values in column:
            axes.text(0, place + 0.15, axis, fontsize=8.8, fontweight="bold", va="center")
            for value in values:
                place += 1
                some = [one for one in judged if one.settings[axis] == value]
                left = 0.0
                axes.barh(place, reach, height=0.78, color="#f4f6f7", lw=0)
                for verdict in (SILENT, TOLD, ALARM):
                    share = count(some, verdict) / len(some)
                    axes.barh(place, share, left=left, height=0.78, color=COLOURS[verdict], lw=0)
                    left += share
                axes.text(-0.02 * reach, place, _short(axis, value), ha="right", va="center", fontsize=8)
                axes.text(left + 0.015 * reach, place, f"{100 * left:.2g} % of {len(some)}" if left
                          else f"{len(some)}", va="center", fontsize=7, color=style.GREY if not left
                          else style.INK)
            place += 2.2
        axes.set_xlim(0, 1.3 * reach), axes.set_ylim(height - 0.8, -0.8)
        axes.set_axis_off()
    handles = [plt.Rectangle((0, 0), 1, 1, color=COLOURS[verdict]) for verdict in (SILENT, TOLD, ALARM)]
    figure.legend(handles, [NAMES[verdict] for verdict in (SILENT, TOLD, ALARM)], loc="upper center",
                  bbox_to_anchor=(0.5, 0), ncol=3)
    return style.save(figure, out, "fig_plain_shares")


def _short(axis, value):
    """Text of a value beside its bar."""
    if axis != "model":
        return str(value)
    return style.model_name(value)


def _models_and_meshes(judged, out):
    """Draws how many runs of each model on each mesh broke a bound."""
    models, meshes = values_of(judged, "model"), values_of(judged, "mesh")
    cells = group(judged, lambda one: (one.settings["model"], one.settings["mesh"]))
    share = np.array([[np.mean([one.verdict in WRONG for one in cells[model, mesh]]) if (model, mesh) in cells
                       else np.nan for model in models] for mesh in meshes])
    figure, axes = plt.subplots(figsize=(9.6, 0.36 * len(meshes) + 1.3), layout="constrained")
    axes.imshow(share, cmap="OrRd", vmin=0, vmax=max(0.3, np.nanmax(share)), aspect="auto")
    for row, column in itertools.product(range(len(meshes)), range(len(models))):
        some = cells.get((models[column], meshes[row]), [])
        wrong, silent = sum(one.verdict in WRONG for one in some), count(some, SILENT)
        dark = share[row, column] > 0.6 * max(0.3, np.nanmax(share))
        axes.text(column, row, f"{wrong}/{len(some)}" if some else "–", ha="center", va="center", fontsize=8,
                  color="white" if dark else style.INK if wrong else style.GREY,
                  bbox=dict(boxstyle="round,pad=0.25", fc="none", ec=COLOURS[SILENT], lw=1.3) if silent
                  else None)
    axes.set_xticks(range(len(models)), [_short("model", model) for model in models], rotation=35, ha="left")
    axes.xaxis.tick_top()
    axes.set_yticks(range(len(meshes)), meshes)
    axes.tick_params(length=0)
    axes.grid(False)
    for side in axes.spines.values():
        side.set_visible(False)
    return style.save(figure, out, MODELS_PICTURE.removesuffix(".png"))


def pairs(judged):
    """Pairs of values that break more bounds together than either alone, of runs as summary.json has them:
    (pair, wrong, runs, expected),
    strongest first."""
    wrong = [one for one in judged if one["verdict"] in WRONG]
    if not wrong:
        return []
    runs_of, wrong_of = Counter(), Counter()
    for counter, some in ((runs_of, judged), (wrong_of, wrong)):
        for one in some:
            counter.update(one["settings"].items())
            counter.update(itertools.combinations(one["settings"].items(), 2))
    found = []
    for pair, number in wrong_of.items():
        if not isinstance(pair[0], tuple) or number < FEWEST:
            continue
        alone = max(wrong_of[value] / runs_of[value] for value in pair)
        if number / runs_of[pair] >= TWICE * alone:
            found.append((pair, number, runs_of[pair], alone * runs_of[pair]))
    return sorted(found, key=lambda row: -row[1] / row[3])


if __name__ == "__main__":
    figure_main(main)
