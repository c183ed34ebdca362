"""Commands that list their options under headings, and options that have former names."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, TypeVar

import click

Decorated = TypeVar("Decorated", bound=Callable[..., Any])

INPUT = "Input"
CALCULATION = "Calculation"
OUTPUT = "Output"
PROCESSING = "Processing"
MESSAGES = "Messages"
HELP = "Help"
_LAST = (CALCULATION, OUTPUT, PROCESSING, MESSAGES, HELP)
"""Headings that follow the input and the headings of the command, in this order."""
_FEW = 7
"""Largest number of options that are listed under the single heading "Options"."""
_HEADING = "heading"
"""Attribute of an option with the heading of the option in the help text."""
_PARAMETERS = "__click_params__"
"""Attribute of a function to which decorators of click append options."""
_WIDTH = 28
"""Largest width of the column of options, in characters; longer options get a line of their own."""


def _place(heading: str) -> int:
    """Return the sort key of a heading; headings of a command are between input and calculation."""
    return -1 if heading == INPUT else heading in _LAST and _LAST.index(heading) + 1


class RenamedOption(click.Option):
    """Option with former names, which are accepted, but neither listed nor completed."""

    def __init__(self, *names: Any, former: Sequence[str] = (), **named: Any) -> None:
        super().__init__(*names, **named)
        self.former = tuple(former)

    def add_to_parser(self, parser: Any, ctx: click.Context) -> None:
        """Add the option to the parser by all of its names."""
        names = self.opts
        self.opts = [*names, *self.former]
        super().add_to_parser(parser, ctx)
        self.opts = names


class HeadedCommand(click.Command):
    """Command whose help lists the options under headings if it has more than a few options."""

    def format_options(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the options, by heading, in the order of declaration."""
        listed: dict[str, list[tuple[str, str]]] = {}
        for option in self.get_params(ctx):
            if isinstance(option, click.Option) and (record := option.get_help_record(ctx)):
                is_help = "--help" in option.opts
                heading = HELP if is_help else getattr(option, _HEADING, CALCULATION)
                listed.setdefault(heading, []).append(record)
        if sum(map(len, listed.values())) <= _FEW:
            listed = {"Options": [record for records in listed.values() for record in records]}
        names = [len(name) for records in listed.values() for name, _ in records]
        width = min(max(names), _WIDTH)  # common to all headings
        for heading in sorted(listed, key=_place):
            with formatter.section(heading):
                rows = [(name.ljust(width), text) for name, text in listed[heading]]
                formatter.write_dl(rows, col_max=_WIDTH)


def command(function: Callable[..., Any]) -> click.Command:
    """Return the command of a function `NAME_command`, whose docstring is the help text.

    The suffix distinguishes the command from a function of the Python interface, such as `sweep`.
    """
    return click.command(cls=HeadedCommand)(function)


def under(heading: str, *options: Callable[[Any], Any]) -> Callable[[Decorated], Decorated]:
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

    def put(function: Decorated) -> Decorated:
        earlier = len(getattr(function, _PARAMETERS, ()))
        for option in reversed(options):
            function = option(function)
        for parameter in getattr(function, _PARAMETERS)[earlier:]:
            vars(parameter).setdefault(_HEADING, heading)
        return function

    return put
