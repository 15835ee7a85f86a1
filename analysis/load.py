"""The only reader of run files. Layout: lib/bendlab/io/run_file.hpp.

A run file is open only while something is read from it, so that hundreds of runs can be listed at once.
Shapes: V vertices, T triangles, F committed frames. Lengths in m, times in s.
"""
import itertools
import json
import re
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

import h5py
import numpy as np


def _text(value):
    if isinstance(value, np.ndarray):
        value = value.reshape(-1)[0]
    return value.decode() if isinstance(value, bytes) else str(value)


class Metrics(Mapping):
    """Name → (F) array of a run file. Each array is read on first use."""

    def __init__(self, path, names, frames):
        self._path, self._frames, self._found = path, frames, dict.fromkeys(names)

    def __getitem__(self, name):
        if self._found[name] is None:
            with h5py.File(self._path, "r") as file:
                self._found[name] = file[f"metrics/{name}"][:self._frames]
        return self._found[name]

    def __iter__(self):
        return iter(self._found)

    def __len__(self):
        return len(self._found)


@dataclass
class Run:
    """One run. Small data are read at once, metrics and frames on demand."""

    file: Path
    id: str
    name: str
    status: str  # complete | implausible | diverged | interrupted
    config: dict
    summary: dict  # name → number
    metrics: Mapping  # name → (F) array, `time` among them
    wall_s: float = 0.0
    step_cpu_s: float = 0.0  # steps only, without set-up and recording
    cpu_s: float = 0.0
    passes: dict = field(default_factory=dict)  # pass → seconds
    counts: dict = field(default_factory=dict)  # kind of constraint → how many
    source_hash: str = ""  # identifies the program that wrote the run

    def get(self, pointer, default=None):
        """Value of the resolved config at a JSON pointer."""
        return at(self.config, pointer, default)

    @property
    def model(self):
        return self.get("/bending/model")

    @property
    def frames(self):
        return len(self.metrics["time"])

    @property
    def complete(self):
        """Whether all frames are there. An implausible run is complete: figures show it."""
        return self.status in ("complete", "implausible")

    @property
    def over(self):
        """Whether repeating the run would give the same end."""
        return self.complete or self.status == "diverged"

    def frame_index(self, frame):
        """Frame number from 0; a negative `frame` counts from the end. IndexError if there is none."""
        index = frame + self.frames if frame < 0 else frame
        if not 0 <= index < self.frames:
            raise IndexError(f"{self.file} has {self.frames} frames, no frame {frame}")
        return index

    def last_second(self):
        """Frame numbers within the last simulated second."""
        time = self.metrics["time"]
        return np.flatnonzero(time >= time[-1] - 1 - 1e-9) if len(time) else np.array([], int)

    def positions(self, frame=-1):
        """(V, 3) positions of a frame, float64."""
        index = self.frame_index(frame)
        with h5py.File(self.file, "r") as file:
            count = len(file["rest/positions"])
            return file["VTKHDF/Points"][index * count:(index + 1) * count].astype(float)

    def trajectory(self):
        """(F, V, 3) positions of all frames, float64."""
        with h5py.File(self.file, "r") as file:
            count = len(file["rest/positions"])
            return file["VTKHDF/Points"][:self.frames * count].reshape(self.frames, count, 3).astype(float)

    def cell(self, name, frame=-1):
        """(T) values of a cell field of a frame."""
        index = self.frame_index(frame)
        with h5py.File(self.file, "r") as file:
            count = len(file["rest/triangles"])
            return file[f"VTKHDF/CellData/{name}"][index * count:(index + 1) * count].astype(float)

    def _rest(self, name):
        with h5py.File(self.file, "r") as file:
            return file[f"rest/{name}"][()]

    @property
    def rest_positions(self):
        """(V, 3)"""
        return self._rest("positions").reshape(-1, 3).astype(float)

    @property
    def triangles(self):
        """(T, 3)"""
        return self._rest("triangles").reshape(-1, 3).astype(int)

    @property
    def pinned(self):
        """(V) bool"""
        return self._rest("pinned").astype(bool)

    @property
    def pin_seeds(self):
        """Vertices that the config names as pins, without the rings around them."""
        return self._rest("pin_seeds").astype(int)

    @property
    def size(self):
        """Diagonal of the rest box."""
        return float(np.linalg.norm(np.ptp(self.rest_positions, axis=0)))

    def constraints(self, kind):
        """(C, n) vertices of every constraint of a kind. KeyError if the run did not record them."""
        with h5py.File(self.file, "r") as file:
            name = f"constraints/{kind}/vertices"
            if name not in file:
                raise KeyError(f"{self.file} has no {name}: run it with /output/constraints true")
            vertices = file[name][()].astype(int)
        return vertices if vertices.ndim == 2 else vertices.reshape(-1, 2)


def at(config, pointer, default=None):
    """Value at a JSON pointer in nested dicts and lists, `default` if there is none."""
    node = config
    for key in pointer.split("/")[1:]:
        if isinstance(node, list) and key.isdigit() and int(key) < len(node):
            node = node[int(key)]
        elif isinstance(node, dict) and key in node:
            node = node[key]
        else:
            return default
    return node


def load_run(path):
    """One run from its file, finished or not (`.part`). OSError: not readable; KeyError: no run."""
    path = Path(path)
    with h5py.File(path, "r") as file:
        frames = len(file["metrics/time"])
        group = lambda name: file[name] if name in file else {}
        attributes = lambda name: file[name].attrs if name in file else {}
        timing = group("timing")
        passes = {}
        if "pass" in timing:
            passes = dict(zip(map(_text, timing["pass"][()]), map(float, timing["seconds"][()])))
        status = _text(file.attrs["status"])
        return Run(
            file=path,
            id=_text(file.attrs["id"]),
            name=_text(file.attrs["name"]),
            status="interrupted" if status == "running" else status,
            config=json.loads(_text(file["provenance/config"][()])),
            summary={name: float(np.ravel(value)[0]) for name, value in attributes("summary").items()},
            metrics=Metrics(path, file["metrics"], frames),
            wall_s=float(np.ravel(attributes("timing").get("wall_s", 0))[0]),
            step_cpu_s=float(np.ravel(attributes("timing").get("step_cpu_s", 0))[0]),
            cpu_s=float(np.ravel(attributes("timing").get("cpu_s", 0))[0]),
            passes=passes,
            source_hash=_text(attributes("provenance").get("source_hash", "")),
            counts={kind: int(np.ravel(data.attrs["count"])[0])
                    for kind, data in group("constraints").items()},
        )


def load_runs(folder, axes=None):
    """Every run below a folder, in the order of their configs; of equal configs the newest complete one. []
    if none.

    Old results may lie beside new ones. `axes` are the JSON pointers of a sweep. With `axes`, only runs of
    the newest run's program are kept, and of these only runs whose other settings equal the newest run's.
    Thus no figure mixes programs, or trials with other settings. Reference runs (`/accuracy`) lie in a folder
    `references` of their own. They are left out unless `folder` is that folder.
    """
    found = {}
    for path in sorted(Path(folder).glob("**/run.vtkhdf*")):
        if path.suffix not in (".vtkhdf", ".part") or "references" in path.relative_to(folder).parts:
            continue
        try:
            run = load_run(path)
        except (OSError, KeyError, ValueError):
            continue  # cut off before its first frame
        if run.frames:
            key = json.dumps(run.config, sort_keys=True)
            rank = (run.complete, path.stat().st_mtime)
            if key not in found or rank > found[key][0]:
                found[key] = (rank, run)
    runs = [run for _, run in sorted(found.values(), key=lambda entry: entry[0][1])]
    if axes is not None and runs:
        runs = [run for run in runs if run.source_hash == runs[-1].source_hash]
        newest = {}
        for run in runs:
            newest[run.model] = _fixed_part(run.config, axes)
            newest["any"] = newest[run.model][0]
        runs = [run for run in runs if _fixed_part(run.config, axes) == (newest["any"], newest[run.model][1])]
    return sorted(runs, key=lambda run: json.dumps(run.config, sort_keys=True))


def _fixed_part(config, axes):
    """The settings that are not on the axes: (all but bending, bending)."""
    rest = json.loads(json.dumps(config))
    for pointer in [*axes, "/name", "/description", "/expect", "/sweep"]:
        parent, _, last = pointer.rpartition("/")
        node = at(rest, parent)
        if isinstance(node, list) and last.isdigit() and int(last) < len(node):
            node[int(last)] = None
        elif isinstance(node, dict):
            node.pop(last, None)
    return rest, rest.pop("bending", {})


def select(runs, **wanted):
    """Runs with these values, '__' for '/': select(runs, bending__model='lod', mesh__cells=64)."""
    pointer = {key: "/" + key.replace("__", "/") for key in wanted}
    return [run for run in runs if all(run.get(pointer[key]) == value for key, value in wanted.items())]


def group(runs, key):
    """Ordered dict: key(run) → runs."""
    groups = {}
    for run in runs:
        groups.setdefault(key(run), []).append(run)
    return groups


def values(runs, name):
    """(R) values of a summary entry. Runs without it are left out; a diverged run counts as infinite."""
    numbers = [run.summary.get(name, np.inf if run.status == "diverged" else np.nan) for run in runs]
    numbers = np.array(numbers, float)
    return numbers[~np.isnan(numbers)]


@dataclass
class Spread:
    """Median and range over seeds."""

    median: float
    low: float
    high: float
    count: int

    def __sub__(self, offset):
        return Spread(self.median - offset, self.low - offset, self.high - offset, self.count)

    @property
    def known(self):
        return self.count > 0 and np.isfinite(self.median)


def spread(numbers):
    """Median and range; NaN if there are no numbers."""
    numbers = np.asarray(numbers, float)
    if not len(numbers):
        return Spread(np.nan, np.nan, np.nan, 0)
    return Spread(float(np.median(numbers)), float(numbers.min()), float(numbers.max()), len(numbers))


def summary_spread(runs, name):
    return spread(values(runs, name))


def statuses(runs):
    return dict(Counter(run.status for run in runs))


def typical_frame(runs, metric="pin_max_stretch"):
    """(run, frame) of the last simulated second whose metric is nearest to the median over all these runs and
    frames.

    Sheets are chaotic: the last frame may differ from what the medians say, this frame does not.
    """
    samples = [(run, frame, run.metrics[metric][frame]) for run in runs for frame in run.last_second()]
    samples = [sample for sample in samples if np.isfinite(sample[2])]
    if not samples:
        return None
    middle = np.median([value for _, _, value in samples])
    run, frame, _ = min(samples, key=lambda sample: abs(sample[2] - middle))
    return run, int(frame)


ROOT = Path(__file__).resolve().parent.parent
CONFIGS = ROOT / "configs"
MODELS = re.findall(r"^BENDLAB_BENDING_MODEL\((\w+)\)",
                    (ROOT / "lib/bendlab/bending/models.def").read_text(encoding="utf-8"), re.M)


@dataclass
class Experiment:
    """The runs of one config: those that exist, and those that are missing."""

    config: str  # file below configs/, as in "paper/fig5"
    settings: dict  # the config as written
    runs: list
    missing: list  # points of the sweep without a finished run, as text

    @property
    def sweep(self):
        """JSON pointer → values"""
        return self.settings.get("sweep", {})

    @property
    def command(self):
        return f"./bendlab run configs/{self.config}.json"


def load_experiment(results, config):
    """The runs of configs/<config>.json below `results`, and the points of its sweep that have no run."""
    settings = json.loads((CONFIGS / f"{config}.json").read_text(encoding="utf-8"))
    sweep = settings["sweep"] = {pointer: _listed(pointer, values)
                                 for pointer, values in settings.get("sweep", {}).items()}
    runs = [run for run in load_runs(Path(results) / settings["name"], list(sweep))
            if _on_sweep(run.config, sweep)]
    if config.endswith("_full"):  # run on request only: may be from an older program
        sources = {run.source_hash for run in load_experiment(results, config.removesuffix("_full")).runs}
        runs = [run for run in runs if run.source_hash in sources]
    there = {_place(run.config, sweep) for run in runs if run.over}
    # Only the program knows the points of a covering array. fig_plain.py checks that they cover.
    points = [] if "cover" in settings else _points(sweep)
    wanted = dict.fromkeys(_place(_with(settings, point), sweep) for point in points)
    missing = [", ".join(f"{pointer} {value}" for pointer, value in place) for place in wanted
               if place not in there]
    return Experiment(config, settings, runs, missing)


def _listed(pointer, values):
    """The swept values. "all" stands for every bending model."""
    if values != "all":
        return values
    if pointer != "/bending/model":
        raise ValueError(f"'all' is known for /bending/model only, not for {pointer}")
    return MODELS


def _points(sweep):
    for values in itertools.product(*sweep.values()):
        yield dict(zip(sweep, values))


def _with(settings, point):
    """A config with the values of a point; complete as far as _place() needs."""
    config = json.loads(json.dumps(settings))
    for pointer, value in point.items():
        *path, last = pointer.split("/")[1:]
        node = config
        for key in path:
            node = node[int(key)] if isinstance(node, list) else node.setdefault(key, {})
        node[int(last) if isinstance(node, list) else last] = value
    return config


def _place(config, sweep):
    """The point of the sweep that a config is: ((pointer, value), …), without settings of other models."""
    used = [pointer for pointer in sweep if _applies(config, pointer)]
    return tuple((pointer, _hashable(swept_value(config, pointer, sweep))) for pointer in used)


def swept_value(config, pointer, sweep):
    """The swept value that a config has at a pointer, None if it has none of them."""
    actual = at(config, pointer)
    return next((value for value in sweep[pointer] if _matches(actual, value)), None)


LEFT_OUT = ("at_curvature",)  # the program omits these if the model does not use them


def _matches(actual, wanted):
    """Whether a value fits a swept one. A swept object names some settings only: the others are defaults."""
    if isinstance(wanted, list):
        return isinstance(actual, list) and len(actual) == len(wanted) and all(map(_matches, actual, wanted))
    if isinstance(wanted, dict):
        return isinstance(actual, dict) and all(_matches(actual.get(key), value)
                                                for key, value in wanted.items() if key in actual
                                                or key not in LEFT_OUT)
    return actual == wanted


def _hashable(value):
    if isinstance(value, dict):
        return json.dumps(value, sort_keys=True)
    # 0 and 0.0 are equal and hash alike
    return tuple(map(_hashable, value)) if isinstance(value, list) else value


def _applies(config, pointer):
    keys = pointer.split("/")[1:]
    return len(keys) < 3 or keys[0] != "bending" or keys[1] == at(config, "/bending/model")


def _on_sweep(config, sweep):
    return all(swept_value(config, pointer, sweep) is not None for pointer in sweep
               if _applies(config, pointer))
