"""What a figure gives to its page: pictures, tables, checks, and claims with a rule."""
import argparse
import hashlib
import json
import math
from dataclasses import dataclass, field, fields, is_dataclass
from datetime import date
from pathlib import Path

from claim_map import ClaimMap
from committed import home

EXACT = 9  # significant digits of what a page is made of again


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
    origins: list = field(default_factory=list)  # of runs that were seen: commit, machine, date
    bits: dict = field(default_factory=dict)  # config → place on its sweep (short) → bits of the run there

    def uses(self, experiment):
        """Adds the experiment's command and its missing points to the section; returns its runs."""
        self.commands.append(experiment.command)
        self.origins += [origin_of(run) for run in experiment.runs[-1:]]
        self.bits[experiment.config] = {short(run.point): bits_of(run) for run in experiment.runs if run.over}
        if experiment.missing_text:
            self.missing.append(f"configs/{experiment.config}.json: {experiment.missing_text}")
        return experiment.runs


    def as_json(self):
        """What its page is made of again, without its runs."""
        return rounded(exactly({entry.name: getattr(self, entry.name) for entry in fields(self)
                                if entry.name != "maps"}), EXACT) | {
                                    "maps": [each.kept() for each in self.maps]}

    @classmethod
    def of_json(cls, kept):
        """The section that as_json() told of."""
        lists = {"pictures": tuple, "tables": lambda each: Table(**each),
                 "claims": lambda each: Claim(**each | {"numbers": known(each["numbers"])}),
                 "checks": lambda each: Check(**known(each)), "maps": ClaimMap.of_kept}
        return cls(**kept | {name: [make(each) for each in kept[name]] for name, make in lists.items()})


def short(value):
    """Eight letters that tell an object of JSON from others."""
    return hashlib.sha256(json.dumps(value, sort_keys=True).encode()).hexdigest()[:8]


def bits_of(run):
    """Eight letters that are equal for two runs if every number of their summaries is, to the last bit; but
    what the machine decides, times and memory."""
    return short({name: float(value).hex() for name, value in run.summary.items()
                  if name not in ("cpu_s", "step_cpu_s", "wall_s", "memory_bytes")})


def exactly(value):
    """Data classes as dictionaries, tuples as lists."""
    if is_dataclass(value):
        return {entry.name: exactly(getattr(value, entry.name)) for entry in fields(value)}
    if isinstance(value, dict):
        return {key: exactly(entry) for key, entry in value.items()}
    return [exactly(entry) for entry in value] if isinstance(value, (list, tuple)) else value


def known(numbers):
    """Numbers of JSON: null is NaN, "inf" infinite."""
    return {name: math.nan if value is None else float(value) if value in ("inf", "-inf") else value
            for name, value in numbers.items()}


def origin_of(run):
    """{commit, machine, date} of a run, as far as its file tells."""
    told = run.provenance
    written = run.file.stat().st_mtime if run.file and run.file.exists() else None
    changed = " with changes" if told.get("git_dirty") == "yes" else ""
    return {"commit": told["git_commit"][:12] + changed if told.get("git_commit") else "",
            "machine": told.get("processor", ""), "host": told.get("host", ""),
            "date": date.fromtimestamp(written).isoformat() if written else ""}


def rounded(value, digits=4):
    """The same value with numbers rounded to so many significant digits, NaN as None; also inside lists."""
    if isinstance(value, dict):
        return {str(key): rounded(entry, digits) for key, entry in value.items()}
    if isinstance(value, (list, tuple)):
        return [rounded(entry, digits) for entry in value]
    if isinstance(value, bool) or value is None or isinstance(value, (str, int)):
        return value
    value = float(value)
    if value != value:
        return None
    return float(f"{value:.{digits}g}") if abs(value) != float("inf") else str(value)


def write_objects(path, objects):
    """Writes a JSON list with one object per line."""
    lines = ",\n".join(json.dumps(entry, ensure_ascii=False) for entry in objects)
    path.write_text(f"[\n{lines}\n]\n", encoding="utf-8")


def print_option(parser):
    """The option of style.PRINT, which style.save() looks for."""
    parser.add_argument("--pdf", action="store_true", help="write every figure as PDF, too")


def figure_main(main):
    """Command line of one figure: draws the figure and prints its claims as JSON."""
    parser = argparse.ArgumentParser(description=main.__doc__)
    parser.add_argument("--results", type=Path, default=Path("results"), help="folder with the runs")
    parser.add_argument("--out", type=Path, default=home("paper", committed=False),
                        help="folder for the pictures (default: %(default)s)")
    print_option(parser)
    arguments = parser.parse_args()
    section = main(arguments.results, arguments.out)
    print(json.dumps([claim.as_json() for claim in section.claims], indent=2, ensure_ascii=False))
