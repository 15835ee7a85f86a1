"""The tables of the hard cases as HTML, and the data of each run for the page's scripts. The functions take
runs as objects of summary.json, of methods.json (runs with other solver methods), or of fabrics.json (runs
with the bending laws of fabrics)."""
import math
from collections import Counter

from bendlab.results.load import group
from figures.stability.cells import id_of, kind_of
from runs import repeat
from runs.collected import differing, stated
from runs.stability_cases import AMBER, CASES, FOLDER, GREEN, RED, SECTIONS, worst_of
from runs.sweeps import planned_points, point_key, read_config
from tables.section import address
from web.html_parts import element, escape, folded, head_html, matrix_table, opener, scroll_table

MEANING = {RED: "unstable", AMBER: "stable, not recovered", GREEN: "passes"}  # of the verdicts, worst first
SIGNS = {RED: "×", AMBER: "–", GREEN: "✓"}
PRECISIONS = ("single", "double")
CASE = {case.name: case for case in CASES}
GROUP = {case.name: title for title, cases in SECTIONS.items() for case in cases}
NUMBERS = {"recovered_s": ("recovered at", "s", "when the cloth was last away from its rest shape"),
           "energy_rises": ("steps in which energy rose", "1", "share of all steps"),
           "seconds": ("processor time", "s", "of the whole run")}
CELLS = ("A cell shows the worst verdict of its runs, and how many of its runs have this verdict. A click "
         "on a cell opens the runs with this verdict, the worst run first.")
SCENES = (
    "The same cases on a coarser sheet of 16 × 16 cells. The membrane has a compliance, and bending "
    "has a physical stiffness, because implicit methods need energies. pbd has its default substeps; "
    "in the case of one iteration it has one substep. The other methods have one substep, and at "
    "most 10 iterations (quasi_newton) or 20 iterations (newton). newton runs with one model only, "
    "because it takes long. Energy is computed from the stated compliance. With too few substeps of "
    "pbd the cloth stays stretched, which counts as gained energy.")
FABRIC_SCENES = (
    "The same sheets as with other solver methods, with the models discrete_shells and mid_edge. pbd has its "
    "default substeps and no coarse levels; quasi_newton has one substep and at most 10 iterations. one "
    "rigidity: B is 10 µN m at 0.2 kg/m². The other laws change this law. direction: B is 30 µN m "
    "along the warp and 6 µN m along the weft. softening: the moment is half of B κ at a curvature of 50 /m. "
    "friction: HB is 0.5 mN, so that HB/B is 50 /m. folds that stay: beyond a curvature of 20 /m the slope "
    "of the moment is B/5. over time: a factor on B grows from 1 to 100 in the first second, and falls to "
    "0.01 in the next second. map: B is 100 times as large in one half. The last law combines four of these "
    "laws.")
NO_ENERGY = ("The energy is not checked here, because with friction, folds or a factor over time it does not "
             "follow from the pose. So a cell may be green here and red in the sections before.")


def shared(runs):
    """The runs of cases and precisions for which every model has a run. Only these runs compare models."""
    models = {run["model"] for run in runs}
    places = group(runs, lambda run: (run["case"], run["precision"]))
    return [run for same_place in places.values() if {run["model"] for run in same_place} == models
            for run in same_place]


def models_of(runs):
    """The models, sorted by the share of their runs that fail, smallest first."""
    by_model = group(runs, lambda run: run["model"])
    return sorted(by_model, key=lambda model: _shares(by_model[model])[RED])


def _shares(runs):
    """Verdict → share of the runs that have this verdict."""
    counts = Counter(run["verdict"] for run in runs)
    return {verdict: counts[verdict] / len(runs) for verdict in MEANING}


# --- models × groups of cases ------------------------------------------------------------------------------

def groups_html(runs):
    """A table of models × groups of cases: how many of the runs are red. On a phone, each row is a card."""
    present = {GROUP[run["case"]] for run in runs}
    titles = [title for title in SECTIONS if title in present]
    rows = ""
    for model in models_of(runs):
        own = [run for run in runs if run["model"] == model]
        by_title = group(own, lambda run: GROUP[run["case"]])
        cells = "".join(map(_share_cell, [own, *(by_title.get(title, []) for title in titles)]))
        rows += f"<tr><td class='t'><b>{escape(model)}</b></td>{cells}</tr>"
    head = head_html("model", "all cases", *titles)
    signs = "".join(f"<span><span class='v {verdict}' aria-hidden='true'>{SIGNS[verdict]}</span>{verdict}: "
                    f"{meaning}</span>" for verdict, meaning in MEANING.items())
    return (scroll_table(head, rows, "Models and groups of cases", class_="shares cards")
            + f"<p class='key'>{signs}</p>")


def _share_cell(runs):
    if not runs:
        return "<td class='t'></td>"
    by_verdict = {verdict: [run for run in runs if run["verdict"] == verdict] for verdict in MEANING}
    at, bars = 0.0, ""
    for verdict, own in by_verdict.items():
        width = 100 * len(own) / len(runs)
        bars += f"<rect class='fill-{verdict}' x='{at:.1f}' width='{width:.1f}' height='8'/>" if width else ""
        at += width
    tally = ", ".join(f"{len(own)} {verdict}" for verdict, own in by_verdict.items())
    text = (f"{100 * _shares(runs)[RED]:.0f} %<svg viewBox='0 0 100 8' preserveAspectRatio='none' "
            f"aria-hidden='true'>{bars}</svg>")
    opened = by_verdict[RED] or by_verdict[AMBER]
    if not opened:
        return element("td", element("div", text, class_="share"), class_="t", title=tally)
    return opener(" ".join(map(id_of, opened)), text, look="opens share", label=tally)


# --- cases × models ----------------------------------------------------------------------------------------

def cases_html(runs):
    """(a table of the cases whose runs have different verdicts, a list of the other cases by colour). The
    table begins with the case that tells models apart best."""
    by_case, models = group(runs, lambda run: run["case"]), models_of(runs)
    telling, alike = split_cases(by_case)
    rows = {}
    for name in telling:
        own = {(run["model"], run["precision"]): run for run in by_case[name]}
        buttons = {model: "".join(_button(own.get((model, precision))) for precision in PRECISIONS)
                   for model in models}
        rows[full_title_html(name)] = [element("td", buttons[model]) for model in models]
    return matrix_table("case", models, rows, "Cases and models", "cases", tall=True), alike


def split_cases(by_case):
    """(the names of the cases in the table of cases_html(), the list of the other cases). `by_case`: name of
    a case → runs."""
    alike = {name: runs[0]["verdict"] for name, runs in by_case.items()
             if len({run["verdict"] for run in runs}) == 1}
    telling = sorted((name for name in by_case if name not in alike),
                     key=lambda name: -discrimination(by_case[name]))
    rows = ""
    for verdict in MEANING:
        names = [f"{GROUP[name].lower()}: {CASE[name].title}" for name in alike if alike[name] == verdict]
        if names:
            colour = element("span", f"all {verdict}", class_=f"status {verdict}")
            rows += f"<li>{colour}: {escape('; '.join(names))}</li>"
    if not alike:
        return telling, ""
    return telling, folded(f"The {len(alike)} cases in which all runs have one colour", f"<ul>{rows}</ul>")


def discrimination(runs):
    """How well a case tells models apart: the share of pairs of runs whose verdicts differ. A pair with a red
    run counts three times."""
    red, amber, green = _shares(runs).values()
    return 3 * red * (1 - red) + amber * green


def full_title_html(name):
    """A case with its group, which links to the group's section."""
    return f"<a href='#{address(GROUP[name])}'>{escape(GROUP[name])}</a>: {escape(CASE[name].title)}"


def _button(run):
    if run is None:
        return "<button type='button' class='v' disabled aria-label='no run'></button>"
    verdict = run["verdict"]
    return element("button", SIGNS[verdict], type="button", class_=f"v {verdict}", data_run=id_of(run),
                   aria_label=f"{run['model']}, {run['precision']}: {verdict}")


# --- cases × solver methods, or bending laws ---------------------------------------------------------------

def methods_html(runs):
    """The HTML of the section on methods: the answer, the matrix, and which runs these are."""
    return _columns_html(runs, "method", "model", SCENES)


def fabrics_html(runs):
    """The HTML of the section on bending laws, as methods_html()."""
    unstable = {run["model"] for run in runs if (run["method"], run["verdict"]) == ("quasi_newton", RED)}
    also = f" With quasi_newton, unstable: {', '.join(sorted(unstable))}." if unstable else ""
    return _columns_html(runs, "law", "combination of model and method", FABRIC_SCENES, NO_ENERGY + also)


def _columns_html(runs, column, others, scenes, also=""):
    if not runs:
        return []
    table, alike = columns_table(runs, column)
    return [f"<p><b>{columns_answer(runs, column, others)}</b> {CELLS} {also}</p>", table, alike,
            folded("Which runs these are", f"<p>{scenes}</p>")]


def columns_answer(runs, column, others):
    """A sentence: in how many cases each value of `column` is unstable, the most stable value first."""
    counts = []
    for value, own in group(runs, lambda run: run[column]).items():
        red, cases = {run["case"] for run in own if run["verdict"] == RED}, {run["case"] for run in own}
        counts.append((len(red) / len(cases), f"{escape(value)} in {len(red)} of {len(cases)}"))
    parts = [text for _, text in sorted(counts, key=lambda entry: entry[0])]
    return f"Unstable with at least one {others}: {'; '.join(parts)} cases."


def columns_table(runs, column):
    """(a table for the cases whose runs have different verdicts, with a column for each value of `column`; a
    list of the other cases by colour)."""
    by_case = group(runs, lambda run: run["case"])
    values = list(group(runs, lambda run: run[column]))
    telling, alike = split_cases(by_case)
    rows = ""
    for name in telling:
        by_value = group(by_case[name], lambda run: run[column])
        cells = "".join(_worst_cell(by_value.get(value, [])) for value in values)
        rows += f"<tr><td class='t text'>{full_title_html(name)}</td>{cells}</tr>\n"
    table = scroll_table(head_html("case", *values), rows, f"Cases by {column}", class_="shares cards")
    colours = "".join(element("span", f"{verdict}: {meaning}", class_=f"status {verdict}")
                      for verdict, meaning in MEANING.items())
    return f"{table}<p class='key'>{colours}</p>", alike


def _worst_cell(runs):
    """A cell with the worst verdict of these runs of a case; it opens the runs with this verdict."""
    if not runs:
        return "<td class='t'></td>"
    verdict = next(colour for colour in MEANING if any(run["verdict"] == colour for run in runs))
    worst = sorted((run for run in runs if run["verdict"] == verdict),
                   key=lambda run: worst_of(run).excess, reverse=True)
    text = element("span", f"{len(worst)} of {len(runs)}", class_=f"status {verdict}", title=verdict)
    return opener(" ".join(map(id_of, worst)), text)


# --- data --------------------------------------------------------------------------------------------------

def data(runs):
    """The data for the page's scripts: runs, base configs, reasons, numbers."""
    texts = list(dict.fromkeys(run["why"] for run in runs if run["why"]))
    models = list(dict.fromkeys(run["model"] for run in runs))
    configs = list(dict.fromkeys(map(_config, runs)))
    planned = [Planned(config, models) for config in configs]
    about = []
    for run in runs:
        base = configs.index(_config(run))
        about.append(_about(run, planned[base], base))
        if run["why"]:
            about[-1]["why"] = texts.index(run["why"])
        if run["verdict"] != GREEN and "method" not in run:
            about[-1]["stills"] = f"#{address(GROUP[run['case']])}"
    numbers = {name: dict(zip(("label", "unit", "meaning"), number)) for name, number in NUMBERS.items()}
    return {"runs": about, "settings": [plan.base for plan in planned], "texts": texts, "summary": numbers}


def _config(run):
    """The path of a run's config below configs/."""
    return run.get("config") or f"{FOLDER}/{CASE[run['case']].config}"


class Planned:
    """The points of a config's sweep, with all values in place of "all"."""

    def __init__(self, config, models):
        choices = {"/bending/model": models, "/solver/precision": list(PRECISIONS)}
        self.file, self.settings = f"configs/{config}.json", read_config(config)
        self.axes = {pointer: choices.get(pointer, []) if values == "all" else values
                     for pointer, values in self.settings["sweep"].items()}
        self.points = planned_points(self.settings, self.axes)
        self.base = stated(self.settings, self.points[0])  # pointer → value at the first point

    def point_of(self, run):
        """The point of the sweep that has the case, model and precision of a run of configs/stability."""
        case, model, precision = CASE[run["case"]], run["model"], run["precision"]
        wanted = {pointer: self.axes[pointer][value] if pointer == "/effects" else value
                  for pointer, value in case.where.items()}
        for point in self.points:
            own = point.get("/bending/model") or point.get("/bending", self.settings["bending"]).get("model")
            if (own == model and point.get("/solver/precision", precision) == precision
                    and point_key(wanted) == point_key({pointer: point[pointer] for pointer in wanted})):
                return point
        raise ValueError(f"{self.file} has no run of case {case.name} with {model}, {precision}")


def _about(run, plan, base):
    worst, point = worst_of(run), run.get("point") or plan.point_of(run)
    title = f"{CASE[run['case']].title}: {', '.join([run['model'], *kind_of(run)])}"
    shown = {"label": worst.name, "value": worst.value, "limit": worst.limit, "unit": worst.unit,
             "held": run["verdict"] == GREEN}
    if not math.isfinite(worst.value):
        shown |= {"value": None, "text": "not a number" if math.isnan(worst.value) else "∞"}
    return {"id": id_of(run), "title": title, "status": run["verdict"], "worst": shown,
            "command": repeat.command(plan.file, point, plan.axes),
            "summary": {name: run[name] for name in NUMBERS if run.get(name) is not None},
            "base": base, "changes": differing(plan.base, stated(plan.settings, point))}
