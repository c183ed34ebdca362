"""Names of gears and gear sets of a found case: gears by their ratios, gear sets by numbers."""

from __future__ import annotations

from collections.abc import Sequence


def set_name(number: int) -> str:
    """Return the name of a gear set in a case, by a number from 1.

    >>> set_name(1)
    'P1'
    """
    return f"P{number}"


def in_order(ratios: Sequence[float]) -> list[int]:
    """Return the indices of ratios in the order of gears: forward, then reverse.

    >>> in_order([1, -2.5, 3.2])
    [2, 0, 1]
    """
    return sorted(range(len(ratios)), key=lambda index: (ratios[index] < 0, -abs(ratios[index])))


def names_of_gears(ratios: Sequence[float]) -> tuple[str, ...]:
    """Return the names of the gears of ratios: forward by descending ratio, then reverse.

    >>> names_of_gears([1, -2.5, 3.2]), names_of_gears([-2, 1, -4])
    (('2', 'R', '1'), ('R2', '1', 'R1'))
    """
    forward = sum(ratio > 0 for ratio in ratios)
    names = gear_names(forward, len(ratios) - forward)
    return tuple(name for _, name in sorted(zip(in_order(ratios), names, strict=True)))


def names_of_mean(ratios: Sequence[float]) -> list[str]:
    """Return the names of the gears in a mean: forward gears or, without any, all gears.

    >>> names_of_mean([1, -2.5, 3.2]), names_of_mean([-2, -4])
    (['1', '2'], ['R1', 'R2'])
    """
    forward = sum(ratio > 0 for ratio in ratios)
    return gear_names(forward, 0) if forward else gear_names(0, len(ratios))


def gear_names(forward: int, backward: int) -> list[str]:
    """Return names for numbers of forward and reverse gears, each from the slowest gear.

    >>> gear_names(2, 1), gear_names(1, 2)
    (['1', '2', 'R'], ['1', 'R1', 'R2'])
    """
    of_backward = [f"R{number}" for number in range(1, backward + 1)] if backward > 1 else ["R"]
    return [*map(str, range(1, forward + 1)), *of_backward[:backward]]
