"""A page in the user's cache: the path of the file, and how a browser opens the file."""
import hashlib
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path


def cached_page(results):
    """The file in the user's cache for a page of these results: a new page replaces the old page."""
    home = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "bendlab"
    whole = [str(Path(result).resolve()) for result in results]
    name = re.sub(r"[^A-Za-z0-9_.=-]+", "_", Path(whole[0]).name)[:60]
    return home / f"{name}-{hashlib.sha256(chr(10).join(whole).encode()).hexdigest()[:8]}.html"


def opened(address):
    """Opens a file: or http: address in a browser. False if no browser is found."""
    opener = shutil.which("open" if sys.platform == "darwin" else "xdg-open")
    if not opener or (sys.platform != "darwin"
                      and not (os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))):
        return False
    try:
        child = subprocess.run([opener, address], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                               stderr=subprocess.DEVNULL, timeout=20, check=False)
        return child.returncode == 0
    except subprocess.TimeoutExpired:  # the opener is the browser itself, which stays open
        return True
    except OSError:
        return False
