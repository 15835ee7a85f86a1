"""A file system without locks, imitated by a library that is loaded before the C library. The program must
refuse to compute, because two processes could compute the same run, and must still read finished runs.

    locks.py PROGRAM      exit 1 if not; 77 without a C compiler
"""
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from program import fresh, run, run_files, write_config

NO_LOCKS = """
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdarg.h>

int fcntl(int file, int command, ...) {
  va_list arguments;
  va_start(arguments, command);
  void *argument = va_arg(arguments, void *);
  va_end(arguments);
  if (command == F_OFD_SETLK || command == F_OFD_GETLK) {
    errno = %s;
    return -1;
  }
  return ((int (*)(int, int, ...))dlsym(RTLD_NEXT, "fcntl"))(file, command, argument);
}

int fcntl64(int, int, ...) __attribute__((alias("fcntl")));
"""
# of NFS without a lock server, of Lustre without its option flock, of other disks, of old kernels
ERRORS = ("ENOLCK", "ENOSYS", "ENOTSUP", "EINVAL")


def wrong_with(program, folder, library):
    """The problem without locks, or "" if there is none."""
    environment = {"LD_PRELOAD": str(library)}
    fresh(folder / "out")
    done = run(program, "run", "tiny.json", "--out", "out", folder=folder, env=environment)
    if done.returncode != 5 or "run.lock" not in done.stderr or "NFS" not in done.stderr:
        return f"exit code {done.returncode}: {done.stderr}"
    if run_files(folder / "out"):
        return "the run was computed"
    done = run(program, "run", "tiny.json", "--out", "whole", folder=folder, env=environment)
    return f"a finished run is not reused: {done.stderr}" if done.returncode else ""


def main(program):
    compiler = shutil.which("cc") or shutil.which("gcc")
    if not compiler:
        print("skipped: there is no C compiler")
        return 77
    wrong = 0
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        write_config(folder, "tiny", mesh={"cells": 3}, duration=0.1)
        run(program, "run", "tiny.json", "--out", "whole", folder=folder)
        for error in ERRORS:
            (folder / "no_locks.c").write_text(NO_LOCKS % error, encoding="utf-8")
            library = folder / f"{error}.so"
            subprocess.run([compiler, "-shared", "-fPIC", "-o", library, folder / "no_locks.c"], check=True)
            if why := wrong_with(program, folder, library):
                wrong += 1
                print(f"{error}: {why}", flush=True)
    print(f"{len(ERRORS)} file systems without locks, {wrong} of them not told")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
