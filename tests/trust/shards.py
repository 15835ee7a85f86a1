"""Starts the shards of a sweep and, at the same time, the whole sweep, and kills some of these processes.
Every run must be computed once, with the same bits as in a single process.

    shards.py PROGRAM [ROUNDS]      exit 1 if a round fails
"""
import json
import random
import sys
import tempfile
import time

from program import differences, fresh, run, run_files, start, write_config

SHARDS = 3
RUNS = 12


def wrong_in(program, folder, number):
    """The problem after a round, or "" if there is none."""
    chance = random.Random(number)
    fresh(folder / "out")
    same = ("run", "sweep.json", "--out", "out", "--json", "--jobs", 1, "--checkpoint", 0.01)
    children = [start(program, *same, "--shard", f"{k}/{SHARDS}", folder=folder) for k in range(SHARDS)]
    children.append(start(program, *same, folder=folder))
    time.sleep(chance.uniform(0.05, 1))
    children[chance.randrange(SHARDS)].kill()
    outputs = [child.communicate() for child in children]
    last = run(program, *same, folder=folder)
    errors = "".join(errors for _, errors in outputs)
    if last.returncode:
        return f"exit code {last.returncode}: {last.stderr}{errors}"
    runs = [json.loads(line) for line in last.stdout.splitlines()]
    if [entry["status"] for entry in runs] != ["complete"] * RUNS:
        return f"the runs are {[entry['status'] for entry in runs]}"
    texts = [*(output for output, _ in outputs), last.stdout]
    computed = [entry["id"] for entry in map(json.loads, "".join(texts).splitlines()) if not entry["reused"]]
    # A killed process may have computed runs that it did not print: it prints a run after all runs before it.
    if len(computed) != len(set(computed)):
        return f"{RUNS} runs were computed {len(computed)} times: {sorted(computed)}"
    wrong = [f"{file.parent.name}: {what}" for file in run_files(folder / "whole")
             for what in differences(file, folder / "out" / file.relative_to(folder / "whole"))]
    return "; ".join(wrong)


def main(program, rounds=50):
    wrong = 0
    with tempfile.TemporaryDirectory() as name:
        folder = fresh(f"{name}/place")
        write_config(folder, "sweep", mesh={"cells": 12}, duration=2.0,
                     sweep={"/mesh/cells": [10, 11, 12, 13, 14, 15], "/solver/substeps": [4, 8]})
        run(program, "run", "sweep.json", "--out", "whole", folder=folder)
        for number in range(rounds):
            if text := wrong_in(program, folder, number):
                wrong += 1
                print(f"round {number}: {text}", flush=True)
    print(f"{rounds - wrong} of {rounds} rounds: every run once, with the same bits")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], *map(int, sys.argv[2:])))
