"""`vstatics run`: calculate cases and write the results."""

from __future__ import annotations

from typing import get_args

import click

from vstatics.cli import cases as arguments
from vstatics.cli import files, texts
from vstatics.cli.cases import CaseOptions, calculate
from vstatics.cli.exit_status import DONE, FAILED
from vstatics.statics.results import Language


@click.command()
@click.argument("cases", nargs=-1, type=click.Path(), metavar="CASE...")
@arguments.format_option(
    get_args(texts.OutputFormat),
    "Format of the results; else told by the suffix of -o, else listing.",
)
@click.option(
    "-o",
    "--output",
    type=click.Path(),
    help="Write to this file, whole or not at all; several cases to this directory.",
)
@click.option(
    "--files-from",
    type=click.Path(),
    metavar="FILE",
    help="More cases: one a line, or ended by NUL; - is standard input.",
)
@click.option(
    "-j",
    "--jobs",
    type=click.IntRange(min=1),
    default=1,
    show_default=True,
    help="Processes that share several cases.",
)
@click.option(
    "--resume", is_flag=True, help="Leave out cases whose result is in the directory already."
)
@click.option(
    "--pretty", is_flag=True, help="One coloured table of the gears, to read at a terminal."
)
@arguments.settings
@arguments.language("the headings of a listing")
def run(
    cases: tuple[str, ...],
    output_format: texts.OutputFormat | None,
    output: str | None,
    files_from: str | None,
    jobs: int,
    resume: bool,
    pretty: bool,
    settings: CaseOptions,
    lang: Language,
) -> int:
    """Calculate every gear of each CASE: a deck, YAML or JSON; - is standard input.

    \b
    Examples:
      vstatics run gearbox.dat
      vstatics run gearbox.yaml --pretty
      vstatics run gearbox.yaml -f json | jq .ratio
      cat gearbox.dat | vstatics run - --coast
      vstatics run variants/*.dat -f json -o results/ --jobs 4
      find . -name '*.dat' | vstatics run --files-from - -f jsonl -o all.jsonl

    Into a directory each case gives a file: its stem and .lst, .json or .csv. A case
    that fails does not stop the others. After Ctrl-C, --resume goes on.

    \b
    Exit status: 0 done; 1 a case is in error, a gear is tied up or in conflict;
    2 wrong use; 130 or 143 stopped by Ctrl-C or SIGTERM.
    Neutral, indeterminate and friction-locked gears are messages, not errors.
    """
    names = _named(cases, files_from)
    several = len(names) > 1 or files_from is not None
    if pretty:
        if output is not None or output_format is not None or jobs > 1 or resume:
            raise click.UsageError("--pretty is for a terminal: without -f, -o, --jobs, --resume")
        return _pretty(names, settings)
    output_format = output_format or texts.format_of_name(output or "")
    folder = _folder(output, output_format, several=several)
    if resume and folder is None:
        raise click.UsageError("--resume needs a directory to go on with: -o DIRECTORY/")
    if folder is None:
        files.spare([*names, *filter(None, [files_from])], output)
    if several or folder is not None or output_format == "jsonl":
        from vstatics.cli import many
        from vstatics.cli.case_job import Job

        job = Job(settings, output_format, lang)
        if folder is None:
            return many.to_stream(names, output, job, jobs=jobs)
        lists = [] if files_from in (None, files.STDIN) else [str(files_from)]
        return many.to_directory(names, folder, job, jobs=jobs, resume=resume, others=lists)
    [outcome] = calculate(names, settings)
    if outcome.results is not None:
        files.write_output(texts.alone(outcome, output_format, lang), output)
    return FAILED if outcome.failed else DONE


def _pretty(names: list[str], settings: CaseOptions) -> int:
    """Show the gears of each case to a person; the exit status."""
    from vstatics.cli.console import SafeConsole, trimmed
    from vstatics.summary.pretty import ASCII, DOTS, view

    console = SafeConsole(highlight=False)
    failed = False
    for outcome in calculate(names, settings):
        failed |= outcome.failed
        if outcome.results is not None:
            marks = ASCII if console.options.ascii_only else DOTS
            with console.capture() as captured:
                console.print(view(outcome.results, marks))
            files.write_output(trimmed(captured.get()), None)
    return FAILED if failed else DONE


def _folder(output: str | None, output_format: texts.OutputFormat, *, several: bool) -> str | None:
    """The directory that results go to, if they do."""
    if output is None:
        return None
    from vstatics.cli.targets import is_directory

    return output if is_directory(output, output_format, several=several) else None


def _named(cases: tuple[str, ...], files_from: str | None) -> list[str]:
    """All cases, of arguments and of the list."""
    if files_from is None:
        if not cases:
            raise click.UsageError("Missing argument 'CASE...'.")
        names = list(cases)
    else:
        if files_from == files.STDIN and files.STDIN in cases:
            raise click.UsageError("standard input (-) is the list of cases, and no case")
        names = [*cases, *files.read_names(files_from)]
    arguments.check_streams(names)
    return names
