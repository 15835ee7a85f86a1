"""The page of what the solver costs on this machine, made from the output of `bendlab bench --json`."""
import json
import re
import sys

from figures.performance import (effects, history, kinds, limits, methods, order, overview, set_up, sizes,
                                 threads)
from figures.performance.rows import PRECISION, iterations, per_vertex, shown, table
from pages.project import Content, Figure, Page
from tables.numbers import number, rounded
from tables.section import write_objects
from web.html_parts import Made, Part, element, escape, folded, table_html

FILE = "results/performance/bench.json"
MEASURE = f"./bendlab bench --json > {FILE}"
FIGURES = [
    Figure(overview, "What does a step cost?", "A step"),
    Figure(sizes, "Does a constraint cost more on a larger cloth?", "Size",
           "A larger cloth no longer fits the caches of the processor, so its constraints wait for memory. "
           "An iteration visits every constraint once; the time is that of a constraint in an iteration."),
    Figure(kinds, "What does each kind of constraint cost?", "Kinds",
           "Models differ in the cost of a constraint and in the number of constraints. So both costs are "
           "shown: per constraint and per vertex."),
    Figure(limits, "How near is that to what the machine can do?", "Limits",
           "Two comparisons. The oracle is plain scalar code: one constraint at a time, straight from the "
           "formulas. The roofline is the least time that arithmetic, caches and memory of this machine "
           "allow; at 100 % of it the code would be as fast as the machine can be."),
    Figure(methods, "What does an iteration of each solver method cost?", "Methods",
           "On one cloth, with hinges. An iteration visits every constraint (pbd), finds a gradient and "
           "solves with a factor that it keeps (quasi_newton), factorises (newton), or visits every vertex "
           "(vbd). How much nearer an iteration comes to the answer is another question: the page of "
           "accuracy compares errors over time. The gradient and the solve are also timed alone."),
    Figure(effects, "What does each effect add?", "Effects",
           "A scene lists its effects; an effect that is not listed costs nothing. Each effect is timed in a "
           "scene in which it has work: obstacles are touched, and cloth that collides with itself lies in "
           "five layers."),
    Figure(set_up, "What does setting up cost?", "Set-up",
           "Before the first step the springs are found and sorted: which vertices lie in which ring, and "
           "which springs share no vertex (a colour), so that they can be projected side by side. Measured "
           "on adaptive springs, of which a fine mesh has many."),
    Figure(order, "What does the order by colour cost?", "Order",
           "Constraints of one colour share no vertex, so the processor can project many at once. The price: "
           "in one iteration a correction travels less far than in list order, where a constraint sees at "
           "once how the constraint before it moved the vertices. The error is the mean strain of the "
           "triangles after a step."),
    Figure(threads, "What do more threads gain?", "Threads"),
    Figure(history, "Was it faster before?", "History"),
]


def default_results(out):
    """The file with the rows, unless the caller names another file."""
    return out / "bench.json"


def read(file):
    """What the benchmark printed into a file."""
    try:
        return json.loads(file.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        sys.exit(f"{file}: {error}; make it with: ./bendlab bench --json > {file}")


def write_data(sections, bench, out):
    """summary.json: an object per row; and bench.json, unless the rows are from there."""
    file = out / "bench.json"
    if not file.exists() or read(file) != bench:
        file.write_text(json.dumps(bench, indent=1), encoding="utf-8")
    write_objects(out / history.FILE, history.measurements(bench, out))
    write_objects(out / "summary.json", [
        rounded({**row, "ns_per_vertex": per_vertex(row) if row["ns_per_constraint"] is not None else None})
        for row in bench["rows"]])


def content(sections, out):
    """The answer, how it was measured, every row."""
    bench = read(out / "bench.json")
    context = bench["context"]
    parts = [Part("method", "How was it measured?", method_html(bench) + machine_html(context), "Method"),
             Part("rows", "Every timed row", rows_html(bench["rows"]), "Rows"),
             Part("data", "As data", "<p><a href='summary.json'>summary.json</a>: every row, with the time "
                  "per vertex. <a href='bench.json'>bench.json</a>: as the program wrote it.</p>"
                  f"<pre>{escape(PAGE.everything)}</pre>", "Data")]
    overview_text = next((section.text for section in sections if section.id == "overview"), "")
    return Content(escape(overview_text) or "There is no row of a whole step.",
                   f"<p class='lead'>{escape(origin(context))}</p>", parts, made=made_by(context))


def made_by(context):
    """Commit, date and machine of the rows."""
    return Made(context["git_commit"][:12] + (" with changes" if context["git_dirty"] else ""),
                context["date"].replace("T", " ").rstrip("Z") + " UTC",
                f"{context['processor']}, {context['host']}", MEASURE)


def origin(context):
    """Where and when the rows were measured, and with which program."""
    return (f"Measured on {context['date'][:10]} on one machine: {context['processor']}, "
            f"{context['vector_bits']}-bit vectors, {context['compiler']}, commit "
            f"{context['git_commit'][:12]} {tree(context)}.")


def tree(context):
    return "with changes that are not committed" if context["git_dirty"] else "without further changes"


def method_html(bench):
    """How the rows were measured, as HTML."""
    timed = [row for row in bench["rows"] if row["repetitions"]]
    repetitions = sorted({row["repetitions"] for row in timed})
    rounds = iterations(bench["rows"])
    return ("<p>Constraints and effects are timed in the steps of a cloth that moves, so that positions, "
            "branches and caches are as in a run. "
            + (f"A step has {rounds} iterations, and an iteration visits every constraint once. " if rounds
               else "")
            + (f"Each number is the median of {' or '.join(map(str, repetitions))} repetitions, with the "
               "lowest and the highest beside it. " if repetitions else "")
            + "Where one thread works, its processor time counts; where several do, the time on the clock."
            "</p><p>The <b>oracle</b> is the scalar code: one constraint at a time, in list order, straight "
            "from the formulas. It is written to be checked, and the fast code must agree with it. It is "
            "timed at one size, and every size is compared with that time. The oracle of a solve is "
            "CHOLMOD's own, in double precision and at each size. The <b>roofline</b> is the least "
            "time that the machine allows: the largest of the time for the arithmetic, for the bytes through "
            "the first cache, and for the bytes through the memory that holds the whole cloth. Its limits "
            "are measured in the same process; they stand below.</p>")


def machine_html(context):
    """Machine and program as an HTML table."""
    rows = {"processor": context["processor"], "vectors": f"{context['vector_bits']} bits",
            "host": context["host"], "date (UTC)": context["date"].replace("T", " ").rstrip("Z"),
            "compiler": context["compiler"], "flags": context["flags"], "build": context["build_type"],
            "version of bendlab": context["version"],
            "commit": f"{context['git_commit']}, {tree(context)}",
            "hash of the source": context["source_hash"]}
    for key, value in context.items():
        if size := re.fullmatch(r"triad_(\d+)_(\w+)_GB_per_s", key):
            rows[f"bandwidth on {size[1]} {size[2]}"] = f"{number(value)} GB/s"
        elif peak := re.fullmatch(r"peak_(\w+)_Gflop_per_s", key):
            rows[f"peak in {PRECISION[peak[1]]} precision"] = f"{number(value)} Gflop/s"
    cells = "".join(element("tr", "".join(element("td", escape(text), class_="t") for text in row))
                    for row in rows.items())
    return element("div", element("table", element("tbody", cells), class_="cards"), class_="scroll")


def rows_html(rows):
    """Every timed row as a folded table."""
    timed = [shown(row) | {"row": row["name"]} for row in rows if row["ns_per_constraint"] is not None]
    made = table("rows", "ns per constraint and iteration (set_up: per spring; effects: per vertex and step; "
                 "methods: per vertex and iteration; solves: per vertex)",
                 ["row", "threads", "precision", "vertices", ("ns", "ns"), "range", "ratio", "share"], timed)
    return folded(f"All {len(timed)} timed rows", table_html(made)) if timed else "<p>There are no rows.</p>"


PAGE = Page("performance", "What does the solver cost?", MEASURE, FIGURES, content, write_data,
            read=read)
