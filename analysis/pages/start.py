"""results/index.html, the start page: which model for my mesh, and a card for every page.

The start page reads files of all other pages: sections, answers, summary.json of accuracy and stability.
"""
import itertools
import re

from bendlab.results.load import group
from figures.stiffness.calibrated import RULES
from pages import performance
from pages.project import NAMES, kept, links_html, made_of, sized, summary
from runs import accuracy_runs
from runs.accuracy_runs import SCENES, candidates, cheapest
from runs.stability_cases import RED
from tables.committed import OWN
from tables.table import Table
from web.html_parts import Made, Part, escape, folded, page, table_html

TITLE = "Bending models for cloth: which one, how stiff, how stable, at what cost"
PICTURES = {"paper": "fig_5_promise.png", "verification": "cells.png", "stiffness": "effective.png",
            "accuracy": "levels.png",
            "stability": "fig_stability_start_poses.png", "performance": "step.png"}
QUESTIONS = {"paper": "Are the paper's claims true?", "verification": "Are the equations solved?",
             "stiffness": "How stiff is it really?",
             "accuracy": "What does accuracy cost?", "stability": "What is stable?",
             "performance": "What does the solver cost?", "plain": "Does any run go wrong without a warning?"}
FAMILIES = {"equilateral": "equilateral triangles", "grid": "a grid of squares with diagonals",
            "delaunay": "irregular triangles (delaunay)", "sphere": "a closed or curved surface",
            "disc": "rings around a centre (disc)"}
STIFF_MESHES = {"same": "grid", "alternating": "grid"}  # mesh of a strip → its family, if the names differ
STABLE_CASES = {"grid": ("meshes: grid", "meshes: strip"), "delaunay": ("meshes: delaunay",),
                "sphere": ("meshes: ball", "curved: flattened", "curved: mirrored", "curved: inverted",
                           "rings_across: ball")}
LEVELS = (0.05, 0.01)  # errors of the table


def write(results):
    """Writes index.html into the folder `results` from the pages below it."""
    chosen = candidates(summary(results / "accuracy"))
    data = accuracy_runs.data([run for run, *_ in chosen]) if chosen else {"runs": []}
    data |= {"charts": [], "chooser": {
        "runs": [chooser_run(*candidate) for candidate in chosen], "scenes": list(SCENES),
        "families": FAMILIES, "stiffness": stiffness(sections(results, "stiffness")),
        "stability": stability(summary(results / "stability"))}}
    top = f"<h1>{escape(TITLE)}</h1><p class='lead'>Measured answers, each with a link to its evidence.</p>"
    if results.name == OWN:
        top += ("<p class='grey small'>These pages show your own runs. The project's runs are on <a "
                "href='../index.html'>the committed pages</a>.</p>")
    origins = [{"page": text} | vars(made) for name, text in NAMES.items()
               if (made := origin_of_page(results, name))]
    origin = Table.of("origin", "", ["page", "commit", "date", "machine", ("command", "made by")], origins)
    parts = [Part("choose", "Which model for my mesh?", chooser_html(chosen), "Choose"),
             Part("pages", "The pages", cards_html(results), "Pages"),
             Part("origin", "Where the numbers are from", table_html(origin), "Origin")]
    made = Made("", "", "", "python3 analysis/page.py PAGE")
    text = page("bendlab: which model for my mesh?", top, parts, made, data, places=links_html("", results),
                player=False)
    (results / "index.html").write_text(sized(text, results), encoding="utf-8")


def sections(results, name):
    """The sections in a page's page.json; [] without a page, or for a page of another version."""
    try:
        return kept(results / name)
    except (FileNotFoundError, ValueError):
        return []


# --- the chooser -------------------------------------------------------------------------------------------

def chooser_run(run, scene, error, against):
    """The data of a run that the chooser reads, besides its config and command."""
    solver = run["settings"]
    return {"id": run["id"], "model": run["model"], "method": solver["method"], "cells": run["cells"],
            "scene": list(SCENES).index(scene),
            "family": accuracy_runs.config_at(run)["mesh"].get("generator", "grid"),
            "against": against, "ms": run["ms_per_frame"], "error": 100 * run[f"{error}_rms"],
            "unknown": 100 * (run.get(f"{error}_reference_gap") or 0), "substeps": solver["substeps"],
            "iterations": solver["iterations"], "precision": solver.get("precision", "double"),
            "paper": run["stiffness"] == "k" and run["model"] != "none"}


def stiffness(sections_):
    """Family of meshes → model → factor by which the model's stated stiffness changes with the resolution."""
    factors = {}
    for row in (row for section in sections_ for row in section.table("summary")):
        if row["rule"] == RULES[0] and "," not in row["name"]:
            own = factors.setdefault(STIFF_MESHES.get(row["family"], row["family"]), {})
            own[row["name"]] = max(row["ratio"], own.get(row["name"], 0))
    return factors


def stability(runs):
    """Family of meshes → model → [number of red runs, number of runs]; the family "" has all cases."""
    families = {"": runs} | {family: [run for run in runs if run["case"] in cases]
                             for family, cases in STABLE_CASES.items()}
    return {family: {model: [sum(run["verdict"] == RED for run in same_model), len(same_model)]
                     for model, same_model in group(own, lambda run: run["model"]).items()}
            for family, own in families.items() if own}


def chooser_html(chosen):
    """HTML of the chooser, and a table of its answers for print and for browsers without scripts."""
    rows = []
    for scene, level in itertools.product(SCENES, LEVELS):
        _, error, against = SCENES[scene]
        rows.append({"scene": scene, "level": f"{100 * level:g} %", "against": against, "method": "",
                     "work": "", "model": "none of the measured runs"})
        if best := cheapest(chosen, scene, level):
            rows[-1] |= {"model": best["model"], "method": best["settings"]["method"], "cells": best["cells"],
                         "work": accuracy_runs.work(best), "error": 100 * best[f"{error}_rms"],
                         "ms": best["ms_per_frame"]}
    table = table_html(Table.of("cheapest", "The fastest measured runs for given limits of the error", [
        ("scene", "a cloth that"), ("level", "error at most"), ("against", "error from"), "model", "method",
        "cells", ("work", "substeps × iterations"), ("error", "error", "", "%"),
        ("ms", "time per frame", "", "ms")], rows)) if chosen else "<p>There are no accuracy runs yet.</p>"
    return ("<p>Describe your cloth. The answer is the measured run that fits best, with its config. All "
            "numbers are read from the runs behind these pages.</p><div id='chooser'></div>"
            + folded("The answers as a table", table))


# --- cards -------------------------------------------------------------------------------------------------

def cards_html(results):
    """A card for every page that exists: a picture, and the page's answer in one sentence."""
    cards = ""
    for name, question in QUESTIONS.items():
        if (answer := answer_of(results / name / "index.html")) is None:
            continue
        picture = f"{name}/{PICTURES.get(name, 'none')}"
        image = f"<img src='{picture}' alt='' loading='lazy'>" if (results / picture).exists() else ""
        cards += (f"<li class='card'><a href='{name}/index.html'>{image}<h3>{escape(question)}</h3></a>"
                  f"<p>{answer}</p><p class='grey small'>{escape(NAMES[name])}</p></li>")
    return f"<ul class='card-list'>{cards}</ul>" if cards else "<p>There are no pages yet.</p>"


def answer_of(file):
    """The answer on top of a page as HTML without links; None if there is no page."""
    if not file.exists():
        return None
    match = re.search(r"<p class='answer'>(.*?)</p>", file.read_text(encoding="utf-8"), re.DOTALL)
    return re.sub(r"</?a\b[^>]*>", "", match[1]) if match else ""


def origin_of_page(results, name):
    """Commit, date and machine of a page (Made); None if no file of the page states them."""
    measured = results / name / "bench.json"
    if measured.exists():
        return performance.made_by(performance.read(measured)["context"])
    kept_sections = sections(results, name)
    return made_of(kept_sections, f"./bendlab reproduce {name}") if kept_sections else None
