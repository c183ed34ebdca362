"""Names of files by patterns, where no shell has expanded them."""

from __future__ import annotations

import os
from collections.abc import Iterable

import click

from vstatics.errors import quoted

WILDCARDS, SIGNS = "*?", "*?["
"""A name with brackets alone that is there no more is told as one that is not there."""


def expanded(names: Iterable[str]) -> list[str]:
    """The files of names and patterns; `**` stands for any folders.

    A file is there once, however many patterns find it, and whoever names it besides.

    Raises
    ------
    UsageError
        If a pattern has no file.

    Examples
    --------
    >>> expanded(["box.yaml", "-"])
    ['box.yaml', '-']
    """
    found = list[str]()
    by_pattern = set[str]()
    for name in names:
        if not any(sign in name for sign in SIGNS) or os.path.lexists(name):
            found += [name] * (os.path.normpath(name) not in by_pattern)
            continue
        from glob import glob  # costs start-up time

        files = sorted(one for one in glob(name, recursive=True) if not os.path.isdir(one))  # noqa: PTH112, PTH207
        if not files and not any(sign in name for sign in WILDCARDS):
            files = [name]
        if not files:
            raise click.UsageError(f"no file matches {quoted(name)}")
        there = {*map(os.path.normpath, found)}
        found += [one for one in files if os.path.normpath(one) not in there]
        by_pattern.update(map(os.path.normpath, files))
    return found
