"""Paths to the numbers of a document: `P1.teeth.sun`, `gears.low.speeds.MG1`, `shifts.1.overlap`.

A path consists of keys separated by points. List items are numbered from 1. A key that contains a
point or another special character is written in quotes. The unit of the values can follow in
brackets: `load.speed [rpm]`. A path can begin with the name of a part: `P1.teeth.sun` means
`elements.P1.teeth.sun` of the document.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import TypeAlias

from vstatics.core.errors import quoted
from vstatics.core.named_tuple import NamedTuple

Keys: TypeAlias = tuple[str, ...]
"""Keys of a path, without quotes."""

PARTS = ("shift_elements", "elements", "mechanisms", "springs")
"""Keys of a case that a path can omit, because it begins with the name of a part."""
BODIES = ("inertias", "masses")
"""Keys of a case that map links to numbers. A path to such a number is `LINK.inertia`."""
OWNERS: Mapping[str, int] = {"load": 1, "gears": 2, "drag": 1, "mesh_efficiency": 1}
"""Keys of a case that can begin a path, each with the number of keys that identify a record.

A record of `gears` needs 2 keys: `gears` and the name of the gear.
"""
MOST_PATH_PARTS = 16
"""Largest number of keys in a path; the keys of documents are nested less deeply."""

_PART = r"\"([^\"]*)\"|'([^']*)'|([^.\"']+)"
_QUOTED = r"""\"([^\"]*)\"|'([^']*)'"""
_BARE = r"\w+(?:[- ]\w+)*"
_UNIT = r"\s*\[([^\]]*)\]\s*\Z"


class PathPart(NamedTuple):
    """Key of a path typed by a user."""

    name: str
    at: int
    """Index of the first character of the key in the typed path."""


class NoValueError(Exception):
    """Error for a path that does not lead to a value; `at` is the index of the faulty key."""

    def __init__(self, message: str, at: int) -> None:
        super().__init__(message)
        self.at = at


def split(text: str) -> list[PathPart]:
    """Return the parts of a typed path.

    Raises
    ------
    NoValueError

    Examples
    --------
    >>> [part.name for part in split('controls."F 1.a".2.1')]
    ['controls', 'F 1.a', '2', '1']
    """
    parts = []
    at = len(text) - len(text.lstrip())
    end = len(text.rstrip())
    part = re.compile(_PART)
    while True:
        match = part.match(text, at, end)
        if not match:
            quote = text[at : at + 1] in ('"', "'") and at < end
            message = "the quote is not closed" if quote else "read nothing, expected a name"
            raise NoValueError(f"{message} between the points of a path", at)
        name = next(group for group in match.groups() if group is not None)
        parts.append(PathPart(name.strip() if match[3] else name, at))
        at = match.end()
        if at == end:
            return parts
        if text[at] != "." or len(parts) == MOST_PATH_PARTS:
            expected = f"at most {MOST_PATH_PARTS} parts" if text[at] == "." else "a point"
            raise NoValueError(f"read {quoted(text[at:end])}, expected {expected}", at)
        at += 1


def in_quotes(name: str) -> str:
    """Return a name in double quotes, or in single quotes if the name contains double quotes."""
    mark = "'" if '"' in name else '"'
    return f"{mark}{name}{mark}"


def written(keys: Sequence[str]) -> str:
    """Return a path with quotes around keys that contain special characters, as a user types it.

    >>> written(("controls", "F.1", "2"))
    'controls."F.1".2'
    """
    return dotted([key if re.fullmatch(_BARE, key) else in_quotes(key) for key in keys])


def dotted(keys: Sequence[str]) -> str:
    """Return a path without quotes, as in the names of columns, fields and changes."""
    return ".".join(keys)


def plain(text: str) -> str:
    """Return a typed path without quotes.

    >>> plain('gears."1 [a]".load.speed')
    'gears.1 [a].load.speed'
    """
    return re.sub(_QUOTED, lambda match: match[1] or match[2] or "", text)


def plain_keys(text: str) -> list[str]:
    """Return a typed path, split at every point after removal of quotes."""
    return plain(text).split(".")


def owner_and_key(text: str) -> tuple[str, str, str]:
    """Split a path at its last point: the text before it, the point, and the last key.

    >>> owner_and_key(" P.x. inertia"), owner_and_key("inertia")
    (('P.x', '.', 'inertia'), ('', '', 'inertia'))
    """
    owner, point, key = map(str.strip, text.strip().rpartition("."))
    return owner, point, key


def owner_and_number(path: str) -> tuple[Keys, Keys]:
    """Split a path into the keys that name the owner of a number, and the remaining keys.

    >>> owner_and_number("P1.teeth.sun"), owner_and_number("gears.low.speeds.MG1")
    ((('P1',), ('teeth', 'sun')), (('gears', 'low'), ('speeds', 'MG1')))
    """
    keys = tuple(path.split("."))
    count = OWNERS.get(keys[0], 1)
    return keys[:count], keys[count:] or keys


def with_unit(text: str) -> tuple[str, str | None]:
    """Split a typed path into the path and the unit in brackets, if any.

    >>> with_unit("load.speed [rpm]"), with_unit("load.speed")
    (('load.speed', 'rpm'), ('load.speed', None))
    """
    unit = re.search(_UNIT, text)
    return (text[: unit.start()], unit[1].strip()) if unit else (text, None)


def by_name(keys: Keys) -> Keys:
    """Shorten the keys of a number in a document to a path that begins with the name of a part.

    >>> by_name(("springs", "damper", "stiffness")), by_name(("inertias", "wheel"))
    (('damper', 'stiffness'), ('wheel', 'inertia'))
    """
    if len(keys) == 2 and keys[0] in BODIES:
        return keys[1], "inertia"
    return keys[1:] if len(keys) > 1 and keys[0] in PARTS else keys


def typed_by_name(text: str) -> str:
    """Shorten a typed path so that it begins with the name of a part.

    >>> typed_by_name("inertias.wl [kg*m^2]"), typed_by_name("D1.ratio")
    ('wl.inertia [kg*m^2]', 'D1.ratio')
    """
    path, _ = with_unit(text)
    keys = tuple(path.strip().split(".", 1))
    shorter = by_name(keys)
    return text if shorter == keys else dotted(shorter) + text[len(path) :].rstrip()


def in_document(keys: Keys) -> list[Keys]:
    """Return all full paths that a path beginning with the name of a part can mean.

    >>> in_document(("wheel", "inertia"))
    [('inertias', 'wheel'), ('masses', 'wheel')]
    >>> in_document(("P1", "teeth", "sun"))[1]
    ('elements', 'P1', 'teeth', 'sun')
    """
    if len(keys) == 2 and keys[1] == "inertia":
        return [(key, keys[0]) for key in BODIES]
    return [(key, *keys) for key in PARTS] if len(keys) > 1 else []
