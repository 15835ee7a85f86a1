"""Writes the page of accuracy and its cost: index.html, and summary.json with one object per run."""
import argparse
from pathlib import Path

import accuracy
import fig_accuracy
import fig_accuracy_beat
import fig_accuracy_roads
import fig_accuracy_rounding
import fig_accuracy_scaling
import fig_accuracy_solver
from html_parts import document, escape, section_html
from report import write_objects
from stiffness_page import checks_html
from sweeps import CONFIGS, load_experiment

FIGURES = [fig_accuracy, fig_accuracy_beat, fig_accuracy_solver, fig_accuracy_rounding, fig_accuracy_scaling,
           fig_accuracy_roads]
EVERYTHING = "./bendlab reproduce accuracy      # everything, and this page"


def main(results, out):
    """Writes the page into `out` from the runs below `results`; returns its sections."""
    out.mkdir(parents=True, exist_ok=True)
    sections = [figure.main(results, out) for figure in FIGURES]
    write_objects(out / "summary.json", summary(results))
    (out / "index.html").write_text(document("bendlab: what does accuracy cost?", body(sections)),
                                    encoding="utf-8")
    return sections


def summary(results):
    """One object per run of configs/accuracy. `on_front`: no run of its scene is cheaper and better."""
    single = {config.stem for config in (CONFIGS / "accuracy").glob("*.json")}.difference(*accuracy.FRONTS)
    objects = []
    for configs in [*accuracy.FRONTS, *((name,) for name in sorted(single))]:
        runs = [run for name in configs for run in load_experiment(results, f"accuracy/{name}").runs]
        front = {run.id for run in accuracy.front([run for run in runs if run.complete])}
        objects += [accuracy.as_json(run, run.id in front) for run in runs]
    return objects


def body(sections):
    """The page below its head."""
    parts = ["<h1>What does accuracy cost?</h1>", "<p class='lead'>Every bending model simulates one stated "
             "cloth. The page shows how far each is from that cloth, how much time it takes, and which "
             "settings use that time well.</p>", measures_html()]
    parts += [section_html(section, EVERYTHING, verdicts=[checks_html(section.checks)])
              for section in sections]
    parts.append("<h2>As data</h2><p><a href='summary.json'>summary.json</a>: every run.</p>")
    return "\n".join(parts)


def measures_html():
    """The meaning of each error as an HTML table."""
    rows = "".join(f"<tr><td class='t'>{escape(name)}</td><td class='t'>{escape(meaning)}</td></tr>"
                   for name, meaning in accuracy.MEANING.items())
    return f"<div class='scroll'><table>{rows}</table></div>"


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--results", type=Path, default=Path("results"), help="folder with the runs")
    parser.add_argument("--out", type=Path, default=Path("results/accuracy"), help="folder for the page")
    arguments = parser.parse_args()
    main(arguments.results, arguments.out)
    print(arguments.out / "index.html")
