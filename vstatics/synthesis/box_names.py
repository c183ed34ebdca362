"""The names of a found box: of its links, shift elements and gears."""

from __future__ import annotations

from collections.abc import Sequence

from vstatics.synthesis.box import HELD
from vstatics.synthesis.scheme import link_name

HOUSING_NAME = "housing"


def element_links(element: tuple[int, int]) -> tuple[str, str]:
    """The names of the two links of an element.

    >>> element_links((2, HELD)), element_links((0, 3))
    (('L2', 'housing'), ('L0', 'L3'))
    """
    first, second = element
    return link_name(first), HOUSING_NAME if second == HELD else link_name(second)


def box_element_name(element: tuple[int, int]) -> str:
    """The name of a shift element.

    >>> box_element_name((2, HELD)), box_element_name((0, 3))
    ('T-L2', 'F-L0-L3')
    """
    first, second = element_links(element)
    return f"T-{first}" if element[1] == HELD else f"F-{first}-{second}"


def target_names(targets: Sequence[float]) -> tuple[str, ...]:
    """The name of the gear of each target: forward by descending ratio, then those backward.

    >>> target_names([1, -2.5, 3.2]), target_names([-2, 1, -4])
    (('2', 'R', '1'), ('R2', '1', 'R1'))
    """
    return tuple(_name(place, targets) for place in range(len(targets)))


def _name(place: int, targets: Sequence[float]) -> str:
    own = targets[place]
    alike = sorted((abs(one) for one in targets if (one > 0) == (own > 0)), reverse=True)
    number = alike.index(abs(own)) + 1
    if own > 0:
        return str(number)
    return f"R{number}" if len(alike) > 1 else "R"


def in_order(targets: Sequence[float]) -> list[int]:
    """The indices of targets in the order of their gears.

    >>> in_order([1, -2.5, 3.2])
    [2, 0, 1]
    """
    return sorted(range(len(targets)), key=lambda index: (targets[index] < 0, -abs(targets[index])))
