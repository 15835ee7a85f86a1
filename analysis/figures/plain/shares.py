"""The plain matrix (simple scenes): runs that broke a bound, by value and by pair of values of settings."""
import itertools
from collections import Counter

import numpy as np

from bendlab.results import registry
from bendlab.results.load import group
from runs.plain_cases import (ALARM, AXES, CONFIGS, FOLDER, NOT_READ, SILENT, SOUND, TOLD, TWINS, judge,
                              settings_of)
from runs.sweeps import load_experiment
from tables.chart import Chart
from tables.numbers import number, rounded
from tables.table import Table

NAMES = {SILENT: "wrong without a warning", TOLD: "wrong with a warning",
         ALARM: "sound, but reported as implausible", SOUND: "sound"}
WRONG = (SILENT, TOLD)
MIXED = ("metres", "millimetres", "methods")  # covering arrays: runs that mix all values evenly
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
FEWEST = 4  # runs; a pair of values is listed if at least this number broke a bound
TWICE = 2.0  # and at least this many times the number expected from the worse value alone


def main(results, out, section):
    """Judges every run, and stores the runs as JSON objects in the section's data."""
    judged, covered, twins = [], [], Twins()
    for name in CONFIGS:
        experiment = load_experiment(results, f"{FOLDER}/{name}")
        runs = [run for run in section.uses(experiment) if run.over]
        judged += [judge(run, name) for run in runs]
        if "cover" in experiment.settings and runs:
            covered.append(covered_text(name, len(runs), *coverage(experiment, runs)))
        if name in TWINS:
            twins.add(name, experiment, runs)
    section.text = " ".join(filter(None, [*covered, twins.text]))
    section.data = [rounded(entry.as_json()) | {"id": f"{entry.config}-{number}"}
                    for number, entry in enumerate(judged)]
    mixed = [entry for entry in section.data if entry["config"] in MIXED]
    rows = [{"setting": axis, "value": str(value), "runs": [entry["id"] for entry in wrong],
             "number": len(with_value),
             "what": NAMES[verdict], "share": 100 * len(wrong) / len(with_value)}
            for axis in AXES for value, with_value in by_value(mixed, axis).items()
            for verdict in (SILENT, TOLD, ALARM)
            if (wrong := [entry for entry in with_value if entry["verdict"] == verdict])
            or verdict == TOLD]
    section.tables.append(Table.of("shares", "Runs that broke a bound, by value of a setting", [
        "setting", "value", "what", ("share", "share of the runs with that value", ".2f", "%"),
        ("number", "runs with that value")], rows))
    section.charts.append(Chart(
        "shares", "Which settings break bounds", "shares", "value", ["share"], ["what"], held=["setting"],
        at="model", scale="band",
        y_scale="linear", look="", note=f"{len(mixed)} runs of the covering arrays, which mix the values of "
                                        "all settings evenly: "
        + ", ".join(f"{sum(entry['verdict'] == verdict for entry in mixed)} {NAMES[verdict]}"
                    for verdict in (SOUND, TOLD, SILENT, ALARM))
        + ". The array over methods has no stiffness given as k."))


def by_value(judged, axis):
    """Value of an axis → runs with this value; in_order() sorts the values."""
    runs_of = group(judged, lambda run: run["settings"][axis])
    return {value: runs_of[value] for value in in_order(axis, set(runs_of))}


def covered_text(name, runs, strength, held, wanted, absent):
    """A sentence: how many of the wanted combinations of values these runs have, counted here."""
    text = f"{name}: {runs} runs have {held} of {wanted} combinations of values of {strength} settings"
    unknown = [combination for combination in absent if not refused(combination)]
    if len(absent) > len(unknown):
        text += (f"; the program refuses {len(absent) - len(unknown)} combinations (a tube needs at least "
                 "three cells around its axis; springs have a known rigidity on flat sheets only)")
    if unknown:
        text += (f"; {len(unknown)} are missing, first "
                 + ", ".join(f"{pointer} {value}" for pointer, value in unknown[0]))
    return f"{text}."


def refused(combination):
    """Whether the program refuses this combination of values; lib/bendlab/scene/rules.cpp has the reasons."""
    values = dict(combination)
    generator = values.get("/mesh", {}).get("generator")
    return ((generator == "tube" and values.get("/mesh/cells") == 2)
            or (generator in ("tube", "sphere") and values.get("/bending", {}).get("stiffness") == "physical"
                and registry.made_of(values.get("/bending/model")) == "springs"))


def coverage(experiment, runs):
    """(settings per combination, combinations in the runs, all combinations, list of missing
    combinations)."""
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
    """Pairs of runs of one scene in two units of length, and the distance of each pair after scaling."""

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

    @property
    def text(self):
        if not self.pairs:
            return ""
        text = f"{self.pairs} scenes were computed in two units of length, 1 : 1024. "
        if not self.apart:
            return text + "After scaling, both runs of each scene are equal to the last bit."
        apart, _, large = max(self.apart, key=lambda entry: entry[0])
        settings = ", ".join(f"{name} {value}" for name, value in settings_of(large.config).items())
        return text + (f"After scaling, the two runs of {len(self.apart)} scenes differ, by up to "
                       f"{number(apart)} sizes ({settings}).")


def same_stiffness(run):
    """Whether the run has the same stiffness in both units. Compliances of springs and of hinges scale
    differently, but a config has one compliance: the value is right for springs or for hinges."""
    if run.get("/bending/stiffness") != "compliance" or run.model == "none":
        return True
    for_springs = run.get("/bending/compliance") * run.get("/mesh/scale") ** 2 < 1
    return registry.made_of(run.model) == ("springs" if for_springs else "hinges")


def in_order(axis, values):
    """The values of an axis, sorted: models and methods in the program's order, other values as in ORDER.
    Values that are not in ORDER come last."""
    known = ORDER.get(axis, [])
    place = PLACE.get(axis, lambda value: known.index(value) if value in known else len(known))
    return sorted(sorted(values), key=place)


def pairs(judged):
    """Pairs of values that break more bounds together than each value alone, strongest first: (pair, number
    of runs that broke a bound, number of runs, expected first number). `judged`: as in summary.json."""
    wrong = [run for run in judged if run["verdict"] in WRONG]
    if not wrong:
        return []
    runs_of, wrong_of = Counter(), Counter()
    for counter, runs in ((runs_of, judged), (wrong_of, wrong)):
        for run in runs:
            counter.update(run["settings"].items())
            counter.update(itertools.combinations(run["settings"].items(), 2))
    failing = []
    for pair, count in wrong_of.items():
        if not isinstance(pair[0], tuple) or count < FEWEST:
            continue
        alone = max(wrong_of[value] / runs_of[value] for value in pair)
        if count / runs_of[pair] >= TWICE * alone:
            failing.append((pair, count, runs_of[pair], alone * runs_of[pair]))
    return sorted(failing, key=lambda row: -row[1] / row[3])
