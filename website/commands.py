"""Reference of the commands, from the declarations of their options."""

from __future__ import annotations

from collections.abc import Iterator

import click

from vstatics.core.cli import main
from vstatics.core.cli.shared.lazy_group import LazyGroup
from website.page import Page, anchor, escaped


def pages() -> Iterator[Page]:
    """Yield a page for each command, and a page that lists all commands."""
    lines = ["# Commands", "", "| command | what it does |", "| --- | --- |"]
    for words, command, summary in commands(main, ()):
        name = "-".join(words)
        lines.append(f"| [`vstatics {' '.join(words)}`]({name}.md) | {escaped(summary)} |")
        yield Page("reference", f"reference/commands/{name}", _page(words, command, summary))
    yield Page("reference", "reference/commands/index", "\n".join([*lines, ""]))


def commands(
    group: LazyGroup, before: tuple[str, ...]
) -> Iterator[tuple[tuple[str, ...], click.Command, str]]:
    """Yield the words, the object and the summary of each command.

    >>> [words for words, *_ in commands(main, ())][:2]
    [('new',), ('run',)]
    """
    context = click.Context(group)
    for name, (_, summary) in group.listed().items():
        command = group.get_command(context, name)
        if isinstance(command, LazyGroup):
            yield from commands(command, (*before, name))
        elif command is not None:
            yield (*before, name), command, summary


def _page(words: tuple[str, ...], command: click.Command, summary: str) -> str:
    context = click.Context(
        command, info_name=" ".join(["vstatics", *words]), **main.context_settings
    )
    formatter = click.HelpFormatter(width=80)
    command.format_help_text(context, formatter)
    usage = " ".join([context.command_path, *command.collect_usage_pieces(context)])
    lines = [
        f"# vstatics {' '.join(words)}",
        "",
        escaped(summary),
        "",
        *("```text", usage, "```", ""),
        *("```text", _dedented(formatter.getvalue()), "```", ""),
    ]
    for option in command.get_params(context):
        record = option.get_help_record(context)
        if record is None:
            continue
        usage_of_option, text = record
        lines += [anchor(f"{'-'.join(words)}{name}") for name in option.opts if name[:2] == "--"]
        lines += [f"`{usage_of_option}`", f": {escaped(text)}", ""]
    return "\n".join(lines)


def _dedented(text: str) -> str:
    lines = text.strip("\n").splitlines()
    return "\n".join(line.removeprefix("  ").rstrip() for line in lines)
