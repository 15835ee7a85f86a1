"""What the order by colour costs: the strain error it leaves, against list order, and the time it saves."""
import matplotlib.pyplot as plt

import style
from fig_performance import kind, to
from report import Section, Table

SCENES = {"corner": "square, hangs from a corner", "strip": "strip, hangs from its top edge",
          "irregular": "irregular mesh, hangs from two corners"}
COLOURS = dict(zip(SCENES, style.SEQUENCE))
ORDERS = {"colour": ("by colour", "-"), "colour_from_pins": ("by colour, found from the pins outward", ":"),
          "from_pins": ("one by one from the pins outward", "--")}


def main(bench, out):
    scenes = by_scene(bench["rows"])
    section = Section("What does the order by colour cost?", "order",
                      commands=["./bendlab bench --filter '^convergence/'"])
    section.text = ("Constraints of one colour share no vertex, so the processor can project many at once. "
                    "The price: in this order a correction can get less far in one iteration than in list "
                    "order, where a constraint sees at once what its neighbour before it moved. The error is "
                    "the mean strain of the triangles after one step. " + time_text(bench["rows"]))
    absent = [name for name in SCENES if name not in scenes]
    if absent:
        section.missing.append(f"scenes for comparing orders: {', '.join(absent)}")
    if scenes:
        section.pictures.append((_draw(scenes, speed(bench["rows"]), out), "Left: error compared with list "
                                 "order after the same number of iterations; below 0 is better. Right: how "
                                 "many times as many iterations by colour leave no more error than list "
                                 "order. Below the dashed line they nevertheless take less time than the "
                                 "oracle in list order."))
        section.tables.append(_table(scenes))
    return section


def by_scene(rows):
    """Scene → its rows by number of iterations."""
    found = {}
    for row in rows:
        if row["name"].startswith("convergence/"):
            found.setdefault(row["name"].split("/")[1], []).append(row)
    return {name: sorted(some, key=lambda row: row["sweeps"]) for name, some in found.items()}


def speed(rows):
    """How many times as fast as in list order a step is by colour, in double precision as in the scenes; None
    if no row says it."""
    return next((row["ratio_to_oracle"] for row in rows if kind(row) == "step" and row["threads"] == 1
                 and row["scalar"] == "double"), None)


def more(row):
    """How many times as many iterations order by colour needs for the error of list order; None: too many."""
    return row["sweeps_to_match"] / row["sweeps"] if row["sweeps_to_match"] else None


def time_text(rows):
    """In how many comparisons the order by colour reaches the error of list order sooner."""
    compared, faster = [row for some in by_scene(rows).values() for row in some], speed(rows)
    if not compared or not faster:
        return ""
    sooner = sum(more(row) is not None and more(row) < faster for row in compared)
    return (f"A step by colour is {style.number(faster)} times as fast as a step of the oracle, which takes "
            "list order (double precision, one thread, a larger cloth). By this estimate order by colour "
            f"reaches the error of list order sooner in {sooner} of {len(compared)} comparisons. But the "
            "oracle is written to be checked and not to be fast; against faster code in list order there "
            "would be fewer.")


def title(scenes):
    rows = [row for some in scenes.values() for row in some]
    worse = [100 * (row["colour_over_mesh"] - 1) for row in rows]
    known = [more(row) for row in rows if more(row)]
    text = (f"Order by colour changes the error by {style.number(min(worse), 1)} to "
            f"{style.number(max(worse), 1)} %")
    if known:
        text += f";\nit needs {to(known)} times as many iterations for the error of list order"
    return text.replace("-", "−")


def _draw(scenes, faster, out):
    figure, (left, right) = plt.subplots(1, 2, figsize=(10.4, 4.2), layout="constrained")
    for name, some in scenes.items():
        x, colour = [row["sweeps"] for row in some], COLOURS.get(name, style.GREY)
        for order, (_, look) in ORDERS.items():
            change = [100 * (row[f"strain_error_{order}"] / row["strain_error_mesh"] - 1) for row in some]
            left.plot(x, change, look, marker="o", markersize=4, color=colour)
        known = [(row["sweeps"], more(row)) for row in some if more(row)]
        right.plot(*zip(*known), "o-", markersize=5, color=colour) if known else None
    left.axhline(0, color=style.INK, linewidth=0.8)
    if faster:
        right.axhline(faster, color=style.GREY, linestyle="--", linewidth=1,
                      label=f"{style.number(faster)}: a step by colour is\nthis many times as fast")
        right.legend()
    for panel in (left, right):
        panel.set_xlabel("iterations in list order" if panel is right else "iterations")
        panel.set_xscale("log")
        panel.set_xticks(*[sorted({row["sweeps"] for some in scenes.values() for row in some})] * 2)
        panel.minorticks_off()
    left.set_title("Error after the same number of iterations")
    right.set_title("Iterations for the same error")
    left.set_ylabel("change of the error against list order (%)")
    style.plain_log(right, "y")
    right.set_ylabel("times as many iterations by colour")
    for name in scenes:
        left.plot([], [], "o-", color=COLOURS.get(name, style.GREY), label=SCENES.get(name, name))
    for text, look in ORDERS.values():
        left.plot([], [], look, color=style.GREY, label=text)
    style.legend_below(figure, left, 2)
    figure.suptitle(title(scenes), x=0.01, ha="left", fontsize=11.5)
    return style.save(figure, out, "fig_performance_order")


def _table(scenes):
    keys = {"list order": "mesh", "by colour": "colour", "by colour, from the pins": "colour_from_pins",
            "one by one from the pins": "from_pins", "one by one towards the pins": "to_pins"}
    return Table("Mean strain error after one step", ["scene", "iterations", *keys,
                                                      "iterations by colour for the error of list order"],
                 [[SCENES.get(name, name), row["sweeps"],
                   *(style.number(row[f"strain_error_{key}"]) for key in keys.values()),
                   row["sweeps_to_match"] or "∞"] for name, some in scenes.items() for row in some])
