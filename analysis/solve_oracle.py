#!/usr/bin/env python3
"""Computes all benchmarks of decks.py with CalculiX. Takes four minutes of processor time.

Writes results/verification/calculix.json: the version of CalculiX, and a row for each quantity, mesh and load
(field names: calculix.Value). `deck` names the input file in results/verification/calculix.
"""
import right_python  # noqa: F401  (first: it may hand over to another Python)
import gzip
import json
import re
import sys
from dataclasses import asdict
from pathlib import Path

from oracle import calculix, decks

RESULTS = Path(__file__).resolve().parents[1] / "results" / "verification"
LARGE = 8_000  # bytes; larger decks are compressed


def file_of(deck):
    """Name and content of the input file of a deck."""
    name = re.sub(r"\W+", "_", f"{deck.benchmark} {deck.element} {deck.mesh}").strip("_").lower() + ".inp"
    data = deck.text.encode("ascii")
    return (name + ".gz", gzip.compress(data, mtime=0)) if len(data) > LARGE else (name, data)


def rows_of(deck):
    """The rows of a deck for the results; none if CalculiX fails."""
    try:
        values = calculix.run_deck(deck)
    except calculix.CalculixError as error:
        print(error, file=sys.stderr)
        return []
    for value in values:
        print(f"{value.benchmark:28} {value.element:4} {value.mesh:22} {value.load:5.2f} {value.quantity:36}"
              f"{value.value:12.6g} {value.truth:12.6g} {value.seconds:7.2f} s", flush=True)
    return [{**asdict(value), "value": float(f"{value.value:.7g}"), "truth": float(f"{value.truth:.7g}"),
             "deck": file_of(deck)[0]} for value in values]


def write(version, computed):
    """Replaces the results. computed: pairs of a deck and its rows."""
    folder = RESULTS / "calculix"
    folder.mkdir(parents=True, exist_ok=True)
    for old in folder.glob("*.inp*"):
        old.unlink()
    for deck, rows in computed:
        if rows:
            name, data = file_of(deck)
            (folder / name).write_bytes(data)
    lines = ",\n".join("  " + json.dumps(row) for _, rows in computed for row in rows)
    (RESULTS / "calculix.json").write_text(
        f'{{"program": "CalculiX", "version": "{version}", "rows": [\n{lines}\n]}}\n', encoding="utf-8")


def main():
    try:
        version = calculix.version()
    except calculix.CalculixError as error:
        sys.exit(str(error))
    write(version, [(deck, rows_of(deck)) for deck in decks.all_decks()])


if __name__ == "__main__":
    main()
