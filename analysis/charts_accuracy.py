"""The charts of the page of accuracy, from its summary."""
from charts_html import lines, model_look, number, series
from bendlab.results.load import group
from looks import of_place

SCENES = {"curtain on two pins, 24 cells": ("accuracy_front", "accuracy_front_slow",
                                            "accuracy_front_work_slow"),
          "cantilever, 12 cells": ("accuracy_front_cantilever", "accuracy_front_cantilever_slow",
                                   "accuracy_front_cantilever_work_slow"),
          "drape, 20 cells": ("accuracy_front_drape_slow",),
          "sheet on one pin, 20 cells": ("accuracy_front_one_pin_slow",)}
MEASURES = [number("error_physical_rms", "error from the stated cloth", "%",
                   "root mean square distance to the stated cloth, in % of the diagonal at rest"),
            number("error_solver_rms", "error from its own equilibrium", "%",
                   "root mean square distance to the equilibrium of the model's own energies on its mesh")]
WAYS = {"one iteration, many substeps": lambda solver: solver["iterations"] == 1,
        "one substep, many iterations": lambda solver: solver["substeps"] == 1}
SOLVED, BEAT = "The same work, spent differently", "Nearer than the paper, for less"


def charts(runs, command):
    """The charts whose runs are there."""
    made = [_fronts(runs, command), _beat(runs, command), _ways(runs, command), _precision(runs, command),
            _motion(runs, command)]
    return [chart for chart in made if chart["series"]]


def in_percent(run, name):
    value = run.get(name)
    return 100 * value if isinstance(value, (int, float)) else None


def front(runs, name="error_physical_rms"):
    """The runs that none of the others beats in cost and error, cheapest first."""
    best, found = float("inf"), []
    known = [run for run in runs if isinstance(run.get(name), (int, float)) and run.get("ms_per_frame")]
    for run in sorted(known, key=lambda run: (run["ms_per_frame"], run[name])):
        if run[name] < best:
            best = run[name]
            found.append(run)
    return found


def _fronts(runs, command):
    some = []
    for at, (scene, names) in enumerate(SCENES.items()):
        own = [run for run in runs if run["experiment"] in names]
        for model, these in group(own, lambda run: run["model"]).items():
            shown = front(these)
            some.append(series(model, model_look(model), [run["ms_per_frame"] for run in shown], {
                each["name"]: [_nan(in_percent(run, each["name"])) for run in shown] for each in MEASURES},
                               runs=[[run["id"]] for run in shown], held=[at]))
    some.sort(key=lambda one: one["label"])
    return lines("fronts", "", "Error against time", _time(), MEASURES,
                 [one for one in some if one["x"]], command,
                 held=[{"name": "scene", "label": "scene", "values": list(SCENES), "at": 1}],
                 note="Each curve is the front of a model: none of its runs is both cheaper and nearer to "
                      "the stated cloth. A point opens its run.", dodge=False, printed=["fig_accuracy.png"])


def _ways(runs, command):
    own = [run for run in runs if run["experiment"] in SCENES["curtain on two pins, 24 cells"]
           and "substeps" in run["settings"] and in_percent(run, "error_solver_rms")]
    models, some = sorted({run["model"] for run in own}), []
    for place, (way, fits) in enumerate(WAYS.items()):
        for model, these in group([run for run in own if fits(run["settings"])],
                                  lambda run: run["model"]).items():
            these = sorted(these, key=_work)
            some.append(series(way, of_place(place), [_work(run) for run in these],
                               {"error_solver_rms": [in_percent(run, "error_solver_rms") for run in these],
                                "ms_per_frame": [run["ms_per_frame"] for run in these]},
                               runs=[[run["id"]] for run in these], held=[models.index(model)]))
    work = {"name": "work", "label": "substeps × iterations", "unit": "", "scale": "log2",
            "ticks": sorted({_work(run) for run in own})}
    shown = [MEASURES[1],
             number("ms_per_frame", "CPU time per frame", "ms", "of the steps, for 1/60 s of cloth")]
    return lines("ways", SOLVED, "Substeps or iterations, at equal work", work, shown, some, command,
                 held=[{"name": "model", "label": "model", "values": models,
                        "at": models.index("dihedral") if "dihedral" in models else 0}] if models else [])


def _beat(runs, command):
    """Fronts over all cells of models that are told the cloth, and the paper's setting on 8 to 64 cells."""
    own = [run for run in runs if run["experiment"] == "accuracy_beat"]
    some = [_points(model, model_look(model), front(these), "error_physical_rms")
            for model, these in group(own, lambda run: run["model"]).items()]
    paper = sorted([run for run in runs if run["model"] == "adaptive" and run["experiment"] in (
        "accuracy_paper_64", "accuracy_paper_cells_slow")], key=lambda run: run["cells"])
    if own and paper:
        some.append(_points("the paper's setting, 8 to 64 cells", of_place(6), paper, "error_physical_rms"))
    return lines("beat", BEAT, "The paper's setting, and models that are told the cloth", _time(),
                 MEASURES[:1], some, command, dodge=False, note="Of each model the front over 8 to 32 cells.")


def _precision(runs, command):
    own = [run for run in runs if run["experiment"] == "accuracy_precision_slow"]
    models, some = sorted({run["model"] for run in own}), []
    for (model, precision), these in group(own, lambda run: (run["model"],
                                                             run["settings"]["precision"])).items():
        these = sorted(these, key=lambda run: run["settings"]["substeps"])
        some.append(_points(f"{precision} precision", of_place(int(precision == "double")), these,
                            "error_solver_rms", lambda run: run["settings"]["substeps"])
                    | {"held": [models.index(model)]})
    substeps = {"name": "substeps", "label": "substeps", "unit": "", "scale": "log2",
                "ticks": sorted({x for one in some for x in one["x"]})}
    return lines("precision", SOLVED, "Substeps in single and in double precision", substeps, MEASURES[1:],
                 some, command, held=[{"name": "model", "label": "model", "values": models, "at": 0}]
                 if models else [])


def _motion(runs, command):
    own = [run for run in runs if run["experiment"] == "accuracy_swing_slow"]
    some = [_points(model, model_look(model), front(these, "error_solver_rms"), "error_solver_rms")
            for model, these in group(own, lambda run: run["model"]).items()]
    distance = number("error_solver_rms", "distance from its motion in 4096 substeps", "%",
                      "root mean square over cloth and frames, in % of the diagonal at rest")
    return lines("motion", "Larger meshes, and motion", "Motion: error against time", _time(), [distance],
                 some, command, dodge=False)


def _points(label, look, runs, name, x=lambda run: run["ms_per_frame"]):
    """A series of runs whose points open them."""
    errors = [_nan(in_percent(run, name)) for run in runs]
    return series(label, look, [x(run) for run in runs], {name: errors}, runs=[[run["id"]] for run in runs])


def _work(run):
    return run["settings"]["substeps"] * run["settings"]["iterations"]


def _time():
    return {"name": "ms_per_frame", "label": "CPU time per frame of 1/60 s", "unit": "ms", "scale": "log"}


def _nan(value):
    return float("nan") if value is None else value
