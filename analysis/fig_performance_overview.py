"""What one vertex costs in one step: strain, each bending model, each effect."""
import math
from dataclasses import dataclass

import matplotlib.pyplot as plt

import style
from fig_performance import STRAIN, at, iterations, kind, kinds, label, per_vertex, series
from report import Section

GROUPS = {"strain": style.INK, "bending": style.SEQUENCE[1], "effects": style.SEQUENCE[0]}


@dataclass
class Part:
    """A part of a step."""

    group: str
    name: str
    ns: float  # per vertex and step


def parts(rows):
    """What a step consists of or can consist of, at the size of the whole step, in single precision; effects
    at the nearest size. Each group begins with its dearest. Empty without a row of a whole step."""
    table, rounds, step = series(rows), iterations(rows), whole_step(rows)
    if not step:
        return []
    size = step["vertices"]
    found = [Part("strain" if name in STRAIN else "bending", label(name), rounds * per_vertex(row))
             for name in kinds(table) if (row := at(table, name, "float", size))]
    for (name, scalar), some in table.items():
        if name.startswith("effect/") and scalar == "float":
            near = min(some, key=lambda row: abs(math.log(row["vertices"] / size)))
            found.append(Part("effects", name.removeprefix("effect/"), per_vertex(near)))
    return sorted(found, key=lambda part: (list(GROUPS).index(part.group), -part.ns))


def whole_step(rows):
    """The row of the step on one thread in single precision, None if there is none."""
    return next((row for row in rows if kind(row) == "step" and row["scalar"] == "float"
                 and row["threads"] == 1), None)


def main(bench, out):
    rows = bench["rows"]
    section = Section("What does a step cost?", "overview", text=answer(rows))
    found = parts(rows)
    if found:
        section.pictures.append((_draw(found, rows, out), caption(rows)))
    else:
        section.missing.append("a whole step in single precision, or its parts")
    return section


def answer(rows):
    """The page's answer."""
    step, found = whole_step(rows), {part.name: part.ns for part in parts(rows)}
    if not step:
        return ""
    all_of_it = iterations(rows) * per_vertex(step)
    text = (f"One step with {iterations(rows)} iterations of a cloth with {step['vertices']:,} vertices and "
            f"crossover springs takes {style.number(step['step_ms'], 2)} ms on one thread. That is "
            f"{style.number(all_of_it)} ns for each vertex")
    names = [label(name) for name in ("strain", "crossover")]
    if all(name in found for name in names):
        text += (f": {style.number(found[names[0]])} ns for the strain of the triangles and "
                 f"{style.number(found[names[1]])} ns for the springs")
    return text + "."


def caption(rows):
    step, sizes = whole_step(rows), {row["vertices"] for row in rows if row["name"].startswith("effect/")}
    near = min(sizes, key=lambda size: abs(math.log(size / step["vertices"])), default=None)
    return (f"A step has {iterations(rows)} iterations: strain and bending are projected "
            f"{iterations(rows)} times. Every cloth has strain, in one of its two forms; add one bending "
            "model, and those effects that the scene needs. One thread, single precision, "
            f"{step['vertices']:,} vertices" + (f" (effects: {near:,})" if near else "") + ".")


def _draw(found, rows, out):
    figure, axes = plt.subplots(figsize=(8.6, 0.9 + 0.24 * len(found)), layout="constrained")
    for y, part in enumerate(found):
        axes.plot(part.ns, y, "o", color=GROUPS[part.group], ms=7)
        axes.annotate(style.number(part.ns, 2), (part.ns, y), xytext=(8, 0), textcoords="offset points",
                      va="center", fontsize=8.5)
    axes.set_yticks(range(len(found)), labels=[part.name for part in found])
    for tick, part in zip(axes.get_yticklabels(), found):
        tick.set_color(GROUPS[part.group])
    axes.set_ylim(len(found) - 0.5, -0.5)
    style.plain_log(axes, "x")
    axes.set_xlim(right=2.2 * axes.get_xlim()[1])  # room for the last number
    axes.set_xlabel(f"ns per vertex and step of {iterations(rows)} iterations")
    for group, colour in GROUPS.items():
        if any(part.group == group for part in found):
            axes.plot([], [], "o", color=colour, label=group)
    axes.legend(loc="center left", bbox_to_anchor=(1.01, 0.5))
    figure.suptitle(title(found), x=0.01, ha="left", fontsize=11.5)
    return style.save(figure, out, "fig_performance_overview")


def title(found):
    """The dearest and the cheapest bending, and the dearest effect, over strain."""
    strain = next((part.ns for part in found if part.name == label("strain")), None)
    bending = [part for part in found if part.group == "bending"]
    effects = [part for part in found if part.group == "effects"]
    text = []
    if strain and len(bending) > 1:
        text.append(f"Bending takes {style.number(bending[-1].ns / strain, 2)} ({bending[-1].name}) to "
                    f"{style.number(bending[0].ns / strain, 2)} ({bending[0].name}) times as long as strain")
    if strain and effects:
        cheap = sum(part.ns < 0.1 * strain for part in effects)
        text.append(f"{cheap} of {len(effects)} effects take less than a tenth of it; the dearest is "
                    f"{effects[0].name}, with {style.number(effects[0].ns / strain, 2)} times as much")
    return ".\n".join(text) or "Time of a step for each vertex"
