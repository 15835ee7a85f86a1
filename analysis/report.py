#!/usr/bin/env python3
"""Makes the page of runs, sweeps or folders of results. The page shows how the cloth moves, charts of the
metrics, and tables. `bendlab report` and `bendlab view` call this script."""
import right_python  # noqa: F401  (first: it may hand over to another Python)
import argparse
import os
import shlex
import sys
from pathlib import Path

from draw import chart_files
from runs.collected import collect, tell
from sweep import browser
from sweep.report import ASKED, FRAMES_LIMIT, WATCHED_LIMIT, Report


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
    files = []
    try:
        report = Report(collect(arguments.results), command, arguments.play, limit,
                        asked=arguments.x and (arguments.x, arguments.y))
        write_page(out, report.html())
        # with --x and --y only the chart of these two metrics
        wanted = [chart for chart in report.charts if not arguments.x or chart["id"].endswith(ASKED)]
        if arguments.figures:
            files = chart_files.write(wanted, out.parent / "figures", arguments.figures)
    except ValueError as error:
        tell(error)
        return 2
    except OSError as error:
        tell(f"the page could not be written to {out}: {error.strerror or error}. Name another file with -o")
        return 5
    print(out, flush=True)
    if arguments.x and not wanted:
        tell(f"no chart is drawn of {arguments.y} against {arguments.x}: no finished run has both")
    elif arguments.figures and not files:
        tell("no figure is drawn: no run has finished, or the runs do not differ")
    if files:
        print(files[0] if len(files) == 1 else f"{files[0].parent}: {len(files)} figures", flush=True)
    if arguments.open and not browser.opened(out.resolve().as_uri()):
        tell("there is no browser to open the page in: open the file yourself")
    return 0


def write_page(file, text):
    """Writes a page. An older page in this file stays until the new page is complete."""
    file.parent.mkdir(parents=True, exist_ok=True)
    part = file.with_name(f"{file.name}.{os.getpid()}.part")
    part.write_text(text, encoding="utf-8")
    part.replace(file)


if __name__ == "__main__":
    sys.exit(main())
