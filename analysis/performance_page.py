"""Writes the page of what the solver costs: index.html, and summary.json with one object per row."""
import right_python  # noqa: F401  (first: it may hand over to another Python)
import argparse
import json
import re
import sys
from dataclasses import replace
from pathlib import Path

import fig_performance
import fig_performance_effects
import fig_performance_kinds
import fig_performance_limits
import fig_performance_methods
import fig_performance_order
import fig_performance_overview
import fig_performance_set_up
import fig_performance_threads
import style
from fig_performance import COLUMNS, PRECISION, columns, iterations, part, per_vertex
import charts_performance
from charts_html import chart_html, placed
from html_parts import Made, Part, escape, folded, section_part, table_html
from project_pages import KEPT, Content, keep, kept, renew_start, write
from report import Table, print_option, rounded, write_objects

FIGURES = [fig_performance_overview, fig_performance, fig_performance_kinds, fig_performance_limits,
           fig_performance_methods, fig_performance_effects, fig_performance_set_up, fig_performance_order,
           fig_performance_threads]
LINKS = {"overview": "A step", "size": "Size", "kinds": "Kinds", "limits": "Limits", "methods": "Methods",
         "effects": "Effects", "set_up": "Set-up", "order": "Order", "threads": "Threads"}
FILE = "results/performance/bench.json"
MEASURE = f"./bendlab bench --json > {FILE}"
EVERYTHING = f"{MEASURE}      # everything\npython3 analysis/performance_page.py {FILE}      # this page"


def main(bench, out):
    """Writes the page of the measured rows into `out`; returns its sections."""
    out.mkdir(parents=True, exist_ok=True)
    sections = [figure.main(bench, out) for figure in FIGURES]
    write_objects(out / "summary.json", [as_json(row) for row in bench["rows"]])
    keep(out, sections)
    lay_out(bench, out)
    return sections


def lay_out(bench, out):
    """Writes index.html of what is kept and of the rows."""
    context = bench["context"]
    made = Made(context["git_commit"][:12] + (" with changes" if context["git_dirty"] else ""),
                context["date"].replace("T", " ").rstrip("Z") + " UTC",
                f"{context['processor']}, {context['host']}", MEASURE)
    write(out, "performance", content(bench, kept(out)), made)


def as_json(row):
    """The object of a row in summary.json."""
    timed = row["ns_per_constraint"] is not None
    return rounded({**row, "ns_per_vertex": per_vertex(row) if timed else None})


def content(bench, sections):
    """What the page says: the answer, the evidence, how it was measured, every row."""
    overview = sections[0]
    charts = charts_performance.charts(bench["rows"], MEASURE)
    parts = [section_part(replace(section, missing=[]), EVERYTHING, [missing_html(section)],
                          link=LINKS[section.figure], **placed(charts, section)) for section in sections]
    method = method_html(bench) + machine_html(bench["context"])
    parts += [Part("method", "How was it measured?", method, "Method"),
              Part("rows", "Every timed row", rows_html(bench["rows"]), "Rows"),
              Part("data", "As data", "<p><a href='summary.json'>summary.json</a>: every row, with the time "
                   "per vertex. <a href='bench.json'>bench.json</a>: as the program wrote it.</p>"
                   f"<pre>{escape(EVERYTHING)}</pre>", "Data")]
    top = "".join(chart_html(chart) for chart in charts if not chart["section"])
    lead = f"<p class='lead'>{escape(origin(bench['context']))}</p>"
    return Content("What does the solver cost?", escape(overview.text) or "There is no row of a whole step.",
                   top + lead, parts, {"charts": charts})


def missing_html(section):
    """What the section has no rows of, as HTML."""
    if not section.missing:
        return ""
    lines = "<br>".join(escape(line) for line in section.missing)
    return f"<div class='missing'>Not among the measured rows, so not shown here:<br>{lines}</div>"


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
            rows[f"bandwidth on {size[1]} {size[2]}"] = f"{style.number(value)} GB/s"
        elif peak := re.fullmatch(r"peak_(\w+)_Gflop_per_s", key):
            rows[f"peak in {PRECISION[peak[1]]} precision"] = f"{style.number(value)} Gflop/s"
    cells = "".join(f"<tr><td class='t'>{escape(name)}</td><td class='t'>{escape(value)}</td></tr>"
                    for name, value in rows.items())
    return f"<div class='scroll'><table class='cards'><tbody>{cells}</tbody></table></div>"


def rows_html(rows):
    """Every timed row as a folded table."""
    timed = [row for row in rows if row["ns_per_constraint"] is not None]
    lines = [[row["name"], row["threads"], *columns(row), style.number(row["ratio_to_oracle"]),
              part(row["roofline_fraction"])] for row in timed]
    table = Table("ns per constraint and iteration (set_up: per spring; effects: per vertex and step; "
                  "methods: per vertex and iteration; solves: per vertex)",
                  ["row", "threads", *COLUMNS, "times as fast as the oracle", "share of the roofline"], lines)
    return folded(f"All {len(timed)} timed rows", table_html(table)) if timed else "<p>There is none.</p>"


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("bench", nargs="?", type=Path, default=Path(FILE),
                        help="what `bendlab bench --json` printed (default: %(default)s)")
    parser.add_argument("--out", type=Path, help="folder for the page (default: that of the measurements)")
    parser.add_argument("--again", action="store_true", help=f"write index.html again, of the {KEPT} there")
    print_option(parser)
    arguments = parser.parse_args()
    out = arguments.out or arguments.bench.parent
    try:
        measured = json.loads(arguments.bench.read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        sys.exit(f"{arguments.bench}: {error}; make it with: ./bendlab bench --json > {arguments.bench}")
    (lay_out if arguments.again else main)(measured, out)
    renew_start(out)
    print(out / "index.html")
