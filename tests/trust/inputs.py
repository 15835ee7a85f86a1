"""Inputs that are too large or are no regular files are refused at once. The message says what is allowed.

    inputs.py PROGRAM [SIZE]      exit 1 if an input is not refused; lists have SIZE values, keys or entries
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
    """(name, part of the message) for configs that are too large in some way."""
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
        "long": ({"name": "n" * size}, "may have at most 100"),
        "rate": ({"output": {"frames_per_second": 1e12}}, "/output/frames_per_second"),
        "slow": ({"duration": 1e18}, "steps of /solver/dt"),
    }
    for name, (settings, message) in too_much.items():
        write_config(folder, name, **{key: value for key, value in settings.items() if key != "name"})
        if "name" in settings:
            (folder / f"{name}.json").write_text(json.dumps(settings), encoding="utf-8")
        yield f"{name}.json", message
    (folder / "twice.json").write_text('{"name": "t"' + ', "a": 1' * size + "}", encoding="utf-8")
    yield "twice.json", "this key twice"
    (folder / "deep.json").write_text("[" * size, encoding="utf-8")
    yield "deep.json", "nested deeper"


def no_files(folder):
    """(path, part of the message) for paths that are no regular files."""
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

    def check(arguments, code, message):
        nonlocal wrong, tried
        tried += 1
        command = " ".join(word if len(word) < 60 else f"{word[:20]}…" for word in arguments)
        try:
            done = run(program, *arguments, folder=folder, timeout=PATIENCE)
        except subprocess.TimeoutExpired:
            wrong += 1
            print(f"{command}: takes more than {PATIENCE} s", flush=True)
            return
        if done.returncode != code or message not in done.stderr or len(done.stderr) > 100000:
            wrong += 1
            print(f"{command}: exit code {done.returncode}, {len(done.stderr)} bytes: {done.stderr[:300]}",
                  flush=True)

    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        for name, message in configs(folder, size):
            check(["validate", name], 3, message)
        write_config(folder, "tiny", duration=0.1)
        for path, message in no_files(folder):
            check(["validate", path], 3, message)
            check(["mesh", path], 5, message)
            for command in ("run", "validate"):
                check([command, "tiny.json", "--set", f"/mesh/file={path}"], 5, message)
            check(["run",
                   "tiny.json",
                   "--set",
                   f'/effects=[{{"type": "gravity"}}, {{"type": "mesh_obstacle", "file": "{path}"}}]'],
                  5,
                  message)
            check(["show", path], 2, "is not a run file")
    print(f"{tried} inputs, {wrong} of them not refused properly")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], *map(int, sys.argv[2:])))
