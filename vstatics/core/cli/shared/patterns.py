"""File names by patterns such as `*.yaml`, for shells that do not expand them."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Sequence

import click

from vstatics.core.errors import quoted

WILDCARDS, SIGNS = "*?", "*?["
"""Characters that make a name a pattern, and all special characters of patterns.

A bracket does not make a name a pattern, because file names can contain brackets.
"""


def expanded(names: Iterable[str]) -> list[str]:
    """Return the files that match names and patterns; `**` matches any folders except links.

    A file is listed once, even if several patterns and names match it.

    Raises
    ------
    UsageError
        If a pattern matches no file.

    Examples
    --------
    >>> expanded(["box.yaml", "-"])
    ['box.yaml', '-']
    """
    expansion = list[str]()
    by_pattern = set[str]()
    for name in names:
        if not any(sign in name for sign in SIGNS) or os.path.lexists(name):
            # Absolute paths are only needed after a pattern. A deleted folder does not have any.
            is_new = not by_pattern or os.path.abspath(name) not in by_pattern  # noqa: PTH100
            expansion += [name] * is_new
            continue
        files = sorted({path for path in _matching(name) if not os.path.isdir(path)})  # noqa: PTH112
        if not files and not any(sign in name for sign in WILDCARDS):
            files = [name]
        if not files:
            raise click.UsageError(f"no file matches {quoted(name)}")
        listed = {*map(os.path.abspath, expansion)}
        expansion += [path for path in files if os.path.abspath(path) not in listed]  # noqa: PTH100
        by_pattern.update(map(os.path.abspath, files))
    return expansion


def _matching(pattern: str) -> Iterator[str]:
    """Yield the paths that match a pattern with any number of `**`.

    The function `glob` would follow links, and would not end in a loop of links.
    """
    from glob import escape  # costs start-up time

    parts = pattern.replace(os.sep, "/").split("/")
    if "**" not in parts:
        yield from _below([""], parts)
        return
    place = parts.index("**")
    above, below = "/".join([*parts[:place], ""]), "/".join(parts[place + 1 :]) or "*"
    for top in _matching(above) if above else [""]:
        for folder, folders, _ in os.walk(top or os.curdir):
            folders[:] = [name for name in folders if not name.startswith(".")]
            path = os.path.join(folder if top else folder[2:], "")  # noqa: PTH118
            yield from _matching(escape(path) + below)


def _below(tops: Iterable[str], parts: Sequence[str]) -> Iterator[str]:
    """Yield the matching paths below folders, without links to a parent folder."""
    from glob import escape, glob, has_magic  # costs start-up time

    for top in tops:
        part, *inner_parts = parts
        paths = glob(escape(top) + part) if has_magic(part) else [top + part]  # noqa: PTH207
        for path in paths:
            if not inner_parts:
                yield from [path] * os.path.lexists(path)
            elif os.path.isdir(path or "/") and not (has_magic(part) and _is_above(path)):  # noqa: PTH112
                yield from _below([f"{path}/"], inner_parts)


def _is_above(path: str) -> bool:
    if not os.path.islink(path):  # noqa: PTH114
        return False
    folder = os.path.realpath(os.path.dirname(path) or os.curdir)  # noqa: PTH120
    target = os.path.realpath(path)
    return os.path.commonpath([folder, target]) == target
