"""Starts the same sweep in four processes at once. Each run must be computed once, and every file be whole.

    rounds.py PROGRAM [ROUNDS]      exit 1 if a round fails
"""
import json
import sys
import tempfile
from pathlib import Path

from program import fresh, run_files, seal_of, start, write_config

PROCESSES = 4
RUNS = 8


def wrong_in(program, folder):
    """The problem after a round, or "" if there is none."""
    fresh(folder / "out")
    children = [start(program, "run", "sweep.json", "--jobs", 2, "--out", "out", "--json", folder=folder)
                for _ in range(PROCESSES)]
    outputs = [child.communicate() for child in children]
    codes = [child.returncode for child in children]
    if any(codes):
        return f"exit codes {codes}: {[errors for _, errors in outputs if errors]}"
    computed = sum(not json.loads(line)["reused"] for out, _ in outputs for line in out.splitlines())
    files = run_files(folder / "out")
    if computed != RUNS or len(files) != RUNS:
        return f"{RUNS} runs were computed {computed} times, and left {len(files)} files"
    if any(seal_of(file) != "whole" for file in files):
        return "a file is not whole"
    left = {file.name for file in (folder / "out").glob("**/*")
            if file.is_file() and not file.name.endswith(".patch.gz")}  # shared by all runs
    return f"left files {sorted(left)}" if left != {"run.lock", "run.vtkhdf", "sweep.sweep.json"} else ""


def main(program, rounds=200):
    wrong = 0
    with tempfile.TemporaryDirectory() as place:
        write_config(place, "sweep", mesh={"cells": 4}, duration=0.2,
                     sweep={"/mesh/cells": [3, 4, 5, 6], "/solver/substeps": [1, 2]})
        for number in range(rounds):
            if why := wrong_in(program, Path(place)):
                wrong += 1
                print(f"round {number}: {why}", flush=True)
    print(f"{rounds - wrong} of {rounds} rounds of {PROCESSES} processes: every run once, every file whole")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], *map(int, sys.argv[2:])))
