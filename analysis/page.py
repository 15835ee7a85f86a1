#!/usr/bin/env python3
"""Writes a page of the project: index.html and its data, from the runs in a folder of results.

    python3 analysis/page.py stiffness --again --committed
"""
import right_python  # noqa: F401  (first: it may hand over to another Python)
import argparse
from pathlib import Path

from pages import accuracy, paper, performance, plain, stability, start, stiffness, verification
from pages.project import KEPT, draw, drawn, lay_out
from tables import committed

PAGES = {page.PAGE.name: page
         for page in (paper, verification, stiffness, accuracy, stability, performance, plain)}


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("page", choices=PAGES)
    parser.add_argument("--results", type=Path, help="folder with the runs (default: results); for "
                                                     "performance, the output file of `bendlab bench --json` "
                                                     "(default: bench.json in the page's folder)")
    place = parser.add_mutually_exclusive_group()
    place.add_argument("--out", type=Path, help="folder for the page (default: results/own/PAGE)")
    place.add_argument("--committed", action="store_true", help="write the project's own page, results/PAGE")
    how = parser.add_mutually_exclusive_group()
    how.add_argument("--again", action="store_true", help=f"write index.html from {KEPT}; runs are not read")
    how.add_argument("--only", metavar="FIGURE", nargs="+", default=[],
                     help="draw only these figures again, and keep all other figures")
    how.add_argument("--figure", help="draw only this figure, without a page, and print the picture files")
    parser.add_argument("--pdf", action="store_true", help="write every figure as PDF, too")
    arguments = parser.parse_args()
    module = PAGES[arguments.page]
    page = module.PAGE
    out = arguments.out or committed.home(page.name, arguments.committed)
    results = arguments.results or (out / "bench.json" if module is performance else Path("results"))
    ids = [figure.id for figure in page.figures]
    if unknown := [name for name in [*arguments.only, *filter(None, [arguments.figure])] if name not in ids]:
        parser.error(f"the page {page.name} has no figure {unknown[0]}; its figures are: {', '.join(ids)}")
    if arguments.again and not (out / KEPT).exists():
        parser.error(f"--again needs {out / KEPT}, which does not exist. Leave out --again, or name the "
                     "folder of a page with --out or --committed")
    if not arguments.again and not results.exists():
        parser.error(f"{results} does not exist: make it with {page.command}, or name another --results")
    if arguments.figure:
        out.mkdir(parents=True, exist_ok=True)
        section = drawn(page.figures[ids.index(arguments.figure)], results, out, page.command)
        for name, _ in section.pictures:
            print(out / name, flush=True)
        return
    try:
        sections = () if arguments.again else draw(page, results, out, arguments.only, arguments.pdf)
        lay_out(page, out, sections)
    except ValueError as error:
        if KEPT not in str(error):
            raise
        parser.error(str(error))
    if out.name in PAGES:
        start.write(out.parent)
    print(out / "index.html", flush=True)


if __name__ == "__main__":
    main()
