"""Runs CalculiX (the program ccx) on a deck, and reads the displacements that it prints."""
import os
import re
import resource
import shutil
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np

MISSING = "CalculiX is not installed: apt-get install calculix-ccx; its rows are left out"
LONGEST = 600  # seconds; ten times as long as the slowest deck takes on an idle core


class CalculixError(Exception):
    """CalculiX is missing, or stopped before the end."""


@dataclass(frozen=True)
class Value:
    """A quantity at a fraction `load` of the load. seconds: processor time for the whole deck."""
    benchmark: str
    quantity: str
    unit: str
    element: str
    mesh: str
    load: float
    value: float
    truth: float
    seconds: float


def program():
    path = shutil.which("ccx")
    if path is None:
        raise CalculixError(MISSING)
    return path


def version():
    output = subprocess.run([program(), "-v"], capture_output=True, text=True, check=False).stdout
    return re.search(r"Version (\S+)", output)[1]


def read_displacements(text):
    """The displacements in a .dat file: per step, {node number: (x, y, z)}."""
    steps = []
    for line in text.splitlines():
        words = line.split()
        if words[:1] == ["displacements"]:
            steps.append({})
        elif len(words) == 4:
            steps[-1][int(words[0])] = np.array(words[1:], dtype=float)
    return steps


def processor_seconds():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def run_deck(deck):
    """The values of a deck: each quantity at the end of each step. Uses one processor core."""
    label = f"{deck.benchmark}, {deck.element}, {deck.mesh}"
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "deck.inp").write_text(deck.text, encoding="ascii")
        before = processor_seconds()
        try:
            done = subprocess.run([program(), "deck"], cwd=folder, env={**os.environ, "OMP_NUM_THREADS": "1"},
                                  capture_output=True, text=True, check=False, timeout=LONGEST)
        except subprocess.TimeoutExpired as error:
            raise CalculixError(f"{label}: CalculiX was stopped after {LONGEST} seconds") from error
        seconds = processor_seconds() - before
        printed = Path(folder) / "deck.dat"
        steps = read_displacements(printed.read_text(encoding="ascii")) if printed.exists() else []
    if done.returncode != 0 or len(steps) != len(deck.loads):
        errors = dict.fromkeys(line.strip() for line in done.stdout.splitlines() if "*ERROR" in line)
        raise CalculixError(f"{label}: CalculiX stopped after step {len(steps)} of {len(deck.loads)}: "
                            f"{'; '.join(errors) or 'no message'}")
    return [Value(deck.benchmark, quantity.name, quantity.unit, deck.element, deck.mesh, load,
                  float(np.mean([step[node] for node in quantity.nodes], axis=0) @ quantity.direction), truth,
                  round(seconds, 2))
            for quantity in deck.quantities for load, truth, step in zip(deck.loads, quantity.truths, steps)]
