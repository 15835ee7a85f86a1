"""A page of one's own beside the committed one: which verdicts, runs and numbers agree, and how well.

`./bendlab reproduce` ends with this table. By hand: python3 analysis/committed.py results/own/paper
"""
import argparse
import json
import math
from dataclasses import dataclass, field
from pathlib import Path

COMMITTED = Path(__file__).resolve().parent.parent / "results"  # the folder of the committed pages
OWN = "own"  # below it, and ignored by git: the pages of whoever runs the scripts
ROUNDING = 1e-3  # relative: numbers that agree so well agree to rounding
MOST, FEW = 20, 8  # lines of a list on the terminal, and of what was not run
OPEN = "open"
KEYS = ("figure", "claim", "setting", "check", "case", "experiment", "point", "model", "mesh", "precision",
        "method", "command")  # what tells an object of a page's data from the others, in their order
NOT_TOLD = ("command", "figure", "setting")  # too long, or of no help, in a line
HOLDS = {True: "holds", False: "does not hold", None: OPEN}
OF_THE_MACHINE = ("CPU", "seconds", "ms per frame")  # in the names of numbers that measure time


@dataclass
class Row:
    """One verdict of a page, and the numbers behind it."""

    label: str
    verdict: str
    numbers: dict = field(default_factory=dict)


@dataclass
class Comparison:
    """What a page says beside the committed one."""

    verdicts: list  # (label, committed, own) of those that differ
    same_verdicts: int
    not_made: int  # verdicts of the committed page that the other one lacks, or has open
    exact: int  # numbers that agree in all digits that both pages keep
    rounded: int  # numbers that agree within ROUNDING
    numbers: list  # (label, committed, own), the others, those that differ most first
    same_bits: int  # runs
    other_bits: int
    runs_not_made: int


def is_own(out):
    """Whether `out` is the folder of a page of one's own, results/own/paper for example."""
    return Path(out).parent.name == OWN


def home(name, committed):
    """Where the scripts write a page unless they are told."""
    return Path("results") / name if committed else Path("results") / OWN / name


def compared(committed, own):
    """The Comparison of two folders of a page; None if one has no data."""
    theirs, mine = rows_of(committed), rows_of(own)
    if not theirs or not mine:
        return None
    found = Comparison([], 0, 0, 0, 0, [], 0, 0, 0)
    digits = min(_digits(theirs), _digits(mine))
    for key, row in theirs.items():
        other = mine.get(key, Row(row.label, OPEN))
        found.same_verdicts += row.verdict == other.verdict
        found.not_made += other.verdict == OPEN != row.verdict
        if row.verdict != other.verdict:
            found.verdicts.append((row.label, row.verdict, other.verdict))
        if other.verdict != OPEN:
            _compare_numbers(row, other, digits, found)
    found.numbers.sort(key=lambda each: -_apart(each[1], each[2]))
    _compare_bits(_bits(committed), _bits(own), found)
    return found


def _compare_numbers(row, other, digits, found):
    for name in row.numbers.keys() & other.numbers.keys():
        one, two = row.numbers[name], other.numbers[name]
        if any(word in name for word in OF_THE_MACHINE) or None in (one, two):
            continue
        if f"{one:.{digits}g}" == f"{two:.{digits}g}":
            found.exact += 1
        elif _apart(one, two) <= ROUNDING:
            found.rounded += 1
        else:
            found.numbers.append((f"{row.label}: {name}", one, two))


def _digits(rows):
    """How many digits of its numbers a page keeps, 4 at least: an older one keeps fewer."""
    return max((4, *(len(f"{value:.9g}".split("e")[0].replace(".", "").replace("-", "").lstrip("0"))
                for row in rows.values() for value in row.numbers.values() if value is not None)))


def _apart(one, two):
    """The relative difference of two numbers."""
    return abs(one - two) / max(abs(one), abs(two)) if math.isfinite(one) and math.isfinite(two) else math.inf


def _compare_bits(theirs, mine, found):
    for place, bits in theirs.items():
        if place not in mine:
            found.runs_not_made += 1
        elif mine[place] == bits:
            found.same_bits += 1
        else:
            found.other_bits += 1


# --- what a page keeps -------------------------------------------------------------------------------------

def rows_of(folder):
    """Key → Row of everything that a page judges."""
    sections = _read(folder / "page.json")
    objects = [entry for section in sections for kind in ("claims", "checks") for entry in section[kind]]
    for name in ("summary.json", "methods.json"):
        objects += [entry for entry in _read(folder / name) if {"verdict", "status"} & entry.keys()]
    rows = {}
    for entry in objects:
        rows[_key(entry)] = Row(_label(entry), _verdict(entry), _numbers(entry))
    for section in sections:
        for each in section["maps"]:
            rows |= _cells(each)
    return rows


def _read(file):
    return json.loads(file.read_text(encoding="utf-8")) if file.exists() else []


def _key(entry):
    return json.dumps([entry.get(name) for name in KEYS], sort_keys=True)


def _label(entry):
    told = [entry[name] for name in KEYS if entry.get(name) and name not in NOT_TOLD]
    if not told and "settings" in entry:  # of a run that its command alone tells
        told = [", ".join(f"{name} {value}" for name, value in entry["settings"].items())]
    return ", ".join(each if isinstance(each, str) else json.dumps(each, ensure_ascii=False) for each in told)


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
    """Name → number; a list gives several."""
    found = {name: value for name, value in entry.items() if name.startswith("error_") or name == "measured"}
    found |= entry.get("numbers", {})
    if isinstance(entry.get("worst"), dict):
        found[entry["worst"]["what"]] = entry["worst"]["value"]
    flat = {}
    for name, value in found.items():
        values = value if isinstance(value, list) else [value]
        flat |= {f"{name} ({i + 1})" if len(values) > 1 else name: _number(each)
                 for i, each in enumerate(values)}
    return flat


def _number(value):
    """What JSON keeps of a number; None for text and NaN."""
    if value in ("inf", "-inf"):
        return float(value)
    known = isinstance(value, (int, float)) and not isinstance(value, bool) and value == value
    return float(value) if known else None


def _cells(kept):
    """Key → Row of the cells of a map of verdicts."""
    rows = {}
    for cell in kept["cells"]:
        place = [cell[name] for name in ("rounding", "damping", "solver", "pins", "cells")]
        label = f"{kept['english']} ({', '.join(str(each) for each in place if each)})"
        verdict = OPEN if cell["open"] else "nothing to judge" if cell["holds"] is None \
            else HOLDS[cell["holds"]]
        try:
            numbers = {"the number of the cell": float(cell["text"])}
        except ValueError:
            numbers = {}
        rows[json.dumps([kept["figure"], kept["english"], place])] = Row(label, verdict, numbers)
    return rows


def _bits(folder):
    """(config, place on its sweep) → the run's bits, see report.Section.bits."""
    return {(config, place): bits for section in _read(folder / "page.json")
            for config, runs in section.get("bits", {}).items() for place, bits in runs.items()}


# --- as text and tables ------------------------------------------------------------------------------------

def summary_rows(found):
    """(what, how many agree, how many do not, how many are not made here)."""
    changed = len(found.verdicts) - found.not_made
    rows = [("verdicts", found.same_verdicts, changed, found.not_made),
            ("numbers, equal in all digits kept", found.exact, found.rounded + len(found.numbers), ""),
            (f"numbers, equal to rounding ({100 * ROUNDING:g} %)", found.exact + found.rounded,
             len(found.numbers), "")]
    if found.same_bits + found.other_bits + found.runs_not_made:
        rows.insert(1, ("runs, equal to the bit", found.same_bits, found.other_bits, found.runs_not_made))
    return rows


def text(found):
    """The comparison for a terminal."""
    rows = [("committed → mine", "agree", "do not", "not made here"),
            *(tuple(map(str, row)) for row in summary_rows(found))]
    widths = [max(len(row[i]) for row in rows) for i in range(4)]
    lines = ["  ".join([row[0].ljust(widths[0]), *(cell.rjust(width) for cell, width in
                                                  zip(row[1:], widths[1:]))]).rstrip() for row in rows]
    lines += _cause(found)
    changed = [each for each in found.verdicts if each[2] != OPEN]
    opened = [each for each in found.verdicts if each[2] == OPEN]
    for title, some, most in (("Verdicts that are others:", changed, MOST),
                              ("Verdicts that are open here, because their runs are not made:", opened, FEW)):
        lines += _listed(title, [f"{committed} → {own}: {label}" for label, committed, own in some], most)
    lines += _listed("Numbers that are others, those that differ most first:",
                     [f"{committed:.4g} → {own:.4g}: {label}" for label, committed, own in found.numbers],
                     MOST)
    return "\n".join(lines)


def _cause(found):
    """Why verdicts and numbers are others, where the runs made here are not."""
    if found.other_bits or not found.runs_not_made or not found.same_bits:
        return []
    return ["", f"All {found.same_bits} runs made here are those of the committed page, to the bit. What is "
            f"another number or verdict rests also on its {found.runs_not_made} runs that are not made here, "
            "of finer meshes most of all: --full makes them."]


def _listed(title, lines, most):
    if not lines:
        return []
    more = [f"  … and {len(lines) - most} more"] if len(lines) > most else []
    return ["", title, *(f"  {_shortened(line)}" for line in lines[:most]), *more]


def _shortened(line, most=160):
    """What stands in brackets at its end tells cells of one claim apart, and stays."""
    if len(line) <= most:
        return line
    end = line[line.rindex(" ("):] if line.endswith(")") and " (" in line else ""
    return f"{line[:max(20, most - 2 - len(end))]} …{end}"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("page", type=Path, help="folder of a page of your own")
    arguments = parser.parse_args()
    own = arguments.page.resolve()
    found = compared(COMMITTED / own.name, own)
    if found is None:
        print(f"{own} has nothing to be compared with {COMMITTED / own.name}")
    else:
        print(text(found))


if __name__ == "__main__":
    main()
