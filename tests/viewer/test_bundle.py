#!/usr/bin/env python3
"""The committed bundle was built from the committed sources, and has the licences of its packages."""
import hashlib
import json
import re
import sys
from pathlib import Path

VIEWER = Path(__file__).resolve().parents[2] / "analysis/viewer"


def sources_hash():
    """The hash of the sources, computed as in analysis/viewer/build.mjs."""
    files = [path.relative_to(VIEWER).as_posix() for path in (VIEWER / "src").rglob("*")
             if path.is_file() and path.suffix in (".js", ".css")]
    digest = hashlib.sha256()
    for file in sorted([*files, "build.mjs", "package-lock.json"]):
        digest.update(f"{file}\n".encode() + (VIEWER / file).read_bytes() + b"\n")
    return digest.hexdigest()


def problems():
    """A sentence for each problem of the bundle."""
    sentences, expected = [], sources_hash()
    for name in ("viewer.js", "page.js", "viewer.css"):
        first = (VIEWER / "dist" / name).read_text(encoding="utf-8").split("\n", 1)[0]
        stated = re.search(r"sources ([0-9a-f]{64})", first)
        if not stated or stated[1] != expected:
            sentences.append(f"analysis/viewer/dist/{name} was not built from the current sources: "
                             "run `npm ci && npm run build` in analysis/viewer")
    licences = (VIEWER / "dist/LICENSES.txt").read_text(encoding="utf-8")
    packages = json.loads((VIEWER / "package.json").read_text(encoding="utf-8"))["dependencies"]
    sentences += [f"dist/LICENSES.txt lacks the licence of {name} {version}"
                  for name, version in packages.items() if f"{name} {version} (" not in licences]
    for name in ("viewer.js", "page.js"):
        script = (VIEWER / "dist" / name).read_text(encoding="utf-8")
        if "</script" in script.lower() or "<!--" in script:
            sentences.append(f"dist/{name} has a text that would end its script element")
    return sentences


if __name__ == "__main__":
    for problem in problems():
        print(problem)
    sys.exit(bool(problems()))
