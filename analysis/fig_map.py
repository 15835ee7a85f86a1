"""The verdict maps: for which answers to the paper's open questions each of its claims holds."""
from dataclasses import replace

import numpy as np

import style
from claim_map import Cell, ClaimMap, command, place_of, places
from distance import at_rest, in_first_second
from load import select, summary_spread
from report import Section, figure_main
from sweeps import load_experiment

PIN_CONFIGS = ["paper/map", "paper/map_64", "paper/map_64_rest", "paper/map_seeds",
               "paper/map_full", "paper/map_256_full"]
LOD_CONFIGS = ["paper/map_lod", "paper/map_lod_rest"]
N_CONFIGS = ["paper/map_n", "paper/map_n_rest"]
WRONG = 1.0  # stretch − 1: a triangle is twice as long as at rest
SOUND_STRAIN = 0.1  # mean strain; woven cloth stretches by less than a tenth as it is worn
SAME_DROP = 0.05
SEEN = 0.01  # RMS distance of two sheets, in sizes: a smaller one is hardly seen


def main(results, out):
    """Computes the maps. They are tables: there is no picture."""
    section = Section("Where each claim holds", "", text="A map has a cell for each answer to the questions "
                      "that the paper leaves open: how m becomes an integer, what is pinned, how much the "
                      "solver works, how motion is damped. 256 × 1 has converged: the strain constraints are "
                      "met. In a viscous medium (1 N s/m³, about the drag of air) the sheet comes to rest, "
                      "so that shapes can be compared; without damping it swings, and numbers are medians "
                      "over the last second and, at 1 × 10, over five seeds.")
    pin, lod, n = (_runs(section, results, configs) for configs in (PIN_CONFIGS, LOD_CONFIGS, N_CONFIGS))
    crossover, adaptive = (places(select(pin, bending__model=model)) for model in ("crossover", "adaptive"))
    section.maps += [_wrong_at_the_pin(crossover), _fails_with_resolution(crossover),
                     _normal_cloth(adaptive), _equally_stiff(adaptive), _springs_or_pins(crossover, adaptive),
                     _lod_looks_the_same(lod), _material_changes(n), _no_abnormal_deformation(n)]
    return section


def _runs(section, results, configs):
    """The runs of these configs; each knows its config."""
    runs = []
    for config in configs:
        experiment = load_experiment(results, config)
        if config.endswith("_full") and not experiment.runs:
            continue
        for run in section.uses(experiment):
            run.point["config"] = config
            runs.append(run)
    return runs


def _cell(runs, text, holds):
    return Cell(text, bool(holds), command(runs[0].point["config"], runs[0]))


def _median(runs, metric, offset=0):
    return summary_spread(runs, metric).median - offset


def _over_cells(groups):
    """Groups of places that differ in N alone: [{N: (place, runs)}]."""
    found = {}
    for place, runs in sorted(groups.items()):
        key = (place.rounding, place.damping, place.solver, place.pins)
        found.setdefault(key, {})[place.cells] = (place, runs)
    return [group for group in found.values() if len(group) > 1]


def _wrong_at_the_pin(groups):
    claim = ClaimMap(
        "1", "이러한 문제는 정점 하나를 고정시킬 때 명확하게 나타난다.",
        "The problem (triangles at the pin that are stretched in a wrong direction) shows clearly when a "
        "single vertex is fixed.",
        "with crossover springs and the pin alone, the median of the largest stretch − 1 at the pin over the "
        "last second is above 1: a triangle is more than twice its length at rest",
        "stretch − 1 at the pin")
    for place, runs in groups.items():
        if place.pins == "alone":
            value = _median(runs, "pin_max_stretch", 1)
            claim.cells[place] = _cell(runs, style.number(value, 2), value > WRONG)
    return claim


def _fails_with_resolution(groups):
    claim = ClaimMap(
        "5a", "저해상도 옷감 결과에서는 잘되는 것처럼 보이지만, 해상도가 증가하면 고정된 포인트들 주변에서 "
        "발생하는 비정상적인 변형률로 인해 불안정한 결과가 나타난다.",
        "Crossover springs seem to work at low resolution; as resolution rises, abnormal strain around the "
        "pinned points makes the result unstable.",
        "the median of the largest stretch − 1 within a tenth of the sheet's size of the pin rises with "
        "every doubling of N, and is above 1 (twice as long) at the finest N. The cells of one row of N are "
        "one verdict", "stretch − 1 around the pin")
    for group in _over_cells(groups):
        values = [_median(runs, "pin_region_stretch", 1) for _, runs in (group[n] for n in sorted(group))]
        holds = values[-1] > WRONG and all(b > a for a, b in zip(values, values[1:]))
        for (place, runs), value in zip((group[n] for n in sorted(group)), values):
            claim.cells[place] = _cell(runs, style.number(value, 2), holds)
    return claim


def _normal_cloth(groups):
    claim = ClaimMap(
        "5b", "우리의 방법은 해상도에 관계없이 정상적인 옷감형태의 표현했으며",
        "Our method showed normal cloth at every resolution.",
        "with adaptive springs no triangle anywhere is more than twice its length at rest (median of the "
        f"largest stretch − 1 over the last second), and the mean strain is at most {SOUND_STRAIN}",
        "largest stretch − 1 anywhere; in brackets the mean strain")
    for place, runs in groups.items():
        most, mean = _median(runs, "max_stretch", 1), _median(runs, "mean_strain")
        claim.cells[place] = _cell(runs, f"{style.number(most, 2)} ({style.number(mean, 2)})",
                                   most <= WRONG and mean <= SOUND_STRAIN)
    return claim


def _equally_stiff(groups):
    claim = ClaimMap(
        "5b", "해상도에 따라 뻣뻣함 정도가 변하지 않고 안정적으로 SBD 시뮬레이션 결과를 만들었다.",
        "The stiffness did not change with the resolution.",
        "with adaptive springs the drop of the sheet (median over the last second) differs by at most "
        f"{100 * SAME_DROP:.0f} % between all N. The cells of one row of N are one verdict",
        "drop in m",
        note="The drop only bounds stiffness: a sheet that is stretched hangs lower, too. The stiffness page "
        "measures it on strips.")
    for group in _over_cells(groups):
        values = [_median(runs, "drop") for _, runs in group.values()]
        holds = max(values) <= (1 + SAME_DROP) * min(values) if np.isfinite(values).all() else False
        for place, runs in group.values():
            claim.cells[place] = _cell(runs, f"{_median(runs, 'drop'):.3f}", holds)
    return claim


def _springs_or_pins(crossover, adaptive):
    claim = ClaimMap(
        "5", "", "Our question: is it the adaptive springs that help, or the pinned 1-ring? (The paper's own "
        "sheets have both, and it says so; it does not say which does what.)",
        "of the whole reduction of the largest stretch − 1 around the pin, from crossover springs with the "
        "pin alone to adaptive springs with its 1-ring, more than half (in logarithms) is the springs'",
        "the springs' share of the reduction; – where there is hardly any",
        note="The springs' part is the mean of what they do with the pin alone and with its 1-ring.")
    level = lambda groups, place: np.log(_median(groups[place], "pin_region_stretch", 1))
    for place, runs in adaptive.items():
        alone, plain = replace(place, pins="alone"), replace(place, rounding="")
        plain_alone = replace(plain, pins="alone")
        if place.pins != "its 1-ring" or alone not in adaptive or not {plain, plain_alone} <= set(crossover):
            continue
        whole = level(crossover, plain_alone) - level(adaptive, place)
        springs = ((level(crossover, plain_alone) - level(adaptive, alone))
                   + (level(crossover, plain) - level(adaptive, place))) / 2
        if whole > np.log(1.25):
            claim.cells[place] = _cell(runs, f"{100 * springs / whole:.0f} %", springs > whole / 2)
    return claim


def _variants(runs, key):
    """Place → {variant: runs}, by the value of `key`."""
    found = {}
    for run in runs:
        place = place_of(run)
        if place:
            found.setdefault(place, {}).setdefault(key(run), []).append(run)
    return found


def _apart(some, others, damping, where=slice(None)):
    """Median distance of two groups of runs in sizes of the sheet, over pairs with different seeds: at rest,
    or of the motion in the first second where nothing comes to rest."""
    pairs = [(a, b) for a in some for b in others if a.get("/initial/seed") != b.get("/initial/seed")]
    if not pairs:
        return np.nan
    if damping == "viscous":
        return float(np.median([at_rest(a, b, where) for a, b in pairs]))
    return float(np.median([in_first_second(a, b, where) for a, b in pairs]))


HOW_FAR = ("Distances are RMS over the vertices, in sizes of the sheet: in the viscous medium between the "
           "last frames, turned about the vertical; without damping over the first second, at equal times.")


def _lod_looks_the_same(runs):
    claim = ClaimMap(
        "6", "LOD를 사용하지 않은 굽힘 스프링 구조와 LOD기반 스프링 구조의 시각적 차이는 거의 발생하지 않았지만, "
        "20% 적은 개수의 굽힘 스프링만을 사용하였다.",
        "There was hardly any visual difference between the structures without and with LOD, which used 20 % "
        "fewer springs.",
        "the sheet with the level t that has 15 to 25 % fewer springs is at most as far from the full one as "
        f"1.25 times two seeds of the full one, or {100 * SEEN:.0f} % of its size",
        "distance to the full structure; in brackets that of two seeds",
        note=HOW_FAR + " At 64 cells, with m rounded, t = 5 has 17 % fewer springs; with m rounded down no "
        "level has 15 to 25 % fewer.")
    for place, kinds in _variants(runs, lambda run: run.get("/bending/lod/t", "full")).items():
        full = kinds.get("full", [])
        for t, some in kinds.items():
            fewer = 1 - summary_spread(some, "springs").median / summary_spread(full, "springs").median \
                if full else 0
            if t == "full" or not 0.15 <= fewer <= 0.25:
                continue
            apart, same = _apart(some, full, place.damping), _apart(full, full, place.damping)
            claim.cells[place] = _cell(some, f"{style.number(apart, 2)} ({style.number(same, 2)})",
                                       apart <= max(1.25 * same, SEEN))
    return claim


def _material_changes(runs):
    claim = ClaimMap(
        "7", "Fig 7은 우리의 방법을 이용하여 옷감의 재질을 변화시킨 결과이다.",
        "Scaling n changes the material of the cloth.",
        "outside the zone around the pin that n × 4 stiffens by itself, the sheets of n × 1 and n × 4 are "
        f"farther apart than twice two seeds of n × 1, and than {100 * SEEN:.0f} % of the size",
        "distance of n × 1 and n × 4 outside that zone; in brackets in the whole sheet, and of two seeds",
        note=HOW_FAR)
    for place, kinds in _variants(runs, _multiplier).items():
        if not {1, 4} <= set(kinds):
            continue
        outside = _outside_zone(kinds[4][0])
        far, near, same = (_apart(kinds[1], kinds[other], place.damping, where)
                           for other, where in ((4, outside), (4, slice(None)), (1, outside)))
        claim.cells[place] = _cell(
            kinds[4], f"{style.number(far, 2)} ({style.number(near, 2)}, {style.number(same, 2)})",
            far > max(2 * same, SEEN))
    return claim


def _no_abnormal_deformation(runs):
    claim = ClaimMap(
        "7", "비정상적인 변형을 없이 안정적으로 재질 변화 제어가 가능하다.",
        "The material can be controlled stably, without abnormal deformation.",
        "with n × 1, × 2 and × 4 no triangle anywhere is more than twice its length at rest",
        "largest stretch − 1 anywhere, of the worst of the three")
    for place, kinds in _variants(runs, _multiplier).items():
        if len(kinds) == 3:
            worst = max(_median(some, "max_stretch", 1) for some in kinds.values())
            claim.cells[place] = _cell(kinds[4], style.number(worst, 2), worst <= WRONG)
    return claim


def _multiplier(run):
    return int(run.get("/bending/adaptive/n_multiplier"))


def _outside_zone(run):
    """(V) whether a vertex at rest is farther from the pin than the n-ring of the pinned vertices reaches."""
    rest, seeds = run.rest_positions, run.pin_seeds
    reach = (run.summary["model_n"] + 1) * run.get("/mesh/width") / run.get("/mesh/cells") * np.sqrt(2)
    return np.linalg.norm(rest - rest[seeds[0]], axis=1) > reach


if __name__ == "__main__":
    figure_main(main)
