"""Imported first by scripts for users: starts another Python if this Python lacks a library."""
import importlib.util
import os
import re
import subprocess
import sys
from pathlib import Path

NEEDED = ("numpy", "h5py", "matplotlib")
BUILD = Path(__file__).resolve().parent.parent / "build"


def other_pythons():
    """Other Pythons that may have the libraries: the Python that the build found, and /usr/bin/python3."""
    caches = [cache.read_text(encoding="utf-8") for cache in sorted(BUILD.glob("*/CMakeCache.txt"))]
    named = [match[1] for text in caches if (match := re.search(r"^BENDLAB_PYTHON:\w+=(.+)$", text, re.M))]
    return [python for python in dict.fromkeys([*named, "/usr/bin/python3"]) if Path(python).exists()]


def hand_over():
    """Restarts the script in another Python if this Python lacks a library; exits if no Python has all."""
    lacking = [name for name in NEEDED if importlib.util.find_spec(name) is None]
    if not lacking:
        return
    for python in other_pythons():
        imports = [python, "-c", f"import {', '.join(NEEDED)}"]
        if subprocess.run(imports, capture_output=True, check=False).returncode == 0:
            os.execv(python, [python, *sys.argv])
    sys.exit(f"{sys.argv[0]}: this Python, {sys.executable}, lacks {', '.join(lacking)}, and no other Python "
             "with all libraries was found. On Debian, install them with: apt-get install python3-numpy "
             "python3-h5py python3-matplotlib")


# With small matrices OpenBLAS threads wait for each other: 100 times as slow on a busy machine.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
hand_over()
