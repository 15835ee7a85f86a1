"""The only reader of run files. Layout: lib/bendlab/io/run_file.hpp.

A run file is open only while something is read from it, so that thousands of runs can be listed at once. Most
lists do not even open the run files, because the index of the folder has what a list needs (run_index.py).
Shapes: V vertices, T triangles, F committed frames. Lengths in m, times in s.
"""
import json
import os
import sys
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property, lru_cache
from pathlib import Path

import h5py
import numpy as np

from bendlab.results import registry
from bendlab.results.checksum import require_readable
from bendlab.results.lock import is_locked
from bendlab.results.facts import Facts
from bendlab.results.run_index import Index, stamp_of


def _opened(path):
    """The opened HDF5 file. Tests the checksum first, because lists of runs do not open the files.
    BlockingIOError if a process is writing the file."""
    path = Path(path)
    if path.suffix == ".part" and is_locked(path.parent):
        raise BlockingIOError(f"{path} is being written by another process")
    require_readable(path)
    return h5py.File(path, "r")


class Metrics(Mapping):
    """Name of a metric → (F) array of a run file. All arrays are read when the first is needed."""

    def __init__(self, path, names, frames):
        self._path, self.frames, self._arrays = path, frames, dict.fromkeys(names)

    def __getitem__(self, name):
        if self._arrays[name] is None:
            with _opened(self._path) as file:
                self._arrays.update(zip(self._arrays, file["metrics/values"][:self.frames].T.copy()))
        return self._arrays[name]

    def __iter__(self):
        return iter(self._arrays)

    def __len__(self):
        return len(self._arrays)

    def about(self, name):
        """(unit, meaning) of a metric."""
        with _opened(self._path) as file:
            return Facts(file).columns[name]


@dataclass(eq=False)
class Run:
    """A run. Metrics and frames are read when they are needed; all other data are read at once."""

    file: Path
    id: str
    name: str
    # complete | implausible | diverged | interrupted. A run without a readable file is missing (not begun),
    # running, failed (before its first frame) or unreadable (damaged).
    status: str
    config: dict = field(default_factory=dict)
    summary: dict = field(default_factory=dict)  # name → number
    metrics: Mapping = field(default_factory=lambda: {"time": []})  # name → (F) array, `time` among them
    wall_s: float = 0.0
    step_cpu_s: float = 0.0  # steps only, without set-up and recording
    cpu_s: float = 0.0
    passes: dict = field(default_factory=dict)  # pass → seconds
    counts: dict = field(default_factory=dict)  # kind of constraint → how many
    point: dict = field(default_factory=dict)  # JSON pointer → value: the place on the sweep
    source_hash: str = ""  # identifies the program that wrote the run
    experiment: str = ""  # its config below configs/, as in "paper/fig5"; "" if it has no config there
    provenance: dict = field(default_factory=dict)  # name → text: commit, processor, threads, …

    @property
    def warnings(self):
        """[{code, message}] of the run's warnings."""
        return _json(self.provenance.get("warnings"), [])

    @property
    def broken(self):
        """The first bound that an implausible run broke: {bound, measured, limit, unit, time, vertex, advice,
        …}. None if the run broke no bound."""
        return _json(self.provenance.get("implausible"), None)

    def get(self, pointer, default=None):
        """The value at a JSON pointer in the config with all defaults."""
        return at(self.config, pointer, default)

    @property
    def model(self):
        return self.get("/bending/model")

    @property
    def method(self):
        return method_name(self.config["solver"])

    @property
    def frames(self):
        return self.metrics.frames if isinstance(self.metrics, Metrics) else len(self.metrics["time"])

    @property
    def complete(self):
        """Whether the run has all its frames. An implausible run has all frames, too, and figures show it."""
        return self.status in ("complete", "implausible")

    @property
    def over(self):
        """Whether the run is complete or diverged, so that a repeated run would end in the same way."""
        return self.complete or self.status == "diverged"

    def frame_index(self, frame):
        """Frame number from 0; a negative `frame` counts from the end. IndexError for a missing frame."""
        index = frame + self.frames if frame < 0 else frame
        if not 0 <= index < self.frames:
            raise IndexError(f"{self.file} has {self.frames} frames, no frame {frame}")
        return index

    def last_second(self):
        """Numbers of the frames in the last simulated second, without the frame at its beginning."""
        time = self.metrics["time"]
        return np.flatnonzero(time > time[-1] - 1 + 1e-9) if len(time) else np.array([], int)

    def positions(self, frame=-1):
        """(V, 3) positions of a frame, float64."""
        index = self.frame_index(frame)
        with _opened(self.file) as file:
            count = len(file["rest/positions"])
            return file["VTKHDF/Points"][index * count:(index + 1) * count].astype(float)

    def trajectory(self, frames=None):
        """(F, V, 3) positions of all frames, or of the frames with the numbers `frames`, float64."""
        with _opened(self.file) as file:
            count = len(file["rest/positions"])
            points = file["VTKHDF/Points"]
            if frames is None:
                return points[:self.frames * count].reshape(self.frames, count, 3).astype(float)
            positions = np.empty((len(frames), count, 3))
            for i, frame in enumerate(frames):
                positions[i] = points[frame * count:(frame + 1) * count]
            return positions

    def cell(self, name, frame=-1):
        """(T) values of a field on the triangles, in a frame."""
        index = self.frame_index(frame)
        with _opened(self.file) as file:
            count = len(file["rest/triangles"])
            return file[f"VTKHDF/CellData/{name}"][index * count:(index + 1) * count].astype(float)

    def _rest(self, name):
        with _opened(self.file) as file:
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

    @cached_property
    def obstacles(self):
        """Index of an obstacle in /effects → (points, triangles, velocity) of its surface at time 0. {} if an
        older program wrote the file, which did not record obstacles."""
        if self.file is None:
            return {}
        with _opened(self.file) as file:
            return {int(index): (group["positions"][()].astype(float), group["triangles"][()],
                                 group["velocity"][()])
                    for index, group in file.get("obstacles", {}).items()}

    @cached_property
    def about(self):
        """{"summary": {name: [unit, meaning]}, "settings": {pointer: [unit, meaning]}}; {}
        if no file states them."""
        try:
            with _opened(self.file) as file:
                return json.loads(file["about"][()].tobytes()) if "about" in file else {}
        except OSError:
            return {}

    def constraints(self, kind):
        """(C, n) vertices of the C constraints of a kind. KeyError if the run did not record constraints."""
        with _opened(self.file) as file:
            name = f"constraints/{kind}/vertices"
            if name not in file:
                raise KeyError(f"{self.file} has no {name}: run it with /output/constraints true")
            vertices = file[name][()].astype(int)
        return vertices if vertices.ndim == 2 else vertices.reshape(-1, 2)


def _json(text, default):
    return (json.loads(text) if text else None) or default


def at(config, pointer, default=None):
    """The value at a JSON pointer in nested dicts and lists; `default` if there is no such value."""
    node = config
    for key in pointer.split("/")[1:]:
        if isinstance(node, list) and key.isdigit() and int(key) < len(node):
            node = node[int(key)]
        elif isinstance(node, dict) and key in node:
            node = node[key]
        else:
            return default
    return node


def method_name(solver):
    """The method of a config's /solver, and the integrator if it is not the default: "newton, euler"."""
    name, integrator = solver.get("method", "pbd"), solver.get("integrator")
    return name if integrator in (None, registry.usual(name, "integrator")) else f"{name}, {integrator}"


def load_run(path):
    """The run of a finished or unfinished (`.part`) file. Raises OSError if the file is not readable, or was
    changed after it was written; ValueError if it is not a run file."""
    return _run_of(Path(path), _read(path))


def _read(path):
    """What a run file says, without metrics and frames. An index has only a part of these data."""
    with _opened(path) as file:
        if not {"facts", "metrics", "VTKHDF"} <= set(file):
            raise ValueError(f"{path} cannot be read as a run file: it is an HDF5 file, but not a run file")
        return {**Facts(file).json, "frames": len(file["metrics/values"])}


def _run_of(path, stated):
    provenance = stated["provenance"]
    _learn(provenance.get("models", "{}"), provenance.get("methods", "{}"))
    return Run(
        file=path,
        id=stated["id"],
        name=stated["name"],
        status="interrupted" if stated["status"] == "running" else stated["status"],
        config=stated["config"],
        summary={name: float(value) for name, value in stated["summary"].items()},
        metrics=Metrics(path, stated["metrics"], stated["frames"]),
        wall_s=float(stated["wall_s"]),
        step_cpu_s=float(stated["step_cpu_s"]),
        cpu_s=float(stated["cpu_s"]),
        passes={name: float(seconds) for name, seconds, *_ in stated["passes"]},
        source_hash=provenance.get("source_hash", ""),
        provenance=provenance,
        point=json.loads(provenance.get("point", "{}")),
        counts=stated["constraints"],
    )


@lru_cache(maxsize=None)
def _learn(models, methods):
    registry.learn(json.loads(models), json.loads(methods))


def load_runs(folder):
    """All runs below a folder, in the order of their configs. If several runs have equal configs, only the
    newest complete run is returned. [] if there is no run.

    A folder may have old and new results: load_experiment() (sweeps.py) returns only the results of one
    program and one sweep. Reference runs (`/accuracy`) are in folders named `references`, and are left out
    unless `folder` itself is such a folder.
    """
    best = {}
    folder = Path(folder)
    indices = Indices(folder)
    for path in _run_files(str(folder)):
        run = load_if_begun(path, indices)
        if run:
            key = json.dumps(run.config, sort_keys=True)
            rank = (run.complete, os.stat(path).st_mtime_ns)
            if key not in best or rank > best[key][0]:
                best[key] = (rank, run)
    indices.write()
    return [best[key][1] for key in sorted(best)]


def _run_files(folder):
    """Sorted paths (str) of the run files below a folder, without reference runs."""
    paths = []
    for place, folders, names in os.walk(folder):
        folders[:] = [name for name in folders if name != "references"]
        paths += [f"{place}/{name}" for name in names
                  if name.startswith("run.vtkhdf") and name.endswith((".vtkhdf", ".part"))]
    return sorted(paths)


class Indices:
    """The indices of runs in a folder: the folder's own index, and the indices of the folders in it."""

    def __init__(self, folder):
        self._folder, self._own, self._new = Path(folder), Index(folder), 0

    @cached_property
    def _others(self):
        places = [path for path in sorted(self._folder.iterdir()) if path.is_dir()]
        return [index for index in map(Index, places) if len(index)]

    def _find(self, path, stamp):
        stated = self._own.find(path, stamp)
        return stated or next(filter(None, (index.find(path, stamp) for index in self._others)), None)

    def run(self, path):
        """The run of a file (str) below the folder. If an index has the present state of the file, the run
        comes from the index, otherwise from the file. Raises the same errors as load_run()."""
        stamp = stamp_of(path)
        stated = self._find(path, stamp)
        if stated:
            return _run_of(Path(path), stated)
        stated = _read(path)
        if path.endswith(".vtkhdf"):
            self._own.put(path, stamp, stated)
            self._new += 1
        return _run_of(Path(path), stated)

    def write(self):
        """Adds the runs that were read from files to the folder's own index."""
        if self._new:
            self._own.write()


def load_if_begun(path, indices=None):
    """The run of a file; None if the file is missing, has no frame yet, or is damaged (stderr then names the
    file). `indices`: the Indices of a folder above the file."""
    if not os.path.exists(path):
        return None
    try:
        run = indices.run(str(path)) if indices else load_run(path)
    except (OSError, KeyError, ValueError) as error:
        if not str(path).endswith(".part"):
            print(f"left out: {error}", file=sys.stderr)
        return None
    return run if run.frames else None


def select(runs, **wanted):
    """The runs whose configs have these values; '__' stands for '/': select(runs, mesh__cells=64)."""
    pointer = {key: "/" + key.replace("__", "/") for key in wanted}
    return [run for run in runs if all(run.get(pointer[key]) == value for key, value in wanted.items())]


def group(runs, key):
    """Ordered dict: key(run) → runs."""
    groups = {}
    for run in runs:
        groups.setdefault(key(run), []).append(run)
    return groups


def by_model(runs):
    """Model → its runs, in the order of the program's models."""
    return dict(sorted(group(runs, lambda run: run.model).items(),
                       key=lambda entry: registry.model_place(entry[0])))


def values(runs, name):
    """(R) values of the metric `name`. Runs without this metric are left out, but diverged runs have inf."""
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


def typical_run(runs, metric="pin_max_stretch"):
    """(run, last frame) of the typical run: the median of `metric` over its last second is nearest to the
    median of all runs. None if there are no runs.

    The frame is not a typical frame but the last frame, so that all panels of a figure show the same time.
    """
    middles = [(np.median(seen), run) for run in runs
               if len(seen := run.metrics[metric][run.last_second()]) and np.isfinite(np.median(seen))]
    if not middles:
        return None
    middle = np.median([value for value, _ in middles])
    _, run = min(middles, key=lambda entry: abs(entry[0] - middle))
    return run, run.frames - 1
