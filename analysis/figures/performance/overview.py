"""The time of one step per vertex: for strain, each bending model, and each effect."""
import math
from collections import namedtuple

from figures.performance.rows import STRAIN, at, iterations, kinds, label, per_vertex, series, whole_step
from tables.numbers import number
from tables.table import Table

GROUPS = ["strain", "bending", "effects"]
Part = namedtuple("Part", "group name ns")  # ns: time per vertex and step


def parts(rows):
    """The parts that a step can have, in single precision, the most expensive first in each group; [] if no
    whole step was timed. Times of effects are from the cloth nearest in size."""
    timed, rounds, step = series(rows), iterations(rows), whole_step(rows)
    if not step:
        return []
    step_parts = [Part("strain" if name in STRAIN else "bending", label(name), rounds * per_vertex(row))
                  for name in kinds(timed) for row in at(timed, [name], step["vertices"])]
    for (name, scalar), sizes in timed.items():
        if name.startswith("effect/") and scalar == "float":
            step_parts.append(Part("effects", name.removeprefix("effect/"), per_vertex(nearest(sizes, step))))
    return sorted(step_parts, key=lambda part: (GROUPS.index(part.group), -part.ns))


def nearest(rows, step):
    """The row whose cloth is nearest in size to the cloth of the step, or None."""
    return min(rows, key=lambda row: abs(math.log(row["vertices"] / step["vertices"])), default=None)


def main(bench, out, section):
    rows = bench["rows"]
    section.text, step_parts = answer(rows), parts(rows)
    if not step_parts:
        section.missing.append("a whole step in single precision, or its parts")
        return
    step, rounds = whole_step(rows), iterations(rows)
    near = nearest([row for row in rows if row["name"].startswith("effect/")], step)
    effects = f" (effects: {near['vertices']:,})" if near else ""
    section.add_chart(
        Table.of("step", "", [("name", "part"), "group", ("ns", "time per vertex and step", "", "ns")],
                 [part._asdict() for part in step_parts]),
        title(step_parts), "name", ["ns"], ["group"], scale="band", y_scale="log", look="", on_top=True,
        note=f"A step has {rounds} iterations: strain and bending are projected {rounds} times. The time of "
             "a cloth is the sum of the times of one form of strain, one bending model, and the effects of "
             f"the scene. One thread, single precision, {step['vertices']:,} vertices{effects}.")


def answer(rows):
    step, ns_of = whole_step(rows), {part.name: part.ns for part in parts(rows)}
    if not step:
        return ""
    text = (f"One step with {iterations(rows)} iterations of a cloth with {step['vertices']:,} vertices and "
            f"crossover springs takes {number(step['call_ms'], 2)} ms on one thread. Each vertex takes "
            f"{number(iterations(rows) * per_vertex(step))} ns")
    strain, crossover = (ns_of.get(label(name)) for name in ("strain", "crossover"))
    if strain and crossover:
        text += (f": {number(strain)} ns for the strain of the triangles and {number(crossover)} ns for the "
                 "springs")
    return text + "."


def title(step_parts):
    """The title: the times of bending and of effects over the time of strain."""
    strain = next((part.ns for part in step_parts if part.name == label("strain")), None)
    bending, effects = ([part for part in step_parts if part.group == group] for group in GROUPS[1:])
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
