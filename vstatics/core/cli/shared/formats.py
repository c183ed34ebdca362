"""Output file and format of a command, from -f and the suffix of -o."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from functools import partial
from typing import Literal

import click

from vstatics.core.annexes import picture_kind_of
from vstatics.core.cli.shared import files
from vstatics.core.cli.shared.options import OUTPUT, Command, gathered, refuse, under
from vstatics.core.cli.shared.values import FILE
from vstatics.core.errors import ReadError
from vstatics.core.extras import missing
from vstatics.core.jobs.files import STDOUT, is_stream, missing_folder
from vstatics.core.start import NamedTuple
from vstatics.core.tables.file_suffixes import SUFFIXES, format_of, known, mismatch, suffix_of
from vstatics.core.texts import Language

TABLES = ("text", "json", "jsonl", "csv", "markdown", "latex", "xlsx")
"""Formats of a command with tables."""
READ_BY_PEOPLE = ("text", "listing", "markdown", "latex", "html")
"""Formats for people, with words in the language of the output."""
PICTURES = ("svg", "png", "pdf")
"""Formats of pictures."""
FULL = ("json", "jsonl", "csv", "parquet")
"""Formats with all digits of a number."""
STREAMS = ("jsonl", "parquet")
"""Formats with all cases in a single file, which --resume can continue."""


def hint_of_pictures(file: str) -> str:
    """Return a hint to `plot` for a file that has the suffix of a picture, else an empty text."""
    if suffix_of(file) not in known(PICTURES):
        return ""
    context = click.get_current_context(silent=True)
    kind = picture_kind_of(context.command_path.split() if context else ())
    return f"; `vstatics plot{f' --kind {kind}' * bool(kind)}` draws pictures"


class TextStyle(NamedTuple):
    """Style of texts."""

    lang: Language | Literal["source"] = "en"
    """Language of the words. The command `run` converts the alias "source" to a format."""
    digits: int | None = None
    """Number of decimals; None for a suitable number for each value."""
    raw: bool = False
    """True to omit the apostrophes that keep spreadsheets from evaluating texts as formulas."""
    own_tables: bool = False
    """True to append the additional tables of vstatics to a published listing."""


class Destination(NamedTuple):
    """Output file and format of a command."""

    form: str
    output: str | None
    style: TextStyle
    is_folder: bool = False

    @property
    def suffix(self) -> str:
        """Suffix of files in the format."""
        return SUFFIXES[self.form][0]

    @property
    def language(self) -> Language:
        """Language of the words, which is English in formats for programs."""
        lang = self.style.lang
        return lang if lang != "source" and self.form in READ_BY_PEOPLE else "en"

    @property
    def is_text(self) -> bool:
        """True if people read the format directly."""
        return self.form in ("text", "listing", "source")


class OutputOptions(NamedTuple):
    """Values of -f, -o, --digits and --raw."""

    formats: Sequence[str]
    """Formats of the command, default first."""
    form: str | None
    output: str | None
    style: TextStyle

    def destination(
        self, inputs: Sequence[str], *, several: bool = False, together: bool = False
    ) -> Destination:
        """Return the output and its format, which are checked before any calculation.

        Parameters
        ----------
        inputs : sequence of str
            Input files, which no output may overwrite.
        several : bool
            True if there are several cases. An output without suffix is then a directory.
        together : bool
            True if the output of several cases is a common text (unless it is a directory).

        Raises
        ------
        UsageError
            If the format is unknown or contradicts the suffix, or an input would be overwritten.
        ReadError
            If a package of the format, or the directory of the file, is missing.
        """
        files.spare(inputs, self.output)
        output, form = self.output, self.form
        if output is None or output == STDOUT:
            return self._checked(form, is_folder=False)
        if output.endswith("/") or os.path.isdir(output):  # noqa: PTH112
            return self._checked(form, is_folder=True)
        suffix = suffix_of(output)
        form_of_suffix = format_of(output, self.formats) if suffix else self.formats[0]
        if form_of_suffix is None and not is_stream(output):
            expected = " ".join(known(self.formats))
            plain = ", or none for text" if self.formats[0] in ("text", "listing") else ""
            folder = "; a directory ends with /" if several else ""
            message = f"no format has this suffix here: expected {expected}{plain}{folder}"
            raise click.UsageError(f"{output}: {message}{hint_of_pictures(output)}")
        if form_of_suffix and (message := mismatch(form, output)):
            raise click.UsageError(f"-f {message}")
        if form is None and suffix:
            form = form_of_suffix
        is_folder = several and not (suffix or together or form in STREAMS or is_stream(output))
        if is_folder and os.path.exists(output):  # noqa: PTH110
            message = f"several cases give a result each, and {output} is a file"
            raise click.UsageError(f"{message}: expected a directory, or a name with a suffix")
        if not is_folder and (problem := missing_folder(output)):
            raise ReadError([problem])
        return self._checked(form, is_folder=is_folder)

    def _checked(self, form: str | None, *, is_folder: bool) -> Destination:
        chosen = form or self.formats[0]
        style = self.style
        all_digits = f"--digits does not apply to {chosen}, which has all digits"
        refuse(
            (
                is_folder and chosen in STREAMS,
                f"{chosen} is one stream: expected -o FILE, not {self.output}",
            ),
            (style.digits is not None and chosen in FULL, all_digits),
            (style.raw and chosen != "csv", "--raw applies to CSV only"),
            (
                style.own_tables and chosen != "source",
                "--own-tables applies to -f source only: other formats always have these tables",
            ),
        )
        needed = {"xlsx": "XLSX", "parquet": "Parquet"}.get(chosen)
        if needed and (message := missing(chosen, needed)):
            raise ReadError("E014", message)
        return Destination(chosen, self.output, self.style, is_folder)


def each_by_itself(
    output: str, cases: Sequence[str], formats: Sequence[str], what: str
) -> Destination:
    """Return the destination of a page or picture. More than two cases need a directory.

    Raises
    ------
    UsageError
    """
    several = len(cases) > 1
    to = OutputOptions(formats, None, output, TextStyle()).destination(cases, several=several)
    if len(cases) > 2 and not to.is_folder:
        folder = os.path.splitext(output)[0]  # noqa: PTH122
        message = f"{what} shows one case or two: for more cases give a directory ({folder}/)"
        raise click.UsageError(message)
    return to


raw = under(
    OUTPUT,
    click.option(
        "--raw",
        is_flag=True,
        help="Omit the apostrophe in CSV that keeps a spreadsheet from reading text as a formula.",
    ),
)
digits = under(
    OUTPUT,
    click.option(
        "--digits",
        type=click.IntRange(1, 15),
        metavar="N",
        help="Number of decimals in text; JSON and CSV have all digits.  "
        "[default: depends on the value]",
    ),
)
WHOLE_OUTPUT = "Output file, written completely or not at all."
"""Help text of the option for an output file."""
OF_SEVERAL_CASES = (
    f"{WHOLE_OUTPUT} With several cases: a directory, or one file if the name has a suffix."
)
"""Help text of the option -o of commands for several cases."""


class FormatChoice(click.Choice[str]):
    """Choice of a format by its name or one of its suffixes, such as markdown or md."""

    def convert(self, value: str, param: click.Parameter | None, ctx: click.Context | None) -> str:
        """Return the name of the format.

        >>> FormatChoice(TABLES).convert("md", None, None)
        'markdown'
        """
        return super().convert(format_of(f"a.{value}", self.choices) or value, param, ctx)


def options(
    *formats: str, says: str = "Format of the output", output_help: str = WHOLE_OUTPUT
) -> Callable[[Command], Command]:
    """Return a decorator that adds -f, -o, --digits and --raw to a command (as `wanted`)."""
    return gathered(
        "wanted",
        partial(OutputOptions, formats),
        under(
            OUTPUT,
            click.option(
                "-f",
                "--format",
                "form",
                type=FormatChoice(formats),
                help=f"{says}.  [default: by the suffix of -o, else {formats[0]}]",
            ),
            click.option("-o", "--output", type=FILE, help=output_help),
            gathered("style", TextStyle, digits, raw),
        ),
    )
