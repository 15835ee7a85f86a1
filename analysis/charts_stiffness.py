"""The charts of the page of stiffness, from its checks."""
import re

import looks
from charts_html import lines, model_look, number, of_rows, series, table_of, value
from bendlab.results.load import group

CALIBRATED = "largest ratio of stiffness between two resolutions"
RULED = "largest ratio of B between two resolutions"
SHARE = "stiffness, measured over stated"


def ratios(checks, name):
    """Model → mesh → largest ratio of stiffness between two resolutions."""
    found = {}
    for check in checks:
        if check.check == name and check.measured == check.measured:
            found.setdefault(check.model, {})[check.mesh] = check.measured
    return found


def charts(sections, command):
    """The charts whose checks and tables are there."""
    checks = [check for section in sections for check in section.checks]
    made = [_ratios_chart(checks, command), _hinges(sections, command), _springs(sections, command),
            _substeps(sections, command), _solver(sections, command), _rule(sections, command),
            _cells_chart(checks, command)]
    return [chart for chart in made if chart["series"]]


def _ratios_chart(checks, command):
    found = {"told its rigidity": ratios(checks, CALIBRATED), "by the paper's rule": ratios(checks, RULED)}
    names = [f"{model}, {rule}" if "paper" in rule else model for rule, some in found.items()
             for model in sorted(some, key=lambda model: max(some[model].values()))]
    meshes = list(dict.fromkeys(mesh.split(", 1")[0] for some in found.values() for by_mesh in some.values()
                                for mesh in by_mesh))
    place = lambda rule, model: names.index(f"{model}, {rule}" if "paper" in rule else model)
    some = []
    for rule, by_model in found.items():
        for model, by_mesh in by_model.items():
            points = sorted((meshes.index(mesh.split(", 1")[0]), value) for mesh, value in by_mesh.items())
            label = names[place(rule, model)]
            some.append(series(label, model_look(model), [place(rule, model)] * len(points),
                               {"ratio": [value for _, value in points]}))
    return lines("resolution", "", "Does the stiffness change with the mesh?",
                 {"name": "model", "label": "", "unit": "", "scale": "band", "categories": names},
                 [number("ratio", "largest stiffness over least, 12 to 96 cells", "1",
                         "1: the same stiffness at every resolution; a mark per kind of mesh")],
                 some, command, legend=False, dodge=False,
                 note=f"A mark per kind of mesh: {', '.join(meshes)}. 1 is the same stiffness at every "
                      "resolution; irregular meshes reach to 48 cells.")


def _cells_chart(checks, command):
    wanted = [check for check in checks if check.check == SHARE and check.measured == check.measured]
    found, meshes = [], []
    for (model, mesh), some in group(wanted, lambda check: (check.model, _mesh(check)[0])).items():
        meshes += [mesh] if mesh not in meshes else []
        some = sorted(some, key=lambda check: _mesh(check)[1])
        found.append(series(model, model_look(model), [_mesh(check)[1] for check in some],
                            {"share": [check.measured for check in some]}, held=[meshes.index(mesh)]))
    cells = sorted({x for one in found for x in one["x"]})
    return lines("calibrated", "Calibrated stiffness against resolution",
                 "The stated stiffness, on finer meshes",
                 {"name": "cells", "label": "cells along the length", "unit": "", "scale": "log2",
                  "ticks": cells}, [number("share", "stiffness, measured over stated")], found, command,
                 held=[{"name": "mesh", "label": "mesh", "values": meshes, "at": 0}],
                 limits=[{"metric": "share", "value": 1, "text": "as stated"}])


def _mesh(check):
    """(kind of mesh, cells) of 'equilateral, 24 cells'."""
    cells = re.search(r"(\d+) cells", check.mesh)
    return check.mesh.split(f", {cells[0]}")[0] if cells else check.mesh, int(cells[1]) if cells else 0


# --- of the tables -----------------------------------------------------------------------------------------

HINGES, SPRINGS = "Hinges against the heavy elastica", "Ring springs: does the moment grow as κ³?"
SOLVER = "XPBD against its equilibrium; k against iterations and time step"
EFFECTIVE, RULE = ("Share of the stated stiffness that the solver gives",
                   "Stiffness against resolution, by the paper's rule")
STATED = [{"metric": name, "value": 1, "text": "as stated"} for name in ("droop", "moment")]


def _hinges(sections, command):
    some, held = of_rows(table_of(sections, HINGES, "Hinges"), "model", "Γ",
                         {"droop": "B from H/W", "moment": "B from m(κ)"}, "cells", _of_model)
    return lines("hinges", HINGES, "The flexural rigidity that hinges have, over the stated one",
                 _x("load", "Γ = ρ g L³ / B", "log"),
                 [number("droop", "B from H/W over B", meaning="from how far the free end hangs down"),
                  number("moment", "B from m(κ) over B",
                         meaning="from moment and curvature along the strip")],
                 some, command, held=[held], limits=STATED, printed=["fig_stiffness_hinges.png"])


def _springs(sections, command):
    some, held = of_rows(table_of(sections, SPRINGS, "Ring springs"), "ring t", "R⁴/(α C)",
                         {"moment": "C from m(κ) over C of the springs",
                          "droop": "C from H/W over C of the springs"}, "cells",
                         lambda name, place: looks.of_place(place))
    for one in some:
        one["label"] = f"ring {one['label']}"
    return lines("springs", SPRINGS, "The stiffness that ring springs have, over that of their springs",
                 _x("membrane", "stiffness of the membrane over that of bending, R⁴ / (α C)", "log"),
                 [number("moment", "C from m(κ) over C"), number("droop", "C from H/W over C")],
                 some, command, held=[held], limits=STATED, printed=["fig_stiffness_springs.png"])


def _substeps(sections, command):
    rows = [row | {"over": value(row["H/W"]) / value(row["H/W static"])}
            for row in table_of(sections, SOLVER, "Approach")]
    some, held = of_rows(rows, "model", "substeps", {"droop": "over"}, "cells", _of_model)
    return lines("substeps", SOLVER, "How far the strip hangs, over how far it does at rest",
                 _x("substeps", "substeps of 1/60 s", "log2"), [number("droop", "H/W over that of the "
                                                                       "equilibrium")],
                 some, command, held=[held], printed=["fig_stiffness_xpbd.png"],
                 limits=[{"metric": "droop", "value": 1, "text": "equilibrium"}])


def _solver(sections, command):
    rows = [row | {"all": "every model"} for row in table_of(sections, EFFECTIVE, "Effective")]
    solvers = list(dict.fromkeys(row["solver"] for row in rows))
    for row in rows:
        row["place"] = solvers.index(row["solver"])
    some, _ = of_rows(rows, "model", "place", {"measured": "measured", "estimate": "estimate"}, "all",
                      _of_model)
    for one in some:
        one.pop("held")
    return lines("effective", EFFECTIVE, "The share of the stated stiffness that a solver gives",
                 _x("solver", "", "band") | {"categories": solvers},
                 [number("measured", "stiffness, measured over stated"),
                  number("estimate", "stiffness, as the program estimates it before the run")],
                 some, command, printed=["fig_stiffness_effective.png"])


def _rule(sections, command):
    rows = [{"model": row["model"], "mesh": row["mesh"], "cells": re.sub(r"\D", "", column),
             "B": row[column]} for row in table_of(sections, RULE, "B from H/W") for column in row
            if column.endswith(" cells")]
    some, held = of_rows(rows, "model", "cells", {"B": "B"}, "mesh", _of_model)
    return lines("rule", RULE, "B of a strip against resolution, by the paper's rule",
                 _x("cells", "cells along the length", "log2") | {
                     "ticks": sorted({x for one in some for x in one["x"]})},
                 [number("B", "flexural rigidity B, from H/W", "N m")], some, command, held=[held],
                 printed=["fig_stiffness_resolution.png"])


def _of_model(name, place):
    return model_look(name)


def _x(name, label, scale):
    return {"name": name, "label": label, "unit": "", "scale": scale}
