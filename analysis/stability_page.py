"""Writes the page of the hard cases: index.html with the matrix, and summary.json with one object per run."""
import argparse
import string
from pathlib import Path

import fig_stability
import fig_stability_pin
import style
from html_parts import document, escape, section_html, table_html
from load import group, models
from report import Table, rounded, write_objects
from stability_cases import (AMBER, APART, CASES, CREEP, ENERGY, FAR, GREEN, MOMENTUM, NEAR, NOT_BACK, RED,
                             SECTIONS, STRAIN_CEILING, STRAIN_FLOOR)

EVERYTHING = "./bendlab reproduce stability      # everything, and this page"
UNKNOWN = "not known"
VERDICTS = (RED, AMBER, GREEN)
PLAIN = "meshes: grid"  # the undisturbed run of all flaws and meshes; also a case
KIND = {GREEN: "yes", AMBER: "open", RED: "no"}


def main(results, out):
    """Writes the page into `out` from the runs below `results`; returns its section."""
    out.mkdir(parents=True, exist_ok=True)
    section = fig_stability.main(results, out)
    write_objects(out / "summary.json", [as_json(cell) for cell in section.cells.values()])
    pin = fig_stability_pin.main(results, out)
    (out / "index.html").write_text(document("bendlab: what is stable?", body(section, pin)),
                                    encoding="utf-8")
    return section


def as_json(cell):
    return {"case": cell.case.name, "title": cell.case.title, "model": cell.model,
            "precision": cell.precision, "verdict": cell.verdict, "worst": rounded(cell.worst.as_json()),
            "seconds": rounded(cell.run.cpu_s), "why": cell.why}


def body(section, pin):
    """The page below its head."""
    cells = section.cells
    parts = ["<h1>What is stable?</h1>", "<p class='lead'>Starts, loads, time steps and meshes on which "
             "cloth solvers fail, each with every bending model in both precisions. Each is compared with "
             "the same scene undisturbed.</p>", overview(cells), rules(), section_html(section, EVERYTHING),
             folded_html(cells)]
    for title, cases in SECTIONS.items():
        parts.append(section_of(title, cases, section))
    parts.append(section_html(pin, EVERYTHING))
    parts.append("<h2>As data</h2><p><a href='summary.json'>summary.json</a>: every run.</p>")
    return "\n".join(parts)


def rules():
    """The rules for verdicts as HTML."""
    return ("<p>A run is <b>red</b> if one of these holds. It ended in a value that is not a number. A "
            f"vertex was ever {APART:g} times as far from the cloth's middle as at the start (at least "
            f"{APART:g} sizes; a size is the diagonal of the rest shape), or at the end more than {FAR:g} "
            f"sizes. Momentum changed where no force acts, by more than {MOMENTUM} times the random walk of "
            "the projections' rounding errors. The total energy rose above its start where nothing drives "
            f"the cloth, by more than {ENERGY:g} of kinetic energy, elastic energy and weight × size. k "
            "states no elastic energy, so energy is checked only for cases that start at rest length or are "
            "elastic, and not for prestressed springs, which push from the start.</p><p>It is <b>amber</b> "
            "if it is stable but has not recovered. Either the mean strain stays above twice the "
            f"undisturbed run's (taken as at least {STRAIN_FLOOR:g} and at most {STRAIN_CEILING:g}). Or, "
            "where the rest shape can be reached, the cloth's distance from it is still more than "
            f"{100 * NEAR:g} % of its size (root mean square, after the best rotation and translation) and "
            f"more than twice the undisturbed run's (taken as at most {100 * NOT_BACK / 2:g} %). Or a cloth "
            f"at rest creeps by more than {CREEP:g} sizes. Mean strain is the median over the last "
            "second.</p>")


def overview(cells):
    """Shares of verdicts per model, of its own runs: some cases are made for some models only."""
    head = "<tr><th class='t'>model</th><th>red</th><th>amber</th><th>green</th><th>runs</th></tr>"
    rows = []
    for model in models():
        numbers = [fig_stability.count(cells, verdict, model) for verdict in VERDICTS]
        if sum(numbers):
            rows.append(f"<tr><td class='t'>{escape(style.model_name(model))}</td>" + "".join(
                f"<td><span class='verdict {KIND[verdict]}'>{100 * number / sum(numbers):.0f} %</span></td>"
                for verdict, number in zip(VERDICTS, numbers)) + f"<td>{sum(numbers)}</td></tr>")
    table = f"<table class='overview'>{head}{''.join(rows)}</table>"
    return f"<div class='scroll'>{table}</div>{plain_grid(cells)}"


def plain_grid(cells):
    """A note on the undisturbed grid, which all flaws and meshes are compared with, if it is amber itself."""
    seen = group([cell for (name, _, _), cell in cells.items() if name == PLAIN], lambda cell: cell.model)
    amber = sum(any(cell.verdict == AMBER for cell in some) for some in seen.values())
    if not amber:
        return ""
    return ("<p>Red means unstable, and compares models. Amber only means not recovered. The undisturbed "
            f"run itself, the plain grid, stretched by half and released, is amber for {amber} of "
            f"{len(seen)} models, in one precision or both. So amber for the flaws and meshes compared with "
            "it shows nothing about them.</p>")


def folded_html(cells):
    """The cases that the picture folds away because all their runs have one colour, by name."""
    alike = fig_stability.folded(cells, CASES)[1]
    if not alike:
        return ""
    rows = "".join(f"<li><span class='verdict {KIND[verdict]}'>all {verdict}</span>: "
                   f"{escape('; '.join(_full_title(case) for case in alike[verdict]))}</li>"
                   for verdict in VERDICTS if verdict in alike)
    return (f"<details><summary>The {sum(map(len, alike.values()))} cases in which all runs have one "
            f"colour</summary><ul>{rows}</ul></details>")


def _full_title(case):
    """A case's section and title: 'start poses: mirrored'."""
    section = next(title for title, cases in SECTIONS.items() if case in cases)
    return f"{section.lower()}: {case.title}"


def section_of(title, cases, section):
    """One group of cases as HTML: their rules, failed runs with reasons, and pictures."""
    cells = section.cells
    here = [case for case in cases if any(key[0] == case.name for key in cells)]
    if not here:
        return ""
    rows = [[case.title, case.config + ".json",
             *(sum(cell.verdict == verdict for key, cell in cells.items() if key[0] == case.name)
               for verdict in (GREEN, AMBER, RED)), case.rule] for case in here]
    parts = [f"<h2>{escape(title)}</h2>",
             table_html(Table("", ["case", "config", "green", "amber", "red", "green if"], rows))]
    failed = [cell for case in here for key, cell in cells.items() if key[0] == case.name
              and cell.verdict != GREEN]
    if failed:
        parts.append(failed_html(failed))
    if title in section.stills:
        parts.append(f"<figure><img src='{section.stills[title]}' alt='The last frames of the runs that "
                     "fail'><figcaption>Last good frame of the worst run of each way in which a case "
                     "turns red, and of the worst amber run of a case without red runs; coloured by "
                     "stretch. Each picture shows the whole cloth; the text below states its extent (one "
                     "size at rest).</figcaption></figure>")
    return "\n".join(parts)


def failed_html(failed):
    """Table of runs that are not green, one row per case, verdict and reason; reasons are below by letter."""
    reasons = list(dict.fromkeys(cell.why or UNKNOWN for cell in failed))
    letter = dict(zip(reasons, string.ascii_lowercase))
    rows = []
    for (title, verdict, why), some in group(failed,
                                             lambda cell: (cell.case.title, cell.verdict,
                                                           cell.why or UNKNOWN)).items():
        numbers = group([cell.worst for cell in some], lambda worst: (worst.name, worst.unit))
        rows.append([title, verdict, models_text(some),
                     "; ".join(range_text(found) for found in numbers.values()),
                     "; ".join(_range([one.limit for one in found]) for found in numbers.values()),
                     letter[why]])
    table = table_html(Table("What is not green",
                             ["case", "verdict", "models", "worst number", "its limit", "why"], rows))
    legend = "".join(f"<li>{escape(why)}</li>" for why in reasons)
    return f"{table}<ol type='a'>{legend}</ol>"


def models_text(cells):
    """Models of some cells as text, with the precision if it is only one."""
    precisions = group(cells, lambda cell: cell.model)
    name = lambda model: style.model_name(model)
    if set(precisions) == set(models()) and all(len(some) == 2 for some in precisions.values()):
        return "all"
    return ", ".join(name(model) + ("" if len(precisions[model]) == 2
                                    else f" ({precisions[model][0].precision})") for model in models()
                     if model in precisions)


def range_text(criteria):
    """Range of criteria with one name, as in 'mean strain 0.2 to 0.9'."""
    unit = "" if criteria[0].unit == "1" else " " + criteria[0].unit
    return f"{criteria[0].name} {_range([one.value for one in criteria])}{unit}"


def _range(values):
    low, high = style.number(min(values)), style.number(max(values))
    return low if low == high else f"{low} to {high}"


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--results", type=Path, default=Path("results"), help="folder with the runs")
    parser.add_argument("--out", type=Path, default=Path("results/stability"), help="folder for the page")
    arguments = parser.parse_args()
    main(arguments.results, arguments.out)
    print(arguments.out / "index.html")
