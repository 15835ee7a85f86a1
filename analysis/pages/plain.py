"""The page of the plain matrix: does a run of a simple scene go wrong without a warning?"""
import numpy as np

from figures.plain import shares
from pages.project import Content, Figure, Page, summary
from runs.plain_cases import ALARM, ENERGY, FALL, MEAN_STRAIN, NEAR, SILENT, SOUND, SPEED, STRETCH, TOLD, WAY
from tables.numbers import known_values, number
from tables.section import write_objects
from tables.table import Table
from web import plain_matrix
from web.html_parts import Part, escape, table_html
from web.verdicts import verdict_html

VERDICTS = (SILENT, TOLD, ALARM, SOUND)
KIND = {SILENT: "no", TOLD: "open", ALARM: "open", SOUND: "yes"}
STATUS = {SILENT: "fails", TOLD: "amber", ALARM: "amber", SOUND: "holds"}  # verdict → CSS class
TITLES = {SILENT: "Wrong without a warning, one by one", TOLD: "Wrong with a warning",
          ALARM: "Reported as implausible, but no bound is broken"}
MANY = 20  # rows in a table of pairs
SCENES = ("<p>No scene here is meant to be hard. The scenes combine every mesh, every kind of pins, every "
          "model and every kind of stiffness, mixed so that any values of three settings occur together in "
          "at least one run. Each run is judged by bounds that are true for any correct cloth, and not by "
          "the program's verdict.</p>")


def write_data(sections, results, out):
    write_objects(out / "summary.json", [entry for section in sections for entry in section.data])


def content(sections, out):
    judged = summary(out)
    covered = " ".join(section.text for section in sections)
    for section in sections:
        section.text = ""
    parts = []
    for verdict, title in TITLES.items():
        runs = [run for run in judged if run["verdict"] == verdict]
        if runs:
            parts.append(Part(f"runs-{verdict}", title, failures_html(runs), title.split(",")[0]))
    parts += [Part("rules", "Which runs, and by which rules", f"{SCENES}{rules()}<p>{escape(covered)}</p>",
                   "Rules"),
              Part("data", "As data", "<p><a href='summary.json'>summary.json</a>: every run.</p>", "Data")]
    return Content(answer(judged), overview(judged), parts,
                   data={"runs": [about(run) for run in judged if run["verdict"] != SOUND]},
                   verdicts=lambda section: [plain_matrix.matrix_html(judged), pairs_html(judged)])


def overview(judged):
    if not judged:
        return ""
    rows = "".join(f"<li>{verdict_html(KIND[verdict], str(count(judged, verdict)))} "
                   f"{escape(shares.NAMES[verdict])}</li>" for verdict in VERDICTS)
    return f"<ul class='tally'>{rows}</ul>"


def count(judged, verdict):
    return sum(run["verdict"] == verdict for run in judged)


def answer(judged):
    silent = [run for run in judged if run["verdict"] == SILENT]
    if not judged:
        return "There are no runs yet."
    if not silent:
        return (f"<b>No.</b> Of {len(judged)} runs {count(judged, TOLD)} broke a bound, and each of these "
                "runs has a warning.")
    worst = max(silent, key=excess)
    return (f"<b>Yes, {len(silent)} of {len(judged)} runs do.</b> The worst: {escape(bound_text(worst))}, "
            f"with {escape(settings_text(worst))}.")


def excess(run):
    """The worst number of a run over its limit; infinite if the number is not finite."""
    worst = known_values(run["worst"])
    return worst["value"] / worst["limit"] if np.isfinite(worst["value"]) else np.inf


def about(run):
    worst = known_values(run["worst"])
    finite = np.isfinite(worst["value"])
    return {"id": run["id"], "title": settings_text(run), "status": STATUS[run["verdict"]],
            "told": f"{shares.NAMES[run['verdict']]}{': ' + run['told'] if run['told'] else ''}",
            "worst": {"label": worst["what"], "value": worst["value"] if finite else None,
                      **({} if finite else {"text": "not finite"}), "limit": worst["limit"],
                      "unit": worst["unit"], "held": not run["broken"],
                      "note": f"broken: {', '.join(run['broken'])}" if run["broken"] else ""},
            "command": run["command"]}


def rules():
    return ("<p>A run breaks a bound if one of these statements is true. A coordinate is not a number. A "
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
    worst = known_values(run["worst"])
    unit = "" if worst["unit"] == "1" else f" {worst['unit']}"
    return (f"{worst['what']} {number(worst['value'])}{unit} (at most {number(worst['limit'])})")


def failures_html(runs):
    """A table of runs, sorted by worst number over limit; a click on a row opens the run."""
    names = list(runs[0]["settings"])
    chosen = {"method", "mesh", "pins", "model", "bending", "precision", "start"}
    head = "<th class='t'>worst number, its limit</th>" + "".join(
        f"<th class='t{' choose' if name in chosen else ''}'>{escape(name)}</th>" for name in names)
    rows = "".join(
        f"<tr><td class='t' data-run='{escape(run['id'])}' data-v='{min(excess(run), 1e9):.6g}'><button "
        f"type='button' class='opens'>{escape(bound_text(run))}</button></td>"
        + "".join(f"<td class='t'>{escape(str(run['settings'][name]))}</td>" for name in names) + "</tr>\n"
        for run in sorted(runs, key=excess, reverse=True))
    return ("<div class='scroll tall' tabindex='0' role='region' aria-label='Runs'><table class='sortable' "
            f"data-rows='runs'><thead><tr>{head}</tr></thead><tbody>{rows}</tbody></table></div>")


PAGE = Page("plain", "Does any run go wrong without a warning?", "./bendlab reproduce plain",
            [Figure(shares, "What fails, and where", "What fails")], content, write_data)
