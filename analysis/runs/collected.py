"""Reads sweeps of runs, from a sweep file, a folder of results, a run's folder, or a run file.

The axes of a sweep come from its sweep file (`bendlab run` writes it), or from the points in run files.
"""
import json
import sys
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

from bendlab.results import registry
from bendlab.results.lock import is_locked
from bendlab.results.load import Indices, Run, group, load_run
from bendlab.results.meanings import Meanings
from runs.sweeps import file_in, is_number, point_key, settings_at


@dataclass
class Sweep:
    """Runs that belong together, including the missing runs."""

    name: str
    source: Path  # the file or folder that was read
    runs: list  # also runs without a readable file, whose Run.file is None
    axes: dict = field(default_factory=dict)  # JSON pointer → values
    settings: dict = field(default_factory=dict)  # the config as written, {} if it is not known
    config: str = ""  # path of the config, "" if it is not known
    overrides: list = field(default_factory=list)  # what `--set` and `--sweep` changed in it
    notes: list = field(default_factory=list)  # sentences on what was left out
    files: dict = field(default_factory=dict)  # run id → original file, if a copy was read
    folders: set = field(default_factory=set)  # of the runs that its sweep file lists

    @cached_property
    def meanings(self):
        """Units and meanings of the sweep's metrics and settings."""
        return Meanings(self.runs)

    @property
    def description(self):
        return self.settings.get("description", "")

    def file_of(self, run):
        """The path of the run's file for commands."""
        return self.files.get(run.id, run.file)


def collect(paths):
    """The sweeps of these paths, with each run once. Files and folders of runs that are side by side are one
    sweep. ValueError if a path has no runs, or if no run is readable."""
    sweeps, alone = [], []
    for path in {Path(path).resolve(): Path(path) for path in paths}.values():
        if file_in(path).is_file() or (path.is_file() and not path.name.endswith(".sweep.json")):
            alone.append(path if path.is_file() else file_in(path))
        else:
            sweeps += _at(path)
    for files in group(alone, lambda file: file.resolve().parents[1]).values():
        sweeps += _by_name(files[0].parent, map(_read, files))
    seen = set()
    for sweep in sorted(sweeps, key=lambda sweep: -len(sweep.runs)):  # a trial may share runs with its config
        sweep.runs = [run for run in sweep.runs if run.id not in seen]
        seen |= {run.id for run in sweep.runs}
    problems = [run.provenance.get("problem") for sweep in sweeps for run in sweep.runs]
    if all(problems):
        raise ValueError("; ".join(problems[:3]) or f"there are no runs in {paths[0]}")
    return [sweep for sweep in sweeps if sweep.runs]


def _at(path):
    if path.is_file():
        return [_of_file(path)]
    indices = Indices(path)
    files = sorted(path.glob("*.sweep.json"))
    if files:
        sweeps = [_of_file(file, indices) for file in files]
        _note_unlisted(path, sweeps)
        indices.write()
        return sweeps
    runs = [_read(file, indices) for file in _run_files(path)]
    indices.write()
    if not runs:
        raise ValueError(f"there are no runs in {path}")
    return _by_name(path, runs)


def _by_name(source, runs):
    return [_of_runs(source, same_name) for same_name in group(runs, lambda run: run.name).values()]


def _run_files(folder):
    """One file of every run below the folder: the finished file, or else the newest unfinished file. Without
    reference runs, except in a folder of references."""
    folders = {file.parent for file in folder.glob("**/run.vtkhdf*") if file.suffix in (".vtkhdf", ".part")
               and "references" not in file.relative_to(folder).parts[:-1]}
    return [file_in(below) for below in sorted(folders)]


def _of_file(file, indices=None):
    """The sweep of a sweep file, with its runs. ValueError if the file is no sweep file."""
    indices = indices or Indices(file.parent)
    try:
        data = json.loads(file.read_text(encoding="utf-8"))
        registry.learn(data["models"], data.get("methods", {}))
        sweep = Sweep(data["experiment"], file, [], data["axes"],
                      data["settings"] | {"expect": data.get("expect", [])}, data["config"],
                      data["overrides"], folders={file.parent / entry["folder"] for entry in data["runs"]})
    except OSError as error:
        raise ValueError(f"{file} cannot be read: {error.strerror}") from None
    except (ValueError, KeyError, TypeError, AttributeError):
        raise ValueError(f"{file} is not a sweep file: it is not JSON, or lacks entries that 'bendlab run' "
                         "writes. Delete the file, or run its config again") from None
    for number, entry in enumerate(data["runs"]):
        folder = file.parent / entry["folder"]
        status = "missing" if not folder.is_dir() else "running" if is_locked(folder) else "failed"
        path = file_in(folder)
        run = _read(path, indices) if path.exists() else None
        if run and run.file and run.id != entry["id"]:
            sweep.notes.append(f"{path} is left out, because the file belongs to another run, {run.id}")
            run, status = None, "missing"
        if not run or not run.frames:
            status, why = (run.status, run.provenance) if run and not run.file else (status, {})
            run = Run(None, entry["id"] or f"missing-{number}", sweep.name, status,
                      settings_at(sweep.settings, entry["point"]), provenance=why)
        run.point = entry["point"]
        sweep.runs.append(run)
    return sweep


def _read(path, indices=None):
    """The run in a file; a Run with the status "running" or "unreadable" if the file cannot be read."""
    try:
        return indices.run(str(path)) if indices else load_run(path)
    except BlockingIOError:  # its program is writing it
        status, why = "running", {}
    except (OSError, KeyError, ValueError) as error:
        reason = getattr(error, "strerror", None)
        status, why = "unreadable", {"problem": f"{path} cannot be read: {reason}" if reason else str(error)}
    name = path.resolve().parents[1].name
    return Run(None, f"{status}-{path.parent.name}-{path.name}", name, status, provenance=why)


def _of_runs(source, runs):
    """The sweep of runs without a sweep file. The axes are the settings of the points in the run files;
    without points, the fewest settings by which the runs differ."""
    if len(runs) > 1 and not any(run.point for run in runs):
        _find_places(runs)
    found = {}
    for run in runs:
        for pointer, value in run.point.items():
            found.setdefault(pointer, {}).setdefault(point_key(value), value)
    axes = {pointer: list(values.values()) for pointer, values in found.items()}
    axes |= {pointer: sorted(values) for pointer, values in axes.items() if all(map(is_number, values))}
    return Sweep(runs[0].name, source, runs, axes)


WITHOUT_FILE = ("missing", "running", "failed", "unreadable")  # the config is then as it is written
FIRST = ["/bending/model", "/mesh/cells", "/solver/method", "/solver/substeps", "/solver/iterations",
         "/solver/dt"]


def _find_places(runs):
    """Gives points to runs whose files state no points: the settings of separating()."""
    chosen = separating(runs)
    for run in runs:
        own = flattened(run.config)
        run.point = {pointer: own[pointer] for pointer in chosen if pointer in own}


def separating(runs):
    """The settings by which the runs differ, usual settings first. A setting is left out if the settings
    before it already separate the same runs."""
    flat = {run.id: flattened(run.config) for run in runs if run.status not in WITHOUT_FILE}
    texts = {pointer: {id: json.dumps(config.get(pointer)) for id, config in flat.items()}
             for pointer in dict.fromkeys(pointer for config in flat.values() for pointer in config)}
    rank = lambda pointer: (FIRST.index(pointer) if pointer in FIRST else len(FIRST),
                            pointer.endswith("/seed"), pointer)
    groups, chosen = {id: () for id in flat}, []  # id → values of the chosen settings
    for pointer in sorted((p for p, values in texts.items() if len(set(values.values())) > 1), key=rank):
        finer = {id: (*known, texts[pointer][id]) for id, known in groups.items()}
        if len(set(finer.values())) > len(set(groups.values())):
            groups = finer
            chosen.append(pointer)
    return chosen


def flattened(value, pointer=""):
    """JSON pointer → value, for values in nested objects and lists; lists of numbers and texts stay whole."""
    if isinstance(value, dict) and value:
        inner = value.items()
    elif isinstance(value, list) and any(isinstance(entry, (dict, list)) for entry in value):
        inner = enumerate(value)
    else:
        return {pointer: value}
    return {key: entry for name, below in inner
            for key, entry in flattened(below, f"{pointer}/{name}").items()}


def stated(settings, point):
    """JSON pointer → value of the settings in a config as it is written, at a point of its sweep."""
    whole = settings_at(settings, point)
    return flattened({key: value for key, value in whole.items() if key not in ("sweep", "description")})


def differing(base, own):
    """Pointer → [value] of settings that differ from `base`, → None of settings that only `base` has."""
    changed = {pointer: [value] for pointer, value in own.items()
               if pointer not in base or json.dumps(base[pointer]) != json.dumps(value)}
    return changed | {pointer: None for pointer in base if pointer not in own}


def _note_unlisted(folder, sweeps):
    """Adds a note: how many runs in the folder are in no sweep file."""
    known = set().union(*(sweep.folders for sweep in sweeps))
    unlisted = [file for file in _run_files(folder) if file.parent not in known]
    if unlisted:
        count = "1 run" if len(unlisted) == 1 else f"{len(unlisted)} runs"
        largest = max(sweeps, key=lambda sweep: len(sweep.runs))
        largest.notes.append(f"Left out of {folder}: {count} that no sweep file lists, for example "
                             f"{unlisted[0].parent.name}")


def tell(text):
    print(f"bendlab: {text}", file=sys.stderr, flush=True)
