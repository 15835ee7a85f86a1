"""The page of runs, sweeps or folders of results: how the cloth moves, charts of the metrics, and tables."""
import json
import math
from functools import cached_property

from bendlab.results.load import at
from draw import frames
from runs.axes import axes_of, label_of, value_text
from runs.expectations import check, expected_of
from sweep import charts, chosen_runs, run_facts
from sweep.answer import status_html, top_html
from sweep.number_chart import number_chart
from sweep.run_table import MOST_RUNS, RunTable, about, explorer, unit_html
from tables import looks
from tables.numbers import number_text
from web.html_parts import Part, chart_html, escape, opener, page, scroll_table
from web.origin import made_of

FRAMES_LIMIT = 12e6  # bytes of all frames of a page in its file
WATCHED_LIMIT = 60e6  # the limit for `bendlab view`, whose page stays on this machine
STILLS = 40  # a page with more runs that are not played shows no stills of them
MOST_CHARTS, MOST_PASS_CHARTS = 8, 12
MOST_VALUES, MOST_MEANING = 24, 110  # values of an axis and characters of its meaning in the table of axes
ASKED = "asked"  # end of the id of a chart that --x and --y ask for


class Report:
    """The sweeps of a page and everything that the page shows of these sweeps."""

    def __init__(self, sweeps, command, play=(), limit=FRAMES_LIMIT, most_frames=None, asked=None):
        self.sweeps, self.command, self.limit = sweeps, command, limit
        self.asked = asked  # (x, y) of a chart of two numbers, or None
        self.axes = [axes_of(sweep) for sweep in sweeps]
        self.runs = list({run.id: run for sweep in sweeps for run in sweep.runs}.values())
        self.sweep_of = {run.id: i for i, sweep in reversed(list(enumerate(sweeps))) for run in sweep.runs}
        self.labels = self._labels()
        self.numbers = [charts.numbers_of(sweep) for sweep in sweeps]
        self.played, self.why_these = chosen_runs.choose(sweeps, [varied for varied, _ in self.axes], play)
        offered = chosen_runs.offered(self.runs, self.played)
        self.short = self._short_labels([*self.played, *offered])
        self.settings = run_facts.Settings(self.runs)
        self.playback, self.packed = None, set()
        if self.played:
            self.playback = frames.playback(self.played, limit, self.short, most_frames, offered)
            self.packed = {entry["id"] for entry in self.playback.data["runs"]}
        self.charts, self.live = [], None

    def sweep(self, run):
        return self.sweeps[self.sweep_of[run.id]]

    def varied(self, run):
        """The axes of the run's sweep that have more than one value."""
        return self.axes[self.sweep_of[run.id]][0]

    def value_text(self, run, pointer):
        """A run's value of a setting as text; "" if it lacks it, or has an object without an axis."""
        value = at(run.config, pointer, {})
        known = "" if isinstance(value, dict) else value_text(value)
        return next((axis.text(run) for axis in self.varied(run) if axis.pointer == pointer), known)

    def _labels(self):
        """Run id → the label of the run: its values of the settings that the sweep varies."""
        labels = {run.id: _label(run, self.varied(run), len(self.sweeps) > 1) for run in self.runs}
        if len(self.runs) > 1 and len(set(labels.values())) == 1:
            labels = {id: f"{label} {id[:6]}" for id, label in labels.items()}
        return labels

    def _short_labels(self, runs):
        """Labels of the runs that a reader can play, with only the settings in which these runs differ."""
        differ = {axis.pointer for varied, _ in self.axes for axis in varied if
                  len({json.dumps(run.point.get(axis.pointer), sort_keys=True) for run in runs}) > 1}
        names = len({run.name for run in runs}) > 1
        labels = {run.id: _label(run, [axis for axis in self.varied(run) if axis.pointer in differ], names)
                  for run in runs}
        return labels if len(set(labels.values())) == len(labels) else self.labels

    @property
    def title(self):
        names = list(dict.fromkeys(sweep.name for sweep in self.sweeps))
        return ", ".join(names[:3]) + (f" and {len(names) - 3} more" if len(names) > 3 else "")

    def html(self, live=None):
        """The page as HTML. `live`: what the page's scripts need to ask for new frames."""
        self.live, self.charts = live, []
        table = Part("runs", "The runs", RunTable(self).html(), "Runs")
        parts = [self._motion(), *self._against(), self._explore(), self._expected(), self._over_time(),
                 self._passes(), table]
        shared = self.playback.data if self.playback else {}
        stills, scripts = self._stills()
        packed = {entry["id"]: entry for entry in shared.get("runs", [])} | stills
        data = {**shared, "settings": [self.settings.base], "summary": self.summary, "charts": self.charts,
                "runs": [packed.get(run.id, {}) | about(self, run) for run in self.runs]}
        if len(self.runs) > 1 and self.summary:
            data["explorer"] = explorer(self)
        if live:
            data["live"] = live
        scripts = [self.playback.scripts if self.playback else "", *scripts]
        return page(f"bendlab: {self.title}", top_html(self), [part for part in parts if part],
                    made_of(self.runs, self.command), data, "\n".join(scripts))

    # --- sections

    def _motion(self):
        if not self.played:
            reason = "No run has frames." if any(run.status != "missing" for run in self.runs) \
                else "No run is computed yet."
            return Part("motion", "Motion", f"<p class='grey'>{reason}</p>")
        count, here = sum(1 for run in self.runs if run.frames), len(self.packed)
        rest = f" {here} of {count} runs can be chosen below the picture." if count > len(self.played) else ""
        rest += " <code>--play ID</code> chooses other runs." if count > here else ""
        text = f"<p class='grey small'>{escape(self.why_these)}{rest}</p>" if self.why_these or rest else ""
        return Part("motion", "Motion", self.playback.players + text)

    def _against(self):
        """A section for each sweep: a table of its axes, and charts of its metrics against each axis."""
        alone = len(self.sweeps) == 1
        for i, (sweep, (varied, fixed)) in enumerate(zip(self.sweeps, self.axes)):
            prefix = f"s{i + 1}-"
            drawn = charts.axis_charts(sweep, varied, self.numbers[i], self.command, prefix)
            drawn, others = drawn[:MOST_CHARTS], [chart["x"]["label"] for chart in drawn[MOST_CHARTS:]]
            more = f"<p>No chart is drawn against {escape(', '.join(others))}.</p>" if others else ""
            asked = self.asked and number_chart(sweep, varied, *self.asked, self.command, prefix + ASKED)
            if asked:
                drawn.insert(0, asked)
            if varied or asked:
                self.charts += drawn
                lead = f"<p>{escape(sweep.description)}</p>" if sweep.description and not alone else ""
                body = lead + _axes_table([*varied, *fixed]) + "".join(map(chart_html, drawn)) + more
                yield (Part("sweep", "The sweep", body, "Sweep") if alone
                       else Part(f"sweep-{i + 1}", sweep.name, body))

    def _explore(self):
        if len(self.runs) < 2 or not self.summary:
            return None
        return Part("explore", "All runs at once",
                    "<p class='grey small'>Drag along a part of an axis to choose the runs whose curves "
                    "cross this part. The table, the groups and the other charts then show these runs. Click "
                    "a curve or a point to open a run, and to compare it with another run. On an axis with "
                    "the focus, ↑ and ↓ move the upper end of the chosen part, → and ← its lower end.</p>"
                    "<div id='explorer'></div>", "Explore")

    def _expected(self):
        rows = ""
        for sweep in self.sweeps:
            checked = [(run, bound) for run in sweep.runs for bound in check(sweep.settings, run)]
            for stated in expected_of(sweep.settings):
                rows += self._expectation_row(stated, [entry for entry in checked if entry[1] == stated])
        head = ("<tr><th class='t'>verdict</th><th class='t'>what is expected</th><th class=''>worst</th>"
                "<th class='t'>in</th><th class='t'>why</th></tr>")
        table = scroll_table(head, rows, class_="cards")
        return Part("expectations", "Expectations", table) if rows else None

    def _expectation_row(self, stated, checked):
        where = ", ".join(f"{pointer} {value_text(value)}" for pointer, value in stated.where.items())
        what = f"{stated.metric.replace('_', ' ')} {stated.bound}" + (f", where {where}" if where else "")
        verdict, measured, place = status_html("none", "no run"), "", "<td></td>"
        if checked:
            held = sum(bound.holds for _, bound in checked)
            run, least = min(checked, key=lambda entry: (entry[1].holds, entry[1].margin))
            word = "holds" if held == len(checked) else "fails"
            count = held if word == "holds" else len(checked) - held
            verdict = status_html(word, f"{word} in {count} of {len(checked)}" if len(checked) > 1 else word)
            value = charts.number_of(run, least.metric)
            digits = charts.digits_of([value], 4)
            measured = "not measured" if math.isnan(value) else number_text(value, digits)
            place = opener(run.id, escape(self.labels[run.id]))
        return (f"<tr><td class='t'>{verdict}</td><td class='t'>{escape(what)}</td><td>{escape(measured)}"
                f"</td>{place}<td class='t text'>{escape(stated.why)}</td></tr>")

    def _over_time(self):
        models = [run.model for run in self.played]
        by_model = all(models) and len(set(models)) == len(models)
        run_looks = {run.id: looks.of_model(run.model) if by_model else looks.of_place(i)
                     for i, run in enumerate(self.played)}
        chart = charts.time_chart(self.played, self.short, run_looks, self.command, "over-time")
        if not chart:
            return None
        self.charts.append(chart)
        return Part("time", "Over time", chart_html(chart, "The runs that are played above.", titled=False))

    def _passes(self):
        drawn, several = [], len(self.sweeps) > 1
        for i, sweep in enumerate(self.sweeps[:MOST_PASS_CHARTS]):
            chart = charts.pass_chart(sweep, self.axes[i][0], self.command, f"s{i + 1}-passes")
            if chart:
                chart["title"] += f", {sweep.name}" if several else ""
                drawn.append(chart)
        self.charts += drawn
        body = "".join(chart_html(chart, titled=several) for chart in drawn)
        return Part("passes", "Time per pass", body, "Cost") if drawn else None

    @cached_property
    def summary(self):
        """Name → {label, unit, meaning} of every metric in the page's data."""
        all_of = lambda sweep: charts.numbers_of(sweep, most=None, equal=True)
        several = map(all_of, self.sweeps) if len(self.runs) <= MOST_RUNS else self.numbers
        return {number["name"]: {key: number[key] for key in ("label", "unit", "meaning")}
                for numbers in several for number in numbers}

    def _stills(self):
        """({run id: data}, scripts) of the first and last frame of runs that are not played. Empty if these
        runs are more than STILLS."""
        unplayed = [run for run in chosen_runs.with_frames(self.runs) if run.id not in self.packed]
        data, scripts, size = {}, [], 0
        for run in unplayed if len(unplayed) <= STILLS else []:
            packed = frames.pack(run, every=max(1, run.frames - 1))
            size += 4 / 3 * len(packed.data) if packed else 0
            if size > self.limit / 4:
                break
            if packed:
                packed.head["notes"] = ["First and last frame."]
                data[run.id] = {"frames": packed.head}
                scripts.append(frames.script(packed))
        return data, scripts


def _label(run, axes, with_name):
    """A run's values on the axes as text, after the name of its sweep if `with_name`."""
    label = label_of(run, axes)
    return f"{run.name}: {label}" if with_name and label != run.name else label


def _axes_table(axes):
    rows = ""
    for axis in axes:
        values = ", ".join(axis.texts[:MOST_VALUES]) + (" …" if len(axis.texts) > MOST_VALUES else "")
        rows += (f"<tr><td class='t'><code>{escape(axis.pointer)}</code></td><td class='t text'>"
                 f"{escape(values)}{unit_html(axis.unit)}</td><td>{len(axis.values)}</td><td class='t text "
                 f"grey'>{escape(_beginning(axis.meaning))}</td></tr>")
    head = "<tr><th class=t>axis</th><th class=t>values</th><th>count</th><th class=t>meaning</th></tr>"
    return scroll_table(head, rows, class_="cards")


def _beginning(text):
    """A text, cut after a sentence or clause if it is longer than MOST_MEANING characters."""
    if len(text) <= MOST_MEANING:
        return text
    cut = max(text[:MOST_MEANING].rfind(mark) for mark in (". ", "; ", ": ", ", "))
    return text[:cut if cut > 40 else MOST_MEANING].rstrip(" ,;:") + " …"
