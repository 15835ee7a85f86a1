"""The scripts and the program read and write one index of a folder (runs.index), and believe it only where it
is as the files are.

    index.py PROGRAM [RUNS]      exit 1 if one of them says what the files do not say
"""
import contextlib
import io
import json
import os
import shutil
import sys
import tempfile
from pathlib import Path

from program import run, run_files, write_config  # first: it knows where the scripts are

import h5py
from bendlab.results import load
from bendlab.results.facts import Facts


def of_file(file):
    """What h5py finds in a run file."""
    with h5py.File(file, "r") as data:
        facts = Facts(data)
        metrics = dict(zip(facts.columns, data["metrics/values"][()].T))
        return {"id": facts.id, "status": facts.status,
                "summary": facts.summary, "cells": facts.config["mesh"]["cells"],
                "commit": facts.provenance["git_commit"],
                "passes": {name: seconds for name, seconds, *_ in facts.passes}, "counts": facts.counts,
                "frames": len(metrics["time"]), "drop": list(metrics["drop"])}


def of_scripts(folder):
    """The same from the scripts, by file, and what they say on stderr."""
    said = io.StringIO()
    with contextlib.redirect_stderr(said):
        runs = load.load_runs(folder)
    found = {str(each.file): {"id": each.id, "status": each.status, "summary": each.summary,
                              "cells": each.get("/mesh/cells"), "commit": each.provenance["git_commit"],
                              "passes": each.passes, "counts": each.counts, "frames": each.frames,
                              "drop": list(each.metrics["drop"])} for each in runs}
    return found, said.getvalue()


def of_program(program, folder):
    """The runs that `bendlab list` knows, by file."""
    listed = run(program, "list", folder, "--json", folder=folder)
    lines = map(json.loads, listed.stdout.splitlines())
    return {line["file"]: {"id": line["id"], "status": line["status"], "summary": line["summary"],
                           "cells": line["config"]["mesh"]["cells"],
                           "commit": line["provenance"]["git_commit"],
                           "passes": {each["name"]: each["seconds"] for each in line["passes"]},
                           "frames": line["frames"]} for line in lines}


class Checks:
    def __init__(self):
        self.wrong = 0

    def __call__(self, holds, what):
        if not holds:
            self.wrong += 1
            print(f"WRONG: {what}", flush=True)


def check_all(program, out, check, what):
    """Scripts and program say what the files say."""
    files = {str(file): of_file(file) for file in run_files(out)}
    check(of_scripts(out)[0] == files, f"{what}: the scripts say what the files do not say")
    for file in files.values():
        del file["counts"], file["drop"]
    check(of_program(program, out) == files, f"{what}: the program says what the files do not say")


def flip(file, at):
    """Changes a byte, and sets the file's time back."""
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
              "the program did not believe the scripts' index")
        index.unlink()
        of_program(program, out)
        by_program = index.stat().st_ino
        check_all(program, out, check, "with the program's index")
        check(index.stat().st_ino == by_program, "the scripts did not believe the program's index")

        # What is no run keeps none from being listed.
        whole = run_files(out)[0].read_bytes()
        for name, data in (("cut", whole[:len(whole) // 2]), ("empty", b""), ("text", b"no HDF5 at all"),
                           ("changed", whole[:-10] + b"x" + whole[-9:])):
            (out / "bad" / name).mkdir(parents=True)
            (out / "bad" / name / "run.vtkhdf").write_bytes(data)
        (out / "bad" / "pipe").mkdir()
        os.mkfifo(out / "bad" / "pipe" / "run.vtkhdf")
        check(len(of_scripts(out)[0]) == len(of_program(program, out)) == runs, "a bad file hides others")
        shutil.rmtree(out / "bad")

        # A lie that the index would be believed to tell.
        told = index.read_bytes()
        index.write_bytes(told.replace(b'"complete"', b'"diverged"', 1))
        check_all(program, out, check, "with a changed index")
        index.write_bytes(told[:len(told) // 2])
        check_all(program, out, check, "with half an index")

        first, *rest = run_files(out)
        flip(first, first.stat().st_size // 2)
        found, said = of_scripts(out)
        check(sorted(found) == sorted(map(str, rest)), "a changed file is still a run")
        check("was changed after it was written" in said, f"the scripts say of a changed file: {said!r}")
        first.write_bytes(rest[0].read_bytes())  # the file of another run
        os.utime(first, ns=(rest[0].stat().st_atime_ns, rest[0].stat().st_mtime_ns))
        found, _ = of_scripts(out)
        check(len({each["id"] for each in found.values()}) ==
              len(rest), "a replaced file is still the old run")

        # From the index alone: it is believed until something is read from the file.
        of_scripts(out)
        known = next(each for each in load.load_runs(out) if str(each.file) == str(rest[-1]))
        flip(rest[-1], rest[-1].stat().st_size // 2)
        try:
            known.metrics["drop"]
            check(False, "metrics of a changed file were read")
        except OSError:
            pass
    print(f"{check.wrong} wrong answers of the index of {runs} runs")
    return 1 if check.wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], *map(int, sys.argv[2:])))
