"""The scripts and the program read and write the same index of a folder (runs.index), and use it only if it
agrees with the files.

    index.py PROGRAM [RUNS]      exit 1 if the scripts or the program disagree with the files
"""
import contextlib
import io
import json
import os
import shutil
import sys
import tempfile
from pathlib import Path

from program import run, run_files, write_config  # first: it adds the scripts to the path

import h5py
from bendlab.results import load
from bendlab.results.facts import Facts


def of_file(file):
    """The contents of a run file according to h5py."""
    with h5py.File(file, "r") as data:
        facts = Facts(data)
        metrics = dict(zip(facts.columns, data["metrics/values"][()].T))
        return {"id": facts.id, "status": facts.status,
                "summary": facts.summary, "cells": facts.config["mesh"]["cells"],
                "commit": facts.provenance["git_commit"],
                "passes": {name: seconds for name, seconds, *_ in facts.passes}, "counts": facts.counts,
                "frames": len(metrics["time"]), "drop": list(metrics["drop"])}


def of_scripts(folder):
    """{file: contents} according to the scripts, and their output on stderr."""
    errors = io.StringIO()
    with contextlib.redirect_stderr(errors):
        runs = load.load_runs(folder)
    contents = {str(record.file): {"id": record.id, "status": record.status, "summary": record.summary,
                                    "cells": record.get("/mesh/cells"),
                                    "commit": record.provenance["git_commit"], "passes": record.passes,
                                    "counts": record.counts, "frames": record.frames,
                                    "drop": list(record.metrics["drop"])} for record in runs}
    return contents, errors.getvalue()


def of_program(program, folder):
    """{file: contents} according to `bendlab list`."""
    listed = run(program, "list", folder, "--json", folder=folder)
    lines = map(json.loads, listed.stdout.splitlines())
    return {line["file"]: {"id": line["id"], "status": line["status"], "summary": line["summary"],
                           "cells": line["config"]["mesh"]["cells"],
                           "commit": line["provenance"]["git_commit"],
                           "passes": {step["name"]: step["seconds"] for step in line["passes"]},
                           "frames": line["frames"]} for line in lines}


class Checks:
    def __init__(self):
        self.wrong = 0

    def __call__(self, holds, what):
        if not holds:
            self.wrong += 1
            print(f"WRONG: {what}", flush=True)


def check_all(program, out, check, what):
    """Checks that the scripts and the program agree with the files."""
    files = {str(file): of_file(file) for file in run_files(out)}
    check(of_scripts(out)[0] == files, f"{what}: the scripts disagree with the files")
    for file in files.values():
        del file["counts"], file["drop"]
    check(of_program(program, out) == files, f"{what}: the program disagrees with the files")


def flip(file, at):
    """Changes a byte, and restores the time of the file."""
    before = file.stat()
    data = bytearray(file.read_bytes())
    data[at] ^= 1
    with open(file, "r+b") as changed:
        changed.write(data)
    os.utime(file, ns=(before.st_atime_ns, before.st_mtime_ns))


def main(program, runs=6):
    check = Checks()
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        write_config(folder, "sweep", duration=0.2, sweep={"/mesh/cells": list(range(2, 2 + runs))})
        done = run(program, "run", "sweep.json", "--out", "out", folder=folder)
        if done.returncode:
            raise SystemExit(done.stderr)
        out = folder / "out"
        index = out / "runs.index"

        check_all(program, out, check, "without an index")
        check(index.is_file(), "the scripts wrote no index")
        by_scripts = index.stat()
        check_all(program, out, check, "with the scripts' index")
        check(index.stat() == by_scripts or index.stat().st_ino == by_scripts.st_ino,
              "the program did not use the scripts' index")
        index.unlink()
        of_program(program, out)
        by_program = index.stat().st_ino
        check_all(program, out, check, "with the program's index")
        check(index.stat().st_ino == by_program, "the scripts did not use the program's index")

        # Files that are no runs must not prevent the listing of runs.
        whole = run_files(out)[0].read_bytes()
        for name, data in (("cut", whole[:len(whole) // 2]), ("empty", b""), ("text", b"no HDF5 at all"),
                           ("changed", whole[:-10] + b"x" + whole[-9:])):
            (out / "bad" / name).mkdir(parents=True)
            (out / "bad" / name / "run.vtkhdf").write_bytes(data)
        (out / "bad" / "pipe").mkdir()
        os.mkfifo(out / "bad" / "pipe" / "run.vtkhdf")
        check(len(of_scripts(out)[0]) == len(of_program(program, out)) == runs, "a bad file hides other runs")
        shutil.rmtree(out / "bad")

        # A false index must not be used.
        data = index.read_bytes()
        index.write_bytes(data.replace(b'"complete"', b'"diverged"', 1))
        check_all(program, out, check, "with a changed index")
        index.write_bytes(data[:len(data) // 2])
        check_all(program, out, check, "with half an index")

        first, *rest = run_files(out)
        flip(first, first.stat().st_size // 2)
        listed, errors = of_scripts(out)
        check(sorted(listed) == sorted(map(str, rest)), "a changed file still counts as a run")
        check("was changed after it was written" in errors, f"of a changed file the scripts say: {errors!r}")
        first.write_bytes(rest[0].read_bytes())  # the file of another run
        os.utime(first, ns=(rest[0].stat().st_atime_ns, rest[0].stat().st_mtime_ns))
        listed, _ = of_scripts(out)
        check(len({contents["id"] for contents in listed.values()}) ==
              len(rest), "a replaced file still counts as the old run")

        # The index alone is trusted until data are read from the file.
        of_scripts(out)
        known = next(record for record in load.load_runs(out) if str(record.file) == str(rest[-1]))
        flip(rest[-1], rest[-1].stat().st_size // 2)
        try:
            known.metrics["drop"]
            check(False, "metrics of a changed file were read")
        except OSError:
            pass
    print(f"{check.wrong} wrong answers from the index of {runs} runs")
    return 1 if check.wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], *map(int, sys.argv[2:])))
