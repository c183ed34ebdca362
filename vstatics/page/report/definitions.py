"""Paths and hatches that several pictures of a page share, defined once per page."""

from __future__ import annotations

import re
from collections import Counter

from vstatics.core.tables.html import Markup, joined, tag

_PATH = re.compile(r'<path\b([^<>]*?) d="([^"]*)"([^<>]*?)(?:/>|>(.*?)</path>)', re.DOTALL)
_HATCHES = re.compile(r"<defs>((?:<pattern\b.*?</pattern>)+)</defs>", re.DOTALL)
_HATCH = re.compile(r'(<pattern\b[^<>]*?) id="([^"]*)"(.*?</pattern>)', re.DOTALL)
_REFERENCE = re.compile(r"url\(#([^)]+)\)")
REFERENCE, DEFINITION = 6, 22
"""Letters of a reference to a path, and of its definition, in addition to the path itself."""


def shared_definitions(page: Markup) -> Markup:
    """Return a page in which hatches and long repeated paths are defined at the beginning.

    Examples
    --------
    >>> path = Markup('<path d="M1 2h5.5v5.5h5.5v5.5h5.5v5.5h5.5v5.5" class="l1"/>')
    >>> shared_definitions(joined(path, path)).partition("</svg>")[2]
    '<use href="#p0" class="l1"/><use href="#p0" class="l1"/>'
    """
    hatches = {(start, end): name for start, name, end in _HATCH.findall(page)}
    names = {name: hatches[start, end] for start, name, end in _HATCH.findall(page)}
    page = Markup(_HATCHES.sub("", page))
    page = Markup(_REFERENCE.sub(lambda match: f"url(#{names.get(match[1], match[1])})", page))
    counts = Counter(data for _, data, _, _ in _PATH.findall(page))
    ids = {
        data: f"p{number}"
        for number, (data, count) in enumerate(counts.most_common())
        if count * (len(data) - REFERENCE) > len(data) + DEFINITION
    }

    def short(match: re.Match[str]) -> str:
        before, data, after, inner = match.groups()
        if data not in ids:
            return match[0]
        start = f'<use href="#{ids[data]}"{before}{after}'
        return f"{start}/>" if inner is None else f"{start}>{inner}</use>"

    page = Markup(_PATH.sub(short, page))
    definitions = [Markup(f'{start} id="{name}"{end}') for (start, end), name in hatches.items()]
    definitions += [Markup(f'<path id="{name}" d="{data}"/>') for data, name in ids.items()]
    if not definitions:
        return page
    drawn = tag(
        "svg", tag("defs", *definitions), width=0, height=0, class_="unseen", aria_hidden="true"
    )
    return joined(drawn, page)
