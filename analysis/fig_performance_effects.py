"""What each effect adds to a step, per vertex, over the size of the cloth."""
import json
from pathlib import Path

import matplotlib.pyplot as plt

import style
from fig_performance import COLUMNS, columns, iterations, part, per_vertex, series
from fig_performance_overview import whole_step
from report import Section, Table

SCHEMA = Path(__file__).resolve().parent.parent / "configs/schema.json"
SHADES = ["#9ccbe6", "#56a5d8", "#0072b2", "#003a5c"]  # small to large cloth
TWICE = 2


def known_effects():
    """Every effect of the program, as its schema lists them."""
    schema = json.loads(SCHEMA.read_text(encoding="utf-8"))
    return [kind["properties"]["type"]["const"] for kind in schema["properties"]["effects"]["items"]["oneOf"]]


def by_effect(rows):
    """Effect → its rows by size, the dearest effect first."""
    found = {name.removeprefix("effect/"): some for (name, scalar), some in series(rows).items()
             if name.startswith("effect/") and scalar == "float"}
    return dict(sorted(found.items(), key=lambda entry: -max(map(per_vertex, entry[1]))))


def main(bench, out):
    effects = by_effect(bench["rows"])
    section = Section("What does each effect add?", "effects",
                      commands=["./bendlab bench --filter '^effect/'"])
    section.text = ("A scene lists its effects; what it does not list costs nothing. Each effect is timed in "
                    "a scene in which it has work: obstacles are touched, cloth that collides with itself "
                    "lies in five layers. " + sizes_text(effects))
    absent = [name for name in known_effects() if name not in effects]
    if absent:
        section.missing.append(f"effects: {', '.join(absent)}")
    if effects:
        section.pictures.append((_draw(effects, bench["rows"], out), "One thread, single precision. Bars: "
                                 "lowest to highest. An effect acts on a vertex, a triangle or a contact; "
                                 "the table says how often in a step, and the time of one action."))
        section.tables.append(_table(effects))
    return section


def growth(some):
    """Cost per vertex on the largest cloth over that on the smallest."""
    return per_vertex(some[-1]) / per_vertex(some[0]) if per_vertex(some[0]) else float("nan")


def sizes_text(effects):
    """Which effects are not timed at the largest size."""
    largest = max((row["vertices"] for some in effects.values() for row in some), default=0)
    small = [f"{name} ({some[-1]['vertices']:,})" for name, some in effects.items()
             if some[-1]["vertices"] < largest]
    return (f"Not timed at {largest:,} vertices, only at fewer: {', '.join(small)}. " if small else "")


def title(effects):
    """For how many effects the cost per vertex grows with the cloth."""
    known = {name: growth(some) for name, some in effects.items() if len(some) > 1}
    grown = [name for name in known if known[name] > TWICE]
    if not known:
        return "Time of each effect for each vertex"
    if not grown:
        return (f"None of {len(known)} effects costs more than twice as much per vertex on the largest "
                "cloth\nas on the smallest")
    most = max(grown, key=known.get)
    return (f"{len(grown)} of {len(known)} effects cost more than twice as much per vertex on the "
            f"largest cloth as on the smallest,\nmost of all {most}: {style.number(known[most], 2)} times")


def _draw(effects, rows, out):
    figure, axes = plt.subplots(figsize=(9.6, 1.4 + 0.33 * len(effects)), layout="constrained")
    sizes = sorted({row["vertices"] for some in effects.values() for row in some})
    dot = {size: dict(color=shade, ms=4.5) for size, shade in zip(sizes, SHADES[-len(sizes):])}
    for effect, some in enumerate(effects.values()):
        for row in some:
            y = effect + 0.17 * (sizes.index(row["vertices"]) - (len(sizes) - 1) / 2)
            axes.hlines(y, per_vertex(row, "ns_lowest"), per_vertex(row, "ns_highest"), linewidth=1,
                        color=dot[row["vertices"]]["color"])
            axes.plot(per_vertex(row), y, "o", **dot[row["vertices"]])
    for size in sizes:
        axes.plot([], [], "o", label=f"{size:,} vertices", **dot[size])
    if step := whole_step(rows):
        axes.axvline(iterations(rows) * per_vertex(step), color=style.GREY, linestyle="--", linewidth=1,
                     label=f"a whole step with crossover\nsprings and no effect but\ngravity, "
                           f"{step['vertices']:,} vertices")
    style.plain_log(axes, "x")
    axes.set_yticks(range(len(effects)), labels=effects)
    axes.set_ylim(len(effects) - 0.5, -0.5)
    axes.set_xlabel("ns per vertex and step")
    axes.legend(loc="center left", bbox_to_anchor=(1.01, 0.5))
    figure.suptitle(title(effects), x=0.01, ha="left", fontsize=11.5)
    return style.save(figure, out, "fig_performance_effects")


def _table(effects):
    return Table("Effects: ns per vertex and step",
                 ["effect", *COLUMNS, "share of its scene's step", "actions per step", "ns per action"],
                 [[name, *columns(row), part(row.get("share_of_step")),
                   f"{row['acted_per_step']:,.0f}" if "acted_per_step" in row else "–",
                   style.number(row.get("per_action_ns"))] for name, some in effects.items() for row in some])
