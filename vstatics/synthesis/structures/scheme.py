"""Scheme of planetary gear sets: the common links of their members, and its code."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from itertools import combinations
from typing import NamedTuple

import numpy as np

from vstatics.core.errors import count_of, listed, quoted, spoken
from vstatics.synthesis.structures.arrays import LEAST_MOBILITY, MEMBERS, are_connected
from vstatics.synthesis.structures.growth import MOST_SETS

MEMBER_NAMES = ("sun", "carrier", "ring")
"""Names of the members in the order of a code."""
LONGEST = MEMBERS * 3 * MOST_SETS
"""Largest number of characters of a code, with two digits and a hyphen for each link."""


class SetScheme(NamedTuple):
    """Links of sun, carrier and ring of each gear set, numbered from 0.

    Examples
    --------
    >>> scheme = SetScheme.of_code("0-1-2-0-3-4")
    >>> scheme.sets, scheme.links, scheme.code
    (((0, 1, 2), (0, 3, 4)), 5, '0-1-2-0-3-4')
    """

    sets: tuple[tuple[int, int, int], ...]

    @classmethod
    def of_code(cls, code: str) -> SetScheme:
        """Return the scheme of a code, whose links can be numbered in any order.

        Raises
        ------
        ValueError
            If the text is not the code of a scheme.
        """
        return cls(_sets(_numbers(code)))

    @property
    def code(self) -> str:
        """Code: the links of all gear sets in turn, joined by hyphens."""
        return "-".join(str(link) for members in self.sets for link in members)

    @property
    def links(self) -> int:
        """Number of links."""
        return 1 + max(link for members in self.sets for link in members)

    @property
    def mobility(self) -> int:
        """Degrees of freedom without shift elements: number of links minus number of gear sets."""
        return self.links - len(self.sets)

    @property
    def is_connected(self) -> bool:
        """True if common links connect all gear sets.

        >>> SetScheme.of_code("0-1-2-3-4-5").is_connected
        False
        """
        return bool(are_connected(np.array([self.sets], np.uint8).reshape(1, -1))[0])

    @property
    def locked_sets(self) -> tuple[int, ...]:
        """Smallest group of gear sets that always rotates as a block, by numbers from 1.

        Such a group has fewer than two links more than sets. A sound scheme has no such group.

        >>> of_code = SetScheme.of_code
        >>> of_code("0-1-2-2-0-1").locked_sets, of_code("0-1-2-2-0-3").locked_sets
        ((1, 2), ())
        """
        for size in range(2, len(self.sets) + 1):
            for group in combinations(range(len(self.sets)), size):
                links = {link for number in group for link in self.sets[number]}
                if len(links) < size + LEAST_MOBILITY:
                    return tuple(number + 1 for number in group)
        return ()


def link_name(link: int) -> str:
    """Return the name of a link in a case, where the number 0 would mean the housing.

    >>> link_name(0)
    'L0'
    """
    return f"L{link}"


def _numbers(code: str) -> list[int]:
    if len(code) > LONGEST:
        raise ValueError(f"read {quoted(code)}, expected at most {MOST_SETS} sets")
    words = code.strip().split("-")
    for word in words:
        if not (word.isascii() and word.isdigit()):
            expected = "expected numbers of links joined by `-`, such as 0-1-2-0-3-4"
            raise ValueError(f"read {quoted(word) if word else 'nothing'} in the code, {expected}")
    return [int(word) for word in words]


def _sets(numbers: Sequence[int]) -> tuple[tuple[int, int, int], ...]:
    if len(numbers) % MEMBERS:
        expected = "expected three for each set: sun, carrier, ring"
        raise ValueError(f"read {count_of('link', len(numbers))} in the code, {expected}")
    if len(numbers) > MEMBERS * MOST_SETS:
        raise ValueError(f"read {len(numbers) // MEMBERS} sets, expected at most {MOST_SETS}")
    # A link number in the text can be huge, so gaps are only sought among the lowest numbers.
    missing = sorted(set(range(min(max(numbers), 2 * len(numbers)))) - set(numbers))
    if missing:
        some = listed([str(link) for link in missing], 3)
        last = f"the greatest is {max(numbers)}"
        raise ValueError(f"no set has link {some}, but {last}; expected 0, 1, 2, ... without gaps")
    parts = range(0, len(numbers), MEMBERS)
    sets = [(numbers[start], numbers[start + 1], numbers[start + 2]) for start in parts]
    for number, links in enumerate(sets, 1):
        [(link, count)] = Counter(links).most_common(1)
        if count > 1:
            members = (name for name, of in zip(MEMBER_NAMES, links, strict=True) if of == link)
            raise ValueError(
                f"{spoken(members)} of set {number} are both link {link}; expected three links"
            )
    return tuple(sets)
