"""Which number of which mechanism is varied: "D1.ratio", "#3.efficiency"."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal, NamedTuple, get_args

from vstatics.errors import Place, Problem, ReadError, nearest
from vstatics.model.transmission import Transmission

Quantity = Literal["ratio", "efficiency"]
QUANTITIES: tuple[Quantity, ...] = get_args(Quantity)

_SHOWN = 40


class Target(NamedTuple):
    """A number of a mechanism that is varied."""

    name: str
    """With the case's own name of the mechanism: `D1.ratio`."""
    mechanism: int
    """Index of the mechanism, from 0."""
    quantity: Quantity


def target(text: str, case: Transmission, place: Place | None = None) -> Target:
    """The number that a text such as `D1.ratio` or `#1.ratio` speaks of.

    Parameters
    ----------
    text : str
        The name of a mechanism, or `#` and its number, then `.ratio` or `.efficiency`. The
        name may stand in quotes; a bare number is taken as a name first.
    case : Transmission
    place : Place, optional
        Where the text begins, for messages.

    Raises
    ------
    ReadError
        If there is no such number; it names the nearest.

    Examples
    --------
    >>> from vstatics.model.transmission import Gear, Mechanism, Transmission
    >>> case = Transmission(3, [], [Mechanism(1, 2, 3, -2.5, name="front")], [Gear()])
    >>> target("front.efficiency", case)
    Target(name='front.efficiency', mechanism=0, quantity='efficiency')
    >>> target("#1.ratio", case).name
    'front.ratio'
    """
    begin = len(text) - len(text.lstrip())
    name, dot, quantity = map(str.strip, text.strip().rpartition("."))
    if not case.mechanisms:
        raise refusal("the case has no mechanisms, so there is nothing to vary", place, begin)
    if not dot or not name:
        known = [f"{mechanism.name}.{part}" for mechanism in case.mechanisms for part in QUANTITIES]
        hint = nearest(text.strip(), known) or f"; such as `{known[0]}`"
        expected = "a mechanism, then `.ratio` or `.efficiency`"
        raise refusal(f"read {shown(text)}, expected {expected}{hint}", place, begin)
    index = _mechanism(name.rstrip(), case)
    if index is None:
        raise refusal(_unknown(name.rstrip(), case), place, begin)
    if quantity not in QUANTITIES:
        hint = nearest(quantity, QUANTITIES)
        message = f"read {shown(quantity)}, expected `ratio` or `efficiency`{hint}"
        raise refusal(message, place, begin + len(name) + 1)
    return Target(f"{case.mechanisms[index].name}.{quantity}", index, quantity)


def _mechanism(name: str, case: Transmission) -> int | None:
    """The index of a mechanism by its name, else by its number."""
    names = [mechanism.name for mechanism in case.mechanisms]
    if name in names:
        return names.index(name)
    if len(name) > 2 and name[0] == name[-1] and name[0] in "\"'" and name[1:-1] in names:
        return names.index(name[1:-1])
    number = name.removeprefix("#")
    if number.isascii() and number.isdigit() and len(number) < 10 and 0 < int(number) <= len(names):
        return int(number) - 1
    return None


def _unknown(name: str, case: Transmission) -> str:
    names = [mechanism.name for mechanism in case.mechanisms]
    if name.startswith("#"):
        return f"read {shown(name)}, expected the number of a mechanism, #1 to #{len(names)}"
    hint = nearest(name, names)
    return f"there is no mechanism {shown(name)}, expected one of {listed(names)}{hint}"


def listed(names: Sequence[str], most: int = 8) -> str:
    """The first of some names."""
    return ", ".join(names[:most]) + (", ..." if len(names) > most else "")


def refusal(message: str, place: Place | None, offset: int = 0) -> ReadError:
    """An error so many letters behind a place."""
    return ReadError([Problem(message, place=behind(place, offset))])


def behind(place: Place | None, offset: int) -> Place | None:
    """The place so many letters further."""
    return place and place._replace(column=place.column + offset)


def shown(text: str) -> str:
    """What was read, in quotes and not too long; "nothing" if it is nothing.

    >>> shown(" .9x "), shown("")
    ('`.9x`', 'nothing')
    """
    text = text.strip()
    if len(text) > _SHOWN:
        text = text[: _SHOWN - 3] + "..."
    return f"`{text}`" if text else "nothing"
