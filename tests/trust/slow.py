"""A separate process reads each file without a checksum. If it never ends, it is stopped after ten seconds,
and the file is reported; all other runs are listed.

    slow.py PROGRAM      exit 1 if not; 77 if every such process ended before it could be stopped
"""
import os
import shutil
import signal
import sys
import tempfile
import time
from pathlib import Path

from program import run, run_files, start, write_config

FILES = 12
ENOUGH = 30  # s


def child_of(parent):
    """The process number of a reader that `parent` started, or None."""
    for entry in Path("/proc").iterdir():
        if not entry.name.isdigit():
            continue
        try:
            words = (entry / "cmdline").read_bytes().split(b"\0")
            above = int((entry / "stat").read_text().rsplit(")", 1)[1].split()[1])
        except (OSError, IndexError):
            continue
        if above == parent and b"read-file" in words:
            return int(entry.name)
    return None


def stop_one(process):
    """Stops a reader of this process, as if it never ended. False if all readers ended before."""
    while process.poll() is None:
        if reader := child_of(process.pid):
            try:
                os.kill(reader, signal.SIGSTOP)
                return True
            except ProcessLookupError:
                pass
    return False


def main(program):
    with tempfile.TemporaryDirectory() as place:
        write_config(place, "tiny", mesh={"cells": 3}, duration=0.1)
        run(program, "run", "tiny.json", folder=place)
        whole = run_files(place)[0]
        for number in range(FILES):  # without its last bytes the checksum does not count
            copy = whole.parent.with_name(f"unsealed{number}")
            copy.mkdir()
            shutil.copy(whole, copy / "run.vtkhdf")
            os.truncate(copy / "run.vtkhdf", whole.stat().st_size - 8)
        process = start(program, "list", folder=place)
        if not stop_one(process):
            print("skipped: every reader ended before it could be stopped")
            return 77
        begun = time.monotonic()
        out, errors = process.communicate(timeout=ENOUGH)
        took = time.monotonic() - begun
    reports = errors.count("has not read it within")
    good = reports == 1 and 8 < took < ENOUGH and "complete" in out
    print(f"a reader without end was stopped after {took:.1f} s and reported {reports} times"
          + ("" if good else f": {errors}{out}"))
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
