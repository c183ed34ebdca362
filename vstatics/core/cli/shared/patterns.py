"""Names of files by patterns, where no shell has expanded them."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Sequence

import click

from vstatics.core.errors import quoted

WILDCARDS, SIGNS = "*?", "*?["
"""A name with brackets alone that is there no more is told as one that is not there."""


def expanded(names: Iterable[str]) -> list[str]:
    """The files of names and patterns; `**` stands for any folders, not through links.

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
            found += [name] * (os.path.abspath(name) not in by_pattern)  # noqa: PTH100
            continue
        files = sorted({one for one in _matching(name) if not os.path.isdir(one)})  # noqa: PTH112
        if not files and not any(sign in name for sign in WILDCARDS):
            files = [name]
        if not files:
            raise click.UsageError(f"no file matches {quoted(name)}")
        there = {*map(os.path.abspath, found)}
        found += [one for one in files if os.path.abspath(one) not in there]  # noqa: PTH100
        by_pattern.update(map(os.path.abspath, files))
    return found


def _matching(pattern: str) -> Iterator[str]:
    """What a pattern finds; `glob` itself follows links, round a loop without end."""
    from glob import escape  # costs start-up time

    parts = pattern.replace(os.sep, "/").split("/")
    if "**" not in parts:
        yield from _below([""], parts)
        return
    place = parts.index("**")
    above, below = "/".join([*parts[:place], ""]), "/".join(parts[place + 1 :]) or "*"
    for top in _matching(above) if above else [""]:
        for folder, folders, _ in os.walk(top or os.curdir):
            folders[:] = [one for one in folders if not one.startswith(".")]
            path = os.path.join(folder if top else folder[2:], "")  # noqa: PTH118
            yield from _matching(escape(path) + below)


def _below(tops: Iterable[str], parts: Sequence[str]) -> Iterator[str]:
    """Return what a pattern finds below some folders, but not by links to folders above these."""
    from glob import escape, glob, has_magic  # costs start-up time

    for top in tops:
        part, *others = parts
        paths = glob(escape(top) + part) if has_magic(part) else [top + part]  # noqa: PTH207
        for path in paths:
            if not others:
                yield from [path] * os.path.lexists(path)
            elif os.path.isdir(path or "/") and not (has_magic(part) and _is_above(path)):  # noqa: PTH112
                yield from _below([f"{path}/"], others)


def _is_above(path: str) -> bool:
    if not os.path.islink(path):  # noqa: PTH114
        return False
    folder = os.path.realpath(os.path.dirname(path) or os.curdir)  # noqa: PTH120
    target = os.path.realpath(path)
    return os.path.commonpath([folder, target]) == target
