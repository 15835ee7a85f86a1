"""Writes the page of stiffness: index.html, and summary.json with one object per check."""
import argparse
from pathlib import Path

import fig_stiffness_buckling
import fig_stiffness_calibrated
import fig_stiffness_convergence
import fig_stiffness_effective
import fig_stiffness_hinges
import fig_stiffness_resolution
import fig_stiffness_springs
import fig_stiffness_textile
import style
from html_parts import document, escape, mark, section_html, table_html
from load import group
from report import Table, write_objects

FIGURES = [fig_stiffness_hinges, fig_stiffness_springs, fig_stiffness_convergence, fig_stiffness_effective,
           fig_stiffness_resolution, fig_stiffness_calibrated, fig_stiffness_buckling, fig_stiffness_textile]
EVERYTHING = "./bendlab reproduce stiffness      # everything, and this page"


def main(results, out):
    """Writes the page into `out` from the runs below `results`; returns its sections."""
    out.mkdir(parents=True, exist_ok=True)
    sections = [figure.main(results, out) for figure in FIGURES]
    checks = [check for section in sections for check in section.checks]
    write_objects(out / "summary.json", [check.as_json() for check in checks])
    (out / "index.html").write_text(document("bendlab: how stiff is it really?", body(sections)),
                                    encoding="utf-8")
    return sections


def body(sections):
    """The page below its head."""
    parts = ["<h1>How stiff is it really?</h1>",
             "<p class='lead'>Every bending model is measured on strips with a known theoretical answer, and "
             "with the tests of textile laboratories. Each number has an expected number beside it, with "
             "source and tolerance, both fixed before the measurement.</p>",
             "<p>Models follow one of two laws. Hinges resist in proportion to curvature: m = B κ (B in N m, "
             "the flexural rigidity). Springs between vertices resist small bending hardly at all: m = C κ³ "
             "(C in N m³). m is the moment per width, κ the curvature. H/W is how far the free end of a "
             "clamped strip hangs down over how far it reaches out.</p>", overview(sections)]
    parts += [section_html(section, EVERYTHING, verdicts=[checks_html(section.checks)])
              for section in sections]
    parts.append("<h2>As data</h2><p><a href='summary.json'>summary.json</a>: every check.</p>")
    return "\n".join(parts)


def overview(sections):
    """How many checks hold in each section, as an HTML table."""
    rows = []
    for section in sections:
        known = [check for check in section.checks if check.holds is not None]
        held = sum(check.holds for check in known)
        kind = "open" if not known else "yes" if held == len(known) else "no"
        text = f"{held} of {len(known)} checks hold" if known else "no runs"
        open_checks = len(section.checks) - len(known)
        text += f", {open_checks} without a number" if known and open_checks else ""
        rows.append(f"<tr><td class='t'>{escape(section.title)}</td><td class='t'><span class='verdict "
                    f"{kind}'>{text}</span></td></tr>")
    return f"<div class='scroll'><table class='overview'>{''.join(rows)}</table></div>"


def checks_html(checks):
    """Checks as HTML: those that do not hold are visible, all of them are folded."""
    if not checks:
        return ""
    failed = [check for check in checks if check.holds is False]
    parts = [table_html(_table("What does not hold", failed))] if failed else []
    parts.append(f"<details><summary>All {len(checks)} "
                 f"checks</summary>{table_html(_table('Checks', checks))}</details>")
    return "".join(parts)


def _table(caption, checks):
    noted = any(check.note for check in checks)
    rows = []
    for (check, model), some in group(checks, lambda check: (check.check, check.model)).items():
        for i, one in enumerate(some):
            rows.append([check if i == 0 else "", model if i == 0 else "", one.mesh,
                         style.number(one.expected), style.number(one.measured), one.bound, mark(one)[1],
                         one.source] + ([one.note] if noted else []))
    return Table(caption, ["check", "model", "mesh", "expected", "measured", "tolerance", "verdict",
                           "source"] + (["note"] if noted else []), rows)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--results", type=Path, default=Path("results"), help="folder with the runs")
    parser.add_argument("--out", type=Path, default=Path("results/stiffness"), help="folder for the page")
    arguments = parser.parse_args()
    main(arguments.results, arguments.out)
    print(arguments.out / "index.html")
