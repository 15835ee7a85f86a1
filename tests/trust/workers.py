"""Workers of one plan on this machine, some of which are killed. Every run must be computed once, to its end.

    workers.py PROGRAM [ROUNDS]      exit 1 if a round fails
"""
import json
import random
import sys
import tempfile
import time

from program import differences, fresh, run, run_files, start, write_config

WORKERS = 3
RUNS = 12


def wrong_in(program, folder, number):
    """The problem after a round, or "" if there is none."""
    chance = random.Random(number)
    fresh(folder / "out")
    run(program, "plan", "sweep.json", "--write", "plan.json", "--out", "out", folder=folder)
    children = [start(program, "work", "plan.json", "--shard", f"{k}/{WORKERS}", "--jobs", 1,
                      "--checkpoint", 0.01, folder=folder) for k in range(WORKERS)]
    time.sleep(chance.uniform(0.05, 1))
    children[chance.randrange(WORKERS)].kill()
    texts = [child.communicate()[1] for child in children]
    last = run(program, "work", "plan.json", folder=folder)  # if all other workers had ended
    lines = "\n".join([*texts, last.stderr]).splitlines()
    computed = [line.split(": complete in")[0] for line in lines if ": complete in" in line]
    states = [json.loads(line)["state"] for line in
              run(program, "status", "plan.json", "--json", folder=folder).stdout.splitlines()]
    if states != ["complete"] * RUNS:
        return f"states {states}: {lines}"
    # A killed worker may have finished its last file without printing this.
    if len(computed) != len(set(computed)) or not RUNS - 1 <= len(computed) <= RUNS:
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
