"""The table of all runs of a page, and the data of each run for the page's scripts."""
import shlex

import numpy as np

from tables.numbers import number_text
from runs import expectations
from sweep import run_facts
from sweep import charts
from web.html_parts import escape
from sweep.answer import status_html

COLUMNS, MOST_COLUMNS, MOST_AXES = 6, 9, 8
FEW = 3  # most commands of single runs that are listed
CHOICES = 24  # an axis with at most this many values has a list to choose from


class RunTable:
    def __init__(self, report):
        self.report = report
        self.axes = list({axis.pointer: axis for varied, _ in report.axes
                          for axis in varied}.values())[:MOST_AXES]
        self.numbers = self._columns()
        self.several = len(report.sweeps) > 1
        self.checked = any(sweep.settings.get("expect") for sweep in report.sweeps)
        self.warned = any(run.warnings for run in report.runs)

    def html(self):
        rows = "".join(map(self._row, self.report.runs))
        return ("<p class='grey small'>Click the id of a run to see its motion, worst metric, config and "
                "command.</p><div class='scroll tall' tabindex='0' role='region' aria-label='The runs'>"
                f"<table class='sortable' data-rows='runs'><thead><tr>{''.join(self._head())}</tr></thead>"
                f"<tbody>{rows}</tbody></table></div><h3>Repeat all runs</h3><pre>{escape(self._again())}"
                "</pre>")

    def _columns(self):
        """The metrics of the table: the first metrics of every sweep, and the CPU time."""
        columns = {}
        for numbers in self.report.numbers:
            for number in numbers[:COLUMNS]:
                columns.setdefault(number["name"], number)
        everything = {number["name"]: number for numbers in self.report.numbers for number in numbers}
        time = everything.get(charts.CPU)
        columns.pop(charts.CPU, None)
        return list(columns.values())[:max(3, MOST_COLUMNS - len(self.axes))] + ([time] if time else [])

    def _head(self):
        text = lambda name: f"<th class='t choose'>{name}</th>"
        yield "<th class='t'>run</th>" + text("verdict")
        if self.several:
            yield text("sweep")
        for axis in self.axes:
            kinds = ("" if axis.numeric else "t ") + ("choose" if len(axis.values) <= CHOICES else "")
            yield f"<th class='{kinds}' title='{escape(axis.pointer)}'>{escape(axis.short)}</th>"
        for number in self.numbers:
            label = escape(number["label"])
            yield (f"<th title='{escape(number['meaning'])}' data-label='{label}'>{label}"
                   f"{unit_html(number['unit'])}</th>")
        if self.checked:
            yield text("expected")
        if self.warned:
            yield text("warnings")

    def _row(self, run):
        return f"<tr>{''.join(self._cells(run))}</tr>"

    def _cells(self, run):
        report = self.report
        name = run.id[:8] if len(report.runs) > 1 else run.name
        yield (f"<td class='t' data-run='{escape(run.id)}'><button type='button' class='opens' "
               f"aria-label='Open {escape(report.labels[run.id])}'>{escape(name)}</button></td><td "
               f"class='t'>{status_html(run.status)}</td>")
        if self.several:
            yield f"<td class='t'>{escape(run.name)}</td>"
        own = {axis.pointer: axis for axis in report.axes[report.sweep_of[run.id]][0]}
        for axis in self.axes:
            text = own[axis.pointer].text(run) if axis.pointer in own else ""
            yield f"<td{'' if axis.numeric else ' class=t'}>{escape(text)}</td>"
        for number in self.numbers:
            value = charts.number_of(run, number["name"])
            key = "" if np.isnan(value) else "∞" if np.isinf(value) else f"{value:.9g}"
            yield f"<td data-v='{key}'>{number_text(value, 4) if key else ''}</td>"
        if self.checked:
            checked = expectations.check(report.sweep(run).settings, run)
            held = all(bound.holds for bound in checked)
            text = status_html("holds" if held else "fails", "held" if held else "failed") if checked else ""
            yield f"<td class='t'>{text}</td>"
        if self.warned:
            codes = ", ".join(dict.fromkeys(warning["code"] for warning in run.warnings))
            yield f"<td class='t'>{escape(codes)}</td>"

    def _again(self):
        """The commands that compute the runs and make the page again."""
        lines = []
        for sweep in self.report.sweeps:
            if sweep.config:
                options = [f"--set {shlex.quote(text)}" for text in sweep.overrides]
                path = shlex.quote(run_facts.shown_path(sweep.config))
                lines.append(" ".join([f"./bendlab run {path}", *options]))
            else:
                runs = [run for run in sweep.runs if run.file]
                lines += [run_facts.command(run, sweep) for run in runs[:FEW]]
                if len(runs) > FEW:
                    lines.append(f"# … and {len(runs) - FEW} more runs: open a run to see its command")
        return "\n".join([*lines, f"{self.report.command}      # this page"])


def about(report, run):
    """The data of a run for the page's scripts, without its frames."""
    sweep = report.sweep(run)
    title = report.labels[run.id]
    data = {"id": run.id, "label": report.short.get(run.id, title), "title": title, "name": run.name,
            "status": run.status, "told": run_facts.in_short(run), "why": run_facts.why(run),
            "worst": run_facts.worst(run, sweep), "warnings": run.warnings,
            "command": run_facts.command(run, sweep),
            "view": run_facts.view_command(run, sweep) if run.frames else "",
            "summary": {name: charts.shortened(charts.number_of(run, name)) for name in report.summary
                        if name == charts.CPU or name in run.summary or run.status == "diverged"}}
    changes = report.settings.changes(run)
    if changes is not None:
        data |= {"base": 0, "changes": changes}
    return {key: value for key, value in data.items() if value not in ("", [], {}) or key == "changes"}


def unit_html(unit):
    return f" <small>{escape(unit)}</small>" if unit not in ("", "1") else ""
