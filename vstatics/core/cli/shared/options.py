"""Options that belong together: a command gets them as one value, such as a record of them."""

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
"""As click declares it: it is put on a command."""


def needs(extra: str, purpose: str) -> None:
    """Refuse what needs a package that is not there."""
    if message := missing(extra, purpose):
        raise ReadError([Problem("E014", message)])


def provided(name: str) -> Callable[[Command], Command]:
    """Return the decorator of options of an annex; without the annex it adds nothing."""
    decorator: Callable[[Command], Command] = _unchanged
    return higher(name) if module_of_method(name) else decorator


def _unchanged(command: Command) -> Command:
    return command


def gathered(
    name: str, made: Callable[..., object], *options: Option
) -> Callable[[Command], Command]:
    r"""Options that become one value.

    Parameters
    ----------
    name : str
        Under which the command gets it.
    made : callable
        Gives it; takes options by their names, as a record does by those of its fields.
    *options : callable
        In the order of the help. What `made` does not take goes on to the command.

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
    names = inspect.signature(made).parameters

    def put(command: Command) -> Command:
        @wraps(command)
        def with_value(**given: Any) -> Any:
            own = {key: given.pop(key) for key in names if key in given}
            return command(**{name: made(**own)}, **given)

        decorated: Any = with_value
        for option in reversed(options):
            decorated = option(decorated)
        return decorated  # type: ignore[no-any-return]

    return put


def completing(
    names: Callable[[], Iterable[str]],
) -> Callable[[Any, Any, str], list[CompletionItem]]:
    """Completion of an option by names, which are asked for when a shell wants them.

    Of several with commas the last is completed.

    >>> complete = completing(lambda: ["zf-8hp70", "simpson"])
    >>> [one.value for begun in ("zf", "a,s") for one in complete(None, None, begun)]
    ['zf-8hp70', 'a,simpson']
    """

    def complete(_context: Any, _option: Any, begun: str) -> list[CompletionItem]:
        from click.shell_completion import CompletionItem  # only a shell asks for it

        known = names()
        before, comma, begun = begun.rpartition(",")
        told = known if isinstance(known, Mapping) else dict.fromkeys(known)
        return [
            CompletionItem(before + comma + name, help=says)
            for name, says in told.items()
            if name.casefold().startswith(begun.casefold())
        ]

    return complete


def refuse(*rules: tuple[object, str]) -> None:
    """Say the first thing that is wrong with options.

    Parameters
    ----------
    *rules : tuple
        What is wrong if it is true, and the message.

    Raises
    ------
    UsageError
    """
    for wrong, message in rules:
        if wrong:
            raise click.UsageError(message)
