"""A case between any two of its links: the pairs that are asked for, and the case of each."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import permutations

from vstatics.core.errors import quoted
from vstatics.core.model.transmission import Gear, Transmission
from vstatics.synthesis.gears.speed_forms import Pair

ALL = "all"
"""What asks for all ordered pairs of different links."""


def port_pairs(case: Transmission, asked: Sequence[str]) -> list[Pair]:
    """Inputs and outputs, each pair once.

    Parameters
    ----------
    asked : sequence of str
        ``all`` alone, or pairs ``IN:OUT`` of names or numbers of links; names may have colons.

    Raises
    ------
    ValueError
        If one is no pair of two links.

    Examples
    --------
    >>> from vstatics import Mechanism
    >>> names = ["a", "b:c", "d"]
    >>> case = Transmission(3, [], [Mechanism(1, 2, 3, -2.5)], [Gear()], link_names=names)
    >>> port_pairs(case, ["a:3", "b:c:a"]), len(port_pairs(case, ["all"]))
    ([(1, 3), (2, 1)], 6)
    """
    if [*asked] == [ALL]:
        return [*permutations(range(1, case.own_links + 1), 2)]
    return [*dict.fromkeys(_pair(case, text) for text in asked)]


def _pair(case: Transmission, text: str) -> Pair:
    """The two links of a text; where several colons can part it, the first that gives two."""
    first, colon, second = text.partition(":")
    names = case.link_names[: case.own_links]
    while second.count(":") and first not in names:
        more, _, second = second.partition(":")
        first = f"{first}:{more}"
    if not colon:
        raise ValueError(f"read {quoted(text)}, expected `{ALL}` alone, or two links as IN:OUT")
    pair = case.link_number(first), case.link_number(second)
    if pair[0] == pair[1]:
        raise ValueError(f"read {quoted(text)}, expected two different links")
    return pair


def between(case: Transmission, pair: Pair) -> Transmission:
    """The case with another input and output; what gears and loads give is left out.

    >>> from vstatics import Mechanism
    >>> case = Transmission(3, [], [Mechanism(1, 2, 3, -2.5)], [Gear(speeds={2: 0})])
    >>> other = between(case, (2, 1))
    >>> other.input, other.output, other.gears[0].speeds
    (2, 1, {})
    """
    first, last = pair
    bare = {"gears": [Gear()], "outputs": (), "load": None, "vehicle": None, "dump": None}
    return case.replace(input=first, output=last, **bare)
