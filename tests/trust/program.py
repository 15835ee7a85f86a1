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
    """A finished `bendlab ARGUMENTS` in `folder`."""
    return subprocess.run([program, *map(str, arguments)], cwd=folder, text=True, capture_output=True,
                          stdin=subprocess.DEVNULL, check=False, **options)


def start(program, *arguments, folder):
    return subprocess.Popen([program, *map(str, arguments)], cwd=folder, text=True, stdin=subprocess.DEVNULL,
                            stdout=subprocess.PIPE, stderr=subprocess.PIPE)


def fresh(folder):
    """The folder, empty."""
    shutil.rmtree(folder, ignore_errors=True)
    Path(folder).mkdir(parents=True)
    return Path(folder)


def run_files(out):
    return sorted(Path(out).glob("**/run.vtkhdf"))


def times_gone_on(file):
    """How often the run of a file went on from a checkpoint."""
    with h5py.File(file, "r") as run_file:
        times = Facts(run_file).provenance.get("went_on_at", "")
    return len(times.split(",")) if times else 0


def differences(one, other):
    """Names of what differs between two run files, but for times: datasets to the bit, summary, status."""
    found = []
    with h5py.File(one, "r") as a, h5py.File(other, "r") as b:
        names = [set(), set()]
        for file, seen in ((a, names[0]), (b, names[1])):
            file.visititems(lambda name, node: seen.add(name) if isinstance(node, h5py.Dataset) else None)
        for name in sorted(names[0] | names[1]):
            if name in ("facts", "outcome"):
                continue
            if name not in a or name not in b:
                found.append(name)
            elif a[name].dtype == object:
                found += [name] if a[name][()].tolist() != b[name][()].tolist() else []
            elif a[name].shape != b[name].shape or a[name][()].tobytes() != b[name][()].tobytes():
                found.append(name)
        facts = [Facts(file) for file in (a, b)]
        summaries = [each.summary for each in facts]
        for key in sorted(summaries[0].keys() | summaries[1].keys()):
            values = [np.asarray(summary.get(key, "none")).tobytes() for summary in summaries]
            found += [f"summary {key}"] if values[0] != values[1] else []
        found += ["status"] if facts[0].status != facts[1].status else []
        found += ["config"] if facts[0].config != facts[1].config else []
        counts = [[(name, *counts) for name, _, *counts in each.passes] for each in facts]
        found += ["calls of passes"] if counts[0] != counts[1] else []
    return found


def write_config(folder, name, **settings):
    file = Path(folder) / f"{name}.json"
    file.write_text(json.dumps({"name": name, **settings}), encoding="utf-8")
    return file
