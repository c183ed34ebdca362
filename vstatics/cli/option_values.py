"""Values of options with names, and numbers in them: calculations such as 73/35 are numbers."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import TypeVar

import click

from vstatics.cli.named_values import named_values
from vstatics.errors import CaseError, quoted
from vstatics.readers.named.scalars import number

Value = TypeVar("Value")


def pair(text: str, example: str = "-4:-1.5") -> tuple[float, float]:
    """Both bounds, or the one number that both are.

    Raises
    ------
    ValueError

    Examples
    --------
    >>> pair("-4:-1.5"), pair("-2")
    ((-4.0, -1.5), (-2.0, -2.0))
    """
    low, colon, high = text.partition(":")
    try:
        return number(low), number(high if colon else low)
    except ValueError:
        raise ValueError(f"expected LOW:HIGH, such as {example}, or one number") from None


def named(
    option: str, texts: Sequence[str], shape: str, read: Callable[[str], Value]
) -> dict[str, Value]:
    """The values of an option by their names; it may be given several times.

    Raises
    ------
    BadParameter
    """
    found: dict[str, Value] = {}
    for text in texts:
        try:
            for name, value in named_values(text, shape):
                if name in found:
                    raise ValueError(f"{name} is given twice")  # noqa: TRY301
                try:
                    found[name] = read(value)
                except ValueError as error:
                    raise ValueError(f"{name}: read {quoted(value)}, {error}") from None
        except ValueError as error:
            raise click.BadParameter(str(error), param_hint=f"--{option}") from None
    return found


@contextmanager
def wrong_use(options: Sequence[str]) -> Iterator[None]:
    """Tell problems whose path begins with the name of an option as wrong use of that.

    Raises
    ------
    UsageError
    CaseError
        Where there are only others.
    """
    try:
        yield
    except CaseError as error:
        of_options = [one for one in error.problems if one.path[:1] and one.path[0] in options]
        if not of_options:
            raise
        lines = [f"Invalid value for --{one.path[0]}: {one.message}" for one in of_options]
        raise click.UsageError("\n".join(lines)) from None
