"""Writes the page of the paper: index.html, summary.json (claims), reference.csv (medians of groups)."""
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
import fig_models
import fig_promise
import fig_promise_strip
import fig_scenes
import fig_structure
import fig_where
from html_parts import claim_html, document, escape, map_html, map_mark, mark, section_html
from load import at, group, statuses, summary_spread
from report import rounded, write_objects
from sweeps import CONFIGS, load_experiment

PAPER = [fig_map, fig_promise, fig_promise_strip, fig_1, fig_structure, fig_5, fig_where, fig_6, fig_7]
FIGURES = {"first": [fig_1], "paper": PAPER, "everything": [*PAPER, fig_ablations, fig_models, fig_scenes]}
COUNTS = ["springs", "springs_beyond_ring_1"]  # the same for every seed
REFERENCE = {"pin_max_stretch": 1, "pin_region_stretch": 1, "max_stretch": 1,
             "mean_strain": 0, "drop": 0}  # summary entry → offset subtracted from it


def main(results, out, only="everything"):
    """Writes the page of these figures into `out` from the runs below `results`; returns its sections.

    Of the first figure alone no page is made."""
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
    text = document("bendlab: the paper, repeated", body(sections, claims))
    (out / "index.html").write_text(text, encoding="utf-8")
    return sections


def _drawn(figure, results, out):
    """The section of a figure by its module's name, for another process."""
    return importlib.import_module(figure).main(results, out)


def body(sections, claims):
    """The page below its head."""
    parts = ["<h1>The paper, repeated</h1>", "<p class='lead'>Jong-Hyun Kim, <em>Bending Spring Model for "
             "Stable Strain-Based Dynamics in Triangular Meshes</em>: each figure repeated, and the measured "
             "numbers beside each claim. The sheets are chaotic, so numbers are medians over the last "
             "simulated second and over seeds. The rule under each claim turns its numbers into a "
             "verdict.</p>", "<p>Unless a figure says otherwise, a sheet of 1 m × 1 m in N × N cells is "
             "pinned at its upper right corner. It starts horizontal and falls for 4 s. Stretch σ₁ is the "
             "largest principal stretch of a triangle: σ₁ − 1 is 0 for an unstretched triangle and 1 for one "
             "that is twice as long.</p>",
             overview([each for section in sections for each in section.maps], claims)]
    parts += [paper_section(section) for section in sections]
    parts.append("<h2>As data</h2><p><a href='summary.json'>summary.json</a>: the claims. <a "
                 "href='maps.json'>maps.json</a>: every cell of the maps. <a "
                 "href='reference.csv'>reference.csv</a>: medians and ranges of every group of runs.</p>")
    return "\n".join(parts)


def overview(maps, claims):
    """One row per claim: first those with a map, then the others that are judged at all settings."""
    row = lambda figure, text, kind, verdict, sentence="": (
        f"<tr><td class='t'>Fig. {escape(figure)}</td><td class='t'>{escape(text)}"
        f"{f'<br><small>{escape(sentence)}</small>' if sentence else ''}</td><td class='t'><span "
        f"class='verdict {kind}'>{verdict}</span></td></tr>")
    rows = [row(each.figure, each.english, *map_mark(each), each.sentence) for each in maps]
    rows += [row(claim.figure, claim.claim, *mark(claim)) for claim in claims if not claim.setting]
    return f"<div class='scroll'><table class='overview'>{''.join(rows)}</table></div>"


def paper_section(section):
    label = f"<span>Fig. {escape(section.figure)}</span> " if section.figure and section.claims else ""
    return section_html(section, "./bendlab reproduce      # everything, and this page", label,
                        [*map(map_html, section.maps), *map(claim_html, section.claims)])


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
    parser.add_argument("--out", type=Path, default=Path("results/paper"), help="folder for the page")
    parser.add_argument("--only", choices=FIGURES, default="everything", help="which figures")
    arguments = parser.parse_args()
    main(arguments.results, arguments.out, arguments.only)
    print(arguments.out / ("fig_1.png" if arguments.only == "first" else "index.html"), flush=True)
