"""The charts of the page of costs, from the rows of the benchmark."""
import fig_performance
import fig_performance_methods
import fig_performance_overview
import looks
from charts_html import lines, number, series
from fig_performance import OVER_SIZE, PRECISION, SCALARS, at, kinds, label, per_vertex, usual

NS = number("ns", "time per constraint and iteration", "ns",
            "median of the repetitions, from lowest to highest")
PER_VERTEX = number("vertex", "time per vertex and iteration", "ns",
                    "of all constraints of a vertex, in one iteration")
GROUPS = ["strain", "bending", "effects"]


def charts(rows, command):
    """The charts whose rows are there."""
    table = fig_performance.series(rows)
    made = [_parts(rows, command), _sizes(table, command), _kinds(table, command), _methods(table, command)]
    return [chart for chart in made if chart]


def _parts(rows, command):
    """Points: what one vertex costs in a step."""
    found = fig_performance_overview.parts(rows)
    some = []
    for place, group in enumerate(GROUPS):
        own = [(i, part.ns) for i, part in enumerate(found) if part.group == group]
        if own:
            some.append(series(group, looks.of_place(place), [i for i, _ in own],
                               {"ns": [ns for _, ns in own]}))
    if not some:
        return None
    return lines("step", "", "What one vertex costs in a step",
                 {"name": "part", "label": "", "unit": "", "scale": "band",
                  "categories": [part.name for part in found]},
                 [number("ns", "time per vertex and step", "ns")], some, command, dodge=False,
                 note=fig_performance_overview.caption(rows), printed=["fig_performance_overview.png"])


def _sizes(table, command):
    """Curves: the cost of a constraint over the size of the cloth."""
    some = []
    for scalar in SCALARS:
        for place, name in enumerate(OVER_SIZE):
            rows = table.get((name, scalar), [])
            if rows:
                look = looks.of_place(place) | ({"hollow": True, "dash": "7 4"} if scalar == "double" else {})
                some.append(_series(f"{label(name)}, {PRECISION[scalar]}", look, rows,
                                    [row["vertices"] for row in rows]))
    if not some:
        return None
    ticks = sorted({x for one in some for x in one["x"]})
    return lines("sizes", "Does a constraint cost more on a larger cloth?", "Cost over the size of the cloth",
                 {"name": "vertices", "label": "vertices", "unit": "", "scale": "log", "ticks": ticks},
                 [NS, PER_VERTEX], some, command, printed=["fig_performance.png"])


def _kinds(table, command):
    """Points: what each kind costs, at the size that most have."""
    size = usual(table)
    names = [name for name in kinds(table) if any(at(table, name, scalar, size) for scalar in SCALARS)]
    some = []
    for scalar in SCALARS:
        rows = [(names.index(name), row) for name in names if (row := at(table, name, scalar, size))]
        if rows:
            look = looks.of_place(0) if scalar == "float" else looks.of_place(1)
            some.append(_series(PRECISION[scalar], look, [row for _, row in rows], [x for x, _ in rows]))
    if not some:
        return None
    return lines("kinds", "What does each kind of constraint cost?", f"Cost on {size:,} vertices",
                 {"name": "kind", "label": "", "unit": "", "scale": "band",
                  "categories": [label(name) for name in names]}, [NS, PER_VERTEX], some, command,
                 printed=["fig_performance_kinds.png"])


def _methods(table, command):
    """Curves: the cost of an iteration over the size of the cloth."""
    some = []
    for scalar in SCALARS:
        for name, (shown, drawn) in fig_performance_methods.lines(table).items():
            rows = table.get((name, scalar), [])
            if rows:
                look = looks.of_look(*drawn) | ({"hollow": True, "dash": "7 4"} if scalar == "double" else {})
                vertices = [row["vertices"] for row in rows]
                values = lambda time: {"vertex": [per_vertex(row, time) for row in rows]}
                some.append(series(f"{shown}, {PRECISION[scalar]}", look, vertices,
                                   values("ns_per_constraint"), low=values("ns_lowest"),
                                   high=values("ns_highest")))
    if not some:
        return None
    ticks = sorted({x for one in some for x in one["x"]})
    return lines("methods", "What does an iteration of each solver method cost?",
                 "Cost of an iteration over the size of the cloth",
                 {"name": "vertices", "label": "vertices", "unit": "", "scale": "log", "ticks": ticks},
                 [number("vertex", "time per vertex and iteration", "ns",
                         "median of the repetitions, from lowest to highest")],
                 some, command, printed=["fig_performance_methods.png"])


def _series(label, look, rows, x):
    values = lambda time: {"ns": [row[time] for row in rows],
                           "vertex": [per_vertex(row, time) for row in rows]}
    return series(label, look, x, values("ns_per_constraint"), low=values("ns_lowest"),
                  high=values("ns_highest"))
