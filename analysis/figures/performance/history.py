"""The costs of constraints and steps in earlier versions of the program, from committed measurements."""
import json
from datetime import datetime

from figures.performance.rows import kinds, label, series, table, usual
from tables.chart import Chart
from tables.numbers import number

FILE = "history.json"  # beside the page, with a measurement per line
SECONDS_PER_DAY = 86_400


def main(bench, out, section):
    entries = measurements(bench, out)
    first = datetime.fromisoformat(entries[0]["date"])
    days = lambda entry: (datetime.fromisoformat(entry["date"]) - first).total_seconds() / SECONDS_PER_DAY
    rows = [{"kind": name, "days": days(entry), "ns": ns, "ratio": ratio, "commit": entry["commit"],
             "date": entry["date"][:10], "processor": entry["processor"]}
            for entry in entries for name, (ns, ratio) in entry["kinds"].items()]
    section.tables.append(table("history", "Medians of every committed measurement", [
        "kind", "date", "commit", "processor", ("days", f"days since {first:%Y-%m-%d}", ".2f"), "ns",
        "ratio"], rows))
    section.charts.append(Chart(
        "history", title(entries), "history", "days", ["ratio", "ns"], ["kind"], held=["processor"],
        scale="linear",
        y_scale="log", look="",
        note="Single precision, one thread, and the mesh for which most kinds are timed. Cloud machines with "
             "one name can have different speeds. The oracle is plain scalar code, timed in the same minute. "
             "So speeds relative to the oracle show changes of the program; times in ns also show changes "
             "of the machine."))


def measurements(bench, out):
    """The measurements in FILE and the measurement `bench`, sorted by date."""
    file = out / FILE
    kept = json.loads(file.read_text(encoding="utf-8")) if file.exists() else []
    entry = summary(bench)
    return sorted([measured for measured in kept if measured["date"] != entry["date"]] + [entry],
                  key=lambda measured: measured["date"])


def summary(bench):
    """The entry of a measurement in FILE."""
    context, timed = bench["context"], series(bench["rows"])
    size, known = usual(timed), {*kinds(timed), "step"}
    costs = {"whole step" if name == "step"
             else label(name): (row["ns_per_constraint"], row["ratio_to_oracle"])
             for (name, scalar), rows in timed.items() for row in rows
             if scalar == "float" and row["vertices"] == size and name in known}
    return {"date": context["date"], "commit": context["git_commit"][:12], "processor": context["processor"],
            "kinds": costs}


def title(entries):
    steps = [entry["kinds"]["whole step"][1] for entry in entries if "whole step" in entry["kinds"]]
    if len(steps) < 2:
        return "The cost of a constraint over time"
    before, now = (number(ratio) for ratio in steps[-2:])
    return f"A step is {now} times as fast as a step of the oracle (in the last measurement: {before} times)"
