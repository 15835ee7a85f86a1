"""Experiments: many runs at once, as `bendlab run` makes them, and a table of their metrics."""
import hashlib
import json
import sys
import warnings
from pathlib import Path

import numpy as np

from bendlab import _core, own
from bendlab.scene import Scene
from bendlab.settings import plain


def run(config, sweep=None, jobs=0, out="results", force=False, name=None, measures=(), progress=False):
    """Computes the runs of an experiment, and returns a table with a row for each run: a structured NumPy
    array. `table["drop"]` is a column, `table[0]` a row, `table.dtype.names` has the names of the columns,
    and `pandas.DataFrame(table)` makes a data frame.

    config: a Scene, a dict as in a config file, or the path of a config file.
    sweep: settings to vary, in addition to the config's own sweep:
        {"/mesh/cells": [16, 32], "/bending": [bl.Crossover(), bl.DiscreteShells()]}. The last setting varies
        fastest. "mesh.cells" means "/mesh/cells".
    jobs: how many runs are computed at the same time; 0: as many as there are cores.
    out: folder of the run files. Runs that are complete in this folder are computed again only with `force`.
    name: name of the experiment, which is a folder in `out`. A Scene without a name is called "scene".
    measures: names or classes of additional measures: your own measures, or measures that the program
        computes only on request.
    progress: shows on stderr how many runs are finished.

    Columns: the settings that vary; status, message, cpu_s (s), file; and the metrics of the runs, which
    `bendlab measures` explains. If the config is wrong, raises ConfigError with all problems. If a run
    fails, `message` says why. Ctrl-C stops the runs after their current frames; if you repeat the call, the
    runs continue.
    """
    if isinstance(jobs, bool) or not isinstance(jobs, int) or jobs < 0:
        raise ValueError(f"jobs: expected a whole number of at least 0, got {jobs!r}")
    settings, source = _settings_of(config, name, Path(out))
    if sweep:
        settings["sweep"] = {**settings.get("sweep", {}),
                             **{_pointer(key): values for key, values in sweep.items()}}
    if measures:
        output = settings["output"] = dict(settings.get("output", {}))  # the caller's dict stays unchanged
        listed = [measures] if isinstance(measures, str) or not hasattr(measures, "__iter__") else measures
        output["measures"] = [*output.get("measures", []), *map(_measure_name, listed)]
    rows = _core.run(json.dumps(settings, default=plain), str(source), str(out), jobs, force,
                     _show if progress else None)
    if progress:
        print(file=sys.stderr)
    _warn(rows)
    return _table(rows)


def _settings_of(config, name, out):
    """(config as a dict, path of the file from which relative paths start, or "")"""
    if isinstance(config, Scene):
        settings = config._config()
        settings.update(name=name or "scene", duration=config.duration)
        if config.mesh._arrays:
            settings["mesh"] = {**settings.get("mesh", {}),
                                "file": _written(*config.mesh._arrays, out / settings["name"])}
        return settings, Path(config._folder, "scene.json") if config._folder else ""
    if isinstance(config, dict):
        return {**config, "name": name or config.get("name", "scene")}, ""
    settings = json.loads(Path(config).read_text(encoding="utf-8"))
    return {**settings, **({"name": name} if name else {})}, Path(config).resolve()


def _written(vertices, triangles, folder):
    """Writes a mesh file, so that the run can be repeated, and returns the path of the file. Coordinates have
    enough digits to be read as exactly the same numbers."""
    lines = [*("v " + " ".join(map(repr, row)) for row in vertices.tolist()),
             *("f " + " ".join(str(corner + 1) for corner in row) for row in triangles.tolist())]
    text = "\n".join(lines) + "\n"
    file = folder.resolve() / f"mesh-{hashlib.sha256(text.encode()).hexdigest()[:16]}.obj"
    folder.mkdir(parents=True, exist_ok=True)
    file.write_text(text, encoding="utf-8")
    return str(file)


def _pointer(key):
    return key if key.startswith("/") else "/" + key.replace(".", "/")


def _measure_name(measure):
    if isinstance(measure, str):
        return measure
    if not (isinstance(measure, type) and issubclass(measure, own.Measure)):
        raise TypeError(f"measures: expected names or classes of measures, got {measure!r}")
    return measure.name


def _warn(rows):
    """Gives one Python warning for each warning code, with the number of runs that have the warning."""
    texts = {}
    for row in rows:
        for code, message in row.get("warnings", ()):
            texts.setdefault(code, []).append(message)
    for code, messages in texts.items():
        warnings.warn(f"{code}, {len(messages)} of {len(rows)} runs: {messages[0]}", stacklevel=3)


def _show(over, count, last=[None]):
    if (over, count) == last[0]:
        return
    last[0] = (over, count)
    print(f"\r{over} of {count} runs", end="", file=sys.stderr, flush=True)


def _table(rows):
    """The rows, with a column for each setting that varies and for each metric."""
    pointers = list(dict.fromkeys(pointer for row in rows for pointer in row["point"]))
    last = [pointer.rsplit("/", 1)[-1] for pointer in pointers]
    names = {pointer: short if last.count(short) == 1 else pointer for pointer, short in zip(pointers, last)}
    metrics = list(dict.fromkeys(name for row in rows for name in row.get("summary", {})))
    columns = {names[pointer]: [_cell(row["point"].get(pointer)) for row in rows] for pointer in pointers}
    for name, missing in (("status", ""), ("message", ""), ("cpu_s", np.nan), ("file", "")):
        columns[name] = [row.get(name, missing) for row in rows]
    for metric in metrics:
        columns.setdefault(metric, [row.get("summary", {}).get(metric, np.nan) for row in rows])
    arrays = {name: np.array(values) for name, values in columns.items()}
    table = np.empty(len(rows), [(name, array.dtype) for name, array in arrays.items()])
    for name, array in arrays.items():
        table[name] = array
    return table


def _cell(value):
    """The value of a setting as a cell of the table. Lists and objects become JSON."""
    return json.dumps(value) if isinstance(value, (dict, list)) else value
