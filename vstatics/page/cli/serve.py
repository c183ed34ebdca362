"""Command `vstatics serve`: serve the page of a case on loopback, and change its file from it."""

from __future__ import annotations

import asyncio
import contextlib
import gc
import os
import secrets
from functools import cache, partial
from typing import TYPE_CHECKING

import click

from vstatics.core.annexes import module_of_method
from vstatics.core.cli.shared import cases as arguments
from vstatics.core.cli.shared import documents, files, formats
from vstatics.core.cli.shared.cases import CaseOptions, calculate_one
from vstatics.core.cli.shared.exit_status import DONE
from vstatics.core.cli.shared.options import command
from vstatics.core.cli.shared.values import FILE
from vstatics.core.errors import ReadError, of_file
from vstatics.core.extras import higher
from vstatics.core.jobs.stopping import ENDING
from vstatics.core.texts import Language, speaking
from vstatics.page.cli.scenarios import naming_of, run_of

if TYPE_CHECKING:
    from vstatics.page.serve.document_fields import Texts
    from vstatics.page.serve.server import PageServer
    from vstatics.page.serve.states import Calculated

TOKEN_BYTES = 24
"""Number of random bytes in the secret token of the address. Three bytes give four characters."""
MOST_PORT = 65535
GARBAGE = 50_000
"""Number of new objects after which Python collects garbage, about the size of a page state."""


@command
@click.argument("case", type=FILE)
@click.option(
    "--port",
    type=click.IntRange(0, MOST_PORT),
    default=0,
    show_default=True,
    metavar="PORT",
    help="Port on 127.0.0.1; 0 selects a free port.",
)
@click.option("--open", "opens", is_flag=True, help="Open the page in a browser.")
@formats.digits
@arguments.language(arguments.WORDS)
@arguments.settings
def serve_command(
    case: str,
    port: int,
    opens: bool,
    digits: int | None,
    lang: Language,
    settings: CaseOptions,
) -> int:
    """Serve the page of CASE to browsers on this computer until Ctrl-C.

    The page is the page of `vstatics report`. It is updated when you save the case, or a file
    that the case names. Fields and sliders of the page change numbers of the case, and the
    results follow at once. When you save the numbers, only they change in the file. CASE can
    also be a scenario. A deck is shown, but cannot be changed.

    The first line on stdout is the address of the page. Everyone who knows the address can
    change the numbers of the case. No other file is written.

    \b
    Examples:
      vstatics serve gearbox.yaml --open
      vstatics serve gearbox.yaml --port 8000 --lang ru

    Exit status 1: the file does not exist, or the port is in use.
    """
    return serve_page(case, digits, lang, settings, port, opens=opens)


def serve_page(
    case: str,
    digits: int | None,
    lang: Language,
    settings: CaseOptions,
    port: int = 0,
    *,
    opens: bool = False,
) -> int:
    """Serve the page of a case until a signal stops the process.

    Raises
    ------
    ReadError
        If the file does not exist or the port is already in use.
    UsageError
        If the case is read from standard input.
    """
    if case == files.STDIN:
        raise click.UsageError("standard input is not saved again: expected a file")
    # A missing file is an error, but an invalid file is shown on the page.
    files.read_input(case, regular=True)
    from vstatics.page.serve.server import PageServer
    from vstatics.page.serve.states import ShownStates
    from vstatics.page.serve.studio import Studio, StudioProcess

    calculate = partial(calculated, case, settings)
    make = partial(ShownStates, calculate, case, digits)
    studio = StudioProcess(Studio(calculate, digits, lang))
    server = PageServer(make, studio, secrets.token_urlsafe(TOKEN_BYTES))
    try:
        with speaking(lang):
            asyncio.run(_until_stopped(server, port, opens=opens))
    except OSError as error:
        why = os.strerror(error.errno) if error.errno else str(error)
        message = f"port {port} cannot be used: {why}"
        raise ReadError([of_file("E760", "127.0.0.1", message)]) from None
    return DONE


async def _until_stopped(server: PageServer, port: int, *, opens: bool) -> None:
    stop = asyncio.Event()
    loop = asyncio.get_running_loop()
    for signal in ENDING:
        # Windows does not support signal handlers in an event loop.
        with contextlib.suppress(NotImplementedError):
            loop.add_signal_handler(signal, stop.set)

    def ready(address: str) -> None:
        gc.freeze()  # modules are never collected; searching them for garbage delayed some saves
        gc.set_threshold(GARBAGE)
        files.write_output(f"{address}\n", None)
        if opens:
            import webbrowser  # slow to import, because it searches for browsers

            loop.run_in_executor(None, webbrowser.open, address)

    await server.serve(port, ready, stop)


def calculated(file: str, settings: CaseOptions, texts: Texts) -> Calculated:
    """Calculate a case or scenario. `texts` replace the contents of files."""
    from vstatics.core.readers.named.csv_files import noted_files
    from vstatics.page.serve.states import Calculated

    texts_read, file_names = _read(file, texts)
    with noted_files() as tables:
        outcome = calculate_one(
            file,
            settings.on_page._replace(scenarios=True, of_runs=True),
            texts_read,
            regular=True,
        )
    if outcome.results is not None and len(texts_read) < len(file_names):
        return calculated(file, settings, texts)  # the missing file has appeared in the meantime
    return Calculated(
        outcome.results,
        outcome.problems,
        naming_of(outcome),
        texts_read,
        [*file_names, *sorted(tables)],
        cache(partial(run_of, outcome)),  # a run is not calculated before it is shown
        outcome.is_run,
    )


def _read(file: str, texts: Texts) -> tuple[dict[str, bytes], list[str]]:
    """Return the contents of all readable files, scenario first, and the names of all files."""
    texts_read, file_names = {}, [file]
    with contextlib.suppress(ReadError):  # the calculation reports the reason
        texts_read[file] = texts.get(file) or files.read_input(file, regular=True)[0]
        if documents.is_a("scenario", texts_read[file], file) and module_of_method("read_scenario"):
            case = higher("read_scenario")(texts_read[file], file).case_file
            if case:
                file_names.append(case)
                texts_read[case] = texts.get(case) or files.read_input(case, regular=True)[0]
    return texts_read, file_names
