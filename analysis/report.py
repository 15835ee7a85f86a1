"""What a figure gives to its page: pictures, tables, checks, and claims with a rule."""
import argparse
import json
from dataclasses import dataclass, field
from pathlib import Path


@dataclass
class Claim:
    figure: str
    claim: str  # the paper's statement
    rule: str  # the condition under which it holds
    numbers: dict  # the measured numbers
    holds: bool | None  # None: runs are missing
    note: str = ""
    setting: str = ""  # judged at this setting only: the verdict over all settings is that of a map

    def as_json(self):
        return {"figure": self.figure, "claim": self.claim, "rule": self.rule,
                "numbers": rounded(self.numbers), "holds": self.holds, "note": self.note,
                **({"setting": self.setting} if self.setting else {})}


@dataclass
class Check:
    """A number known beforehand from theory or experiment, and the measured one."""

    check: str
    model: str
    mesh: str
    expected: float
    measured: float  # NaN: no run, or the run lacks it
    tolerance: float  # relative or absolute, see `kind`
    source: str
    kind: str = "relative"  # or "absolute", or "most": measured is at most expected
    note: str = ""

    @property
    def holds(self):
        """Whether the measured number is within the tolerance; None if nothing was measured."""
        if self.measured is None or self.measured != self.measured:
            return None
        if self.kind == "most":
            return bool(self.measured <= self.expected)
        return bool(abs(self.measured - self.expected) <= self.tolerance
                    * (self.expected if self.kind == "relative" else 1))

    @property
    def bound(self):
        """The tolerance as text."""
        return {"relative": f"± {100 * self.tolerance:g} %", "absolute": f"± {self.tolerance:g}",
                "most": "at most"}[self.kind]

    def as_json(self):
        return {"check": self.check, "model": self.model, "mesh": self.mesh,
                "expected": rounded(self.expected), "measured": rounded(self.measured),
                "tolerance": self.bound, "source": self.source, "holds": self.holds, "note": self.note}


@dataclass
class Table:
    caption: str
    columns: list
    rows: list  # lists of text or numbers


@dataclass
class Section:
    """One part of the page."""

    title: str
    figure: str
    pictures: list = field(default_factory=list)  # (file name, caption)
    tables: list = field(default_factory=list)
    claims: list = field(default_factory=list)
    checks: list = field(default_factory=list)
    maps: list = field(default_factory=list)  # ClaimMap
    commands: list = field(default_factory=list)
    missing: list = field(default_factory=list)
    text: str = ""

    def uses(self, experiment):
        """Adds the experiment's command and its missing points to the section; returns its runs."""
        self.commands.append(experiment.command)
        if experiment.missing_text:
            self.missing.append(f"configs/{experiment.config}.json: {experiment.missing_text}")
        return experiment.runs


def rounded(value):
    """The same value with numbers rounded to four significant digits, NaN as None; also inside lists."""
    if isinstance(value, dict):
        return {str(key): rounded(entry) for key, entry in value.items()}
    if isinstance(value, (list, tuple)):
        return [rounded(entry) for entry in value]
    if isinstance(value, bool) or value is None or isinstance(value, (str, int)):
        return value
    value = float(value)
    if value != value:
        return None
    return float(f"{value:.4g}") if abs(value) != float("inf") else str(value)


def write_objects(path, objects):
    """Writes a JSON list with one object per line."""
    lines = ",\n".join(json.dumps(entry, ensure_ascii=False) for entry in objects)
    path.write_text(f"[\n{lines}\n]\n", encoding="utf-8")


def figure_main(main):
    """Command line of one figure: draws the figure and prints its claims as JSON."""
    parser = argparse.ArgumentParser(description=main.__doc__)
    parser.add_argument("--results", type=Path, default=Path("results"), help="folder with the runs")
    parser.add_argument("--out", type=Path, default=Path("results/paper"), help="folder for the pictures")
    arguments = parser.parse_args()
    section = main(arguments.results, arguments.out)
    print(json.dumps([claim.as_json() for claim in section.claims], indent=2, ensure_ascii=False))
