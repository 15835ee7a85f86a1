"""Imported first by scripts that people call: a Python without the libraries hands over to one with them."""
import importlib.util
import os
import re
import subprocess
import sys
from pathlib import Path

NEEDED = ("numpy", "h5py", "matplotlib")
BUILD = Path(__file__).resolve().parent.parent / "build"


def missing():
    """The libraries that this Python lacks."""
    return [name for name in NEEDED if importlib.util.find_spec(name) is None]


def other_pythons():
    """Other Pythons that may have the libraries: the Python that the build found, and the system's."""
    caches = [cache.read_text(encoding="utf-8") for cache in sorted(BUILD.glob("*/CMakeCache.txt"))]
    named = [match[1] for text in caches if (match := re.search(r"^BENDLAB_PYTHON:\w+=(.+)$", text, re.M))]
    return [python for python in dict.fromkeys([*named, "/usr/bin/python3"]) if Path(python).exists()]


def has_all(python):
    """Whether another Python has the libraries."""
    return subprocess.run([python, "-c", f"import {', '.join(NEEDED)}"], capture_output=True,
                          check=False).returncode == 0


def hand_over():
    """Continues in another Python if this Python lacks a library; ends with advice if no Python has all."""
    lacking = missing()
    if not lacking:
        return
    for python in other_pythons():
        if has_all(python):
            os.execv(python, [python, *sys.argv])
    sys.exit(f"{sys.argv[0]}: this Python, {sys.executable}, has no {', '.join(lacking)}, and no other was "
             "found that has; on Debian: apt-get install python3-numpy python3-h5py python3-matplotlib")


# With small matrices OpenBLAS threads wait for each other: 100 times as slow on a busy machine.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
hand_over()
