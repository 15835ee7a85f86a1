"""The index of a folder of results: a file with a line for each run (experiments/campaign/run_index.hpp)."""
import json
import os
import secrets
from pathlib import Path

import xxhash

NAME = "runs.index"
FIRST = b"bendlab index 2\n"
HEAD = ("id", "name", "status", "frames", "wall_s", "cpu_s", "step_cpu_s", "metrics", "constraints", "passes")
PARTS = ("summary", "provenance", "config")  # the parts of a line after its head


def stamp_of(path):
    """(size, modified, changed) of a file, in bytes and ns. A line of an index has this stamp, or is old."""
    status = os.stat(path)
    return status.st_size, status.st_mtime_ns, status.st_ctime_ns


class Index:
    """What an index says about the finished runs below its folder. A missing or damaged index is read as an
    empty index."""

    def __init__(self, folder):
        self.folder, self._lines = Path(folder), {}  # path below the folder → line
        try:
            data = (self.folder / NAME).read_bytes()
        except OSError:
            return
        last = data.rfind(b"\n", 0, -1) + 1
        if not data.startswith(FIRST) or last < len(FIRST) or data[last:] != _checksum(data[:last]):
            return
        for line in os.fsdecode(data[len(FIRST):last]).split("\n")[:-1]:
            self._lines[line[:line.index("\t")]] = line

    def __len__(self):
        return len(self._lines)

    def find(self, path, stamp):
        """{id, name, …, summary, provenance, config} of a file (str) below the folder; None if the index has
        no line of this file with this stamp."""
        line = self._lines.get(path[len(str(self.folder)) + 1:])
        if line is None:
            return None
        _, size, modified, changed, parts = line.split("\t", 4)
        if (int(size), int(modified), int(changed)) != stamp:
            return None
        head, *parts = json.loads(f"[{parts.replace(chr(9), ',')}]")  # no JSON text has a tab
        return {**head, **dict(zip(PARTS, parts))}

    def put(self, path, stamp, run):
        """Adds the line of a file (str) below the folder. `run` is what the file says."""
        parts = [{name: run[name] for name in HEAD}, *(run[name] for name in PARTS)]
        name = path[len(str(self.folder)) + 1:]
        if "\t" in name or "\n" in name:
            return  # the program does not index such files either
        texts = (json.dumps(part, separators=(",", ":")) for part in parts)
        self._lines[name] = "\t".join([name, *map(str, stamp), *texts])

    def write(self):
        """Replaces the index on the disk in one step. Does nothing if the folder cannot be written."""
        lines = os.fsencode("".join(line + "\n" for name, line in sorted(self._lines.items())
                                    if os.path.isfile(f"{self.folder}/{name}")))
        draft = self.folder / f"{NAME}.{os.getpid()}-{secrets.token_hex(8)}.tmp"
        try:
            with open(draft, "xb") as file:
                file.write(FIRST + lines + _checksum(FIRST + lines))
            os.replace(draft, self.folder / NAME)
        except OSError:  # somebody else's folder, or a full disk
            draft.unlink(missing_ok=True)


def _checksum(data):
    return xxhash.xxh3_64_hexdigest(data).encode() + b"\n"
