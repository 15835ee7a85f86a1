"""What it takes to get from a rest mesh to the first step with adaptive springs."""
import matplotlib.pyplot as plt

import style
from fig_performance import COLUMNS, at, columns, iterations, series
from report import Section, Table

PARTS = {"rings_and_pairs_s": ("find rings and pairs", style.SEQUENCE[5]),
         "colours_and_batches_s": ("colour them, sort them by colour", style.SEQUENCE[0])}


def main(bench, out):
    rows = series(bench["rows"]).get(("set_up", "float"), [])
    section = Section("What does setting up cost?", "set_up",
                      commands=["./bendlab bench --filter '^set_up/'"])
    section.text = ("Before the first step the springs are found and sorted: which vertices lie in which "
                    "ring, and which springs share no vertex (a colour), so that they can be projected side "
                    "by side. Measured on adaptive springs, of which a fine mesh has many. "
                    + steps_text(bench["rows"]))
    if rows:
        section.pictures.append((_draw(rows, out), "Left: time for each spring; the line: lowest to highest "
                                 "of the whole. Right: memory at its peak, before the first step."))
        section.tables.append(Table("Set-up: ns per spring",
                                    ["springs", *COLUMNS, "seconds", "rings and pairs (s)",
                                     "colours and batches (s)", "bytes per spring at the peak"],
                                    [[f"{row['constraints']:,}", *columns(row), style.number(row["set_up_s"]),
                                      *(style.number(row[part]) for part in PARTS),
                                      style.number(row["peak_bytes_per_spring"])] for row in rows]))
    else:
        section.missing.append("set_up/…/float")
    return section


def steps(row, table, rounds):
    """In how many steps the projection of the same springs takes as long as their set-up; None if unknown."""
    dense = at(table, "dense", "float", row["vertices"])
    return row["ns_per_constraint"] / dense["ns_per_constraint"] / rounds if dense and rounds else None


def steps_text(rows):
    table, rounds = series(rows), iterations(rows)
    known = [row for row in table.get(("set_up", "float"), []) if steps(row, table, rounds)]
    if not known:
        return ""
    return (f"For {known[-1]['constraints']:,} springs it takes as long as projecting them in "
            f"{style.number(steps(known[-1], table, rounds), 2)} steps.")


def title(rows):
    last = rows[-1]
    return (f"Setting up {last['constraints']:,} springs takes {style.number(last['set_up_s'], 2)} s: "
            f"{style.number(last['ns_per_constraint'])} ns and "
            f"{style.number(last['peak_bytes_per_spring'], 2)} bytes for each")


def _draw(rows, out):
    figure, (left, right) = plt.subplots(1, 2, figsize=(8.6, 3.4), layout="constrained", sharey=True,
                                         width_ratios=[1.6, 1])
    at_y = range(len(rows))
    done = [0.0] * len(rows)
    for part, (name, colour) in PARTS.items():
        width = [row["ns_per_constraint"] * row[part] / row["set_up_s"] for row in rows]
        left.barh(at_y, width, left=done, color=colour, label=name, height=0.6)
        done = [a + b for a, b in zip(done, width)]
    left.hlines(at_y, [row["ns_lowest"] for row in rows], [row["ns_highest"] for row in rows],
                color=style.INK, linewidth=1)
    right.barh(at_y, [row["peak_bytes_per_spring"] for row in rows], color=style.GREY, height=0.6)
    left.set_yticks(at_y, labels=[f"{row['constraints']:,} springs\n{row['vertices']:,} vertices"
                                  for row in rows])
    left.invert_yaxis()
    left.set_xlabel("ns per spring")
    right.set_xlabel("bytes per spring at the peak")
    style.legend_below(figure, left, 2)
    figure.suptitle(title(rows), x=0.01, ha="left", fontsize=11.5)
    return style.save(figure, out, "fig_performance_set_up")
