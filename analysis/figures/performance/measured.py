"""Rows from the JSON of Google Benchmark, which `bendlab bench --json` prints."""
import re
from datetime import datetime, timezone

from figures.performance.roofline import Machine

# The name of a benchmark: strain/128/float/threads:2/manual_time. Peaks have no size: peak/float.
NAME = re.compile(r"(?P<name>.+)/(?P<scalar>float|double)(/threads:(?P<threads>\d+))?(/.*)?")
MILLISECONDS = {"ns": 1e-6, "us": 1e-3, "ms": 1, "s": 1e3}
TIMES = {"ns_per_constraint": "median", "ns_lowest": "lowest", "ns_highest": "highest"}
# Keys that Google Benchmark writes itself, without those of counters.
OWN = {"name", "family_index", "per_family_instance_index", "run_name", "run_type", "repetitions",
       "threads", "aggregate_name", "aggregate_unit", "iterations", "real_time", "cpu_time", "time_unit"}


def context_of(bench):
    """The context of Google Benchmark, with the date in UTC."""
    date = datetime.fromisoformat(bench["context"]["date"]).astimezone(timezone.utc)
    return bench["context"] | {"date": f"{date:%Y-%m-%dT%H:%M:%SZ}"}


def by_statistic(bench):
    """Name of a benchmark → {"median", "lowest" or "highest" of its repetitions: object}. A benchmark that
    failed has no such objects."""
    benchmarks = {}
    for entry in bench["benchmarks"]:
        if "aggregate_name" in entry:
            benchmarks.setdefault(entry["run_name"], {})[entry["aggregate_name"]] = entry
    return benchmarks


def machine_of(bench):
    """The limits of the machine: the best repetitions, because other programs may disturb a repetition."""
    best = {tuple(name.split("/")[:2]): found["highest"] for name, found in by_statistic(bench).items()}
    return Machine(
        {int(size): entry["bytes_per_second"] for (kind, size), entry in best.items() if kind == "triad"},
        {scalar: entry["flop_per_second"] for (kind, scalar), entry in best.items() if kind == "peak"})


def rows_of(bench):
    """A row for each benchmark of the solver, compared with its oracle and with the machine."""
    machine, rows = machine_of(bench), []
    for name, found in by_statistic(bench).items():
        if "constraints" in found["highest"]:  # not a limit of the machine
            rows.append(row_of(NAME.fullmatch(name), found))
    for row in rows:
        row |= {"ratio_to_oracle": ratio_to_oracle(row, rows), "roofline_fraction": machine.share(row)}
    return rows


def row_of(name, found):
    """The medians, with the range of times and of ratios."""
    median = found["median"]
    row = {"name": name["name"], "scalar": name["scalar"], "threads": int(name["threads"] or 1),
           "repetitions": median["repetitions"],
           "call_ms": median["real_time"] * MILLISECONDS[median["time_unit"]]}
    row |= {counter: value for counter, value in median.items() if counter not in OWN | {"seconds_per_item"}}
    row |= {size: int(row[size]) for size in ("vertices", "constraints")}
    row |= {key: 1e9 * found[statistic]["seconds_per_item"] for key, statistic in TIMES.items()}
    for ratio in {"wall_ratio", "speed_up"} & row.keys():
        row |= {f"{ratio}_{end}": found[end][ratio] for end in ("lowest", "highest")}
    return row


def ratio_to_oracle(row, rows):
    """Time of the oracle, divided by the time of the row; None without an oracle. Oracles are timed in few
    sizes, and some only in double precision, so the row is compared with the oracle that is most like it."""
    kind, _, size = row["name"].rpartition("/")
    oracles = [other for other in rows if other["name"].rpartition("/")[0] == f"{kind}_oracle"]
    like = lambda other: (other["scalar"] == row["scalar"], other["name"].endswith(f"/{size}"))
    oracle = max(oracles, key=like, default=None)
    return oracle and oracle["ns_per_constraint"] / row["ns_per_constraint"]
