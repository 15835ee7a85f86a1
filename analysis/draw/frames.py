"""What the player of a page needs: the frames of runs, compressed, and the colours of the cloth.

    shown = playback(runs)
    shown.data      {"colours": …, "quantities": […], "runs": [{"id", "label", "name", "status", "frames"}]}
    shown.scripts   HTML: the frames of every run that recorded frames
    shown.players   HTML: a player of these runs (player_html)

analysis/viewer/README.md describes this data. Lengths in m, times in s.
"""
import base64
import html
import json
import math
import shlex
from dataclasses import dataclass
from functools import lru_cache

import h5py
import numpy as np

from draw import cloth
from tables import looks
from runs import obstacles
from draw import render
from bendlab.results.facts import Facts
from draw.far import origin_of
from draw.frame_coding import LEVELS, PARENTS, deflated, encode, lineage
from bendlab.results.load import Run

LIMIT = 60e6  # most bytes of all frames in a page; to stay below this limit, frames are left out
# most vertices times frames of the runs that a page offers in addition; packing takes about 6 s
MOST_OFFERED = 1_000_000
MOST_SPRINGS = 400_000  # a run with more springs shows none in the page
FLOWN_APART = 50  # sizes at rest; a frame with a larger box would leave too few digits for the other frames


@dataclass
class Playback:
    """Runs ready for a page."""

    data: dict  # a part of the page's data
    scripts: str  # HTML
    players: str  # HTML


def playback(runs, limit=LIMIT, labels=None, most=None, offered=()):
    """Playback of runs. `labels`: id → name in the page, by default the settings in which runs differ.

    If all frames exceed `limit` bytes, or a run has more than `most` frames, frames are left out at equal
    intervals, and a note says this. `offered`: more runs that a reader can choose. Runs are added in order
    until MOST_OFFERED or `limit` is reached.
    """
    labels = labels or labels_of(runs)
    every = {run.id: math.ceil(run.frames / most) if most and run.frames else 1 for run in runs}
    packed = {run.id: pack(run, every[run.id]) for run in runs}
    size = sum(4 / 3 * len(frames.data) for frames in packed.values() if frames)
    if size > limit:
        more = math.ceil(size / limit)
        packed = {run.id: pack(run, more * every[run.id]) for run in runs}
        size /= more
    places = 0
    for run in offered:
        places += run.frames * len(run.rest_positions)
        frames = pack(run) if places <= MOST_OFFERED else None
        size += 4 / 3 * len(frames.data) if frames else 0
        if not frames or size > limit:
            break
        packed[run.id] = frames
    runs = [*runs, *(run for run in offered if run.id in packed)]
    data = {"colours": colours(), "quantities": QUANTITIES,
            "runs": [{"id": run.id, "label": labels[run.id], "name": run.name, "status": run.status,
                      "frames": packed[run.id].head if packed[run.id] else None,
                      "remedy": None if packed[run.id] else remedy(run)} for run in runs]}
    scripts = "\n".join(script(frames) for frames in packed.values() if frames)
    return Playback(data, scripts, player_html(runs))


def player_html(runs):
    """HTML of a player of these runs. The page also needs Playback.data and Playback.scripts."""
    return place_html(run.id for run in runs)


def place_html(ids):
    """The HTML element of a player of the runs with these ids."""
    names = html.escape(" ".join(ids), quote=True)
    return (f"<div class='player' data-runs='{names}'><p class='player-fallback'>The cloth moves here in a "
            "browser with JavaScript and WebGL 2.</p></div>")


def script(packed):
    return (f"<script type='application/octet-stream;base64' id='{packed.head['dom']}'>"
            f"{base64.b64encode(packed.data).decode()}</script>")


def remedy(run):
    """What a reader can do to see a run without frames."""
    if run.status == "missing":
        return "This run is not computed yet."
    config = f"configs/{run.experiment}.json" if run.experiment else "CONFIG"
    points = " ".join(f"--set {shlex.quote(f'{key}={value}')}" for key, value in run.point.items())
    return (f"This run recorded no frames. To record frames: ./bendlab run {config} {points} "
            "--set /output/frames_per_second=30 --force").replace("  ", " ")


def labels_of(runs):
    """{run id: label}. A label has the config (if there are several), the model, and settings that differ."""
    pointers = {pointer for run in runs for pointer in run.point} - {"/bending/model"}
    differs = lambda value: len({json.dumps(value(run), sort_keys=True) for run in runs}) > 1
    swept = [pointer for pointer in sorted(pointers) if differs(lambda run: run.get(pointer))]
    several = differs(lambda run: _config_name(run))
    labels = {}
    for run in runs:
        parts = [_config_name(run)] if several else []
        parts.append(run.model)
        parts += [f"{pointer.rsplit('/', 1)[1].replace('_', ' ')} {_short(run.get(pointer))}"
                  for pointer in swept if run.get(pointer) is not None]
        labels[run.id] = ", ".join(parts)
    return labels


def _config_name(run):
    return run.name.split("/")[0].replace("_", " ")


def _short(value):
    return f"{value:g}" if isinstance(value, float) else str(
        value) if np.isscalar(value) else json.dumps(value)


# --- colours and quantities --------------------------------------------------------------------------------

def _hex(colours):
    return "".join(f"{round(255 * c):02x}" for colour in colours for c in colour[:3])


def colours():
    """The colour maps of figures, as 256 hexadecimal colours each, and the light of figures."""
    import matplotlib
    shares = np.linspace(0, 1, 256)
    maps = {"stretch": cloth.STRETCH, "sequence": matplotlib.colormaps["viridis"],
            "quality": matplotlib.colormaps["cividis"], "difference": matplotlib.colormaps["RdBu_r"]}
    return {"maps": {name: _hex(colour_map(shares)) for name, colour_map in maps.items()},
            "light": render.LIGHT.tolist(), "back": render.BACK.tolist(), "obstacle": list(render.OBSTACLE),
            "rings": looks.SEQUENCE}


# The quantities that can colour the cloth. `scale`: log or linear; `range`: the range that the player shows
# first, None for the range of the data.
QUANTITIES = [
    {"key": "stretch", "name": "Stretch", "symbol": "σ₁ − 1", "unit": "1", "map": "stretch", "scale": "log",
     "range": [cloth.STRETCH_NORM.vmin, cloth.STRETCH_NORM.vmax],
     "meaning": "Largest principal stretch of a triangle, minus 1: 0 unstretched, 1 twice as long"},
    {"key": "strain", "name": "Strain", "symbol": "max |σ − 1|", "unit": "1", "map": "stretch",
     "scale": "log", "range": [0.01, 10],
     "meaning": "Larger of |σ₁ − 1| and |σ₂ − 1|, from the principal stretches σ₁ and σ₂ of a triangle"},
    {"key": "quality", "name": "Triangle quality", "symbol": "shape", "unit": "1", "map": "quality",
     "scale": "linear", "range": [0, 1],
     "meaning": "4√3 area / (a² + b² + c²) with edges a, b, c: 1 if equilateral, 0 without area"},
    {"key": "bending", "name": "Bending energy", "symbol": "½ κ²", "unit": "1/m²", "map": "sequence",
     "scale": "log", "range": None,
     "meaning": "Energy per area at rest of hinges (discrete_shells) with a flexural rigidity of 1 N m"},
    {"key": "distance", "name": "Distance", "symbol": "|Δx|", "unit": "m", "map": "sequence",
     "scale": "linear", "range": None,
     "meaning": "Distance of a vertex from the same point of the cloth in the other run"},
    {"key": "none", "name": "Plain", "symbol": "", "unit": "", "map": None, "scale": "linear", "range": None,
     "meaning": "The shape alone"},
]


# --- frames ------------------------------------------------------------------------------------------------

@dataclass
class Packed:
    """The frames of one run: a description for JSON, and the bytes."""

    head: dict
    data: bytes  # the first frame comes first, so that the page can draw it before the others are read


class _Sections:
    """Arrays in one block of bytes. Each array is deflated separately."""

    def __init__(self):
        self.data, self.places = b"", {}

    def add(self, name, data, **more):
        self.places[name] = {"offset": len(self.data), "size": len(data), **more}
        self.data += data

    def integers(self, name, array, columns):
        """Adds the differences between successive rows, ordered by _planes()."""
        rows = np.asarray(array, np.int64).reshape(-1, columns)
        steps = np.diff(rows, axis=0, prepend=0)
        folded = ((steps << 1) ^ (steps >> 63)).astype("<u4")
        self.add(name, deflated(_planes(folded)), kind="integers", rows=len(rows), columns=columns)

    def floats(self, name, array, columns):
        """Adds 32-bit numbers, ordered by _planes()."""
        rows = np.asarray(array, "<f4").reshape(-1, columns)
        self.add(name, deflated(_planes(rows)), kind="floats", rows=len(rows), columns=columns)


def _planes(array):
    """The bytes of 4-byte numbers: for each column the first byte of all rows, then the second byte …"""
    return np.ascontiguousarray(array.T).view(np.uint8).reshape(array.shape[1], -1, 4).transpose(
        0, 2, 1).tobytes()


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
    origin, step = _lattice(frames)
    lattice = np.rint((frames - origin) / step).astype(np.int32)
    parents, groups = _lineage(triangles.tobytes(), len(rest))
    coded = encode(lattice, parents, groups)
    sections = _Sections()
    sections.floats("rest", rest, 3)
    sections.integers("triangles", triangles, 3)
    sections.integers("parents", np.arange(len(rest))[:, None] - parents, PARENTS)
    sections.integers("groups", groups, 1)
    sections.integers("pinned", np.flatnonzero(run.pinned), 1)
    sections.integers("seeds", run.pin_seeds, 1)
    springs = _add_springs(sections, run)
    solid = _add_obstacles(sections, run, notes, home)
    floor = obstacles.floor_of(run.config)
    sections.integers("first", lattice[0], 3)
    sections.add("frames", coded.data, kind="frames", weights=coded.weights, counts=coded.counts)
    head = {"dom": f"frames-{run.id}", "count": len(chosen), "recorded": run.frames, "vertices": len(rest),
            "triangles": len(triangles), "times": [round(float(t), 9) for t in run.metrics["time"][chosen]],
            "chosen": [int(frame) for frame in chosen], "origin": origin.tolist(), "step": step,
            "size": run.size, "box": [frames.min(axis=(0, 1)).tolist(), frames.max(axis=(0, 1)).tolist()],
            "notes": notes, "sections": sections.places, "springs": springs,
            "rigidity": run.get("/bending/flexural_rigidity"), "obstacles": solid,
            "floor": None if floor is None else floor - home[2]}
    return Packed(head, sections.data)


@lru_cache(maxsize=2)
def _lineage(triangles, vertices):
    """Calls lineage(). Cached, because runs of a sweep share a mesh; `triangles`: the bytes of an array."""
    return lineage(np.frombuffer(triangles, int).reshape(-1, 3), vertices)


def _lattice(frames):
    """(3) origin and step of the 16-bit positions. LEVELS steps are the largest side of the bounding box."""
    low, high = frames.min(axis=(0, 1)), frames.max(axis=(0, 1))
    return low, float(max(np.max(high - low), 1e-9) / LEVELS)


def choose(run, every=1):
    """Returns indices of the frames to show, their positions (F, V, 3), and notes on frames left out."""
    count = 0 if run.status == "missing" else run.frames
    if not count:
        return np.array([], int), np.empty((0, 0, 3)), []
    notes = []
    wanted = np.union1d(np.arange(0, count, every), count - 1)
    frames = run.trajectory(wanted)
    size = run.size
    cloth = np.array([_is_cloth(positions, size) for positions in frames])
    if not cloth.all():
        notes.append(
            f"{len(wanted) - cloth.sum()} of {len(wanted)} frames are left out, because the cloth is not "
            f"finite or is larger than {FLOWN_APART} times its size at rest.")
    if every > 1:
        notes.append(f"{cloth.sum()} of {count} frames are shown, one of {every}, so that the page "
                     "stays small.")
    return wanted[cloth], frames[cloth], notes


def _is_cloth(positions, size):
    return np.isfinite(positions).all() and np.ptp(positions, axis=0).max() <= FLOWN_APART * size


def _add_springs(sections, run):
    """The page's data about a run's springs: section names by kind, or why the page has no springs."""
    kinds, missing = {}, None
    with h5py.File(run.file, "r") as file:
        for kind, count in Facts(file).counts.items():
            group = file[f"constraints/{kind}"] if f"constraints/{kind}" in file else {}
            if kind == "strain" or not count:
                continue
            if "vertices" not in group:
                missing = ("The run did not record its springs. To see springs, compute the run again with "
                           "--set /output/constraints=true --force.")
            elif count > MOST_SPRINGS:
                missing = f"{count:,} springs are too many for a page.".replace(",", " ")
            else:
                vertices = group["vertices"][()]
                vertices = vertices.reshape(count, -1)
                vertices = vertices[np.lexsort(vertices.T[::-1])]
                sections.integers(f"springs-{kind}", vertices, vertices.shape[1])
                kinds[kind] = f"springs-{kind}"
    return {"kinds": kinds, "counts": run.counts, "missing": None if kinds else missing}


def _add_obstacles(sections, run, notes, home):
    """[{section, velocity}] of every obstacle except horizontal planes. The section has the surface at t = 0,
    relative to the point `home`. If the run's file lacks the obstacles, adds a note."""
    parts = []
    for points, triangles, velocity in obstacles.drawn(run).values():
        section = f"obstacle-{len(parts)}"
        sections.floats(f"{section}-points", points - home, 3)
        sections.integers(f"{section}-triangles", triangles, 3)
        parts.append({"section": section, "velocity": velocity.tolist()})
    if obstacles.are_unknown(run):
        notes.append("Obstacles are not drawn: an older program wrote this run, and did not record them.")
    return parts
