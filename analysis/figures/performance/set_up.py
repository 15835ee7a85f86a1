"""The set-up with adaptive springs: time and memory from the rest mesh to the first step."""
from figures.performance.rows import at, iterations, series, shown, table
from tables.numbers import number

PARTS = {"rings_and_pairs_s": "find rings and pairs",
         "colours_and_batches_s": "colour the springs, sort them by colour"}


def main(bench, out, section):
    timed = series(bench["rows"]).get(("set_up", "float"), [])
    section.commands = ["./bendlab bench --filter '^set_up/'"]
    section.text += " " + steps_text(bench["rows"])
    if not timed:
        section.missing.append("set_up/…/float")
        return
    rows = [shown(row) | {"springs": row["constraints"],
                          "name": f"{row['constraints']:,} springs, {row['vertices']:,} vertices",
                          "seconds": row["call_ms"] / 1e3, "bytes": row["peak_bytes_per_spring"]}
            | {part: 1e9 * row[part] / row["constraints"] for part in PARTS}
            for row in timed]
    section.add_chart(table("set_up", "Set-up", [
        ("springs", "springs", ",d"), "vertices", ("ns", "time per spring", "", "ns"), "range",
        ("seconds", "set-up", "", "s"),
        *((part, label, "", "ns per spring") for part, label in PARTS.items()),
        ("bytes", "memory at its peak, before the first step", "", "bytes per spring"),
        ("name", "", "", "ns", "time per spring", False)], rows), title(timed), "name", [*PARTS], kind="bars")


def steps_text(rows):
    """A sentence: after how many steps projections of the springs have taken as long as the set-up."""
    timed, rounds = series(rows), iterations(rows)
    known = [(row, dense) for row in timed.get(("set_up", "float"), [])
             for dense in at(timed, ["dense"], row["vertices"])]
    if not known or not rounds:
        return ""
    row, dense = known[-1]
    return (f"Setting up {row['constraints']:,} springs takes as long as projecting them in "
            f"{number(row['ns_per_constraint'] / dense['ns_per_constraint'] / rounds, 2)} steps.")


def title(rows):
    last = rows[-1]
    return (f"Setting up {last['constraints']:,} springs takes {number(last['call_ms'] / 1e3, 2)} s: "
            f"{number(last['ns_per_constraint'])} ns and {number(last['peak_bytes_per_spring'], 2)} bytes "
            "for each spring")
