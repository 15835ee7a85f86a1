"""The questions that the paper leaves open: how each answer changes the sheet."""
import re

import numpy as np

from bendlab.results.load import at, group
from figures.paper import medians
from runs.strips import largest_ratio
from runs.sweeps import CONFIGS, load_experiment
from tables.numbers import number

METRICS = [("pin_max_stretch", 1, "stretch − 1 at the pin"), ("mean_strain", 0, "mean strain"),
           ("drop", 0, "drop (m)")]


def main(results, out, section):
    rows = []
    for config in sorted(CONFIGS.glob("ablations/*.json")):
        experiment = load_experiment(results, f"ablations/{config.stem}")
        if experiment.runs:
            rows += _rows(config.stem, experiment)
        if experiment.missing_text and (experiment.runs or not config.stem.endswith("_full")):
            section.missing.append(f"configs/ablations/{config.name}: {experiment.missing_text}")
    section.commands.append("./bendlab run configs/ablations/*.json")
    rows.sort(key=lambda row: -row["effect"] if row["effect"] > 0 else 0)  # an unknown effect is last
    known = [row for row in rows if row["effect"] > 0]
    section.add_table("ablations", "Median over the last second and over seeds", [
        "question", "choice", "N", ("effect", "largest over smallest stretch − 1 at the pin"),
        *medians.columns(METRICS), ("springs", "springs", ",.0f"), ("status", "runs")], rows)
    if known:
        section.add_chart(
            "ablations", "What the paper leaves open changes the stretch at the pin by up to "
            f"{number(known[0]['effect'], 2)} times ({known[0]['question']}); the least important question "
            f"is {known[-1]['question']}", "answer", medians.names(METRICS), ["kind"], scale="band",
            y_scale="log", look="", note="The questions with the largest effect at the pin come first. Bars "
            "go from the smallest to the largest seed.")


def _rows(config, experiment):
    """A row for each answer, in the order of the config."""
    pointer = next(p for p in experiment.sweep if p != "/initial/seed")
    answers = experiment.sweep[pointer]
    default = at(experiment.settings, pointer, answers[0])
    groups = group(experiment.runs, lambda run: answers.index(run.get(pointer)))
    name = re.sub(r"_\d\d+(_full)?$", "", config).replace("_", " ")
    rows = []
    for i, runs in sorted(groups.items()):
        choice = _choice(pointer, answers[i], runs[0])
        cells = round((runs[0].summary["triangles"] / 2) ** 0.5)  # a mesh file has no /mesh/cells
        question = f"{name}, N = {cells}"
        rows.append({"question": question, "choice": choice, "N": cells, "answer": f"{question}: {choice}",
                     "kind": "our default" if answers[i] == default else "another answer"}
                    | medians.row(runs, [*METRICS, ("springs", 0, "")]))
    effect = largest_ratio(row["pin_max_stretch"] for row in rows)
    return [row | {"effect": effect} for row in rows]


def _choice(pointer, value, run):
    """An answer as text."""
    if pointer == "/pins/vertices":
        count = np.isin(run.triangles, np.flatnonzero(run.pinned)).any(axis=1).sum()
        return f"{count:d} triangle{'s' * (count > 1)}"
    if isinstance(value, list):
        return f"{np.degrees(np.arctan2(value[1], value[0])):g}°"
    if isinstance(value, bool):
        return "yes" if value else "no"
    form = {"/solver/dt": lambda dt: f"1/{1 / dt:.0f} s", "/initial/tilt": "{:g}°".format,
            "/bending/lod/t": lambda t: f"t = {t or 'm and n'}", "/effects/1/rate": "{} s⁻¹".format,
            "/material/density": "{} kg/m²".format}.get(pointer, str)
    return form(value).replace("_", " ")
