"""Runs the program, and compares run files to the bit."""
import json
import shutil
import subprocess
import sys
from pathlib import Path

import h5py
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "analysis"))
from bendlab.results.checksum import seal_of  # noqa: E402
from bendlab.results.facts import Facts  # noqa: E402

TIMES = ("wall_s", "cpu_s", "step_cpu_s")


def run(program, *arguments, folder, **options):
    """Runs `bendlab ARGUMENTS` in `folder`. The finished process."""
    return subprocess.run([program, *map(str, arguments)], cwd=folder, text=True, capture_output=True,
                          stdin=subprocess.DEVNULL, check=False, **options)


def start(program, *arguments, folder):
    return subprocess.Popen([program, *map(str, arguments)], cwd=folder, text=True, stdin=subprocess.DEVNULL,
                            stdout=subprocess.PIPE, stderr=subprocess.PIPE)


def fresh(folder):
    """Empties or creates the folder. Returns it."""
    shutil.rmtree(folder, ignore_errors=True)
    Path(folder).mkdir(parents=True)
    return Path(folder)


def run_files(out):
    return sorted(Path(out).glob("**/run.vtkhdf"))


def times_gone_on(file):
    """How often the run of a file continued from a checkpoint."""
    with h5py.File(file, "r") as run_file:
        times = Facts(run_file).provenance.get("went_on_at", "")
    return len(times.split(",")) if times else 0


def differences(first, second):
    """The parts of two run files that differ, except for times: datasets to the bit, summary, verdict."""
    differing = []
    with h5py.File(first, "r") as a, h5py.File(second, "r") as b:
        names = [set(), set()]
        for file, seen in ((a, names[0]), (b, names[1])):
            file.visititems(lambda name, node: seen.add(name) if isinstance(node, h5py.Dataset) else None)
        for name in sorted(names[0] | names[1]):
            if name in ("facts", "outcome"):
                continue
            if name not in a or name not in b:
                differing.append(name)
            elif a[name].dtype == object:
                differing += [name] if a[name][()].tolist() != b[name][()].tolist() else []
            elif a[name].shape != b[name].shape or a[name][()].tobytes() != b[name][()].tobytes():
                differing.append(name)
        facts = [Facts(file) for file in (a, b)]
        summaries = [part.summary for part in facts]
        for key in sorted(summaries[0].keys() | summaries[1].keys()):
            values = [np.asarray(summary.get(key, "none")).tobytes() for summary in summaries]
            differing += [f"summary {key}"] if values[0] != values[1] else []
        differing += ["status"] if facts[0].status != facts[1].status else []
        differing += ["config"] if facts[0].config != facts[1].config else []
        counts = [[(name, *counts) for name, _, *counts in part.passes] for part in facts]
        differing += ["calls of passes"] if counts[0] != counts[1] else []
    return differing


def write_config(folder, name, **settings):
    file = Path(folder) / f"{name}.json"
    file.write_text(json.dumps({"name": name, **settings}), encoding="utf-8")
    return file
