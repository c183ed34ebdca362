"""Measure the table of docs/performance.md: ``python -m benchmarks [--page FILE] [WORD...]``."""

from __future__ import annotations

import argparse
import datetime as dt
import os
import re
import sys
import tempfile
from collections.abc import Sequence
from pathlib import Path

from benchmarks.measuring import Row, Setting, heading, machine
from benchmarks.peer import compiled
from benchmarks.rows import ROWS

PLACE = re.compile(r"(?<=<!-- bench -->\n).*?(?=<!-- end of bench -->)", re.DOTALL)
ONE_THREAD = dict.fromkeys(("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"), "1")


def table(rows: Sequence[Row], setting: Setting, *, with_long: bool) -> str:
    """Return a table in Markdown; print each row when it is measured."""
    lines = [heading()]
    print(heading(), flush=True)
    for row in rows:
        lines.append(row.unmeasured if row.is_long and not with_long else row.measured(setting))
        print(lines[-1], flush=True)
    return "\n".join(lines)


def with_table(page: str, text: str) -> str:
    """Return a page with another text between the lines `<!-- bench -->` and its end."""
    return PLACE.sub(lambda _: f"\n{text}\n\n", page)


def main() -> None:
    """Measure all rows, or those that contain a word, and write them to a page."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks")
    parser.add_argument("--boxes", action="store_true", help="also the search for eight gears")
    parser.add_argument("--page", type=Path, metavar="FILE", help="page that gets the table")
    parser.add_argument("--peer", type=Path, metavar="PROGRAM", help="instead of the peer in C")
    parser.add_argument("words", nargs="*", metavar="WORD", help="only rows with one of the words")
    given = parser.parse_args()
    words = given.words or [""]
    rows = [row for row in ROWS if any(word in row.calculation for word in words)]
    with tempfile.TemporaryDirectory() as folder:
        peer = given.peer.resolve() if given.peer else compiled(Path(folder))
        text = table(rows, Setting(Path(folder), peer), with_long=given.boxes)
    if given.page:
        command = "make bench BOXES=1" if given.boxes else "make bench"
        origin = f"{machine()}, {dt.datetime.now(tz=dt.UTC).date()}, `{command}`:"
        page = given.page.read_text("utf-8")
        given.page.write_text(with_table(page, f"{origin}\n\n{text}"), "utf-8")


if __name__ == "__main__":
    if any(os.environ.get(name) != number for name, number in ONE_THREAD.items()):
        again = [sys.executable, "-m", "benchmarks", *sys.argv[1:]]
        os.execve(sys.executable, again, {**os.environ, **ONE_THREAD})  # noqa: S606
    main()
