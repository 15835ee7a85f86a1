"""The time of one step per vertex: for strain, each bending model, and each effect."""
import math
from dataclasses import dataclass

from figures.performance.rows import STRAIN, at, iterations, kind, kinds, label, per_vertex, series
from tables.chart import Chart
from tables.numbers import number
from tables.table import Table

GROUPS = ["strain", "bending", "effects"]


@dataclass
class Part:
    group: str
    name: str
    ns: float  # per vertex and step


def parts(rows):
    """The parts that a step can have, in single precision, the most expensive first in each group; [] if no
    whole step was timed. Times of effects are from the cloth nearest in size."""
    timed, rounds, step = series(rows), iterations(rows), whole_step(rows)
    if not step:
        return []
    size = step["vertices"]
    step_parts = [Part("strain" if name in STRAIN else "bending", label(name), rounds * per_vertex(row))
                  for name in kinds(timed) if (row := at(timed, name, "float", size))]
    for (name, scalar), sizes in timed.items():
        if name.startswith("effect/") and scalar == "float":
            near = min(sizes, key=lambda row: abs(math.log(row["vertices"] / size)))
            step_parts.append(Part("effects", name.removeprefix("effect/"), per_vertex(near)))
    return sorted(step_parts, key=lambda part: (GROUPS.index(part.group), -part.ns))


def whole_step(rows):
    """The benchmark's row of a step on one thread in single precision, or None."""
    return next((row for row in rows if kind(row) == "step" and row["scalar"] == "float"
                 and row["threads"] == 1), None)


def main(bench, out, section):
    rows = bench["rows"]
    section.text = answer(rows)
    step_parts = parts(rows)
    if not step_parts:
        section.missing.append("a whole step in single precision, or its parts")
        return
    section.tables.append(Table.of("step", "",
                                   [("name", "part"), "group", ("ns", "time per vertex and step", "", "ns")],
                                   [vars(part) for part in step_parts]))
    section.charts.append(Chart("step", title(step_parts), "step", "name", ["ns"], ["group"], scale="band",
                                y_scale="log",
                                look="", on_top=True, note=caption(rows)))


def answer(rows):
    step, ns_of = whole_step(rows), {part.name: part.ns for part in parts(rows)}
    if not step:
        return ""
    all_of_it = iterations(rows) * per_vertex(step)
    text = (f"One step with {iterations(rows)} iterations of a cloth with {step['vertices']:,} vertices and "
            f"crossover springs takes {number(step['step_ms'], 2)} ms on one thread. Each vertex takes "
            f"{number(all_of_it)} ns")
    names = [label(name) for name in ("strain", "crossover")]
    if all(name in ns_of for name in names):
        text += (f": {number(ns_of[names[0]])} ns for the strain of the triangles and "
                 f"{number(ns_of[names[1]])} ns for the springs")
    return text + "."


def caption(rows):
    step, sizes = whole_step(rows), {row["vertices"] for row in rows if row["name"].startswith("effect/")}
    near = min(sizes, key=lambda size: abs(math.log(size / step["vertices"])), default=None)
    return (f"A step has {iterations(rows)} iterations: strain and bending are projected {iterations(rows)} "
            "times. The time of a cloth is the sum of the times of one form of strain, one bending model, "
            f"and the effects of the scene. One thread, single precision, {step['vertices']:,} vertices"
            + (f" (effects: {near:,})" if near else "") + ".")


def title(step_parts):
    """The title: the times of bending and of effects over the time of strain."""
    strain = next((part.ns for part in step_parts if part.name == label("strain")), None)
    bending = [part for part in step_parts if part.group == "bending"]
    effects = [part for part in step_parts if part.group == "effects"]
    text = []
    if strain and len(bending) > 1:
        text.append(f"Bending takes {number(bending[-1].ns / strain, 2)} ({bending[-1].name}) to "
                    f"{number(bending[0].ns / strain, 2)} ({bending[0].name}) times as long as strain")
    if strain and effects:
        cheap = sum(part.ns < 0.1 * strain for part in effects)
        text.append(f"{cheap} of {len(effects)} effects take less than a tenth of the time of strain. The "
                    f"most expensive effect, {effects[0].name}, takes {number(effects[0].ns / strain, 2)} "
                    "times as long as strain")
    return ". ".join(text) or "Time of a step for each vertex"
