"""A program that was built from sources with uncommitted changes keeps these changes, so that its sources can
be restored from the commit. A run names the changes.

    changes.py PROGRAM      exit 1 if not; 77 without git or cmake
"""
import gzip
import json
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from program import run, write_config

SOURCE = Path(__file__).resolve().parents[2]


def git(folder, *arguments, **options):
    return subprocess.run(["git", "-c", "user.name=a", "-c", "user.email=a@b", *arguments], cwd=folder,
                          check=True, capture_output=True, **options).stdout


def built_in(folder, header):
    """(hash, patch) that version.cmake derives from a checkout."""
    subprocess.run(["cmake", f"-DSOURCE={folder}", f"-DOUTPUT={header}", "-DVERSION=1", "-DCOMPILER=c",
                    "-DFLAGS=f", "-DBUILD_TYPE=b", "-P", SOURCE / "experiments/version.cmake"], check=True,
                   capture_output=True)
    text = (header.parent / "bendlab_changes.hpp").read_text(encoding="utf-8")
    values = re.search(r"changes\[\] = \{(.*)\}", text)[1].split(",")
    assert values.pop() == "0"  # so that no array is empty
    packed = bytes(int(value, 16) for value in values)
    return re.search(r'changes_hash\[\] = "(.*)"', text)[1], gzip.decompress(packed) if packed else b""


def tree(folder):
    return {path.relative_to(folder): path.read_bytes() for path in sorted(folder.glob("**/*"))
            if path.is_file() and ".git" not in path.relative_to(folder).parts}


def main(program):
    if not (shutil.which("git") and shutil.which("cmake")):
        print("skipped: there is no git or no cmake")
        return 77
    wrong = []
    with tempfile.TemporaryDirectory() as place:
        checkout, header = Path(place) / "checkout", Path(place) / "header" / "bendlab_version.hpp"
        header.parent.mkdir()
        (checkout / "lib/bendlab").mkdir(parents=True)
        (checkout / "experiments/run").mkdir(parents=True)
        (checkout / "CMakeLists.txt").write_text("# nothing\n")
        source = checkout / "lib/bendlab/one.cpp"
        source.write_text('const char* text = "a;b[c] ${d} \\\\";\n', encoding="utf-8")
        (checkout / "experiments/run/two.cpp").write_text("int two = 2;\n")
        git(checkout, "init", "-q")
        git(checkout, "add", ".")
        git(checkout, "commit", "-qm", "one")
        if built_in(checkout, header) != ("", b""):
            wrong.append("a checkout without changes has changes")
        source.write_text('const char* text = "ä;;[x]] ${e} \\\\ \\"";\n', "utf-8")
        (checkout / "experiments/run/two.cpp").unlink()
        (checkout / "experiments/run/not yet known.cpp").write_text("int three = 3;\n")
        (checkout / "lib/bendlab/picture.bin").write_bytes(bytes(range(256)))
        first, patch = built_in(checkout, header)
        clone = Path(place) / "clone"
        git(place, "clone", "-q", checkout, clone)
        git(clone, "apply", "-", input=patch)
        if tree(clone) != tree(checkout):
            wrong.append("the commit and its patch do not give the sources")
        (checkout / "CMakeLists.txt").write_text("# something\n")
        if built_in(checkout, header)[0] == first:
            wrong.append("different changes have the same name")

        write_config(place, "tiny", mesh={"cells": 3}, duration=0.1)
        done = run(program, "run", "tiny.json", folder=place)
        provenance = json.loads(run(program, "list", "--json", folder=place).stdout)["provenance"]
        named = provenance.get("git_changes")
        if done.returncode or (provenance["git_dirty"] == "yes") != bool(named):
            wrong.append(f"dirty {provenance['git_dirty']}, changes {named}")
        kept = Path(place) / "results" / str(named)
        if named and not gzip.decompress(kept.read_bytes()).startswith(b"diff --git"):
            wrong.append("the patch in the results is no patch")
    print("\n".join(wrong) or "the changes since the commit are kept")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
