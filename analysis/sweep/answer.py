"""The top of a page of runs: the answer, the number of runs with each verdict, and what went wrong."""
from collections import Counter

import numpy as np

from bendlab.results.load import group
from runs import expectations
from sweep import charts, run_facts
from tables.numbers import number_text
from web.html_parts import element, escape

ORDER = ["complete", "running", "implausible", "diverged", "interrupted", "failed", "unreadable", "missing"]


def top_html(report):
    text = next((sweep.description for sweep in report.sweeps if sweep.description), "")
    lead = f"<p class='lead'>{escape(text)}</p>" if text and len(report.sweeps) == 1 else ""
    # on a live page, these counts would soon be out of date
    tally = "" if report.live else f"<ul class='tally'>{''.join(_tally(report))}</ul>"
    return (f"<h1>{escape(report.title)}</h1>{lead}<p class='answer'>{_answer(report)}</p>{tally}"
            f"{_going_on(report)}{''.join(_trouble(report))}")


def status_html(status, text=""):
    """A status as HTML, in the style of its kind."""
    kind = "fails" if status in ("unreadable", "failed") else status
    return element("span", escape(text or status), class_=f"status {kind}")


def _answer(report):
    """The answer: the number of runs, and the range of the first metric that differs between runs."""
    runs, count = report.runs, len(report.runs)
    if report.live:
        return "The page follows this run while it is computed."
    done = sum(run.complete for run in runs)
    if count > 1:
        text = spaced(count) + " runs" + (f", {spaced(done)} of them complete" if done < count else "")
    else:
        text = f"One run, {runs[0].status}"
        if runs[0].frames:
            seconds = number_text(charts.simulated_s(runs[0]))
            text += f": {seconds} s of cloth in {runs[0].frames} frames"
    extremes = _extremes(report)
    if extremes:
        number, *ends = extremes
        unit = "" if number["unit"] in ("", "1") else f" {number['unit']}"
        values = [run.summary[number["name"]] for run in ends]
        digits = next(digits for digits in range(charts.digits_of(values, 3), 20)
                      if number_text(values[0], digits) != number_text(values[1], digits))
        low, high = (f"<b>{escape(number_text(value, digits) + unit)}</b> ({escape(report.labels[run.id])})"
                     for value, run in zip(values, ends))
        text += f". The {escape(number['label'])} goes from {low} to {high}"
    return text + "."


def _extremes(report):
    """(metric, run with the smallest value, run with the largest value) of the first metric that differs."""
    for number in report.numbers[0] if report.numbers else []:
        of = lambda run: run.summary.get(number["name"], np.nan)
        runs = [run for run in report.runs if run.complete and np.isfinite(of(run))]
        if runs and of(min(runs, key=of)) < of(max(runs, key=of)):
            return number, min(runs, key=of), max(runs, key=of)
    return None


def _tally(report):
    counts = Counter(run.status for run in report.runs)
    for name in ORDER:
        if counts[name]:
            yield f"<li>{status_html(name, f'{spaced(counts[name])} {name}')}</li>"
    checked = [expected.holds for sweep in report.sweeps for run in sweep.runs
               for expected in expectations.check(sweep.settings, run)]
    if checked:
        kind = "holds" if all(checked) else "fails"
        yield f"<li>{status_html(kind, f'{sum(checked)} of {len(checked)} expectations hold')}</li>"
    given = Counter(code for run in report.runs
                    for code in sorted({warning["code"] for warning in run.warnings}))
    for code, count in given.items():
        yield f"<li><b>{count}</b> with the warning {escape(code)}</li>"


def _going_on(report):
    if not report.live:
        return ""
    run = report.runs[0]
    now, end = number_text(charts.simulated_s(run)), number_text(run.get("/duration"))
    states = {"running": "goes on", "interrupted": "was stopped", "diverged": "diverged"}
    return (f"<p id='live' role='status'>{run.frames} frames, t = {now} s of {end} s. The run "
            f"{states.get(run.status, f'is {run.status}')}.</p>")


def _trouble(report):
    """Notes as HTML: a note for each kind of failure and of warning, and the notes of the sweeps."""
    link = lambda run: f"<a href='#run-{escape(run.id)}'>{escape(report.labels[run.id])}</a>"
    for status, kind in (("implausible", "no"), ("diverged", "diverged"), ("failed", "no"),
                         ("unreadable", "no")):
        failed = [run for run in report.runs if run.status == status]
        if failed:
            rest = len(failed) - 1
            more = f" {rest} more with this status: see <a href='#runs'>the runs</a>." if rest else ""
            yield (f"<div class='note {kind}'><p>{status_html(status)} {link(failed[0])}: "
                   f"{escape(run_facts.why(failed[0]))}{more}</p></div>")
    warnings = [(run, warning) for run in report.runs for warning in run.warnings]
    for code, alike in group(warnings, lambda entry: entry[1]["code"]).items():
        run, message = alike[0][0], alike[0][1]["message"]
        more = f" (and {len(alike) - 1} more)" if len(alike) > 1 else ""
        end = "" if message.endswith((".", "!", "?")) else "."
        yield (f"<div class='note open'><p><b>{escape(code)}</b> {link(run)}{more}: "
               f"{escape(message)}{end}</p></div>")
    for note in (note for sweep in report.sweeps for note in sweep.notes):
        yield f"<div class='note'><p>{escape(note)}.</p></div>"


def spaced(count):
    """1234 as 1 234."""
    return f"{count:,}".replace(",", "\u202f")
