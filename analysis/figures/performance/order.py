"""Constraints in order of colour, compared with constraints in list order: error after a step, and time."""
from bendlab.results.load import group
from figures.performance.rows import whole_step
from tables.numbers import number, span
from tables.table import Table

SCENES = {"corner": "square, hangs from a corner", "strip": "strip, hangs from its top edge",
          "irregular": "irregular mesh, hangs from two corners"}
ORDERS = {"colour": "by colour", "colour_from_pins": "by colour, found from the pins outward",
          "from_pins": "one by one from the pins outward", "to_pins": "one by one towards the pins"}


def main(bench, out, section):
    scenes, faster = by_scene(bench["rows"]), speed(bench["rows"])
    section.commands = ["./bendlab bench --filter '^convergence/'"]
    section.text += " " + time_text(bench["rows"])
    if absent := [name for name in SCENES if name not in scenes]:
        section.missing.append(f"scenes that compare orders: {', '.join(absent)}")
    if not scenes:
        return
    rows = [{"scene": SCENES.get(name, name), "iterations": row["sweeps"], "order": label,
             "error": row[f"strain_error_{order}"], "list": row["strain_error_mesh"],
             "change": 100 * (row[f"strain_error_{order}"] / row["strain_error_mesh"] - 1),
             "more": more(row) if order == "colour" else None}
            for name, series in scenes.items() for row in series for order, label in ORDERS.items()]
    limits = [("change", 0, "list order")]
    if faster:
        limits.append(("more", faster, f"a step by colour is {number(faster)} times as fast"))
    section.add_chart(
        Table.of("order", "Mean strain error after one step", [
            "scene", "iterations", "order", ("error", "strain error"), ("list", "in list order"),
            ("change", "change of the error against list order", "+.1f", "%"),
            ("more", "iterations for an equal error, by colour over list order")], rows),
        title(scenes), "iterations", ["change", "more"], ["order"], held=["scene"], scale="log2", look="",
        limits=limits,
        note="Errors are compared after the same number of iterations; below 0, order by colour has the "
             "smaller error. The line states how many times as fast a step by colour is. Below this line, "
             "order by colour is faster than the oracle (scalar code in list order).")


def by_scene(rows):
    """Scene → rows of the benchmark, sorted by number of iterations."""
    scenes = group((row for row in rows if row["name"].startswith("convergence/")),
                   lambda row: row["name"].split("/")[1])
    return {name: sorted(series, key=lambda row: row["sweeps"]) for name, series in scenes.items()}


def speed(rows):
    """Time of a step in list order over its time by colour, in double precision; None if not measured."""
    step = whole_step(rows, "double")
    return step and step["ratio_to_oracle"]


def more(row):
    """Iterations by colour over iterations in list order for an equal error; None if too many are needed."""
    return row["sweeps_to_match"] / row["sweeps"] if row["sweeps_to_match"] else None


def time_text(rows):
    """Text: in how many comparisons order by colour reaches the error of list order sooner."""
    compared, faster = [row for series in by_scene(rows).values() for row in series], speed(rows)
    if not compared or not faster:
        return ""
    sooner = sum(more(row) is not None and more(row) < faster for row in compared)
    return (f"A step by colour is {number(faster)} times as fast as a step of the oracle, the scalar code in "
            "list order (double precision, one thread, a larger cloth). By this estimate order by colour "
            f"reaches the error of list order sooner in {sooner} of {len(compared)} comparisons. But the "
            "oracle is written to be easy to check, and not to be fast. With faster code for list order, "
            "order by colour would be sooner in fewer comparisons.")


def title(scenes):
    rows = [row for series in scenes.values() for row in series]
    changes = [100 * (row["colour_over_mesh"] - 1) for row in rows]
    text = f"Order by colour changes the error by {number(min(changes), 1)} to {number(max(changes), 1)} %"
    if known := [more(row) for row in rows if more(row)]:
        text += (f". To reach the error of list order, order by colour needs {span(known, 2)} times as many "
                 "iterations")
    return text.replace("-", "−")
