"""Draws every figure and writes the page: index.html, summary.json (the claims) and reference.csv (medians of every group)."""
import argparse
import csv
import html
import json
from pathlib import Path

import numpy as np

import fig_1
import fig_5
import fig_6
import fig_7
import fig_ablations
import fig_models
import fig_scenes
import fig_structure
import style
from load import CONFIGS, at, group, load_experiment, statuses, summary_spread
from report import rounded

FIGURES = [fig_1, fig_structure, fig_5, fig_6, fig_7, fig_ablations, fig_models, fig_scenes]
COUNTS = ["springs", "springs_beyond_ring_1"]  # the same for every seed
REFERENCE = {"pin_max_stretch": 1, "pin_region_stretch": 1, "max_stretch": 1,
             "mean_strain": 0, "drop": 0}  # summary entry → what is taken off it

PAGE = """<!doctype html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<title>bendlab: the paper, repeated</title>
<style>
  :root { --ink: #22262b; --grey: #6d747c; --line: #e2e6ea; --yes: #00694c; --no: #a8321a; --open: #7a6000; }
  * { box-sizing: border-box }
  body { margin: 0; color: var(--ink); background: #fff; font: 16px/1.55 system-ui, "Segoe UI", "DejaVu Sans", sans-serif }
  main { max-width: 60rem; margin: 0 auto; padding: 3rem 1.25rem 5rem }
  h1 { font-size: 2rem; line-height: 1.2; margin: 0 0 .4rem; letter-spacing: -.01em }
  h2 { font-size: 1.35rem; margin: 3.6rem 0 .6rem; padding-top: 1.1rem; border-top: 1px solid var(--line) }
  h2 span { color: var(--grey); font-weight: 500; margin-right: .5rem }
  p { margin: .5rem 0 1rem; max-width: 46rem } .lead { color: var(--grey); font-size: 1.08rem }
  figure { margin: 1.4rem 0 } img { max-width: 100%; height: auto; display: block }
  figcaption { color: var(--grey); font-size: .88rem; margin-top: .35rem; max-width: 46rem }
  .scroll { overflow-x: auto; margin: 1rem 0 }
  table { border-collapse: collapse; font-size: .84rem; line-height: 1.35; font-variant-numeric: tabular-nums }
  caption { caption-side: top; text-align: left; color: var(--grey); padding: .3rem 0 .5rem }
  th, td { text-align: right; padding: .28rem .75rem .28rem 0; border-bottom: 1px solid var(--line); vertical-align: top }
  th { font-weight: 600; border-bottom: 1.5px solid var(--ink); vertical-align: bottom }
  th.t, td.t { text-align: left }
  .overview td { font-size: .95rem; padding: .45rem .9rem .45rem 0 } .overview td:first-child { white-space: nowrap }
  .claim { border-left: 4px solid var(--line); padding: .1rem 0 .1rem 1rem; margin: 1.3rem 0 }
  .claim.yes { border-color: var(--yes) } .claim.no { border-color: var(--no) } .claim.open { border-color: var(--open) }
  .claim p { margin: .25rem 0 } .claim .rule { color: var(--grey); font-size: .9rem } .claim table { margin: .5rem 0 .2rem }
  .verdict { font-weight: 650; white-space: nowrap } .yes .verdict, .verdict.yes { color: var(--yes) }
  .no .verdict, .verdict.no { color: var(--no) } .open .verdict, .verdict.open { color: var(--open) }
  code, pre { font: .86rem/1.5 ui-monospace, "DejaVu Sans Mono", monospace; background: #f5f6f8; border-radius: 4px }
  code { padding: .1rem .3rem } pre { padding: .7rem .9rem; overflow-x: auto }
  details { margin: 1rem 0 } summary { cursor: pointer; color: var(--grey); font-size: .92rem }
  .missing { background: #fff7e0; border-left: 4px solid #d9a400; padding: .5rem .9rem; font-size: .92rem }
</style></head><body><main>
"""


def main(results, out):
    """Everything the page needs, from runs below `results` into `out`; returns the sections."""
    out.mkdir(parents=True, exist_ok=True)
    sections = [figure.main(results, out) for figure in FIGURES]
    claims = [claim for section in sections for claim in section.claims]
    text = json.dumps([claim.as_json() for claim in claims], indent=2, ensure_ascii=False)
    (out / "summary.json").write_text(text + "\n", encoding="utf-8")
    write_reference(results, out / "reference.csv")
    (out / "index.html").write_text(PAGE + body(sections, claims), encoding="utf-8")
    return sections


def body(sections, claims):
    """The page below its head."""
    parts = ["<h1>The paper, repeated</h1>",
             "<p class='lead'>Jong-Hyun Kim, <em>Bending Spring Model for Stable Strain-Based Dynamics in Triangular Meshes</em>: "
             "each figure run again, each claim beside its number. Numbers are medians over the last simulated second and over "
             "seeds, because the sheets are chaotic; a verdict follows from them by the rule printed with it.</p>",
             "<p>The scene of every figure unless it says otherwise: a sheet of 1 m × 1 m in N × N cells, pinned at its upper "
             "right corner, starts horizontal and falls for 4 s. Stretch σ₁ is the largest principal stretch of a triangle: "
             "σ₁ − 1 is 0 where it is unstretched and 1 where it is twice as long.</p>", overview(claims)]
    parts += [section_html(section) for section in sections]
    parts.append("<h2>As data</h2><p><a href='summary.json'>summary.json</a>: the claims. "
                 "<a href='reference.csv'>reference.csv</a>: medians and ranges of every group of runs.</p>")
    return "\n".join(parts) + "\n</main></body></html>\n"


def overview(claims):
    rows = "".join(f"<tr><td class='t'>Fig. {escape(claim.figure)}</td><td class='t'>{escape(claim.claim)}</td>"
                   f"<td class='t'><span class='verdict {mark(claim)[0]}'>{mark(claim)[1]}</span></td></tr>" for claim in claims)
    return f"<div class='scroll'><table class='overview'>{rows}</table></div>"


def mark(claim):
    if claim.holds is None:
        return "open", "no runs"
    return ("yes", "holds") if claim.holds else ("no", "does not hold")


def section_html(section):
    label = f"<span>Fig. {escape(section.figure)}</span> " if section.claims else ""
    parts = [f"<h2>{label}{escape(section.title)}</h2>"]
    if section.text:
        parts.append(f"<p>{escape(section.text)}</p>")
    if section.missing:
        missing = "<br>".join(escape(line) for line in section.missing)
        parts.append(f"<div class='missing'>Runs that are missing:<br>{missing}</div>")
    parts += [claim_html(claim) for claim in section.claims]
    parts += [f"<figure><img src='{name}' alt='{escape(caption)}'><figcaption>{escape(caption)}</figcaption></figure>"
              for name, caption in section.pictures]
    tables = "".join(table_html(table) for table in section.tables if table.rows)
    if tables:
        parts.append(f"<details><summary>All numbers</summary>{tables}</details>")
    repeat = "\n".join(section.commands + ["./bendlab reproduce      # everything, and this page"])
    parts.append(f"<details><summary>Repeat it</summary><pre>{escape(repeat)}</pre></details>")
    return "\n".join(parts)


def claim_html(claim):
    kind, verdict = mark(claim)
    numbers = "".join(f"<tr><td class='t'>{escape(name)}</td><td>{shown(value)}</td></tr>" for name, value in claim.numbers.items())
    note = f"<p>{escape(claim.note)}</p>" if claim.note else ""
    return (f"<div class='claim {kind}'><p>“{escape(claim.claim)}” <span class='verdict'>{verdict}</span></p><table>{numbers}</table>"
            f"<p class='rule'>Holds if {escape(claim.rule)}.</p>{note}</div>")


def shown(value):
    if isinstance(value, (list, tuple)):
        return ", ".join(shown(entry) for entry in value)
    if isinstance(value, str):
        return escape(value)
    return str(value) if isinstance(value, int) else style.number(value)


def table_html(table):
    """A table whose text columns are left-aligned."""
    is_text = [any(isinstance(row[i], str) and not row[i][:1].isdigit() and row[i] not in ("–", "∞") for row in table.rows)
               for i in range(len(table.columns))]
    cell = lambda tag, i, value: f"<{tag}{' class=t' if is_text[i] else ''}>{escape(str(value))}</{tag}>"
    head = "".join(cell("th", i, name) for i, name in enumerate(table.columns))
    rows = "".join("<tr>" + "".join(cell("td", i, value) for i, value in enumerate(row)) + "</tr>" for row in table.rows)
    return f"<div class='scroll'><table><caption>{escape(table.caption)}</caption><tr>{head}</tr>{rows}</table></div>"


def escape(text):
    return html.escape(str(text), quote=True)


def write_reference(results, path):
    """One row per experiment and point of its sweep without the seed: medians and ranges over seeds."""
    columns = ["experiment", "cells", "model", "pin_ring", "setting", "seeds", "status", *COUNTS]
    columns += [f"{name}{'_minus_1' if offset else ''}{part}" for name, offset in REFERENCE.items() for part in ("", "_low", "_high")]
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        for config in sorted(CONFIGS.glob("paper/*.json")) + sorted(CONFIGS.glob("ablations/*.json")):
            experiment = load_experiment(results, f"{config.parent.name}/{config.stem}")
            for setting, runs in sorted(group(experiment.runs, lambda run: _setting(run, experiment.sweep)).items()):
                status = " ".join(f"{count} {name}" for name, count in sorted(statuses(runs).items()))
                row = [f"{config.parent.name}/{config.stem}", *setting, len(runs), status]
                row += [f"{summary_spread(runs, name).median:.0f}" for name in COUNTS]
                for name, offset in REFERENCE.items():
                    s = summary_spread(runs, name) - offset
                    row += ["" if np.isnan(x) else rounded(x) for x in (s.median, s.low, s.high)]
                writer.writerow(row)


def _setting(run, sweep):
    """(cells, model, pinned rings, the rest of the sweep as text)."""
    named = ("/mesh/cells", "/bending/model", "/pins/ring", "/initial/seed")
    rest = [f"{pointer}={json.dumps(at(run.config, pointer))}" for pointer in sweep
            if pointer not in named and at(run.config, pointer) is not None]
    return run.get("/mesh/cells", 0), run.model, run.get("/pins/ring"), " ".join(rest)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--results", type=Path, default=Path("results"), help="folder with the runs")
    parser.add_argument("--out", type=Path, default=Path("results/paper"), help="folder for the page")
    arguments = parser.parse_args()
    main(arguments.results, arguments.out)
    print(arguments.out / "index.html")
