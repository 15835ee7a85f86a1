"""Writes the page of the plain matrix: index.html, and summary.json with one object per run."""
import right_python  # noqa: F401  (first: it may hand over to another Python)
import os

# With 3 × 2 matrices OpenBLAS threads wait for each other: 100 times as slow on a busy machine.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import fig_plain
import numpy as np
import plain_cases
import plain_matrix
import project_pages
from bendlab.results import registry
import style
from html_parts import Part, escape, section_part, table_html
from plain_cases import ALARM, ENERGY, FALL, MEAN_STRAIN, NEAR, SILENT, SOUND, SPEED, STRETCH, TOLD, WAY
from project_pages import Content, command_line, keep, kept, made_of, write
from report import Table, known, rounded, write_objects
from verdicts_html import verdict_html

COMMAND = "./bendlab reproduce plain"
EVERYTHING = f"{COMMAND}      # everything, and this page"
VERDICTS = (SILENT, TOLD, ALARM, SOUND)
KIND = {SILENT: "no", TOLD: "open", ALARM: "open", SOUND: "yes"}
STATUS = {SILENT: "fails", TOLD: "amber", ALARM: "amber", SOUND: "holds"}  # class of a run's status
TITLES = {SILENT: "Wrong without a warning, one by one", TOLD: "Wrong with a warning",
          ALARM: "Reported as implausible, but no bound is broken"}
MANY = 20  # rows in a table of pairs
SCENES = ("<p>No scene here is meant to be hard. They combine every mesh, every kind of pins, every model "
          "and every kind of stiffness, mixed so that any three settings occur together in at least one run. "
          "Bounds that any correct cloth keeps judge each run; they do not use the program's verdict.</p>")


def main(results, out):
    """Writes the page into `out` from the runs below `results`; returns its section."""
    section = draw(results, out)
    lay_out(out)
    return section


def draw(results, out):
    """Draws the figures, and keeps what the page is made of."""
    out.mkdir(parents=True, exist_ok=True)
    section = fig_plain.main(results, out)
    section.text = " ".join(filter(None, [coverage_text(section), twins_text(section.twins)]))
    write_objects(out / "summary.json", [rounded(one.as_json()) for one in section.judged])
    keep(out, [section])
    return section


def lay_out(out):
    """Writes index.html of what is kept."""
    (section,), judged = kept(out), project_pages.summary(out)
    for number, one in enumerate(judged):
        one["id"] = f"{one['config']}-{number}"
    covered, section.text = section.text, ""
    matrix = plain_matrix.matrix_html(judged)
    if matrix:  # which says what the picture says, that is for print
        section.pictures = [picture for picture in section.pictures if picture[0] != fig_plain.MODELS_PICTURE]
    parts = [section_part(section, EVERYTHING, [matrix, pairs_html(judged)], link="What fails")]
    for verdict, title in TITLES.items():
        some = [one for one in judged if one["verdict"] == verdict]
        if some:
            parts.append(Part(f"runs-{verdict}", title, failures_html(some), title.split(",")[0]))
    told = f"{SCENES}{rules()}<p>{escape(covered)}</p>"
    parts += [Part("rules", "Which runs, and by which rules", told, "Rules"),
              Part("data", "As data", "<p><a href='summary.json'>summary.json</a>: every run.</p>", "Data")]
    data = {"runs": [about(one) for one in judged if one["verdict"] != SOUND]}
    content = Content("Does any run go wrong without a warning?", answer(judged), overview(judged), parts,
                      data)
    write(out, "plain", content, made_of([section], COMMAND))


def overview(judged):
    if not judged:
        return ""
    rows = "".join(f"<li>{verdict_html(KIND[verdict], str(count(judged, verdict)))} "
                   f"{escape(fig_plain.NAMES[verdict])}</li>" for verdict in VERDICTS)
    return f"<ul class='tally'>{rows}</ul>"


def count(judged, verdict):
    return sum(one["verdict"] == verdict for one in judged)


def answer(judged):
    """The page's answer in one sentence."""
    silent = [one for one in judged if one["verdict"] == SILENT]
    if not judged:
        return "There are no runs yet."
    if not silent:
        return (f"<b>No.</b> Of {len(judged)} runs {count(judged, TOLD)} broke a bound, and every one of "
                "them got a warning.")
    worst = max(silent, key=excess)
    return (f"<b>Yes, {len(silent)} of {len(judged)} runs do.</b> The worst: {escape(bound_text(worst))}, "
            f"with {escape(settings_text(worst))}.")


def excess(one):
    """How far beyond its limit the worst number of a run is."""
    worst = known(one["worst"])
    return worst["value"] / worst["limit"] if np.isfinite(worst["value"]) else np.inf


def about(one):
    """What the page's data say of a run."""
    worst = known(one["worst"])
    finite = np.isfinite(worst["value"])
    return {"id": one["id"], "title": settings_text(one), "status": STATUS[one["verdict"]],
            "told": f"{fig_plain.NAMES[one['verdict']]}{': ' + one['told'] if one['told'] else ''}",
            "worst": {"label": worst["what"], "value": worst["value"] if finite else None,
                      **({} if finite else {"text": "not finite"}), "limit": worst["limit"],
                      "unit": worst["unit"], "held": not one["broken"],
                      "note": f"broken: {', '.join(one['broken'])}" if one["broken"] else ""},
            "command": one["command"]}


def rules():
    return ("<p>A run breaks a bound if one of these holds. A coordinate is not a number. A pinned vertex "
            f"moves. The mean strain exceeds {MEAN_STRAIN:g}, or a triangle is stretched to more than "
            f"{STRETCH:g} times its length: every membrane here is stated not to stretch, and woven cloth "
            "yields by a tenth before it is taut (Provot 1995). A vertex is farther from its pin than "
            f"{1 + WAY:g} times the path along the edges, by more than {NEAR:g} sizes (a size is the "
            f"diagonal of the rest shape). A vertex is faster than {SPEED:g} (v<sub>0</sub> + g t), or "
            f"kinetic energy plus energy of weight rises by more than {ENERGY:g} of their scale; prestressed "
            "springs push from the start, so these two are not checked for them. Without pins, the centre "
            "of mass differs from x<sub>0</sub> + v<sub>0</sub> t + g t (t + h) / 2, the exact motion in "
            "steps of h (by BDF2 g t² / 2 + 3/4 g h² (1 − 3<sup>−t/h</sup>)), by more than "
            f"{FALL:g} of its fall.</p><p>A run has a <b>warning</b> if the "
            "program ends it as implausible or diverged, or warns of something that affects these numbers. A "
            "run is <b>wrong without a warning</b> if it breaks a bound and the program reports nothing.</p>")


def coverage_text(section):
    """The combinations of values in the covering arrays, counted again here."""
    lines = []
    for name, runs, strength, held, wanted, absent in section.covered:
        line = (f"{name}: {runs} runs have {held} of {wanted} combinations of the values of {strength} "
                "settings")
        unknown = [combination for combination in absent if not refused(combination)]
        if len(absent) > len(unknown):
            line += (f"; {len(absent) - len(unknown)} are refused by the program (a tube needs at least "
                     "three cells around; springs have a known rigidity on flat sheets only)")
        if unknown:
            line += f"; {len(unknown)} are missing, first " + ", ".join(f"{pointer} {value}"
                                                                        for pointer, value in unknown[0])
        lines.append(f"{line}.")
    return " ".join(lines)


def refused(combination):
    """Whether the program refuses these values together; rules.cpp has the reasons."""
    values = {pointer: value for pointer, value in combination}
    generator = values.get("/mesh", {}).get("generator")
    return ((generator == "tube" and values.get("/mesh/cells") == 2)
            or (generator in ("tube", "sphere") and values.get("/bending", {}).get("stiffness") == "physical"
                and registry.made_of(values.get("/bending/model")) == "springs"))


def twins_text(twins):
    if not twins.pairs:
        return ""
    text = f"{twins.pairs} scenes were computed in two units of length, 1 : 1024: "
    if not twins.apart:
        return text + "after scaling they are equal to the last bit."
    apart, _, large = max(twins.apart, key=lambda entry: entry[0])
    settings = ", ".join(f"{name} {value}" for name, value in plain_cases.settings_of(large.config).items())
    return (text + f"{len(twins.apart)} of them differ after scaling, by up to {style.number(apart)} sizes "
            f"({settings}).")


def pairs_html(judged):
    """Table of pairs of settings that fail together."""
    rows = [[f"{a[0]}: {a[1]}", f"{b[0]}: {b[1]}", wrong, runs, style.number(expected)]
            for (a, b), wrong, runs, expected in fig_plain.pairs(judged)[:MANY]]
    if not rows:
        return ""
    caption = (f"Pairs of values with which at least {fig_plain.FEWEST} runs broke a bound, and at least "
               f"{fig_plain.TWICE:g} times as many as expected from the worse of the two values")
    return table_html(Table(caption, ["value", "with value", "broke a bound", "of runs",
                                      "expected from the worse value"], rows))


def settings_text(one):
    return ", ".join(f"{name} {value}" for name, value in one["settings"].items())


def bound_text(one):
    worst = known(one["worst"])
    unit = "" if worst["unit"] == "1" else f" {worst['unit']}"
    return (f"{worst['what']} {style.number(worst['value'])}{unit} (at most "
            f"{style.number(worst['limit'])})")


def failures_html(some):
    """A table of runs, those farthest beyond a bound first; each opens."""
    names = list(some[0]["settings"])
    chosen = {"method", "mesh", "pins", "model", "bending", "precision", "start"}
    head = "<th class='t'>worst number, its limit</th>" + "".join(
        f"<th class='t{' choose' if name in chosen else ''}'>{escape(name)}</th>" for name in names)
    rows = "".join(
        f"<tr><td class='t' data-run='{escape(one['id'])}' data-v='{min(excess(one), 1e9):.6g}'><button "
        f"type='button' class='opens'>{escape(bound_text(one))}</button></td>"
        + "".join(f"<td class='t'>{escape(str(one['settings'][name]))}</td>" for name in names) + "</tr>\n"
        for one in sorted(some, key=excess, reverse=True))
    return ("<div class='scroll tall' tabindex='0' role='region' aria-label='Runs'><table class='sortable' "
            f"data-rows='runs'><thead><tr>{head}</tr></thead><tbody>{rows}</tbody></table></div>")


if __name__ == "__main__":
    command_line("plain", __doc__, main, lay_out)
