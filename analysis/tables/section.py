"""A section of a page, which a figure makes: charts, pictures, tables, checks, and claims with a rule."""
import hashlib
import json
import re
from dataclasses import asdict, dataclass, field, replace
from datetime import date

from tables.numbers import known_values, rounded
from tables.chart import Chart
from tables.claim_map import ClaimMap
from tables.table import EXACT, Table


@dataclass
class Claim:
    figure: str
    claim: str  # the paper's statement
    rule: str  # the condition under which it holds
    numbers: dict  # the measured numbers
    holds: bool | None  # None: runs are missing
    note: str = ""
    setting: str = ""  # the claim is judged at this setting only; a map judges it over all settings

    def as_json(self):
        return {name: value for name, value in rounded(asdict(self)).items() if value or name != "setting"}


@dataclass
class Check:
    """A number that is known beforehand from theory or experiment, and the measured number."""

    check: str
    model: str
    mesh: str
    expected: float
    measured: float  # NaN: no run, or a run without this number
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
                    * (abs(self.expected) if self.kind == "relative" else 1))

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
class Section:
    """One part of a page. The page gives the id and title of a section, and a figure adds the content."""

    id: str  # its address in the page
    title: str
    link: str = ""  # its name in the navigation
    text: str = ""
    figure: str = ""  # the number of the paper's figure
    charts: list = field(default_factory=list)  # Chart
    pictures: list = field(default_factory=list)  # (file name, caption)
    tables: list = field(default_factory=list)  # Table
    claims: list = field(default_factory=list)
    checks: list = field(default_factory=list)
    maps: list = field(default_factory=list)  # ClaimMap
    commands: list = field(default_factory=list)
    missing: list = field(default_factory=list)
    origins: list = field(default_factory=list)  # of the runs of the section: commit, machine, date
    data: list = field(default_factory=list)  # objects for a JSON file beside the page, not for page.json
    frames: object = None  # frames of moving cloth (draw/frames.py), for index.html only
    bits: dict = field(default_factory=dict)  # config → short(point of the sweep) → bits_of(run)

    def uses(self, experiment):
        """Adds an experiment's command and missing runs to the section. Returns the experiment's runs."""
        self.commands.append(experiment.command)
        self.origins += [origin_of(run) for run in experiment.runs[-1:]]
        self.bits[experiment.config] = {short(run.point): bits_of(run) for run in experiment.runs if run.over}
        if experiment.missing_text:
            self.missing.append(f"configs/{experiment.config}.json: {experiment.missing_text}")
        return experiment.runs

    def add_table(self, *table):
        """Adds a table; the arguments are those of Table.of()."""
        self.tables.append(Table.of(*table))

    def add_check(self, *check, **options):
        """Adds a check; the arguments are those of Check."""
        self.checks.append(Check(*check, **options))

    def add_chart(self, table, title, x, ys, *curve, id="", **options):
        """Adds a chart, and its table if `table` is no id of a table. `id`: the id of the chart; "": the id
        of the table. All other arguments are as in Chart."""
        if isinstance(table, Table):
            self.tables.append(table)
            table = table.id
        self.charts.append(Chart(id or table, title, table, x, ys, *curve, **options))

    def table(self, id):
        """The rows of the section's table with this id; [] without such a table."""
        return next((table.rows for table in self.tables if table.id == id), [])

    def as_json(self):
        """The section as JSON, from which the HTML of its page can be made again without runs."""
        kept = asdict(replace(self, maps=[], tables=[], data=[], frames=None))
        for name in ("maps", "tables", "data", "frames"):
            del kept[name]
        return rounded(kept, EXACT) | {"tables": [table.as_json(self._used(table)) for table in self.tables],
                                       "maps": [claim_map.kept() for claim_map in self.maps]}

    def _used(self, table):
        """The names of the values that columns and charts show of a table's rows."""
        charts = [chart for chart in self.charts if table.id in (chart.table, chart.theory)]
        names = {name for chart in charts for name in (
            chart.x, chart.look, chart.dashed, *chart.curve, *chart.held,
            *(y + end for y in chart.ys for end in ("", "_low", "_high")))}
        return names | {"runs"} | {name for column in table.columns for name in (column.id, column.least)}

    @classmethod
    def of_json(cls, kept):
        """The section that as_json() wrote."""
        lists = {"pictures": tuple, "tables": Table.of_json, "charts": lambda entry: Chart(**entry),
                 "claims": lambda entry: Claim(**entry | {"numbers": known_values(entry["numbers"])}),
                 "checks": lambda entry: Check(**known_values(entry)), "maps": ClaimMap.of_kept}
        return cls(**kept | {name: [make(entry) for entry in kept[name]] for name, make in lists.items()})


def address(title):
    """The address of a part of a page with this title, such as what-is-stable."""
    return re.sub(r"[^a-z0-9]+", "-", title.lower()).strip("-")


def short(value):
    """A hash of an object of JSON, eight hexadecimal digits long."""
    return hashlib.sha256(json.dumps(value, sort_keys=True).encode()).hexdigest()[:8]


def bits_of(run):
    """A hash of a run's summary: equal for two runs whose numbers are equal to the last bit. Times and memory
    do not count, because they depend on the machine."""
    return short({name: float(value).hex() for name, value in run.summary.items()
                  if name not in ("cpu_s", "step_cpu_s", "wall_s", "memory_bytes")})


def origin_of(run):
    """{commit, machine, date} of a run, as far as its file states them."""
    provenance = run.provenance
    written = run.file.stat().st_mtime if run.file and run.file.exists() else None
    changed = " with changes" if provenance.get("git_dirty") == "yes" else ""
    return {"commit": provenance["git_commit"][:12] + changed if provenance.get("git_commit") else "",
            "machine": provenance.get("processor", ""), "host": provenance.get("host", ""),
            "date": date.fromtimestamp(written).isoformat() if written else ""}


def write_objects(path, objects):
    """Writes a JSON list with one object per line."""
    lines = ",\n".join(json.dumps(entry, ensure_ascii=False) for entry in objects)
    path.write_text(f"[\n{lines}\n]\n", encoding="utf-8")


def read_objects(path):
    """The objects in a JSON list; [] if there is no such file."""
    return json.loads(path.read_text(encoding="utf-8")) if path.exists() else []
