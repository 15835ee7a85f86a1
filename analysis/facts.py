"""Texts and numbers of a run file as h5py sees it, which has them in compressed datasets
(lib/bendlab/io/facts.hpp); or of an older program's, which has them as attributes. Needs h5py and numpy:

    with h5py.File("run.vtkhdf") as file:
        print(Facts(file).summary["drop"])
"""
from itertools import islice

import numpy as np


def text_of(value):
    if isinstance(value, np.ndarray):
        value = value.reshape(-1)[0]
    return value.decode(errors="surrogateescape") if isinstance(value, bytes) else str(value)


def _number(value):
    return float(np.ravel(value)[0])


class Facts:
    """`id`, `name`, `status`, `config` (a text), `provenance` (name → text), `summary` and `timing` (name →
    number), `passes` [(name, seconds, calls, acted)], `counts` (kind of constraint → how many), `columns`
    (name of a metric → (unit, meaning)) and `inputs` [(name, bytes)] of an open run file."""

    def __init__(self, file):
        self.id, self.name, self.status = (text_of(file.attrs[name]) for name in ("id", "name", "status"))
        self.inputs = []
        if "facts" in file:
            self._read_datasets(file)
        else:
            self._read_attributes(file)

    def _read_datasets(self, file):
        pairs, numbers = [], []
        for group in ("facts", "outcome"):  # of a run that has not ended, or is short, the first alone
            if group not in file:
                continue
            bytes_of = file[f"{group}/texts"][()].tobytes()
            texts = bytes_of.decode(errors="surrogateescape").split("\0")[:-1]
            end = texts[::2].index("") * 2  # an empty path
            pairs += zip(texts[:end:2], texts[1:end:2])
            numbers += zip(texts[end + 1:], map(float, file[f"{group}/numbers"][()]))
        below = lambda group, all_of: [(path[len(group) + 1:], value) for path, value in all_of
                                       if path.startswith(f"{group}/")]
        self.config = dict(pairs)["config"]
        self.provenance = dict(below("provenance", pairs))
        self.summary, self.timing = dict(below("summary", numbers)), dict(below("timing", numbers))
        passes = below("passes", numbers)
        self.passes = [(seconds[0], seconds[1], int(calls[1]), int(acted[1]))
                       for seconds, calls, acted in zip(*(islice(passes, i, None, 3) for i in range(3)))]
        self.counts = {kind: int(count) for kind, count in below("counts", numbers)}
        about = below("metrics", pairs)  # a unit, then a meaning
        self.columns = {unit[0]: (unit[1], meaning[1]) for unit, meaning in zip(about[::2], about[1::2])}
        names = dict(below("files", pairs))
        self.inputs = [(names[key], entry[()].tobytes()) for key, entry in
                       (file["provenance/inputs"].items() if names else ())]

    def _read_attributes(self, file):
        group = lambda name: file[name] if name in file else {}
        attributes = lambda name: file[name].attrs if name in file else {}
        self.config = text_of(file["provenance/config"][()])
        self.provenance = {name: text_of(value) for name, value in attributes("provenance").items()}
        self.summary = {name: _number(value) for name, value in attributes("summary").items()}
        self.timing = {name: _number(value) for name, value in attributes("timing").items()}
        timing = group("timing")
        columns = [list(timing[name][()]) for name in ("pass", "seconds", "calls", "acted") if name in timing]
        self.passes = [(text_of(name), float(seconds), *map(int, [*counts, 0, 0][:2]))
                       for name, seconds, *counts in zip(*columns)]
        self.counts = {kind: int(_number(data.attrs["count"])) for kind, data in group("constraints").items()}
        metrics = file["metrics"]
        if "values" in metrics:
            names, *about = (map(text_of, metrics[name][()]) for name in ("names", "units", "meanings"))
            self.columns = dict(zip(names, zip(*about)))
        else:  # an older program's: a dataset for every metric
            told = lambda data, name, default: text_of(data.attrs.get(name, default))
            self.columns = {name: (told(data, "unit", "1"), told(data, "meaning", ""))
                            for name, data in metrics.items()}
        if "provenance/inputs" in file:
            self.inputs = [(text_of(entry.attrs["name"]), np.asarray(entry[()]).tobytes())
                           for entry in file["provenance/inputs"].values()]
