"""Choice of two links as input and output of a case."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import permutations

from vstatics.core.errors import quoted
from vstatics.core.model.transmission import Gear, Transmission
from vstatics.synthesis.gears.speed_forms import Pair

ALL = "all"
"""Text that requests all ordered pairs of different links."""


def port_pairs(case: Transmission, asked: Sequence[str]) -> list[Pair]:
    """Return the requested pairs of input and output link, each once.

    Parameters
    ----------
    asked : sequence of str
        ``all`` alone, or pairs ``IN:OUT`` of names or numbers of links; names can contain colons.

    Raises
    ------
    ValueError
        If a text does not name two different links.

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
    """Return the two links of a text, split at the first colon that follows the name of a link."""
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
    """Return the case with a different input and output, and without gears and loads.

    >>> from vstatics import Mechanism
    >>> case = Transmission(3, [], [Mechanism(1, 2, 3, -2.5)], [Gear(speeds={2: 0})])
    >>> other = between(case, (2, 1))
    >>> other.input, other.output, other.gears[0].speeds
    (2, 1, {})
    """
    first, last = pair
    bare = {"gears": [Gear()], "outputs": (), "load": None, "vehicle": None, "dump": None}
    return case.replace(input=first, output=last, **bare)
