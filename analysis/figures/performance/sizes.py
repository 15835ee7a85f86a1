"""The time per constraint against the size of the cloth."""
from figures.performance.rows import PRECISION, at, label, lacking, series, shown, table, usual
from tables.numbers import number

OVER_SIZE = ("strain", "crossover", "dense")


def main(bench, out, section):
    timed = series(bench["rows"])
    section.missing = lacking(timed, OVER_SIZE)
    section.commands = ["./bendlab bench --filter '^(strain|crossover|dense)'"]
    rows = [shown(row) | {"kind": label(name)} for name in OVER_SIZE
            for scalar in PRECISION for row in timed.get((name, scalar), [])]
    section.add_chart(
        table("sizes", "Cost over size",
              ["kind", "precision", "vertices", "ns", "range", "vertex"], rows),
        title(timed), "vertices", ["ns", "vertex"], ["kind", "precision"], y_scale="log", look="",
        dashed="precision")


def title(timed):
    """The title: time per constraint on the largest cloth over the time on the usual size, see usual()."""
    size, rows = usual(timed), {name: timed.get((name, "float"), []) for name in OVER_SIZE}
    largest = max((series[-1]["vertices"] for series in rows.values() if series), default=0)
    grown = [f"{number(series[-1]['ns_per_constraint'] / first[0]['ns_per_constraint'])} for {label(name)}"
             for name, series in rows.items() if (first := at(timed, [name], size))
             and series[-1]["vertices"] == largest > size]
    if not grown:
        return "Time per constraint over the size of the cloth"
    return (f"Time of a constraint on {largest:,} vertices over its time on {size:,}: {' and '.join(grown)} "
            "(single precision)")
