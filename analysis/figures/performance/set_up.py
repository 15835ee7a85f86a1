"""The set-up with adaptive springs: time and memory from the rest mesh to the first step."""
from figures.performance.rows import at, iterations, series, shown, table
from tables.chart import Chart
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
    rows = [shown(row) | {"springs": row["constraints"], "name": f"{row['constraints']:,} springs, "
                          f"{row['vertices']:,} vertices", "seconds": row["set_up_s"],
                          "bytes": row["peak_bytes_per_spring"]}
            | {part: row["ns_per_constraint"] * row[part] / row["set_up_s"] for part in PARTS}
            for row in timed]
    section.tables.append(table("set_up", "Set-up", [
        ("springs", "springs", ",d"), "vertices", ("ns", "time per spring", "", "ns"), "range",
        ("seconds", "set-up", "", "s"),
        *((part, label, "", "ns per spring") for part, label in PARTS.items()),
        ("bytes", "memory at its peak, before the first step", "", "bytes per spring"),
        ("name", "", "", "ns", "time per spring", False)], rows))
    section.charts.append(Chart("set_up", title(timed), "set_up", "name", list(PARTS), kind="bars"))


def steps(row, timed, rounds):
    """After how many steps projections of these springs have taken as long as the set-up; None if unknown."""
    dense = at(timed, "dense", "float", row["vertices"])
    return row["ns_per_constraint"] / dense["ns_per_constraint"] / rounds if dense and rounds else None


def steps_text(rows):
    timed, rounds = series(rows), iterations(rows)
    known = [row for row in timed.get(("set_up", "float"), []) if steps(row, timed, rounds)]
    if not known:
        return ""
    return (f"Setting up {known[-1]['constraints']:,} springs takes as long as projecting them in "
            f"{number(steps(known[-1], timed, rounds), 2)} steps.")


def title(rows):
    last = rows[-1]
    return (f"Setting up {last['constraints']:,} springs takes {number(last['set_up_s'], 2)} s: "
            f"{number(last['ns_per_constraint'])} ns and {number(last['peak_bytes_per_spring'], 2)} bytes "
            "for each spring")
