"""How much time each effect adds to a step, per vertex, for several sizes of the cloth."""
import json
import math

from figures.performance.rows import iterations, per_vertex, series, shown, table, whole_step
from runs.sweeps import CONFIGS
from tables.numbers import number

TWICE = 2


def known_effects():
    schema = json.loads((CONFIGS / "schema.json").read_text(encoding="utf-8"))
    return [kind["properties"]["type"]["const"] for kind in schema["properties"]["effects"]["items"]["oneOf"]]


def by_effect(rows):
    """{effect: its rows, from the smallest to the largest cloth}. The most expensive effect is first."""
    effects = {name.removeprefix("effect/"): sizes for (name, scalar), sizes in series(rows).items()
               if name.startswith("effect/") and scalar == "float"}
    return dict(sorted(effects.items(), key=lambda entry: -max(map(per_vertex, entry[1]))))


def main(bench, out, section):
    effects, step = by_effect(bench["rows"]), whole_step(bench["rows"])
    section.commands = ["./bendlab bench --filter '^effect/'"]
    largest = max((sizes[-1]["vertices"] for sizes in effects.values()), default=0)
    small = [f"{name} ({sizes[-1]['vertices']:,})" for name, sizes in effects.items()
             if sizes[-1]["vertices"] < largest]
    section.text += " "
    if small:
        section.text += f"These effects are not timed at {largest:,} vertices: {', '.join(small)}."
    if absent := [name for name in known_effects() if name not in effects]:
        section.missing.append(f"effects: {', '.join(absent)}")
    rows = [shown(row) | {"kind": name, "size": f"{row['vertices']:,} vertices",
                          "step": row.get("share_of_step") and 100 * row["share_of_step"],
                          "acted": row.get("acted_per_step"), "per_action": per_action(row)}
            for name, sizes in effects.items() for row in sizes]
    effects_table = table("effects", "Effects", [
        ("kind", "effect"), "vertices", ("vertex", "time per vertex and step", "", "ns"), "range",
        ("step", "share of the time of a step", "", "%"), ("acted", "actions per step", ",.0f"),
        ("per_action", "time per action", "", "ns")], rows)
    limits = [("vertex", iterations(bench["rows"]) * per_vertex(step),
               f"a whole step with crossover springs, {step['vertices']:,} vertices")] if step else []
    section.add_chart(
        effects_table, title(effects), "kind", ["vertex"], ["size"], scale="band", y_scale="log", look="",
        limits=limits, note="One thread, single precision. An effect acts on a vertex, a triangle or a "
                            "contact. The table states the number of actions per step, and their time.")


def per_action(row):
    """Time per action of an effect in ns; None if it does not act."""
    return 1e6 * row["call_ms"] / row["acted_per_step"] if row.get("acted_per_step") else None


def title(effects):
    """The title: for how many effects the cost per vertex grows with the size of the cloth."""
    known = {name: per_vertex(sizes[-1]) / (per_vertex(sizes[0]) or math.nan)
             for name, sizes in effects.items() if len(sizes) > 1}
    if not known:
        return "Time of each effect for each vertex"
    grown = {name: ratio for name, ratio in known.items() if ratio > TWICE}
    if not grown:
        return (f"None of {len(known)} effects costs more than twice as much per vertex on the largest "
                "cloth as on the smallest")
    most = max(grown, key=grown.get)
    return (f"{len(grown)} of {len(known)} effects cost more than twice as much per vertex on the "
            f"largest cloth as on the smallest. The largest ratio is {number(grown[most], 2)} ({most})")
