"""The charts of the page of stiffness, from its checks."""
import re

from charts_html import lines, model_look, number, series
from load import group

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


def charts(checks, command):
    """The charts whose checks are there."""
    made = [_ratios_chart(checks, command), _cells_chart(checks, command)]
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
