"""Reports of invented runs."""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "analysis"))

from runs.collected import Sweep  # noqa: E402
from bendlab.results.load import Run  # noqa: E402
from sweep.report import Report  # noqa: E402


def run_at(point, summary=None, status="complete", **more):
    """A run at a point of a sweep, without a file."""
    config = {"bending": {"model": point.get("/bending/model", "adaptive")},
              "mesh": {"cells": point.get("/mesh/cells", 8)}, "duration": 1.0}
    for pointer, value in point.items():
        *path, last = pointer.split("/")[1:]
        node = config
        for key in path:
            node = node.setdefault(key, {})
        node[last] = value
    fields = dict(file=None, id="-".join(map(str, point.values())) or "one", name="made", status=status,
                  config=config, summary=summary or {}, metrics={"time": []}, point=point)
    return Run(**(fields | more))


def sweep_of(runs, axes, settings=None, **more):
    return Sweep("made", Path("results/made"), runs, axes, settings or {}, **more)


def report_of(*sweeps, command="./bendlab report results/made"):
    return Report(list(sweeps), command)
