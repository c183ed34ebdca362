"""Pages of a picture in a series of files: NAME.svg, NAME-2.svg, NAME-3.svg.

The user names only the file of the first page. The files of further pages therefore contain a mark
that distinguishes them from other files. Only marked files are replaced or removed.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, suppress

from vstatics.core.errors import ReadError, of_file
from vstatics.core.jobs.files import replacing, set_aside

PAGE_KEY = "data-page"
"""Attribute of an SVG, or text key of a PNG, with the number of a further page."""
_MARK = re.compile(rb'(?:<svg\b[^>]*? data-page="|tEXtdata-page\0)([1-9]\d{0,5})')
_LOOKED_AT = 2000
"""Number of bytes at the beginning of a file that can contain the mark."""
_FURTHER = re.compile(r"(.+)-([1-9]\d{0,5})")


def page_name(path: str, number: int) -> str:
    """Return the file name of a page of a picture. Pages count from 1.

    >>> page_name("flows/box.svg", 1), page_name("flows/box.svg", 2)
    ('flows/box.svg', 'flows/box-2.svg')
    """
    stem, suffix = os.path.splitext(path)  # noqa: PTH122
    return path if number == 1 else f"{stem}-{number}{suffix}"


def replace_pages(path: str, pages: Sequence[bytes], mark: str = "") -> None:
    """Write all pages of a picture or none, and remove other pages of an earlier picture.

    Parameters
    ----------
    path : str
        File of the first page.
    pages : sequence of bytes
        Contents of the files.
    mark : str, optional
        Mark in temporary names; see `vstatics.core.jobs.files.replace`.

    Raises
    ------
    ReadError
        If a page would replace a file that is not a page of an earlier picture, or the first page
        would replace a further page of another picture.
    OSError
        If a page cannot be written.
    """
    _refuse(path, len(pages))
    with ExitStack() as stack:  # files are moved into place after all are written
        for number, page in enumerate(pages, 1):
            stack.enter_context(replacing(page_name(path, number), mark))(page)
    for stale in further_pages(path, len(pages)):
        os.unlink(stale)  # noqa: PTH108


def further_pages(path: str, count: int = 1) -> Iterator[str]:
    """Yield the existing files of the pages after the first `count` pages."""
    number = count + 1
    while _marked(page_name(path, number)) == number:
        yield page_name(path, number)
        number += 1


def set_pages_aside(path: str) -> str:
    """Rename all pages of an earlier picture; return the new name of the first page."""
    for further in further_pages(path):
        set_aside(further)
    return set_aside(path)


def _refuse(path: str, count: int) -> None:
    stem, suffix = os.path.splitext(path)  # noqa: PTH122
    named = _FURTHER.fullmatch(stem)
    if named and os.path.exists(named[1] + suffix) and _marked(path) == int(named[2]):  # noqa: PTH110
        message = f"is page {named[2]} of {named[1]}{suffix}: expected another name"
        raise ReadError([of_file("E448", path, message)])
    for number in range(2, count + 1):
        further = page_name(path, number)
        if os.path.lexists(further) and _marked(further) != number:
            message = f"exists already and would be page {number} of {path}: expected another name"
            raise ReadError([of_file("E447", further, message)])


def _marked(path: str) -> int:
    """Return the page number that marks a file; 0 without a mark."""
    if not os.path.isfile(path):  # noqa: PTH113 - a FIFO would never answer
        return 0
    with suppress(OSError), open(path, "rb") as file:  # noqa: PTH123
        mark = _MARK.search(file.read(_LOOKED_AT))
        return int(mark[1]) if mark else 0
    return 0
