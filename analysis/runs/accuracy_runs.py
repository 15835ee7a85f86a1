"""Data on the runs of configs/accuracy: id, config, command. A `run` here is an object in summary.json."""
from bendlab.results.load import group
from runs import repeat
from runs.collected import differing, flattened
from tables.numbers import number_text
from runs.sweeps import read_config, settings_at

PREFIX = "accuracy_"
ERRORS = {"error_physical_rms": "error from the stated cloth",
          "error_solver_rms": "error from its own equilibrium"}
NUMBERS = {"ms_per_frame": ("CPU time per frame", "ms", "of the steps, for 1/60 s of cloth"),
           "memory_bytes": ("memory", "bytes", "")}

STATED, OWN_REST = "the stated cloth", "the equilibrium of calibrated hinges on the same mesh"
OWN_MOTION = "the motion of calibrated hinges by Newton's method"
# Description of a cloth → (experiments with this cloth, name of the error, reference of the error).
SCENES = {
    "hangs from two corners: gravity gives the shape": ((
        "accuracy_front", "accuracy_front_slow", "accuracy_front_work_slow", "accuracy_beat",
        "accuracy_paper", "accuracy_paper_64", "accuracy_paper_cells_slow"), "error_physical", STATED),
    "stands out from a clamp: bending holds it up": ((
        "accuracy_front_cantilever", "accuracy_front_cantilever_slow", "accuracy_front_cantilever_work_slow",
        "accuracy_paper_cantilever"), "error_physical", STATED),
    "drapes over a disc": (("accuracy_front_drape_slow",), "error_physical", STATED),
    "hangs from one pin": (("accuracy_front_one_pin_slow",), "error_physical", STATED),
    "hangs from two patches: solver methods compared": ((
        "accuracy_methods_slow", "accuracy_methods_96_slow", "accuracy_methods_192_slow"), "error_solver",
                                                        OWN_REST),
    "falls and swings from two patches: its motion": (("accuracy_methods_motion_slow",), "error_solver",
                                                      OWN_MOTION)}


def config_of(run):
    """The name of the run's config below configs/."""
    return f"accuracy/{run['experiment'].removeprefix(PREFIX)}"


def work(run):
    """Substeps × iterations of a run, or the run's method if the run states no substeps."""
    solver = run["settings"]
    return f"{solver['substeps']} × {solver['iterations']}" if "substeps" in solver else solver["method"]


def front(runs, error):
    """The front, fastest first: the runs that are more accurate than all faster runs. `error`: its name."""
    best, kept = float("inf"), []
    known = [run for run in runs if isinstance(run.get(error), (int, float)) and run.get("ms_per_frame")]
    for run in sorted(known, key=lambda run: (run["ms_per_frame"], run[error])):
        if run[error] < best:
            best = run[error]
            kept.append(run)
    return kept


def candidates(runs):
    """[(run, scene, name of the error, reference of the error)] of the runs that can be an answer: the fronts
    of all runs of a scene with one model, one method and one number of cells."""
    chosen = []
    for scene, (names, error, against) in SCENES.items():
        own = [run for run in runs if run["experiment"] in names and run["status"] == "complete"
               and run["point"] is not None]
        kind = lambda run: (run["model"], run["settings"]["method"], run["cells"])
        for series in group(own, kind).values():
            chosen += [(run, scene, error, against) for run in front(series, f"{error}_rms")]
    return chosen


def cheapest(chosen, scene, level):
    """A scene's fastest candidate with at most this error, or None; the reference must be exact enough."""
    near = [run for run, of, error, _ in chosen if of == scene and run[f"{error}_rms"] <= level
            and level >= (run.get(f"{error}_reference_gap") or 0)]
    return min(near, key=lambda run: run["ms_per_frame"], default=None)


def title(run):
    precision = run["settings"].get("precision", "double")
    return f"{run['model']}, {run['cells']} cells, {work(run)}, {precision} ({scene(run)})"


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
    names = NUMBERS | {name: (text, "1", "root mean square, relative to the diagonal of the rest box")
                       for name, text in ERRORS.items()}
    keys = ("label", "unit", "meaning")
    summary = {name: dict(zip(keys, description)) for name, description in names.items()}
    return {"runs": [_about(run, configs.index(config_of(run)), bases, names) for run in runs],
            "settings": bases, "summary": summary}


def _about(run, place, bases, names):
    return {"id": run["id"], "title": title(run), "status": run["status"], "worst": worst(run),
            "command": command(run), "summary": {name: run[name] for name in names
                                                 if run.get(name) not in (None, "inf")},
            "base": place, "changes": differing(bases[place], flattened(config_at(run)))}


def worst(run):
    """The run's error, and the limit below which errors are not known."""
    name = next((name for name in ERRORS if run.get(name) not in (None, "inf")), None)
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
