"""What the order by colour costs: the strain error it leaves, against list order, and the time it saves."""
from figures.performance.rows import kind, to
from tables.chart import Chart
from tables.numbers import number
from tables.table import Table

SCENES = {"corner": "square, hangs from a corner", "strip": "strip, hangs from its top edge",
          "irregular": "irregular mesh, hangs from two corners"}
ORDERS = {"colour": "by colour", "colour_from_pins": "by colour, found from the pins outward",
          "from_pins": "one by one from the pins outward", "to_pins": "one by one towards the pins"}


def main(bench, out, section):
    scenes = by_scene(bench["rows"])
    section.commands = ["./bendlab bench --filter '^convergence/'"]
    section.text += " " + time_text(bench["rows"])
    absent = [name for name in SCENES if name not in scenes]
    if absent:
        section.missing.append(f"scenes for comparing orders: {', '.join(absent)}")
    if not scenes:
        return
    rows = [{"scene": SCENES.get(name, name), "iterations": row["sweeps"], "order": label,
             "error": row[f"strain_error_{order}"], "list": row["strain_error_mesh"],
             "change": 100 * (row[f"strain_error_{order}"] / row["strain_error_mesh"] - 1),
             "more": more(row) if order == "colour" else None}
            for name, series in scenes.items() for row in series for order, label in ORDERS.items()]
    section.tables.append(Table.of("order", "Mean strain error after one step", [
        "scene", "iterations", "order", ("error", "strain error"), ("list", "in list order"),
        ("change", "change of the error against list order", "+.1f", "%"),
        ("more", "times as many iterations for the error of list order")], rows))
    faster = speed(bench["rows"])
    section.charts.append(Chart(
        "order", title(scenes), "order", "iterations", ["change", "more"], ["order"], held=["scene"],
        scale="log2",
        look="", limits=[("change", 0, "list order"),
                         *([("more", faster,
                             f"{number(faster)}: a step by colour is this many times as fast")] if faster
                           else [])],
        note="Error compared with list order after the same number of iterations; below 0 is better. Below "
             "the line of speed, iterations by colour nevertheless take less time than the oracle in list "
             "order."))


def by_scene(rows):
    """Scene → its rows by number of iterations."""
    scenes = {}
    for row in rows:
        if row["name"].startswith("convergence/"):
            scenes.setdefault(row["name"].split("/")[1], []).append(row)
    return {name: sorted(series, key=lambda row: row["sweeps"]) for name, series in scenes.items()}


def speed(rows):
    """Speed of a step by colour over list order, in double precision like the scenes; None without a row."""
    return next((row["ratio_to_oracle"] for row in rows if kind(row) == "step" and row["threads"] == 1
                 and row["scalar"] == "double"), None)


def more(row):
    """How many times as many iterations order by colour needs for the error of list order; None: too many."""
    return row["sweeps_to_match"] / row["sweeps"] if row["sweeps_to_match"] else None


def time_text(rows):
    """In how many comparisons the order by colour reaches the error of list order sooner."""
    compared, faster = [row for series in by_scene(rows).values() for row in series], speed(rows)
    if not compared or not faster:
        return ""
    sooner = sum(more(row) is not None and more(row) < faster for row in compared)
    return (f"A step by colour is {number(faster)} times as fast as a step of the oracle, which takes "
            "list order (double precision, one thread, a larger cloth). By this estimate order by colour "
            f"reaches the error of list order sooner in {sooner} of {len(compared)} comparisons. But the "
            "oracle is written to be checked and not to be fast; against faster code in list order there "
            "would be fewer.")


def title(scenes):
    rows = [row for series in scenes.values() for row in series]
    worse = [100 * (row["colour_over_mesh"] - 1) for row in rows]
    known = [more(row) for row in rows if more(row)]
    text = (f"Order by colour changes the error by {number(min(worse), 1)} to {number(max(worse), 1)} %")
    if known:
        text += f"; it needs {to(known)} times as many iterations for the error of list order"
    return text.replace("-", "−")
