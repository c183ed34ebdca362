"""Group of commands, each in a module that is imported when its command is called."""

from __future__ import annotations

from collections.abc import Mapping
from importlib import import_module
from typing import ClassVar

import click

from vstatics.core.annexes import missing_command
from vstatics.core.errors import quoted
from vstatics.core.suggestions import nearest

Modules = Mapping[str, tuple[str, str]]
"""Module and summary of each command. The module defines the command as `NAME_command`."""


class LazyGroup(click.Group):
    """Group that imports the module of a command when the command is called."""

    modules: ClassVar[Modules] = {}

    def listed(self) -> Modules:
        """Return modules and summaries of all commands, in the order of the help text."""
        return self.modules

    def module(self, name: str) -> str:
        """Return the module of a command; empty if the command does not exist."""
        return self.listed().get(name, ("", ""))[0]

    def list_commands(self, ctx: click.Context) -> list[str]:  # noqa: ARG002
        """Return the names of all commands, in the order of the help text."""
        return list(self.listed())

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:  # noqa: ARG002
        """Import the module of a command, and return the command."""
        module = self.module(cmd_name)
        if not module:
            return None
        command: click.Command = getattr(import_module(module), f"{cmd_name}_command")
        return command

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """Find the command of the arguments; for an unknown name suggest a similar command."""
        name = args[0]
        if name.startswith("-") or self.module(name):
            return super().resolve_command(ctx, args)
        if message := missing_command(name):
            raise click.UsageError(message, ctx)
        raise click.UsageError(f"there is no command {quoted(name)}{self.hint(name)}", ctx)

    def hint(self, name: str) -> str:
        """Return the hint for an unknown name: the most similar command, or all commands."""
        file = "; expected a command before a file" * ("." in name)
        return nearest(name, self.listed()) or f"{file}; commands are {', '.join(self.listed())}"

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:  # noqa: ARG002
        """Write the list of commands without importing their modules."""
        with formatter.section("Commands"):
            formatter.write_dl([(name, summary) for name, (_, summary) in self.listed().items()])
