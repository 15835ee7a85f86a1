"""The speed of the kernels, compared with plain scalar code (the oracle) and with the least time that the
machine allows (the roofline).
"""
from figures.performance.kinds import at_usual, sizes
from figures.performance.rows import PRECISION, STRAIN, kinds, label, series, shown, table, to, usual
from tables.chart import Chart


def main(bench, out, section):
    timed = series(bench["rows"])
    section.commands = [f"./bendlab bench --filter '^({'|'.join(kinds(timed) or STRAIN)})/'"]
    rows = [shown(row) | {"kind": label(name)} for name in kinds(timed) for scalar in PRECISION
            for row in sizes(timed, name, scalar)]
    if not any(row["ratio"] or row["share"] for row in rows):
        section.missing.append("any kind of constraint")
        return
    section.tables.append(table("limits", "", ["kind", "precision", "vertices", "ratio", "share"], [
        row | {"size": f"{row['vertices']:,} vertices"} for row in rows]))
    section.charts.append(Chart(
        "limits", title(timed), "limits", "kind", ["ratio", "share"], ["precision", "size"], scale="band",
        y_scale="linear", look="", note=f"The oracle is timed only at {usual(timed):,} vertices. choi_ko "
                                        "springs with compliance have no comparison, because their oracle "
                                        "uses a slow bisection."))


def title(timed):
    """The title: the ranges of both ratios over all kinds, at the usual size."""
    rows = at_usual(timed, kinds(timed))
    faster = [row["ratio_to_oracle"] for row in rows if row["ratio_to_oracle"]]
    share = [100 * row["roofline_fraction"] for row in rows if row["roofline_fraction"]]
    if not faster or not share:
        return "Compared with the oracle and with the roofline"
    return (f"The kernels are {to(faster)} times as fast as the oracle and reach {to(share)} % of the "
            f"roofline (single precision, {usual(timed):,} vertices)")
