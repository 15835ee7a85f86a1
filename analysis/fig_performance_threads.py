"""What more threads gain: one cloth on several, several runs side by side, recording beside stepping."""
import matplotlib.pyplot as plt

import style
from fig_performance import PRECISION, kind
from report import Section, Table

COLOURS = dict(zip(PRECISION, style.SEQUENCE))


def main(bench, out):
    rows = bench["rows"]
    steps = by_precision(rows)
    section = Section("What do more threads gain?", "threads",
                      commands=["./bendlab bench --filter '^(step|recording|sweep)/'"])
    section.text = beside_text(rows)
    if not any(len(some) > 1 for some in steps.values()):
        section.missing.append("a step on more than one thread: step/…/threads:…")
    section.missing += [f"{name}/…" for name in ("recording", "sweep") if not named(rows, name)]
    if steps:
        section.pictures.append((_draw(steps, out), "A step of strain and crossover springs. Lines at the "
                                 "end of a bar: lowest to highest. One thread: processor time; several: time "
                                 "on the clock, so that other programs on the machine count."))
        section.tables.append(Table("A step by threads", ["precision", "threads", "vertices", "ms per step",
                                                          "times as fast as one thread"],
                                    [[PRECISION[scalar], row["threads"], f"{row['vertices']:,}",
                                      style.number(row["step_ms"]), style.number(gain(some, row))]
                                     for scalar, some in steps.items() for row in some]))
    return section


def named(rows, name):
    """The first row of a kind, None if there is none."""
    return next((row for row in rows if kind(row) == name), None)


def by_precision(rows):
    """Precision → the steps by number of threads."""
    return {scalar: sorted(some, key=lambda row: row["threads"]) for scalar in COLOURS
            if (some := [row for row in rows if kind(row) == "step" and row["scalar"] == scalar])}


def gain(some, row):
    """How many times as fast as on one thread; NaN without a row of one thread."""
    one = next((other["step_ms"] for other in some if other["threads"] == 1), float("nan"))
    return one / row["step_ms"]


def beside_text(rows):
    """What a second core gains for whole runs."""
    sweep, recording, text = named(rows, "sweep"), named(rows, "recording"), []
    if sweep:
        text.append(f"Two runs side by side are {style.number(sweep['speed_up'], 2)} times as fast as one "
                    "after the other "
                    f"({style.number(sweep['speed_up_lowest'])} to "
                    f"{style.number(sweep['speed_up_highest'])}).")
    if recording:
        text.append(f"Recording 30 frames a second with every metric has a thread of its own; on the clock "
                    f"a run then takes {style.number(recording['wall_ratio'])} times as long as without "
                    f"({style.number(recording['wall_ratio_lowest'])} to "
                    f"{style.number(recording['wall_ratio_highest'])}).")
    return " ".join(text)


def threads_of(row):
    return f"{row['threads']} thread{'s' if row['threads'] > 1 else ''}"


def title(steps):
    """What the most threads gain."""
    most = max((row["threads"] for some in steps.values() for row in some), default=1)
    gains = [f"{style.number(gain(some, some[-1]), 2)} times ({PRECISION[scalar]} precision)"
             for scalar, some in steps.items() if some[-1]["threads"] == most > 1]
    if not gains:
        return "Time of a step on one thread"
    return f"On {most} threads a step is {' and '.join(gains)} as fast as on one"


def _draw(steps, out):
    bars = [(scalar, row) for scalar, some in steps.items() for row in some]
    figure, axes = plt.subplots(figsize=(8.6, 1.2 + 0.42 * len(bars)), layout="constrained")
    for y, (scalar, row) in enumerate(bars):
        low, high = (row["step_ms"] * row[key] / row["ns_per_constraint"]
                     for key in ("ns_lowest", "ns_highest"))
        axes.barh(y, row["step_ms"], color=COLOURS[scalar], height=0.62)
        axes.hlines(y, low, high, color=style.INK, linewidth=1)
        axes.annotate(f"{style.number(row['step_ms'])} ms", (high, y), xytext=(6, 0),
                      textcoords="offset points", va="center")
    axes.set_yticks(range(len(bars)), labels=[f"{PRECISION[scalar]}, {threads_of(row)}"
                                              for scalar, row in bars])
    axes.invert_yaxis()
    axes.margins(x=0.12)
    axes.set_xlim(left=0)
    axes.set_xlabel(f"ms per step, {bars[0][1]['vertices']:,} vertices")
    figure.suptitle(title(steps), x=0.01, ha="left", fontsize=11.5)
    return style.save(figure, out, "fig_performance_threads")
