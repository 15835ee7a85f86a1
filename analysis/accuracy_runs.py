"""What pages say of a run of configs/accuracy: its address, config and command. A run is its object in
summary.json."""
from collections import Counter

import repeat
from collected import flattened
from html_parts import number_text
from run_facts import differing
from sweeps import read_config, settings_at

PREFIX = "accuracy_"
ERRORS = {"error_physical_rms": "error from the stated cloth",
          "error_solver_rms": "error from its own equilibrium"}
NUMBERS = {"ms_per_frame": ("CPU time per frame", "ms", "of the steps, for 1/60 s of cloth"),
           "memory_bytes": ("memory", "bytes", "")}


def config_of(run):
    """The name of its config below configs/."""
    return f"accuracy/{run['experiment'].removeprefix(PREFIX)}"


def with_ids(runs):
    """The runs with an id each, as addresses have it: front.adaptive.24.16x4."""
    seen, found = Counter(), []
    for run in runs:
        name = (f"{run['experiment'].removeprefix(PREFIX)}.{run['model']}.{run['cells']}."
                f"{work(run).replace(' × ', 'x')}")
        seen[name] += 1
        found.append(run | {"id": name + (f".{seen[name]}" if seen[name] > 1 else "")})
    return found


def work(run):
    """Its substeps × iterations, or its method if that has none."""
    solver = run["settings"]
    return f"{solver['substeps']} × {solver['iterations']}" if "substeps" in solver else solver["method"]


def title(run):
    precision = run["settings"].get("precision", "double")
    return f"{run['model']}, {run['cells']} cells, {work(run)}, {precision} ({scene(run)})"


def scene(run):
    """Its config's name as words."""
    return run["experiment"].removeprefix(PREFIX).replace("_", " ")


def config_at(run):
    """The config of one run as it is stated: a whole file for `bendlab run`. Of a run whose place on the
    sweep was not written down, what its whole sweep has in common."""
    settings = settings_at(read_config(config_of(run)), run["point"] or {})
    return {key: value for key, value in settings.items() if key not in ("sweep", "accuracy")}


def data(runs):
    """What the page's scripts read of the runs."""
    configs = list(dict.fromkeys(map(config_of, runs)))
    first = {config_of(run): run for run in reversed(runs)}
    bases = [flattened(config_at(first[config])) for config in configs]
    names = NUMBERS | {name: (text, "1", "root mean square, in diagonals of the rest box")
                       for name, text in ERRORS.items()}
    summary = {name: dict(zip(("label", "unit", "meaning"), told)) for name, told in names.items()}
    return {"runs": [_about(run, configs.index(config_of(run)), bases, names) for run in runs],
            "settings": bases, "summary": summary}


def _about(run, place, bases, names):
    return {"id": run["id"], "title": title(run), "status": run["status"], "worst": worst(run),
            "command": command(run), "summary": {name: run[name] for name in names
                                                 if run.get(name) not in (None, "inf")},
            "base": place, "changes": differing(bases[place], flattened(config_at(run)))}


def worst(run):
    """Its error, and below which errors are not known."""
    name = next((name for name in ERRORS if run.get(name) not in (None, "inf")), None)
    if name is None:
        return {"label": "error", "text": "not known", "value": None}
    gap = run.get(name.replace("rms", "reference_gap"))
    return {"label": ERRORS[name], "value": 100 * run[name], "unit": "%",
            "note": f"errors below {number_text(100 * gap, 2)} % are not known" if gap else
            "no bound is stated for it"}


def command(run):
    """The one line that computes the run again; with its whole sweep if its place on it is not known."""
    config = config_of(run)
    if run["point"] is None:
        return f"./bendlab run configs/{config}.json"
    return repeat.command(f"configs/{config}.json", run["point"], read_config(config)["sweep"])
