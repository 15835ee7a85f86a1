"""What an iteration of each solver method costs, and what an iteration of quasi_newton consists of."""
from bendlab.results import registry
from figures.performance.rows import PRECISION, per_vertex, series, shown, table
from tables.chart import Chart
from tables.numbers import number

# Parts of quasi_newton, and the oracles that they are compared with: name in rows → name on the page.
PARTS = {"gradient": "quasi_newton, its gradient", "solve": "quasi_newton, its solve"}
ORACLES = {"gradient_oracle": "oracle of the gradient", "solve_oracle": "CHOLMOD's own solve"}
STEP = "method/"  # rows of whole steps begin so; the method's name follows


def lines(timed):
    """Name in rows → name on the page, for every timed method and for PARTS."""
    methods = sorted({name.removeprefix(STEP) for name, _ in timed if name.startswith(STEP)},
                     key=registry.method_place)
    return {STEP + name: name for name in methods} | PARTS


def main(bench, out, section):
    timed = series(bench["rows"])
    section.missing = missing(timed)
    section.commands = [f"./bendlab bench --filter '^(method|{'|'.join(PARTS)})/'"]
    rows = [shown(row)
            | {"kind": label, "method": label.split(",")[0], "two": threads_gain(bench["rows"], row),
               "drawn": name in lines(timed)}
            for name, label in (lines(timed) | ORACLES).items() for scalar in PRECISION
            for row in timed.get((name, scalar), [])]
    section.tables += [
        table("methods", "Methods",
              ["kind", "precision", "vertices", ("ns", "time per vertex or constraint", "", "ns"),
               "range", "vertex", ("two", "times as fast on two threads"), "ratio", "share"],
              rows),
        table("method_lines", "", ["vertices", "vertex", "kind", "precision"],
              [row for row in rows if row["drawn"]])]
    section.charts.append(Chart(
        "methods", title(timed), "method_lines", "vertices", ["vertex"], ["kind", "precision"], y_scale="log",
        look="method", note="Time of a whole step over its iterations; gradient and solve alone."))


def missing(timed):
    """A line for each precision that lacks rows."""
    expected = {"float": PARTS, "double": PARTS | ORACLES}
    lacking = [f"{PRECISION[scalar]} precision: {', '.join(absent)}" for scalar, named in expected.items()
               if (absent := [label for name, label in named.items() if (name, scalar) not in timed])]
    return lacking + ["whole steps"] * (lines(timed) == PARTS)


def title(timed):
    """The solve's part of an iteration and pbd's cost, on the largest cloth that all have in common."""
    of = {name: {row["vertices"]: row for row in timed.get((name, "float"), [])} for name in
          ("method/quasi_newton", "method/pbd", "solve")}
    both = set.intersection(*(set(sizes) for sizes in of.values()))
    if not both:
        return "Time of an iteration per vertex, over the size of the cloth"
    step, projections, solve = (per_vertex(sizes[max(both)]) for sizes in of.values())
    return (f"An iteration of quasi_newton costs {number(step)} ns per vertex, "
            f"{number(step / projections)} times an iteration of pbd; the solve is "
            f"{number(100 * solve / step, 2)} % of it (single precision, {max(both):,} vertices)")


def threads_gain(rows, row):
    """How many times as fast two threads are; None if they were not timed."""
    two = next((other for other in rows if other["threads"] == 2 and other["name"] == row["name"]
                and other["scalar"] == row["scalar"]), None)
    return row["ns_per_constraint"] / two["ns_per_constraint"] if two else None
