"""Writes the page of the hard cases: index.html with the matrix, and summary.json with one object per run."""
import right_python  # noqa: F401  (first: it may hand over to another Python)
import string
from collections import Counter

import fig_stability
import fig_stability_pin
import numpy as np
import page_frames
import stability_matrix
import stability_methods
import style
from html_parts import Part, address, escape, folded, number_text, picture_html, section_part, table_html
from bendlab.results.load import group
from project_pages import Content, command_line, keep, kept, made_of, summary, write
from report import Table, known, rounded, write_objects
from stability_cases import (AMBER, APART, CREEP, ENERGY, FAR, GREEN, MOMENTUM, NEAR, NOT_BACK, RED, SECTIONS,
                             STRAIN_CEILING, STRAIN_FLOOR)

COMMAND = "./bendlab reproduce stability"
EVERYTHING = f"{COMMAND}      # everything, and this page"
UNKNOWN = "not known"
PLAIN = "meshes: grid"  # the undisturbed run of all flaws and meshes; also a case
LINKS = {"Start poses": "Starts", "Curved rest shape": "Curved", "Pins and loads": "Pins",
         "Flawed meshes": "Flaws", "Meshes and units": "Meshes", "Moving freely": "Free"}


def main(results, out):
    """Writes the page into `out` from the runs below `results`; returns its section."""
    section = draw(results, out)
    lay_out(out, stills(section.cells))
    return section


def draw(results, out):
    """Draws the figures, and keeps what the page is made of."""
    out.mkdir(parents=True, exist_ok=True)
    section = fig_stability.main(results, out)
    write_objects(out / "summary.json", [as_json(cell) for cell in section.cells.values()])
    keep(out, [section, fig_stability_pin.main(results, out), stability_methods.main(results, out)])
    return section


def as_json(cell):
    seen = lambda name: cell.run.summary.get(f"stability_{name}", np.nan)
    return {"case": cell.case.name, "title": cell.case.title, "model": cell.model,
            "precision": cell.precision, "verdict": cell.verdict, "worst": rounded(cell.worst.as_json()),
            "seconds": rounded(cell.run.cpu_s), "recovered_s": rounded(seen("recovered_at")),
            "energy_rises": rounded(seen("energy_rises")), "why": cell.why}


def stills(cells):
    """The first and the last frame of the worst red run of every case and model."""
    worst = {}
    for cell in cells.values():
        place = cell.case.name, cell.model
        if cell.verdict == RED and cell.run.frames and not worst.get(place, cell).worst.excess > \
                cell.worst.excess:
            worst[place] = cell
    runs = {stability_matrix.id_of(as_json(cell)): cell.run for cell in worst.values()}
    return page_frames.of_runs(runs, 2)


def lay_out(out, shown=None):
    """Writes index.html of what is kept. `shown`: frames; None: those that the page there has."""
    shown = shown or page_frames.taken_from(out / "index.html")
    (section, pin, *others), runs, by_method = kept(out), summary(out), stability_methods.kept_runs(out)
    matrix, alike = stability_matrix.cases_html(runs) if runs else ("", "")
    print_version = "".join(folded("The matrix as a picture, for print", picture_html(*picture))
                            for picture in section.pictures)
    section.pictures, section.title = [], "The cases that tell models apart"
    evidence = section_part(section, EVERYTHING, [
        "<p>A row per case; the cases whose verdicts differ most among models come first. Each cell has two "
        "halves: single precision left, double precision right. A cell opens its run: the worst number with "
        f"its limit, why, config and command. {plain_grid(runs)}</p>", matrix, alike, print_version],
        link="Cases")
    parts = [evidence, *(part for title, cases in SECTIONS.items()
                         if (part := section_of(title, cases, runs, out))),
             *(stability_methods.part(other, by_method, EVERYTHING) for other in others),
             section_part(pin, EVERYTHING, link="One pin"), Part("rules", "The rules", rules(), "Rules"),
             Part("data", "As data", data_html(by_method), "Data")]
    top = stability_matrix.groups_html(runs) if runs else ""
    content = Content("What is stable?", answer(runs), top, parts,
                      stability_matrix.data([*runs, *by_method]), shown)
    write(out, "stability", content, made_of([section, pin, *others], COMMAND))


def data_html(by_method):
    """The links to the page's data."""
    also = f", <a href='{stability_methods.FILE}'>{stability_methods.FILE}</a>: those by other methods"
    return f"<p><a href='summary.json'>summary.json</a>: every run{also if by_method else ''}.</p>"


def answer(runs):
    """The page's answer: which models fail in the fewest hard cases, and which in the most."""
    if not runs:
        return "There are no runs yet."
    models = stability_matrix.models_of(runs)
    share = lambda model: 100 * np.mean([run["verdict"] == RED for run in runs if run["model"] == model])
    shares = {model: share(model) for model in models}
    few = [model for model in models if shares[model] < shares[models[0]] + 0.5]
    many = [model for model in models if shares[model] > shares[models[-1]] - 0.5]
    listed = lambda some: ", ".join(f"<b>{escape(model)}</b>" for model in some)
    counts = Counter(run["verdict"] for run in runs)
    return (f"{listed(few)} fail in the fewest hard cases, {number_text(shares[few[0]], 2)} % of them; "
            f"{listed(many)} in the most, {number_text(shares[many[-1]], 2)} %. Of {len(runs)} runs "
            f"{counts[RED]} fail, {counts[AMBER]} are stable but do not recover, {counts[GREEN]} pass.")


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


def plain_grid(runs):
    """A note on the undisturbed grid, which all flaws and meshes are compared with, if it is amber itself."""
    seen = group([run for run in runs if run["case"] == PLAIN], lambda run: run["model"])
    amber = sum(any(run["verdict"] == AMBER for run in some) for some in seen.values())
    if not amber:
        return ""
    return ("Red means unstable, and compares models. Amber only means not recovered: the undisturbed run "
            f"itself, the plain grid, stretched by half and released, is amber for {amber} of {len(seen)} "
            "models, in one precision or both. So amber for the flaws and meshes compared with it shows "
            "nothing about them.")


def section_of(title, cases, runs, out):
    """One group of cases: their rules, runs that are not green with reasons, and pictures. None without
    runs."""
    here = {case.name: case for case in cases if any(run["case"] == case.name for run in runs)}
    if not here:
        return None
    own = [run for run in runs if run["case"] in here]
    of = lambda case, verdict: sum(run["case"] == case.name and run["verdict"] == verdict for run in own)
    rows = [[case.title, case.config + ".json", *(of(case, verdict) for verdict in (GREEN, AMBER, RED)),
             case.rule] for case in here.values()]
    parts = []
    picture = f"fig_stability_{address(title).replace('-', '_')}.png"
    if (out / picture).exists():
        parts.append(picture_html(picture, "Last good frame of the worst run of each way in which a case "
                                  "turns red, and of the worst amber run of a case without red runs; "
                                  "coloured by stretch. Each picture shows the whole cloth; the text below "
                                  "states its extent (one size at rest)."))
    failed = [run for run in own if run["verdict"] != GREEN]
    if failed:
        parts.append(failed_html(failed, len(stability_matrix.models_of(runs))))
    rules_table = table_html(Table("", ["case", "config", "green", "amber", "red", "green if"], rows))
    parts.append(folded(f"The {len(here)} cases and their rules", rules_table))
    return Part(address(title), title, "\n".join(parts), LINKS.get(title, title))


def failed_html(failed, models):
    """Table of runs that are not green, one row per case, verdict and reason; reasons are below by letter.
    `models`: how many the page has."""
    reasons = list(dict.fromkeys(run["why"] or UNKNOWN for run in failed))
    letter = dict(zip(reasons, string.ascii_lowercase))
    rows = []
    for (title, verdict, why), some in group(failed, lambda run: (run["title"], run["verdict"],
                                                                  run["why"] or UNKNOWN)).items():
        numbers = group([known(run["worst"]) for run in some], lambda worst: (worst["what"], worst["unit"]))
        rows.append([title, verdict, models_text(some, models),
                     "; ".join(range_text(found) for found in numbers.values()),
                     "; ".join(_range([one["limit"] for one in found]) for found in numbers.values()),
                     letter[why]])
    table = table_html(Table("What is not green",
                             ["case", "verdict", "models", "worst number", "its limit", "why"], rows))
    legend = "".join(f"<li>{escape(why)}</li>" for why in reasons)
    return f"{table}<ol type='a'>{legend}</ol>"


def models_text(runs, models):
    """Models of some runs as text, with the precision if it is only one; `models`: how many there are."""
    precisions = group(runs, lambda run: run["model"])
    if len(precisions) == models and all(len(some) == 2 for some in precisions.values()):
        return "all"
    return ", ".join(model + ("" if len(some) == 2 else f" ({some[0]['precision']})")
                     for model, some in precisions.items())


def range_text(worst):
    """Range of numbers with one name, as in 'mean strain 0.2 to 0.9'."""
    unit = "" if worst[0]["unit"] == "1" else " " + worst[0]["unit"]
    return f"{worst[0]['what']} {_range([one['value'] for one in worst])}{unit}"


def _range(values):
    low, high = style.number(min(values)), style.number(max(values))
    return low if low == high else f"{low} to {high}"


if __name__ == "__main__":
    command_line("stability", __doc__, main, lay_out)
