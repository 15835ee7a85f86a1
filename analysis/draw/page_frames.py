"""Frames of runs in the project's own pages. Frames are stored only in index.html, so a new layout copies the
frames from the old index.html."""
import json
import re
from dataclasses import dataclass, field

from draw import frames

SCRIPT = re.compile(r"<script type='application/octet-stream;base64' id='([^']+)'>[^<]*</script>")
DATA = re.compile(r"id='bendlab-data'>(.*?)</script>", re.DOTALL)


@dataclass
class PageFrames:
    """The frames of the runs in a page, by the id of a run."""

    heads: dict = field(default_factory=dict)  # id → description of the frames in the page's data
    scripts: dict = field(default_factory=dict)  # id → HTML

    @property
    def data(self):
        """What a player needs in addition to the runs. Empty without frames."""
        return {"colours": frames.colours(), "quantities": frames.QUANTITIES} if self.heads else {}

    @property
    def html(self):
        return "\n".join(self.scripts.values())


def of_runs(runs, most):
    """The frames of `runs` (id → run): at most about `most` frames per run."""
    page_frames = PageFrames()
    for name, run in runs.items():
        packed = frames.pack(run, every=max(1, -(-(run.frames - 1) // (most - 1)))) if run.frames else None
        if packed:
            page_frames.heads[name], page_frames.scripts[name] = packed.head, frames.script(packed)
    return page_frames


def taken_from(file):
    """The frames in a page. Empty if the page does not exist."""
    if not file.exists():
        return PageFrames()
    text = file.read_text(encoding="utf-8")
    scripts = {match[1]: match[0] for match in SCRIPT.finditer(text)}
    data = DATA.search(text)
    runs = json.loads(data[1]).get("runs", []) if data else []
    heads = {run["id"]: run["frames"] for run in runs if run.get("frames")}
    return PageFrames(heads, {name: scripts[head["dom"]] for name, head in heads.items()})
