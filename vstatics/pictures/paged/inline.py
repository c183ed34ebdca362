"""SVG pictures embedded in HTML, with unique ids and colours that follow the screen.

Attributes of appearance that elements share become rules of one style sheet per page.
"""

from __future__ import annotations

import re
from collections import Counter
from xml.etree import ElementTree as ET

from vstatics.core.tables.html import Markup
from vstatics.pictures.drawing.style import Style

_LIGHT, _DARK = Style(), Style(dark=True)
_NAMES = ("paper", "ink", "soft", "faint", "engaged", "lost", "circulating", "power")
_PAIRS = {name: (getattr(_LIGHT, name), getattr(_DARK, name)) for name in _NAMES} | {
    f"colour{number}": pair
    for number, pair in enumerate(zip(_LIGHT.colours, _DARK.colours, strict=True))
}
"""Colours of pictures on paper and on a dark screen, by the name of the CSS variable."""
_COLOUR_NAMES = {light: name for name, (light, _) in _PAIRS.items()}
_REFERENCE = re.compile(r"url\(#([^)]+)\)")
_COLOUR = re.compile("#[0-9a-f]{6}")
_COLOURED = ("style", "fill", "stroke")


def palette(*, dark: bool) -> str:
    """Return the declarations of the colour variables for a style sheet."""
    return " ".join(f"--{name}: {pair[dark]};" for name, pair in _PAIRS.items())


def inline(svg: bytes, prefix: str, label: str) -> Markup:
    """Embed an SVG in HTML.

    Ids get a prefix, because two pictures of matplotlib have the same ids. Colours become variables
    of the page. The elements stay accessible by their titles.

    Examples
    --------
    >>> svg = b'<svg xmlns="http://www.w3.org/2000/svg"><g id="a" fill="#1a1a1a"/></svg>'
    >>> inline(svg, "plan", "plan").partition(">")[2]
    '<g id="plan-a" fill="var(--ink)" /></svg>'
    """
    root = ET.fromstring(svg)  # noqa: S314 - written by this program
    if len(root) and root[0].tag.endswith("}title"):  # the caption of the page replaces the title
        del root[0]
    for element in root.iter():
        element.tag = _local(element.tag)
        attributes = sorted(
            element.attrib.items(), key=lambda attribute: (is_look(attribute[0]), attribute[0])
        )
        element.attrib = {
            _local(key): _rewritten(_local(key), value, prefix) for key, value in attributes
        }
    style = f"--width: {root.attrib.get('width', '100%')}"
    for key in ("width", "height", "version", "font-family"):
        root.attrib.pop(key, None)
    root.attrib |= {"role": "graphics-document", "aria-label": label, "style": style}
    return Markup(ET.tostring(root, encoding="unicode"))


def _local(name: str) -> str:
    """Return a name without the XML namespace."""
    return name.rpartition("}")[2]


def _rewritten(key: str, value: str, prefix: str) -> str:
    if key == "id":
        return f"{prefix}-{value}"
    if key == "href" and value.startswith("#"):
        return f"#{prefix}-{value[1:]}"
    if key in _COLOURED:
        value = _COLOUR.sub(_variable, value)
    return _REFERENCE.sub(rf"url(#{prefix}-\1)", value)


def _variable(match: re.Match[str]) -> str:
    name = _COLOUR_NAMES.get(match[0])
    return f"var(--{name})" if name else match[0]


def colour_name(colour: str) -> str:
    """Return the name of the variable of a colour.

    >>> colour_name(Style().colour(3)), colour_name(Style().ink)
    ('colour3', 'ink')
    """
    return _COLOUR_NAMES[colour]


_TAG = re.compile(r"<(?:path|text|use|g)\b[^<>]*>")
_KEY = r"(?:fill|stroke|opacity|font|text-anchor|paint-order)[-a-z]*"
_CLASS = re.compile(' class="([^"<>]*)"')
_LOOK = re.compile(f'(?: {_KEY}="[^"<>]*")+(?=[ />])')


def shared(page: Markup) -> tuple[Markup, Markup]:
    """Move attributes of appearance that elements share to rules of a style sheet.

    Examples
    --------
    >>> shown = Markup('<text x="1" fill="red">a</text><text x="2" fill="red">b</text>')
    >>> for part in shared(shown):
    ...     print(part)
    <text x="1" class="l0">a</text><text x="2" class="l0">b</text>
    .l0{fill:red}

    An existing class is retained.

    >>> print(shared(Markup('<path fill="red" class="wire"/><path fill="red"/>'))[0])
    <path class="l0 wire"/><path class="l0"/>
    """
    looks = Counter(look for part in _TAG.findall(page) for look in _LOOK.findall(part))
    often = [look for look, count in looks.most_common() if count > 1]
    names = {look: f' class="l{number}"' for number, look in enumerate(often)}

    def short(part: re.Match[str]) -> str:
        shortened = _LOOK.sub(lambda look: names.get(look[0], look[0]), part[0], count=1)
        classes = _CLASS.findall(shortened)
        if len(classes) < 2:
            return shortened
        first = shortened.index(' class="')
        return f'{shortened[:first]} class="{" ".join(classes)}"{_CLASS.sub("", shortened[first:])}'

    rules = []
    for number, look in enumerate(often):  # ``fill="none"`` is ``fill:none``
        declarations = re.findall(r'([-a-z]+)="([^"]*)"', look)
        rules.append(f".l{number}{{{';'.join(f'{key}:{value}' for key, value in declarations)}}}")
    return Markup(_TAG.sub(short, page)), Markup("\n".join(rules))


def is_look(key: str) -> bool:
    """Check whether an attribute of an element determines its appearance.

    >>> is_look("stroke-width"), is_look("d")
    (True, False)
    """
    return re.fullmatch(_KEY, key) is not None
