"""Makes the page of runs, sweeps or folders of results. The page shows how the cloth moves, charts of the
metrics, and tables. `bendlab report` and `bendlab view` call this script."""
import argparse
import json
import os
import shlex
from functools import cached_property
from pathlib import Path

from tables.numbers import number_text

from sweep import browser
from sweep import chosen_runs
from runs import expectations
from draw import frames
from tables import looks
from sweep import run_facts
from sweep import charts
from draw import chart_files
from runs.collected import collect, tell
from web.html_parts import Part, escape, page
from sweep.number_chart import number_chart
from web.origin import made_of
from sweep.explorer import MOST_RUNS, explorer
from sweep.answer import status_html, top_html
from sweep.run_table import RunTable, about, unit_html
from runs.axes import axes_of, label_of

FRAMES_LIMIT = 12e6  # bytes of all frames of a page in its file
WATCHED_LIMIT = 60e6  # the limit for `bendlab view`, whose page stays on this machine
STILLS = 40  # a page with more runs that are not played shows no stills of them
MOST_CHARTS, MOST_PASS_CHARTS = 8, 12
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
        self.short = self._short_labels()
        self.settings = run_facts.Settings(self.runs)
        self.playback, self.packed = None, set()
        if self.played:
            self.playback = frames.playback(self.played, limit, self.labels | self.short, most_frames,
                                            chosen_runs.offered(self.runs, self.played))
            self.packed = {entry["id"] for entry in self.playback.data["runs"]}
        self.charts, self.live = [], None

    def sweep(self, run):
        return self.sweeps[self.sweep_of[run.id]]

    def _labels(self):
        """Run id → the label of the run: its values of the settings that the sweep varies."""
        labels = {}
        for run in self.runs:
            label = label_of(run, self.axes[self.sweep_of[run.id]][0])
            labels[run.id] = label if len(self.sweeps) == 1 or label == run.name else f"{run.name}: {label}"
        if len(self.runs) > 1 and len(set(labels.values())) == 1:
            labels = {id: f"{label} {id[:6]}" for id, label in labels.items()}
        return labels

    def _short_labels(self):
        """Labels of the runs that are played. A label has only the settings in which these runs differ."""
        pointers = {axis.pointer for varied, _ in self.axes for axis in varied}
        values = lambda pointer: {json.dumps(run.point.get(pointer), sort_keys=True) for run in self.played}
        differ = {pointer for pointer in pointers if len(values(pointer)) > 1}
        names = len({run.name for run in self.played}) > 1
        labels = {}
        for run in self.played:
            axes = [axis for axis in self.axes[self.sweep_of[run.id]][0] if axis.pointer in differ]
            label = label_of(run, axes)
            labels[run.id] = f"{run.name}: {label}" if names and label != run.name else label
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
        if len(self.runs) > 1:
            data["explorer"] = explorer(self)
        if live:
            data["live"] = live
        scripts = [self.playback.scripts if self.playback else "", *scripts]
        return page(f"bendlab: {self.title}", top_html(self), [part for part in parts if part],
                    made_of(self.runs, self.command), data, "\n".join(scripts))

    # --- sections

    def _motion(self):
        if not self.played:
            over = any(run.over for run in self.runs)
            reason = "The runs recorded no frames." if over else "There are no runs yet."
            return Part("motion", "Motion", f"<p class='grey'>{reason}</p>")
        count = sum(1 for run in self.runs if run.frames)
        here = len(self.packed)
        rest = f" {here} of {count} runs can be chosen below the picture." if count > len(self.played) else ""
        rest += " <code>--play ID</code> chooses other runs." if count > here else ""
        text = f"<p class='grey small'>{escape(self.why_these)}{rest}</p>" if self.why_these or rest else ""
        return Part("motion", "Motion", self.playback.players + text)

    def _against(self):
        """A section for each sweep: a table of its axes, and charts of its metrics against each axis."""
        alone = len(self.sweeps) == 1
        for i, sweep in enumerate(self.sweeps):
            varied, fixed = self.axes[i]
            drawn = charts.axis_charts(sweep, varied, self.numbers[i], self.command,
                                       f"s{i + 1}-")[:MOST_CHARTS]
            asked = self.asked and number_chart(sweep, varied, *self.asked, self.command,
                                                f"s{i + 1}-{ASKED}")
            drawn = [asked, *drawn] if asked else drawn
            if not varied and not asked:
                continue
            self.charts += drawn
            lead = f"<p>{escape(sweep.description)}</p>" if sweep.description and not alone else ""
            yield Part("sweep" if alone else f"sweep-{i + 1}", "The sweep" if alone else sweep.name,
                       lead + _axes_table(varied, fixed) + "".join(map(figure, drawn)),
                       "Sweep" if alone else sweep.name)

    def _explore(self):
        if len(self.runs) < 2:
            return None
        return Part("explore", "All runs at once",
                    "<p class='grey small'>Drag along a part of an axis to choose the runs whose curves "
                    "cross this part. The table, the groups and the other charts then show these runs. Click "
                    "a curve or a point to open a run, and to compare it with another run.</p>"
                    "<div id='explorer'></div>", "Explore")

    def _expected(self):
        rows = []
        for sweep in self.sweeps:
            checked = [(run, bound) for run in sweep.runs
                       for bound in expectations.check(sweep.settings, run)]
            for stated in expectations.expected_of(sweep.settings):
                rows.append(self._expectation_row(stated, [(run, bound) for run, bound in checked
                                                           if bound.same_bound(stated)]))
        if not rows:
            return None
        head = "".join(f"<th class='{kind}'>{name}</th>" for name, kind in (
            ("verdict", "t"), ("what is expected", "t"), ("worst", ""), ("in", "t"), ("why", "t")))
        return Part("expectations", "Expectations",
                    f"<div class='scroll'><table class='cards'><thead><tr>{head}</tr></thead>"
                    f"<tbody>{''.join(rows)}</tbody></table></div>")

    def _expectation_row(self, stated, checked):
        where = ", ".join(f"{pointer} {value}" for pointer, value in stated.where.items())
        what = f"{stated.metric.replace('_', ' ')} {stated.bound}" + (f", where {where}" if where else "")
        verdict, measured, place = status_html("none", "no run"), "", "<td></td>"
        if checked:
            held = sum(bound.holds for _, bound in checked)
            run, least = min(checked, key=lambda entry: (entry[1].holds, entry[1].margin))
            word = "holds" if held == len(checked) else "fails"
            count = held if word == "holds" else len(checked) - held
            verdict = status_html(word, f"{word} in {count} of {len(checked)}" if len(checked) > 1 else word)
            measured = "not measured" if least.measured is None else number_text(least.measured, 4)
            place = (f"<td class='t' data-run='{escape(run.id)}'><button type='button' class='opens'>"
                     f"{escape(self.labels[run.id])}</button></td>")
        return (
            f"<tr><td class='t'>{verdict}</td><td class='t'>{escape(what)}</td><td>{escape(measured)}</td>"
            f"{place}<td class='t text'>{escape(stated.why)}</td></tr>")

    def _over_time(self):
        run_looks = {run.id: look for run, look in zip(self.played, self._looks(self.played))}
        chart = charts.time_chart(self.played, self.short, run_looks, self.command, "over-time")
        if not chart:
            return None
        self.charts.append(chart)
        return Part("time", "Over time", figure(chart, "The runs that are played above.", titled=False))

    @staticmethod
    def _looks(runs):
        """The styles of the runs' curves: by model if all models differ, otherwise by number."""
        if len({run.model for run in runs}) == len(runs) and all(run.model for run in runs):
            return [looks.of_model(run.model) for run in runs]
        return [looks.of_place(i) for i in range(len(runs))]

    def _passes(self):
        drawn = []
        for i, sweep in enumerate(self.sweeps[:MOST_PASS_CHARTS]):
            chart = charts.pass_chart(sweep, self.axes[i][0], self.command, f"s{i + 1}-passes")
            if chart and len(self.sweeps) > 1:
                chart["title"] = f"Time per pass, {sweep.name}"
            drawn += [chart] if chart else []
        if not drawn:
            return None
        self.charts += drawn
        body = "".join(figure(chart, titled=len(self.sweeps) > 1) for chart in drawn)
        return Part("passes", "Time per pass", body, "Cost")

    @cached_property
    def summary(self):
        """Name → {label, unit, meaning} of every metric in the page's data."""
        all_of = lambda sweep: charts.numbers_of(sweep, most=None)
        several = map(all_of, self.sweeps) if len(self.runs) <= MOST_RUNS else self.numbers
        return {number["name"]: {key: number[key] for key in ("label", "unit", "meaning")}
                for numbers in several for number in numbers}

    def _stills(self):
        """({run id: data}, scripts) of the first and last frame of runs that are not played. Empty if these
        runs are more than STILLS."""
        unplayed = [run for run in self.runs if run.frames and run.file and run.id not in self.packed]
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


def figure(chart, note="", titled=True):
    """The element in which the page's script draws a chart."""
    text = " ".join(part for part in (chart.get("note", ""), note) if part)
    title = f"<b>{escape(chart['title'])}</b>" if titled else ""
    note = f"<span>{escape(text)}</span>" if text else ""
    caption = f"<figcaption>{title}{note}</figcaption>" if title or note else ""
    return f"<figure class='chart' data-chart='{chart['id']}' id='{chart['id']}'>{caption}</figure>"


def _axes_table(varied, fixed):
    row = lambda axis: (f"<tr><td class='t'><code>{escape(axis.pointer)}</code></td><td class='t text'>"
                        f"{escape(', '.join(axis.texts[:24]))}{' …' if len(axis.texts) > 24 else ''}"
                        f"{unit_html(axis.unit)}</td><td>{len(axis.values)}</td><td class='t text grey'>"
                        f"{escape(_beginning(axis.meaning))}</td></tr>")
    rows = "".join(map(row, [*varied, *fixed]))
    head = "<th class=t>axis</th><th class=t>values</th><th>count</th><th class=t>meaning</th>"
    return (f"<div class='scroll'><table class='cards'><thead><tr>{head}</tr></thead>"
            f"<tbody>{rows}</tbody></table></div>")


def _beginning(text, most=110):
    """A text, cut after a sentence or clause if it is longer than `most` characters."""
    if len(text) <= most:
        return text
    cut = max(text[:most].rfind(mark) for mark in (". ", "; ", ": ", ", "))
    return text[:cut if cut > 40 else most].rstrip(" ,;:") + " …"


# --- command line ------------------------------------------------------------------------------------------

def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("results", type=Path, nargs="+", metavar="RESULT",
                        help="folder of results, run's folder, run file or .sweep.json")
    where = parser.add_mutually_exclusive_group(required=True)
    where.add_argument("-o", "--out", type=Path, help="the page's file")
    where.add_argument("--cached", action="store_true", help="a file in the user's cache")
    parser.add_argument("--open", action="store_true", help="open the page in the browser")
    parser.add_argument("--play", action="append", default=[], metavar="ID",
                        help="a run to be played: the beginning of its id, or part of its folder's name")
    parser.add_argument("--figures", choices=list(chart_files.NO_DATE), metavar="FORMAT",
                        help="also write the charts as files beside the page: %(choices)s")
    parser.add_argument("--x", help="with --y: a chart against this metric or setting")
    parser.add_argument("--y", help="with --x: a chart of this metric or setting")
    parser.add_argument("--command", default="", help="the command that the page states as its origin")
    arguments = parser.parse_args()
    command = arguments.command or shlex.join(["./bendlab", "report", *map(str, arguments.results)])
    out = arguments.out or browser.cached_page(arguments.results)
    limit = WATCHED_LIMIT if arguments.cached else FRAMES_LIMIT
    try:
        report = Report(collect(arguments.results), command, arguments.play,
                        limit, asked=arguments.x and (arguments.x, arguments.y))
        write_page(out, report.html())
        files = written_figures(report, out.parent / "figures", arguments)
    except ValueError as error:
        tell(error)
        return 2
    except OSError as error:
        tell(f"the page could not be written to {out}: {error.strerror or error}. Name another file with -o")
        return 5
    print(out, flush=True)
    if files:
        print(files[0] if len(files) == 1 else f"{files[0].parent}: {len(files)} figures", flush=True)
    if arguments.open and not browser.opened(out.resolve().as_uri()):
        tell("there is no browser to open the page in: open the file yourself")
    return 0


def written_figures(report, folder, arguments):
    """Writes the charts as files if --figures is given; with --x and --y only the chart of these two metrics.
    Returns the files."""
    if not arguments.figures:
        return []
    wanted = [chart for chart in report.charts if not arguments.x or chart["id"].endswith(ASKED)]
    return chart_files.write(wanted, folder, arguments.figures)


def write_page(file, text):
    """Writes a page. An older page in this file stays until the new page is complete."""
    file.parent.mkdir(parents=True, exist_ok=True)
    part = file.with_name(f"{file.name}.{os.getpid()}.part")
    part.write_text(text, encoding="utf-8")
    part.replace(file)
