"""Replaces every file that the program writes by a link to another file. The program must not change that
other file.

    links.py PROGRAM [ROUNDS]      exit 1 if the program writes through a link
"""
import shutil
import sys
import tempfile
from pathlib import Path

from program import fresh, run, write_config

OLD_NAMES = ("run.vtkhdf", "run.vtkhdf.part", "run.xdmf", "run.checkpoint", "run.failure", "runs.index")
PRECIOUS = b"of somebody else\n"


def work(program, folder):
    """Runs all commands that write files: runs (two of them fail), index, rerun, exports."""
    configs = ("sweep.json", "--out", "out")
    run(program, "run", *configs, folder=folder)
    run(program, "run", *configs, "--force", "--checkpoint", "0.001", folder=folder)
    run(program, "plan", *configs, folder=folder)
    run(program, "list", "out", folder=folder)
    files = sorted((folder / "out").glob("sweep/cells=3*/run.vtkhdf"))
    if files and not files[0].is_symlink():
        run(program, "rerun", files[0], "--out", "out/again", folder=folder)
        for kind in ("csv", "obj", "ply", "pc2", "usda", "xdmf"):
            run(program, "export", files[0], "--format", kind, "--force", folder=folder)


def names_in(folder):
    """All files except run.lock: if that is a link, no run is computed (tests/io/folder_lock_test.cpp)."""
    return sorted(path.relative_to(folder) for path in folder.glob("**/*")
                  if not path.is_dir() and path.name != "run.lock")


def main(program, rounds=1):
    wrong = tried = 0
    with tempfile.TemporaryDirectory() as place:
        inputs, folder = fresh(Path(place) / "inputs"), Path(place) / "work"
        write_config(inputs, "sweep", duration=0.3,
                     sweep={"/mesh": [{"cells": 3}, {"cells": 20}, {"file": "point.obj"}]})
        (inputs / "point.obj").write_text("v 0 0 0\n", encoding="utf-8")  # a run that fails
        for _ in range(rounds):
            shutil.rmtree(folder, ignore_errors=True)
            shutil.copytree(inputs, folder)
            work(program, folder)
            out = folder / "out"
            names = {*names_in(out), *(subfolder.relative_to(out) / old for subfolder in out.glob("**")
                                       for old in OLD_NAMES)}
            tried += len(names)
            elsewhere = fresh(folder / "elsewhere")
            shutil.rmtree(out)
            for count, name in enumerate(sorted(names)):
                (elsewhere / str(count)).write_bytes(PRECIOUS)
                (out / name).parent.mkdir(parents=True, exist_ok=True)
                (out / name).symlink_to(elsewhere / str(count))
            # A link to a missing file, which would be created.
            (out / "sweep.sweep.json").symlink_to(elsewhere / "made")
            work(program, folder)
            for count, name in enumerate(sorted(names)):
                if (elsewhere / str(count)).read_bytes() != PRECIOUS:
                    wrong += 1
                    print(f"the program wrote through the link {name}", flush=True)
            if len(list(elsewhere.iterdir())) != len(names):
                wrong += 1
                print(f"new elsewhere: {sorted(path.name for path in elsewhere.iterdir())[-1]}", flush=True)
    print(f"{tried} links, {wrong} of them followed")
    return 1 if wrong or tried < 20 * rounds else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], *map(int, sys.argv[2:])))
