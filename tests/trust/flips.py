"""Flips single bits of finished run files. The program must compute the run again, with the same numbers.

    flips.py PROGRAM [FLIPS]      exit 1 if a flip goes unnoticed
"""
import json
import random
import sys
import tempfile
from pathlib import Path

from program import run, run_files, write_config


def runs(program, folder):
    """{id: (reused, summary)} after `bendlab run` of the sweep."""
    done = run(program, "run", "sweep.json", "--out", "out", "--json", folder=folder)
    if done.returncode:
        raise SystemExit(f"exit code {done.returncode}: {done.stderr}")
    lines = map(json.loads, done.stdout.splitlines())
    return {line["id"]: (line["reused"], line["summary"]) for line in lines}


def is_noticed(program, folder, file, chance, summaries):
    data = bytearray(file.read_bytes())
    at = chance.randrange(len(data))
    data[at] ^= 1 << chance.randrange(8)
    file.unlink()
    file.write_bytes(data)
    outcomes = runs(program, folder)
    for aside in file.parent.glob("*.bad"):
        aside.unlink()
    redone = [run_id for run_id, (reused, _) in outcomes.items() if not reused]
    same = {run_id: summary for run_id, (_, summary) in outcomes.items()} == summaries
    if len(redone) == 1 and same:
        return True
    print(f"byte {at} of {file.parent.name}: {len(redone)} runs were computed again, numbers "
          f"{'the same' if same else 'CHANGED'}", flush=True)
    return False


def main(program, flips=1000, seed=1):
    chance = random.Random(seed)
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        write_config(folder, "sweep", mesh={"cells": 4}, duration=0.2,
                     sweep={"/mesh/cells": [3, 5], "/solver/substeps": [1, 2]})
        summaries = {run_id: summary for run_id, (_, summary) in runs(program, folder).items()}
        noticed = sum(is_noticed(program, folder, chance.choice(run_files(folder / "out")), chance, summaries)
                      for _ in range(flips))
    print(f"{noticed} of {flips} flipped bits were noticed")
    return 0 if noticed == flips else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], *map(int, sys.argv[2:])))
