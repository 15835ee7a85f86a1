"""The page about the cost of the solver on this machine, from the output of `bendlab bench --json`."""
import json
import sys

from figures.performance import (effects, history, kinds, laws, limits, measured, methods, overview, set_up,
                                 sizes, threads)
from figures.performance.rows import PRECISION, iterations, per_vertex, shown, table
from pages.project import Content, Figure, Page
from tables.numbers import number, rounded
from tables.section import write_objects
from web.html_parts import Made, Part, element, escape, folded, row_html, scroll_table, table_html

MEASURE = "./bendlab bench --json > results/performance/bench.json"
FIGURES = [
    Figure(overview, "What does a step cost?", "A step"),
    Figure(sizes, "Does a constraint cost more on a larger cloth?", "Size",
           "A larger cloth no longer fits the caches of the processor, so its constraints wait for memory. "
           "An iteration projects every constraint once. The chart shows the time per constraint and "
           "iteration."),
    Figure(kinds, "What does each kind of constraint cost?", "Kinds",
           "Models differ in the cost of a constraint and in the number of constraints. So both costs are "
           "shown: per constraint and per vertex."),
    Figure(limits, "How near is the code to the limits of the machine?", "Limits",
           "The code is compared with the oracle and with the roofline. The oracle is plain scalar code that "
           "projects one constraint at a time, straight from the formulas. The roofline is the least time "
           "that the arithmetic, caches and memory of this machine allow. At 100 % of the roofline the code "
           "would be as fast as the machine can be."),
    Figure(methods, "What does an iteration of each solver method cost?", "Methods",
           "All methods solve one cloth with hinges. An iteration of pbd projects every constraint. "
           "quasi_newton computes a gradient and solves with a stored factorisation. newton computes the "
           "factorisation again in every iteration. vbd moves every vertex. This chart does not show how "
           "much an iteration reduces the error: the page of accuracy compares errors over time. The "
           "gradient and the solve are also timed separately."),
    Figure(effects, "What does each effect add?", "Effects",
           "A scene lists its effects; an effect that is not listed costs nothing. Each effect is timed in a "
           "scene in which the effect acts: the cloth touches the obstacles, and for collisions with itself "
           "the cloth lies in five layers."),
    Figure(laws, "What do the bending laws of fabrics cost?", "Laws",
           "A simple sheet has the moment B κ with one B. In a fabric, B may depend on the direction or on "
           "time, the moment may soften, the yarns may rub, and folds may stay. The same cloth is simulated "
           "with each law."),
    Figure(set_up, "What does setting up cost?", "Set-up",
           "Before the first step, the program finds the springs (which vertices lie in which ring) and "
           "sorts them by colour: springs of one colour share no vertex, so that they can be projected at "
           "the same time. The chart is for adaptive springs, because a fine mesh has many of them."),
    Figure(threads, "What do more threads gain?", "Threads"),
    Figure(history, "Was the solver faster before?", "History"),
]


def read(file):
    """The output of the benchmark, read from a file, with its rows and the limits of the machine."""
    try:
        bench = json.loads(file.read_text(encoding="utf-8"))
        if not isinstance(bench, dict) or not {"context", "benchmarks"} <= bench.keys():
            raise ValueError("it has no 'context' or no 'benchmarks'")
        return {"context": measured.context_of(bench), "benchmarks": bench["benchmarks"],
                "rows": measured.rows_of(bench), "machine": measured.machine_of(bench)}
    except (OSError, ValueError) as error:
        sys.exit(f"{file}: {error}. Write this file with: ./bendlab bench --json > {file}")


def write_data(sections, bench, out):
    """Writes summary.json, with an object per row, and bench.json, with an object of Google Benchmark per
    line. Google Benchmark itself needs several times the space."""
    context, benchmarks = json.dumps(bench["context"], indent=1), map(json.dumps, bench["benchmarks"])
    (out / "bench.json").write_text(
        f'{{"context": {context},\n "benchmarks": [\n' + ",\n".join(benchmarks) + "\n]}\n", encoding="utf-8")
    write_objects(out / history.FILE, history.measurements(bench, out))
    write_objects(out / "summary.json", [
        rounded({**row, "ns_per_vertex": per_vertex(row)}) for row in bench["rows"]])


def content(sections, out):
    """The page's answer, and sections on the method, on every row, and on the data."""
    bench = read(out / "bench.json")
    context = bench["context"]
    method = method_html(bench) + machine_html(context, bench["machine"])
    parts = [Part("method", "How was it measured?", method, "Method"),
             Part("rows", "Every timed row", rows_html(bench["rows"]), "Rows"),
             Part("data", "As data", "<p><a href='summary.json'>summary.json</a>: every row, with the time "
                  "per vertex. <a href='bench.json'>bench.json</a>: the output of the "
                  f"program.</p><pre>{escape(PAGE.everything)}</pre>", "Data")]
    measured = (f"Measured on {context['date'][:10]} on one machine: {context['processor']}, "
                f"{context['vector_bits']}-bit vectors, {context['compiler']}, commit "
                f"{context['git_commit'][:12]} {tree(context)}.")
    return Content(escape(overview.answer(bench["rows"])) or "There is no row of a whole step.",
                   f"<p class='lead'>{escape(measured)}</p>", parts, made=made_by(context))


def made_by(context):
    """Commit, date and machine of the rows."""
    return Made(context["git_commit"][:12] + (" with changes" if context["git_dirty"] == "true" else ""),
                context["date"].replace("T", " ").rstrip("Z") + " UTC",
                f"{context['processor']}, {context['host_name']}", MEASURE)


def tree(context):
    changed = context["git_dirty"] == "true"
    return "with changes that are not committed" if changed else "without further changes"


def method_html(bench):
    rounds = iterations(bench["rows"])
    repetitions = " or ".join(map(str, sorted({row["repetitions"] for row in bench["rows"]})))
    step = (f"A step has {rounds} iterations, and an iteration visits every constraint once. "
            if rounds else "")
    median = (f"Each number is the median of {repetitions} repetitions, with the lowest and the highest "
              "beside it. " if repetitions else "")
    return ("<p>Constraints and effects are timed in the steps of a cloth that moves, so that positions, "
            f"branches and caches are as in a run. {step}{median}Times on one thread are processor times. "
            "Times on several threads are wall times.</p><p>The <b>oracle</b> is the scalar code: one "
            "constraint at a time, in list order, straight from the formulas. The oracle is written to be "
            "easy to check, and the results of the fast code must agree with the oracle. The oracle is timed "
            "at one size, and all sizes are compared with this time. For a linear solve, the oracle is "
            "CHOLMOD's solve in double precision, at each size. The <b>roofline</b> is the least time that "
            "the machine allows: the largest of three times, for the arithmetic, for the bytes through the "
            "first cache, and for the bytes through the cache or memory that holds the whole cloth. These "
            "limits of the machine are measured in the same process and listed below. The bandwidth of other "
            "sizes is interpolated.</p>")


def machine_html(context, machine):
    rows = {"processor": context["processor"], "vectors": f"{context['vector_bits']} bits",
            "host": context["host_name"], "date (UTC)": context["date"].replace("T", " ").rstrip("Z"),
            "compiler": context["compiler"], "flags": context["flags"], "build": context["build_type"],
            "version of bendlab": context["version"], "commit": f"{context['git_commit']}, {tree(context)}",
            "hash of the source": context["source_hash"]}
    for size, bandwidth in machine.bandwidths.items():
        rows[f"bandwidth on {size // 1024:,} KiB"] = f"{number(bandwidth / 1e9)} GB/s"
    for scalar, peak in machine.peaks.items():
        rows[f"peak in {PRECISION[scalar]} precision"] = f"{number(peak / 1e9)} Gflop/s"
    cells = "".join(row_html(element("td", escape(text), class_="t") for text in row) for row in rows.items())
    return scroll_table("", cells, class_="cards")


def rows_html(rows):
    timed = [shown(row) | {"row": row["name"]} for row in rows]
    made = table("rows", "ns per constraint and iteration (set_up: per spring; effects: per vertex and step; "
                 "methods: per vertex and iteration; solves: per vertex)",
                 ["row", "threads", "precision", "vertices", ("ns", "ns"), "range", "ratio", "share"], timed)
    return folded(f"All {len(timed)} timed rows", table_html(made)) if timed else "<p>There are no rows.</p>"


PAGE = Page("performance", "What does the solver cost?", MEASURE, FIGURES, content, write_data, read)
