"""The command line: it alone prints, opens files and exits.

Words of a command line go in; results go to stdout, messages to stderr, and an exit status.

>>> from click.testing import CliRunner
>>> said = CliRunner().invoke(main, ["run", "nowhere/box.yaml"])
>>> said.exit_code, said.stderr.rstrip()
(1, "nowhere/box.yaml: error: can't be read: No such file or directory [E006]")

The record of the core and those of the annexes list the commands.
`shared` has what all of them share: input and output, cases, values of options. `templates` are
the cases of `new`. `schemas` writes the JSON Schemas of all.
"""

from __future__ import annotations

import contextlib
import os
import re
import sys
from collections.abc import Iterator
from typing import Any

import click

from vstatics.core.annexes import annexes
from vstatics.core.cli.shared import files
from vstatics.core.cli.shared.exit_status import DONE, FAILED, WRONG_USE, stopped_by
from vstatics.core.cli.shared.lazy_group import LazyGroup, Modules
from vstatics.core.errors import ReadError, printable
from vstatics.core.extras import __version__, build
from vstatics.core.jobs.files import unwritable
from vstatics.core.jobs.stopping import Stop, StoppedError, stoppable
from vstatics.core.record import CORE
from vstatics.core.suggestions import nearest

click.UsageError.exit_code = WRONG_USE

WITH_LANGUAGES = ("run", "flow", "summary", "explain", "plot", "report", "serve")
"""Commands that have words in other languages, by --lang."""


class Commands(LazyGroup):
    """The commands, and the exit status of each."""

    def listed(self) -> Modules:
        """Return the commands of the core and of the annexes in the order of their places."""
        commands = [pair for record in (CORE, *annexes()) for pair in record.commands.items()]
        ordered = sorted(commands, key=lambda pair: pair[1].place)
        return {name: (command.module, command.help) for name, command in ordered}

    def module(self, name: str) -> str:
        """Return the module of a command; records are read for those of annexes alone."""
        return CORE.commands[name].module if name in CORE.commands else super().module(name)

    def make_context(self, *values: Any, **named: Any) -> click.Context:
        """As click does; messages are safe to print, and that of the version may fail."""
        try:
            with _safely_told():
                return super().make_context(*values, **named)
        except ReadError as error:
            files.show(error.problems)
            raise click.exceptions.Exit(FAILED) from None

    def invoke(self, ctx: click.Context) -> Any:
        """Exit with the status of the command, also where it can't read or write or is stopped."""
        try:
            with stoppable() as stop, _safely_told():
                status = self._status(ctx, stop)
        except StoppedError as stopped:
            files.say("stopped")
            status = stopped_by(stopped.signal)
        ctx.exit(status)

    def _status(self, ctx: click.Context, stop: Stop) -> int:
        """The exit status that the command returns; 1 if a file can't be read or written."""
        try:
            return super().invoke(ctx) or DONE
        except click.exceptions.Exit as leaving:
            return leaving.exit_code
        except ReadError as error:
            files.show(error.problems)
        except (click.ClickException, click.Abort, OSError):
            raise
        except Exception as error:  # noqa: BLE001 - whoever uses the program wants no trace
            stop.check()  # an import that is stopped may end in an error of another kind
            from vstatics.core.cli.shared.cases import unexpected

            files.show([unexpected(f"vstatics {ctx.invoked_subcommand}", error)])
        return FAILED


@contextlib.contextmanager
def _safely_told() -> Iterator[None]:
    """Let click tell wrong use in a message that is safe to print."""
    try:
        yield
    except click.exceptions.NoArgsIsHelpError:
        raise  # its message is the help, and shown as that
    except click.UsageError as error:
        message = printable(error.format_message(), lines=True)
        if isinstance(error, click.NoSuchOption) and error.option_name == "--lang":
            *most, last = with_languages()
            message += f" {', '.join(most)} and {last} have it."
        raise click.UsageError(_with_hint(message), error.ctx) from None


def with_languages() -> list[str]:
    """Return the installed commands that have words in other languages."""
    installed = main.listed()
    return [name for name in WITH_LANGUAGES if name in installed]


def _with_hint(message: str) -> str:
    """Return a message of click with a hint on the spelling of a number or of a choice.

    >>> _with_hint("'stik' is not one of 'stick', 'flow'.")
    "'stik' is not one of 'stick', 'flow'; did you mean `stick`?"
    """
    if choice := re.search(r"'([^']*)' is not one of ('.*')\.$", message):
        hint = nearest(choice[1], re.findall(r"'([^']*)'", choice[2]))
        return message.removesuffix(".") + hint if hint else message
    number = re.search(r"'([^']*)' is not a valid float", message)
    if number is None:
        return message
    from vstatics.core.readers.named.arithmetic import slip  # needless at the start of commands

    return message + slip(number[1])


def _tell_version(context: click.Context, _: click.Parameter, value: bool) -> None:
    if value and not context.resilient_parsing:
        files.write_output(f"vstatics, version {__version__}, build {build()}\n", None)
        context.exit()


@click.group(cls=Commands, context_settings={"help_option_names": ["-h", "--help"]})
@click.option(
    "--version",
    is_flag=True,
    expose_value=False,
    is_eager=True,
    callback=_tell_version,
    help="Show the version and the build, and exit.",
)
def main() -> None:
    """Vehicle transmissions calculated from their kinematic scheme.

    Speeds, planet and slip speeds, torques with and without losses, efficiency
    and power flow in every gear, from a Visual-Statics deck or YAML.

    \b
    Examples:
      vstatics new gearbox.yaml --template ravigneaux
      vstatics run gearbox.dat                 tables of every gear
      vstatics run gearbox.dat -f source       the published listing, verbatim
      vstatics run gearbox.yaml -f json        the same for programs
      vstatics check gearbox.yaml              what is wrong or doubtful
      vstatics convert gearbox.dat gearbox.yaml
      vstatics compare result.json golden.json

    \b
    Completion in the shell (bash; zsh and fish likewise):
      eval "$(_VSTATICS_COMPLETE=bash_source vstatics)"
    """


def entry() -> None:
    """Run the program and leave at once.

    Tearing the interpreter down takes longer than a calculation, and all files are
    closed by then; `main` alone is for calls from Python.
    """
    code: int | str | None = DONE
    try:
        try:
            main(prog_name="vstatics")
        except SystemExit as leaving:
            code = leaving.code
        if not code and sys.stdout is not None:  # whoever called may have closed it
            sys.stdout.flush()
    except BrokenPipeError:  # the reader has seen enough
        code = FAILED
    except OSError as error:
        files.show([unwritable(None, error)])
        code = FAILED
    with contextlib.suppress(OSError, AttributeError):
        sys.stderr.flush()
    os._exit(code if isinstance(code, int) else FAILED)
