"""Compares methods that should give the same reference, and states the cost of remedies for a single pin."""
import numpy as np

from bendlab.results.load import by_model, select
from figures.accuracy.measures import (cells, complete_runs, cost, error, row, solver_error, substeps, table,
                                       with_error, work)
from tables.numbers import number

AGREE = 0.005  # largest distance between two methods, in sizes
# The free end of the heavy elastica of configs/accuracy/cantilever.json, m
REACH, DROP, LENGTH = 0.03520, 0.06745, 0.08083
EFFECTS = {"tethers": "tethers", "strain_limiting": "strain limits"}


def main(results, out, section):
    for name in ("cantilever", "curtain", "drape", "one_pin"):
        runs = complete_runs(results, section, name)
        from_end = name in ("drape", "one_pin")
        moving = [run for run in select(runs, solver__method="pbd")
                  if run.get("/accuracy/start_from_end", False) == from_end]
        for own_runs in by_model(moving).values():
            finest = max(own_runs, key=substeps)
            section.add_check(
                f"{name.replace('_', ' ')}: XPBD with {substeps(finest)} substeps from Newton's equilibrium",
                finest.model, f"{cells(finest)} cells", AGREE, solver_error(finest), 0, "the same energies",
                "most")
        if name == "cantilever":
            _check_elastica(section, select(runs, solver__method="equilibrium"))
    pin = with_error(section, complete_runs(results, section, "pin"))
    if not pin:
        return
    rows = [row(run) | {"remedy": remedy(run), "effect": [*effects_of(run), "no effect"][0],
                        "pin": run.summary.get("pin_max_stretch", np.nan)}
            for run in sorted(pin, key=error, reverse=True)]
    best = min(pin, key=lambda run: error(run) * cost(run))
    plain = next((run for run in pin if remedy(run).startswith("plain")), None)
    section.add_chart(
        table("pin", "Remedies at the pin", [("remedy", "remedy"), "ms", "error_physical",
                                             ("pin", "largest stretch at the pin"), "strain"], rows),
        f"At one pin: compared with plain iterations, '{remedy(best)}' divides the error by "
        f"{number(error(plain) / error(best), 2)} and takes {number(cost(best) / cost(plain), 2)} × the time"
        if plain else "Remedies at the pin",
        "remedy", ["error_physical", "ms", "strain"], ["effect"], scale="band", look="", y_scale="log",
        note="Hinges on a sheet of 30 cm that hangs from one pin. The error is the distance from the nearest "
             "equilibrium of the stated cloth, after the best rotation about the vertical axis.")


def _check_elastica(section, runs):
    """Compares height / width of strips of hinges in equilibrium with the heavy elastica."""
    for run in runs:
        if run.model in ("dihedral", "isometric"):
            section.add_check(
                "cantilever: H/W against the heavy elastica", run.model, f"{cells(run)} cells", DROP / REACH,
                run.summary.get("stiffness_height_over_width", np.nan),
                AGREE * LENGTH * (1 / DROP + 1 / REACH),
                "strip of Bickley 1934; tolerance 0.5 % of its length in height and width")


def effects_of(run):
    """The names of the effects of a run that are remedies for the pin."""
    return [EFFECTS[effect["type"]] for effect in run.get("/effects") if effect["type"] in EFFECTS]


def remedy(run):
    names, iterations = effects_of(run), run.get("/solver/iterations")
    if (substeps(run), iterations) != (1, 10):
        names.append(work(run) if substeps(run) > 1 else f"{iterations} iterations")
    if run.get("/solver/order") != "colour":
        names.append("order from the pin")
    if run.get("/solver/flight_limit"):
        names.append("cut steps")
    return ", ".join(names) or "plain, 1 × 10"
