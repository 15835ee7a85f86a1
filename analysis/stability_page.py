"""Writes the page of the hard cases: index.html with the matrix, and summary.json with one object per run."""
import argparse
import string
from pathlib import Path

import fig_stability
import fig_stability_pin
import style
from html_parts import document, escape, section_html, table_html
from load import MODELS, group
from report import Table, rounded, write_objects
from stability_cases import AMBER, APART, CREEP, ENERGY, FAR, GREEN, MOMENTUM, NEAR, NOT_BACK, RED, SECTIONS, STRAIN_CEILING, STRAIN_FLOOR

EVERYTHING = "./bendlab reproduce stability      # everything, and this page"
UNKNOWN = "not known"
VERDICTS = (RED, AMBER, GREEN)
PLAIN = "meshes: grid"  # the undisturbed run of all flaws and meshes, a case itself
KIND = {GREEN: "yes", AMBER: "open", RED: "no"}


def main(results, out):
    """Everything the page needs, from runs below `results` into `out`; returns the section."""
    out.mkdir(parents=True, exist_ok=True)
    section = fig_stability.main(results, out)
    write_objects(out / "summary.json", [as_json(cell) for cell in section.cells.values()])
    pin = fig_stability_pin.main(results, out)
    (out / "index.html").write_text(document("bendlab: what is stable?", body(section, pin)), encoding="utf-8")
    return section


def as_json(cell):
    return {"case": cell.case.name, "title": cell.case.title, "model": cell.model, "precision": cell.precision,
            "verdict": cell.verdict, "worst": rounded(cell.worst.as_json()), "seconds": rounded(cell.run.cpu_s), "why": cell.why}


def body(section, pin):
    """The page below its head."""
    cells = section.cells
    parts = ["<h1>What is stable?</h1>",
             "<p class='lead'>Starts, loads, time steps and meshes on which cloth solvers fail, each with every bending model in both "
             "precisions, and beside each the same scene undisturbed.</p>", overview(cells), rules(),
             section_html(section, EVERYTHING)]
    for title, cases in SECTIONS.items():
        parts.append(section_of(title, cases, section))
    parts.append(section_html(pin, EVERYTHING))
    parts.append("<h2>As data</h2><p><a href='summary.json'>summary.json</a>: every run.</p>")
    return "\n".join(parts)


def rules():
    """By what a run is judged, for a reader."""
    return (f"<p>A run is <b>red</b> if it ended in a number that is none, if a vertex was ever {APART:g} times as far from the cloth's middle as at "
            f"the start (at least {APART:g} sizes; a size is the diagonal of the rest shape) or at the end more than {FAR:g} sizes, "
            f"if momentum changed where nothing acts (by more than {MOMENTUM} times the random walk of "
            f"the projections' rounding errors), or if the total energy rose above its start where nothing drives (by more than "
            f"{ENERGY:g} of kinetic energy, elastic energy and weight × size; k has no elastic energy, so only cases that start at rest "
            f"length or are elastic are looked at, and not the prestressed springs, which push from the start).</p><p>It is <b>amber</b> if it is stable but has not come back: the mean strain stays "
            f"above twice the undisturbed run's (taken as at least {STRAIN_FLOOR:g} and at most {STRAIN_CEILING:g}), or, where the rest shape can "
            f"be reached, the cloth is still more than {100 * NEAR:g} % of its size away from it (root mean square, after the rotation and "
            f"translation that bring them nearest), or more than twice as far as the undisturbed run (taken as at most "
            f"{100 * NOT_BACK / 2:g} %), or a cloth at rest creeps by more than {CREEP:g} sizes. Mean strain is the median of the "
            f"last second.</p>")


def overview(cells):
    """Verdicts per model, as shares of its own runs; some cases are made for some models only."""
    head = "<tr><th class='t'>model</th><th>red</th><th>amber</th><th>green</th><th>runs</th></tr>"
    rows = []
    for model in MODELS:
        numbers = [fig_stability.count(cells, verdict, model) for verdict in VERDICTS]
        if sum(numbers):
            rows.append(f"<tr><td class='t'>{escape(style.MODEL_NAMES.get(model, model))}</td>" + "".join(
                f"<td><span class='verdict {KIND[verdict]}'>{100 * number / sum(numbers):.0f} %</span></td>"
                for verdict, number in zip(VERDICTS, numbers)) + f"<td>{sum(numbers)}</td></tr>")
    return f"<div class='scroll'><table class='overview'>{head}{''.join(rows)}</table></div>{plain_grid(cells)}"


def plain_grid(cells):
    """What the undisturbed grid says of the amber of all cases that are compared with it."""
    seen = group([cell for (name, _, _), cell in cells.items() if name == PLAIN], lambda cell: cell.model)
    amber = sum(any(cell.verdict == AMBER for cell in some) for some in seen.values())
    if not amber:
        return ""
    return (f"<p>Red is instability, and compares models; amber is only not to have come back. The control itself, the plain grid, stretched by half and let "
            f"go, is amber in {amber} of {len(seen)} models, in one precision or both: amber of the flaws and meshes beside it says nothing about them.</p>")


def section_of(title, cases, section):
    """One group of cases: their rules, what fails and why, and stills of it."""
    cells = section.cells
    here = [case for case in cases if any(key[0] == case.name for key in cells)]
    if not here:
        return ""
    rows = [[case.title, case.config + ".json", *(sum(cell.verdict == verdict for key, cell in cells.items() if key[0] == case.name)
                                                  for verdict in (GREEN, AMBER, RED)), case.rule] for case in here]
    parts = [f"<h2>{escape(title)}</h2>", table_html(Table("", ["case", "config", "green", "amber", "red", "green if"], rows))]
    failed = [cell for case in here for key, cell in cells.items() if key[0] == case.name and cell.verdict != GREEN]
    if failed:
        parts.append(failed_html(failed))
    if title in section.stills:
        parts.append(f"<figure><img src='{section.stills[title]}' alt='The last frames of the runs that fail'><figcaption>The last "
                     "good frames of the red runs, and of the amber run farthest from its limit in a case that has no red one; coloured by stretch. "
                     "Each is framed whole; how far it reaches across stands below it (at rest a sheet is one size across).</figcaption></figure>")
    return "\n".join(parts)


def failed_html(failed):
    """What is not green: models that share case, verdict and reason in one row, and the reasons below by letter."""
    reasons = list(dict.fromkeys(cell.why or UNKNOWN for cell in failed))
    letter = dict(zip(reasons, string.ascii_lowercase))
    rows = []
    for (title, verdict, why), some in group(failed, lambda cell: (cell.case.title, cell.verdict, cell.why or UNKNOWN)).items():
        numbers = group([cell.worst for cell in some], lambda worst: (worst.name, worst.unit))
        rows.append([title, verdict, models_text(some), "; ".join(range_text(found) for found in numbers.values()),
                     "; ".join(_range([one.limit for one in found]) for found in numbers.values()), letter[why]])
    table = table_html(Table("What is not green", ["case", "verdict", "models", "worst number", "its limit", "why"], rows))
    legend = "".join(f"<li>{escape(why)}</li>" for why in reasons)
    return f"{table}<ol type='a'>{legend}</ol>"


def models_text(cells):
    """The models of some cells in the order of the registry, with the precision where it is one of the two."""
    precisions = group(cells, lambda cell: cell.model)
    name = lambda model: style.MODEL_NAMES.get(model, model)
    if set(precisions) == set(MODELS) and all(len(some) == 2 for some in precisions.values()):
        return "all"
    return ", ".join(name(model) + ("" if len(precisions[model]) == 2 else f" ({precisions[model][0].precision})")
                     for model in MODELS if model in precisions)


def range_text(criteria):
    """'mean strain 0.2 to 0.9', of criteria of one name."""
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
