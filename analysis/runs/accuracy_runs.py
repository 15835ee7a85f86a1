"""Data on the runs of configs/accuracy: id, config, command. A `run` here is an object in summary.json."""
from operator import itemgetter

from bendlab.results.load import group
from runs import repeat
from runs.collected import differing, flattened
from tables.numbers import number_text
from runs.sweeps import read_config, settings_at

PREFIX = "accuracy_"
ERRORS = {"error_physical_rms": "error from the stated cloth",
          "error_solver_rms": "error from its own equilibrium"}
# Name of a number of a run → (label, unit, meaning).
NUMBERS = {"ms_per_frame": ("CPU time per frame", "ms", "of the steps, for 1/60 s of cloth"),
           "memory_bytes": ("memory", "bytes", ""),
           **{name: (label, "1", "root mean square, relative to the diagonal of the rest box")
              for name, label in ERRORS.items()}}

STATED, OWN_REST = "the stated cloth", "the equilibrium of calibrated hinges on the same mesh"
OWN_MOTION = "the motion of calibrated hinges by Newton's method"
# Description of a cloth → (configs with this cloth, name of the error, reference of the error).
SCENES = {
    "hangs from two corners: gravity gives the shape": (
        "front front_slow front_work_slow beat paper paper_64 paper_cells_slow", "error_physical", STATED),
    "stands out from a clamp: bending holds it up": (
        "front_cantilever front_cantilever_slow front_cantilever_work_slow paper_cantilever",
        "error_physical", STATED),
    "drapes over a disc": ("front_drape_slow", "error_physical", STATED),
    "hangs from one pin": ("front_one_pin_slow", "error_physical", STATED),
    "hangs from two patches: solver methods compared": (
        "methods_slow methods_96_slow methods_192_slow", "error_solver", OWN_REST),
    "falls and swings from two patches: its motion": ("methods_motion_slow", "error_solver", OWN_MOTION)}


def config_of(run):
    """The name of the run's config below configs/."""
    return f"accuracy/{run['experiment'].removeprefix(PREFIX)}"


def work(run):
    """Substeps × iterations of a run, or the run's method if the run states no substeps."""
    solver = run["settings"]
    return f"{solver['substeps']} × {solver['iterations']}" if "substeps" in solver else solver["method"]


def front(runs, cost, error):
    """The front, cheapest first: the runs that are more accurate than all cheaper runs. `cost` and `error`:
    functions of a run."""
    best, kept = float("inf"), []
    for run in sorted(runs, key=lambda run: (cost(run), error(run))):
        if error(run) < best:
            best = error(run)
            kept.append(run)
    return kept


def candidates(runs):
    """[(run, scene, name of the error, reference of the error)] of the runs that can be an answer: the fronts
    of all runs of a scene with one model, one method and one number of cells."""
    chosen = []
    for text, (names, error, against) in SCENES.items():
        configs, rms = {f"accuracy/{name}" for name in names.split()}, itemgetter(f"{error}_rms")
        own = [run for run in runs if config_of(run) in configs and run["status"] == "complete"
               and run["point"] is not None and run.get("ms_per_frame")
               and isinstance(run.get(f"{error}_rms"), (int, float))]
        kind = lambda run: (run["model"], run["settings"]["method"], run["cells"])
        for series in group(own, kind).values():
            chosen += [(run, text, error, against) for run in front(series, itemgetter("ms_per_frame"), rms)]
    return chosen


def cheapest(chosen, scene, level):
    """A scene's fastest candidate with at most this error, or None; the reference must be exact enough."""
    near = [run for run, of, error, _ in chosen if of == scene and run[f"{error}_rms"] <= level
            and level >= (run.get(f"{error}_reference_gap") or 0)]
    return min(near, key=itemgetter("ms_per_frame"), default=None)


def scene(run):
    return run["experiment"].removeprefix(PREFIX).replace("_", " ")


def config_at(run):
    """The whole config of one run, as a file for `bendlab run`. If the run's point of the sweep was not
    recorded, only the settings that all runs of the sweep share."""
    settings = settings_at(read_config(config_of(run)), run["point"] or {})
    return {key: value for key, value in settings.items() if key not in ("sweep", "accuracy")}


def data(runs):
    configs = list(dict.fromkeys(map(config_of, runs)))
    first = {config_of(run): run for run in reversed(runs)}
    bases = [flattened(config_at(first[config])) for config in configs]
    summary = {name: {"label": label, "unit": unit, "meaning": meaning}
               for name, (label, unit, meaning) in NUMBERS.items()}
    return {"runs": [_about(run, configs.index(config_of(run)), bases) for run in runs],
            "settings": bases, "summary": summary}


def _about(run, place, bases):
    precision = run["settings"].get("precision", "double")
    known = {name: run[name] for name in NUMBERS if run.get(name) not in (None, "inf")}
    title = f"{run['model']}, {run['cells']} cells, {work(run)}, {precision} ({scene(run)})"
    return {"id": run["id"], "title": title, "status": run["status"], "worst": _worst(run, known),
            "command": command(run), "summary": known,
            "base": place, "changes": differing(bases[place], flattened(config_at(run)))}


def _worst(run, known):
    """The run's error, and the limit below which errors are not known."""
    name = next((name for name in ERRORS if name in known), None)
    if name is None:
        return {"label": "error", "text": "not known", "value": None}
    gap = run.get(name.replace("rms", "reference_gap"))
    return {"label": ERRORS[name], "value": 100 * run[name], "unit": "%",
            "note": f"errors below {number_text(100 * gap, 2)} % are not known" if gap else
            "the exactness of the reference is not known"}


def command(run):
    """The command that repeats the run, or the whole sweep if the run's point of the sweep is not known."""
    config = config_of(run)
    if run["point"] is None:
        return f"./bendlab run configs/{config}.json"
    return repeat.command(f"configs/{config}.json", run["point"], read_config(config)["sweep"])
