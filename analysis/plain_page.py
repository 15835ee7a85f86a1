"""Writes the page of the plain matrix: index.html, and summary.json with one object per run."""
import argparse
import os
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # its threads wait for each other's 3 × 2 matrices: 100 times as long on a busy machine

import fig_plain
import plain_cases
import style
from html_parts import document, escape, section_html, table_html
from load import group
from plain_cases import ALARM, AXES, ENERGY, FALL, MEAN_STRAIN, NEAR, SILENT, SOUND, SPEED, STRETCH, TOLD, WAY
from report import Table, rounded, write_objects

EVERYTHING = "./bendlab reproduce plain      # everything, and this page"
VERDICTS = (SILENT, TOLD, ALARM, SOUND)
KIND = {SILENT: "no", TOLD: "open", ALARM: "open", SOUND: "yes"}
MANY = 20  # rows of a table that a reader looks through


def main(results, out):
    """Everything the page needs, from runs below `results` into `out`; returns the section."""
    out.mkdir(parents=True, exist_ok=True)
    section = fig_plain.main(results, out)
    write_objects(out / "summary.json", [rounded(one.as_json()) for one in section.judged])
    (out / "index.html").write_text(document("bendlab: is anything wrong in silence?", body(section)), encoding="utf-8")
    return section


def body(section):
    """The page below its head."""
    judged = section.judged
    parts = ["<h1>Is anything wrong in silence?</h1>",
             "<p class='lead'>Scenes of which none is meant to be hard: every mesh, every kind of pins, every model and every way to state its "
             "stiffness, mixed so that any three settings meet in at least one run. Each run is judged by bounds that any correct cloth "
             "keeps, beside the program and not by it.</p>", overview(judged), answer(judged), rules(), coverage_html(section), twins_html(section.twins),
             section_html(section, EVERYTHING), pairs_html(judged)]
    for verdict, title in ((SILENT, "Wrong in silence, one by one"), (TOLD, "Wrong and told"), (ALARM, "Told implausible, and no bound is broken")):
        some = [one for one in judged if one.verdict == verdict]
        if some:
            parts.append(failures_html(title, some))
    parts.append("<h2>As data</h2><p><a href='summary.json'>summary.json</a>: every run.</p>")
    return "\n".join(parts)


def overview(judged):
    if not judged:
        return ""
    rows = "".join(f"<tr><td class='t'>{escape(fig_plain.NAMES[verdict])}</td><td><span class='verdict {KIND[verdict]}'>"
                   f"{fig_plain.count(judged, verdict)}</span></td></tr>" for verdict in VERDICTS)
    return f"<div class='scroll'><table class='overview'><tr><th class='t'>runs that are</th><th>of {len(judged)}</th></tr>{rows}</table></div>"


def answer(judged):
    """One sentence for a reader in a hurry."""
    silent = [one for one in judged if one.verdict == SILENT]
    if not judged:
        return ""
    if not silent:
        return "<p><b>No.</b> No run broke a bound without being told so.</p>"
    worst = max(silent, key=lambda one: one.worst.excess)
    return (f"<p><b>Yes, {len(silent)} of {len(judged)} runs are.</b> The worst: {escape(bound_text(worst.worst))} (at most "
            f"{escape(style.number(worst.worst.limit))}), with {escape(settings_text(worst))}.</p>")


def rules():
    return (f"<p>A run breaks a bound if a coordinate is no number; if a pinned vertex moves; if the mean strain passes {MEAN_STRAIN:g} or a triangle is "
            f"stretched to more than {STRETCH:g} times its length (every membrane here is stated to be without stretch, and woven cloth gives way by a tenth "
            f"before it is taut: Provot 1995); if a vertex is farther from its pin than the way along the edges and a tenth of it, by more than {NEAR:g} "
            f"sizes (a size is the diagonal of the rest shape); if a vertex is faster than {SPEED:g} (v<sub>0</sub> + g t) or kinetic energy and that of weight rise "
            f"by more than {ENERGY:g} of their scale (neither is looked at for prestressed springs, which push from the start); or, without pins, if the centre of "
            f"mass leaves x<sub>0</sub> + v<sub>0</sub> t + g t (t + h) / 2, which steps of h give exactly, by more than {FALL:g} of its fall.</p>"
            "<p>It is <b>told</b> if the program ends it as implausible or diverged, or warns of what spoils these numbers. A run is <b>wrong in "
            "silence</b> if it breaks a bound and nothing was said.</p>")


def coverage_html(section):
    """What the covering arrays hold, counted here once more."""
    lines = []
    for name, runs, strength, held, wanted, absent in section.covered:
        line = f"{name}: {runs} runs hold {held} of {wanted} combinations of the values of {strength} settings"
        unknown = [combination for combination in absent if not refused(combination)]
        if len(absent) > len(unknown):
            line += f"; {len(absent) - len(unknown)} are refused by the program (a tube has at least three cells around, and the rigidity of springs is known on flat sheets only)"
        if unknown:
            line += f"; {len(unknown)} are missing, first " + ", ".join(f"{pointer} {value}" for pointer, value in unknown[0])
        lines.append(escape(line) + ".")
    return "<p>" + "<br>".join(lines) + "</p>" if lines else ""


def refused(combination):
    """Whether the program refuses these values together: rules.cpp says why."""
    values = {pointer: value for pointer, value in combination}
    generator = values.get("/mesh", {}).get("generator")
    springs = ("crossover", "k_ring", "adaptive", "lod", "sparse_lod", "prestressed")
    return ((generator == "tube" and values.get("/mesh/cells") == 2)
            or (generator in ("tube", "sphere") and values.get("/bending", {}).get("stiffness") == "physical" and values.get("/bending/model") in springs))


def twins_html(twins):
    if not twins.pairs:
        return ""
    text = f"<p>{twins.pairs} scenes are there in two units, lengths 1 : 1024: "
    if not twins.apart:
        return text + "after scaling not a bit differs.</p>"
    apart, _, large = max(twins.apart, key=lambda entry: entry[0])
    return text + (f"{len(twins.apart)} of them differ once scaled, by up to {style.number(apart)} sizes ({escape(settings_text(plain_cases.Judged('', large, plain_cases.settings_of(large.config), [], '', '')))}).</p>")


def pairs_html(judged):
    """Which settings fail together."""
    rows = [[f"{a[0]}: {a[1]}", f"{b[0]}: {b[1]}", wrong, runs, style.number(expected)] for (a, b), wrong, runs, expected in fig_plain.pairs(judged)[:MANY]]
    if not rows:
        return ""
    caption = f"Pairs of values with which at least {fig_plain.FEWEST} runs broke a bound, {fig_plain.TWICE:g} times as many as the worse of the two values has on average"
    return table_html(Table(caption, ["value", "with value", "broke a bound", "of runs", "expected of the worse value"], rows))


def settings_text(one):
    return ", ".join(f"{name} {value}" for name, value in one.settings.items())


def bound_text(bound):
    return f"{bound.name} {style.number(bound.value)}" + ("" if bound.unit == "1" else f" {bound.unit}")


def failures_html(title, some):
    """Runs that broke the same bound together, the worst first, and the command of each."""
    parts = [f"<h2>{escape(title)}</h2>"]
    for name, runs in sorted(group(some, lambda one: one.worst.name).items(), key=lambda entry: -len(entry[1])):
        runs = sorted(runs, key=lambda one: -one.worst.excess)
        rows = [[one.settings["mesh"], one.settings["cells"], one.settings["height / width"], f"{one.settings['pins']}, {one.settings['rings pinned']}",
                 one.settings["model"], one.settings["bending"], f"{one.settings['strain form']}, {one.settings['strain stiffness']}", one.settings["start"],
                 f"{one.settings['substeps × iterations']}, {one.settings['order']}, {one.settings['sweep']}, {one.settings['precision']}, {one.settings['units']}",
                 style.number(one.worst.value), one.told or "nothing"] for one in runs]
        columns = ["mesh", "cells", "h / w", "pins, rings", "model", "bending", "strain", "start", "solver, units", name, "told"]
        parts.append(table_html(Table(f"{len(runs)} runs: {name}, at most {style.number(runs[0].worst.limit)}", columns, rows[:MANY])))
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
