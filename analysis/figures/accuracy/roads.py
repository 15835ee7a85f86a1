"""Compares methods that should give the same reference, and states the cost of remedies for a single pin."""
import numpy as np

from bendlab.results.load import by_model
from figures.accuracy import measures
from tables.chart import Chart
from tables.numbers import number
from tables.section import Check

AGREE = 0.005  # largest distance between two methods, in sizes
# The free end of the heavy elastica of configs/accuracy/cantilever.json, m
REACH, DROP, LENGTH = 0.03520, 0.06745, 0.08083
EFFECTS = {"tethers": "tethers", "strain_limiting": "strain limits"}


def main(results, out, section):
    for name in ("cantilever", "curtain", "drape", "one_pin"):
        runs = [run for run in measures.experiment_runs(results, section, name) if run.complete]
        section.checks += road_checks(name, runs)
        if name == "cantilever":
            section.checks += elastica_checks(runs)
    pin = [run for run in measures.experiment_runs(results, section, "pin") if run.complete]
    if not pin:
        return
    rows = [measures.row(run) | {"remedy": remedy(run), "effect": EFFECTS.get(effect_of(run), "no effect"),
                                 "pin": run.summary.get("pin_max_stretch", np.nan)}
            for run in sorted(pin, key=measures.error, reverse=True)]
    section.tables.append(measures.table("pin", "Remedies at the pin", [
        ("remedy", "remedy"), "ms", "error_physical", ("pin", "largest stretch at the pin"), "strain"], rows))
    plain = next(run for run in pin if remedy(run).startswith("plain"))
    best = min(pin, key=lambda run: measures.error(run) * measures.cost(run))
    section.charts.append(Chart(
        "pin", f"At one pin: compared with plain iterations, '{remedy(best)}' divides the error by "
        f"{number(measures.error(plain) / measures.error(best), 2)} and takes "
        f"{number(measures.cost(best) / measures.cost(plain), 2)} × the time", "pin", "remedy",
        ["error_physical", "ms", "strain"], ["effect"], scale="band", look="", y_scale="log",
        note="Hinges on a sheet of 30 cm that hangs from one pin. The error is the distance from the nearest "
             "equilibrium of the stated cloth, after the best rotation about the vertical axis."))


def road_checks(name, runs):
    """For every model: whether XPBD with the most substeps and Newton's method reach the same pose."""
    moving = [run for run in runs if run.get("/solver/method") == "pbd"
              and run.get("/accuracy/start_from_end") in (name in ("drape", "one_pin"), None)]
    finest = [max(own_runs, key=lambda run: run.get("/solver/substeps"))
              for own_runs in by_model(moving).values()]
    return [Check(f"{name.replace('_', ' ')}: XPBD with {run.get('/solver/substeps')} substeps from Newton's "
                  "equilibrium", run.model, f"{run.get('/mesh/cells')} cells", AGREE,
                  measures.error(run, against="solver"), 0, "the same energies", "most") for run in finest]


def elastica_checks(runs):
    """Compares height / width of a strip of hinges in equilibrium with the heavy elastica."""
    return [Check("cantilever: H/W against the heavy elastica", run.model, f"{run.get('/mesh/cells')} cells",
                  DROP / REACH, run.summary.get("stiffness_height_over_width", np.nan),
                  AGREE * LENGTH * (1 / DROP + 1 / REACH), "strip of Bickley 1934; tolerance 0.5 % of its "
                  "length in height and width") for run in runs if run.get("/solver/method") == "equilibrium"
            and run.model in ("dihedral", "isometric")]


def effect_of(run):
    """The effect of a run that is a remedy for the pin, or ""."""
    return next((effect["type"] for effect in run.get("/effects") if effect["type"] in EFFECTS), "")


def remedy(run):
    names = [EFFECTS[effect["type"]] for effect in run.get("/effects") if effect["type"] in EFFECTS]
    substeps, iterations = run.get("/solver/substeps"), run.get("/solver/iterations")
    if (substeps, iterations) != (1, 10):
        names.append(f"{substeps} × {iterations}" if substeps > 1 else f"{iterations} iterations")
    if run.get("/solver/order") != "colour":
        names.append("order from the pin")
    if run.get("/solver/flight_limit"):
        names.append("cut steps")
    return ", ".join(names) or "plain, 1 × 10"
