"""Runs the program on a disk with room for only a few blocks, from the start or after another program has
filled the disk. The program must report this and end, and files that it calls finished must be whole.

    disk.py PROGRAM [SIZES]      exit 1 if a run crashes, hangs or leaves a false file; 77 if no small disk
                                 can be mounted (this needs a mount in a user namespace)
"""
import subprocess
import sys
import tempfile
from pathlib import Path

from program import run_files, seal_of, write_config

SMALL = """
mount -t tmpfs -o size={size}k none disk || exit 77
timeout -s KILL 60 "$1" run sweep.json --out disk/out --jobs 1 >/dev/null 2>messages
code=$?
mkdir -p kept
cp -r disk/out kept/small-{size} 2>/dev/null
exit $code
"""

# The disk is filled after the run has started its file, except for {size} KiB.
FILLED = """
mount -t tmpfs -o size=65536k none disk || exit 77
timeout -s KILL 60 "$1" run long.json --out disk/out --jobs 1 >/dev/null 2>messages &
while [ -z "$(ls disk/out/long/*/*.part 2>/dev/null)" ]; do
  kill -0 $! || break
  sleep 0.02
done
free=$(df --output=avail -k disk | tail -n 1)
head -c $(((free - {size}) * 1024)) /dev/zero >disk/filler
wait $!
code=$?
mkdir -p kept
cp -r disk/out kept/filled-{size} 2>/dev/null
exit $code
"""


def attempt(program, folder, script):
    """(exit code, last line on stderr). Exit code 77: no small disk can be mounted."""
    done = subprocess.run(["unshare", "--user", "--map-root-user", "--mount", "bash", "-c", script, "bash",
                           program], cwd=folder, check=False, capture_output=True, text=True)
    if done.returncode == 77 or "unshare" in done.stderr:
        return 77, done.stderr
    lines = (folder / "messages").read_text(encoding="utf-8", errors="replace").splitlines()
    return done.returncode, lines[-1] if lines else ""


def main(program, sizes=16):
    wrong = refused = 0
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        (folder / "disk").mkdir()
        # A run that starts its file early, and a run that writes the whole file at its end.
        write_config(folder, "sweep", duration=1, output={"frames_per_second": 60},
                     sweep={"/mesh/cells": [24, 3]})
        write_config(folder, "long", duration=40, mesh={"cells": 24}, output={"frames_per_second": 60})
        for step in range(sizes):
            size = 4 + 4 * (step * 15 // max(1, sizes - 1))
            for name, script in (("small", SMALL), ("filled", FILLED)):
                code, text = attempt(program, folder, script.format(size=size))
                if code == 77:
                    print(f"skipped: no small disk can be mounted here ({text.strip()})")
                    return 77
                false = [file for file in run_files(folder / "kept") if seal_of(file) != "whole"]
                reported = "space" in text or "free" in text
                refused += code in (1, 5) and reported
                if false or not (code == 0 or (code in (1, 5) and reported)):
                    wrong += 1
                    print(
                        f"{name}, {size} KiB: exit code {code}, false files {list(map(str, false))}: {text}",
                        flush=True)
    print(f"{2 * sizes} disks with room for 4 to 64 KiB: {refused} runs refused, {wrong} results wrong")
    return 1 if wrong or not refused else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], *map(int, sys.argv[2:])))
