#!/usr/bin/env python3
"""`bendlab report` and `bendlab view`: write a page of any runs. `report.py --help` has the options."""
import right_python  # noqa: F401  (first: it may hand over to another Python)
import sys

from sweep import report

if __name__ == "__main__":
    sys.exit(report.main())
