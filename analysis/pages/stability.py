"""The page of the hard cases: what is stable."""
import string
from collections import Counter

from bendlab.results.load import group
from figures.stability import cells, fabrics, methods, pin
from pages.project import Content, Figure, Page, summary
from runs.stability_cases import (AMBER, APART, CREEP, ENERGY, FAR, GREEN, MOMENTUM, NEAR, NOT_BACK, RED,
                                  SECTIONS, STRAIN_CEILING, STRAIN_FLOOR, worst_of)
from tables.numbers import span, unit_text
from tables.section import address, read_objects, write_objects
from tables.table import Table
from web import stability_matrix
from web.html_parts import Part, escape, folded, picture_html, table_html

UNKNOWN = "not known"
PLAIN = "meshes: grid"  # the case with which all flaws and meshes are compared
LINKS = {"Start poses": "Starts", "Curved rest shape": "Curved", "Pins and loads": "Pins",
         "Flawed meshes": "Flaws", "Meshes and units": "Meshes", "Moving freely": "Free"}
METHODS, FABRICS = "methods.json", "fabrics.json"
# Id of a section → file of its runs
FILES = {"cells": "summary.json", "methods": METHODS, "fabrics": FABRICS}
PICTURE = ("The last good frame of the worst run of each case, for each criterion that makes the case red. A "
           "case without red runs has the last frame of its worst amber run. Colour is stretch. Each picture "
           "shows the whole cloth, and the text below states the cloth's extent (one size at rest).")
FIGURES = [Figure(cells, "Cases whose verdict depends on the model", "Cases"),
           Figure(methods, "Hard cases with other solver methods", "Methods"),
           Figure(fabrics, "Hard cases with the bending laws of fabrics", "Fabrics"),
           Figure(pin, "Is the degenerate triangle the cause?", "One pin",
                  "A sheet of 64 × 64 cells hangs from one vertex with the published settings: ten "
                  "iterations, k = 0.5, one step of 1/60 s. Three numbers are measured in each frame, "
                  f"within {pin.NEAR} rings of the pin: the largest stretch of a triangle, the worst shape "
                  "of a triangle, and the largest correction. A correction is the distance by which "
                  "constraints moved a vertex from its free flight. A triangle is degenerate if its longest "
                  f"edge is more than {pin.NEEDLE:g} times the shortest or an angle exceeds {pin.CAP:g}°. "
                  f"The strain of a triangle has failed above a stretch of {1 + pin.STRETCHED:g}. A "
                  "correction overshoots if it is longer than an edge.")]


def write_data(sections, results, out):
    for section in sections:
        if section.data:
            write_objects(out / FILES[section.id], section.data)


def content(sections, out):
    runs, by_method, by_law = summary(out), *(read_objects(out / file) for file in (METHODS, FABRICS))
    matrix, alike = stability_matrix.cases_html(runs) if runs else ("", "")
    note = plain_grid(runs)
    lead = ("<p>Each row is a case; the cases whose verdicts differ most among models come first. The left "
            "half of a cell is for single precision, the right half for double precision. A click on a cell "
            f"opens its run: the worst number and its limit, the reason, config and command. {note}</p>")
    verdicts = {"cells": [lead, matrix, alike], "methods": stability_matrix.methods_html(by_method),
                "fabrics": stability_matrix.fabrics_html(by_law)}
    also = "".join(f", <a href='{file}'>{file}</a>: the runs with {what}" for file, what, listed in (
        (METHODS, "other methods", by_method), (FABRICS, "the bending laws of fabrics", by_law)) if listed)
    parts = [*filter(None, (section_of(title, cases, runs, out) for title, cases in SECTIONS.items())),
             Part("rules", "The rules", rules(), "Rules"),
             Part("data", "As data",
                  f"<p><a href='summary.json'>summary.json</a>: the runs with all models{also}.</p>", "Data")]
    top = stability_matrix.groups_html(runs) if runs else ""
    return Content(answer(runs), top + (f"<p class='note'>{note}</p>" if note else ""), parts,
                   data=stability_matrix.data([*runs, *by_method, *by_law]),
                   verdicts=lambda section: verdicts.get(section.id, []))


def answer(runs):
    if not runs:
        return "There are no runs yet."
    counts, compared = Counter(run["verdict"] for run in runs), stability_matrix.shared(runs)
    text = (f"Of all {len(runs)} runs {counts[RED]} fail, {counts[AMBER]} are stable but do not recover, "
            f"{counts[GREEN]} pass.")
    if not compared:
        return f"There is no hard case with runs of every model yet. {text}"
    red = {model: sum(run["verdict"] == RED for run in own_runs)
           for model, own_runs in group(compared, lambda run: run["model"]).items()}
    few, many = (group(red, red.get)[pick(red.values())] for pick in (min, max))  # models
    fail = lambda models: (", ".join(f"<b>{escape(model)}</b>" for model in models)
                           + (" fails" if len(models) == 1 else " fail"))
    return (f"Every model has {len(compared) // len(red)} comparable runs, each a hard case in one "
            f"precision. {fail(few)} in the fewest of these runs, {red[few[0]]}. {fail(many)} in the most, "
            f"{red[many[0]]}. {text}")


def rules():
    return ("<p>A run is <b>red</b> if one of these statements is true. The run ended with a value that is "
            f"not a number. A vertex was at any time {APART:g} times as far from the cloth's middle as at "
            f"the start (at least {APART:g} sizes; a size is the diagonal of the rest shape), or at the end "
            f"more than {FAR:g} sizes. Without forces, the momentum changed by more than {MOMENTUM} times "
            "the random walk of the projections' rounding errors. In a case where nothing adds energy, the "
            f"total energy rose above its value at the start by more than {ENERGY:g} of the sum of kinetic "
            "energy, elastic energy and weight × size. A stiffness given as k defines no elastic energy. So "
            "energy is checked only for cases that start at rest length or are elastic, and not for "
            "prestressed springs, which push from the start.</p><p>A run is <b>amber</b> if it is stable "
            "but has not recovered. Either the mean strain stays above twice the mean strain of the "
            f"undisturbed run (which counts as at least {STRAIN_FLOOR:g} and at most {STRAIN_CEILING:g}). Or "
            "the cloth could reach its rest shape, but its distance from the rest shape is still more than "
            f"{100 * NEAR:g} % of its size (root mean square, after the best rotation and translation) and "
            "more than twice the distance in the undisturbed run (which counts as at most "
            f"{100 * NOT_BACK / 2:g} %). Or a cloth at rest creeps by more than {CREEP:g} sizes. Mean strain "
            "is the median over the last second.</p>")


def plain_grid(runs):
    """A note if the run of the plain grid is amber: all flaws and meshes are compared with this run."""
    seen = group([run for run in runs if run["case"] == PLAIN], lambda run: run["model"])
    amber = sum(any(run["verdict"] == AMBER for run in own_runs) for own_runs in seen.values())
    if not amber:
        return ""
    return ("Red means unstable, so red cells show differences between models. Amber only means not "
            "recovered. Even the undisturbed run (the plain grid, stretched by half and released) is amber "
            f"for {amber} of {len(seen)} models, in one precision or in both. So an amber cell tells nothing "
            "about the flaws and meshes that are compared with this run.")


def section_of(title, cases, runs, out):
    """The section of a group of cases: a picture, reasons of runs that are not green, rules. None without
    runs."""
    by_case = group(runs, lambda run: run["case"])
    here = [case for case in cases if case.name in by_case]
    if not here:
        return None
    failed = [run for run in runs if run["case"] in [case.name for case in here] and run["verdict"] != GREEN]
    rows = [{"case": case.title, "config": case.config + ".json", "rule": case.rule}
            | {verdict: sum(run["verdict"] == verdict for run in by_case[case.name])
               for verdict in (GREEN, AMBER, RED)} for case in here]
    rules_table = Table.of("rules", "", ["case", "config", GREEN, AMBER, RED, ("rule", "green if")], rows)
    picture = f"fig_stability_{address(title).replace('-', '_')}.png"
    parts = [picture_html(picture, PICTURE)] if (out / picture).exists() else []
    if failed:
        parts.append(failed_html(failed, len(stability_matrix.models_of(runs))))
    parts.append(folded(f"The {len(here)} cases and their rules", table_html(rules_table)))
    return Part(address(title), title, "\n".join(parts), LINKS.get(title, title))


def failed_html(failed, models):
    """Table of runs that are not green, one row per case, verdict and reason. A list below the table gives
    the reasons by letter. `models`: number of models on the page."""
    letters, rows = {}, []
    by_row = group(failed, lambda run: (run["title"], run["verdict"], run["why"] or UNKNOWN))
    for (title, verdict, why), row_runs in by_row.items():
        numbers = group(map(worst_of, row_runs), lambda worst: (worst.name, unit_text(worst.unit)))
        rows.append({"case": title, "verdict": verdict, "models": models_text(row_runs, models),
                     "why": letters.setdefault(why, string.ascii_lowercase[len(letters)]),
                     "worst": "; ".join(f"{name} {span([worst.value for worst in worsts])}{unit}"
                                        for (name, unit), worsts in numbers.items()),
                     "limit": "; ".join(span([worst.limit for worst in worsts])
                                        for worsts in numbers.values())})
    table = table_html(Table.of("failed", "What is not green", [
        "case", "verdict", "models", ("worst", "worst number"), ("limit", "its limit"), "why"], rows))
    legend = "".join(f"<li>{escape(why)}</li>" for why in letters)
    return f"{table}<ol type='a'>{legend}</ol>"


def models_text(runs, models):
    """The models of these runs as text; the precision follows a model that has runs in one precision only.
    `models`: number of models on the page."""
    precisions = group(runs, lambda run: run["model"])
    if len(precisions) == models and all(len(own_runs) == 2 for own_runs in precisions.values()):
        return "all"
    return ", ".join(model + ("" if len(own_runs) == 2 else f" ({own_runs[0]['precision']})")
                     for model, own_runs in precisions.items())


PAGE = Page("stability", "What is stable?", "./bendlab reproduce stability", FIGURES, content, write_data)
