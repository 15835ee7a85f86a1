"""The questions that the paper leaves open: how each answer changes the sheet."""
import re

import numpy as np

from tables.numbers import number
from bendlab.results.load import at, group
from figures.paper import medians
from tables.chart import Chart
from tables.table import Table
from runs.sweeps import CONFIGS, load_experiment

METRICS = [("pin_max_stretch", 1, "stretch − 1 at the pin"), ("mean_strain", 0, "mean strain"),
           ("drop", 0, "drop (m)")]


def main(results, out, section):
    rows = []
    for config in sorted(CONFIGS.glob("ablations/*.json")):
        experiment = load_experiment(results, f"ablations/{config.stem}")
        if config.stem.endswith("_full") and not experiment.runs:
            continue
        if experiment.missing_text:
            section.missing.append(f"configs/ablations/{config.name}: {experiment.missing_text}")
        if experiment.runs:
            rows += _rows(config.stem, experiment)
    section.commands.append("./bendlab run configs/ablations/*.json")
    most = {}
    for row in rows:
        most.setdefault(row["question"], []).append(row["pin_max_stretch"])
    effect = {question: max(stretches) / min(stretches) for question, stretches in most.items()}
    rows.sort(key=lambda row: -effect[row["question"]])
    for row in rows:
        row["effect"] = effect[row["question"]]
    section.tables.append(Table.of("ablations", "Median over the last second and over three seeds", [
        "question", "choice", "N", ("effect", "largest over smallest stretch − 1 at the pin"),
        *medians.columns(METRICS), ("springs", "springs", ",.0f")], rows))
    if rows:
        first, last = rows[0], rows[-1]
        title = (f"What the paper leaves open changes the stretch at the pin by up to "
                 f"{number(first['effect'], 2)} times ({first['question']}); the least important question "
                 f"is {last['question']}")
        section.charts.append(Chart(
            "ablations", title, "ablations", "answer", [name for name, *_ in METRICS], ["kind"], scale="band",
            y_scale="log", look="", note="The questions with the largest effect at the pin come first. Bars "
                                         "go from the smallest to the largest seed."))


def _rows(config, experiment):
    """A row for each answer, in the order of the config."""
    pointer = next(p for p in experiment.sweep if p != "/initial/seed")
    answers = experiment.sweep[pointer]
    default = at(experiment.settings, pointer, answers[0])
    groups = group(experiment.runs, lambda run: answers.index(run.get(pointer)))
    rows = []
    for i in sorted(groups):
        own_runs = groups[i]
        choice, cells = _choice(pointer, answers[i],
                                own_runs[0]), round((own_runs[0].summary["triangles"] / 2) ** 0.5)
        question = re.sub(r"_\d\d+(_full)?$", "", config).replace("_", " ")  # a mesh file has no /mesh/cells
        rows.append({"question": f"{question}, N = {cells}", "choice": choice, "N": cells,
                     "answer": f"{question}, N = {cells}: {choice}",
                     "kind": "our default" if answers[i] == default else "another answer"}
                    | medians.row(own_runs, [*METRICS, ("springs", 0, "")]))
    return rows


def _choice(pointer, value, run):
    if pointer == "/solver/dt":
        return f"1/{1 / value:.0f} s"
    if pointer == "/initial/tilt":
        return f"{value:g}°"
    if pointer == "/bending/lod/t":
        return f"t = {value}" if value else "t = m and n"
    if pointer == "/pins/vertices":
        count = np.isin(run.triangles, np.flatnonzero(run.pinned)).any(axis=1).sum()
        return f"{count:d} triangle{'s' * (count > 1)}"
    if isinstance(value, list):
        return f"{np.degrees(np.arctan2(value[1], value[0])):g}°"
    unit = {"/effects/1/rate": " s⁻¹", "/material/density": " kg/m²"}.get(pointer, "")
    return {True: "yes",
            False: "no"}[value] if isinstance(value, bool) else f"{value}{unit}".replace("_", " ")
