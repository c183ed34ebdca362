"""Options that belong together and that a command receives as one argument."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterable, Mapping
from functools import wraps
from typing import TYPE_CHECKING, Any, TypeVar

import click

from vstatics.core.annexes import module_of_method
from vstatics.core.errors import Problem, ReadError
from vstatics.core.extras import higher, missing

if TYPE_CHECKING:
    from click.shell_completion import CompletionItem

Command = TypeVar("Command", bound=Callable[..., Any])
Option = Callable[[Any], Any]
"""Decorator that adds an option to a command, as returned by click."""


def needs(extra: str, purpose: str) -> None:
    """Raise an error if the package `extra`, which a purpose needs, is not installed."""
    if message := missing(extra, purpose):
        raise ReadError([Problem("E014", message)])


def provided(name: str) -> Callable[[Command], Command]:
    """Return the decorator that adds options of an annex; without the annex, it adds none."""
    return higher(name) if module_of_method(name) else lambda command: command


def gathered(
    name: str, build: Callable[..., object], *options: Option
) -> Callable[[Command], Command]:
    r"""Return a decorator that combines options into a single argument.

    Parameters
    ----------
    name : str
        Name of the argument of the command.
    build : callable
        Function that returns the argument; its parameters have the names of the options.
    *options : callable
        Options in the order of the help. The command receives options that `build` does not take.

    Examples
    --------
    >>> import click
    >>> from click.testing import CliRunner
    >>> from typing import NamedTuple
    >>> class Size(NamedTuple):
    ...     wide: int
    ...     high: int = 7
    >>> @click.command()
    ... @gathered("size", Size, click.option("--wide", type=int))
    ... def show(size: Size) -> None:
    ...     click.echo(size)
    >>> CliRunner().invoke(show, ["--wide", "3"]).output
    'Size(wide=3, high=7)\n'
    """
    names = inspect.signature(build).parameters

    def put(command: Command) -> Command:
        @wraps(command)
        def with_value(**given: Any) -> Any:
            taken = {key: given.pop(key) for key in names if key in given}
            return command(**{name: build(**taken)}, **given)

        decorated: Any = with_value
        for option in reversed(options):
            decorated = option(decorated)
        return decorated  # type: ignore[no-any-return]

    return put


def completing(
    names: Callable[[], Iterable[str]],
) -> Callable[[Any, Any, str], list[CompletionItem]]:
    """Return a completion of option values by names; names are listed only if a shell asks.

    Of comma-separated names the last is completed.

    >>> complete = completing(lambda: ["zf-8hp70", "simpson"])
    >>> [item.value for begun in ("zf", "a,s") for item in complete(None, None, begun)]
    ['zf-8hp70', 'a,simpson']
    """

    def complete(_context: Any, _option: Any, begun: str) -> list[CompletionItem]:
        from click.shell_completion import CompletionItem  # only a shell asks for it

        known = names()
        before, comma, begun = begun.rpartition(",")
        helps = known if isinstance(known, Mapping) else dict.fromkeys(known)
        return [
            CompletionItem(before + comma + name, help=says)
            for name, says in helps.items()
            if name.casefold().startswith(begun.casefold())
        ]

    return complete


def refuse(*rules: tuple[object, str]) -> None:
    """Raise the first error in combinations of options.

    Parameters
    ----------
    *rules : tuple
        Condition of the error, and its message.

    Raises
    ------
    UsageError
    """
    for wrong, message in rules:
        if wrong:
            raise click.UsageError(message)
