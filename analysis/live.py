#!/usr/bin/env python3
"""`bendlab view --live`: serves the page of a run while it is computed. `live.py --help` has the options."""
import right_python  # noqa: F401  (first: it may hand over to another Python)
import sys

from sweep import live

if __name__ == "__main__":
    sys.exit(live.main())
