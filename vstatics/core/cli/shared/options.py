"""Options of commands: headings in the help text, former names, several options in an argument."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import wraps
from typing import TYPE_CHECKING, Any, TypeVar

import click

from vstatics.core.annexes import module_of_method
from vstatics.core.errors import ReadError
from vstatics.core.extras import higher, missing

if TYPE_CHECKING:
    from click.shell_completion import CompletionItem

Command = TypeVar("Command", bound=Callable[..., Any])
Option = Callable[[Any], Any]
"""Decorator of click that adds an option to a command."""

INPUT = "Input"
CALCULATION = "Calculation"
OUTPUT = "Output"
PROCESSING = "Processing"
MESSAGES = "Messages"
HELP = "Help"
_LAST = (CALCULATION, OUTPUT, PROCESSING, MESSAGES, HELP)
"""Headings at the end of the help text, after headings of input options and of the command."""
_FEW = 7
"""Number of options up to which all are under the heading "Options"."""
_HEADING = "heading"
"""Attribute that contains the heading of an option in the help text."""
_PARAMETERS = "__click_params__"
"""Attribute of a function in which click collects its options."""
_WIDTH = 28
"""Largest width of the column of options, in characters. Longer options have separate lines."""


def needs(extra: str, purpose: str) -> None:
    """Raise an error if the optional package `extra` is not installed."""
    if message := missing(extra, purpose):
        raise ReadError("E014", message)


def provided(name: str) -> Callable[[Command], Command]:
    """Return a decorator that adds options of an annex, if the annex is installed."""
    return higher(name) if module_of_method(name) else lambda command: command


def gathered(
    name: str, build: Callable[..., object], *options: Option
) -> Callable[[Command], Command]:
    r"""Return a decorator that combines options in a single argument of a command.

    Parameters
    ----------
    name : str
        Name of the argument of the command.
    build : callable
        Function that returns the argument. Its parameters have the names of options.
    *options : callable
        Options in the order of the help text. Options that `build` does not accept are passed to
        the command.

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
    """Return a function that completes option values in a shell, from `names` when needed.

    Of several comma-separated names, the last is completed.

    >>> complete = completing(lambda: ["zf-8hp70", "simpson"])
    >>> [item.value for begun in ("zf", "a,s") for item in complete(None, None, begun)]
    ['zf-8hp70', 'a,simpson']
    """

    def complete(_context: Any, _option: Any, begun: str) -> list[CompletionItem]:
        from click.shell_completion import CompletionItem  # needed only for completion

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
    """Raise an error if options violate a rule; only the first such rule is reported.

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


def _place(heading: str) -> int:
    """Return the sort key of a heading. Headings of a command are after the input options."""
    return -1 if heading == INPUT else heading in _LAST and _LAST.index(heading) + 1


class RenamedOption(click.Option):
    """Option with former names, which are accepted but neither listed nor completed."""

    def __init__(self, *names: Any, former: Sequence[str] = (), **named: Any) -> None:
        super().__init__(*names, **named)
        self.former = tuple(former)

    def add_to_parser(self, parser: Any, ctx: click.Context) -> None:
        """Add the option to the parser under all its names."""
        names = self.opts
        self.opts = [*names, *self.former]
        super().add_to_parser(parser, ctx)
        self.opts = names


class HeadedCommand(click.Command):
    """Command whose help text groups options under headings, if there are many."""

    def format_options(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the options by heading, in the order in which they are declared."""
        listed: dict[str, list[tuple[str, str]]] = {}
        for option in self.get_params(ctx):
            if isinstance(option, click.Option) and (record := option.get_help_record(ctx)):
                is_help = "--help" in option.opts
                heading = HELP if is_help else getattr(option, _HEADING, CALCULATION)
                listed.setdefault(heading, []).append(record)
        if sum(map(len, listed.values())) <= _FEW:
            listed = {"Options": [record for records in listed.values() for record in records]}
        names = [len(name) for records in listed.values() for name, _ in records]
        width = min(max(names), _WIDTH)  # equal for all headings
        for heading in sorted(listed, key=_place):
            with formatter.section(heading):
                rows = [(name.ljust(width), text) for name, text in listed[heading]]
                formatter.write_dl(rows, col_max=_WIDTH)


def command(function: Callable[..., Any]) -> click.Command:
    """Return the command for a function `NAME_command`, with the docstring as the help text.

    The suffix `_command` distinguishes the function from functions of the Python interface, such as
    `sweep`.
    """
    return click.command(cls=HeadedCommand)(function)


def under(heading: str, *options: Option) -> Callable[[Command], Command]:
    """Return a decorator that adds options under a heading of the help text.

    Examples
    --------
    >>> from click.testing import CliRunner
    >>> @command
    ... @under("Size", *(click.option(f"--{name}") for name in "abcdefgh"))
    ... def show_command(**sizes: str) -> None: ...
    >>> show_command.name, *CliRunner().invoke(show_command, ["--help"]).output.splitlines()[2:4]
    ('show', 'Size:', '  --a TEXT')
    """

    def put(function: Command) -> Command:
        earlier = len(getattr(function, _PARAMETERS, ()))
        for option in reversed(options):
            function = option(function)
        for parameter in getattr(function, _PARAMETERS)[earlier:]:
            vars(parameter).setdefault(_HEADING, heading)
        return function

    return put
