"""The hard cases with other solver methods as HTML: a table of cases × methods, from runs in methods.json."""
import numpy as np

from web import stability_matrix
from figures.stability.cells import id_of
from web.html_parts import escape, folded
from bendlab.results.load import group
from tables.numbers import known_values
from runs.stability_cases import RED
from web.stability_matrix import VERDICTS, full_title_html

COLOURS = {"red": "unstable", "amber": "stable, not recovered", "green": "passes"}
CELLS = ("A cell shows the verdict of its worst model, and how many of the models have this verdict. A click "
         "on a cell opens the runs with this verdict, the worst run first.")
SCENES = ("The same cases on a coarser sheet of 16 cells. The membrane has a compliance, and bending has a "
          "physical stiffness, because implicit methods need energies. pbd has its default substeps; in the "
          "case of one iteration it has one substep. The other methods have one substep, and at most 10 "
          "iterations (quasi_newton) or 20 iterations (newton). newton runs with one model only, because it "
          "takes long. Energy is computed from the stated compliance. So cloth that stays stretched, because "
          "pbd has too few substeps, has gained energy.")


def methods_html(runs):
    """The HTML of the section on methods: the answer, the matrix, and which runs these are."""
    if not runs:
        return []
    table, alike = table_html(runs)
    return [f"<p><b>{answer(runs)}</b> {CELLS}</p>", table, alike,
            folded("Which runs these are", f"<p>{SCENES}</p>")]


def answer(runs):
    """A sentence: in how many cases each method is unstable, the most stable method first."""
    counts = {method: (len(cases_of(own_runs, RED)), len(cases_of(own_runs)))
              for method, own_runs in group(runs, lambda run: run["method"]).items()}
    parts = [f"{escape(method)} in {red} of {of}" for method, (red, of)
             in sorted(counts.items(), key=lambda entry: entry[1][0] / entry[1][1])]
    return f"Unstable with at least one model: {'; '.join(parts)} cases."


def cases_of(runs, verdict=None):
    """The names of the cases that have a run with this verdict; without a verdict, of all cases."""
    return {run["case"] for run in runs if verdict in (None, run["verdict"])}


def table_html(runs):
    """(a table of cases × methods for the cases whose runs have different verdicts, a list of the other cases
    by colour)."""
    by_case = group(runs, lambda run: run["case"])
    methods = list(group(runs, lambda run: run["method"]))
    telling, alike = stability_matrix.folded(by_case)
    head = "".join(f"<th class='t'>{escape(method)}</th>" for method in methods)
    rows = ""
    for name in telling:
        cells = "".join(_cell([run for run in by_case[name] if run["method"] == method])
                        for method in methods)
        rows += f"<tr><td class='t text'>{full_title_html(name)}</td>{cells}</tr>\n"
    return ("<div class='scroll' tabindex='0' role='region' aria-label='Cases and methods'><table "
            f"class='shares cards'><thead><tr><th class='t'>case</th>{head}</tr></thead><tbody>{rows}</tbody>"
            f"</table></div>{_key_html()}", alike)


def _cell(runs):
    """A cell with the worst verdict of the models in a case; it opens the runs with this verdict."""
    if not runs:
        return "<td class='t'></td>"
    verdict = next(colour for colour in VERDICTS if any(run["verdict"] == colour for run in runs))
    worst = sorted((run for run in runs if run["verdict"] == verdict), key=excess, reverse=True)
    ids = " ".join(map(id_of, worst))
    return (f"<td class='t' data-run='{escape(ids)}'><button type='button' class='opens'><span class='status "
            f"{verdict}' title='{verdict}'>{len(worst)} of {len(runs)}</span></button></td>")


def excess(run):
    """The worst number of a run as a multiple of the number's limit."""
    worst = known_values(run["worst"])
    return np.nan_to_num(worst["value"] / worst["limit"], nan=np.inf) if worst["limit"] else np.inf


def _key_html():
    return "<p class='key'>" + "".join(f"<span class='status {verdict}'>{verdict}: {COLOURS[verdict]}</span>"
                                       for verdict in VERDICTS) + "</p>"
