"""SVG pictures embedded in HTML, with unique ids and colours for light and dark screens.

A page defines repeated shapes and hatches once. Frequent looks (sets of attributes such as `fill`)
become classes of the style sheet.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence
from functools import cache, lru_cache
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
_COLOURED = ("fill", "stroke")
_XML = "{http://www.w3.org/XML/1998/namespace}"
_PLACES = {"x", "y", "cx", "cy", "transform"}
_STEP = re.compile(r"([MLQCz])([^MLQCz]*)")
_DECIMAL = re.compile(r"-?\d+(?:\.\d+)?")
_MOVED = re.compile(r"translate\((\S+) (\S+)\)")
_NAMED = re.compile(r'<g(?: (?:class|data-[-\w]+)="[^"]*")+>')
_INK = "var(--ink)"
_MOST_PATHS = 4096
"""Largest number of remembered paths. Pictures of gears have many paths in common."""


def palette(*, dark: bool) -> str:
    """Return the CSS declarations of the colour variables, for a light or a dark screen."""
    return " ".join(f"--{name}: {pair[dark]};" for name, pair in _PAIRS.items())


def inline(
    svg: bytes | ET.Element, prefix: str, label: str, *, repeats: bool | None = None
) -> Markup:
    """Embed an SVG in HTML.

    Ids get a prefix, because different pictures use equal ids. Colours become CSS variables of the
    page. Titles remain as tooltips and for screen readers.

    Parameters
    ----------
    repeats : bool, optional
        True replaces the rows of the picture by references to equal rows of other pictures, which
        are embedded with False.

    Examples
    --------
    >>> svg = b'<svg xmlns="http://www.w3.org/2000/svg"><g id="a" fill="#1a1a1a"/></svg>'
    >>> inline(svg, "plan", "plan").partition(">")[2]
    '<g id="plan-a" fill="var(--ink)"/></svg>'
    """
    # This program wrote the SVG.
    root = ET.fromstring(svg) if isinstance(svg, bytes) else svg  # noqa: S314
    # The heading on the page replaces the title in the picture.
    if len(root) and _local(root[0].tag) == "title":
        del root[0]
    _fold(root)
    for element in root.iter():
        element.tag = _local(element.tag)
        attributes = sorted(
            element.attrib.items(), key=lambda attribute: (is_look(attribute[0]), attribute[0])
        )
        element.attrib = {
            _local(key): _rewritten(_local(key), value, prefix) for key, value in attributes
        }
        moved = _MOVED.fullmatch(element.get("transform", "")) if element.tag == "text" else None
        if moved:
            del element.attrib["transform"]
            element.attrib = {"x": moved[1], "y": moved[2], **element.attrib}
        # Ink is the default colour of texts in the picture.
        if element.tag == "text" and element.get("fill") == _INK:
            del element.attrib["fill"]
    if repeats is not None:
        for row in root.findall("g[@class='row']"):
            _share_row(row, repeats=repeats)
    style = f"--width: {root.attrib.get('width', '100%')}"
    for key in ("xmlns", "width", "height", "font-family", "font-size", "stroke-linejoin"):
        root.attrib.pop(key, None)
    root.attrib |= {"role": "graphics-document", "aria-label": label, "style": style}
    return Markup(ET.tostring(root, encoding="unicode").replace(" />", "/>"))


def for_paper(svg: Markup) -> Markup:
    """Return an SVG without tooltips and names of groups, which paper does not show."""
    shown = _NAMED.sub("<g>", svg)
    shown = re.sub("><title>[^<]*</title></(?:path|circle)>", "/>", shown)
    return Markup(re.sub("<title>[^<]*</title>", "", shown))


def _share_row(row: ET.Element, *, repeats: bool) -> None:
    """Give an id to a row, or replace a repeated row by a reference to this id."""
    name, at, inner = f"row-{row.attrib['data-of']}", row.attrib["data-at"].split(), [*row]
    row.clear()
    if repeats:
        row.tag, row.attrib = "use", {"href": f"#{name}", "x": at[0], "y": at[1]}
    else:
        row.set("transform", f"translate({' '.join(at)})")
        back = " ".join(f"-{length}" for length in at)
        ET.SubElement(row, "g", {"id": name, "transform": f"translate({back})"}).extend(inner)


def _fold(parent: ET.Element) -> None:
    """Move the title of an SVG group with a single shape or text into this shape or text."""
    for place, child in enumerate(parent):
        _fold(child)
        kinds = [_local(part.tag) for part in child]
        if kinds[:1] == ["title"] and len(kinds) == 2 and all(map(is_look, child.attrib)):
            title, shape = child
            shape.text, title.tail = None, shape.text
            shape.insert(0, title)
            for key, look in child.attrib.items():
                shape.attrib.setdefault(key, look)  # looks of the shape have priority
            parent[place] = shape


@cache
def _local(name: str) -> str:
    """Return a name without the namespace of SVG, and ``xml:space`` with the prefix."""
    return name.replace(_XML, "xml:").rpartition("}")[2]


def _rewritten(key: str, value: str, prefix: str) -> str:
    if key == "id":
        return f"{prefix}-{value}"
    if key == "d":
        return short_path(value)
    if key in _PLACES:
        return _DECIMAL.sub(lambda number: _tenths(round(10 * float(number[0]))), value)
    if key in _COLOURED:
        value = _COLOUR.sub(_variable, value)
    return _REFERENCE.sub(rf"url(#{prefix}-\1)", value)


@lru_cache(maxsize=_MOST_PATHS)
def short_path(path: str) -> str:
    """Return an SVG path with coordinates relative to the previous point, rounded to 0.1 pt.

    Parameters
    ----------
    path : str
        Path with the letters M, L, Q, C and z; each point follows its letter.

    Examples
    --------
    >>> short_path("M10 20.04L10 5.5L12.25 5.5L13 6zM1 1C1 2 3 4 5 6")
    'M10 20v-14.5h2.2l.8.5zm-9-19c0 1 2 3 4 5'
    >>> short_path("M10 20L11.5 18L12 18.5L13.5 19")
    'M10 20l1.5-2 .5.5 1.5.5'
    """
    steps: list[tuple[str, list[int]]] = []
    at = start = (0, 0)
    for letter, text in _STEP.findall(path):
        numbers = [round(10 * float(number)) for number in _DECIMAL.findall(text)]
        if letter == "z":
            steps.append((letter, []))
            at = start
            continue
        points = [*zip(numbers[::2], numbers[1::2], strict=True)]
        x, y = at
        flat = [number for across, up in points for number in (across - x, up - y)]
        at = points[-1]
        if letter == "M":
            start = at
        if letter == "L" and not flat[1]:
            steps.append(("h", flat[:1]))
        elif letter == "L" and not flat[0]:
            steps.append(("v", flat[1:]))
        elif steps and letter != "M" and steps[-1][0] == letter.lower():
            steps[-1][1].extend(flat)  # an equal letter is omitted
        else:
            steps.append((letter.lower() if steps else letter, flat))
    return "".join(letter + _joined(numbers) for letter, numbers in steps)


def _joined(numbers: Sequence[int]) -> str:
    """Return numbers in tenths as text, with blanks only before numbers without minus or point."""
    text = before = ""
    for number in map(_tenths, numbers):
        is_apart = not text or number[0] == "-" or (number[0] == "." and "." in before)
        text += number if is_apart else f" {number}"
        before = number
    return text


def _tenths(number: int) -> str:
    whole, part = divmod(abs(number), 10)
    decimals = f".{part}" if part else ""
    return f"{'-' * (number < 0)}{whole or '' if part else whole}{decimals}"


def _variable(match: re.Match[str]) -> str:
    name = _COLOUR_NAMES.get(match[0])
    return f"var(--{name})" if name else match[0]


def colour_name(colour: str) -> str:
    """Return the name of the CSS variable of a colour.

    >>> colour_name(Style().colour(3)), colour_name(Style().ink)
    ('colour3', 'ink')
    """
    return _COLOUR_NAMES[colour]


_TAG = re.compile(r"<(?:path|circle|text|g)\b[^<>]*>")
_KEY = r"(?:fill|stroke|opacity|font|text-anchor|paint-order)[-a-z]*"
_CLASS = re.compile(' class="([^"<>]*)"')
_LOOK = re.compile(f'(?: {_KEY}="[^"<>]*")+(?=[ />])')
_PATTERN = re.compile(r'(<pattern\b[^<>]*?) id="([^"]*)"(.*?</pattern>)', re.DOTALL)
_SHAPES = (
    ("<g id={}>{}</g>", re.compile(r"<g>((?!<title>)(?:(?!</?g\b).)*)()</g>", re.DOTALL)),
    ("<g id={}>{}</g>", re.compile(r"((?:<path\b[^<>]*/>){2,})()")),
    (
        "<path id={}{}/>",
        re.compile(r"<path\b([^<>]*?)(?:/>|>(<title>[^<]*</title>)</path>)"),
    ),
)
"""Format of the definition of a repeated shape, and pattern with groups for shape and tooltip."""
_USE = len('<use href="#s100"/>')


def shared(page: Markup) -> tuple[Markup, Markup]:
    """Define repeated shapes and frequent looks once; return the page and the style sheet.

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
    shown, definitions = _with_common_hatches(page)
    shown, rules = _with_common_looks(shown)
    for form, pattern in _SHAPES:
        shown = _with_common_shapes(shown, form, pattern, definitions)
    if definitions:
        shown += f'<svg class="unseen" aria-hidden="true"><defs>{"".join(definitions)}</defs></svg>'
    return Markup(shown), Markup(rules)


def _with_common_hatches(page: str) -> tuple[str, list[str]]:
    """Return a page with equal patterns of hatches defined once, and the definitions."""
    names: dict[str, str] = {}
    ids = {
        match[2]: names.setdefault(match[1] + match[3], f"h{len(names)}")
        for match in _PATTERN.finditer(page)
    }
    shown = _PATTERN.sub("", page).replace("<defs></defs>", "")
    shown = _REFERENCE.sub(lambda match: f"url(#{ids.get(match[1], match[1])})", shown)
    return shown, [f'<pattern id="{name}"{text[len("<pattern") :]}' for text, name in names.items()]


def _with_common_looks(page: str) -> tuple[str, str]:
    """Return a page with classes instead of frequent looks, and the rules of the classes."""
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
    for number, look in enumerate(often):  # ``fill="none"`` becomes ``fill:none``
        declarations = re.findall(r'([-a-z]+)="([^"]*)"', look)
        rules.append(f".l{number}{{{';'.join(f'{key}:{value}' for key, value in declarations)}}}")
    return _TAG.sub(short, page), "\n".join(rules)


def _with_common_shapes(
    page: str, form: str, pattern: re.Pattern[str], definitions: list[str]
) -> str:
    """Return a page that uses repeated shapes, and append their definitions."""
    names = {}
    for shape, count in Counter(match[1] for match in pattern.finditer(page)).items():
        if (count - 1) * len(shape) > count * _USE + len(form):
            names[shape] = f"s{len(definitions)}"
            definitions.append(form.format(f'"{names[shape]}"', shape))

    def used(match: re.Match[str]) -> str:
        if match[1] not in names:
            return match[0]
        use = f'<use href="#{names[match[1]]}"'
        return f"{use}>{match[2]}</use>" if match[2] else f"{use}/>"

    return pattern.sub(used, page)


@cache
def is_look(key: str) -> bool:
    """Check whether an attribute determines the appearance of an element.

    >>> is_look("stroke-width"), is_look("d")
    (True, False)
    """
    return re.fullmatch(_KEY, key) is not None
