"""What parts of pictures look like, said once for a page in place of once for each part."""

from __future__ import annotations

import re
from collections import Counter

from vstatics.tables.html import Markup

_TAG = re.compile(r"<(?:path|text|use|g)\b[^<>]*>")
_KEY = r"(?:fill|stroke|opacity|font|text-anchor|paint-order)[-a-z]*"
_LOOK = re.compile(f'(?: {_KEY}="[^"<>]*")+(?=[ />])')


def shared(page: Markup) -> tuple[Markup, Markup]:
    """A page whose pictures share their looks, and the rules of a style sheet for these.

    Examples
    --------
    >>> shown = Markup('<text x="1" fill="red">a</text><text x="2" fill="red">b</text>')
    >>> for part in shared(shown):
    ...     print(part)
    <text x="1" class="l0">a</text><text x="2" class="l0">b</text>
    .l0{fill:red}
    """
    looks = Counter(look for part in _TAG.findall(page) for look in _LOOK.findall(part))
    often = [look for look, count in looks.most_common() if count > 1]
    names = {look: f' class="l{number}"' for number, look in enumerate(often)}

    def short(part: re.Match[str]) -> str:
        return _LOOK.sub(lambda look: names.get(look[0], look[0]), part[0], count=1)

    rules = []
    for number, look in enumerate(often):  # ``fill="none"`` is ``fill:none``
        said = re.findall(r'([-a-z]+)="([^"]*)"', look)
        rules.append(f".l{number}{{{';'.join(f'{key}:{value}' for key, value in said)}}}")
    return Markup(_TAG.sub(short, page)), Markup("\n".join(rules))


def is_look(key: str) -> bool:
    """Whether an attribute of a part says what it looks like.

    >>> is_look("stroke-width"), is_look("d")
    (True, False)
    """
    return re.fullmatch(_KEY, key) is not None
