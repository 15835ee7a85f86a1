"""The page of any runs, sweeps or folders of results: how they move, their numbers against every axis, their
tables. `bendlab report` and `bendlab view` call it."""
import argparse
import json
import os
import shlex
import sys
from pathlib import Path

import browser
import chosen_runs
import expectations
import frames
import looks
import run_facts
import sweep_charts
import sweep_figures
from collected import collect, tell
from html_parts import Part, escape, number_text, page
from number_chart import number_chart
from origin import made_of
from page_answer import status_html, top_html
from run_table import RunTable, about, unit_html
from sweep_axes import axes_of, label_of

FRAMES_LIMIT = 12e6  # bytes of all frames of a page in its file
WATCHED_LIMIT = 60e6  # of `bendlab view`, whose page is for this machine
STILLS = 40  # as many runs as a page may have for each to have a still
MOST_CHARTS, MOST_PASS_CHARTS = 8, 12
ASKED = "asked"  # the end of the id of a chart that was asked for


class Report:
    """Everything that a page says of some sweeps."""

    def __init__(self, sweeps, command, play=(), limit=FRAMES_LIMIT, most_frames=None, asked=None):
        self.sweeps, self.command, self.limit = sweeps, command, limit
        self.asked = asked  # (x, y) of a chart of two numbers, or None
        self.axes = [axes_of(sweep) for sweep in sweeps]
        self.runs = list({run.id: run for sweep in sweeps for run in sweep.runs}.values())
        self.sweep_of = {run.id: i for i, sweep in reversed(list(enumerate(sweeps))) for run in sweep.runs}
        self.labels = self._labels()
        self.numbers = [sweep_charts.numbers_of(sweep) for sweep in sweeps]
        self.played, self.why_these = chosen_runs.choose(sweeps, [varied for varied, _ in self.axes], play)
        self.short = self._short_labels()
        self.settings = run_facts.Settings(self.runs)
        self.playback = None
        if self.played:
            self.playback = frames.playback(self.played, limit, self.short, most_frames)
        self.charts, self.live = [], None

    def sweep(self, run):
        return self.sweeps[self.sweep_of[run.id]]

    def _labels(self):
        """Run id → its place on its sweep."""
        labels = {}
        for run in self.runs:
            label = label_of(run, self.axes[self.sweep_of[run.id]][0])
            labels[run.id] = label if len(self.sweeps) == 1 or label == run.name else f"{run.name}: {label}"
        if len(self.runs) > 1 and len(set(labels.values())) == 1:
            labels = {id: f"{label} {id[:6]}" for id, label in labels.items()}
        return labels

    def _short_labels(self):
        """Of the runs that are played: what differs among them."""
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
        """The page. `live`: what its scripts need to ask for new frames."""
        self.live, self.charts = live, []
        table = Part("runs", "The runs", RunTable(self).html(), "Runs")
        parts = [self._motion(), *self._against(), self._expected(), self._over_time(), self._passes(), table]
        shared = self.playback.data if self.playback else {}
        stills, scripts = self._stills()
        packed = {entry["id"]: entry for entry in shared.get("runs", [])} | stills
        data = {**shared, "settings": [self.settings.base], "summary": self._summary(), "charts": self.charts,
                "runs": [packed.get(run.id, {}) | about(self, run) for run in self.runs]}
        if live:
            data["live"] = live
        scripts = [self.playback.scripts if self.playback else "", *scripts]
        return page(f"bendlab: {self.title}", top_html(self), [part for part in parts if part],
                    made_of(self.runs, self.command), data, "\n".join(scripts))

    # --- sections

    def _motion(self):
        if not self.played:
            over = any(run.over for run in self.runs)
            reason = "The runs recorded no frames." if over else "No run is there yet."
            return Part("motion", "Motion", f"<p class='grey'>{reason}</p>")
        count = sum(1 for run in self.runs if run.frames)
        rest = (f" {len(self.played)} of {count} runs are played here; <code>--play ID</code> names others."
                if count > len(self.played) else "")
        text = f"<p class='grey small'>{escape(self.why_these)}{rest}</p>" if self.why_these or rest else ""
        return Part("motion", "Motion", self.playback.players + text)

    def _against(self):
        """A section of each sweep: its axes, and its numbers against them."""
        alone = len(self.sweeps) == 1
        for i, sweep in enumerate(self.sweeps):
            varied, fixed = self.axes[i]
            charts = sweep_charts.axis_charts(sweep, varied, self.numbers[i], self.command,
                                              f"s{i + 1}-")[:MOST_CHARTS]
            asked = self.asked and number_chart(sweep, varied, *self.asked, self.command,
                                                f"s{i + 1}-{ASKED}")
            charts = [asked, *charts] if asked else charts
            if not varied and not asked:
                continue
            self.charts += charts
            lead = f"<p>{escape(sweep.description)}</p>" if sweep.description and not alone else ""
            yield Part("sweep" if alone else f"sweep-{i + 1}", "The sweep" if alone else sweep.name,
                       lead + _axes_table(varied, fixed) + "".join(map(figure, charts)),
                       "Sweep" if alone else sweep.name)

    def _expected(self):
        rows = []
        for sweep in self.sweeps:
            checked = [(run, each) for run in sweep.runs for each in expectations.check(sweep.settings, run)]
            for stated in expectations.expected_of(sweep.settings):
                rows.append(self._expectation_row(stated, [(run, each) for run, each in checked
                                                           if each.same_bound(stated)]))
        if not rows:
            return None
        head = "".join(f"<th class='{kind}'>{name}</th>" for name, kind in (
            ("verdict", "t"), ("what is expected", "t"), ("worst", ""), ("in", "t"), ("why", "t")))
        return Part("expectations", "Expectations",
                    f"<div class='scroll'><table class='cards'><thead><tr>{head}</tr></thead>"
                    f"<tbody>{''.join(rows)}</tbody></table></div>")

    def _expectation_row(self, stated, found):
        where = ", ".join(f"{pointer} {value}" for pointer, value in stated.where.items())
        what = f"{stated.metric.replace('_', ' ')} {stated.bound}" + (f", where {where}" if where else "")
        verdict, measured, place = status_html("none", "no run"), "", "<td></td>"
        if found:
            held = sum(each.holds for _, each in found)
            run, least = min(found, key=lambda entry: (entry[1].holds, entry[1].margin))
            word = "holds" if held == len(found) else "fails"
            count = held if word == "holds" else len(found) - held
            verdict = status_html(word, f"{word} in {count} of {len(found)}" if len(found) > 1 else word)
            measured = "not measured" if least.measured is None else number_text(least.measured, 4)
            place = (f"<td class='t' data-run='{escape(run.id)}'><button type='button' class='opens'>"
                     f"{escape(self.labels[run.id])}</button></td>")
        return (
            f"<tr><td class='t'>{verdict}</td><td class='t'>{escape(what)}</td><td>{escape(measured)}</td>"
            f"{place}<td class='t text'>{escape(stated.why)}</td></tr>")

    def _over_time(self):
        run_looks = {run.id: look for run, look in zip(self.played, self._looks(self.played))}
        chart = sweep_charts.time_chart(self.played, self.short, run_looks, self.command, "over-time")
        if not chart:
            return None
        self.charts.append(chart)
        return Part("time", "Over time", figure(chart, "The runs that are played above.", titled=False))

    @staticmethod
    def _looks(runs):
        """Those of their models, if each has another one."""
        if len({run.model for run in runs}) == len(runs) and all(run.model for run in runs):
            return [looks.of_model(run.model) for run in runs]
        return [looks.of_place(i) for i in range(len(runs))]

    def _passes(self):
        charts = []
        for i, sweep in enumerate(self.sweeps[:MOST_PASS_CHARTS]):
            chart = sweep_charts.pass_chart(sweep, self.axes[i][0], self.command, f"s{i + 1}-passes")
            if chart and len(self.sweeps) > 1:
                chart["title"] = f"Time per pass, {sweep.name}"
            charts += [chart] if chart else []
        if not charts:
            return None
        self.charts += charts
        body = "".join(figure(chart, titled=len(self.sweeps) > 1) for chart in charts)
        return Part("passes", "Time per pass", body, "Cost")

    def _summary(self):
        return {number["name"]: {key: number[key] for key in ("label", "unit", "meaning")}
                for numbers in self.numbers for number in numbers}

    def _stills(self):
        """First and last frame of the runs that are not played, if these are few: {id: data}, scripts."""
        others = [run for run in self.runs if run.frames and run.file and run not in self.played]
        data, scripts, size = {}, [], 0
        for run in others if len(others) <= STILLS else []:
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
    """The place of a chart in the page."""
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
    head = "<th class=t>axis</th><th class=t>values</th><th>how many</th><th class=t>what it is</th>"
    return (f"<div class='scroll'><table class='cards'><thead><tr>{head}</tr></thead>"
            f"<tbody>{rows}</tbody></table></div>")


def _beginning(text, most=110):
    """The beginning of a long text, to the end of a part of it."""
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
    parser.add_argument("--figures", choices=list(sweep_figures.NO_DATE), metavar="FORMAT",
                        help="write the charts as files beside the page, too: %(choices)s")
    parser.add_argument("--x", help="with --y: a chart against this number")
    parser.add_argument("--y", help="with --x: a chart of this number")
    parser.add_argument("--command", default="", help="the command that the page names as its own")
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
        tell("there is no browser to open it in: open the file yourself")
    return 0


def written_figures(report, folder, arguments):
    """The files of the charts as far as they are asked for: all, or with --x and --y that one alone."""
    if not arguments.figures:
        return []
    charts = [chart for chart in report.charts if not arguments.x or chart["id"].endswith(ASKED)]
    return sweep_figures.write(charts, folder, arguments.figures)


def write_page(file, text):
    """Writes a page; an older one stays until the new one replaces it."""
    file.parent.mkdir(parents=True, exist_ok=True)
    part = file.with_name(f"{file.name}.{os.getpid()}.part")
    part.write_text(text, encoding="utf-8")
    part.replace(file)


if __name__ == "__main__":
    sys.exit(main())
