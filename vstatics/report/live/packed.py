"""Sections of a page packed into one script, which puts them in their places as the page opens.

Pictures and tables of gears are alike, far apart from one another: LZMA looks back to all of them.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from importlib.resources import files

from vstatics.tables.html import Markup, tag
from vstatics.texts import tr

_SECTION = re.compile(r'(?=<section (?:class="[^"]*" )?id=")')
_HEADED = re.compile(r'(<section [^>]*id="([^"]*)"[^>]*><h2>.*?</h2>)(.*)(</section>)', re.DOTALL)
_LOOKS_BACK = 1 << 23
"""So far LZMA looks back. [bytes]"""
_CONTEXT = 4
"""So many bits of the byte before tell what comes, as `unpack.js` knows."""
_BETWEEN = "\2"
"""Sections."""
_OWN_SIGN = {2: "\ufffd"}
"""What no text of a page may have here."""
_NO_SCRIPT = "This page calculates, for which it needs scripts."


def packed(page: str, kept: frozenset[str]) -> str:
    """A page whose sections stand in a script, packed, but for those with some ids.

    A Python that was built without LZMA leaves the page as it is.

    Examples
    --------
    >>> shown = '<main><section id="a"><h2>A</h2><p>1</p></section></main>'
    >>> packed(shown, frozenset("a")) == shown
    True
    >>> packed(shown, frozenset()).partition("</main>")[0]
    '<main><section id="a"><h2>A</h2><div data-packed></div></section>'
    """
    try:
        import lzma
    except ImportError:
        return page
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
    text = _BETWEEN.join(one.translate(_OWN_SIGN) for one in contents)
    method = {
        "id": lzma.FILTER_LZMA1,
        "preset": 9 | lzma.PRESET_EXTREME,
        "dict_size": _LOOKS_BACK,
        "lc": _CONTEXT,
        "lp": 0,
        "pb": 0,
    }
    plain = text.encode(errors="backslashreplace")
    small = lzma.compress(plain, lzma.FORMAT_RAW, filters=[method])
    told = Markup("".join(written(small)))
    script = Markup((files(__package__) / "unpack.js").read_text(encoding="utf-8"))
    scripts = tag("script", told, type="text/plain", id="packed") + tag("script", script)
    return f"{main}{end}{tag('noscript', tr(_NO_SCRIPT))}{scripts}{rest}"


def written(data: bytes) -> Iterator[str]:
    """Bytes as letters: thirteen bits, the least first, are two digits to the base of 91.

    Letters from # on without <, which might end the script: a twelfth less than base64.

    >>> "".join(written(bytes([255, 31, 1])))
    '$~+#'
    """
    value = bits = 0
    for byte in data:
        value |= byte << bits
        bits += 8
        if bits >= 13:
            yield _letters(value & 8191)
            value >>= 13
            bits -= 13
    if bits:
        yield _letters(value)


def _letters(value: int) -> str:
    return "".join(chr(35 + digit + (digit >= 25)) for digit in divmod(value, 91)[::-1])
