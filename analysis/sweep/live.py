"""Serves the page of a run that is being computed, at 127.0.0.1, under an address with a random part.

The page asks for new frames, which are read from the unfinished file of the run. A request with another path
or host name gets the status 404; a request with another method than GET gets 405. Ctrl-C ends the server.
"""
import argparse
import json
import secrets
import shutil
import signal
import tempfile
import threading
import time
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

import numpy as np

from draw import frame_coding
from sweep import browser
from runs.collected import Sweep, tell
from bendlab.results.load import load_run
from sweep.report import WATCHED_LIMIT, Report

POLL_S = 1.0  # time between two requests of the page, s
REST = 1  # seconds until the file is read again, per second that the last reading took
MOST_PLACES = 300_000  # vertices times frames of a page; more would take longer than a second or two
FEWEST, MOST = 30, 240  # frames, whatever the mesh


class LiveRun:
    """A run with the frames that are written so far. The file of the run is copied before it is read, because
    the writer locks the file."""

    def __init__(self, place, command):
        self._place, self._command = Path(place), command
        self._seen, self._report, self._turn, self._not_before = None, None, threading.Lock(), 0.0

    def file(self):
        """The finished or unfinished file of the run; None before the run's first frame."""
        if self._place.is_file():
            whole = self._place.parent / "run.vtkhdf"
            return whole if whole.exists() else self._place
        begun = [path for path in self._place.glob("**/run.vtkhdf*") if path.suffix in (".vtkhdf", ".part")]
        return max(begun, key=lambda path: path.stat().st_mtime, default=None)

    def report(self):
        """The Report of the run with the frames that are written so far; None without a frame. If the file
        cannot be read now, the last Report that could be made."""
        with self._turn:
            begin = time.monotonic()
            if begin >= self._not_before:
                try:
                    self._read_new()
                # the file is being written; the next call reads it again
                except (OSError, KeyError, ValueError):
                    pass
                end = time.monotonic()
                self._not_before = end + REST * (end - begin)
            return self._report

    def _read_new(self):
        file = self.file()
        if file is None:
            return
        status = file.stat()
        seen = (file, status.st_mtime_ns, status.st_size)
        if seen == self._seen:
            return
        with tempfile.TemporaryDirectory() as folder:
            copy = Path(folder) / file.name
            shutil.copyfile(file, copy)
            run = load_run(copy)
            if not run.frames:
                return
            run.status = "running" if file.suffix == ".part" else run.status
            sweep = Sweep(run.name, self._place, [run], files={run.id: file})
            report = Report([sweep], self._command, (), WATCHED_LIMIT, most_frames(run))
            report.live_page = report.html(live={"every": POLL_S, "frames": run.frames})
            report.news = self._news(report, run)
        self._report, self._seen = report, seen

    @staticmethod
    def _news(report, run):
        """The data that an open page needs to show the new frames."""
        entry = report.playback.data["runs"][0]
        return {"frames": run.frames, "time": float(run.metrics["time"][-1]), "status": run.status,
                "duration": run.get("/duration"), "run": entry, "scripts": frames_of(report.playback.scripts),
                "chart": next((chart for chart in report.charts if chart["id"] == "over-time"), None)}


def most_frames(run):
    """The largest number of frames of a page: smaller for a finer mesh, so that the page is made quickly."""
    return int(np.clip(MOST_PLACES // max(len(run.rest_positions), 1), FEWEST, MOST))


def frames_of(script):
    """The base64 text of frames, without the script element around it."""
    return script[script.index(">") + 1:script.rindex("</script>")] if "</script>" in script else ""


def handler_of(live, token):
    """The class that answers requests for a run."""

    class Handler(BaseHTTPRequestHandler):
        protocol_version = "HTTP/1.1"
        server_version, sys_version = "bendlab", ""

        def do_GET(self):
            path, _, query = self.path.partition("?")
            hosts = [f"{name}:{self.server.server_port}" for name in ("127.0.0.1", "localhost")]
            host_known = self.headers.get("Host") in hosts
            asked = [part.encode() for part in path.split("/")]
            known = len(asked) == 3 and secrets.compare_digest(asked[1], token.encode())
            if not (host_known and known and asked[2] in (b"", b"frames")):
                return self._answer(404, "text/plain", b"There is nothing here.\n")
            report = live.report()
            if report is None:
                text = b"The run has no frame yet: reload the page in a moment.\n"
                return self._answer(503, "text/plain", text)
            if asked[2] == b"":
                return self._answer(200, "text/html; charset=utf-8", report.live_page.encode())
            if query == f"have={report.news['frames']}-{report.news['status']}":
                return self._answer(204, "application/json", b"")
            self._answer(200, "application/json", json.dumps(report.news).encode())

        def _answer(self, code, kind, body):
            self.send_response(code)
            self.send_header("Content-Type", kind)
            self.send_header("Content-Length", str(len(body)))
            for name, value in (("Cache-Control", "no-store"), ("X-Content-Type-Options", "nosniff"),
                                ("Referrer-Policy", "no-referrer"), ("X-Frame-Options", "DENY"),
                                ("Cross-Origin-Resource-Policy", "same-origin")):
                self.send_header(name, value)
            self.end_headers()
            self.wfile.write(body)

        def send_error(self, code, message=None, explain=None):
            self.close_connection = True
            self._answer(405 if code == 501 else code, "text/plain", b"There is nothing here.\n")

        def log_message(self, *_):
            pass

    return Handler


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("run", type=Path, help="the run's folder or its unfinished file")
    parser.add_argument("--command", default="", help="the command that the page states as its origin")
    parser.add_argument("--open", action="store_true", help="open the page in the browser")
    parser.add_argument("--play", action="append", default=[], help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    frame_coding.compress_quickly()
    live = LiveRun(arguments.run, arguments.command)
    if live.file() is None:
        tell(f"there is no run in {arguments.run}: start the run first, then watch it")
        return 2
    token = secrets.token_urlsafe(24)
    server = ThreadingHTTPServer(("127.0.0.1", 0), handler_of(live, token))
    server.daemon_threads = True
    address = f"http://127.0.0.1:{server.server_port}/{token}/"
    print(address, flush=True)
    tell("Ctrl-C ends the server")
    if arguments.open and not browser.opened(address):
        tell("there is no browser to open the page in: open the address yourself")
    try:
        for number in (signal.SIGINT, signal.SIGTERM):  # also if the shell told this process to ignore SIGINT
            signal.signal(number, _stop)
        server.serve_forever()
    except _Stopped as stopped:
        return 128 + stopped.args[0]
    finally:
        server.server_close()


class _Stopped(Exception):
    """A signal ended the server; the argument is the number of the signal."""


def _stop(number, _):
    raise _Stopped(number)
