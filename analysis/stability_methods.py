"""The hard cases by other solver methods: a table of cases × methods, and methods.json with every run."""
import json

import numpy as np

import stability_matrix
from fig_stability import cells_of
from html_parts import escape, folded, section_part
from bendlab.results.load import group
from report import Section, known, rounded, write_objects
from stability_cases import METHOD_CASES, METHODS, RED
from stability_matrix import VERDICTS, full_title_html, id_of

TITLE = "The same with other methods"
FILE = "methods.json"
COLOURS = {"red": "unstable", "amber": "stable, not recovered", "green": "passes"}
CELLS = ("A cell has the verdict of its worst model, and how many of its models have that verdict. It opens "
         "these runs, the worst first.")
SCENES = ("The same cases on a coarser sheet, of 16 cells. Its membrane has a compliance and its bending a "
          "physical stiffness, because implicit methods need energies. pbd has its default substeps, and one "
          "in the case of one iteration; the others have one, and at most 10 (quasi_newton) or 20 iterations "
          "(newton). newton has one model, because it takes long. Energy is that of the stated "
          "compliance: where the substeps of pbd are too few for it, cloth that they leave stretched has "
          "gained energy.")


def main(results, out):
    """Judges the runs, and writes methods.json. Returns the section."""
    section = Section(TITLE, "stability_methods")
    cells = cells_of(results, section, METHOD_CASES, METHODS, lambda run: (run.model, run.method))
    write_objects(out / FILE, [as_json(cell) for cell in cells.values()])
    return section


def as_json(cell):
    return {"case": cell.case.name, "title": cell.case.title, "model": cell.model, "method": cell.run.method,
            "verdict": cell.verdict, "worst": rounded(cell.worst.as_json()),
            "seconds": rounded(cell.run.cpu_s), "why": "", "config": cell.run.experiment,
            "point": cell.run.point}


def kept_runs(out):
    """The objects of methods.json; none without it."""
    file = out / FILE
    return json.loads(file.read_text(encoding="utf-8")) if file.exists() else []


def part(section, runs, everything):
    """The section as a part of the page."""
    if not runs:
        return section_part(section, everything, link="Methods")
    table, alike = table_html(runs)
    told = [f"<p><b>{answer(runs)}</b> {CELLS}</p>", table, alike,
            folded("Which runs these are", f"<p>{SCENES}</p>")]
    return section_part(section, everything, told, link="Methods")


def answer(runs):
    """In how many cases each method is unstable, those with the fewest first, as a sentence."""
    counts = {method: (len(cases_of(some, RED)), len(cases_of(some)))
              for method, some in group(runs, lambda run: run["method"]).items()}
    told = [f"{escape(method)} in {red} of {of}" for method, (red, of)
            in sorted(counts.items(), key=lambda entry: entry[1][0] / entry[1][1])]
    return f"Unstable with at least one model: {'; '.join(told)} cases."


def cases_of(runs, verdict=None):
    """The names of the cases that have a run with this verdict, or any run."""
    return {run["case"] for run in runs if verdict in (None, run["verdict"])}


def table_html(runs):
    """(the cases × the methods, without the cases all of whose runs have one colour; these, by colour)."""
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
    """The worst verdict of a case's models, as a cell that opens the runs that have it."""
    if not runs:
        return "<td class='t'></td>"
    verdict = next(each for each in VERDICTS if any(run["verdict"] == each for run in runs))
    worst = sorted((run for run in runs if run["verdict"] == verdict), key=excess, reverse=True)
    ids = " ".join(map(id_of, worst))
    return (f"<td class='t' data-run='{escape(ids)}'><button type='button' class='opens'><span class='status "
            f"{verdict}' title='{verdict}'>{len(worst)} of {len(runs)}</span></button></td>")


def excess(run):
    """How far beyond its limit the worst number of a run is."""
    worst = known(run["worst"])
    return np.nan_to_num(worst["value"] / worst["limit"], nan=np.inf) if worst["limit"] else np.inf


def _key_html():
    return "<p class='key'>" + "".join(f"<span class='status {verdict}'>{verdict}: {COLOURS[verdict]}</span>"
                                       for verdict in VERDICTS) + "</p>"
