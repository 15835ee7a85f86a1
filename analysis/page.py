"""Writes the page of the paper: index.html, summary.json (claims), reference.csv (medians of groups)."""
import right_python  # noqa: F401  (first: it may hand over to another Python)
import argparse
import csv
import importlib
import json
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

import numpy as np

import fig_1
import fig_5
import fig_6
import fig_7
import fig_map
import fig_ablations
import fig_large_forces
import fig_models
import fig_promise
import fig_promise_strip
import fig_scenes
import fig_structure
import fig_where
import page_frames
from frames import place_html
from html_parts import Part, address, escape, picture_html, section_part
from bendlab.results.load import at, group, statuses, summary_spread
from project_pages import (KEPT, Content, folder_options, keep, kept, made_of, parsed, renew_start,
                           write)
from repeat import runs_of
from report import print_option, rounded, write_objects
from run_facts import differing, stated
from sweeps import CONFIGS, load_experiment, read_config
from verdicts_html import cards_html, claim_html, map_cells, map_html, map_mark, mark

COMMAND = "./bendlab reproduce"
EVERYTHING = f"{COMMAND}      # everything, and this page"
MOST_FRAMES = 61  # of each cloth that moves
FIRST_PICTURE = "fig_5_promise.png"
LINKS = {"Where each claim holds": "Maps",
         "The promise: Fig. 5 a third time, with our settings": "The promise",
         "As stiff at every resolution? The recommended cloth on strips": "Strips",
         "One pinned vertex": "Fig. 1", "The springs of a vertex": "Fig. 2-4",
         "Crossover against adaptive springs over resolutions": "Fig. 5",
         "Where the failure went: stretch against distance from the pin": "Where",
         "All rings against one ring (LOD)": "Fig. 6", "Another material by scaling n": "Fig. 7",
         "Large external forces": "Large forces",
         "Where the paper is silent": "Ablations", "Every bending model on the same scenes": "Models"}
RULES = ("<p>Jong-Hyun Kim, <em>Bending Spring Model for Stable Strain-Based Dynamics in Triangular "
         "Meshes</em>: each figure repeated, and the measured numbers beside each claim. The sheets are "
         "chaotic, so numbers are medians over the last simulated second and over seeds. The rule under each "
         "claim turns its numbers into a verdict.</p><p>Unless a figure says otherwise, a sheet of 1 m × 1 m "
         "in N × N cells is pinned at its upper right corner. It starts horizontal and falls for 4 s. "
         "Stretch σ₁ is the largest principal stretch of a triangle: σ₁ − 1 is 0 for an unstretched triangle "
         "and 1 for one that is twice as long.</p>")

PAPER = [fig_map, fig_promise, fig_promise_strip, fig_1, fig_structure, fig_5, fig_where, fig_6, fig_7]
FIGURES = {"first": [fig_1], "paper": PAPER,
           "everything": [*PAPER, fig_large_forces, fig_ablations, fig_models, fig_scenes]}
COUNTS = ["springs", "springs_beyond_ring_1"]  # the same for every seed
REFERENCE = {"pin_max_stretch": 1, "pin_region_stretch": 1, "max_stretch": 1,
             "mean_strain": 0, "drop": 0}  # summary entry → offset subtracted from it


def main(results, out, only="everything"):
    """Writes the page of these figures into `out` from the runs below `results`; returns its sections.

    Of the first figure alone no page is made."""
    sections = draw(results, out, only)
    if only != "first":
        lay_out(out, page_frames.of_runs({address(name): run for name, run in
                                          fig_promise.moving(results).items()}, MOST_FRAMES))
    return sections


def draw(results, out, only="everything"):
    """Draws the figures, and keeps what the page is made of."""
    out.mkdir(parents=True, exist_ok=True)
    with ProcessPoolExecutor() as pool:
        last_first = [pool.submit(_drawn, figure.__name__, results, out)  # the scenes take longest
                      for figure in reversed(FIGURES[only])]
        sections = [drawn.result() for drawn in reversed(last_first)]
    if only == "first":
        return sections
    claims = [claim for section in sections for claim in section.claims]
    write_objects(out / "summary.json", [claim.as_json() for claim in claims])
    write_objects(out / "maps.json", [each.as_json() for section in sections for each in section.maps])
    write_reference(results, out / "reference.csv")
    keep(out, sections)
    return sections


def _drawn(figure, results, out):
    """The section of a figure by its module's name, for another process."""
    return importlib.import_module(figure).main(results, out)


def lay_out(out, shown=None):
    """Writes index.html of what is kept. `shown`: frames; None: those that the page there has."""
    shown = shown or page_frames.taken_from(out / "index.html")
    sections = kept(out)
    claims = [claim for section in sections for claim in section.claims]
    maps = [each for section in sections for each in section.maps]
    names = {id(each): f"map-{i + 1}" for i, each in enumerate(maps)}
    parts = [paper_section(section, names) for section in sections]
    parts += [Part("rules", "How it is measured", RULES, "Rules"),
              Part("data", "As data", "<p><a href='summary.json'>summary.json</a>: the claims. <a "
                   "href='maps.json'>maps.json</a>: every cell of the maps. <a "
                   "href='reference.csv'>reference.csv</a>: medians and ranges of every group of runs.</p>",
                   "Data")]
    cells = [cell for each in maps for cell in map_cells(each, names[id(each)])]
    settings = with_configs(cells)
    parts[:0] = motion(shown)
    top = first_picture(sections) + overview(maps, claims)
    played = [{"id": name, "label": label, "name": label, "status": "complete", "title": label}
              for label in fig_promise.ROWS if (name := address(label)) in shown.heads]
    content = Content("The paper, repeated", answer(maps, claims), top, parts,
                      {"runs": cells + played, "settings": settings}, shown)
    write(out, "paper", content, made_of(sections, COMMAND))


def with_configs(cells):
    """Gives each cell `base` and `changes`, which tell the config of the first run of its commands: an entry
    of the list that is returned, and what differs from it."""
    bases = {}
    for cell in cells:
        lines = cell["command"].splitlines()
        if not lines[0].startswith("./bendlab run configs/"):
            continue
        config, points = runs_of(lines[0])
        own = stated(read_config(config), points[0])
        base = bases.setdefault(config, own)
        cell |= {"base": list(bases).index(config), "changes": differing(base, own)}
        if len(lines) > 1 or len(points) > 1:
            first = "the config below is that of its first run"
            cell["told"] = f"{cell['told']}; {first}" if cell["told"] else first
    return list(bases.values())


def motion(shown):
    """The section in which the rows of the first picture move; none without their frames."""
    if not shown.heads:
        return []
    told = (f"The rows of the picture above on {fig_promise.MOVING} cells: crossover springs, the paper's "
            "adaptive springs with the ring around the pin, and the recommended settings.")
    return [Part("motion", "The promise, in motion", f"<p>{escape(told)}</p>{place_html(shown.heads)}",
                 "Motion")]


def first_picture(sections):
    """The picture on top, "" without its runs."""
    found = [picture for section in sections for picture in section.pictures if picture[0] == FIRST_PICTURE]
    return picture_html(*found[0]) if found else ""


def answer(maps, claims):
    """The page's answer: how many of the claims hold where."""
    judged = [each.holds for each in maps] + [claim.holds for claim in claims if not claim.setting]
    everywhere, nowhere = sum(each is True for each in judged), sum(each is False for each in judged)
    unknown = sum(each is None for each in judged)
    if not judged:
        return "There are no runs yet."
    return (f"Of {len(judged)} claims, the paper's and ours, <b>{everywhere}</b> hold at every setting that "
            f"was measured, <b>{len(judged) - everywhere - nowhere - unknown}</b> at some, "
            f"<b>{nowhere}</b> at none"
            + (f"; {unknown} are open, because runs are missing" if unknown else "") + ".")


def named(figure):
    """A figure of the paper by its number, or what is ours."""
    return escape(f"Fig. {figure}" if figure[:1].isdigit() else figure.capitalize())


def overview(maps, claims):
    """One row per claim: first those with a map, then the others that are judged at all settings."""
    rows = [(named(each.figure),
             f"{escape(each.english)}<br><small>{escape(each.sentence)}</small>", map_mark(each))
            for each in maps]
    rows += [(named(claim.figure), escape(claim.claim), mark(claim)) for claim in claims
             if not claim.setting]
    return cards_html(rows)


def paper_section(section, names):
    label = f"{named(section.figure)}: " if section.figure and section.claims else ""
    verdicts = [*(map_html(each, names[id(each)]) for each in section.maps), *map(claim_html, section.claims)]
    return section_part(section, EVERYTHING, verdicts, label, link=LINKS.get(section.title, section.title))


def write_reference(results, path):
    """Writes one row per experiment and point of its sweep, with medians and ranges over seeds."""
    columns = ["experiment", "cells", "model", "pin_ring", "setting", "seeds", "status", *COUNTS]
    columns += [f"{name}{'_minus_1' if offset else ''}{part}" for name, offset in REFERENCE.items()
                for part in ("", "_low", "_high")]
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        for config in sorted(CONFIGS.glob("paper/*.json")) + sorted(CONFIGS.glob("ablations/*.json")):
            experiment = load_experiment(results, f"{config.parent.name}/{config.stem}")
            for setting, runs in sorted(group(experiment.runs,
                                              lambda run: _setting(run, experiment.sweep)).items()):
                status = " ".join(f"{count} {name}" for name, count in sorted(statuses(runs).items()))
                row = [f"{config.parent.name}/{config.stem}", *setting, len(runs), status]
                row += [f"{summary_spread(runs, name).median:.0f}" for name in COUNTS]
                for name, offset in REFERENCE.items():
                    s = summary_spread(runs, name) - offset
                    row += ["" if np.isnan(x) else rounded(x) for x in (s.median, s.low, s.high)]
                writer.writerow(row)


def _setting(run, sweep):
    """(cells, model, pinned rings, other swept settings as text)."""
    named = ("/mesh/cells", "/bending/model", "/pins/ring", "/initial/seed")
    rest = [f"{pointer}={json.dumps(at(run.config, pointer))}" for pointer in sweep
            if pointer not in named and at(run.config, pointer) is not None]
    return run.get("/mesh/cells", 0), run.model, run.get("/pins/ring"), " ".join(rest)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--results", type=Path, default=Path("results"), help="folder with the runs")
    folder_options(parser, "paper")
    parser.add_argument("--only", choices=FIGURES, default="everything", help="which figures")
    parser.add_argument("--again", action="store_true", help=f"write index.html again, of the {KEPT} there")
    print_option(parser)
    arguments = parsed(parser, "paper")
    if arguments.again:
        lay_out(arguments.out)
    else:
        main(arguments.results, arguments.out, arguments.only)
    if arguments.only != "first":
        renew_start(arguments.out)
    print(arguments.out / ("fig_1.png" if arguments.only == "first" else "index.html"), flush=True)
