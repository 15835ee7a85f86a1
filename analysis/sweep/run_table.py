"""All runs of a page: their table, the data of each run for the page's scripts, and the data of the part of
the page that shows all runs at once (its explorer)."""
import shlex

import numpy as np

from bendlab.results.load import group
from runs import expectations
from runs.collected import separating
from runs.sweeps import is_number
from sweep import charts, number_chart, run_facts
from sweep.answer import status_html
from tables import looks
from tables.numbers import number_text
from web.html_parts import element, escape, opener, row_html, scroll_table

COLUMNS, MOST_COLUMNS, MOST_AXES = 6, 9, 8
FEW = 3  # most commands of single runs that are listed
CHOICES = 24  # an axis with at most this many values has a list to choose from
MOST_LOOKS = 24  # an axis with more values gives runs no colours in the explorer
MOST_RUNS = 500  # a page with more runs has only the metrics of its charts


class RunTable:
    def __init__(self, report):
        self.report = report
        axes = list({axis.pointer: axis for varied, _ in report.axes for axis in varied}.values())
        self.axes, self.left_out = axes[:MOST_AXES], axes[MOST_AXES:]

    def html(self):
        heads, cells = zip(*self._columns())
        rows = "".join(row_html(cell(run) for cell in cells) for run in self.report.runs)
        table = scroll_table(row_html(heads), rows, "The runs", True, class_="sortable", data_rows="runs")
        left_out = ", ".join(axis.label for axis in self.left_out)
        more = f" The table leaves out {escape(left_out)}." if left_out else ""
        return ("<p class='grey small'>Click the id of a run to see its motion, worst metric, config and "
                f"command.{more}</p>{table}<h3>Repeat all runs</h3><pre>{escape(self._again())}</pre>")

    def _columns(self):
        """(heading, run → cell) of every column, as HTML."""
        report = self.report
        of_text = lambda name, html: (element("th", name, class_="t choose"),
                                      lambda run: element("td", html(run), class_="t"))
        yield "<th class='t'>run</th>", self._opener
        yield of_text("verdict", lambda run: status_html(run.status))
        if len(report.sweeps) > 1:
            yield of_text("sweep", lambda run: escape(run.name))
        yield from map(self._of_axis, self.axes)
        yield from map(self._of_number, self._numbers())
        if any(sweep.settings.get("expect") for sweep in report.sweeps):
            yield of_text("expected", self._held)
        if any(run.warnings for run in report.runs):
            codes = lambda run: dict.fromkeys(warning["code"] for warning in run.warnings)
            yield of_text("warnings", lambda run: escape(", ".join(codes(run))))

    def _opener(self, run):
        name = run.id[:8] if len(self.report.runs) > 1 else run.name
        return opener(run.id, escape(name), label=f"Open {self.report.labels[run.id]}")

    def _of_axis(self, axis):
        kinds = ("" if axis.numeric else "t ") + ("choose" if len(axis.values) <= CHOICES else "")
        text = "<td>" if axis.numeric else "<td class=t>"
        return (f"<th class='{kinds}' title='{escape(axis.pointer)}'>{escape(axis.short)}</th>",
                lambda run: f"{text}{escape(self.report.value_text(run, axis.pointer))}</td>")

    def _of_number(self, number):
        digits = charts.digits_of([charts.number_of(run, number["name"]) for run in self.report.runs], 4)

        def cell(run):
            value = charts.number_of(run, number["name"])
            key = "" if np.isnan(value) else "∞" if np.isinf(value) else f"{value:.9g}"
            return f"<td data-v='{key}'>{number_text(value, digits) if key else ''}</td>"
        label = escape(number["label"])
        return (f"<th title='{escape(number['meaning'])}' data-label='{label}'>{label}"
                f"{unit_html(number['unit'])}</th>"), cell

    def _held(self, run):
        checked = expectations.check(self.report.sweep(run).settings, run)
        held = all(bound.holds for bound in checked)
        return status_html("holds" if held else "fails", "held" if held else "failed") if checked else ""

    def _numbers(self):
        """The metrics of the table: the first metrics of every sweep, and the CPU time."""
        several = [charts.numbers_of(sweep, most=None, equal=True) for sweep in self.report.sweeps]
        times = [number for numbers in several for number in numbers if number["name"] == charts.CPU]
        first = [number for numbers in several for number in numbers[:COLUMNS] if number not in times]
        columns = [same_number[0] for same_number in group(first, lambda number: number["name"]).values()]
        return columns[:max(3, MOST_COLUMNS - len(self.axes))] + times[:1]

    def _again(self):
        """The commands that compute the runs and make the page again."""
        lines = []
        for sweep in self.report.sweeps:
            if sweep.config:
                options = [f"--set {shlex.quote(text)}" for text in sweep.overrides]
                path = shlex.quote(run_facts.shown_path(sweep.config))
                lines.append(" ".join([f"./bendlab run {path}", *options]) + run_facts.out(sweep))
            else:
                runs = [run for run in sweep.runs if run.file]
                lines += [run_facts.command(run, sweep) for run in runs[:FEW]]
                if len(runs) > FEW:
                    lines.append(f"# … and {len(runs) - FEW} more runs: open a run to see its command")
        return "\n".join([*lines, f"{self.report.command}      # this page"])


def about(report, run):
    """The data of a run for the page's scripts, without its frames."""
    sweep, title = report.sweep(run), report.labels[run.id]
    data = {"id": run.id, "label": report.short.get(run.id, title), "title": title, "name": run.name,
            "status": run.status, "outcome": run_facts.in_short(run), "why": run_facts.why(run),
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


# --- explorer ----------------------------------------------------------------------------------------------

def explorer(report):
    """{axes, numbers, places, plain}: the axes of all sweeps, the names of the metrics, run id → index of the
    run's value on each axis, the style of runs without a colour."""
    swept = group([axis for varied, _ in report.axes for axis in varied], lambda axis: axis.pointer)
    further = separating(report.runs) if len(report.sweeps) > 1 else []
    axes = [_axis(report, pointer, swept.get(pointer, [])) for pointer in dict.fromkeys([*swept, *further])]
    # axes with names first, because the first axis has most room for names on its left
    axes.sort(key=lambda axis: axis["numbers"] is not None)
    places = {}
    for run in report.runs:
        texts = [report.value_text(run, axis["name"]) for axis in axes]
        places[run.id] = [axis["texts"].index(text) if text else None for axis, text in zip(axes, texts)]
    of = lambda name: {charts.number_of(run, name) for run in report.runs if run.summary}
    numbers = [name for name in report.summary if len(of(name)) > 1] or list(report.summary)
    return {"axes": axes, "numbers": numbers, "places": places, "plain": looks.of_place(0)}


def _axis(report, pointer, same_axis):
    """The axis of a setting: the values from all sweeps that vary it, in order, then values of other runs."""
    values = {text: value for axis in same_axis for text, value in zip(axis.texts, axis.values)}
    for run in report.runs:
        values.setdefault(report.value_text(run, pointer), run.get(pointer))
    values.pop("", None)
    numeric = all(map(is_number, values.values()))
    texts = sorted(values, key=values.get) if numeric else list(values)
    models = {text: model for axis in same_axis for text, model in zip(axis.texts, axis.models or [])}
    if pointer == "/bending/model":
        models = values
    # the colours of models cannot tell apart two values that have the same model
    alone = len(set(models.values())) == len(values)
    styles = [looks.of_model(models[text]) if alone else looks.of_place(at) for at, text in enumerate(texts)]
    stated = [charts.described(pointer, axis.unit, axis.meaning, axis.short) for axis in same_axis[:1]]
    return {**(stated or [number_chart.about(pointer, report.sweeps[0].meanings)])[0],
            "texts": texts, "numbers": [values[text] for text in texts] if numeric else None,
            "looks": styles if len(texts) <= MOST_LOOKS else None}
