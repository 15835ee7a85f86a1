"""The origin of a page: commit, date, machine, command."""
import datetime
import platform
import subprocess
from collections import Counter
from pathlib import Path

from web.html_parts import Made

ROOT = Path(__file__).resolve().parents[2]


def made_of(runs, command):
    """The origin (Made) of a page of these runs."""
    seen = [run.provenance for run in runs if run.provenance]
    commits = Counter(_commit(provenance) for provenance in seen if provenance.get("git_commit"))
    machines = Counter(provenance["processor"] for provenance in seen if provenance.get("processor"))
    hosts = Counter(provenance["host"] for provenance in seen if provenance.get("host"))
    parts = [f"page {_here()}" if _here() else "", f"runs of {_most(commits)}" if commits else ""]
    machine = _most(machines) or platform.processor()
    return Made("; ".join(part for part in parts if part),
                datetime.datetime.now(datetime.timezone.utc).strftime("%Y-%m-%d %H:%M UTC"),
                f"{machine} ({_most(hosts)})" if hosts else machine, command)


def _most(counts):
    return ", ".join(name for name, _ in counts.most_common(3))


def _commit(provenance):
    changed = " with changes" if provenance.get("git_dirty") == "yes" else ""
    return provenance["git_commit"][:12] + changed


def _here():
    """The commit of the scripts, "" outside a checkout."""
    commit = _git("rev-parse", "--short=12", "HEAD")
    changed = commit and _git("status", "--porcelain", "--untracked-files=no")
    return commit + (" with changes" if changed else "")


def _git(*arguments):
    try:
        return subprocess.run(["git", "-C", ROOT, *arguments], capture_output=True, text=True, check=True,
                              timeout=10).stdout.strip()
    except (OSError, subprocess.SubprocessError):
        return ""
