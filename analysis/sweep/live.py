"""The page of a run that is being computed, and the answers to a browser that shows this page (live.py)."""
import contextlib
import json
import secrets
import shutil
import tempfile
import threading
import time
from http.server import BaseHTTPRequestHandler
from pathlib import Path

from bendlab.results.lock import is_locked
from bendlab.results.load import load_run
from runs.collected import Sweep
from sweep.report import WATCHED_LIMIT, Report

POLL_S = 1.0  # time between two requests of the page, s
REST = 1  # seconds until the file is read again, per second that the last reading took
# The most frames of a page: fewer for a finer mesh, so that the page is made quickly.
MOST_PLACES = 300_000  # vertices times frames of a page; more would take longer than a second or two
FEWEST, MOST = 30, 240  # frames, whatever the mesh
NOTHING, NOT_YET = b"There is nothing here.\n", b"The run has no frame yet: reload the page in a moment.\n"
HEADERS = {"Cache-Control": "no-store", "X-Content-Type-Options": "nosniff", "Referrer-Policy": "no-referrer",
           "X-Frame-Options": "DENY", "Cross-Origin-Resource-Policy": "same-origin"}


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
                # an error if the file is being written; the next call reads it again
                with contextlib.suppress(OSError, KeyError, ValueError):
                    self._read_new()
                end = time.monotonic()
                self._not_before = end + REST * (end - begin)
            return self._report

    def _read_new(self):
        file = self.file()
        if file is None:
            return
        status = file.stat()
        goes_on = file.suffix == ".part" and is_locked(file.parent)
        seen = (file, status.st_mtime_ns, status.st_size, goes_on)
        if seen == self._seen:
            return
        with tempfile.TemporaryDirectory() as folder:
            copy = Path(folder) / file.name
            shutil.copyfile(file, copy)
            run = load_run(copy)
            if not run.frames:
                return
            run.status = "running" if goes_on else run.status
            sweep = Sweep(run.name, self._place, [run], files={run.id: file})
            most = MOST_PLACES // max(len(run.rest_positions), 1)
            report = Report([sweep], self._command, (), WATCHED_LIMIT, max(FEWEST, min(most, MOST)))
            report.live_page = report.html(live={"every": POLL_S, "frames": run.frames})
            text = report.playback.scripts.partition(">")[2].removesuffix("</script>")  # base64
            report.news = {  # the data that an open page needs to show the new frames
                "frames": run.frames, "time": float(run.metrics["time"][-1]), "status": run.status,
                "duration": run.get("/duration"), "run": report.playback.data["runs"][0], "scripts": text,
                "chart": next((chart for chart in report.charts if chart["id"] == "over-time"), None)}
        self._report, self._seen = report, seen


def handler_of(live, token):
    """The class that answers requests for a run."""

    class Handler(BaseHTTPRequestHandler):
        protocol_version = "HTTP/1.1"
        server_version, sys_version = "bendlab", ""

        def do_GET(self):
            path, _, query = self.path.partition("?")
            hosts = [f"{name}:{self.server.server_port}" for name in ("127.0.0.1", "localhost")]
            asked = [part.encode() for part in path.split("/")]
            known = len(asked) == 3 and secrets.compare_digest(asked[1], token.encode())
            if not (known and self.headers.get("Host") in hosts and asked[2] in (b"", b"frames")):
                return self._answer(404, "text/plain", NOTHING)
            report = live.report()
            if report is None:
                return self._answer(503, "text/plain", NOT_YET)
            if asked[2] == b"":
                return self._answer(200, "text/html; charset=utf-8", report.live_page.encode())
            if query == f"have={report.news['frames']}-{report.news['status']}":
                return self._answer(204, "application/json", b"")
            self._answer(200, "application/json", json.dumps(report.news).encode())

        def _answer(self, code, kind, body):
            self.send_response(code)
            for name, value in ({"Content-Type": kind, "Content-Length": str(len(body))} | HEADERS).items():
                self.send_header(name, value)
            self.end_headers()
            self.wfile.write(body)

        def send_error(self, code, message=None, explain=None):
            self.close_connection = True
            self._answer(405 if code == 501 else code, "text/plain", NOTHING)

        def log_message(self, *_):
            pass

    return Handler
