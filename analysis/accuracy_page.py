"""Writes the page of accuracy and its cost: index.html, and summary.json with one object per run."""
import right_python  # noqa: F401  (first: it may hand over to another Python)
import accuracy
import accuracy_runs
import charts_accuracy
import fig_accuracy
import fig_accuracy_beat
import fig_accuracy_methods
import fig_accuracy_roads
import fig_accuracy_rounding
import fig_accuracy_scaling
import fig_accuracy_solver
import project_pages
from charts_html import chart_html, placed
from html_parts import Part, escape, number_text, section_part, table_html
from project_pages import Content, command_line, keep, kept, made_of, write
from report import Table, write_objects
from sweeps import CONFIGS, load_experiment
from verdicts_html import checks_html

FIGURES = [fig_accuracy, fig_accuracy_beat, fig_accuracy_solver, fig_accuracy_rounding, fig_accuracy_scaling,
           fig_accuracy_roads, fig_accuracy_methods]
COMMAND = "./bendlab reproduce accuracy"
EVERYTHING = f"{COMMAND}      # everything, and this page"
LINKS = ["Error and time", "Nearer for less", "Same work", "Substeps", "Scaling", "References", "Methods"]
NEAR = 0.01  # the error of the answer
COLUMNS = ["run", "scene", "model", "cells", "substeps × iterations", "precision",
           "error from the stated (%)", "error from its own (%)", "ms per frame", "status"]


def main(results, out):
    """Writes the page into `out` from the runs below `results`; returns its sections."""
    sections = draw(results, out)
    lay_out(out)
    return sections


def draw(results, out):
    """Draws the figures, and keeps what the page is made of."""
    out.mkdir(parents=True, exist_ok=True)
    sections = [figure.main(results, out) for figure in FIGURES]
    write_objects(out / "summary.json", summary(results))
    keep(out, sections)
    return sections


def renew(results, out, name):
    """Draws the section of one figure again, and keeps the others with their runs as they are."""
    figure = next(figure for figure in FIGURES if figure.__name__ == name)
    section = figure.main(results, out)
    sections = [each for each in kept(out) if each.title != section.title]
    sections.insert(FIGURES.index(figure), section)
    fresh = summary(results)
    drawn = {run["experiment"] for run in fresh}
    write_objects(out / "summary.json",
                  [run for run in project_pages.summary(out) if run["experiment"] not in drawn] + fresh)
    keep(out, sections)
    lay_out(out)


def summary(results):
    """One object per run of configs/accuracy. `on_front`: no run of its scene is cheaper and better."""
    single = {config.stem for config in (CONFIGS / "accuracy").glob("*.json")}.difference(*accuracy.FRONTS)
    objects = []
    for configs in [*accuracy.FRONTS, *((name,) for name in sorted(single))]:
        runs = [run for name in configs for run in load_experiment(results, f"accuracy/{name}").runs]
        front = {run.id for run in accuracy.front([run for run in runs if run.complete])}
        objects += [accuracy.as_json(run, run.id in front) for run in runs]
    return objects


def lay_out(out):
    """Writes index.html of what is kept."""
    sections, runs = kept(out), accuracy_runs.with_ids(project_pages.summary(out))
    charts = charts_accuracy.charts(runs, COMMAND)
    parts = [section_part(section, EVERYTHING, [checks_html(section.checks)], link=link,
                          **placed(charts, section))
             for section, link in zip(sections, LINKS)]
    parts += [Part("runs", "Every run", runs_html(runs), "Runs"),
              Part("rules", "What an error is", measures_html(), "Errors"),
              Part("data", "As data", "<p><a href='summary.json'>summary.json</a>: every run.</p>", "Data")]
    top = "".join(chart_html(chart) for chart in charts if not chart["section"])
    content = Content("What does accuracy cost?", answer(runs), top, parts,
                      accuracy_runs.data(runs) | {"charts": charts})
    write(out, "accuracy", content, made_of(sections, COMMAND))


def answer(runs):
    """The page's answer: the cheapest run near the stated cloth, and what the paper's setting does."""
    told = []
    for scene, names in charts_accuracy.SCENES.items():
        known = [run for run in runs if run["experiment"] in names
                 and isinstance(run.get("error_physical_rms"), (int, float))]
        near = [run for run in known if run["error_physical_rms"] <= NEAR]
        if near and len(told) < 2:
            best = min(near, key=lambda run: run["ms_per_frame"])
            told.append(f"on the {scene} <a href='#run-{escape(best['id'])}'>{escape(best['model'])}</a> in "
                        f"<b>{number_text(best['ms_per_frame'], 2)} ms</b> per frame")
    text = f"Within {100 * NEAR:g} % of the stated cloth is cheapest: {', and '.join(told)}." if told else ""
    paper = next((run for run in runs if run["experiment"] == "accuracy_paper_64"
                  and run["model"] == "adaptive" and run.get("error_physical_rms")), None)
    if paper:
        text += (f" The paper's setting on 64 cells is {number_text(100 * paper['error_physical_rms'], 3)} % "
                 f"off, at {number_text(paper['ms_per_frame'], 2)} ms.")
    return text or "There are no runs yet."


def runs_html(runs):
    """Every run in a table; each opens."""
    if not runs:
        return "<p>There is none.</p>"
    percent = lambda run, name: "" if charts_accuracy.in_percent(run, name) is None else number_text(
        charts_accuracy.in_percent(run, name))
    rows = ""
    for run in runs:
        ms = run.get("ms_per_frame")
        cells = [accuracy_runs.scene(run), run["model"], run["cells"], accuracy_runs.work(run),
                 run["settings"].get("precision", ""),
                 percent(run, "error_physical_rms"), percent(run, "error_solver_rms"),
                 number_text(ms) if isinstance(ms, (int, float)) else "", run["status"]]
        text = "".join(f"<td{' class=t' if i in (0, 1, 3, 4, 8) else ''}>{escape(str(cell))}</td>"
                       for i, cell in enumerate(cells))
        rows += (f"<tr><td class='t' data-run='{escape(run['id'])}'><button type='button' class='opens'>open"
                 f"</button></td>{text}</tr>\n")
    text_columns, chosen = (0, 1, 2, 4, 5, 9), (1, 2, 3, 5, 9)
    head = "".join(f"<th class='{'t' if i in text_columns else ''}{' choose' if i in chosen else ''}'>{name}"
                   "</th>" for i, name in enumerate(COLUMNS))
    return ("<div class='scroll tall' tabindex='0' role='region' aria-label='Every run'><table "
            f"class='sortable' data-rows='runs'><thead><tr>{head}</tr></thead><tbody>{rows}</tbody></table>"
            "</div>")


def measures_html():
    """The meaning of each error as an HTML table."""
    return table_html(Table("", ["error", "what it is"], [list(row) for row in accuracy.MEANING.items()]))


if __name__ == "__main__":
    command_line("accuracy", __doc__, main, lay_out, (renew, FIGURES))
