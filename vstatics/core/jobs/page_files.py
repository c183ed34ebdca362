"""Pages of one picture in files beside one another: NAME.svg, NAME-2.svg, NAME-3.svg.

Nobody named the files of further pages. So these carry a mark, by which they are told from files
that somebody else has put there: only what has it is replaced, or removed when it is stale.
"""

from __future__ import annotations

import os
import re
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, suppress

from vstatics.core.errors import ReadError, of_file
from vstatics.core.jobs.files import replacing, set_aside

PAGE_KEY = "data-page"
"""Of an SVG that is a further page, with its number; of a PNG, as the key of a text."""
_MARK = re.compile(rb'(?:<svg\b[^>]*? data-page="|tEXtdata-page\0)([1-9]\d{0,5})')
_LOOKED_AT = 2000
"""Bytes of a file in which its mark would be."""
_FURTHER = re.compile(r"(.+)-([1-9]\d{0,5})")


def page_name(path: str, number: int) -> str:
    """The file of a page of a picture, from 1.

    >>> page_name("flows/box.svg", 1), page_name("flows/box.svg", 2)
    ('flows/box.svg', 'flows/box-2.svg')
    """
    stem, suffix = os.path.splitext(path)  # noqa: PTH122
    return path if number == 1 else f"{stem}-{number}{suffix}"


def replace_pages(path: str, pages: Sequence[bytes], mark: str = "") -> None:
    """Write the pages of a picture, all or none; the last ones of an earlier one are removed.

    Parameters
    ----------
    path : str
        The file of the first page.
    pages : sequence of bytes
        Each a file.
    mark : str, optional
        As of `vstatics.core.jobs.files.replace`.

    Raises
    ------
    ReadError
        If a page would take the place of a file that is no page of an earlier picture, or the
        picture that of a further page of another one.
    OSError
        If a page cannot be written.
    """
    _refuse(path, len(pages))
    with ExitStack() as stack:  # moved into place when all are written, the first page last
        for number, page in enumerate(pages, 1):
            stack.enter_context(replacing(page_name(path, number), mark))(page)
    for stale in further_pages(path, len(pages)):
        os.unlink(stale)  # noqa: PTH108


def further_pages(path: str, count: int = 1) -> Iterator[str]:
    """The files of the pages that a picture has behind so many."""
    number = count + 1
    while _marked(page_name(path, number)) == number:
        yield page_name(path, number)
        number += 1


def set_pages_aside(path: str) -> str:
    """Rename an earlier picture with its further pages; the name of its first page now."""
    for further in further_pages(path):
        set_aside(further)
    return set_aside(path)


def _refuse(path: str, count: int) -> None:
    """Keep the files of others."""
    stem, suffix = os.path.splitext(path)  # noqa: PTH122
    named = _FURTHER.fullmatch(stem)
    if named and os.path.exists(named[1] + suffix) and _marked(path) == int(named[2]):  # noqa: PTH110
        message = f"is page {named[2]} of {named[1]}{suffix}: expected another name"
        raise ReadError([of_file("E448", path, message)])
    for number in range(2, count + 1):
        further = page_name(path, number)
        if os.path.lexists(further) and _marked(further) != number:
            message = f"is there, and would be page {number} of {path}: expected another name"
            raise ReadError([of_file("E447", further, message)])


def _marked(path: str) -> int:
    """Which page a file says that it is; 0 if it says nothing."""
    if not os.path.isfile(path):  # noqa: PTH113 - a FIFO would never answer
        return 0
    with suppress(OSError), open(path, "rb") as file:  # noqa: PTH123
        found = _MARK.search(file.read(_LOOKED_AT))
        return int(found[1]) if found else 0
    return 0
