"""How fast the kernels are, compared with plain code and with the least time that the machine allows."""
import style
from fig_performance import COLUMNS, STRAIN, columns, kinds, label, part, series, to, usual
from fig_performance_kinds import COLOURS, at_usual, dots, panels, sizes
from report import Section, Table


def main(bench, out):
    table = series(bench["rows"])
    section = Section("How near is that to what the machine can do?", "limits",
                      commands=[f"./bendlab bench --filter '^({'|'.join(kinds(table) or STRAIN)})/'"])
    section.text = ("Two comparisons. The oracle is plain scalar code: one constraint at a time, straight "
                    "from the formulas. The roofline is the least time that arithmetic, caches and memory of "
                    "this machine allow; at 100 % of it the code would be as fast as the machine can be.")
    compared = [name for name in kinds(table)
                if any(row["ratio_to_oracle"] or row["roofline_fraction"]
                       for scalar in COLOURS for row in table.get((name, scalar), []))]
    if compared:
        section.pictures.append((_draw(table, out), "Left: speed compared with the oracle, which is timed at "
                                 f"{usual(table):,} vertices only. Right: least possible time over "
                                 "measured time. choi_ko springs with compliance are not compared with their "
                                 "oracle: it halves an interval until it has the answer, which is slow."))
        section.tables.append(_table(table))
    else:
        section.missing.append("any kind of constraint")
    return section


def _draw(table, out):
    figure, (left, right) = panels(table)
    dots(left, table, lambda row, _: row["ratio_to_oracle"])
    dots(right, table, lambda row, _: row["roofline_fraction"] and 100 * row["roofline_fraction"])
    left.set_xlim(left=0), right.set_xlim(0, max(100, right.get_xlim()[1]))
    left.set_xlabel("times as fast as the oracle")
    right.set_xlabel("share of the roofline (%)")
    right.legend(loc="center left", bbox_to_anchor=(1.01, 0.5))
    figure.suptitle(title(table), x=0.01, ha="left", fontsize=11.5)
    return style.save(figure, out, "fig_performance_limits")


def title(table):
    """The range over the kinds at the usual size."""
    rows = at_usual(table, kinds(table))
    faster = [row["ratio_to_oracle"] for row in rows if row["ratio_to_oracle"]]
    share = [100 * row["roofline_fraction"] for row in rows if row["roofline_fraction"]]
    if not faster or not share:
        return "Compared with the oracle and with the roofline"
    return (f"The fast code is {to(faster)} times as fast as the oracle and reaches {to(share)} % of the "
            f"roofline\n(single precision, {usual(table):,} vertices)")


def _table(table):
    rows = [[label(name), *columns(row), style.number(row["ratio_to_oracle"]),
             part(row["roofline_fraction"])]
            for name in kinds(table) for scalar in COLOURS for row in sizes(table, name, scalar)]
    return Table("Compared with the oracle and the roofline: ns per constraint and iteration",
                 ["constraint", *COLUMNS, "times as fast as the oracle", "share of the roofline"], rows)
