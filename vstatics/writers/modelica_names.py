"""Names and texts of a case as those of Modelica."""

from __future__ import annotations

import re
from collections.abc import Iterable

from vstatics.errors import printable

_RESERVED = frozenset(
    re.findall(
        r"\w+",
        "algorithm and annotation assert block break class connect connector constant "
        "constrainedby der discrete each else elseif elsewhen encapsulated end enumeration "
        "equation expandable extends external false final flow for function if import impure in "
        "initial inner input loop model not operator or outer output package parameter partial "
        "protected public pure record redeclare replaceable return stream then time true type "
        "when while within Boolean Clock ExternalObject Integer Modelica Real StateSelect String",
    )
)
"""Words of the language, and names that stand for something: between quotes they do not."""
_PLAIN = re.compile(r"[A-Za-z_][A-Za-z0-9_]*\Z")
_NOT_BETWEEN_QUOTES = re.compile(r"[^A-Za-z0-9_!#$%&()*+,\-./:;<>=?@\[\]^{}|~ ]")


def identifier(name: str) -> str:
    r"""A name as an identifier: as it is, or between quotes.

    Signs that no identifier may have become underlines.

    >>> identifier("FH"), identifier("in"), identifier("set 0"), identifier("Ф's")
    ('FH', "'in'", "'set 0'", "'__s'")
    """
    if _PLAIN.match(name) and name not in _RESERVED:
        return name
    return f"'{_NOT_BETWEEN_QUOTES.sub('_', name)}'"


class Identifiers:
    """Identifiers of one scope, each given once.

    Examples
    --------
    >>> names = Identifiers()
    >>> names.new("out"), names.new("out"), names.new("in"), names.new("in")
    ('out', 'out_2', "'in'", 'in_2')
    """

    def __init__(self, taken: Iterable[str] = ()) -> None:
        self._taken = set(taken)

    def new(self, name: str) -> str:
        """The identifier of a name, with a number behind it if it is taken."""
        made, number = identifier(name), 1
        while made in self._taken:
            number += 1
            made = identifier(f"{name}_{number}")
        self._taken.add(made)
        return made


def class_name(name: str) -> str:
    """The name of a class, which is that of a file too: one word of letters.

    >>> class_name("Dump-truck gearbox"), class_name("8HP"), class_name("")
    ('Dump_truck_gearbox', 'Case_8HP', 'Case')
    """
    word = re.sub(r"[^A-Za-z0-9]+", "_", name).strip("_")[:60]
    plain = _PLAIN.match(word) and word not in _RESERVED
    return word if plain else f"Case_{word}".rstrip("_")


def string(text: str) -> str:
    r"""A text between double quotes.

    >>> print(string('a "b" \\ c'))
    "a \"b\" \\ c"
    """
    safe = printable(text, lines=True).replace("\\", "\\\\").replace('"', '\\"')
    return f'"{safe}"'
