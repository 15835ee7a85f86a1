"""What the player of a page needs: the frames of runs, compressed, and the colours of the cloth.

    shown = playback(runs, limit, labels, most, offered)
    shown.data      {"colours": …, "quantities": […], "runs": [{"id", "label", "name", "status", "frames"}]}
    shown.scripts   HTML: the frames of every run that recorded frames
    shown.players   HTML: a player of these runs (place_html)

analysis/viewer/README.md describes this data. Lengths in m, times in s.
"""
import base64
import html
import json
import math
import re
from collections import namedtuple
from dataclasses import dataclass, field

import matplotlib
import numpy as np
from matplotlib.colors import to_hex

from bendlab.results.load import Run
from draw import cloth, render
from draw.frame_coding import LEVELS, PARENTS, deflated, encode, lineage
from runs import obstacles
from tables import looks

# most vertices times frames of the runs that a page offers in addition; packing takes about 6 s
MOST_OFFERED = 1_000_000
MOST_SPRINGS = 400_000  # a run with more springs shows none in the page
FLOWN_APART = 50  # sizes at rest; a frame with a larger box would leave too few digits for the other frames
FAR = 1e-4  # edge lengths; if single precision rounds more, positions are relative to a point near the cloth
SCRIPT = re.compile(r"<script type='application/octet-stream;base64' id='([^']+)'>[^<]*</script>")
DATA = re.compile(r"id='bendlab-data'>(.*?)</script>", re.DOTALL)
Playback = namedtuple("Playback", "data scripts players")  # runs ready for a page
# The frames of one run: a description for JSON, and the bytes. The first frame comes first in the bytes, so
# that the page can draw it before the others are read.
Packed = namedtuple("Packed", "head data")


def playback(runs, limit, labels, most, offered):
    """Playback of runs. `labels`: id → name in the page.

    If all frames exceed `limit` bytes, or a run has more than `most` frames (if `most` is not None), frames
    are left out at equal intervals, and a note says this. `offered`: more runs that a reader can choose. Runs
    are added in order until MOST_OFFERED or `limit` is reached.
    """
    size_of = lambda frames: 4 / 3 * len(frames.data) if frames else 0
    every = {run.id: math.ceil(run.frames / most) if most else 1 for run in runs}
    packed = {run.id: pack(run, every[run.id]) for run in runs}
    size = sum(map(size_of, packed.values()))
    if size > limit:
        more = math.ceil(size / limit)
        packed = {run.id: pack(run, more * every[run.id]) for run in runs}
        size /= more
    places = 0
    for run in offered:
        places += run.frames * len(run.rest_positions)
        frames = pack(run) if places <= MOST_OFFERED else None
        size += size_of(frames)
        if not frames or size > limit:
            break
        packed[run.id] = frames
    shown, runs = len(runs), [*runs, *(run for run in offered if run.id in packed)]
    data = {"colours": colours(), "quantities": QUANTITIES,
            "runs": [{"id": run.id, "label": labels[run.id], "name": run.name, "status": run.status,
                      "frames": packed[run.id].head if packed[run.id] else None,
                      "remedy": None if packed[run.id] else "The cloth is not finite or has flown apart."}
                     for run in runs]}
    scripts = "\n".join(script(frames) for frames in packed.values() if frames)
    return Playback(data, scripts, place_html((run.id for run in runs), shown if len(runs) > shown else 0))


def place_html(ids, shown=0):
    """The HTML element of a player of the runs with these ids. The page also needs their data and scripts.
    `shown`: how many of the runs are shown at first; 0 for all."""
    names, first = html.escape(" ".join(ids), quote=True), f" data-shown='{shown}'" if shown else ""
    return (f"<div class='player' data-runs='{names}'{first}><p class='player-fallback'>The cloth moves here "
            "in a browser with JavaScript and WebGL 2.</p></div>")


def script(packed):
    return (f"<script type='application/octet-stream;base64' id='{packed.head['dom']}'>"
            f"{base64.b64encode(packed.data).decode()}</script>")


# --- colours and quantities --------------------------------------------------------------------------------

def colours():
    """The colour maps of figures, as 256 hexadecimal colours each, and the light of figures."""
    maps = {"stretch": cloth.STRETCH, "sequence": matplotlib.colormaps["viridis"],
            "quality": matplotlib.colormaps["cividis"], "difference": matplotlib.colormaps["RdBu_r"]}
    return {"maps": {name: "".join(to_hex(colour)[1:] for colour in colour_map(np.linspace(0, 1, 256)))
                     for name, colour_map in maps.items()},
            "light": render.LIGHT.tolist(), "back": render.BACK.tolist(), "obstacle": list(render.OBSTACLE),
            "rings": looks.SEQUENCE}


# The quantities that can colour the cloth. `scale`: log or linear; `range`: the range that the player shows
# first, None for the range of the data.
PROPERTIES = ("key", "name", "symbol", "unit", "map", "scale", "range", "meaning")
SHADES = [cloth.STRETCH_NORM.vmin, cloth.STRETCH_NORM.vmax]
QUANTITIES = [dict(zip(PROPERTIES, row)) for row in (
    ("stretch", "Stretch", "σ₁ − 1", "1", "stretch", "log", SHADES,
     "Largest principal stretch of a triangle, minus 1: 0 unstretched, 1 twice as long"),
    ("strain", "Strain", "max |σ − 1|", "1", "stretch", "log", [0.01, 10],
     "Larger of |σ₁ − 1| and |σ₂ − 1|, from the principal stretches σ₁ and σ₂ of a triangle"),
    ("quality", "Triangle quality", "shape", "1", "quality", "linear", [0, 1],
     "4√3 area / (a² + b² + c²) with edges a, b, c: 1 if equilateral, 0 without area"),
    ("bending", "Bending energy", "½ κ²", "1/m²", "sequence", "log", None,
     "Energy per area at rest of hinges (discrete_shells) with a flexural rigidity of 1 N m"),
    ("distance", "Distance", "|Δx|", "m", "sequence", "linear", None,
     "Distance of a vertex from the same point of the cloth in the other run"),
    ("none", "Plain", "", "", None, "linear", None, "The shape alone"),
)]


# --- frames ------------------------------------------------------------------------------------------------

class _Sections:
    """Arrays in one block of bytes. Each array is deflated separately."""

    def __init__(self):
        self.data, self.places = b"", {}

    def add(self, name, data, **more):
        self.places[name] = {"offset": len(self.data), "size": len(data), **more}
        self.data += data

    def integers(self, name, array):
        """Adds the differences between successive rows of a table."""
        steps = np.diff(array.astype(np.int64), axis=0, prepend=0)
        self._numbers(name, "integers", ((steps << 1) ^ (steps >> 63)).astype("<u4"))

    def floats(self, name, array):
        """Adds the rows of a table as 32-bit numbers."""
        self._numbers(name, "floats", array.astype("<f4"))

    def _numbers(self, name, kind, array):
        """Adds 4-byte numbers: for each column the first byte of all rows, then the second byte …"""
        rows, columns = array.shape
        planes = np.ascontiguousarray(array.T).view(np.uint8).reshape(columns, -1, 4).transpose(0, 2, 1)
        self.add(name, deflated(planes.tobytes()), kind=kind, rows=rows, columns=columns)


def pack(run: Run, every=1):
    """Packs each `every`-th frame and the last frame. None if the run has no frames or is missing."""
    chosen, frames, notes = choose(run, every)
    if not len(chosen):
        return None
    rest, triangles = run.rest_positions, run.triangles
    home = origin_of(rest, triangles)
    rest, frames = rest - home, frames - home
    if home.any():
        notes.append("Positions are relative to ({:.12g}, {:.12g}, {:.12g}) m.".format(*home))
    low, high = frames.min(axis=(0, 1)), frames.max(axis=(0, 1))
    step = float(max(np.max(high - low), 1e-9) / LEVELS)
    lattice = np.rint((frames - low) / step).astype(np.int32)
    parents, groups = lineage(triangles.tobytes(), len(rest))
    coded = encode(lattice, parents, groups)
    sections = _Sections()
    sections.floats("rest", rest)
    sections.integers("triangles", triangles)
    sections.integers("parents", np.arange(len(rest))[:, None] - parents)
    sections.integers("groups", groups[:, None])
    sections.integers("pinned", np.flatnonzero(run.pinned)[:, None])
    sections.integers("seeds", run.pin_seeds[:, None])
    springs = _add_springs(sections, run)
    solid = _add_obstacles(sections, run, notes, home)
    floor = obstacles.floor_of(run.config)
    sections.integers("first", lattice[0])
    sections.add("frames", coded.data, kind="frames", weights=coded.weights, counts=coded.counts)
    head = {"dom": f"frames-{run.id}", "count": len(chosen), "recorded": run.frames, "vertices": len(rest),
            "triangles": len(triangles), "times": [round(float(t), 9) for t in run.metrics["time"][chosen]],
            "chosen": chosen.tolist(), "origin": low.tolist(), "step": step, "size": run.size,
            "box": [low.tolist(), high.tolist()], "notes": notes, "sections": sections.places,
            "springs": springs, "rigidity": run.get("/bending/flexural_rigidity"), "obstacles": solid,
            "floor": None if floor is None else floor - home[2]}
    return Packed(head, sections.data)


def origin_of(rest, triangles):
    """(3) a point with round coordinates near the middle of a mesh that is far from the origin, as in
    geographic data; zeros if the rounding of single precision, up to 2⁻²⁴ of the distance from the origin, is
    at most FAR. lib/bendlab/mesh/single_precision.cpp does the same."""
    sides = rest[triangles] - rest[np.roll(triangles, -1, axis=1)]
    edge = np.linalg.norm(sides, axis=2).mean()
    if not np.abs(rest).max() * 2**-24 > FAR * edge:
        return np.zeros(3)
    power = int(np.floor(np.log10(np.ptp(rest, axis=0).max())))
    unit, middle = 10.0**abs(power), (rest.min(axis=0) + rest.max(axis=0)) / 2
    return (np.rint(middle / unit) * unit if power >= 0 else np.rint(middle * unit) / unit) + 0.0  # no -0


def choose(run, every=1):
    """Returns indices of the frames to show, their positions (F, V, 3), and notes on frames left out."""
    if not run.frames:
        return np.array([], int), np.empty((0, 0, 3)), []
    notes, count = [], run.frames
    wanted = np.union1d(np.arange(0, count, every), count - 1)
    frames = run.trajectory(wanted)
    size = run.size
    whole = np.array([np.isfinite(frame).all() and np.ptp(frame, axis=0).max() <= FLOWN_APART * size
                      for frame in frames])
    if not whole.all():
        notes.append(f"{len(wanted) - whole.sum()} of {len(wanted)} frames are left out, because the cloth "
                     f"is not finite or is larger than {FLOWN_APART} times its size at rest.")
    if every > 1:
        notes.append(f"{whole.sum()} of {count} frames are shown, one of {every}, so that the page stays "
                     "small.")
    return wanted[whole], frames[whole], notes


def _add_springs(sections, run):
    """The page's data about a run's springs: section names by kind, or why the page has no springs."""
    kinds, missing = {}, None
    for kind, count in run.counts.items():
        if kind == "strain" or not count:
            continue
        try:
            vertices = run.constraints(kind)
        except KeyError:
            missing = ("The run did not record its springs. To see springs, compute the run again with "
                       "--set /output/constraints=true --force.")
            continue
        if count > MOST_SPRINGS:
            missing = f"{count:,} springs are too many for a page.".replace(",", " ")
        else:
            sections.integers(f"springs-{kind}", vertices[np.lexsort(vertices.T[::-1])])
            kinds[kind] = f"springs-{kind}"
    return {"kinds": kinds, "counts": run.counts, "missing": None if kinds else missing}


def _add_obstacles(sections, run, notes, home):
    """[{section, velocity}] of every obstacle except horizontal planes. The section has the surface at t = 0,
    relative to the point `home`. If the run's file lacks the obstacles, adds a note."""
    parts = []
    for points, triangles, velocity in obstacles.drawn(run).values():
        section = f"obstacle-{len(parts)}"
        sections.floats(f"{section}-points", points - home)
        sections.integers(f"{section}-triangles", triangles)
        parts.append({"section": section, "velocity": velocity.tolist()})
    if obstacles.are_unknown(run):
        notes.append("Obstacles are not drawn: an older program wrote this run, and did not record them.")
    return parts


# --- frames in the project's own pages ---------------------------------------------------------------------

@dataclass
class PageFrames:
    """The frames of the runs in a page of the project. They are stored only in index.html, so a new layout
    copies the frames from the old index.html."""

    heads: dict = field(default_factory=dict)  # id of a run → description of its frames in the page's data
    scripts: dict = field(default_factory=dict)  # id → HTML

    @property
    def data(self):
        """What a player needs in addition to the runs. Empty without frames."""
        return {"colours": colours(), "quantities": QUANTITIES} if self.heads else {}

    @property
    def html(self):
        return "\n".join(self.scripts.values())


def of_runs(runs, most):
    """The frames of `runs` (id → run): at most about `most` frames per run."""
    packed = {id: pack(run, max(1, -(-(run.frames - 1) // (most - 1)))) for id, run in runs.items()}
    return PageFrames({id: frames.head for id, frames in packed.items() if frames},
                      {id: script(frames) for id, frames in packed.items() if frames})


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
