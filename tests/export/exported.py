"""Compares exported files with the run file. The readers here are independent of the program.

    exported.py RUN FORMAT PATH [--frames FIRST:LAST:STEP] [--up y]      exit 1 if a value differs

PATH is the argument of --to in `bendlab export`. Positions must equal the floats of the run to the last bit.
"""
import argparse
import csv
import re
import struct
import sys
from pathlib import Path

import h5py
import numpy as np
import usda

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "analysis"))
from bendlab.results.facts import Facts  # noqa: E402


class Run:
    """A run file as h5py reads it."""

    def __init__(self, path):
        with h5py.File(path, "r") as file:
            self.triangles = file["rest/triangles"][()]
            count = len(file["rest/positions"])
            self.points = file["VTKHDF/Points"][()].reshape(-1, count, 3)
            facts = Facts(file)
            self.metrics = dict(zip(facts.columns, file["metrics/values"][()].T))
            self.units = {name: unit for name, (unit, _) in facts.columns.items()}
            self.summary, self.config = facts.summary, facts.config
            self.id, self.name = facts.id, facts.name
        self.times = self.metrics["time"]
        self.rate = self.config["output"]["frames_per_second"]

    def frames(self, text):
        """Numbers of the frames that --frames FIRST:LAST:STEP chooses, LAST included."""
        first, last, step = [*(int(part) if part else None for part in text.split(":")), None, None][:3]
        numbers = range(len(self.times))
        if ":" not in text:
            return [numbers[first]]
        last = numbers[-1 if last is None else last]
        return list(numbers[first:last + 1:step])

    def obstacles(self):
        """Exported name of each obstacle: its settings."""
        kinds = [effect["type"] for effect in self.config["effects"]]
        settings = {}
        for index, effect in enumerate(self.config["effects"]):
            if "velocity" in effect:
                kind = effect["type"]
                number = f"_{kinds[:index].count(kind) + 1}" if kinds.count(kind) > 1 else ""
                settings[kind + number] = effect
        return settings


def turned(points, up):
    """Turns points with z up so that the axis `up` is up."""
    return points if up != "y" else np.stack([points[..., 0], points[..., 2], -points[..., 1]], axis=-1)


def off_surface(effect, points, time):
    """The largest distance of points from the surface of an obstacle at this time, m."""
    vector = lambda name: np.array(effect[name], float)  # noqa: E731
    points = np.asarray(points, float) - time * vector("velocity")
    if effect["type"] == "sphere":
        return np.abs(np.linalg.norm(points - vector("centre"), axis=1) - effect["radius"]).max()
    if effect["type"] == "plane":
        return np.abs((points - vector("point")) @ vector("normal")).max() / np.linalg.norm(vector("normal"))
    if effect["type"] == "capsule":
        a, along = vector("a"), vector("b") - vector("a")
        part = np.clip((points - a) @ along / (along @ along), 0, 1)[:, None]
        return np.abs(np.linalg.norm(points - a - part * along, axis=1) - effect["radius"]).max()
    if effect["type"] == "disc":
        axis = vector("axis") / np.linalg.norm(vector("axis"))
        height = (points - vector("centre")) @ axis
        outward = np.linalg.norm(points - vector("centre") - height[:, None] * axis, axis=1)
        rim = np.maximum(outward - effect["radius"] + effect["height"] / 2, 0)
        return np.abs(np.hypot(height, rim) - effect["height"] / 2).max()
    raise ValueError(f"this test has no distance to the obstacle {effect['type']}")


def read_obj(path):
    """Points, triangles, texture coordinates of the corners (or None)."""
    points, texture, triangles, corners = [], [], [], []
    for line in path.read_text(encoding="ascii").splitlines():
        kind, *words = line.split() or ["#"]
        if kind == "v":
            points.append([float(word) for word in words])
        elif kind == "vt":
            texture.append([float(word) for word in words])
        elif kind == "f":
            indices = [[int(index) for index in word.split("/")] for word in words]
            triangles.append([corner[0] - 1 for corner in indices])
            corners.append([texture[corner[1] - 1] for corner in indices if len(corner) > 1])
        elif kind not in ("#", "o"):
            raise ValueError(f"{path}: {line}")
    return np.array(points), np.array(triangles), np.array(corners) if texture else None


def read_ply(path):
    """Points, triangles, texture coordinates of a binary PLY file, with the properties of its header."""
    head, body = path.read_bytes().split(b"end_header\n", 1)
    lines = head.decode("ascii").splitlines()
    assert lines[:2] == ["ply", "format binary_little_endian 1.0"]
    vertices, faces = (int(line.split()[2]) for line in lines if line.startswith("element"))
    number = {"float": "<f4", "double": "<f8"}
    fields = [line.split()[1:] for line in lines if re.match("property (float|double) ", line)]
    assert "property list uchar int vertex_indices" in lines
    values = np.frombuffer(body, np.dtype([(name, number[kind]) for kind, name in fields]), vertices)
    table = np.frombuffer(body[values.nbytes:], np.dtype([("count", "u1"), ("corners", "<i4", 3)]))
    assert len(table) == faces and (table["count"] == 3).all()
    columns = lambda *names: np.stack([values[name] for name in names], axis=1)  # noqa: E731
    texture = columns("s", "t")[table["corners"]] if "s" in values.dtype.names else None
    return columns("x", "y", "z"), table["corners"], texture


def read_pc2(path):
    """First frame, number of frames between two samples, samples (n, vertices, 3)."""
    data = path.read_bytes()
    signature, version, points, first, rate, samples = struct.unpack("<12siiffi", data[:32])
    assert signature == b"POINTCACHE2\0" and version == 1 and len(data) == 32 + 12 * points * samples
    return first, rate, np.frombuffer(data[32:], "<f4").reshape(samples, points, 3)


class Differences(list):

    def check(self, right, what):
        if not right:
            self.append(what)

    def same_points(self, got, expected, what):
        got, expected = np.asarray(got).astype(np.float32), np.asarray(expected).astype(np.float32)
        self.check(got.shape == expected.shape and np.array_equal(got, expected), what)


def flat_texture(run):
    """(V, 2) texture coordinates of a sheet that is flat in z at rest; its longer side goes from 0 to 1."""
    low, extent = run.points[0].min(axis=0)[:2], np.ptp(run.points[0], axis=0)[:2].max()
    return (run.points[0][:, :2] - low) / extent


def compare_files(run, read, suffix, folder, frames, up, wrong):
    """Compares a sequence of OBJ or PLY files."""
    single = folder.suffix == suffix
    expected = set()
    for number in frames:
        file = folder if single else folder / f"cloth.{number:04}{suffix}"
        expected.add(file)
        points, triangles, texture = read(file)
        wrong.same_points(points, turned(run.points[number], up), f"{file}: positions")
        wrong.check(np.array_equal(triangles, run.triangles), f"{file}: triangles")
        close = texture is not None and np.allclose(texture, flat_texture(run)[run.triangles], atol=1e-6)
        wrong.check(close, f"{file}: texture coordinates")
    for name, effect in run.obstacles().items():
        moves = any(effect["velocity"])
        for number in frames if moves else frames[:1]:
            numbered = f"{name}.{number:04}{suffix}" if moves else f"{name}{suffix}"
            file = folder.with_name(f"{folder.stem}_{name}{suffix}") if single else folder / numbered
            expected.add(file)
            points = read(file)[0]
            if up != "y":
                wrong.check(off_surface(effect, points, run.times[number]) < 1e-6, f"{file}: off its surface")
    if not single:
        wrong.check(set(folder.iterdir()) == expected, f"{folder}: other files than expected")


def compare_pc2(run, folder, frames, up, wrong):
    cache = folder if folder.suffix == ".pc2" else folder / "cloth.pc2"
    first, rate, samples = read_pc2(cache)
    wrong.check(first == frames[0] and rate == (frames[1] - frames[0] if len(frames) > 1 else 1), "times")
    wrong.same_points(samples, turned(run.points[frames], up), f"{cache}: positions")
    points, triangles, _ = read_obj(cache.with_suffix(".obj"))
    wrong.same_points(points, turned(run.points[frames[0]], up), "the first frame")
    wrong.check(np.array_equal(triangles, run.triangles), "triangles")
    for name, effect in run.obstacles().items():
        stem = cache.with_name(name if cache.stem == "cloth" else f"{cache.stem}_{name}")
        wrong.check(stem.with_suffix(".obj").exists(), f"{name}.obj is missing")
        wrong.check(stem.with_suffix(".pc2").exists() == any(effect["velocity"]), f"{name}.pc2")


def compare_usda(run, path, frames, up, wrong):
    file = path if path.suffix == ".usda" else path / "cloth.usda"
    layer, prims = usda.read_stage(file)
    prim = prims[layer["defaultPrim"]]
    codes = [run.times[number] * run.rate for number in frames]
    wrong.check(layer["metersPerUnit"] == 1 and layer["upAxis"] == ("Y" if up == "y" else "Z"), "units")
    wrong.check(layer["timeCodesPerSecond"] == run.rate, "timeCodesPerSecond")
    wrong.check(np.allclose([layer["startTimeCode"], layer["endTimeCode"]], [codes[0], codes[-1]]), "range")
    marks = layer["customLayerData"]["bendlab"]
    wrong.check(marks["run"] == run.id and marks["experiment"] == run.name and marks["version"], "marks")
    wrong.check(prim["type"] == "Xform" and set(prim["children"]) == {"cloth", *run.obstacles()}, "prims")
    for name, mesh in prim["children"].items():
        wrong.check(mesh["type"] == "Mesh", f"{name}: type")
        compare_mesh(run, name, {key: entry["value"] for key, entry in mesh["properties"].items()}, wrong)
        wrong.check(mesh["properties"]["subdivisionScheme"]["uniform"],
                    f"{name}: subdivisionScheme is uniform")
    cloth = prim["children"]["cloth"]["properties"]
    samples = cloth["points.timeSamples"]["value"]
    wrong.check(np.allclose(list(samples), codes, atol=1e-6, rtol=0), "times of the cloth")
    wrong.same_points(list(samples.values()), turned(run.points[frames], up), f"{file}: positions")
    extents = np.array(list(cloth["extent.timeSamples"]["value"].values()))
    points = turned(run.points[frames], up)
    wrong.same_points(extents, np.stack([points.min(axis=1), points.max(axis=1)], axis=1), "extents")
    wrong.check(cloth["primvars:st"]["interpolation"] == "faceVarying", "interpolation")
    texture = np.array(cloth["primvars:st"]["value"])[np.array(cloth["primvars:st:indices"]["value"], int)]
    wrong.check(
        np.allclose(texture.reshape(-1, 3, 2),
                    flat_texture(run) [run.triangles],
                    atol=1e-6),
        "texture")
    for name, effect in run.obstacles().items():
        values = prim["children"][name]["properties"]
        still = np.array(values["points"]["value"])
        moves = values.get("xformOp:translate.timeSamples", {"value": {codes[0]: (0, 0, 0)}})["value"]
        wrong.check((len(moves) > 1) == (any(effect["velocity"]) and len(frames) > 1), f"{name}: motion")
        for code, way in moves.items():
            if up != "y":
                off = off_surface(effect, still + way, code / run.rate)
                wrong.check(off < 1e-6, f"{name}: {off} m off its surface at {code}")


def compare_mesh(run, name, values, wrong):
    """Compares the properties that every mesh has."""
    corners = np.array(values["faceVertexIndices"], int).reshape(-1, 3)
    wrong.check(set(values["faceVertexCounts"]) == {
                3} and 3 * len(values["faceVertexCounts"]) == corners.size, f"{name}: counts")
    wrong.check(values["subdivisionScheme"] == "none", f"{name}: subdivisionScheme")
    if name == "cloth":
        wrong.check(np.array_equal(corners, run.triangles), "triangles")
    else:
        points = np.array(values["points"])
        wrong.check(0 <= corners.min() and corners.max() == len(points) - 1, f"{name}: indices")
        wrong.check(np.allclose(values["extent"], [points.min(
            axis=0), points.max(axis=0)]), f"{name}: extent")


def number_of(cell):
    return float(cell) if cell else np.nan


def same_number(cell, value):
    return number_of(cell) == value or (cell == "" and np.isnan(value))


def compare_csv(run, folder, frames, _, wrong):
    rows = {}
    for name in ("summary", "frames", "columns"):
        with open(folder / f"{name}.csv", encoding="utf-8", newline="") as file:
            rows[name] = list(csv.DictReader(file, strict=True))
    summary = {row["name"]: row["value"] for row in rows["summary"]}
    wrong.check(set(summary) == set(run.summary), "names of the summary")
    wrong.check(all(same_number(cell, run.summary[name]) for name, cell in summary.items()), "the summary")
    wrong.check(any(row["unit"] == "m" for row in rows["summary"]), "no unit in the summary")
    wrong.check([int(row["frame"]) for row in rows["frames"]] == frames, "numbers of the frames")
    for row, number in zip(rows["frames"], frames):
        wrong.check(set(row) == {"frame", *run.metrics}, f"columns of frame {number}")
        for name, values in run.metrics.items():
            wrong.check(same_number(row[name], values[number]), f"frame {number}: {name} is '{row[name]}'")
    units = {row["name"]: row["unit"] for row in rows["columns"]}
    wrong.check(units == {"frame": "1", **run.units}, "units of the columns")


def main(arguments):
    run, wrong = Run(arguments.run), Differences()
    frames, up = run.frames(arguments.frames), arguments.up
    compare = {"csv": compare_csv, "pc2": compare_pc2, "usda": compare_usda,
               "obj": lambda run, *rest: compare_files(run, read_obj, ".obj", *rest),
               "ply": lambda run, *rest: compare_files(run, read_ply, ".ply", *rest)}
    compare[arguments.format](run, arguments.path, frames, up, wrong)
    for what in wrong:
        print(f"{arguments.format}: {what}")
    return 1 if wrong else 0


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("run", type=Path)
    parser.add_argument("format")
    parser.add_argument("path", type=Path)
    parser.add_argument("--frames", default=":")
    parser.add_argument("--up", default="z")
    sys.exit(main(parser.parse_args()))
