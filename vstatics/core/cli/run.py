"""`vstatics run`: calculation of cases, with the results in any format."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, Any

import click

from vstatics.core.cli.shared import cases as arguments
from vstatics.core.cli.shared import files, formats, texts
from vstatics.core.cli.shared.cases import CalculatedCase, CaseOptions, calculate
from vstatics.core.cli.shared.exit_status import DONE, FAILED
from vstatics.core.cli.shared.formats import Destination, OutputOptions, TextStyle
from vstatics.core.cli.shared.one_or_many import carry_out
from vstatics.core.cli.shared.options import OUTPUT, PROCESSING, command, refuse, under
from vstatics.core.cli.shared.texts import Job
from vstatics.core.errors import CaseError, printable
from vstatics.core.jobs.files import STDOUT, is_stream
from vstatics.core.jobs.workers import cores
from vstatics.core.statics.results import Results
from vstatics.core.texts import speaking

if TYPE_CHECKING:
    from vstatics.core.tables.grid import Grid

PLAIN: dict[str, Any] = {"color_system": None, "force_terminal": False}
"""Options of a `rich` console for plain text without colours."""
FORMATS = ("listing", "source", *formats.TABLES[1:], "parquet")
MANY = 100
"""Number of cases from which all processor cores are used by default."""


@command
@arguments.optional_argument
@under(
    OUTPUT,
    click.option(
        "--pretty",
        is_flag=True,
        help="Print a compact table of the gears instead of the listing, coloured on a terminal.",
    ),
    formats.options(*FORMATS, says="Format of the results", output_help=formats.OF_SEVERAL_CASES),
    click.option(
        "--own-tables",
        is_flag=True,
        help="Append tables that the listing of Visual-Statics does not have. Needs -f source.",
    ),
)
@arguments.files_from
@under(
    PROCESSING,
    click.option(
        "-j",
        "--jobs",
        type=click.IntRange(min=1),
        metavar="N",
        help="Number of worker processes for several cases.  [default: 1, or the number of cores "
        f"for {MANY} cases or more]",
    ),
    click.option(
        "--resume",
        is_flag=True,
        help="Resume a stopped run: skip each case whose result exists in the directory, or in "
        "the pieces of a .jsonl or .parquet file.",
    ),
)
@arguments.settings
@arguments.language(
    "headings and words; names and messages stay as they are. `source` is the same as -f source",
    "source",
)
def run_command(
    cases: tuple[str, ...],
    wanted: OutputOptions,
    files_from: str | None,
    jobs: int | None,
    resume: bool,
    pretty: bool,
    settings: CaseOptions,
) -> int:
    """Calculate every gear of each CASE: a deck, YAML, JSON or XLSX.

    The results are speeds, torques with and without losses, efficiency and power flow. The
    CASE `-` is standard input.

    \b
    Examples:
      vstatics run gearbox.yaml --pretty
      vstatics run gearbox.yaml
      vstatics run gearbox.yaml -f json | jq .ratio
      vstatics new mzkt.dat --template mzkt7922
      vstatics run mzkt.dat -f source
      cat gearbox.yaml | vstatics run - --coast
      vstatics run *.yaml *.dat -f json -o results/ --jobs 2
      vstatics run '**/*.yaml' -o all.parquet
      find . -name '*.dat' | vstatics run --files-from - -o all.jsonl

    The default format is a listing with the tables of Visual-Statics. -f source reproduces
    the published listing of Visual-Statics character by character. The program expands quoted
    patterns, in which ** stands for any folders. In a directory, each result has the name of its
    case. A case that fails does not stop the other cases.

    \b
    Exit status 1: a case has an error, a gear is tied up, or a freewheel can
    neither hold nor overrun. Gears that are neutral, indeterminate,
    back-driven or self-locking only get messages.
    """
    names = arguments.named(cases, files_from)
    several = len(names) > 1 or files_from is not None
    others = [] if files_from is None else [files_from]
    wanted = _without_alias(wanted)
    if pretty:
        if wanted.form is not None or jobs is not None or resume:
            without = "-f, --jobs, --resume, --lang source"
            raise click.UsageError(f"--pretty cannot be combined with {without}")
        return _pretty(names, settings, wanted, [*names, *others], several=several)
    to = wanted.destination([*names, *others], several=several)
    of_source = to.form == "source"
    refuse(
        (of_source and settings.coast, "--coast has no field in the published listing"),
        (of_source and settings.idle == "exact", "-f source has the signs of --unloaded published"),
    )
    if resume and not to.is_folder and (to.form not in formats.STREAMS or is_stream(to.output)):
        message = (
            "--resume needs the output of the stopped run: -o DIRECTORY/, or a .jsonl or "
            ".parquet file"
        )
        raise click.UsageError(message)
    job = Job(
        "run",
        settings,
        to,
        partial(show, to=to),
        _frame() if to.form == "csv" else None,
    )
    jobs = jobs or (cores() if len(names) >= MANY else 1)
    return carry_out(job, names, others=others, a_list=several, jobs=jobs, resume=resume)


def _without_alias(wanted: OutputOptions) -> OutputOptions:
    """Return the output options, with `-f source` instead of its alias `--lang source`.

    Raises
    ------
    UsageError
        If the user also requests another format.
    """
    if wanted.style.lang != "source":
        return wanted
    if wanted.form not in (None, "listing", "source"):
        raise click.UsageError(f"--lang source is an alias of -f source, not of -f {wanted.form}")
    return wanted._replace(form="source", style=wanted.style._replace(lang="en"))


def show(outcome: CalculatedCase, results: Results, to: Destination) -> texts.CaseOutput:
    """Return the output of a case: all tables of its results."""
    style = to.style
    if to.form == "source":
        return _as_published(outcome, results, style)

    def listing(_: str | None) -> str:
        from vstatics.core.writers import listing

        return listing.write(results, to.language, style.digits or listing.LISTING_DECIMALS)

    def csv(file: str | None) -> str:
        from vstatics.core.writers import result_csv

        if file is None:
            return result_csv.write(results, raw=style.raw)
        return result_csv.rows(file, results, raw=style.raw)

    def parquet(file: str | None) -> bytes:
        from vstatics.core.writers import result_parquet

        return result_parquet.rows(file or outcome.file, results)

    def document() -> dict[str, Any]:
        from vstatics.core.writers import result_json

        return result_json.document(results)

    def lay_out(document: dict[str, Any]) -> str:
        from vstatics.core.writers import result_json

        return result_json.text(document)

    def grids() -> list[Grid]:
        from vstatics.core.tables.result_tables import of_messages, of_results

        messages = of_messages(results)
        return [*of_results(results), *[messages] * bool(messages.rows)]

    titles = [results.case.name or outcome.file]
    by_format: dict[str, Callable[[str | None], str | bytes]]
    by_format = {"listing": listing, "csv": csv, "parquet": parquet}
    return texts.CaseOutput(titles, by_format, grids, document, lay_out)


def _as_published(outcome: CalculatedCase, results: Results, style: TextStyle) -> texts.CaseOutput:
    """Return the output of a case in the format `source`, the listing of Visual-Statics.

    A warning is added if the conventions of the listing change an efficiency.

    Raises
    ------
    ReadError
        If the listing has no field for a part of the case.
    """
    from vstatics.core.writers import source_listing
    from vstatics.core.writers.listing import LISTING_DECIMALS

    try:
        published = source_listing.published_results(results)
    except CaseError as error:
        raise outcome.located(error) from None
    digits = style.digits or LISTING_DECIMALS
    text = source_listing.write(published, digits, own_tables=style.own_tables)
    changed = source_listing.changed_efficiencies(results, published)
    problems = outcome.located(CaseError(changed)).problems
    return texts.CaseOutput([], {"source": lambda _: text}, problems=problems)


def _frame() -> texts.Frame:
    from vstatics.core.writers import result_csv

    head, tail = result_csv.head(several=True), result_csv.tail(several=True)
    return texts.Frame(head, "", tail, head + tail)


def _pretty(
    names: list[str],
    settings: CaseOptions,
    wanted: OutputOptions,
    inputs: list[str],
    *,
    several: bool,
) -> int:
    """Print a table of the gears of each case for people, and return the exit status."""
    from rich.console import ConsoleDimensions

    from vstatics.core.cli.shared.console import SafeConsole, trimmed
    from vstatics.core.summary.pretty import ASCII, DOTS, view

    to = wanted._replace(formats=("text",)).destination(inputs)
    language = to.language
    if to.is_folder:
        raise click.UsageError(f"all cases have one output: expected -o FILE, not {to.output}")
    to_stdout = to.output in (None, STDOUT)
    console = SafeConsole(highlight=False) if to_stdout else SafeConsole(highlight=False, **PLAIN)
    # A width of 0 means unknown. If TERM is dumb, rich ignores COLUMNS unless a height is set.
    console.size = ConsoleDimensions(console.width or 80, console.height)
    marks = ASCII if to_stdout and console.options.ascii_only else DOTS
    failed, views = False, list[str]()
    for outcome in calculate(names, settings):
        failed |= outcome.failed
        if outcome.results is None:
            continue
        with console.capture() as captured, speaking(language):
            console.print(view(outcome.results, marks, wanted.style.digits, console.width))
        head = "\n" * bool(views) + f"==> {printable(outcome.file)} <==\n" if several else ""
        views.append(head + trimmed(captured.get()))
        if to_stdout:
            files.write_coloured(views[-1])
    if views and not to_stdout:
        files.write_output("".join(views), to.output)
    return FAILED if failed else DONE
