#!/usr/bin/env python3
"""Writes a page that has only a player, for tests and screenshots: page.py OUT.html RUN.vtkhdf…"""
import base64
import hashlib
import json
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "analysis"))

from draw.frames import playback  # noqa: E402
from bendlab.results.load import load_run  # noqa: E402

DIST = ROOT / "analysis/viewer/dist"


def write_page(path, runs, labels=None, limit=60e6):
    """Writes the page of these runs; returns its Playback."""
    player = playback(runs, limit, labels or {run.id: run.name for run in runs}, None, [])
    script, style = ((DIST / f"viewer.{kind}").read_text(encoding="utf-8") for kind in ("js", "css"))
    data = json.dumps(player.data).replace("<", "\\u003c")
    policy = (
        f"default-src 'none'; script-src '{_hash(script)}'; style-src '{_hash(style)}'; img-src data: blob:; "
        "media-src blob:")
    Path(path).write_text(
        "<!doctype html><html lang='en'><head><meta charset='utf-8'>"
        f'<meta http-equiv="Content-Security-Policy" content="{policy}">'
        "<meta name='viewport' content='width=device-width, initial-scale=1'><title>Player</title>"
        f"<style>{style}</style></head><body><main><h1>Player</h1>{player.players}</main>"
        f"<script type='application/json' id='bendlab-data'>{data}</script>\n{player.scripts}\n"
        f"<script>{script}</script></body></html>", encoding="utf-8")
    return player


def _hash(text):
    return f"sha256-{base64.b64encode(hashlib.sha256(text.encode()).digest()).decode()}"


if __name__ == "__main__":
    write_page(sys.argv[1], [load_run(run) for run in sys.argv[2:]])
