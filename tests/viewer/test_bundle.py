#!/usr/bin/env python3
"""The committed bundle is made of the committed sources, and has the licences of what is in it."""
import hashlib
import json
import re
import sys
from pathlib import Path

VIEWER = Path(__file__).resolve().parents[2] / "analysis/viewer"


def sources_hash():
    """As analysis/viewer/build.mjs computes it."""
    files = [path.relative_to(VIEWER).as_posix() for path in (VIEWER / "src").rglob("*")
             if path.is_file() and path.suffix in (".js", ".css")]
    digest = hashlib.sha256()
    for file in sorted([*files, "build.mjs", "package-lock.json"]):
        digest.update(f"{file}\n".encode() + (VIEWER / file).read_bytes() + b"\n")
    return digest.hexdigest()


def problems():
    """Sentences on what is wrong; [] if nothing is."""
    found, expected = [], sources_hash()
    for name in ("viewer.js", "page.js", "viewer.css"):
        first = (VIEWER / "dist" / name).read_text(encoding="utf-8").split("\n", 1)[0]
        told = re.search(r"sources ([0-9a-f]{64})", first)
        if not told or told[1] != expected:
            found.append(f"analysis/viewer/dist/{name} is not made of the sources that are there: "
                         "run `npm ci && npm run build` in analysis/viewer")
    licences = (VIEWER / "dist/LICENSES.txt").read_text(encoding="utf-8")
    packages = json.loads((VIEWER / "package.json").read_text(encoding="utf-8"))["dependencies"]
    found += [f"dist/LICENSES.txt lacks the licence of {name} {version}"
              for name, version in packages.items() if f"{name} {version} (" not in licences]
    for name in ("viewer.js", "page.js"):
        script = (VIEWER / "dist" / name).read_text(encoding="utf-8")
        if "</script" in script.lower() or "<!--" in script:
            found.append(f"dist/{name} holds a text that would end its script element")
    return found


if __name__ == "__main__":
    for problem in problems():
        print(problem)
    sys.exit(bool(problems()))
