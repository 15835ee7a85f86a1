"""Writes the page of the plain matrix: index.html, and summary.json with one object per run."""
import argparse
import os
from pathlib import Path

# With 3 × 2 matrices OpenBLAS threads wait for each other: 100 times as slow on a busy machine.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import fig_plain
import plain_cases
import style
from html_parts import document, escape, section_html, table_html
from load import group
from plain_cases import ALARM, ENERGY, FALL, MEAN_STRAIN, NEAR, SILENT, SOUND, SPEED, STRETCH, TOLD, WAY
from report import Table, rounded, write_objects

EVERYTHING = "./bendlab reproduce plain      # everything, and this page"
VERDICTS = (SILENT, TOLD, ALARM, SOUND)
KIND = {SILENT: "no", TOLD: "open", ALARM: "open", SOUND: "yes"}
MANY = 20  # rows in a table; the rest is counted only


def main(results, out):
    """Writes the page into `out` from the runs below `results`; returns its section."""
    out.mkdir(parents=True, exist_ok=True)
    section = fig_plain.main(results, out)
    write_objects(out / "summary.json", [rounded(one.as_json()) for one in section.judged])
    (out / "index.html").write_text(document("bendlab: does any run go wrong without a warning?",
                                             body(section)), encoding="utf-8")
    return section


def body(section):
    """The page below its head."""
    judged = section.judged
    parts = ["<h1>Does any run go wrong without a warning?</h1>", "<p class='lead'>No scene here is meant to "
             "be hard. They combine every mesh, every kind of pins, every model and every kind of stiffness, "
             "mixed so that any three settings occur together in at least one run. Bounds that any correct "
             "cloth keeps judge each run; they do not use the program's verdict.</p>", overview(judged),
             answer(judged), rules(), coverage_html(section), twins_html(section.twins),
             section_html(section, EVERYTHING), pairs_html(judged)]
    for verdict, title in ((SILENT, "Wrong without a warning, one by one"), (TOLD, "Wrong with a warning"),
                           (ALARM, "Reported as implausible, but no bound is broken")):
        some = [one for one in judged if one.verdict == verdict]
        if some:
            parts.append(failures_html(title, some))
    parts.append("<h2>As data</h2><p><a href='summary.json'>summary.json</a>: every run.</p>")
    return "\n".join(parts)


def overview(judged):
    if not judged:
        return ""
    rows = "".join(f"<tr><td class='t'>{escape(fig_plain.NAMES[verdict])}</td><td><span class='verdict "
                   f"{KIND[verdict]}'>{fig_plain.count(judged, verdict)}</span></td></tr>"
                   for verdict in VERDICTS)
    head = f"<tr><th class='t'>runs that are</th><th>of {len(judged)}</th></tr>"
    return f"<div class='scroll'><table class='overview'>{head}{rows}</table></div>"


def answer(judged):
    """The page's answer in one sentence."""
    silent = [one for one in judged if one.verdict == SILENT]
    if not judged:
        return ""
    if not silent:
        return "<p><b>No.</b> Every run that broke a bound got a warning.</p>"
    worst = max(silent, key=lambda one: one.worst.excess)
    return (f"<p><b>Yes, {len(silent)} of {len(judged)} runs do.</b> The worst: "
            f"{escape(bound_text(worst.worst))} (at most {escape(style.number(worst.worst.limit))}), with "
            f"{escape(settings_text(worst))}.</p>")


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
            f"steps of h, by more than {FALL:g} of its fall.</p><p>A run has a <b>warning</b> if the "
            "program ends it as implausible or diverged, or warns of something that affects these numbers. A "
            "run is <b>wrong without a warning</b> if it breaks a bound and the program reports nothing.</p>")


def coverage_html(section):
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
        lines.append(escape(line) + ".")
    return "<p>" + "<br>".join(lines) + "</p>" if lines else ""


def refused(combination):
    """Whether the program refuses these values together; rules.cpp has the reasons."""
    values = {pointer: value for pointer, value in combination}
    generator = values.get("/mesh", {}).get("generator")
    springs = ("crossover", "k_ring", "adaptive", "lod", "sparse_lod", "prestressed")
    return ((generator == "tube" and values.get("/mesh/cells") == 2)
            or (generator in ("tube", "sphere") and values.get("/bending", {}).get("stiffness") == "physical"
                and values.get("/bending/model") in springs))


def twins_html(twins):
    if not twins.pairs:
        return ""
    text = f"<p>{twins.pairs} scenes were computed in two units of length, 1 : 1024: "
    if not twins.apart:
        return text + "after scaling they are equal to the last bit.</p>"
    apart, _, large = max(twins.apart, key=lambda entry: entry[0])
    settings = ", ".join(f"{name} {value}" for name, value in plain_cases.settings_of(large.config).items())
    return (text + f"{len(twins.apart)} of them differ after scaling, by up to {style.number(apart)} sizes "
            f"({escape(settings)}).</p>")


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
    return ", ".join(f"{name} {value}" for name, value in one.settings.items())


def bound_text(bound):
    return f"{bound.name} {style.number(bound.value)}" + ("" if bound.unit == "1" else f" {bound.unit}")


def failures_html(title, some):
    """Tables of runs, one for each worst bound, worst first, and the command of each run."""
    parts = [f"<h2>{escape(title)}</h2>"]
    for name, runs in sorted(group(some, lambda one: one.worst.name).items(),
                             key=lambda entry: -len(entry[1])):
        runs = sorted(runs, key=lambda one: -one.worst.excess)
        rows = [[one.settings["mesh"], one.settings["cells"], one.settings["height / width"],
                 f"{one.settings['pins']}, {one.settings['rings pinned']}", one.settings["model"],
                 one.settings["bending"],
                 f"{one.settings['strain form']}, {one.settings['strain stiffness']}", one.settings["start"],
                 f"{one.settings['substeps × iterations']}, {one.settings['order']}, "
                 f"{one.settings['sweep']}, {one.settings['precision']}, {one.settings['units']}",
                 style.number(one.worst.value), one.told or "none"] for one in runs]
        columns = ["mesh", "cells", "h / w", "pins, rings", "model", "bending", "strain", "start",
                   "solver, units", name, "warning"]
        parts.append(
            table_html(Table(f"{len(runs)} runs: {name}, at most {style.number(runs[0].worst.limit)}",
                             columns, rows[:MANY])))
        if len(rows) > MANY:
            parts.append(f"<p>and {len(rows) - MANY} more, in summary.json</p>")
        commands = "\n".join(escape(one.command) for one in runs[:MANY])
        parts.append(f"<details><summary>Repeat them</summary><pre>{commands}</pre></details>")
    return "\n".join(parts)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--results", type=Path, default=Path("results"), help="folder with the runs")
    parser.add_argument("--out", type=Path, default=Path("results/plain"), help="folder for the page")
    arguments = parser.parse_args()
    main(arguments.results, arguments.out)
    print(arguments.out / "index.html")
