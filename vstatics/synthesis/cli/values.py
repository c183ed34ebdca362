"""Values of options of the search for gearboxes, and problems that concern an option."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager

import click

from vstatics.core.errors import CaseError
from vstatics.core.model.empty import EMPTY


def pair(text: str, example: str = "-4:-1.5") -> tuple[float, float]:
    """Parse LOW:HIGH, or a single number for both limits.

    Raises
    ------
    ValueError

    Examples
    --------
    >>> pair("-4:-1.5"), pair("-2")
    ((-4.0, -1.5), (-2.0, -2.0))
    """
    from vstatics.core.readers.named.arithmetic import slip
    from vstatics.core.readers.named.scalars import number

    low, colon, high = text.partition(":")
    try:
        return number(low), number(high if colon else low)
    except ValueError:
        expected = f"expected LOW:HIGH, such as {example}, or one number{slip(text)}"
        raise ValueError(expected) from None


@contextmanager
def wrong_use(options: Sequence[str], spelled: Mapping[str, str] = EMPTY) -> Iterator[None]:
    """Run the block; report problems whose path begins with an option as wrong use of it.

    `spelled` maps names of options in paths to names on the command line, if they differ.

    Raises
    ------
    UsageError
    CaseError
        If no problem concerns an option.
    """
    try:
        yield
    except CaseError as error:
        of_options = [
            problem for problem in error.problems if problem.path[:1] and problem.path[0] in options
        ]
        if not of_options:
            raise
        names = [str(problem.path[0]) for problem in of_options]
        lines = [
            f"Invalid value for --{spelled.get(name, name)}: {problem.message}"
            for name, problem in zip(names, of_options, strict=True)
        ]
        raise click.UsageError("\n".join(lines)) from None
