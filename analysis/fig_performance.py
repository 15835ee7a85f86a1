"""Cost of a constraint over the size of the cloth, from `bendlab bench --json`."""
import argparse
import json
import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import style

ROOT = Path(__file__).resolve().parent.parent
KINDS = {"strain": ("strain triangle", style.SEQUENCE[0]),
         "crossover": ("crossover spring", style.SEQUENCE[1]),
         "dense": ("spring of dense rings", style.SEQUENCE[2])}
SCALARS = {"float": dict(ls="-", marker="o"), "double": dict(ls="--", marker="s", mfc="white")}


def main(bench, out):
    """Draws the figure; returns its title."""
    rows = series(bench["rows"])
    if not any((kind, scalar) in rows for kind in KINDS for scalar in SCALARS):
        raise ValueError("no kernels among the rows")
    figure, axes = plt.subplots(figsize=(7.6, 4.6), layout="constrained")
    for kind, (name, colour) in KINDS.items():
        for scalar, look in SCALARS.items():
            _line(axes, rows.get((kind, scalar), []), f"{name}, {scalar}", color=colour, **look)
            _oracle(axes, rows.get((f"{kind}_oracle", scalar), []), colour, look)
    if any(kind.endswith("_oracle") for kind, _ in rows):
        axes.plot([], [], ls="none", marker="x", color=style.GREY,
                  label="the same, oracle (scalar code) in mesh order")
    style.plain_log(axes, "y")
    axes.set_xscale("log")
    axes.set_xlabel("vertices")
    axes.set_ylabel("time per constraint and projection (ns)")
    title = title_of(rows)
    axes.set_title(title)
    context = bench["context"]
    axes.text(0, -0.16, f"{context['processor']}, {context['vector_bits']} bits, {context['compiler']}, one "
              f"thread, {context['date'][:10]}; medians; bars: lowest to highest", transform=axes.transAxes,
              fontsize=7.5, color=style.GREY, va="top")
    axes.legend(loc="center left", bbox_to_anchor=(1.01, 0.5))
    style.save(figure, out, "fig_performance")
    return title


def series(rows):
    """(kind, scalar) → timed rows of one thread, sorted by vertices."""
    found = {}
    for row in rows:
        kind = row["name"].split("/")[0]
        if row["threads"] == 1 and row["ns_per_constraint"] is not None:
            found.setdefault((kind, row["scalar"]), []).append(row)
    return {key: sorted(some, key=lambda row: row["vertices"]) for key, some in found.items()}


def title_of(rows):
    """The title: cost, speed relative to the oracle, and growth from 10⁴ vertices to the largest cloth."""
    parts = []
    for kind in ("strain", "crossover"):
        some = [row for row in rows.get((kind, "float"), []) if row["vertices"] > 1e4]
        if len(some) > 1:
            first, last = some[0], some[-1]
            parts.append(f"{KINDS[kind][0]}: {first['ns_per_constraint']:.1f} ns, "
                         f"{first['ratio_to_oracle']:.0f} times as fast as the oracle; × "
                         f"{last['ns_per_constraint'] / first['ns_per_constraint']:.2f} from "
                         f"{first['vertices']:,} to {last['vertices']:,} vertices")
    return "\n".join(parts) or "Time per constraint"


def _line(axes, rows, label, **look):
    if not rows:
        return
    at, middle, low, high = (np.array([row[key] for row in rows], float)
                             for key in ("vertices", "ns_per_constraint", "ns_lowest", "ns_highest"))
    axes.errorbar(at, middle, yerr=[middle - low, high - middle], label=label, capsize=2.5, elinewidth=1,
                  **look)


def _oracle(axes, rows, colour, look):
    is_float = look["ls"] == "-"
    for row in rows:
        at = row["vertices"], row["ns_per_constraint"]
        axes.plot(*at, "x", color=colour, mew=1.8 if is_float else 0.9, ms=7)
        axes.annotate(row["scalar"], at, xytext=(-7 if is_float else 7, 0), textcoords="offset points",
                      color=colour, fontsize=7.5, ha="right" if is_float else "left", va="center")


def _arguments():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("bench", nargs="?", type=Path, default=ROOT / "results/performance/bench.json",
                        help="what `bendlab bench --json` printed (default: %(default)s)")
    parser.add_argument("--out", type=Path, help="folder of the picture (default: beside the file)")
    return parser.parse_args()


if __name__ == "__main__":
    arguments = _arguments()
    try:
        print(main(json.loads(arguments.bench.read_text()), arguments.out or arguments.bench.parent))
    except (OSError, ValueError) as error:
        sys.exit(f"{arguments.bench}: {error}; make it with: bendlab bench --json > {arguments.bench}")
