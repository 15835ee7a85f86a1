"""Configs, plans, run files and file names with malicious texts. No control character, and no character that
reverses the direction of text, may reach the terminal, and JSON must stay valid.

    texts.py PROGRAM      exit 1 if such a character is printed, or JSON is invalid
"""
import json
import re
import shutil
import sys
import tempfile
from pathlib import Path

from program import fresh, run, run_files, write_config  # first: it adds the scripts to the path

import h5py
import numpy as np
from bendlab.results.checksum import LENGTH, NAME, checksum
from bendlab.results.facts import Facts

# Clears the screen; sets the window's title; the same in C1; reverses the following text; rings; deletes.
EVIL = "\x1b[2J\x1b]0;x\x07\x9b2J\x9d0;x\x9c\u202eabc\u2066\u200f\u2028\x7f\r\b"
FORBIDDEN = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\u061c\u200e\u200f\u2028-\u202e\u2066-\u2069]")


def evil_copy(file, to):
    """Copies a run file twice: once with evil texts, once with invalid UTF-8. Both checksums are valid."""
    data = file.read_bytes()[:-LENGTH]
    with h5py.File(file) as run_file:
        facts = Facts(run_file).json
    facts["name"] += EVIL
    facts["config"]["bending"]["model"] = f"model{EVIL}"
    facts["provenance"] |= {"host": EVIL, f"key{EVIL}": f"value{EVIL}"}
    facts["summary"][f"number{EVIL}"] = 1.0
    text = json.dumps(facts, ensure_ascii=False).encode()
    no_utf_8 = text.replace(b"value", b"\xff\xfe\xc3(\xed\xa0\x80\x9b[2J")
    for path, text in (to / "run.vtkhdf", text), (to / "no_utf_8" / "run.vtkhdf", no_utf_8):
        path.parent.mkdir()
        path.write_bytes(data)
        with h5py.File(path, "r+") as run_file:
            del run_file["facts"]
            run_file["facts"] = np.frombuffer(text, "u1")
        path.write_bytes(path.read_bytes() + NAME + checksum(path, path.stat().st_size) + b"\n")


def places(program, folder):
    """Argument lists of commands that print texts from files."""
    write_config(folder, "good", mesh={"cells": 3}, duration=0.1)
    run(program, "run", "good.json", folder=folder)
    file, = run_files(folder / "results")
    evil_copy(file, folder / "evil")
    names = folder / f"na{EVIL}me"
    names.mkdir()
    shutil.copy(file, names / "run.vtkhdf")
    (names / f"{EVIL}.vtkhdf").write_bytes(b"no HDF5")

    write_config(folder, "config", **{
        "description": EVIL, "mesh": {"cells": 3}, "duration": 0.1, "because": {"/mesh/cells": EVIL},
        "expect": [{"metric": "drop", "max": -1, "why": EVIL}],
        "sweep": {"/mesh": [{"cells": 3}, {"file": f"mesh{EVIL}.obj"}]}})
    write_config(folder, "wrong", **{f"key{EVIL}": EVIL,
                 "mesh": {"generator": EVIL}, "sweep": {EVIL: [EVIL]}})
    shutil.copy(folder / "wrong.json", folder / f"wrong{EVIL}.json")
    (folder / "broken.json").write_text(f'{{"name": {EVIL}', encoding="utf-8")
    (folder / f"mesh{EVIL}.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", encoding="utf-8")
    (folder / "bad.obj").write_text(f"v 0 0 {EVIL}\nf {EVIL}\n", encoding="utf-8")

    planned = run(program, "plan", "good.json", "--json", "--out", "planned", folder=folder)
    planned = json.loads(planned.stdout)
    failed = fresh(folder / planned["folder"])
    (failed / "run.failure").write_text(EVIL, encoding="utf-8")

    for extra in ([], ["--json"]):
        yield ["list", "evil", *extra]
        yield ["list", names, *extra]
        yield ["list", ".", "--sort", "/bending/model", *extra]
        yield ["show", "evil/run.vtkhdf", *extra]
        yield ["show", "evil/no_utf_8/run.vtkhdf", *extra]
        yield ["compare", "evil/run.vtkhdf", file, *extra]
        yield ["compare", "evil", "results", *extra]
        yield ["rerun", "evil/run.vtkhdf", *extra]
        yield ["export", "evil/run.vtkhdf", "--format", "obj", "--force", *extra]
        yield ["stiffness", "evil/run.vtkhdf", *extra]
        yield ["run", "config.json", *extra]
        yield ["plan", "config.json", *extra]
        yield ["plan", "good.json", "--out", "planned", *extra]
        yield ["mesh", f"mesh{EVIL}.obj", *extra]
        yield ["mesh", "bad.obj", *extra]
    yield ["validate", "config.json", "wrong.json", f"wrong{EVIL}.json", "broken.json"]
    yield ["validate", "config.json", "--strict"]
    yield ["run", "wrong.json", "--set", f"/mesh/cells={EVIL}", "--set", EVIL]
    yield [EVIL]


def main(program):
    wrong = tried = 0
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        for arguments in places(program, folder):
            tried += 1
            done = run(program, *arguments, folder=folder, errors="surrogateescape")
            output = done.stdout + done.stderr
            match = FORBIDDEN.search(output) or re.search("[\udc80-\udcff]", output)
            command = " ".join(map(str, arguments)).replace(EVIL, "EVIL").replace(str(folder), ".")
            if match or done.returncode < 0:
                wrong += 1
                at = match.start() if match else 0
                print(f"{command}: exit code {done.returncode}, prints {output[max(0, at - 30):at + 30]!r}",
                      flush=True)
            try:
                lines = [json.loads(line) for line in done.stdout.splitlines() if "--json" in arguments]
                if arguments == ["list", "evil", "--json"] and lines[0]["name"] != f"good{EVIL}":
                    raise ValueError(f"the name is {lines[0]['name']!r}")
            except (ValueError, IndexError) as error:
                wrong += 1
                print(f"{command}: {error}", flush=True)
    print(f"{tried} commands, {wrong} of them with wrong output")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
