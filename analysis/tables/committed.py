"""Compares a page of your own runs with the committed page: which verdicts, runs and numbers agree, and how
well.

`./bendlab reproduce` prints this comparison at its end. To print only the comparison:
python3 analysis/compare_pages.py results/own/paper
"""
import argparse
import json
import math
from dataclasses import dataclass, field
from pathlib import Path

COMMITTED = Path(__file__).resolve().parents[2] / "results"  # the folder of the committed pages
OWN = "own"  # the folder below it with the pages of your own runs; git ignores it
ROUNDING = 1e-3  # largest relative difference of numbers that agree to rounding
MOST, FEW = 20, 8  # most lines of a list on the terminal, and of the list of open verdicts
OPEN = "open"
KEYS = ("figure", "claim", "setting", "check", "case", "experiment", "point", "model", "mesh", "precision",
        "method", "command")  # entries that together identify an object of a page's data
NOT_IN_LABEL = ("command", "figure", "setting")  # too long for a label, or not useful in it
HOLDS = {True: "holds", False: "does not hold", None: OPEN}
OF_THE_MACHINE = ("CPU", "seconds", "ms per frame")  # in the names of numbers that measure time


@dataclass
class Row:
    """One verdict of a page, and the numbers from which it follows."""

    label: str
    verdict: str
    numbers: dict = field(default_factory=dict)


@dataclass
class Comparison:
    """How a page differs from the committed page."""

    verdicts: list  # (label, committed, own) of the verdicts that differ
    same_verdicts: int
    not_made: int  # verdicts of the committed page that your page lacks, or has open
    exact: int  # numbers that agree in all digits that both pages keep
    rounded: int  # numbers that agree within ROUNDING
    numbers: list  # (label, committed, own) of the other numbers, largest difference first
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
    comparison = Comparison([], 0, 0, 0, 0, [], 0, 0, 0)
    digits = min(_digits(theirs), _digits(mine))
    for key, row in theirs.items():
        other = mine.get(key, Row(row.label, OPEN))
        comparison.same_verdicts += row.verdict == other.verdict
        comparison.not_made += other.verdict == OPEN != row.verdict
        if row.verdict != other.verdict:
            comparison.verdicts.append((row.label, row.verdict, other.verdict))
        if other.verdict != OPEN:
            _compare_numbers(row, other, digits, comparison)
    comparison.numbers.sort(key=lambda entry: -_apart(entry[1], entry[2]))
    _compare_bits(_bits(committed), _bits(own), comparison)
    return comparison


def _compare_numbers(row, other, digits, comparison):
    for name in row.numbers.keys() & other.numbers.keys():
        a, b = row.numbers[name], other.numbers[name]
        if any(word in name for word in OF_THE_MACHINE) or None in (a, b):
            continue
        if f"{a:.{digits}g}" == f"{b:.{digits}g}":
            comparison.exact += 1
        elif _apart(a, b) <= ROUNDING:
            comparison.rounded += 1
        else:
            comparison.numbers.append((f"{row.label}: {name}", a, b))


def _digits(rows):
    """The largest number of digits of a number on a page, at least 4. Older pages have fewer digits."""
    return max((4, *(len(f"{value:.9g}".split("e")[0].replace(".", "").replace("-", "").lstrip("0"))
                for row in rows.values() for value in row.numbers.values() if value is not None)))


def _apart(a, b):
    """The relative difference of two numbers."""
    return abs(a - b) / max(abs(a), abs(b)) if math.isfinite(a) and math.isfinite(b) else math.inf


def _compare_bits(theirs, mine, comparison):
    for place, bits in theirs.items():
        if place not in mine:
            comparison.runs_not_made += 1
        elif mine[place] == bits:
            comparison.same_bits += 1
        else:
            comparison.other_bits += 1


# --- the data of a page ------------------------------------------------------------------------------------

def rows_of(folder):
    """Key → Row of every verdict of a page."""
    sections = _read(folder / "page.json")
    objects = [entry for section in sections for kind in ("claims", "checks") for entry in section[kind]]
    for name in ("summary.json", "methods.json"):
        objects += [entry for entry in _read(folder / name) if {"verdict", "status"} & entry.keys()]
    rows = {}
    for entry in objects:
        rows[_key(entry)] = Row(_label(entry), _verdict(entry), _numbers(entry))
    for section in sections:
        for claim_map in section["maps"]:
            rows |= _cells(claim_map)
    return rows


def _read(file):
    return json.loads(file.read_text(encoding="utf-8")) if file.exists() else []


def _key(entry):
    return json.dumps([entry.get(name) for name in KEYS], sort_keys=True)


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
    if "holds" in entry:
        return HOLDS[entry["holds"]]
    measured, expected = _number(entry["measured"]), _number(entry["expected"])  # a check
    if measured is None:
        return OPEN
    if entry["kind"] == "most":
        return HOLDS[measured <= expected]
    bound = entry["tolerance"] * (expected if entry["kind"] == "relative" else 1)
    return HOLDS[abs(measured - expected) <= bound]


def _numbers(entry):
    """Name → number. A list of n numbers becomes n names with a number."""
    numbers = {name: value for name, value in entry.items()
               if name.startswith("error_") or name == "measured"}
    numbers |= entry.get("numbers", {})
    if isinstance(entry.get("worst"), dict):
        numbers[entry["worst"]["what"]] = entry["worst"]["value"]
    flat = {}
    for name, value in numbers.items():
        values = value if isinstance(value, list) else [value]
        flat |= {f"{name} ({i + 1})" if len(values) > 1 else name: _number(item)
                 for i, item in enumerate(values)}
    return flat


def _number(value):
    """A value of JSON as a number; None for text and NaN."""
    if value in ("inf", "-inf"):
        return float(value)
    known = isinstance(value, (int, float)) and not isinstance(value, bool) and value == value
    return float(value) if known else None


def _cells(kept):
    """Key → Row of the cells of a map of verdicts."""
    rows = {}
    for cell in kept["cells"]:
        place = [cell[name] for name in ("rounding", "damping", "solver", "pins", "cells")]
        label = f"{kept['english']} ({', '.join(str(answer) for answer in place if answer)})"
        verdict = OPEN if cell["open"] else "nothing to judge" if cell["holds"] is None \
            else HOLDS[cell["holds"]]
        try:
            numbers = {"the number of the cell": float(cell["text"])}
        except ValueError:
            numbers = {}
        rows[json.dumps([kept["figure"], kept["english"], place])] = Row(label, verdict, numbers)
    return rows


def _bits(folder):
    """(config, point of its sweep) → the hash of the run at this point, see section.Section.bits."""
    return {(config, place): bits for section in _read(folder / "page.json")
            for config, runs in section.get("bits", {}).items() for place, bits in runs.items()}


# --- the comparison as text --------------------------------------------------------------------------------

def summary_rows(comparison):
    """Rows of (what is compared, how many agree, how many differ, how many your page lacks)."""
    changed = len(comparison.verdicts) - comparison.not_made
    rows = [("verdicts", comparison.same_verdicts, changed, comparison.not_made),
            ("numbers, equal in all digits kept", comparison.exact,
             comparison.rounded + len(comparison.numbers), ""),
            (f"numbers, equal to rounding ({100 * ROUNDING:g} %)", comparison.exact + comparison.rounded,
             len(comparison.numbers), "")]
    if comparison.same_bits + comparison.other_bits + comparison.runs_not_made:
        rows.insert(1, ("runs, equal to the bit", comparison.same_bits, comparison.other_bits,
                        comparison.runs_not_made))
    return rows


def text(comparison):
    """The comparison for a terminal."""
    rows = [("committed → mine", "agree", "do not", "not made here"),
            *(tuple(map(str, row)) for row in summary_rows(comparison))]
    widths = [max(len(row[i]) for row in rows) for i in range(4)]
    lines = ["  ".join([row[0].ljust(widths[0]), *(cell.rjust(width) for cell, width in
                                                  zip(row[1:], widths[1:]))]).rstrip() for row in rows]
    lines += _cause(comparison)
    changed = [verdict for verdict in comparison.verdicts if verdict[2] != OPEN]
    opened = [verdict for verdict in comparison.verdicts if verdict[2] == OPEN]
    for title, verdicts, most in (
            ("Verdicts that differ:", changed, MOST),
            ("Verdicts that are open on your page, because it lacks runs:", opened, FEW)):
        lines += _listed(title, [f"{committed} → {own}: {label}" for label, committed, own in verdicts], most)
    lines += _listed("Numbers that differ, the largest difference first:",
                     [f"{committed:.4g} → {own:.4g}: {label}"
                      for label, committed, own in comparison.numbers], MOST)
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


def _shortened(line, most=160):
    """The line cut to `most` characters. Brackets at the end of the line stay, because the lines of a claim
    differ only there."""
    if len(line) <= most:
        return line
    end = line[line.rindex(" ("):] if line.endswith(")") and " (" in line else ""
    return f"{line[:max(20, most - 2 - len(end))]} …{end}"


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
