"""Where the failure went: stretch against distance from the pin, per model and N.

A model that mends the pin has not mended the cloth if the stretch is then elsewhere. The paper's adaptive
springs come with a pinned 1-ring, so crossover springs are shown with it too: only then do the two differ in
nothing but their springs.
"""
import right_python  # noqa: F401  (first: it may hand over to another Python)
import matplotlib.pyplot as plt
import numpy as np

import style
from fig_6 import damping_rate
from bendlab.results.load import group
from report import Claim, Section, Table, figure_main
from stretch import NEAR, WRONG, measure
from sweeps import load_experiment

REACH_TOP = 0.72  # of a panel's height; the uprights stay below the list of the largest
COMPARED = 64  # cells; the title compares the two models here
LOOKS = {16: ("#e69f00", "o"), 32: ("#009e73", "s"), 64: ("#0072b2", "^"), 128: ("#b0579b", "D"),
         256: ("#22262b", "v")}
CROSSOVER, MENDED, ADAPTIVE = ("crossover, pin alone", "crossover, pin + 1-ring", "adaptive, pin + 1-ring")
BARE, OURS = "adaptive, pin alone", "recommended, pin alone"
FALLING = {CROSSOVER: ("crossover", 0), BARE: ("adaptive", 0), MENDED: ("crossover", 1),
           ADAPTIVE: ("adaptive", 1)}
SCALED = {1: ("#0072b2", "^"), 2: ("#d55e00", "P"), 4: ("#7a3b12", "X")}  # n × 1 is a curve of Fig. 5
PAPERS = {CROSSOVER: "the paper's Fig. 5a", ADAPTIVE: "the paper's Fig. 5b", OURS: "ours"}


def main(results, out):
    """Draws stretch over distance from the pin: falling as in Fig. 5, with other n, and at rest."""
    section = Section("Where the failure went: stretch against distance from the pin", "5")
    runs = [run for config in ("paper/fig5", "paper/fig5_128")
            for run in section.uses(load_experiment(results, config))]
    runs = runs + load_experiment(results, "paper/fig5_full").runs
    falling = {case: _by_cells(_of_kind(runs, *kind, "floor")) for case, kind in FALLING.items()}
    rounded = _by_cells(_of_kind(runs, *FALLING[ADAPTIVE], "round"))
    scaled, rest = _scaled(section, results), _at_rest(section, results)
    if any(falling.values()):
        section.pictures.append((_panels(falling, out, "fig_where", falling_title(falling)),
                                 "Largest stretch of the triangles at each distance from the nearest pinned "
                                 "vertex, as in Fig. 5: no damping, median over the last second and the "
                                 "seeds (bars: smallest and largest seed). " + KEY))
    if scaled:
        section.pictures.append((_cause(falling[ADAPTIVE], rounded, scaled, out), "Adaptive springs with the "
                                 "1-ring pinned, no damping. Left: the runs of Fig. 7, n × 1, 2 and 4. "
                                 "Right: every N, m rounded down and to the nearest, and the three n, those "
                                 "of one n side by side; bars are the middle four fifths over frames and "
                                 "seeds."))
    if any(rest.values()):
        section.pictures.append((_panels(rest, out, "fig_where_rest", rest_title(rest)),
                                 "The same at rest in a medium with about the drag of air, one seed."))
    section.text = _text([*falling.values(), rounded, scaled, *rest.values()])
    section.tables += [_table(falling, "Falling, without damping: median over the last second and over seeds "
                              "(smallest – largest seed)"),
                       _table({"m to the nearest": rounded, "n × 1, 2, 4": scaled},
                              "Adaptive springs, pin + 1-ring, with another n; falling, without damping"),
                       _table(rest, "At rest in a medium: median over the last second, one seed")]
    section.claims += _claims(falling[ADAPTIVE], falling[MENDED], [*rounded.values(), *scaled.values()])
    return section


KEY = ("Filled: within two cells of a pinned vertex; hollow: beyond. The star is the most stretched triangle "
       "of all, its bar the middle four fifths of where it is from frame to frame. Faint lines: nine of ten "
       "triangles at that distance are stretched less. Dotted uprights: n cells, where the springs of a "
       "pinned vertex end (eq. 7). Grey line: twice as long as at rest, which counts as failed.")


def _of_kind(runs, model, ring, rounding):
    return [run for run in runs if (run.model, run.get("/pins/ring")) == (model, ring)
            and run.get("/bending/adaptive/m_rounding", rounding) == rounding]


def _by_cells(runs):
    """N → Group."""
    return {n: measure(some) for n, some in sorted(group(runs, lambda run: run.get("/mesh/cells")).items())}


def _scaled(section, results):
    """Multiplier of n → Group, of the sheets of Fig. 7 without damping."""
    runs = [run for run in section.uses(load_experiment(results, "paper/fig7")) if not damping_rate(run)]
    factor = lambda run: run.get("/bending/adaptive/n_multiplier")
    return {k: measure(some) for k, some in sorted(group(runs, factor).items())}


def _at_rest(section, results):
    """Case → N → Group, of sheets that hang from one corner in the medium of the recommended settings."""
    kinds = {CROSSOVER: ("paper/fig5_rest",), ADAPTIVE: ("paper/promise", "paper/promise_full"),
             OURS: ("recommended", "paper/recommended_full")}
    cases = {}
    for case, configs in kinds.items():
        runs = section.uses(load_experiment(results, configs[0]))
        runs = runs + [run for config in configs[1:] for run in load_experiment(results, config).runs]
        cases[case] = _by_cells([run for run in runs if run.get("/pins/vertices") == ["upper_right"]
                                 and run.get("/bending/adaptive/m_rounding", "floor") == "floor"])
    return cases


def falling_title(cases):
    """What Fig. 5 shows at COMPARED cells with the 1-ring pinned, in numbers."""
    crossover, adaptive = (cases[case].get(COMPARED) for case in (MENDED, ADAPTIVE))
    if not crossover or not adaptive:
        return ""
    two = lambda s: style.number(s.median, 2)
    return (f"With the 1-ring pinned, N = {COMPARED}: at the pin (within {NEAR:g} cells) adaptive springs "
            f"have a stretch − 1 of {two(adaptive.near)}, crossover springs {two(crossover.near)}.\n"
            f"Beyond, adaptive springs have {two(adaptive.far)} and crossover springs {two(crossover.far)}: "
            f"the largest is now {adaptive.in_cells:.1f} cells from the pin instead of "
            f"{crossover.in_cells:.1f}.")


def rest_title(cases):
    """The largest stretch on any N of each case at rest."""
    worst = {case: max(groups.values(), key=lambda one: one.whole.median) for case, groups in cases.items()
             if groups}
    return "At rest, the largest stretch − 1 on any N and its distance from the pin:\n" + "; ".join(
        f"{case}: {style.number(one.whole.median, 2)} at {one.in_cells:.1f} cells"
        for case, one in worst.items())


def _panels(cases, out, file, title):
    columns = 2 if len(cases) == 4 else len(cases)
    rows = -(-len(cases) // columns)
    figure, axes = plt.subplots(rows, columns, sharex=True, sharey=True, squeeze=False,
                                figsize=(10.4, 3.7 * rows + 0.7), layout="constrained")
    for panel, (case, groups) in zip(axes.flat, cases.items()):
        entries = [(f"N = {n}", _look(n), one) for n, one in groups.items()]
        _curves(panel, entries)
        name = f"{case} ({PAPERS[case]})" if case in PAPERS else case
        panel.set_title(f"{name}\n{_verdict(groups)}")
    _scales(axes[0, 0])
    figure.supxlabel("distance at rest from the nearest pinned vertex (m; the sheet is 1 m wide)", fontsize=9)
    figure.supylabel("stretch σ₁ − 1", fontsize=9)
    figure.suptitle(title, x=0.01, ha="left", fontsize=10)
    return style.save(figure, out, file)


def _look(n):
    return LOOKS.get(n, (style.INK, "v"))


def _verdict(groups):
    """Which N fail, and where, as text."""
    failed = [one for one in groups.values() if one.failed]
    if not failed:
        largest = max((one.whole.median for one in groups.values()), default=np.nan)
        return f"fails at no N: the largest is {style.number(largest, 2)}"
    where = sorted({f"{end([one.in_cells for one in failed]):.1f}" for end in (min, max)}, key=float)
    onward = [n for n in groups if n >= failed[0].n] == [one.n for one in failed]
    which = f"from N = {failed[0].n} on" if onward else f"at N = {', '.join(str(one.n) for one in failed)}"
    return f"fails {which}, {' to '.join(where)} cells away"


def _curves(panel, entries):
    """Draws (name, look, Group) of a panel, and lists their largest in its upper right corner."""
    panel.axhline(WRONG, color=style.GREY, linewidth=1, zorder=0)
    for line, (name, look, one) in enumerate(reversed(entries)):
        _curve(panel, one, *look)
        y = 0.965 - 0.058 * line
        panel.plot(0.98, y, look[1], color=look[0], markersize=5, transform=panel.transAxes, zorder=6)
        panel.text(0.955, y, f"{name}: {style.number(one.whole.median, 2)} at {one.in_cells:.1f} cells",
                   color=look[0], transform=panel.transAxes, va="center", ha="right", fontsize=8.3)
    ends = [one.reach * one.cell for _, _, one in entries if np.isfinite(one.reach)]
    if ends:
        panel.text(min(ends) * 0.85, REACH_TOP, "n cells:\nthe pin's springs end", fontsize=7.5,
                   color=style.GREY, ha="right", va="top", transform=panel.get_xaxis_transform())


def _curve(panel, one, colour, marker):
    """Draws a Group: the largest and the usual stretch in each bin, and where the largest of all is."""
    style.with_range(panel, one.middles, one.worst, color=colour, linewidth=1.4)
    median = np.array([s.median for s in one.worst])
    known, near = np.isfinite(median), one.middles <= NEAR * one.cell
    for chosen, face in ((known & near, colour), (known & ~near, "white")):
        panel.plot(one.middles[chosen], median[chosen], marker, color=colour, markerfacecolor=face,
                   markersize=4.5)
    panel.plot(one.middles[known], one.usual[known], color=colour, linewidth=0.8, alpha=0.45)
    if np.isfinite(one.reach):
        panel.axvline(one.reach * one.cell, ymax=REACH_TOP, color=colour, linewidth=1.1, linestyle=":",
                      zorder=0)
    at, (low, high) = one.place.median, one.range
    panel.errorbar(at, one.whole.median, xerr=[[max(at - low, 0)], [max(high - at, 0)]], color=colour,
                   marker="*", markersize=15, markeredgecolor="white", capsize=2, elinewidth=1.2, zorder=5)


def _scales(panel):
    """Logarithmic axes, with room for the list of the largest."""
    style.plain_log(panel)
    style.plain_log(panel, "x")
    low, high = panel.get_ylim()
    panel.set_ylim(max(low, 1e-3), high * (high / max(low, 1e-3)) ** 0.25)


def _cause(cases, rounded, scaled, out):
    """Draws the curves of three n on one mesh, and the ring of the most stretched triangle over n."""
    figure, (left, right) = plt.subplots(1, 2, figsize=(10.4, 4.3), layout="constrained")
    entries = [(f"n × {k} = {one.reach:g}", SCALED[k], one) for k, one in scaled.items()]
    _curves(left, entries)
    _scales(left)
    left.set_xlabel("distance at rest from the nearest pinned vertex (m)")
    left.set_ylabel("stretch σ₁ − 1")
    known = [*cases.values(), *rounded.values(), *(one for k, one in scaled.items() if k > 1)]
    n, places = (", ".join(texts) for texts in zip(*((f"{one.reach:g}", f"{one.in_cells:.1f}")
                                                     for one in scaled.values())))
    left.set_title(f"N = {entries[0][2].n}, n = {n}: the largest is {places} cells away")
    _rings(right, known)
    last = [one for one in known if one.failed]
    right.set_title(f"{sum(map(_at_end, last))} of {len(last)} settings that fail do so where the pin's "
                    "springs end")
    return style.save(figure, out, "fig_where_cause")


def _rings(panel, known):
    """Draws the ring of the most stretched triangle's farthest corner over n, where the pin's springs end."""
    ends = np.array([2.5, 25])
    panel.fill_between(ends, ends, ends + 1, color=style.GRID, zorder=0)
    panel.annotate("n to n + 1: the end of\nthe pin's springs", (6.2, 6.9), xytext=(3.2, 14), fontsize=8.3,
                   color=style.GREY, arrowprops=dict(arrowstyle="-", color=style.GREY, linewidth=0.8))
    meshes = sorted({one.n for one in known})
    for one in known:
        colour, marker = _look(one.n)
        same = sorted({other.n for other in known if other.reach == one.reach})
        beside = 1.04 ** (same.index(one.n) - (len(same) - 1) / 2)  # else one mesh hides another
        low, high = one.rings
        panel.errorbar(one.reach * beside, one.ring, yerr=[[one.ring - low], [high - one.ring]], color=colour,
                       marker=marker, markerfacecolor=colour if one.failed else "white", markersize=7,
                       capsize=2, elinewidth=1)
    for n in meshes:
        panel.plot([], [], _look(n)[1], color=_look(n)[0], label=f"N = {n}")
    panel.plot([], [], "o", color=style.GREY, markerfacecolor="white", label="does not fail (below 1)")
    panel.legend(loc="lower right", bbox_to_anchor=(1, 0.07), ncols=2)  # above what fails at the pin
    for which in "xy":
        style.plain_log(panel, which)
    panel.set_xlim(2.5, 25)
    for axis in (panel.xaxis, panel.yaxis):
        ticks = [3, 5, 7, 10, 15, 20] if axis is panel.xaxis else [1, 2, 3, 5, 7, 10, 15, 20]
        axis.set_ticks(ticks, labels=[str(tick) for tick in ticks])
    panel.set_xlabel("n: rings that the springs of a pinned vertex reach")
    panel.set_ylabel("ring of the most stretched triangle's farthest corner")


def _text(cases):
    known = [one for groups in cases for one in groups.values()]
    check = (f" The largest σ₁ found here agrees with the program's own measure, max_stretch, to "
             f"{style.number(max(one.disagreement for one in known), 2)} of it in every frame."
             if known else "")
    return ("The verdicts of Fig. 5 look at the pin. A cloth whose pin is sound has still failed if it is "
            "torn elsewhere. Here σ₁ of every triangle is computed from its positions and shown over its "
            "distance at rest from the nearest pinned vertex. Triangles whose three corners are pinned are "
            "left out: they cannot stretch." + check)


def _table(cases, caption):
    ranged = lambda s: style.number(s.median, 2) + (
        f" ({style.number(s.low, 2)} – {style.number(s.high, 2)})" if s.count > 1 else "")
    rows = [[case, one.n, ranged(one.near), ranged(one.far), ranged(one.whole),
             f"{style.number(one.place.median, 2)} ({one.in_cells:.1f})",
             f"{style.number(one.range[0] / one.cell, 2)} – {style.number(one.range[1] / one.cell, 2)}",
             f"{one.ring:g}", f"{one.reach:g}" if np.isfinite(one.reach) else "–",
             ", ".join(f"{count} {status}" for status, count in one.status.items())]
            for case, groups in cases.items() for one in groups.values()]
    return Table(f"{caption}. Distances are at rest, from the nearest pinned vertex.",
                 ["case", "N", f"largest stretch − 1 within {NEAR:g} cells", "beyond", "anywhere",
                  "where the largest is, m (cells)", "it wanders over (cells)",
                  "ring of its farthest corner", "n", "runs"], rows)


def _claims(adaptive, crossover, others):
    """Whether cloth is sound beyond the pin too, where it fails, and whether crossover springs are worse.

    `others`: adaptive Groups with another n.
    """
    both = [n for n in adaptive if n in crossover]
    failed = [one for one in [*adaptive.values(), *others] if one.failed]
    setting = "one substep of 10 iterations, without damping"
    less = [getattr(adaptive[n], part).median < getattr(crossover[n], part).median
            for n in both for part in ("near", "far")]
    return [Claim("5b", "Adaptive springs keep the whole cloth from failing, and not only the pin.",
                  "with the 1-ring pinned, the median of the largest stretch − 1 anywhere stays below 1 "
                  "(twice as long) at every N", _numbers(adaptive),
                  not any(one.failed for one in adaptive.values()) if adaptive else None, setting=setting),
            Claim("5b", "Our question: has the failure moved, to where the springs of the pin end?",
                  "wherever adaptive springs with the 1-ring fail (at any N, either reading of eq. 6, n × 1, "
                  f"2 or 4), the largest within {NEAR:g} cells of the pinned vertices is smaller than the "
                  "largest beyond, and the most stretched triangle has its farthest corner in ring n of the "
                  "pinned vertices, the last that their springs reach, or in the next",
                  {f"N = {one.n}, n = {one.reach:g}: ring, within {NEAR:g} cells, beyond": [
                      one.ring, one.near.median, one.far.median] for one in failed},
                  all(map(_moved, failed)) if failed else None, _pin_note(failed), setting=setting),
            Claim("5", "Our question: with the same pins, does cloth stretch less with adaptive springs than "
                  "with crossover springs, at the pin and beyond?",
                  "with the 1-ring pinned in both, at every N the median of the largest stretch − 1 is "
                  f"smaller with adaptive springs, both within {NEAR:g} cells of the pinned vertices and "
                  "beyond",
                  {f"{case}, {name}": value for case, groups in ((MENDED, crossover), (ADAPTIVE, adaptive))
                   for name, value in _numbers(groups).items()},
                  all(less) if less else None, setting=setting)]


def _numbers(groups):
    """The medians at the pin and beyond, by N."""
    return {f"N = {one.n}: within {NEAR:g} cells, beyond": [one.near.median, one.far.median]
            for one in groups.values()}


def _at_end(one):
    """Whether the most stretched triangle lies where the pin's springs end."""
    return one.reach <= one.ring <= one.reach + 1


def _moved(one):
    """Whether the failure is where the pin's springs end, and larger than at the pin."""
    return _at_end(one) and one.near.median < one.far.median


def _pin_note(failed):
    """Says where the pin has failed besides."""
    still = [f"N = {one.n}, n = {one.reach:g} ({style.number(one.near.median, 2)})" for one in failed
             if one.near.median > WRONG]
    return f"The pin itself has failed too at {'; '.join(still)}." if still else ""


if __name__ == "__main__":
    figure_main(main)
