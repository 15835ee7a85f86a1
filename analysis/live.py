#!/usr/bin/env python3
"""Serves the page of a run that is being computed, at 127.0.0.1, under an address with a random part.

The page asks for new frames, which are read from the unfinished file of the run. A request with another path
or host name gets the status 404; a request with another method than GET gets 405. Ctrl-C ends the server.
"""
import right_python  # noqa: F401  (first: it may hand over to another Python)
import argparse
import secrets
import signal
import sys
from http.server import ThreadingHTTPServer
from pathlib import Path

from draw import frame_coding
from runs.collected import tell
from sweep import browser, live


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("run", type=Path, help="the run's folder or its unfinished file")
    parser.add_argument("--command", default="", help="the command that the page states as its origin")
    parser.add_argument("--open", action="store_true", help="open the page in the browser")
    parser.add_argument("--play", action="append", default=[], help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    frame_coding.compress_quickly()
    run = live.LiveRun(arguments.run, arguments.command)
    if run.file() is None:
        tell(f"there is no run in {arguments.run}: start the run first, then watch it")
        return 2
    token = secrets.token_urlsafe(24)
    with ThreadingHTTPServer(("127.0.0.1", 0), live.handler_of(run, token)) as server:
        address = f"http://127.0.0.1:{server.server_port}/{token}/"
        print(address, flush=True)
        tell("Ctrl-C ends the server")
        if arguments.open and not browser.opened(address):
            tell("there is no browser to open the page in: open the address yourself")
        for number in (signal.SIGINT, signal.SIGTERM):  # also if the shell told this process to ignore SIGINT
            signal.signal(number, lambda received, _: sys.exit(128 + received))
        server.serve_forever()


if __name__ == "__main__":
    sys.exit(main())
