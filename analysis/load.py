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
    """Name → (F) array of a run file, each read when it is first asked for."""

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
    """One run: what is small is read at once, metrics and frames on demand."""

    file: Path
    id: str
    name: str
    status: str  # complete | implausible | diverged | interrupted
    config: dict
    summary: dict  # name → number
    metrics: Mapping  # name → (F) array, `time` among them
    wall_s: float = 0.0
    step_cpu_s: float = 0.0  # of the steps alone
    cpu_s: float = 0.0
    passes: dict = field(default_factory=dict)  # pass → seconds
    counts: dict = field(default_factory=dict)  # kind of constraint → how many
    source_hash: str = ""  # of the program that ran it

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
        """Whether all frames are there. A run that is implausible went to its end: what is wrong with it is what a figure shows."""
        return self.status in ("complete", "implausible")

    @property
    def over(self):
        """Whether the same run again would end as it did."""
        return self.complete or self.status == "diverged"

    def frame_index(self, frame):
        """A frame number from 0, given one that may count from the end. IndexError where there is none."""
        index = frame + self.frames if frame < 0 else frame
        if not 0 <= index < self.frames:
            raise IndexError(f"{self.file} has {self.frames} frames, no frame {frame}")
        return index

    def last_second(self):
        """Numbers of the frames within the last simulated second."""
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
        """The vertices that the scene names, without the rings pinned with them."""
        return self._rest("pin_seeds").astype(int)

    @property
    def size(self):
        """Diagonal of the rest box."""
        return float(np.linalg.norm(np.ptp(self.rest_positions, axis=0)))

    def constraints(self, kind):
        """(C, n) vertices of every constraint of a kind; KeyError unless the run recorded them."""
        with h5py.File(self.file, "r") as file:
            name = f"constraints/{kind}/vertices"
            if name not in file:
                raise KeyError(f"{self.file} holds no {name}: run it with /output/constraints true")
            vertices = file[name][()].astype(int)
        return vertices if vertices.ndim == 2 else vertices.reshape(-1, 2)


def at(config, pointer, default=None):
    """Value of nested dicts and lists at a JSON pointer, `default` where there is none."""
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
    """One run from its file, finished or not (`.part`). OSError where it can't be opened, KeyError where it is no run."""
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
            counts={kind: int(np.ravel(data.attrs["count"])[0]) for kind, data in group("constraints").items()},
        )


def load_runs(folder, axes=None):
    """Every run below a folder, the newest of each config, in the order of their configs; [] where there is none.

    Old results may lie beside new ones. With `axes` (JSON pointers) only runs of the newest one's program that differ
    from it in nothing but these are kept, so that neither an older program nor a trial with other settings mixes into a figure. References of runs
    (`/accuracy`) lie in a folder `references` of their own and are left out, unless that is the folder.
    """
    found = {}
    for path in sorted(Path(folder).glob("**/run.vtkhdf*")):
        if path.suffix not in (".vtkhdf", ".part") or "references" in path.relative_to(folder).parts:
            continue
        try:
            run = load_run(path)
        except (OSError, KeyError, ValueError):
            continue  # a file that was cut off before its first frame
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
    """What the axes don't point at: (the scene, bending, of which models keep only what they use)."""
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
    """Runs whose config has these values; '__' stands for '/': select(runs, bending__model='lod', mesh__cells=64)."""
    pointer = {key: "/" + key.replace("__", "/") for key in wanted}
    return [run for run in runs if all(run.get(pointer[key]) == value for key, value in wanted.items())]


def group(runs, key):
    """Ordered dict: key(run) → runs."""
    groups = {}
    for run in runs:
        groups.setdefault(key(run), []).append(run)
    return groups


def values(runs, name):
    """(R) values of a summary entry over the runs, those without it left out. A diverged run counts as infinite."""
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
    """Median and range; NaN where there are none."""
    numbers = np.asarray(numbers, float)
    if not len(numbers):
        return Spread(np.nan, np.nan, np.nan, 0)
    return Spread(float(np.median(numbers)), float(numbers.min()), float(numbers.max()), len(numbers))


def summary_spread(runs, name):
    return spread(values(runs, name))


def statuses(runs):
    return dict(Counter(run.status for run in runs))


def typical_frame(runs, metric="pin_max_stretch"):
    """(run, frame) of the last simulated second whose metric is nearest to the median over all these runs and frames:
    a picture of it shows what the numbers say, where a last frame of a chaotic sheet may mislead."""
    samples = [(run, frame, run.metrics[metric][frame]) for run in runs for frame in run.last_second()]
    samples = [sample for sample in samples if np.isfinite(sample[2])]
    if not samples:
        return None
    middle = np.median([value for _, _, value in samples])
    run, frame, _ = min(samples, key=lambda sample: abs(sample[2] - middle))
    return run, int(frame)


ROOT = Path(__file__).resolve().parent.parent
CONFIGS = ROOT / "configs"
MODELS = re.findall(r"^BENDLAB_BENDING_MODEL\((\w+)\)", (ROOT / "lib/bendlab/bending/models.def").read_text(encoding="utf-8"), re.M)


@dataclass
class Experiment:
    """The runs of one config: those that are there, and how many are not."""

    config: str  # "paper/fig5": the file below configs/
    settings: dict  # the config as it is written
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
    """The runs of configs/<config>.json below `results`, with what is missing of its sweep."""
    settings = json.loads((CONFIGS / f"{config}.json").read_text(encoding="utf-8"))
    sweep = settings["sweep"] = {pointer: _listed(pointer, values) for pointer, values in settings.get("sweep", {}).items()}
    runs = [run for run in load_runs(Path(results) / settings["name"], list(sweep)) if _on_sweep(run.config, sweep)]
    if config.endswith("_full"):  # made on request only, so what is there may be of an older program than the rest
        sources = {run.source_hash for run in load_experiment(results, config.removesuffix("_full")).runs}
        runs = [run for run in runs if run.source_hash in sources]
    there = {_place(run.config, sweep) for run in runs if run.over}
    # Which points a covering array takes is known to the program alone; fig_plain.py looks whether they cover.
    points = [] if "cover" in settings else _points(sweep)
    wanted = dict.fromkeys(_place(_with(settings, point), sweep) for point in points)
    missing = [", ".join(f"{pointer} {value}" for pointer, value in place) for place in wanted if place not in there]
    return Experiment(config, settings, runs, missing)


def _listed(pointer, values):
    """What is swept: "all" stands for every choice of a setting, and is used for bending models."""
    if values != "all":
        return values
    if pointer != "/bending/model":
        raise ValueError(f"'all' of {pointer} is not known here")
    return MODELS


def _points(sweep):
    for values in itertools.product(*sweep.values()):
        yield dict(zip(sweep, values))


def _with(settings, point):
    """A config (only as far as _place() looks) with the point's values in it."""
    config = json.loads(json.dumps(settings))
    for pointer, value in point.items():
        *path, last = pointer.split("/")[1:]
        node = config
        for key in path:
            node = node[int(key)] if isinstance(node, list) else node.setdefault(key, {})
        node[int(last) if isinstance(node, list) else last] = value
    return config


def _place(config, sweep):
    """Where on the sweep a config is: ((pointer, value), …), without the settings of models it doesn't use."""
    used = [pointer for pointer in sweep if _applies(config, pointer)]
    return tuple((pointer, _hashable(swept_value(config, pointer, sweep))) for pointer in used)


def swept_value(config, pointer, sweep):
    """The value of the sweep that a config has at a pointer, None where it has none of them."""
    actual = at(config, pointer)
    return next((value for value in sweep[pointer] if _matches(actual, value)), None)


LEFT_OUT = ("at_curvature",)  # by the program, of a model that does not use it


def _matches(actual, wanted):
    """Equal; of a swept object, or each of a list, the config has the settings that it names, and the defaults of all others."""
    if isinstance(wanted, list):
        return isinstance(actual, list) and len(actual) == len(wanted) and all(map(_matches, actual, wanted))
    if isinstance(wanted, dict):
        return isinstance(actual, dict) and all(_matches(actual.get(key), value) for key, value in wanted.items()
                                                if key in actual or key not in LEFT_OUT)
    return actual == wanted


def _hashable(value):
    if isinstance(value, dict):
        return json.dumps(value, sort_keys=True)
    return tuple(map(_hashable, value)) if isinstance(value, list) else value  # 0 and 0.0 are equal and hash alike


def _applies(config, pointer):
    keys = pointer.split("/")[1:]
    return len(keys) < 3 or keys[0] != "bending" or keys[1] == at(config, "/bending/model")


def _on_sweep(config, sweep):
    return all(swept_value(config, pointer, sweep) is not None for pointer in sweep if _applies(config, pointer))
