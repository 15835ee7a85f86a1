"""The plain matrix (simple scenes): runs that broke a bound, by value and by pair of values of settings."""
import itertools
from collections import Counter

import numpy as np

from bendlab.results import registry
from bendlab.results.load import group
from runs.plain_cases import (ALARM, AXES, CONFIGS, FOLDER, NOT_READ, SILENT, SOUND, WARNED, TWINS, judge,
                              settings_of)
from runs.sweeps import load_experiment
from tables.numbers import number, rounded
from tables.table import Table

NAMES = {SILENT: "wrong without a warning", WARNED: "wrong with a warning",
         ALARM: "sound, but reported as implausible", SOUND: "sound"}
WRONG = (SILENT, WARNED)
# Covering arrays: their runs mix all values evenly.
MIXED = ("metres", "millimetres", "methods", "fabrics", "fabrics_map")
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
    judged, covered, runs_at = [], [], {}  # runs_at: config → place on the axes → run
    for name in CONFIGS:
        experiment = load_experiment(results, f"{FOLDER}/{name}")
        runs = [run for run in section.uses(experiment) if run.over]
        judged += [judge(run, name) for run in runs]
        runs_at[name] = {place_of(experiment, run): run for run in runs}
        if "cover" in experiment.settings and runs:
            covered.append(covered_text(name, experiment, runs))
    small, large = (runs_at[name] for name in TWINS)
    twins = twins_text([(small[place], run) for place, run in large.items() if place in small])
    section.text = " ".join(filter(None, [*covered, twins]))
    section.data = [rounded(run) | {"id": f"{run['config']}-{place}"} for place, run in enumerate(judged)]
    mixed = [entry for entry in section.data if entry["config"] in MIXED]
    rows = []
    for axis in AXES:
        runs_of = group(comparable(mixed, axis), lambda entry: entry["settings"][axis])
        for value, verdict in itertools.product(in_order(axis, runs_of), (SILENT, WARNED, ALARM)):
            count = len(runs_of[value])
            wrong = [entry["id"] for entry in runs_of[value] if entry["verdict"] == verdict]
            if wrong or verdict == WARNED:
                rows.append({"setting": axis, "value": str(value), "runs": wrong, "number": count,
                             "what": NAMES[verdict], "share": 100 * len(wrong) / count})
    verdicts = Counter(entry["verdict"] for entry in mixed)
    counts = ", ".join(f"{verdicts[verdict]} {NAMES[verdict]}" for verdict in (SOUND, WARNED, SILENT, ALARM))
    section.add_chart(
        Table.of("shares", "Runs that broke a bound, by value of a setting", [
            "setting", "value", "what", ("share", "share of the runs with that value", ".2f", "%"),
            ("number", "runs with that value")], rows),
        "Which settings break bounds", "value", ["share"], ["what"], held=["setting"], at="model",
        scale="band", y_scale="linear", look="",
        note=f"{len(mixed)} runs of the covering arrays, which mix the values of all settings evenly: "
             f"{counts}. Each chart counts the arrays that vary its setting.")


def comparable(entries, axis):
    """The entries of configs that vary this axis: other configs differ in more than this setting."""
    varying = [own for own in group(entries, lambda entry: entry["config"]).values()
               if len({entry["settings"][axis] for entry in own}) > 1]
    return list(itertools.chain(*varying))


def place_of(experiment, run):
    """The place of a run on the axes of its sweep: an index for each axis."""
    return tuple(values.index(run.point[pointer]) for pointer, values in experiment.sweep.items())


def covered_text(name, experiment, runs):
    """A sentence: how many of the wanted combinations of values these runs have, counted here."""
    strength, held, absent = coverage(experiment, runs)
    text = (f"{name}: {len(runs)} runs have {held} of {held + len(absent)} combinations of values of "
            f"{strength} settings")
    unknown = [combination for combination in absent if not refused(combination)]
    if len(absent) > len(unknown):
        text += (f"; the program refuses {len(absent) - len(unknown)} combinations (a tube needs at least "
                 "three cells around its axis; springs have a known rigidity on flat sheets only)")
    if unknown:
        first = ", ".join(f"{pointer} {value}" for pointer, value in unknown[0].items())
        text += f"; {len(unknown)} are missing, first {first}"
    return f"{text}."


def refused(values):
    """Whether the program refuses these values (pointer → value). lib/bendlab/scene/rules.cpp says why."""
    generator = values.get("/mesh", {}).get("generator")
    return ((generator == "tube" and values.get("/mesh/cells") == 2)
            or (generator in ("tube", "sphere") and values.get("/bending", {}).get("stiffness") == "physical"
                and registry.made_of(values.get("/bending/model")) == "springs"))


def coverage(experiment, runs):
    """(settings per combination, number of combinations in the runs, list of missing combinations)."""
    cover, sweep = experiment.settings["cover"], experiment.sweep
    strength = cover if isinstance(cover, int) else cover["strength"]
    places = [place_of(experiment, run) for run in runs]
    held, absent = 0, []
    for axes in itertools.combinations(enumerate(sweep), strength):
        there = {tuple(place[axis] for axis, _ in axes) for place in places}
        held += len(there)
        absent += [{pointer: sweep[pointer][index] for (_, pointer), index in zip(axes, point)}
                   for point in itertools.product(*(range(len(sweep[pointer])) for _, pointer in axes))
                   if point not in there]
    return strength, held, absent


def twins_text(pairs):
    """Text: how far the runs of one scene in two units of length are apart after scaling."""
    compared = [(distance(small, large), large) for small, large in pairs if same_stiffness(large)]
    if not compared:
        return ""
    text = f"{len(compared)} scenes were computed in two units of length, 1 : 1024. "
    differing = [(apart, large) for apart, large in compared if apart != 0]
    if not differing:
        return text + "After scaling, both runs of each scene are equal to the last bit."
    apart, large = max(differing, key=lambda pair: pair[0])
    settings = ", ".join(f"{name} {value}" for name, value in settings_of(large.config).items())
    return text + (f"After scaling, the two runs of {len(differing)} scenes differ, by up to {number(apart)} "
                   f"sizes ({settings}).")


def distance(small, large):
    """The largest distance of a vertex of two runs after scaling, in sizes."""
    scale = small.get("/mesh/scale") / large.get("/mesh/scale")
    frames = min(small.frames, large.frames)
    return np.abs(small.trajectory()[:frames] / scale - large.trajectory()[:frames]).max() / large.size


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
    counted = lambda runs: Counter(values for run in runs for size in (1, 2)
                                   for values in itertools.combinations(run["settings"].items(), size))
    runs_of, wrong_of = counted(judged), counted(run for run in judged if run["verdict"] in WRONG)
    failing = []
    for pair, count in wrong_of.items():
        alone = max(wrong_of[value,] / runs_of[value,] for value in pair)
        if len(pair) == 2 and count >= FEWEST and count / runs_of[pair] >= TWICE * alone:
            failing.append((pair, count, runs_of[pair], alone * runs_of[pair]))
    return sorted(failing, key=lambda row: -row[1] / row[3])
