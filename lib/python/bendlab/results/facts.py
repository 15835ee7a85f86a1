"""Reads what a run file says besides its arrays (lib/bendlab/io/facts.hpp). Needs only h5py:

    with h5py.File("run.vtkhdf") as file:
        print(Facts(file).summary["drop"])
"""
import json


class Facts:
    """What an open run file says besides its arrays. `json` has everything; the other members are parts of
    `json`: `id`, `name`, `status`, `config`, `provenance` (name → text), `summary` and `timing` (name →
    number), `passes` [(name, seconds, calls, acted)], `counts` (kind of constraint → how many), `columns`
    (name of a metric → (unit, meaning)), `inputs` [(name, bytes)]."""

    def __init__(self, file):
        self.json = json.loads(file["outcome" if "outcome" in file else "facts"][()].tobytes())
        self.id, self.name, self.status, self.config, self.provenance, self.counts = (
            self.json[name] for name in ("id", "name", "status", "config", "provenance", "constraints"))
        # Numbers that JSON cannot express are texts: nan, inf and -inf.
        self.summary = {name: float(value) for name, value in self.json["summary"].items()}
        self.timing = {name: float(self.json[name]) for name in ("wall_s", "cpu_s", "step_cpu_s")}
        self.passes = [(name, float(seconds), *counts)
                       for name, seconds, *counts in self.json["passes"]]
        self.columns = dict(zip(self.json["metrics"], zip(self.json["units"], self.json["meanings"])))
        self.inputs = [(name, file[f"provenance/inputs/{k}"][()].tobytes())
                       for k, (_, name) in enumerate(self.json["inputs"])]
