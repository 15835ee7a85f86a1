"""The origin of a page: commit, date, machine, command."""
import datetime
import platform
import subprocess
from collections import Counter
from pathlib import Path

from tables.section import origin_of
from web.html_parts import Made


def made_of(runs, command):
    """The origin (Made) of a page of these runs, with the commits of the scripts and of the runs."""
    origins = [origin_of(run) for run in runs]
    commits, machines, hosts = (most_frequent(origins, name) for name in ("commit", "machine", "host"))
    here = _git("rev-parse", "--short=12", "HEAD")
    changed = " with changes" if here and _git("status", "--porcelain", "--untracked-files=no") else ""
    parts = [f"page {here}{changed}" if here else "", f"runs of {commits}" if commits else ""]
    machine = machines or platform.processor()
    return Made("; ".join(filter(None, parts)),
                datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%d %H:%M UTC"),
                f"{machine} ({hosts})" if hosts else machine, command)


def most_frequent(origins, name):
    """The three most frequent texts with this name in the origins of runs."""
    counts = Counter(origin[name] for origin in origins if origin.get(name))
    return ", ".join(text for text, _ in counts.most_common(3))


def _git(*arguments):
    try:
        git = ["git", "-C", Path(__file__).parent, *arguments]
        return subprocess.run(git, capture_output=True, text=True, check=True, timeout=10).stdout.strip()
    except (OSError, subprocess.SubprocessError):
        return ""
