"""The rules of the verdict maps: for each claim, under which condition a cell holds."""
from contextlib import suppress
from dataclasses import replace

import numpy as np

from bendlab.results.load import group
from figures.paper.map_cells import NotMeasured, cell, median, noted, row_cells, same_seeds
from runs import strips
from runs.distance import at_rest, in_first_second
from tables.claim_map import ClaimMap, Place, place_of, places, rounding_of, solver_of
from tables.numbers import number

WRONG = 1.0  # stretch − 1 of a triangle that is twice as long as at rest
SOUND_STRAIN = 0.1  # mean strain; clothes of woven cloth stretch by less than a tenth when worn
SAME_DROP = 0.05  # of the smallest drop
SAME_STIFFNESS = 1.25  # largest stiffness over smallest
SEEN = 0.01  # RMS distance of two sheets, in sizes; smaller distances are hardly visible
REDUCED = 1.25  # if a stretch falls by a smaller factor, this counts as no reduction
SHEETS, STRIPS = (16, 32, 64), (12, 24, 48)  # the N of every row
STRIP_PIN = "one side of the strip"
STIFFNESS_SENTENCE = "해상도에 따라 뻣뻣함 정도가 변하지 않고 안정적으로 SBD 시뮬레이션 결과를 만들었다."
ONE_VERDICT = "All N of a row have one verdict. If runs of an N are missing, the row is open"


def wrong_at_the_pin(groups):
    def judge(runs):
        value = median(runs, "pin_max_stretch", 1)
        return number(value, 2), value > WRONG

    return ClaimMap(
        "1", "이러한 문제는 정점 하나를 고정시킬 때 명확하게 나타난다.",
        "The problem (triangles at the pin are stretched in a wrong direction) is clearly visible when a "
        "single vertex is fixed.",
        "with crossover springs and only the corner pinned, a triangle at the pin is more than twice its "
        "length at rest: the largest stretch − 1 at the pin, as median over the last second, is above 1",
        "largest stretch − 1 at the pin",
        {place: cell(judge, runs) for place, runs in groups.items() if place.pins == "the corner alone"},
        of_torn=True)


def fails_with_resolution(groups):
    worsens = lambda values: values[-1] > WRONG and all(b > a for a, b in zip(values, values[1:]))
    return ClaimMap(
        "5a", "저해상도 옷감 결과에서는 잘되는 것처럼 보이지만, 해상도가 증가하면 고정된 포인트들 주변에서 발생하는 비정상적인 변형률로 인해 불안정한 결과가 나타난다.",
        "Crossover springs seem to work at low resolution. At higher resolution abnormal strain around the "
        "pinned points makes the result unstable.",
        "with crossover springs the largest stretch − 1 around the pin (within a tenth of the sheet's size, "
        "median over the last second) rises with every increase of N, and is above 1 at the largest N. "
        f"{ONE_VERDICT}", "largest stretch − 1 around the pin",
        row_cells(groups, SHEETS, lambda runs: median(runs, "pin_region_stretch", 1),
                  lambda value: number(value, 2), worsens), of_torn=True)


def normal_cloth(groups):
    judge = lambda runs: _sound(median(runs, "max_stretch", 1), median(runs, "mean_strain"))
    return ClaimMap(
        "5b", "우리의 방법은 해상도에 관계없이 정상적인 옷감형태의 표현했으며",
        "Our method showed normal cloth at every resolution.",
        "with adaptive springs no triangle is more than twice its length at rest (largest stretch − 1 "
        f"anywhere at most 1), and the mean strain is at most {SOUND_STRAIN}, both as medians over the last "
        "second", "largest stretch − 1 anywhere (in brackets: mean strain)",
        {place: cell(judge, runs) for place, runs in groups.items()})


def _sound(most, mean):
    text = f"{_against(most, WRONG)} ({_against(mean, SOUND_STRAIN)})"
    return text, most <= WRONG and mean <= SOUND_STRAIN


def _against(value, limit):
    """The value as text, with enough digits to see whether it is above the limit."""
    for digits in (2, 3, 4, 8):
        rounded = float(f"{value:.{digits - 1}e}")
        if rounded != limit and (rounded < limit) == (value < limit):
            break
    return number(value, digits)


def equally_stiff(runs):
    def judge(own_runs):
        if not all("settled_at" in run.summary for run in own_runs):
            raise NotMeasured("a strip that still moves")
        values = [median([run], "stiffness_flexural_rigidity") for run in own_runs]
        ratio = strips.largest_ratio(values)
        return (f"{number(ratio, 2)} ({', '.join(number(1e6 * value, 2) for value in values)})",
                ratio <= SAME_STIFFNESS)

    cells = {}
    for (rounding, solver), own_runs in group(runs, lambda run: (rounding_of(run), solver_of(run))).items():
        own_runs = sorted(own_runs, key=strips.cells)
        n = f"{STRIPS[0]} to {strips.cells(own_runs[-1])}"
        place = Place(rounding, "viscous drag", solver, STRIP_PIN, n)
        cells[place] = cell(judge, own_runs)
    return ClaimMap(
        "5b", STIFFNESS_SENTENCE,
        "The stiffness did not change with the resolution (measured as the stiffness of a strip).",
        "strips of adaptive springs are clamped on one side and hang at rest under their own weight. Their "
        f"flexural rigidity B is nearly equal at every N: the largest B is at most {SAME_STIFFNESS} times "
        "the smallest", "largest B over smallest B (in brackets: B in µN m, from the smallest N to the "
        "largest)", cells,
        "A strip is 20 cm long and 12.5 cm wide. N is the number of cells along the strip, with the clamp. B "
        "is computed from the height and the reach of the free end, as on the stiffness page. Gravity has a "
        "tenth of its usual value, so that even the softest strip has a measurable shape. If m is 1, free "
        "vertices have springs only to their neighbours, so only the springs of the clamp resist bending.")


def equal_drop(groups):
    at_rest_ones = {place: runs for place, runs in groups.items() if place.damping == "viscous drag"}
    same = lambda values: max(values) <= (1 + SAME_DROP) * min(values)
    return ClaimMap(
        "5b", STIFFNESS_SENTENCE,
        "The stiffness did not change with the resolution (judged by the drop of the sheet).",
        "with adaptive springs and viscous drag the drop of the sheet differs by at most "
        f"{100 * SAME_DROP:.0f} % between all N. {ONE_VERDICT}", "drop in m",
        row_cells(at_rest_ones, SHEETS, lambda runs: median(runs, "drop"), "{:.3f}".format, same),
        "The drop shows how the sheet looks, and not its stiffness. A stretched sheet hangs lower; a "
        "sheet without stiffness hangs down by its diagonal, 1.41 m. Without damping the sheet swings and "
        "the drop changes all the time, so runs without damping are left out.")


def springs_rather_than_ring(crossover, adaptive):
    cells = {}
    for place in adaptive:
        alone = replace(place, pins="the corner alone")
        wanted = [(crossover, replace(alone, rounding="")), (crossover, replace(place, rounding="")),
                  (adaptive, alone), (adaptive, place)]
        if place.pins == "the corner and its 1-ring" and all(key in groups for groups, key in wanted):
            before = [groups[key] for groups, key in wanted]
            after = same_seeds(before)
            cells[place] = noted(cell(_share, *after), sum(before, []))
    return ClaimMap(
        "5", "", "Our question, not the paper's: more than half of the reduction of the stretch at the pin "
        "is caused by the springs, and not by the pinned ring.",
        "the largest stretch − 1 around the pin is smaller with adaptive springs and a pinned 1-ring than "
        "with crossover springs and only the corner pinned. The springs cause more than half of the "
        "logarithm of this reduction", "the springs' share of the reduction", cells,
        "The paper's sheets have both the springs and the pinned ring. The paper does not say how much "
        "the springs and the ring contribute. The part of the springs is the mean of two reductions: "
        "with only the corner pinned, and with its 1-ring pinned, too. “No reduction”: springs and "
        f"ring together reduce the stretch by less than a factor of {REDUCED}.")


def _share(*groups):
    """The springs' share of the reduction as text, and whether it is more than half. `groups`: runs with
    crossover springs and the corner alone, with its 1-ring, and the same with adaptive springs."""
    levels = [median(runs, "pin_region_stretch", 1) for runs in groups]
    if min(levels) <= 0:
        raise NotMeasured("the logarithm of a stretch − 1 that is not positive")
    neither, ring, springs, both = np.log(levels)
    whole, part = neither - both, ((neither - springs) + (ring - both)) / 2
    if whole <= np.log(REDUCED):
        return "no reduction", None
    if part > whole:
        return "the ring makes it worse", True
    if part < 0:
        return "the springs make it worse", False
    return f"{100 * part / whole:.0f} %", part > whole / 2


def _variants(runs, key):
    """Place → {key(run): runs}."""
    return {place: group(own_runs, key) for place, own_runs in places(runs).items()}


def _apart(runs, other_runs, where=slice(None)):
    """Median distance of two groups of runs in sizes of the sheet, over pairs with different seeds. With
    damping the cloths at rest are compared, without damping the motions in the first second. NotMeasured if
    no pair has different seeds."""
    distance = at_rest if place_of(runs[0]).damping == "viscous drag" else in_first_second
    pairs = [distance(a, b, where) for a in runs for b in other_runs
             if a.get("/initial/seed") != b.get("/initial/seed")]
    if not pairs or not np.isfinite(pairs).all():
        raise NotMeasured("how far sheets with different seeds are apart")
    return float(np.median(pairs))


HOW_FAR = ("Distances are root mean squares over the vertices, in sizes of the sheet. With viscous drag the "
           "last frames are compared, after the rotation about the vertical that makes the distance "
           "smallest. Without damping, distances at equal times are averaged over the first second.")


def lod_looks_the_same(runs):
    def judge(fewer, full):
        apart, same = _apart(fewer, full), _apart(full, full)
        return f"{number(apart, 2)} ({number(same, 2)})", apart <= max(1.25 * same, SEEN)

    cells, levels = {}, []
    for place, kinds in sorted(_variants(runs, lambda run: run.get("/bending/lod/t", "full")).items()):
        full = kinds.pop("full", [])
        (level, fewer), known = _twenty_percent_fewer(kinds, full), sum(kinds.values(), full)
        if level is not None:
            levels.append(f"At N = {place.cells} with m {place.rounding}, t = {level} has "
                          f"{100 * fewer:.0f} % fewer springs.")
            cells[place] = cell(judge, kinds[level], full)
        elif not all("springs" in run.summary for run in known):
            cells[place] = cell(lambda runs: median(runs, "springs"), known)  # NotMeasured
    return ClaimMap(
        "6", "LOD를 사용하지 않은 굽힘 스프링 구조와 LOD기반 스프링 구조의 시각적 차이는 거의 발생하지 않았지만, 20% 적은 개수의 굽힘 스프링만을 사용하였다.",
        "There was hardly any visual difference between the structures without LOD and with LOD, although "
        "LOD used 20 % fewer springs.",
        "a sheet with 15 to 25 % fewer springs (LOD with a ring t) differs from a sheet with all springs by "
        "at most 1.25 times as much as two sheets with all springs that start from different seeds, or by "
        f"at most {100 * SEEN:.0f} % of the size",
        "distance from the sheet with all springs (in brackets: two seeds, all springs)", cells,
        " ".join([HOW_FAR, *dict.fromkeys(levels)]))


def _twenty_percent_fewer(kinds, full):
    """(t, its saving) of the ring t whose saving of springs is nearest to 20 %. Without a saving between 15
    and 25 %, t is None."""
    fewer = {}
    for level, runs in kinds.items():
        with suppress(NotMeasured):
            fewer[level] = 1 - median(runs, "springs") / median(full, "springs")
    near = [entry for entry in fewer.items() if 0.15 <= entry[1] <= 0.25]
    return min(near, key=lambda entry: abs(entry[1] - 0.2), default=(None, np.nan))


def material_changes(runs):
    def judge(once, four_times):
        outside = _outside_zone(four_times[0])
        far, whole = _apart(once, four_times, outside), _apart(once, four_times)
        same = _apart(once, once, outside)
        return f"{number(far, 2)} ({number(whole, 2)}, {number(same, 2)})", far > max(2 * same, SEEN)

    return ClaimMap(
        "7", "Fig 7은 우리의 방법을 이용하여 옷감의 재질을 변화시킨 결과이다.",
        "Scaling n changes the material of the cloth.",
        "a sheet with n × 1 and a sheet with n × 4 are more than twice as far apart as two sheets with n × 1 "
        f"that start from different seeds, and farther apart than {100 * SEEN:.0f} % of the size. Vertices "
        "near the pin are left out, because the longer springs of the pin with n × 4 stiffen this zone "
        "directly",
        "distance of n × 1 and n × 4 outside the zone (in brackets: over the whole sheet; two seeds with n × "
        "1, outside the zone)",
        {place: cell(judge, kinds[1], kinds[4]) for place, kinds in _variants(runs, _multiplier).items()
         if {1, 4} <= set(kinds)}, HOW_FAR)


def no_abnormal_deformation(runs):
    def judge(*kinds):
        worst = max(median(own_runs, "max_stretch", 1) for own_runs in kinds)
        return number(worst, 2), worst <= WRONG

    return ClaimMap(
        "7", "비정상적인 변형을 없이 안정적으로 재질 변화 제어가 가능하다.",
        "The material can be controlled stably, without abnormal deformation.",
        "with n × 1, n × 2 and n × 4 no triangle anywhere is more than twice its length at rest, as median "
        "over the last second", "largest stretch − 1 anywhere, of all three n",
        {place: cell(judge, *(kinds[n] for n in (1, 2, 4)))
         for place, kinds in _variants(runs, _multiplier).items() if {1, 2, 4} <= set(kinds)})


def _multiplier(run):
    return int(run.get("/bending/adaptive/n_multiplier"))


def _outside_zone(run):
    """(V) whether a vertex at rest lies outside the n-ring of the pinned vertices."""
    rest, pins = run.rest_positions, run.pin_seeds
    reach = (run.summary["model_n"] + 1) * run.get("/mesh/width") / run.get("/mesh/cells") * np.sqrt(2)
    return np.linalg.norm(rest - rest[pins[0]], axis=1) > reach
