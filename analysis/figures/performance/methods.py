"""The cost of an iteration of each solver method, and of the two parts of an iteration of quasi_newton."""
from bendlab.results import registry
from figures.performance.rows import PRECISION, per_vertex, series, shown, table
from tables.chart import Chart
from tables.numbers import number

# Parts of an iteration of quasi_newton, and their oracles: {name in the benchmark: name on the page}.
PARTS = {"gradient": "quasi_newton, its gradient", "solve": "quasi_newton, its solve"}
ORACLES = {"gradient_oracle": "oracle of the gradient", "solve_oracle": "CHOLMOD's own solve"}
STEP = "method/"  # rows of whole steps are named STEP + method


def lines(timed):
    """{name in the benchmark: name on the page} of every timed method and of PARTS."""
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
        look="method", note="Time of a step divided by its iterations. Gradient and solve are parts."))


def missing(timed):
    expected = {"float": PARTS, "double": PARTS | ORACLES}
    lacking = [f"{PRECISION[scalar]} precision: {', '.join(absent)}" for scalar, named in expected.items()
               if (absent := [label for name, label in named.items() if (name, scalar) not in timed])]
    return lacking + ["whole steps"] * (lines(timed) == PARTS)


def title(timed):
    """The title: costs of an iteration, its solve and an iteration of pbd, on the largest common cloth."""
    of = {name: {row["vertices"]: row for row in timed.get((name, "float"), [])} for name in
          ("method/quasi_newton", "method/pbd", "solve")}
    both = set.intersection(*(set(sizes) for sizes in of.values()))
    if not both:
        return "Time of an iteration per vertex, for several sizes of the cloth"
    step, projections, solve = (per_vertex(sizes[max(both)]) for sizes in of.values())
    return (f"An iteration of quasi_newton costs {number(step)} ns per vertex, "
            f"{number(step / projections)} times an iteration of pbd; the solve takes "
            f"{number(100 * solve / step, 2)} % of it (single precision, {max(both):,} vertices)")


def threads_gain(rows, row):
    """How many times as fast two threads are as one. None if two threads were not timed."""
    two = next((other for other in rows if other["threads"] == 2 and other["name"] == row["name"]
                and other["scalar"] == row["scalar"]), None)
    return row["ns_per_constraint"] / two["ns_per_constraint"] if two else None
