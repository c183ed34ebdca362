"""Sections of a page packed into one script, which puts them in their places as the page opens.

Pictures and tables of gears are alike, farther apart than deflate looks back. So what stood
before is told by its place first: a byte 1, where it starts, how long it is, ``1 120,48;``.
"""

from __future__ import annotations

import base64
import re
import zlib
from collections.abc import Iterator
from importlib.resources import files

from vstatics.tables.html import Markup, tag
from vstatics.texts import tr

_SECTION = re.compile(r'(?=<section (?:class="[^"]*" )?id=")')
_HEADED = re.compile(r'(<section [^>]*id="([^"]*)"[^>]*><h2>.*?</h2>)(.*)(</section>)', re.DOTALL)
_BLOCK = 24
"""Bytes that are compared first: shorter repetitions are left to deflate."""
_LEAST = 32
"""Of what is told by its place."""
_BETWEEN = "\2"
"""Sections."""
_OWN_SIGNS = {1: "\ufffd", 2: "\ufffd"}
"""What no text of a page may have here."""
_NO_SCRIPT = "This page calculates, for which it needs scripts."


def packed(page: str, kept: frozenset[str]) -> str:
    """A page whose sections stand in a script, packed, but for those with some ids.

    Examples
    --------
    >>> shown = '<main><section id="a"><h2>A</h2><p>1</p></section></main>'
    >>> packed(shown, frozenset("a")) == shown
    True
    >>> packed(shown, frozenset()).partition("</main>")[0]
    '<main><section id="a"><h2>A</h2><div data-packed></div></section>'
    """
    main, end, rest = page.partition("</main>")
    contents: list[str] = []

    def taken(found: re.Match[str]) -> str:
        start, name, content, close = found.groups()
        if name in kept:
            return found[0]
        contents.append(content)
        return f"{start}<div data-packed></div>{close}"

    main = "".join(_HEADED.sub(taken, one) for one in _SECTION.split(main))
    if not contents:
        return page
    text = _BETWEEN.join(one.translate(_OWN_SIGNS) for one in contents)
    plain = text.encode(errors="backslashreplace")
    deflated = zlib.compress(b"".join(repeated(plain)), 9, wbits=-15)
    told = Markup(base64.b64encode(deflated).decode())
    script = Markup((files(__package__) / "unpack.js").read_text(encoding="utf-8"))
    scripts = tag("script", told, type="text/plain", id="packed") + tag("script", script)
    return f"{main}{end}{tag('noscript', tr(_NO_SCRIPT))}{scripts}{rest}"


def repeated(text: bytes) -> Iterator[bytes]:
    r"""A text in which what stood before is told by its place.

    Examples
    --------
    >>> list(repeated(b"0123456789" * 7 + b"."))
    [b'012345678901234567890123456789', b'\x010,40;', b'.']
    """
    seen: dict[bytes, int] = {}
    start = place = known = 0
    while place < len(text) - _BLOCK:
        while known + _BLOCK <= place:
            seen.setdefault(text[known : known + _BLOCK], known)
            known += _BLOCK // 2
        found = seen.get(text[place : place + _BLOCK])
        if found is None:
            place += 1
            continue
        back = 0
        while back < min(found, place - start) and text[found - back - 1] == text[place - back - 1]:
            back += 1
        long = back + _BLOCK + _alike(text, found + _BLOCK, place + _BLOCK)
        found, place = found - back, place - back
        if long < _LEAST:
            place += back + 1
            continue
        yield text[start:place]
        yield b"\x01%d,%d;" % (found, long)
        place += long
        start = place
    yield text[start:]


def _alike(text: bytes, one: int, other: int) -> int:
    """How many bytes are the same from two places on."""
    long, step = 0, 256
    while step:
        while other + long + step <= len(text) and (
            text[one + long : one + long + step] == text[other + long : other + long + step]
        ):
            long += step
        step //= 4
    return long
