"""The verdict maps: for which answers to the paper's open questions a claim of the paper holds."""
from dataclasses import replace

from bendlab.results.load import select
from figures.paper import map_rules as rules
from figures.paper.map_cells import NotMeasured, median
from runs.sweeps import load_experiment, planned_runs
from tables.claim_map import SOLVERS, Place, places

PIN_CONFIGS = ["paper/map", "paper/map_64", "paper/map_64_rest", "paper/map_seeds",
               "paper/map_64_free_full", "paper/map_full", "paper/map_256_full"]
LOD_CONFIGS = ["paper/map_lod", "paper/map_lod_rest_full"]
N_CONFIGS = ["paper/map_n", "paper/map_n_rest_full"]
STRIP_CONFIGS = ["paper/map_strip", "paper/map_strip_full"]
TEXT = ("The paper leaves some questions open: how m becomes an integer, what is pinned, how much work the "
        "solver does, and how motion is damped. A map has one box for each combination of answers. In a "
        "blue box the claim holds, in an orange box it fails. A box with a diverged run fails. If the claim "
        "says that cloth tears, orange means torn, and the claim holds there. A grey box has no verdict, and "
        "states the reason. A dash means that there is no such run. Some boxes show the same cloth: at N = "
        "16 the patch of 5 cm contains only the corner, at N = 32 the corner and its 1-ring, and at N = 16 "
        "both roundings give m = 1. With viscous drag (1 N s/m³, about the drag of air) the sheet comes "
        "nearly to rest, so shapes can be compared. Without damping the sheet swings, and numbers are "
        "medians over the last second. Without damping and at 1 × 10 the motion is also chaotic, so numbers "
        "up to N = 64 are medians over the seeds 1 to 5. If a verdict compares several N, and the largest N "
        "has only seed 1, the boxes of this verdict use only seed 1 and say so. Fig. 6 and 7 have the seeds "
        "1 and 2, all other boxes have seed 1. With 256 × 1 the strain has converged: the cloth no longer "
        "stretches. Bending never converges with the paper's k, because each projection of a spring removes "
        "the share k of its error. So more projections make the cloth stiffer.")


def main(results, out, section):
    (pin, pin_less), (lod, lod_less), (n, n_less), (strip, strip_less) = (
        _runs(section, results, configs) for configs in (PIN_CONFIGS, LOD_CONFIGS, N_CONFIGS, STRIP_CONFIGS))
    crossover, adaptive = (places(select(pin, bending__model=model)) for model in ("crossover", "adaptive"))
    section.text += _bending_does_not_converge(adaptive)
    for less, *maps in (
            (pin_less, rules.wrong_at_the_pin(crossover), rules.fails_with_resolution(crossover),
             rules.normal_cloth(adaptive)),
            (strip_less, rules.equally_stiff(strip)),
            (pin_less, rules.equal_drop(adaptive), rules.springs_rather_than_ring(crossover, adaptive)),
            (lod_less, rules.lod_looks_the_same(lod)),
            (n_less, rules.material_changes(n), rules.no_abnormal_deformation(n))):
        section.maps += [replace(claim_map, left_out=less) for claim_map in maps]


def _runs(section, results, configs):
    """Returns every run of these configs (also missing runs), and whether a _full config has no runs."""
    experiments = [load_experiment(results, config) for config in configs]
    known = [experiment for experiment in experiments
             if experiment.runs or not experiment.config.endswith("_full")]
    for experiment in known:
        section.uses(experiment)
    return sum(map(planned_runs, known), []), len(known) < len(experiments)


def _bending_does_not_converge(groups):
    """A sentence with the drops of one sheet, from little to much work. "" if runs are missing."""
    place = lambda solver: Place("rounded down", "viscous drag", solver, "the corner and its 1-ring", 16)
    try:
        *drops, last = (f"{median(groups.get(place(solver), []), 'drop'):.2f}" for solver in SOLVERS.values())
    except NotMeasured:
        return ""
    return (" With viscous drag, N = 16 and the 1-ring pinned, the sheet's drop is "
            f"{', '.join(drops)} and {last} m from 1 × 10 to 256 × 1.")
