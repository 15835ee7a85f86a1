"""The speed of the kernels, compared with plain scalar code (oracle) and the machine's limit (roofline)."""
from figures.performance.kinds import command, rows_of
from figures.performance.rows import at, kinds, series, table, usual
from tables.numbers import span

MACHINE = "./bendlab bench --filter '^(triad|peak)/'"


def main(bench, out, section):
    timed = series(bench["rows"])
    section.commands, rows = [command(timed), MACHINE], rows_of(timed)
    if not any(row["ratio"] or row["share"] for row in rows):
        section.missing.append("any kind of constraint")
        return
    section.add_chart(
        table("limits", "", ["kind", "precision", "vertices", "ratio", "share"], rows), title(timed), "kind",
        ["ratio", "share"], ["precision", "size"], scale="band", y_scale="linear", look="",
        note=f"The oracle is timed only at {usual(timed):,} vertices. choi_ko springs with compliance have "
             "no comparison, because their oracle uses a slow bisection.")


def title(timed):
    """The title: the ranges of both ratios over all kinds, at the usual size."""
    rows = at(timed, kinds(timed), usual(timed))
    faster = [row["ratio_to_oracle"] for row in rows if row["ratio_to_oracle"]]
    share = [100 * row["roofline_fraction"] for row in rows if row["roofline_fraction"]]
    if not faster or not share:
        return "Compared with the oracle and with the roofline"
    return (f"The kernels are {span(faster, 2)} times as fast as the oracle and reach {span(share, 2)} % of "
            f"the roofline (single precision, {usual(timed):,} vertices)")
