"""Whether a process writes into a run's folder (lib/bendlab/io/folder_lock.hpp)."""
import fcntl
import os
import struct
from pathlib import Path

FLOCK = "hhqqi"  # struct flock: l_type, l_whence, l_start, l_len, l_pid


def is_locked(folder):
    """Whether a process, on this machine or another, holds the lock of the folder."""
    try:
        file = os.open(Path(folder) / "run.lock", os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK)
    except OSError:
        return False
    try:
        whole_file = struct.pack(FLOCK, fcntl.F_WRLCK, os.SEEK_SET, 0, 0, 0)
        return struct.unpack(FLOCK, fcntl.fcntl(file, fcntl.F_OFD_GETLK, whole_file))[0] != fcntl.F_UNLCK
    except OSError:  # a file system without locks
        return False
    finally:
        os.close(file)
