"""Command line of the program. No other package prints anything or ends the process.

A command writes results to stdout and messages to stderr, and returns an exit status.

>>> from click.testing import CliRunner
>>> answer = CliRunner().invoke(main, ["run", "nowhere/box.yaml"])
>>> answer.exit_code, answer.stderr.rstrip()
(1, 'nowhere/box.yaml: error: cannot be read: No such file or directory [E006]')

The records of the core and of the annexes list the commands. `shared` contains code that all
commands use: input and output, cases, values of options. `templates` contains cases for the command
`new`. `schemas` writes the JSON Schemas of all documents.
"""

from __future__ import annotations

import contextlib
import os
import re
import sys
from collections.abc import Iterator, Sequence
from typing import Any

import click

from vstatics.core.annexes import annexes, picture_kinds
from vstatics.core.cli.shared import files
from vstatics.core.cli.shared.exit_status import DONE, FAILED, WRONG_USE, stopped_by
from vstatics.core.cli.shared.lazy_group import LazyGroup, Modules
from vstatics.core.errors import ReadError, printable, quoted, spoken
from vstatics.core.extras import __version__, build
from vstatics.core.jobs.files import unwritable
from vstatics.core.jobs.stopping import Stop, StoppedError, stoppable
from vstatics.core.record import CORE
from vstatics.core.suggestions import nearest

click.UsageError.exit_code = WRONG_USE

WITH_LANGUAGES = ("run", "flow", "summary", "explain", "plot", "report", "serve")
"""Commands with the option --lang, whose output has several languages."""


_ELSEWHERE = {"--lang": WITH_LANGUAGES, "--gear": ("flow", "explain", "torsion", "plot")}
"""Options that users expect in all commands, with the commands that have them."""


class Commands(LazyGroup):
    """Group of all commands of the program, which also sets the exit status."""

    def listed(self) -> Modules:
        """Return the commands of the core and of all annexes, in the order of the help text."""
        commands = [pair for record in (CORE, *annexes()) for pair in record.commands.items()]
        ordered = sorted(commands, key=lambda pair: pair[1].place)
        return {name: (command.module, command.help) for name, command in ordered}

    def module(self, name: str) -> str:
        """Return the module of a command, from the core or an annex."""
        return CORE.commands[name].module if name in CORE.commands else super().module(name)

    def hint(self, name: str) -> str:
        """Return the hint for an unknown name, which can be a kind of picture."""
        if name in picture_kinds():
            return f"; {quoted(name)} is a picture: `vstatics plot --kind {name}`"
        return super().hint(name)

    def make_context(self, *values: Any, **named: Any) -> click.Context:
        """Return the context of click, and make error messages safe to print."""
        try:
            with _safe_usage_errors():
                return super().make_context(*values, **named)
        except ReadError as error:
            files.show(error.problems)
            raise click.exceptions.Exit(FAILED) from None

    def invoke(self, ctx: click.Context) -> Any:
        """Run a command, and exit with its status, also after an error or a signal."""
        try:
            with stoppable() as stop, _safe_usage_errors():
                status = self._status(ctx, stop)
        except StoppedError as stopped:
            files.say("stopped")
            status = stopped_by(stopped.signal)
        ctx.exit(status)

    def _status(self, ctx: click.Context, stop: Stop) -> int:
        try:
            status = super().invoke(ctx) or DONE
        except click.exceptions.Exit as leaving:
            return leaving.exit_code
        except ReadError as error:
            files.show(error.problems)
        except (click.ClickException, click.Abort, OSError):
            raise
        except Exception as error:  # noqa: BLE001 - users need a message, not a traceback
            stop.check()  # a signal during an import can cause the error
            from vstatics.core.cli.shared.cases import unexpected

            files.show([unexpected(f"vstatics {ctx.invoked_subcommand}", error)])
        else:
            if status == DONE:
                stop.check()  # Python can have dropped the error of a signal
            return status
        return FAILED


@contextlib.contextmanager
def _safe_usage_errors() -> Iterator[None]:
    try:
        yield
    except click.exceptions.NoArgsIsHelpError:
        raise  # the error is a help text, which needs no hint
    except click.UsageError as error:
        unknown = error.option_name if isinstance(error, click.NoSuchOption) else ""
        if isinstance(error, click.NoSuchOption):  # click compares options with their dashes
            near = [name for name in error.possibilities or () if nearest(unknown[2:], [name[2:]])]
            error = click.NoSuchOption(unknown, possibilities=near, ctx=error.ctx)
        message = printable(error.format_message(), lines=True)
        if unknown in _ELSEWHERE and f"{unknown}s" not in message:
            others = spoken(installed(_ELSEWHERE[unknown]))
            message = f"No such option '{unknown}': {others} have it."
        if unknown in ("-o", "--output") and error.ctx and error.ctx.info_name == "convert":
            message = f"No such option '{unknown}': expected `convert IN OUT`."
        raise click.UsageError(_with_hint(message), error.ctx) from None


def installed(names: Sequence[str]) -> list[str]:
    """Return the commands in `names` that are installed."""
    listed = main.listed()
    return [name for name in names if name in listed]


def _with_hint(message: str) -> str:
    """Return a message of click with a hint on the spelling of a number or a choice.

    >>> _with_hint("'stik' is not one of 'stick', 'flow'.")
    "'stik' is not one of 'stick', 'flow'; did you mean `stick`?"
    """
    if choice := re.search(r"'([^']*)' is not one of ('.*')\.$", message):
        hint = nearest(choice[1], re.findall(r"'([^']*)'", choice[2]))
        return message.removesuffix(".") + hint if hint else message
    number = re.search(r"'([^']*)' is not a valid float", message)
    if number is None:
        return message
    from vstatics.core.readers.named.arithmetic import slip  # costs start-up time

    return message + slip(number[1])


def _print_version(context: click.Context, _: click.Parameter, value: bool) -> None:
    if value and not context.resilient_parsing:
        files.write_output(f"vstatics, version {__version__}, build {build()}\n", None)
        context.exit()


@click.group(cls=Commands, context_settings={"help_option_names": ["-h", "--help"]})
@click.option(
    "--version",
    is_flag=True,
    expose_value=False,
    is_eager=True,
    callback=_print_version,
    help="Print the version and the build, and exit.",
)
def main() -> None:
    """Calculate vehicle transmissions from their stick diagrams.

    A case describes gear sets, shift elements and gears in YAML, or in a deck of the
    program Visual-Statics. You get ratios, speeds, torques, efficiency and power flow of
    every gear, and can vary, draw, simulate and design gearboxes.

    \b
    Examples:
      vstatics new gearbox.yaml --template zf-8hp70
      vstatics run gearbox.yaml --pretty
      vstatics check gearbox.yaml
      vstatics plot gearbox.yaml --kind stick -o gearbox.svg
      vstatics report gearbox.yaml -o gearbox.html
      vstatics run gearbox.yaml --help

    The first example writes the case that the help of all commands uses.

    \b
    Exit status of all commands:
      0    success
      1    an error in a case, an incomplete result, or a difference in `compare`
      2    wrong use of the command line
      3    a sweep without rows, with --fail-empty
      130  stopped by Ctrl-C; 143: stopped by SIGTERM
    The help of each command lists its causes of status 1.

    \b
    Completion in bash; in zsh and fish write their name instead of `bash`:
      eval "$(_VSTATICS_COMPLETE=bash_source vstatics)"
    """


def entry() -> None:
    """Run the program and exit at once.

    The interpreter is not finalised, because this takes longer than a calculation, and all files
    are already closed. Python code calls `main` instead.
    """
    code: int | str | None = DONE
    try:
        try:
            main(prog_name="vstatics")
        except SystemExit as leaving:
            code = leaving.code
        if not code and sys.stdout is not None:  # stdout can be closed
            sys.stdout.flush()
    except BrokenPipeError:  # the program that reads the pipe has closed it
        code = FAILED
    except OSError as error:
        files.show([unwritable(None, error)])
        code = FAILED
    with contextlib.suppress(OSError, AttributeError):
        sys.stderr.flush()
    os._exit(code if isinstance(code, int) else FAILED)
