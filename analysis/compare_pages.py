#!/usr/bin/env python3
"""Compares a page of your own runs with the committed page: compare_pages.py results/own/paper"""
import right_python  # noqa: F401  (first: it may hand over to another Python)

from tables import committed

if __name__ == "__main__":
    committed.main()
