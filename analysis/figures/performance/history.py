"""The costs of constraints and steps in earlier versions of the program, from committed measurements."""
from datetime import datetime, timedelta

from figures.performance.rows import at, kinds, label, series, table, usual
from tables.numbers import number
from tables.section import read_objects

FILE = "history.json"  # beside the page, with a measurement per line


def main(bench, out, section):
    entries = measurements(bench, out)
    first, *_ = times = [datetime.fromisoformat(entry["date"]) for entry in entries]
    rows = [{"kind": name, "days": (time - first) / timedelta(days=1), "ns": ns, "ratio": ratio,
             "commit": entry["commit"], "date": entry["date"][:10], "processor": entry["processor"]}
            for entry, time in zip(entries, times) for name, (ns, ratio) in entry["kinds"].items()]
    section.add_chart(
        table("history", "Medians of every committed measurement", [
            "kind", "date", "commit", "processor", ("days", f"days since {first:%Y-%m-%d}", ".2f"), "ns",
            "ratio"], rows),
        title(entries), "days", ["ratio", "ns"], ["kind"], held=["processor"], scale="linear", y_scale="log",
        look="",
        note="Single precision, one thread, and the mesh for which most kinds are timed. Cloud machines with "
             "one name can have different speeds. The oracle is plain scalar code, timed in the same minute. "
             "So speeds relative to the oracle show changes of the program; times in ns also show changes "
             "of the machine.")


def measurements(bench, out):
    """The measurements in FILE and the measurement `bench`, sorted by date."""
    context, timed = bench["context"], series(bench["rows"])
    names = {name: label(name) for name in kinds(timed)} | {"step": "whole step"}
    costs = {names[name]: (row["ns_per_constraint"], row["ratio_to_oracle"])
             for name, _ in timed if name in names for row in at(timed, [name], usual(timed))}
    entry = {"date": context["date"], "commit": context["git_commit"][:12], "processor": context["processor"],
             "kinds": costs}
    others = [kept for kept in read_objects(out / FILE) if kept["date"] != entry["date"]]
    return sorted([*others, entry], key=lambda measured: measured["date"])


def title(entries):
    steps = [entry["kinds"]["whole step"][1] for entry in entries
             if "whole step" in entry["kinds"] and entry["processor"] == entries[-1]["processor"]]
    if len(steps) < 2:
        return "The cost of a constraint over time"
    before, now = map(number, steps[-2:])
    return (f"A step is {now} times as fast as a step of the oracle (in the last measurement on a processor "
            f"of this name: {before} times)")
