"""Checks that runs take the memory and disk space that `plan` states, and that a run which needs too much
memory is refused.

    needs.py PROGRAM [CELLS]      128 cells by default; exit 1 if memory is off by more than a factor of 2

Memory is the largest resident set of the process that computes the run. (It includes the memory of the parent
when the child starts, so this script imports nothing large.)
"""
import json
import os
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

from program import run, write_config

IMPLICIT = {"strain": {"stiffness": "compliance", "compliance": 1e-4}}
# (model, solver): few and many springs, hinges, normals of edges; with and without a matrix.
CASES = [("none", {}), ("adaptive", {}), ("dihedral", {}), ("mid_edge", {}),
         ("dihedral", {"method": "quasi_newton"}), ("dihedral", {"method": "newton", "iterations": 1})]
MEMORY = 2  # a factor
DISK = 0.5  # in files with few frames: the rest pose of a grid is compressed, which is not estimated


def largest_set(program, folder, limit=None):
    """The outcome of the run as JSON (None if it failed), its memory in bytes, and its output on stderr."""
    limits = (lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit))) if limit else None
    with open(folder / "errors", "w+", encoding="utf-8") as errors:
        started = subprocess.Popen([program, "run", "run.json", "--force", "--json"], cwd=folder, text=True,
                                   stdout=subprocess.PIPE, stderr=errors, preexec_fn=limits)
        text = started.stdout.read()
        _, status, usage = os.wait4(started.pid, 0)
        started.returncode = os.waitstatus_to_exitcode(status)
        errors.seek(0)
        outcome = json.loads(text) if text else {}
        return outcome if outcome.get("file") else None, usage.ru_maxrss * 1024, errors.read()


def main(program, cells=128):
    program = str(Path(program).resolve())
    wrong = 0
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        for model, solver in CASES:
            write_config(folder, "run", mesh={"cells": cells}, duration=0.04, bending={"model": model},
                         material=IMPLICIT if "method" in solver else {}, solver=solver)
            needs = json.loads(run(program, "plan", "run.json", "--json", folder=folder).stdout)["needs"]
            outcome, memory, errors = largest_set(program, folder)
            if outcome is None:
                print(model, solver, "failed:", errors)
                wrong += 1
                continue
            size = os.path.getsize(folder / outcome["file"])
            bad = (not 1 / MEMORY < needs["memory_bytes"] / memory < MEMORY
                   or abs(needs["disk_bytes"] / size - 1) > DISK)
            wrong += bad
            print(model, solver, f"{memory / 1e6:.0f} MB, estimated {needs['memory_bytes'] / 1e6:.0f} MB;",
                  f"disk {size / 1e6:.2f} MB, estimated {needs['disk_bytes'] / 1e6:.2f} MB",
                  "WRONG" if bad else "", flush=True)

        # Half a gigabyte is not enough for this run. It must say so before it takes memory.
        write_config(folder, "run", mesh={"cells": 512}, duration=0.04, bending={"model": "adaptive"})
        outcome, memory, errors = largest_set(program, folder, 1 << 29)
        print(errors.strip(), f"({memory / 1e6:.0f} MB taken)")
        if outcome is not None or "of memory" not in errors or "/mesh/cells" not in errors or memory > 100e6:
            wrong += 1
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], *map(int, sys.argv[2:])))
