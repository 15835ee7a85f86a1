"""The checksum at the end of a finished run file. Layout: lib/bendlab/io/checksum.hpp."""
import subprocess
import sys
from functools import lru_cache
from pathlib import Path

import h5py
import xxhash

NAME = b"\nbendlab XXH3-128 "
LENGTH = len(NAME) + 32 + 1
FINISHED = 3  # exit code of the child process: the file is finished, so it should have a checksum
TIME_LIMIT = 30  # s, for a child process that reads an unsealed file


def checksum(path, size):
    """The checksum of the first `size` bytes, as hexadecimal digits."""
    state = xxhash.xxh3_128()
    with open(path, "rb") as file:
        while size > 0 and (block := file.read(min(size, 1 << 20))):
            state.update(block)
            size -= len(block)
    return state.hexdigest().encode()


def seal(path):
    """Appends the checksum to a file, as the program does when the file is finished."""
    digits = checksum(path, Path(path).stat().st_size)
    with open(path, "ab") as file:
        file.write(NAME + digits + b"\n")


def seal_of(path):
    """The state of a file: "whole" if its checksum is right, "broken" if its checksum is wrong, "none" if it
    has no checksum, because it is unfinished or was not written by bendlab."""
    size = Path(path).stat().st_size
    if size < LENGTH:
        return "none"
    with open(path, "rb") as file:
        file.seek(size - LENGTH)
        end = file.read()
    if not (end.startswith(NAME) and end.endswith(b"\n")):
        return "none"
    return "whole" if end[len(NAME):-1] == checksum(path, size - LENGTH) else "broken"


def require_readable(path):
    """Raises OSError if HDF5 may crash on the file: the checksum is wrong, or the file has no checksum and a
    child process could not read it."""
    path = Path(path)
    if not path.is_file():
        raise OSError(f"{path} is not a file")
    status = path.stat()
    why = _problem(str(path), status.st_mtime_ns, status.st_ctime_ns, status.st_size, status.st_ino)
    if why:
        raise OSError(f"{path} {why}")


@lru_cache(maxsize=None)
def _problem(path, *_):
    seal = seal_of(path)
    if seal == "broken":
        return "was changed after it was written: its checksum does not match. Run its config again"
    if seal == "none":
        if not h5py.is_hdf5(path):
            return "cannot be read as a run file: it is not an HDF5 file"
        try:
            child = subprocess.run([sys.executable, __file__, path], timeout=TIME_LIMIT, check=False,
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        except subprocess.TimeoutExpired:
            return f"cannot be read: the HDF5 library was still reading it after {TIME_LIMIT} s"
        if child.returncode == FINISHED:
            return ("was changed after it was written: it is finished, but has no checksum. Run its config "
                    "again")
        if child.returncode:
            return "is damaged: the HDF5 library cannot read it"
    return ""


def _read_everything(path):
    from facts import Facts  # found because this script is in its folder
    with h5py.File(path, "r") as file:
        if "facts" in file and Facts(file).status in ("complete", "implausible", "diverged"):
            sys.exit(FINISHED)
        def read(_, node):
            dict(node.attrs)
            if isinstance(node, h5py.Dataset):
                node[()]
        read("", file)
        file.visititems(read)


if __name__ == "__main__":
    _read_everything(sys.argv[1])
