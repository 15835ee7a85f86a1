"""How much time several threads save: for one step, for two runs at once, and for recording frames."""
from figures.performance.rows import PRECISION, first, kind
from tables.numbers import number, span
from tables.table import Table


def main(bench, out, section):
    rows = bench["rows"]
    steps = by_precision(rows)
    section.commands = ["./bendlab bench --filter '^(step|recording|sweep)/'"]
    section.text += " " + beside_text(rows)
    if not any(len(series) > 1 for series in steps.values()):
        section.missing.append("a step on more than one thread: step/…/threads:…")
    section.missing += [f"{name}/…" for name in ("recording", "sweep") if not first(rows, name)]
    if not steps:
        return
    section.add_chart(
        Table.of("threads", "A step by threads", [
            "precision", "threads", ("vertices", "vertices", ",d"), ("ms", "time per step", "", "ms"),
            ("gain", "times as fast as one thread"), ("name", "threads", "", "", "", False)],
            [shown(row, gain(series, row)) for series in steps.values() for row in series]),
        title(steps), "name", ["ms", "gain"], ["precision"], scale="band", y_scale="linear", look="",
        note="The step has strain and crossover springs. On one thread, times are processor times. On "
             "several threads, times are wall times, which other programs can increase.")


def shown(row, gained):
    """A row of a step as a row of the page's table."""
    return {"precision": PRECISION[row["scalar"]], "threads": row["threads"], "vertices": row["vertices"],
            "ms": row["call_ms"], "gain": gained,
            "name": f"{row['threads']} thread{'s' if row['threads'] > 1 else ''}",
            "ms_low": row["call_ms"] * row["ns_lowest"] / row["ns_per_constraint"],
            "ms_high": row["call_ms"] * row["ns_highest"] / row["ns_per_constraint"]}


def by_precision(rows):
    """Precision → rows of steps, sorted by number of threads."""
    return {scalar: sorted(steps, key=lambda row: row["threads"]) for scalar in PRECISION
            if (steps := [row for row in rows if kind(row) == "step" and row["scalar"] == scalar])}


def gain(steps, row):
    """Time of a step on one thread over the time in this row; NaN if one thread was not timed."""
    alone = next((other["call_ms"] for other in steps if other["threads"] == 1), float("nan"))
    return alone / row["call_ms"]


def beside_text(rows):
    """Text: how much time a second core saves for whole runs."""
    sweep, recording, text = first(rows, "sweep"), first(rows, "recording"), []
    between = lambda row, name: span([row[f"{name}_lowest"], row[f"{name}_highest"]])
    if sweep:
        text.append(f"Two runs side by side are {number(sweep['speed_up'], 2)} times as fast as one "
                    f"after the other ({between(sweep, 'speed_up')}).")
    if recording:
        text.append("A separate thread records 30 frames a second with every metric. In wall time, a run "
                    f"with this thread takes {number(recording['wall_ratio'])} times as long as a run "
                    f"without recording ({between(recording, 'wall_ratio')}).")
    return " ".join(text)


def title(steps):
    """The title: how much faster a step is on the largest number of threads."""
    most = max((series[-1]["threads"] for series in steps.values()), default=1)
    gains = [f"{number(gain(series, series[-1]), 2)} times ({PRECISION[scalar]} precision)"
             for scalar, series in steps.items() if series[-1]["threads"] == most > 1]
    if not gains:
        return "Time of a step on one thread"
    return f"On {most} threads a step is {' and '.join(gains)} as fast as on one"
