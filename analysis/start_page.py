"""Writes results/index.html, the start page: which model for my mesh, and a card for every page.

It reads what the other pages wrote: summary.json of accuracy, stability and stiffness, and their answers.
"""
import right_python  # noqa: F401  (first: it may hand over to another Python)
import argparse
import json
import re
from pathlib import Path

import accuracy_runs
import charts_stiffness
from charts_accuracy import front
from committed import OWN
from html_parts import Made, Part, escape, number_text, page, table_html
from bendlab.results.load import group
from project_pages import KEPT, PAGES, links_html, made_of, sized
from report import Section, Table
from stability_cases import RED

TITLE = "Bending models for cloth: which one, how stiff, how stable, at what cost"
PICTURES = {"paper": "fig_5_promise.png", "stiffness": "fig_stiffness_effective.png",
            "accuracy": "fig_accuracy.png", "stability": "fig_stability_start_poses.png",
            "performance": "fig_performance_overview.png", "plain": "fig_plain_models.png"}
QUESTIONS = {"paper": "Does the paper hold?", "stiffness": "How stiff is it really?",
             "accuracy": "What does accuracy cost?", "stability": "What is stable?",
             "performance": "What does the solver cost?", "plain": "Does any run go wrong without a warning?"}
# What a cloth is like → experiments in which it was measured, and against what.
SCENES = {
    "hangs from two corners: gravity gives the shape": (
        "accuracy_front", "accuracy_front_slow", "accuracy_front_work_slow", "accuracy_beat",
        "accuracy_paper", "accuracy_paper_64", "accuracy_paper_cells_slow"),
    "stands out from a clamp: bending holds it up": (
        "accuracy_front_cantilever", "accuracy_front_cantilever_slow", "accuracy_front_cantilever_work_slow",
        "accuracy_paper_cantilever"),
    "drapes over a disc": ("accuracy_front_drape_slow",),
    "hangs from one pin": ("accuracy_front_one_pin_slow",)}
MOTION = ("accuracy_swing_slow",)  # against its own motion in 4096 substeps
FAMILIES = {"equilateral": "equilateral triangles", "grid": "a grid of squares with diagonals",
            "delaunay": "irregular triangles (delaunay)", "sphere": "a closed or curved surface",
            "disc": "rings around a centre (disc)"}
STIFF_MESHES = {"equilateral": "equilateral", "delaunay": "delaunay", "grid, alternating": "grid",
                "grid, one diagonal": "grid"}  # as checks name them → family
STABLE_CASES = {"grid": ("meshes: grid", "meshes: strip"), "delaunay": ("meshes: delaunay",),
                "sphere": ("meshes: ball", "curved: flattened", "curved: mirrored", "curved: inverted",
                           "rings_across: ball")}
LEVELS = (0.05, 0.01)  # errors of the table


def write(results):
    """Writes index.html into the folder `results` from the pages below it."""
    runs = accuracy_runs.with_ids(_objects(results, "accuracy"))
    stable, checks = _objects(results, "stability"), _checks(results)
    chosen = candidates(runs)
    data = accuracy_runs.data(chosen) if chosen else {"runs": []}
    data |= {"charts": [], "chooser": chooser_data(chosen, stable, checks)}
    top = (f"<h1>{escape(TITLE)}</h1><p class='lead'>Measured answers, each one click from its evidence.</p>")
    if results.name == OWN:
        top += ("<p class='grey small'>These pages are made of your own runs. The project's are <a "
                "href='../index.html'>the committed ones</a>.</p>")
    parts = [Part("choose", "Which model for my mesh?", chooser_html(runs), "Choose"),
             Part("pages", "The pages", cards_html(results), "Pages"),
             Part("origin", "Where the numbers are from", origin_html(results), "Origin")]
    made = Made("", "", "", "python3 analysis/start_page.py")
    text = page("bendlab: which model for my mesh?", top, parts, made, data, places=links_html("", results),
                player=False)
    (results / "index.html").write_text(sized(text, results), encoding="utf-8")


def _objects(results, name):
    path = results / name / "summary.json"
    return json.loads(path.read_text(encoding="utf-8")) if path.exists() else []


def _sections(results, name):
    path = results / name / KEPT
    return [Section.of_json(entry) for entry in json.loads(path.read_text(encoding="utf-8"))] \
        if path.exists() else []


def _checks(results):
    return [check for section in _sections(results, "stiffness") for check in section.checks]


# --- the chooser -------------------------------------------------------------------------------------------

def candidates(runs):
    """The runs that can be an answer: on the front of their model, cells and scene."""
    found = []
    for measure, scenes in (("error_physical_rms", SCENES.values()), ("error_solver_rms", [MOTION])):
        for names in scenes:
            own = [run for run in runs if run["experiment"] in names and run["status"] == "complete"
                   and run["point"] is not None]
            for some in group(own, lambda run: (run["model"], run["cells"])).values():
                found += front(some, measure)
    return found


def chooser_data(runs, stable, checks):
    """What the chooser reads besides the runs' configs and commands."""
    told = []
    for run in runs:
        moves = run["experiment"] in MOTION
        scene = next((i for i, names in enumerate(SCENES.values()) if run["experiment"] in names), 0)
        mesh = accuracy_runs.config_at(run)["mesh"]
        told.append({"id": run["id"], "model": run["model"], "cells": run["cells"], "scene": scene,
                     "family": mesh.get("generator", "grid"), "motion": moves, "ms": run["ms_per_frame"],
                     "error": 100 * run["error_solver_rms" if moves else "error_physical_rms"],
                     "substeps": run["settings"]["substeps"], "iterations": run["settings"]["iterations"],
                     "precision": run["settings"]["precision"],
                     "paper": run["stiffness"] == "k" and run["model"] != "none"})
    return {"runs": told, "scenes": list(SCENES), "families": FAMILIES, "stiffness": stiffness(checks),
            "stability": stability(stable)}


def stiffness(checks):
    """Family → model → the factor by which its stated stiffness changes with the resolution."""
    found = {}
    for model, by_mesh in charts_stiffness.ratios(checks, charts_stiffness.CALIBRATED).items():
        for mesh, ratio in by_mesh.items():
            family = STIFF_MESHES.get(mesh.split(", 1")[0])
            if family and "," not in model:
                own = found.setdefault(family, {})
                own[model] = max(ratio, own.get(model, 0))
    return found


def stability(runs):
    """Family → model → [red runs, runs]; "" is all cases."""
    found = {}
    for family, cases in {"": None, **STABLE_CASES}.items():
        for model, some in group([run for run in runs if cases is None or run["case"] in cases],
                                 lambda run: run["model"]).items():
            red = sum(run["verdict"] == RED for run in some)
            found.setdefault(family, {})[model] = [red, len(some)]
    return found


def chooser_html(runs):
    """The place of the chooser, and the same as a table for print and without scripts."""
    rows = []
    for scene, names in SCENES.items():
        own = [run for run in runs if run["experiment"] in names and run["status"] == "complete"]
        for level in LEVELS:
            near = [run for run in own if isinstance(run.get("error_physical_rms"), (int, float))
                    and run["error_physical_rms"] <= level]
            best = min(near, key=lambda run: run["ms_per_frame"], default=None)
            rows.append([scene, f"{100 * level:g} %"] + ([
                best["model"], best["cells"],
                f"{best['settings']['substeps']} × {best['settings']['iterations']}",
                number_text(100 * best["error_physical_rms"], 2), number_text(best["ms_per_frame"], 2)]
                if best else ["none of the measured runs", "", "", "", ""]))
    table = table_html(Table("The cheapest measured run within an error of the stated cloth", [
        "a cloth that", "error at most", "model", "cells", "substeps × iterations", "error (%)",
        "ms per frame"], rows)) if runs else "<p>There are no runs of accuracy yet.</p>"
    return ("<p>Say what your cloth is like; the answer is the measured run that fits best, with its config. "
            "Nothing here is typed by hand: it is read from the runs behind these pages.</p>"
            "<div id='chooser'></div><details><summary>The same as a table</summary>" + table + "</details>")


# --- cards -------------------------------------------------------------------------------------------------

def cards_html(results):
    """A card for every page that is there: a picture, and its answer in one sentence."""
    cards = ""
    for name, question in QUESTIONS.items():
        answer = answer_of(results / name / "index.html")
        if answer is None:
            continue
        picture = f"{name}/{PICTURES[name]}"
        image = (f"<img src='{picture}' alt='' loading='lazy'>" if (results / picture).exists() else "")
        cards += (f"<li class='card'><a href='{name}/index.html'>{image}<h3>{escape(question)}</h3></a>"
                  f"<p>{answer}</p><p class='grey small'>{escape(PAGES[name])}</p></li>")
    return f"<ul class='card-list'>{cards}</ul>" if cards else "<p>There are no pages yet.</p>"


def answer_of(file):
    """The answer on top of a page as HTML without links, None without the page."""
    if not file.exists():
        return None
    found = re.search(r"<p class='answer'>(.*?)</p>", file.read_text(encoding="utf-8"), re.DOTALL)
    return re.sub(r"</?a\b[^>]*>", "", found[1]) if found else ""


def origin_html(results):
    """Commit, date and machine of every page."""
    rows = []
    for name, text in PAGES.items():
        made = origin_of_page(results, name)
        if made:
            rows.append([text, made.commit, made.date, made.machine, made.command])
    return table_html(Table("", ["page", "commit", "date", "machine", "made by"], rows))


def origin_of_page(results, name):
    """The Made of a page, as far as it keeps one."""
    measured = results / name / "bench.json"
    if measured.exists():
        context = json.loads(measured.read_text(encoding="utf-8"))["context"]
        return Made(context["git_commit"][:12], context["date"][:10], context["processor"],
                    "./bendlab bench --json")
    sections = _sections(results, name)
    return made_of(sections, f"./bendlab reproduce {name}") if sections else None


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=Path("results"), help="folder of the pages")
    arguments = parser.parse_args()
    write(arguments.out)
    print(arguments.out / "index.html")
