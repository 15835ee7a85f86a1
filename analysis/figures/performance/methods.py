"""The cost of an iteration of each solver method, and of the two parts of an iteration of quasi_newton."""
from bendlab.results import registry
from figures.performance.rows import PRECISION, at, first, kind, lacking, per_vertex, series, shown, table
from tables.numbers import number

# Parts of an iteration of quasi_newton, and their oracles: {name in the benchmark: name on the page}.
PARTS = {"gradient": "quasi_newton, its gradient", "solve": "quasi_newton, its solve"}
ORACLES = {"gradient_oracle": "oracle of the gradient", "solve_oracle": "CHOLMOD's own solve"}
STEP = "method/"  # rows of whole steps are named STEP + method


def main(bench, out, section):
    timed, both = series(bench["rows"]), PARTS | ORACLES
    methods = sorted({name.removeprefix(STEP) for name, _ in timed if name.startswith(STEP)},
                     key=registry.method_place)
    names = {STEP + method: method for method in methods} | both
    section.missing = lacking(timed, PARTS, both.get, ["float"]) + lacking(timed, both, both.get, ["double"])
    if not methods:
        section.missing.append("whole steps")
    section.commands = [f"./bendlab bench --filter '^(method|{'|'.join(PARTS | ORACLES)})/'"]
    rows = [shown(row) | {"kind": label, "method": label.split(",")[0],
                          "two": threads_gain(bench["rows"], row), "drawn": name not in ORACLES}
            for name, label in names.items() for scalar in PRECISION for row in timed.get((name, scalar), [])]
    section.tables.append(table("methods", "Methods", [
        "kind", "precision", "vertices", ("ns", "time per vertex or constraint", "", "ns"), "range", "vertex",
        ("two", "times as fast on two threads"), "ratio", "share"], rows))
    section.add_chart(
        table("method_lines", "", ["vertices", "vertex", "kind", "precision"],
              [row for row in rows if row["drawn"]]),
        title(timed), "vertices", ["vertex"], ["kind"], id="methods", held=["precision"], at="single",
        y_scale="log", look="",
        note="Time of a step divided by its iterations. Gradient and solve are parts.")


def title(timed):
    """The title: costs of an iteration, its solve and an iteration of pbd, on the largest common cloth."""
    names = ("method/quasi_newton", "method/pbd", "solve")
    both = set.intersection(*({row["vertices"] for row in timed.get((name, "float"), [])} for name in names))
    if not both:
        return "Time of an iteration per vertex, for several sizes of the cloth"
    step, projections, solve = map(per_vertex, at(timed, names, max(both)))
    return (f"An iteration of quasi_newton costs {number(step)} ns per vertex, "
            f"{number(step / projections)} times an iteration of pbd; the solve takes "
            f"{number(100 * solve / step, 2)} % of it (single precision, {max(both):,} vertices)")


def threads_gain(rows, row):
    """How many times as fast two threads are as one. None if two threads were not timed."""
    two = first(rows, kind(row), name=row["name"], scalar=row["scalar"], threads=2)
    return row["ns_per_constraint"] / two["ns_per_constraint"] if two else None
