"""What `vstatics synth box` is asked for, by its options."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import wraps
from typing import Any, NamedTuple

import click

from vstatics.cli.frame.cases import Command
from vstatics.cli.frame.values import Value, named, pair, separated, wrong_use
from vstatics.errors import nearest, plural, quoted, spoken, typed_number
from vstatics.readers.named.scalars import number
from vstatics.synthesis.boxes.box import BoxSearch
from vstatics.synthesis.boxes.checks import check_box_search
from vstatics.synthesis.boxes.choice import LIMITED, BoxFilter
from vstatics.synthesis.boxes.search import EFFICIENCY


class BoxAsked(NamedTuple):
    """A search, and which of the found boxes are told."""

    search: BoxSearch
    efficiency: float
    wanted: BoxFilter


def options(command: Command) -> Command:
    """The options of a search and its filters; the command gets `asked`."""

    @wraps(command)
    def with_asked(*values: Any, **others: Any) -> Any:
        said = {name: others.pop(name) for name in _NAMES}
        return command(*values, asked=_asked(**said), **others)

    decorated: Any = with_asked
    for option in reversed(_OPTIONS):
        decorated = option(decorated)
    return decorated  # type: ignore[no-any-return]


_OPTIONS: tuple[Callable[[Any], Any], ...] = (
    click.option("--sets", type=int, required=True, metavar="N", help="Planetary sets."),
    click.option(
        "--elements", type=int, required=True, metavar="M", help="Brakes and clutches in all."
    ),
    click.option(
        "--engaged",
        type=int,
        required=True,
        metavar="E",
        help="So many of them are engaged in every gear.",
    ),
    click.option(
        "--ratios",
        multiple=True,
        required=True,
        metavar="I,...",
        help="The ratio of each gear, those backward below 0; may be given several times.",
    ),
    click.option(
        "--bounds",
        default="1.4:5",
        show_default=True,
        metavar="LOW:HIGH",
        help="Ring teeth/sun teeth of each set.",
    ),
    click.option(
        "--meshed",
        type=int,
        default=0,
        metavar="K",
        help="So many sets have planets that mesh with each other.",
    ),
    click.option(
        "--own-input",
        is_flag=True,
        help="The input is a shaft that only clutches join to the sets.",
    ),
    click.option(
        "--fixed",
        type=int,
        default=0,
        metavar="K",
        help="So many members of sets are held for good.",
    ),
    click.option(
        "--tolerance",
        type=float,
        default=BoxSearch._field_defaults["tolerance"],
        show_default=True,
        metavar="T",
        help="A box is found where all |ln(i/wanted)| can be no more.",
    ),
    click.option(
        "--efficiency",
        type=float,
        default=EFFICIENCY,
        show_default=True,
        metavar="ETA",
        help="Of each set with its carrier held.",
    ),
    click.option("--single", is_flag=True, help="One element changes between neighbours."),
    click.option("--planar", is_flag=True, help="No shafts need cross."),
    click.option("--brakes", multiple=True, metavar="N,..", help="So many brakes: 2, or 2,3."),
    click.option("--clutches", multiple=True, metavar="N,..", help="So many clutches."),
    click.option(
        "--limit",
        multiple=True,
        metavar="FIGURE=X,...",
        help=f"No larger {spoken(LIMITED, 'or')}, such as loss=.05,torque=4.",
    ),
)
_NAMES = (
    *("sets", "elements", "engaged", "ratios", "bounds", "meshed", "own_input", "fixed"),
    *("tolerance", "efficiency", "single", "planar", "brakes", "clutches", "limit"),
)


def _asked(
    ratios: Sequence[str],
    bounds: str,
    efficiency: float,
    brakes: Sequence[str],
    clutches: Sequence[str],
    limit: Sequence[str],
    single: bool,
    planar: bool,
    **counts: Any,
) -> BoxAsked:
    """What the options ask for.

    Raises
    ------
    UsageError
    """
    targets = _each("ratios", ratios, number)
    both = _read("bounds", bounds, lambda text: pair(text, "1.4:5"))
    search = BoxSearch(targets=targets, bounds=both, **counts)
    with wrong_use([*counts, "ratios", "bounds"]):
        check_box_search(search)
    if not 0 < efficiency <= 1:
        raise _refused("efficiency", f"read {efficiency:g}, expected a number above 0, up to 1")
    numbers = {
        name: tuple(sorted({*_each(name, texts, lambda text: _count(text, search.elements))}))
        for name, texts in (("brakes", brakes), ("clutches", clutches))
    }
    _check_sum(search.elements, **numbers)
    limits = named("limit", limit, "FIGURE=X", number)
    _check_limits(limits)
    return BoxAsked(search, efficiency, BoxFilter(single, planar, limits=limits, **numbers))


def _each(option: str, texts: Sequence[str], read: Callable[[str], Value]) -> tuple[Value, ...]:
    """What an option has between commas, each read."""
    return tuple(_read(option, word, read) for word in separated(texts))


def _read(option: str, text: str, read: Callable[[str], Value]) -> Value:
    """A value of an option.

    Raises
    ------
    BadParameter
    """
    try:
        return read(text)
    except ValueError as error:
        raise _refused(option, f"read {quoted(text)}, {error}") from None


def _count(text: str, most: int) -> int:
    """How many of the elements."""
    if text.strip("0") == "" and text:
        return 0
    count = typed_number(text, most)
    if count is None:
        raise ValueError(f"expected a number from 0 to {most}, as there are so many elements")
    return count


def _check_sum(elements: int, brakes: Sequence[int], clutches: Sequence[int]) -> None:
    """Refuse counts that no elements have together."""
    if brakes and clutches and elements not in {one + two for one in brakes for two in clutches}:
        noun = plural("brake", brakes[-1])
        there = f"{spoken(map(str, brakes), 'or')} {noun}"
        message = f"read {spoken(map(str, clutches), 'or')}, but with {there} these are not"
        raise _refused("clutches", f"{message} {elements} elements together")


def _check_limits(limits: dict[str, float]) -> None:
    """Refuse limits of what is no figure, and those that are no numbers."""
    for name, value in limits.items():
        if name not in LIMITED:
            hint = nearest(name, LIMITED) or f"; expected {spoken(LIMITED, 'or')}"
            raise _refused("limit", f"read {quoted(name)}, but there is no such figure{hint}")
        if math.isnan(value):
            raise _refused("limit", f"{name}: read {value}, expected a number")


def _refused(option: str, message: str) -> click.BadParameter:
    return click.BadParameter(message, param_hint=f"--{option}")
