"""What a page shows of one run: the metric nearest to its limit, why the run failed, config and command."""
import json
import math
import shlex
from collections import Counter
from pathlib import Path

from runs import repeat
from runs.collected import WITHOUT_FILE, differing, flattened
from runs.expectations import check
from sweep.charts import cpu_ms, number_of, simulated_s
from tables.numbers import number_text as number
from tables.numbers import shortened


def worst(run, sweep):
    """The metric that is nearest to its limit, or farthest beyond the limit: {label, value, limit, unit,
    held, note}. Without limits, the largest stretch; None if the run has no stretch."""
    if run.broken:
        broken = run.broken
        return {"label": broken["bound"].replace("_", " "), "value": json_number(broken["measured"]),
                "limit": json_number(broken["limit"]), "unit": broken.get("unit", ""), "held": False,
                "note": f"at t = {number(broken['time'])} s" if broken.get("time") is not None else ""}
    checked = check(sweep.settings, run)
    if checked:
        least = min(checked, key=lambda bound: (bound.holds, bound.margin))
        measured = number_of(run, least.metric)
        return {"label": least.metric.replace("_", " "), "value": shortened(measured),
                "limit": json_number(least.limit), "unit": "", "held": least.holds, "note": least.why
                } | ({"text": "not measured"} if math.isnan(measured) else {})
    if "max_stretch" in run.summary:
        return {"label": "largest stretch σ₁", "value": shortened(number_of(run, "max_stretch")),
                "limit": None, "unit": "1", "held": None, "note": "no bound is stated for it"}
    return None


def json_number(value):
    """A number for the JSON of a page; "∞" for None, which run files have if a number is not finite."""
    return "∞" if value is None else shortened(float(value))


def why(run):
    """One or two sentences why a run failed or is not finished; "" for a complete run."""
    if run.status == "implausible" and run.broken:
        broken = run.broken
        limit = lambda name: number(math.inf if broken[name] is None else broken[name])
        where = f"vertex {broken['vertex']}" if broken.get("vertex", -1) >= 0 else "the cloth"
        constraint = broken.get("constraint") or {}
        cause = (f" There, a {constraint['kind']} constraint has the largest correction, "
                 f"{number(constraint['correction'])} m in one projection."
                 if constraint.get("kind") and constraint.get("correction") is not None else "")
        advice = f" Measured to help: {broken['advice'].rstrip('.')}." if broken.get("advice") else ""
        unit = "" if broken.get("unit") in (None, "1") else f" {broken['unit']}"
        return (f"At t = {number(broken['time'])} s {where} broke the bound on "
                f"{broken['bound'].replace('_', ' ')}: the value is {limit('measured')}{unit}, and the "
                f"scene allows {limit('limit')}{unit}.{cause}{advice}")
    if run.status == "diverged":
        return run.provenance.get("message") or (
            f"The run diverged at t = {number(simulated_s(run))} s; the page shows the earlier frames.")
    if run.status == "interrupted":
        return f"The run was stopped at t = {number(simulated_s(run))} s. Its command continues it."
    return run.provenance.get("problem") or {
        "missing": "This run is not computed yet.", "running": "This run is being computed.",
        "failed": "This run ended before its first frame. Its command says why."}.get(run.status, "")


def in_short(run):
    """Frames, simulated time and CPU time of a run."""
    if not run.frames:
        return ""
    ms = cpu_ms(run)
    cost = "" if math.isnan(ms) else f" · {number(ms)} ms of CPU per 1/60 s"
    return f"{run.frames} frames, {number(simulated_s(run))} s{cost} · {run.id}"


def command(run, sweep):
    """The command that computes a run again."""
    if sweep.config and sweep.settings:
        return repeat.command(shown_path(sweep.config), run.point, sweep.axes, sweep.overrides) + out(sweep)
    if run.file:
        return f"./bendlab rerun {shlex.quote(shown_path(sweep.file_of(run)))}"
    return ""


def out(sweep):
    """The option --out of a sweep whose sweep file is not in results/."""
    folder = shown_path(sweep.source.parents[1]) if sweep.source.name.endswith(".sweep.json") else "results"
    return "" if folder == "results" else f" --out {shlex.quote(folder)}"


def view_command(run, sweep):
    return f"./bendlab view {shlex.quote(shown_path(sweep.file_of(run)))}" if run.file else ""


def shown_path(path):
    """A path as the user would type it in the current folder."""
    path, here = Path(path), Path.cwd()
    return str(path.resolve().relative_to(here) if path.resolve().is_relative_to(here) else path)


class Settings:
    """The configs of many runs: one base config for the page, and what differs from the base for each run."""

    def __init__(self, runs):
        self._own = {run.id: flattened(run.config) for run in runs if run.config}
        written = {run.id for run in runs if run.status in WITHOUT_FILE}
        whole = [config for id, config in self._own.items() if id not in written] or [*self._own.values()]
        values = {}
        for config in whole:
            for pointer, value in config.items():
                values.setdefault(pointer, Counter())[json.dumps(value)] += 1
        self.base = {pointer: json.loads(counts.most_common(1)[0][0]) for pointer, counts in values.items()
                     if counts.total() > len(whole) / 2}
        for id in written & self._own.keys():  # a config as it is written lacks defaults
            self._own[id] = self.base | self._own[id]

    def changes(self, run):
        """Pointer → [value] of each setting that differs from the base config; None instead of [value] if the
        run's config lacks the setting."""
        return differing(self.base, self._own[run.id]) if run.id in self._own else None
