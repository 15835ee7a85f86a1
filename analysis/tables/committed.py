"""Compares a page of your own runs with the committed page: which verdicts, runs and numbers agree, and how
well.

`./bendlab reproduce` prints this comparison at its end. To print only the comparison:
python3 analysis/compare_pages.py results/own/paper
"""
import argparse
import json
import math
from collections import namedtuple
from dataclasses import dataclass
from pathlib import Path

from tables.numbers import known_values
from tables.section import Check, read_objects

COMMITTED = Path(__file__).resolve().parents[2] / "results"  # the folder of the committed pages
OWN = "own"  # the folder below it with the pages of your own runs; git ignores it
ROUNDING = 1e-3  # largest relative difference of numbers that agree to rounding
MOST, FEW, MOST_TEXT = 20, 8, 160  # lines of a list, lines of the list of open verdicts, characters of a line
OPEN = "open"
KEYS = ("figure", "claim", "setting", "check", "case", "experiment", "point", "model", "mesh", "precision",
        "method", "command")  # entries that together identify an object of a page's data
NOT_IN_LABEL = ("command", "figure", "setting")  # too long for a label, or not useful in it
HOLDS = {True: "holds", False: "does not hold", None: OPEN}
OF_THE_MACHINE = ("CPU", "seconds", "ms per frame", "time for the same error")  # in names of times
Row = namedtuple("Row", "label verdict numbers")  # of a page: a verdict, and the numbers that it follows from


@dataclass
class Comparison:
    """How a page differs from the committed page."""

    verdicts: list  # (label, committed, own) of the verdicts that differ
    same_verdicts: int
    not_made: int  # verdicts of the committed page that your page lacks, or has open
    exact: int  # numbers that agree in all digits that both pages keep
    rounded: int  # numbers that agree within ROUNDING
    numbers: list  # (label, committed, own) of the other numbers, largest difference first
    lost: list  # (label, committed, None) of the numbers that only your page lacks
    same_bits: int  # number of runs that are equal to the last bit
    other_bits: int  # number of runs that differ
    runs_not_made: int  # number of runs that your page lacks


def is_own(out):
    """Whether `out` is the folder of a page of your own runs, for example results/own/paper."""
    return Path(out).parent.name == OWN


def home(name, committed):
    """The folder to which the scripts write a page by default."""
    return Path("results") / name if committed else Path("results") / OWN / name


def compared(committed, own):
    """Compares the folders of the committed page and of your page; None if either folder has no data."""
    theirs, mine = rows_of(committed), rows_of(own)
    if not theirs or not mine:
        return None
    pairs = [(row, mine.get(key, Row(row.label, OPEN, {}))) for key, row in theirs.items()]
    verdicts = [(row.label, row.verdict, other.verdict) for row, other in pairs
                if row.verdict != other.verdict]
    known = [(f"{row.label}: {name}", number, other.numbers.get(name))
             for row, other in pairs if other.verdict != OPEN for name, number in row.numbers.items()
             if number is not None and not any(word in f"{row.label}: {name}" for word in OF_THE_MACHINE)]
    lost = [entry for entry in known if entry[2] is None]
    numbers = [entry for entry in known if entry[2] is not None]
    digits = min(_digits(theirs), _digits(mine))
    unequal = [entry for entry in numbers if f"{entry[1]:.{digits}g}" != f"{entry[2]:.{digits}g}"]
    far = [entry for entry in unequal if _apart(entry) > ROUNDING]
    runs, own_runs = _bits(committed), _bits(own)
    same_bits = [own_runs[place] == bits for place, bits in runs.items() if place in own_runs]
    return Comparison(
        verdicts, same_verdicts=len(pairs) - len(verdicts), not_made=sum(now == OPEN for *_, now in verdicts),
        exact=len(numbers) - len(unequal), rounded=len(unequal) - len(far),
        numbers=sorted(far, key=_apart, reverse=True), lost=lost, same_bits=sum(same_bits),
        other_bits=len(same_bits) - sum(same_bits), runs_not_made=len(runs) - len(same_bits))


def _digits(rows):
    """The largest number of digits of a number on a page, at least 4. Older pages have fewer digits."""
    return max((4, *(len(f"{value:.9g}".split("e")[0].replace(".", "").replace("-", "").lstrip("0"))
                for row in rows.values() for value in row.numbers.values() if value is not None)))


def _apart(entry):
    """The relative difference of the two numbers of (label, number, number)."""
    _, a, b = entry
    return abs(a - b) / max(abs(a), abs(b)) if math.isfinite(a) and math.isfinite(b) else math.inf


# --- the data of a page ------------------------------------------------------------------------------------

def rows_of(folder):
    """Key → Row of every verdict of a page. ValueError if two verdicts have one key."""
    sections = read_objects(folder / "page.json")
    objects = [entry for section in sections for kind in ("claims", "checks") for entry in section[kind]]
    for name in ("summary.json", "methods.json"):
        objects += [entry for entry in read_objects(folder / name) if {"verdict", "status"} & entry.keys()]
    rows = {}
    for entry in objects:
        key = json.dumps([entry.get(name) for name in KEYS], sort_keys=True)
        if key in rows:
            raise ValueError(f"{folder} has two verdicts with the name '{_label(entry)}'")
        rows[key] = Row(_label(entry), _verdict(entry), _numbers(entry))
    for section in sections:
        for claim_map in section["maps"]:
            rows |= _cells(claim_map)
    return rows


def _label(entry):
    parts = [entry[name] for name in KEYS if entry.get(name) and name not in NOT_IN_LABEL]
    if not parts and "settings" in entry:  # a run that only its command identifies
        parts = [", ".join(f"{name} {value}" for name, value in entry["settings"].items())]
    return ", ".join(part if isinstance(part, str) else json.dumps(part, ensure_ascii=False)
                     for part in parts)


def _verdict(entry):
    if "verdict" in entry:
        return entry["verdict"]
    if "status" in entry:
        return OPEN if entry["status"] == "missing" else entry["status"]
    return HOLDS[entry["holds"] if "holds" in entry else Check(**known_values(entry)).holds]


def _numbers(entry):
    """Name → number. A list of n numbers becomes n names with a number."""
    numbers = {name: value for name, value in entry.items() if name.startswith(("error_", "measured"))}
    numbers |= entry.get("numbers", {})
    if isinstance(entry.get("worst"), dict):
        numbers[entry["worst"]["what"]] = entry["worst"]["value"]
    lists = {name: value if isinstance(value, list) else [value] for name, value in numbers.items()}
    return {f"{name} ({place})" if len(values) > 1 else name: _number(value)
            for name, values in lists.items() for place, value in enumerate(values, 1)}


def _number(value):
    """A value of JSON as a number; None for text and NaN."""
    return float(value) if value in ("inf", "-inf") or type(value) in (int, float) else None


def _cells(kept):
    """Key → Row of the cells of a map of verdicts."""
    rows = {}
    for cell in kept["cells"]:
        place = [cell[name] for name in ("rounding", "damping", "solver", "pins", "cells")]
        label = f"{kept['english']} ({', '.join(str(answer) for answer in place if answer)})"
        verdict = "nothing to judge" if cell["holds"] is None and not cell["open"] else HOLDS[cell["holds"]]
        try:
            numbers = {"the number of the cell": float(cell["text"])}
        except ValueError:
            numbers = {}
        rows[json.dumps([kept["figure"], kept["english"], place])] = Row(label, verdict, numbers)
    return rows


def _bits(folder):
    """(config, point of its sweep) → the hash of the run at this point, see section.Section.bits."""
    return {(config, place): bits for section in read_objects(folder / "page.json")
            for config, runs in section.get("bits", {}).items() for place, bits in runs.items()}


# --- the comparison as text --------------------------------------------------------------------------------

def summary_rows(comparison):
    """Rows of (what is compared, how many agree, how many differ, how many your page lacks)."""
    changed = len(comparison.verdicts) - comparison.not_made
    bits = comparison.same_bits, comparison.other_bits, comparison.runs_not_made
    exact, rounded, far = comparison.exact, comparison.rounded, len(comparison.numbers)
    lost = len(comparison.lost)
    return [("verdicts", comparison.same_verdicts, changed, comparison.not_made),
            *([("runs, equal to the bit", *bits)] if any(bits) else []),
            ("numbers, equal in all digits kept", exact, rounded + far, lost),
            (f"numbers, equal to rounding ({100 * ROUNDING:g} %)", exact + rounded, far, lost)]


def text(comparison):
    """The comparison for a terminal."""
    rows = [("committed → mine", "agree", "do not", "not made here"),
            *(tuple(map(str, row)) for row in summary_rows(comparison))]
    width, *widths = [max(map(len, column)) for column in zip(*rows)]
    lines = ["  ".join([what.ljust(width), *map(str.rjust, cells, widths)]).rstrip() for what, *cells in rows]
    verdicts = lambda opened: [f"{theirs} → {mine}: {label}" for label, theirs, mine in comparison.verdicts
                               if (mine == OPEN) == opened]
    numbers = [f"{committed:.4g} → {own:.4g}: {label}" for label, committed, own in comparison.numbers]
    lines += _cause(comparison)
    lines += _listed("Verdicts that differ:", verdicts(False), MOST)
    lines += _listed("Verdicts that are open on your page, because it lacks runs:", verdicts(True), FEW)
    lines += _listed("Numbers that differ, the largest difference first:", numbers, MOST)
    lost = [f"{committed:.4g}: {label}" for label, committed, _ in comparison.lost]
    lines += _listed("Numbers that your page lacks:", lost, MOST)
    return "\n".join(lines)


def _cause(comparison):
    """Why verdicts and numbers may differ although all your runs equal the committed runs."""
    if comparison.other_bits or not comparison.runs_not_made or not comparison.same_bits:
        return []
    return ["", f"All {comparison.same_bits} of your runs equal the runs of the committed page, to the bit. "
                f"The numbers and verdicts that differ also depend on {comparison.runs_not_made} runs that "
                "your page lacks, most of them on finer meshes. --full computes these runs."]


def _listed(title, lines, most):
    if not lines:
        return []
    more = [f"  … and {len(lines) - most} more"] if len(lines) > most else []
    return ["", title, *(f"  {_shortened(line)}" for line in lines[:most]), *more]


def _shortened(line):
    """The line cut to MOST_TEXT characters. Brackets at its end stay, because the lines of a claim differ
    only there."""
    if len(line) <= MOST_TEXT:
        return line
    end = line[line.rindex(" ("):] if line.endswith(")") and " (" in line else ""
    return f"{line[:max(20, MOST_TEXT - 2 - len(end))]} …{end}"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("page", type=Path, help="folder of a page of your own")
    arguments = parser.parse_args()
    own = arguments.page.resolve()
    comparison = compared(COMMITTED / own.name, own)
    if comparison is None:
        print(f"{own} or {COMMITTED / own.name} has no verdicts to compare")
    else:
        print(text(comparison))
