"""The page of the plain matrix: does a run of a simple scene go wrong without a warning?"""
import numpy as np

from bendlab.results.load import group
from figures.plain import shares
from pages.project import Content, Figure, Page, summary
from runs.plain_cases import (ALARM, ENERGY, FALL, MEAN_STRAIN, NEAR, SILENT, SOUND, SPEED, STRETCH,
                              UNFINISHED, WARNED, WAY)
from runs.stability_cases import worst_of
from tables.numbers import number, unit_text
from tables.section import write_objects
from tables.table import Table
from web import plain_matrix
from web.html_parts import Part, element, escape, opener, row_html, scroll_table, table_html
from web.verdicts import verdict_html

# Verdict → CSS class of its count, CSS class of its runs, title of its runs
LOOKS = {SILENT: ("no", "fails", "Wrong without a warning, one by one"),
         WARNED: ("open", "amber", "Wrong with a warning"),
         ALARM: ("open", "amber", "Reported as implausible, but no bound is broken"),
         SOUND: ("yes", "holds", "")}
MANY = 20  # rows in a table of pairs
SCENES = ("<p>No scene here is meant to be hard. The scenes combine every mesh, every kind of pins, every "
          "model and every kind of stiffness, mixed so that any values of three settings occur together in "
          "at least one run. Each run is judged by bounds that are true for any correct cloth, and not by "
          "the program's verdict.</p>")


def write_data(sections, results, out):
    write_objects(out / "summary.json", [entry for section in sections for entry in section.data])


def content(sections, out):
    judged = summary(out)
    runs_of = group(judged, lambda run: run["verdict"])
    covered = " ".join(section.text for section in sections)
    for section in sections:
        section.text = ""
    parts = [Part(f"runs-{verdict}", title, failures_html(runs_of[verdict]), title.split(",")[0])
             for verdict, (_, _, title) in LOOKS.items() if title and verdict in runs_of]
    parts += [Part("rules", "Which runs, and by which rules", f"{SCENES}{rules()}<p>{escape(covered)}</p>",
                   "Rules"),
              Part("data", "As data", "<p><a href='summary.json'>summary.json</a>: every run.</p>", "Data")]
    counts = "".join(f"<li>{verdict_html(kind, str(len(runs_of.get(verdict, []))))} "
                     f"{escape(shares.NAMES[verdict])}</li>" for verdict, (kind, _, _) in LOOKS.items())
    return Content(answer(judged), f"<ul class='tally'>{counts}</ul>" if judged else "", parts,
                   data={"runs": [about(run) for run in judged if run["verdict"] != SOUND]},
                   verdicts=lambda section: [plain_matrix.matrix_html(judged), pairs_html(judged)])


def answer(judged):
    silent = [run for run in judged if run["verdict"] == SILENT]
    if not judged:
        return "There are no runs yet."
    if not silent:
        warned = sum(run["verdict"] == WARNED for run in judged)
        return (f"<b>No.</b> Of {len(judged)} runs {warned or 'none'} broke a bound"
                f"{', and each of these runs has a warning' if warned else ''}.")
    worst = max(silent, key=lambda run: worst_of(run).excess)
    return (f"<b>Yes, {len(silent)} of {len(judged)} runs do.</b> The worst: {escape(bound_text(worst))}, "
            f"with {escape(settings_text(worst))}.")


def about(run):
    worst, verdict, broken = worst_of(run), run["verdict"], ", ".join(run["broken"])
    value = {"value": worst.value} if np.isfinite(worst.value) else {"value": None, "text": "not finite"}
    return {"id": run["id"], "title": settings_text(run), "status": LOOKS[verdict][1],
            "outcome": shares.NAMES[verdict] + (f": {run['warnings']}" if run["warnings"] else ""),
            "worst": {"label": worst.name, **value, "limit": worst.limit, "unit": worst.unit,
                      "held": not broken, "note": f"broken: {broken}" if broken else ""},
            "command": run["command"]}


def rules():
    return ("<p>A run breaks a bound if one of these statements is true. A coordinate is not a number. The "
            f"run ends before {100 * (1 - UNFINISHED):g} % of its duration are simulated. A "
            f"pinned vertex moves. The mean strain exceeds {MEAN_STRAIN:g}, or a triangle is stretched to "
            f"more than {STRETCH:g} times its length: every membrane here is stated not to stretch, and "
            "woven cloth yields by a tenth before it is taut (Provot 1995). The distance of a vertex from "
            f"its pin exceeds {1 + WAY:g} times the path along the edges by more than {NEAR:g} sizes (a size "
            f"is the diagonal of the rest shape). A vertex is faster than {SPEED:g} (v<sub>0</sub> + g t), "
            f"or the sum of kinetic and potential energy rises by more than {ENERGY:g} of its scale (kinetic "
            "energy at the start plus weight × size). Speed and energy are not checked for prestressed "
            "springs, because these push from the start. Without pins, the centre of mass differs from its "
            f"exact motion in steps of h by more than {FALL:g} of the length of the fall. The exact motion "
            "is x<sub>0</sub> + v<sub>0</sub> t + g t (t + h) / 2, where the last term with BDF2 is g t² / "
            "2 + 3/4 g h² (1 − 3<sup>−t/h</sup>).</p><p>A run has a <b>warning</b> if the program ends it "
            "as implausible or diverged, or warns of something that affects these numbers. A run is "
            "<b>wrong without a warning</b> if it breaks a bound and the program reports nothing.</p>")


def pairs_html(judged):
    rows = [{"value": f"{a[0]}: {a[1]}", "with": f"{b[0]}: {b[1]}", "wrong": wrong, "runs": runs,
             "expected": expected}
            for (a, b), wrong, runs, expected in shares.pairs(judged)[:MANY]]
    caption = (f"Pairs of values with which at least {shares.FEWEST} runs broke a bound, and at least "
               f"{shares.TWICE:g} times as many as expected from the worse of the two values")
    return table_html(Table.of("pairs", caption, [
        "value", ("with", "with value"), ("wrong", "broke a bound"), ("runs", "of runs"),
        ("expected", "expected from the worse value")], rows))


def settings_text(run):
    return ", ".join(f"{name} {value}" for name, value in run["settings"].items())


def bound_text(run):
    worst = worst_of(run)
    return f"{worst.name} {number(worst.value)}{unit_text(worst.unit)} (at most {number(worst.limit)})"


def failures_html(runs):
    """A table of runs, sorted by worst number over limit; a click on a row opens the run."""
    chosen = {"method", "mesh", "pins", "model", "bending", "precision", "start"}
    head = "<th class='t'>worst number, its limit</th>" + "".join(
        element("th", escape(name), class_="t choose" if name in chosen else "t")
        for name in runs[0]["settings"])
    rows = ""
    for run in sorted(runs, key=lambda run: worst_of(run).excess, reverse=True):
        settings = [element("td", escape(value), class_="t") for value in run["settings"].values()]
        excess = f"{min(worst_of(run).excess, 1e9):.6g}"
        rows += row_html([opener(run["id"], escape(bound_text(run)), data_v=excess), *settings]) + "\n"
    return scroll_table(row_html(head), rows, "Runs", True, class_="sortable", data_rows="runs")


PAGE = Page("plain", "Does any run go wrong without a warning?", "./bendlab reproduce plain",
            [Figure(shares, "What fails, and where", "What fails")], content, write_data)
