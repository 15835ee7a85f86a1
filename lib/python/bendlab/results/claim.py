"""Whether a process writes into a run's folder (lib/bendlab/io/claim.hpp)."""
import os
from pathlib import Path


def is_owned(folder):
    """Whether the folder's owner lives. An owner on another machine or in a container counts as alive."""
    claims = {int(path.suffix[1:]): path for path in Path(folder).glob("run.claim.*")
              if path.suffix[1:].isdigit()}
    try:
        _, _, process, beginning, place, *_ = claims[max(claims)].read_text(encoding="utf-8").split("\n")
        boot = Path("/proc/sys/kernel/random/boot_id").read_text(encoding="utf-8").strip()
        if place != f"{boot} {os.readlink('/proc/self/ns/pid')}":
            return True
        fields = Path(f"/proc/{process}/stat").read_text(encoding="utf-8").rpartition(")")[2].split()
        return fields[0] not in "ZX" and fields[19] == beginning  # proc(5): fields 3 and 22; Z and X: ended
    except (OSError, ValueError):  # nobody owns the folder, or its owner has ended
        return False
