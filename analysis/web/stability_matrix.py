"""The tables of the hard cases as HTML, and the data of each run for the page's scripts. The functions take
runs as objects of summary.json."""
from collections import Counter
from functools import lru_cache

from runs import repeat
from figures.stability.cells import id_of
from web.html_parts import address, escape
from bendlab.results.load import group
from tables.numbers import known_values
from runs.collected import differing, stated
from runs.stability_cases import AMBER, CASES, FOLDER, GREEN, RED, SECTIONS
from runs.sweeps import planned_points, point_key, read_config

VERDICTS = (RED, AMBER, GREEN)
SIGNS = {RED: "×", AMBER: "–", GREEN: "✓"}
PRECISIONS = ("single", "double")
CASE = {case.name: case for case in CASES}
GROUP = {case.name: title for title, cases in SECTIONS.items() for case in cases}
NUMBERS = {"recovered_s": ("recovered at", "s", "when the cloth was last away from its rest shape"),
           "energy_rises": ("steps in which energy rose", "1", "share of all steps"),
           "seconds": ("processor time", "s", "of the whole run")}


def _kind(run):
    """The setting in which the runs of a case and a model differ: the solver method, or the precision."""
    return run.get("method") or run["precision"]


def shared(runs):
    """The runs of cases and precisions for which every model has a run. Only these runs compare models."""
    models = {run["model"] for run in runs}
    places = group(runs, lambda run: (run["case"], run["precision"]))
    return [run for same_place in places.values() if {run["model"] for run in same_place} == models
            for run in same_place]


def models_of(runs):
    """The models, sorted by the share of their runs that fail, smallest first."""
    by_model = group(runs, lambda run: run["model"])
    shares = {model: _share(own_runs, RED) for model, own_runs in by_model.items()}
    return sorted(shares, key=shares.get)


def _share(runs, verdict):
    return sum(run["verdict"] == verdict for run in runs) / len(runs) if runs else 0.0


# --- models × groups of cases ------------------------------------------------------------------------------

def groups_html(runs):
    """A table of models × groups of cases: how many of the runs are red. On a phone, each row is a card."""
    titles = [title for title in SECTIONS if any(GROUP[run["case"]] == title for run in runs)]
    by_place = group(runs, lambda run: (run["model"], GROUP[run["case"]]))
    head = "".join(f"<th class='t'>{escape(title)}</th>" for title in ["all cases", *titles])
    rows = ""
    for model in models_of(runs):
        own = [run for run in runs if run["model"] == model]
        cells = "".join(_share_cell(cell_runs) for cell_runs in [own, *(by_place.get((model, title), [])
                                                                        for title in titles)])
        rows += f"<tr><td class='t'><b>{escape(model)}</b></td>{cells}</tr>"
    return ("<div class='scroll' tabindex='0' role='region' aria-label='Models and groups of cases'><table "
            f"class='shares cards'><thead><tr><th class='t'>model</th>{head}</tr></thead><tbody>{rows}"
            f"</tbody></table></div>{key_html()}")


def _share_cell(runs):
    if not runs:
        return "<td class='t'></td>"
    counts = Counter(run["verdict"] for run in runs)
    at, bars = 0.0, ""
    for verdict in VERDICTS:
        width = 100 * counts[verdict] / len(runs)
        bars += f"<rect class='fill-{verdict}' x='{at:.1f}' width='{width:.1f}' height='8'/>" if width else ""
        at += width
    tally = ", ".join(f"{counts[verdict]} {verdict}" for verdict in VERDICTS)
    text = f"{100 * _share(runs, RED):.0f} %"
    bar = f"<svg viewBox='0 0 100 8' preserveAspectRatio='none' aria-hidden='true'>{bars}</svg>"
    opened = [run for run in runs if run["verdict"] == RED] or [run for run in runs
                                                                if run["verdict"] == AMBER]
    if not opened:
        return f"<td class='t' title='{tally}'><div class='share'>{text}{bar}</div></td>"
    ids = " ".join(map(id_of, opened))
    return (f"<td class='t' data-run='{escape(ids)}'><button type='button' class='opens share' aria-label='"
            f"{tally}'>{text}{bar}</button></td>")


def key_html():
    """What the signs mean."""
    names = {RED: "red: unstable", AMBER: "amber: stable, not recovered", GREEN: "green: passes"}
    return "<p class='key'>" + "".join(
        f"<span><span class='v {verdict}' aria-hidden='true'>{SIGNS[verdict]}</span>{name}</span>"
        for verdict, name in names.items()) + "</p>"


# --- cases × models ----------------------------------------------------------------------------------------

def cases_html(runs):
    """(a table of the cases whose runs have different verdicts, a list of the other cases by colour). The
    table begins with the case that tells models apart best."""
    by_case = group(runs, lambda run: run["case"])
    telling, alike = folded(by_case)
    return _matrix(telling, by_case, models_of(runs)), alike


def folded(by_case):
    """(the names of the cases in the table of cases_html(), the list of the other cases). `by_case`: name of
    a case → runs."""
    telling = [name for name in by_case if len({run["verdict"] for run in by_case[name]}) > 1]
    telling.sort(key=lambda name: -discrimination(by_case[name]))
    alike = {}
    for name in by_case:
        if name not in telling:
            alike.setdefault(by_case[name][0]["verdict"], []).append(name)
    return telling, _alike_html(alike)


def discrimination(runs):
    """How well a case tells models apart: the share of pairs of runs whose verdicts differ. A pair with a red
    run counts three times."""
    counts = Counter(run["verdict"] for run in runs)
    red, amber, green = (counts[verdict] / len(runs) for verdict in VERDICTS)
    return 3 * red * (1 - red) + amber * green


def _matrix(names, by_case, models):
    head = "".join(f"<th scope='col'>{escape(model)}</th>" for model in models)
    rows = ""
    for name in names:
        own = {(run["model"], run["precision"]): run for run in by_case[name]}
        cells = "".join(f"<td>{''.join(_button(own.get((model, precision))) for precision in PRECISIONS)}"
                        "</td>" for model in models)
        rows += f"<tr><th scope='row' class='t'>{full_title_html(name)}</th>{cells}</tr>\n"
    return ("<div class='scroll tall' tabindex='0' role='region' aria-label='Cases and models'><table "
            f"class='cases'><thead><tr><th class='t'>case</th>{head}</tr></thead><tbody>{rows}</tbody>"
            "</table></div>")


def full_title_html(name):
    """A case with its group, which links to the group's section."""
    return f"<a href='#{address(GROUP[name])}'>{escape(GROUP[name])}</a>: {escape(CASE[name].title)}"


def _button(run):
    if run is None:
        return "<button type='button' class='v' disabled aria-label='no run'></button>"
    name = f"{run['model']}, {run['precision']}: {run['verdict']}"
    return (f"<button type='button' class='v {run['verdict']}' data-run='{escape(id_of(run))}' "
            f"aria-label='{escape(name)}'>{SIGNS[run['verdict']]}</button>")


def _full_title(name):
    """A case with its group: 'start poses: mirrored'."""
    return f"{GROUP[name].lower()}: {CASE[name].title}"


def _alike_html(alike):
    """The list of the cases in which all runs have the same colour."""
    if not alike:
        return ""
    rows = "".join(f"<li><span class='status {verdict}'>all {verdict}</span>: "
                   f"{escape('; '.join(map(_full_title, alike[verdict])))}</li>"
                   for verdict in VERDICTS if verdict in alike)
    return (f"<details><summary>The {sum(map(len, alike.values()))} cases in which all runs have one "
            f"colour</summary><ul>{rows}</ul></details>")


# --- data --------------------------------------------------------------------------------------------------

def data(runs):
    """The data for the page's scripts: runs, base configs, reasons, numbers."""
    texts = list(dict.fromkeys(run["why"] for run in runs if run["why"]))
    configs = list(dict.fromkeys(map(_config, runs)))
    models = tuple(dict.fromkeys(run["model"] for run in runs))
    bases = [_base(config, models) for config in configs]
    about = [_about(run, texts, configs, bases, models) for run in runs]
    keys = ("label", "unit", "meaning")
    numbers = {name: dict(zip(keys, description)) for name, description in NUMBERS.items()}
    return {"runs": about, "settings": bases, "texts": texts, "summary": numbers}


def _config(run):
    """The path of a run's config below configs/."""
    return run.get("config") or f"{FOLDER}/{CASE[run['case']].config}"


def _about(run, texts, configs, bases, models):
    case, worst, config = CASE[run["case"]], known_values(run["worst"]), _config(run)
    place = configs.index(config)
    point = run.get("point") or _point(case, run["model"], run["precision"], models)
    entry = {"id": id_of(run), "title": f"{case.title}: {run['model']}, {_kind(run)}",
             "status": run["verdict"], "worst": {
                 "label": worst["what"], "value": worst["value"], "limit": worst["limit"],
                 "unit": worst["unit"], "held": run["verdict"] == GREEN},
             "command": repeat.command(f"configs/{config}.json", point, _axes(config, models)),
             "summary": {name: run[name] for name in NUMBERS if run.get(name) is not None},
             "base": place, "changes": differing(bases[place], stated(read_config(config), point))}
    if worst["value"] != worst["value"] or abs(worst["value"]) == float("inf"):
        entry["worst"] |= {"value": None, "text": "not a number" if worst["value"] != worst["value"] else "∞"}
    if run["why"]:
        entry["why"] = texts.index(run["why"])
    if run["verdict"] != GREEN and "method" not in run:
        entry["stills"] = f"#{address(GROUP[run['case']])}"
    return entry


@lru_cache(maxsize=None)
def _axes(config, models):
    """The sweep of a config, with all values in place of "all"."""
    choices = {"/bending/model": list(models), "/solver/precision": list(PRECISIONS)}
    sweep = read_config(config)["sweep"]
    return {pointer: choices.get(pointer, []) if values == "all" else values
            for pointer, values in sweep.items()}


@lru_cache(maxsize=None)
def _base(config, models):
    """Pointer → value of a config at the first point of its sweep."""
    settings = read_config(config)
    points = planned_points(settings, _axes(config, models))
    return stated(settings, points[0])


def _point(case, model, precision, models):
    """The point of the sweep in configs/stability that has this case, model and precision."""
    config = f"{FOLDER}/{case.config}"
    settings, axes = read_config(config), _axes(config, models)
    wanted = {pointer: axes[pointer][value] if pointer == "/effects" else value
              for pointer, value in case.where.items()}
    for point in planned_points(settings, axes):
        own = point.get("/bending/model") or point.get("/bending", settings["bending"]).get("model")
        if (own == model and point.get("/solver/precision", precision) == precision
                and all(point_key({key: point[key]}) == point_key({key: value})
                        for key, value in wanted.items())):
            return point
    raise ValueError(f"configs/{config}.json has no run of case {case.name} with {model}, {precision}")
