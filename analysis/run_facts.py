"""What a page says of one run: its worst number with its limit, why it failed, its config, its command."""
import json
import math
import shlex
from collections import Counter
from pathlib import Path

import repeat
from collected import flattened
from expectations import check
from sweep_charts import cpu_ms, shortened, simulated_s
from html_parts import number_text as number
from sweeps import settings_at


def worst(run, sweep):
    """The number that is nearest to its limit, or beyond it: {label, value, limit, unit, held, note}. None
    without limits."""
    if run.broken:
        broken = run.broken
        return {"label": broken["bound"].replace("_", " "), "value": told(broken["measured"]),
                "limit": told(broken["limit"]), "unit": broken.get("unit", ""), "held": False,
                "note": f"at t = {number(broken['time'])} s" if broken.get("time") is not None else ""}
    checked = check(sweep.settings, run)
    if checked:
        least = min(checked, key=lambda each: (each.holds, each.margin))
        return {"label": least.metric.replace("_", " "), "value": told(least.measured),
                "limit": told(least.limit), "unit": "", "held": least.holds, "note": least.why}
    if "max_stretch" in run.summary:
        return {"label": "largest stretch σ₁", "value": told(run.summary["max_stretch"]), "limit": None,
                "unit": "1", "held": None, "note": "no bound is stated for it"}
    return None


def told(value):
    """A number for JSON; what is not finite was stored as null."""
    return "∞" if value is None else shortened(float(value))


def why(run):
    """Why a run is not complete, a sentence or two."""
    if run.status == "implausible" and run.broken:
        broken = run.broken
        limit = lambda name: number(math.inf if broken[name] is None else broken[name])
        where = f"vertex {broken['vertex']}" if broken.get("vertex", -1) >= 0 else "the cloth"
        constraint = broken.get("constraint") or {}
        cause = (f" The {constraint['kind']} constraint moves it farthest, by "
                 f"{number(constraint['correction'])} m in one projection."
                 if constraint.get("kind") and constraint.get("correction") is not None else "")
        advice = f" Measured to help: {broken['advice'].rstrip('.')}." if broken.get("advice") else ""
        unit = "" if broken.get("unit") in (None, "1") else f" {broken['unit']}"
        return (f"At t = {number(broken['time'])} s {where} broke the bound on "
                f"{broken['bound'].replace('_', ' ')}: {limit('measured')}{unit}, and the scene allows "
                f"{limit('limit')}{unit}.{cause}{advice}")
    if run.status == "diverged":
        return run.provenance.get("message") or (
            f"The run diverged at t = {number(simulated_s(run))} s; what is shown is what was kept.")
    if run.status == "interrupted":
        return f"The run was stopped, or goes on, at t = {number(simulated_s(run))} s."
    if run.status == "missing":
        return "This run is not computed yet."
    if run.status == "unreadable":
        return run.provenance.get("problem", "Its file cannot be read.")
    return ""


def told_in_short(run):
    """Frames, simulated time and CPU time of a run."""
    if not run.frames:
        return ""
    ms = cpu_ms(run)
    parts = [f"{run.frames} frames, {number(simulated_s(run))} s"]
    if ms == ms:
        parts.append(f"{number(ms)} ms of CPU per 1/60 s")
    parts.append(run.id)
    return " · ".join(parts)


def command(run, sweep):
    """The one line that computes a run again."""
    if sweep.config and sweep.settings:
        return repeat.command(shown_path(sweep.config), run.point, sweep.axes, sweep.overrides)
    if run.file:
        return f"./bendlab rerun {shlex.quote(shown_path(sweep.file_of(run)))}"
    return ""


def view_command(run, sweep):
    return f"./bendlab view {shlex.quote(shown_path(sweep.file_of(run)))}" if run.file else ""


def shown_path(path):
    """A path as one would type it here."""
    path = Path(path)
    try:
        return str(path.resolve().relative_to(Path.cwd()))
    except ValueError:
        return str(path)


class Settings:
    """Configs of many runs as one whole one per page, and of each run what differs from it."""

    def __init__(self, runs):
        flat = {run.id: flattened(run.config) for run in runs if run.config}
        values = {}
        for each in flat.values():
            for pointer, value in each.items():
                values.setdefault(pointer, Counter())[json.dumps(value)] += 1
        self.base = {pointer: json.loads(counts.most_common(1)[0][0]) for pointer, counts in values.items()
                     if sum(counts.values()) > len(flat) / 2}
        self._flat = flat

    def changes(self, run):
        """Pointer → [value] where the run's config is another, → None where it has no such setting."""
        own = self._flat.get(run.id)
        if own is None:
            return None
        return differing(self.base, own)


def stated(settings, point):
    """Pointer → value of a config as it is written, at a place on its sweep."""
    whole = settings_at(settings, point)
    return flattened({key: value for key, value in whole.items() if key not in ("sweep", "description")})


def differing(base, own):
    """Pointer → [value] where a config is another than a base, → None where it has no such setting."""
    found = {pointer: [value] for pointer, value in own.items()
             if pointer not in base or json.dumps(base[pointer]) != json.dumps(value)}
    return found | {pointer: None for pointer in base if pointer not in own}
