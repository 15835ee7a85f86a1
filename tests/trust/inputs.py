"""Inputs that are too much, or no files at all: each is refused at once, in words that say what is allowed.

    inputs.py PROGRAM [SIZE]      exit 1 if one is not; SIZE values, keys, entries
"""
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

from program import run, write_config

PATIENCE = 10  # s


def configs(folder, size):
    """(name, what its refusal says) of configs with too much of something."""
    flat = [{"type": "gravity"}]
    numbers = [0.1 + 1e-9 * step for step in range(size)]
    every = {f"/k{step}": [1] for step in range(size)}
    too_much = {
        "values": ({"sweep": {"/material/density": numbers}}, "at most 10000 runs"),
        "lists": ({"sweep": {"/effects": [flat] * size}}, "at most 10000 runs"),
        "covered": ({"sweep": {"/material/density": numbers, "/mesh/cells": [3, 4]}, "cover": 2},
                    "at most 10000 runs"),
        "axes": ({"sweep": every}, "more than 1000 keys"),
        "keys": ({f"k{step}": 1 for step in range(size)}, "more than 1000 keys"),
        "reasons": ({"because": dict.fromkeys(every, "why")}, "more than 1000 keys"),
        "expectations": ({"expect": [{"metric": "drop", "max": 1, "why": "why"}] * size}, "at most 1000"),
        "effects": ({"effects": flat * size}, "at most 1000"),
        "pins": ({"pins": {"vertices": list(range(size))}}, "and "),
        "long": ({"name": "n" * size}, "may have 100"),
        "rate": ({"output": {"frames_per_second": 1e12}}, "/output/frames_per_second"),
        "slow": ({"duration": 1e18}, "steps of /solver/dt"),
    }
    for name, (settings, told) in too_much.items():
        write_config(folder, name, **{key: value for key, value in settings.items() if key != "name"})
        if "name" in settings:
            (folder / f"{name}.json").write_text(json.dumps(settings), encoding="utf-8")
        yield f"{name}.json", told
    (folder / "twice.json").write_text('{"name": "t"' + ', "a": 1' * size + "}", encoding="utf-8")
    yield "twice.json", "there twice"
    (folder / "deep.json").write_text("[" * size, encoding="utf-8")
    yield "deep.json", "nested deeper"


def no_files(folder):
    """(path, what is said of it)."""
    os.mkfifo(folder / "pipe")
    (folder / "folder").mkdir()
    (folder / "round").symlink_to("about")
    (folder / "about").symlink_to("round")
    return [("pipe", "is a pipe or a device"), ("/dev/zero", "is a pipe or a device"),
            ("folder", "is a folder"),
            ("round", "is a link that leads back to itself"), ("n" * 300, "has too long a name"),
            ("nothing", "No such file")]


def main(program, size=300000):
    wrong = tried = 0

    def check(arguments, code, told):
        nonlocal wrong, tried
        tried += 1
        shown = " ".join(each if len(each) < 60 else f"{each[:20]}…" for each in arguments)
        try:
            done = run(program, *arguments, folder=folder, timeout=PATIENCE)
        except subprocess.TimeoutExpired:
            wrong += 1
            print(f"{shown}: takes more than {PATIENCE} s", flush=True)
            return
        if done.returncode != code or told not in done.stderr or len(done.stderr) > 100000:
            wrong += 1
            print(f"{shown}: exit code {done.returncode}, {len(done.stderr)} bytes: {done.stderr[:300]}",
                  flush=True)

    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        for name, told in configs(folder, size):
            check(["validate", name], 3, told)
        write_config(folder, "tiny", duration=0.1)
        for path, told in no_files(folder):
            check(["validate", path], 3, told)
            check(["mesh", path], 5, told)
            for command in ("run", "validate"):
                check([command, "tiny.json", "--set", f"/mesh/file={path}"], 5, told)
            check(["run",
                   "tiny.json",
                   "--set",
                   f'/effects=[{{"type": "gravity"}}, {{"type": "mesh_obstacle", "file": "{path}"}}]'],
                  5,
                  told)
            check(["status", path], 5, "")
            check(["show", path], 2, "is no run file")
    print(f"{tried} inputs, {wrong} of them not refused as they should be")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], *map(int, sys.argv[2:])))
