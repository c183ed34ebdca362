"""Which number of which mechanism is varied: "D1.ratio", "#3.efficiency"."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Literal, NamedTuple, get_args

from vstatics.errors import Place, Problem, ReadError, nearest, quoted, typed_number
from vstatics.model.transmission import Transmission
from vstatics.readers.deck.places import LISTS
from vstatics.tables.names import no_row, rows_called, several

Quantity = Literal["ratio", "efficiency"]
QUANTITIES: tuple[Quantity, ...] = get_args(Quantity)
ALIASES: Mapping[str, Quantity] = {LISTS["mechanisms", one]: one for one in QUANTITIES}
"""What the deck calls them, IAB and ETAI."""
NAMES: Mapping[str, Quantity] = {**{one: one for one in QUANTITIES}, **ALIASES}


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
        The name of a mechanism, or `#` and its number, then `.ratio` or `.efficiency`, in a
        deck `.IAB` or `.ETAI`. The name may stand in quotes; a bare number is taken as a name
        first. A drawn element alone is its only mechanism.
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
    found = _mechanisms(name.rstrip(), case)
    if len(found) != 1:
        raise refusal(_not_one(name.rstrip(), found, case), place, begin)
    if quantity not in NAMES:
        hint = nearest(quantity, NAMES)
        message = f"read {shown(quantity)}, expected `ratio` or `efficiency`{hint}"
        raise refusal(message, place, begin + len(name) + 1)
    index, varied = found[0], NAMES[quantity]
    return Target(f"{case.mechanisms[index].name}.{varied}", index, varied)


def _mechanisms(name: str, case: Transmission) -> list[int]:
    """Indices of mechanisms by their name, or that of a drawn element, else by their number."""
    found = rows_called(name, "mechanisms", case)
    if not found and len(name) > 2 and name[0] == name[-1] and name[0] in "\"'":
        found = rows_called(name[1:-1], "mechanisms", case)
    number = typed_number(name.removeprefix("#"), len(case.mechanisms))
    return found or ([] if number is None else [number - 1])


def _not_one(name: str, found: Sequence[int], case: Transmission) -> str:
    """What to say of a name that no mechanism has, or several of one element."""
    names = [mechanism.name for mechanism in case.mechanisms]
    if found:
        return several(name, found, names, "mechanisms")
    if name.startswith("#"):
        return f"read {shown(name)}, expected the number of a mechanism, #1 to #{len(names)}"
    return no_row(name, "mechanisms", names)


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
    return quoted(text) if text else "nothing"
