"""Runs the program with little memory (ulimit -v). It must work, or report that memory is missing and end.

    memory.py PROGRAM [LIMITS]      exit 1 if a run crashes or hangs; 77 if no limit is enough
"""
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

from program import run_files, seal_of, write_config

LEAST, MOST = 40, 640  # MiB of address space: from too little for loading to enough
STARTS = 220  # MiB: with less memory, libraries may end the program while it is loaded
TIME_LIMIT = 60  # s


def attempt(program, folder, mebibytes):
    """(exit code, stderr); None for the code if it hangs."""
    limit = mebibytes << 20
    try:
        done = subprocess.run([program,
                               "run",
                               "sweep.json",
                               "--jobs",
                               "2",
                               "--force"],
                              cwd=folder,
                              check=False,
                              capture_output=True,
                              text=True,
                              timeout=TIME_LIMIT,
                              stdin=subprocess.DEVNULL,
                              preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS,
                                                                    (limit,
                                                                     limit)))
        return done.returncode, done.stderr
    except subprocess.TimeoutExpired:
        return None, ""


def main(program, limits=16):
    wrong = done = 0
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        write_config(folder, "sweep", mesh={"cells": 10}, duration=0.2,
                     sweep={"/solver/substeps": [1, 2, 3]})
        for step in range(limits):
            limit = LEAST + step * (MOST - LEAST) // max(1, limits - 1)
            code, text = attempt(program, folder, limit)
            done += code == 0
            # During loading, a library without memory may end the process with any exit code.
            ends_well = code is not None and 0 <= code <= 6
            in_loading = limit < STARTS and code is not None
            if not (ends_well or in_loading) or any(seal_of(file) != "whole" for file in run_files(folder)):
                wrong += 1
                print(f"{limit} MiB: {'hangs' if code is None else f'exit code {code}'}: {text[-300:]}",
                      flush=True)
    print(f"{limits} limits of memory: {done} runs had enough, {wrong} ended wrongly")
    return 1 if wrong else 0 if done else 77  # under the address sanitizer no limit is enough


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], *map(int, sys.argv[2:])))
