"""Stops the program while it reads, checks, plans and computes. It must end soon.

    stops.py PROGRAM [STOPS]      exit 1 if a process ignores SIGINT or SIGTERM for more than 10 s
"""
import random
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from program import start, write_config

PATIENCE = 10  # s


def main(program, stops=24, seed=1):
    chance = random.Random(seed)
    ignored = stopped = 0
    slowest = 0.0
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        many = [0.01 + 1e-7 * step for step in range(5000)]
        write_config(folder, "many", mesh={"cells": 3}, duration=0.05, sweep={"/solver/dt": many})
        write_config(folder, "wrong", unknown={"key": 1}, sweep={"/solver/dt": ["no"] * 5000})
        commands = [("run", "many.json"), ("plan", "many.json"), ("validate", "many.json", "--strict"),
                    ("validate", "wrong.json"), ("list", "results")]
        (folder / "results").mkdir()
        for count in range(stops):
            command = commands[count % len(commands)]
            process = start(program, *command, folder=folder)
            time.sleep(chance.random() * 2)
            process.send_signal(chance.choice((signal.SIGINT, signal.SIGTERM)))
            sent = time.monotonic()
            try:
                process.communicate(timeout=PATIENCE)
                slowest = max(slowest, time.monotonic() - sent)
                stopped += process.returncode in (130, 143, -signal.SIGINT, -signal.SIGTERM)
            except subprocess.TimeoutExpired:
                ignored += 1
                print(f"ignored the signal: {' '.join(command)}", flush=True)
                process.kill()
                process.communicate()
    print(f"{stops} signals: {stopped} stopped a process, the slowest within {slowest:.1f} s, "
          f"{ignored} were ignored")
    return 1 if ignored or not stopped else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], *map(int, sys.argv[2:])))
