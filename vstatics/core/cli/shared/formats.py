"""Where a command writes to and in which format: told by -f and the suffix of -o."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from functools import partial
from typing import Literal, NamedTuple

import click

from vstatics.core.cli.shared import files
from vstatics.core.cli.shared.options import Command, gathered, refuse
from vstatics.core.errors import Problem, ReadError
from vstatics.core.extras import missing
from vstatics.core.jobs.files import STDOUT, is_stream, missing_folder
from vstatics.core.tables.suffixes import SUFFIXES, format_of, known, mismatch, suffix_of
from vstatics.core.texts import Language

TABLES = ("text", "json", "jsonl", "csv", "markdown", "latex", "xlsx")
"""The formats of a command with tables."""
READ_BY_PEOPLE = ("text", "listing", "markdown", "latex", "html")
"""They have words in the language that is asked for."""
FULL = ("json", "jsonl", "csv", "parquet")
"""They have all digits of a number."""
STREAMS = ("jsonl", "parquet")
"""All cases are one file, whatever their number; a run that was stopped can go on."""


class TextStyle(NamedTuple):
    """How texts are laid out."""

    lang: Language | Literal["source"] = "en"
    """"source" is an alias of the format of that name, which `run` resolves."""
    digits: int | None = None
    """After the point; None: those that suit a number."""
    raw: bool = False
    """Whether texts in CSV stay as they are."""
    own_tables: bool = False
    """Whether the tables that the source does not have follow the published listing."""


class Destination(NamedTuple):
    """Where results go."""

    form: str
    output: str | None
    style: TextStyle
    is_folder: bool = False

    @property
    def suffix(self) -> str:
        """Of a file in a directory."""
        return SUFFIXES[self.form][0]

    @property
    def language(self) -> Language:
        """Of the words; what programs read stays English."""
        lang = self.style.lang
        return lang if lang != "source" and self.form in READ_BY_PEOPLE else "en"

    @property
    def is_text(self) -> bool:
        """Whether people read it as it is."""
        return self.form in ("text", "listing", "source")


class OutputOptions(NamedTuple):
    """What -f, -o, --digits and --raw say."""

    formats: Sequence[str]
    """Which the command has; without a word it is the first."""
    form: str | None
    output: str | None
    style: TextStyle

    def destination(
        self, inputs: Sequence[str], *, several: bool = False, together: bool = False
    ) -> Destination:
        """Where results go, and in which format; refused before anything is calculated.

        Parameters
        ----------
        inputs : sequence of str
            Files that are read, so nothing may be written over them.
        several : bool
            Whether there are several cases. To a name without suffix they go into a directory.
        together : bool
            Whether they give one text even there, but in a directory that is there or is meant.

        Raises
        ------
        UsageError
            If the command has no such format, two are told, or an input would be overwritten.
        ReadError
            If a package is missing that the format needs, or the directory of a file.
        """
        files.spare(inputs, self.output)
        output, form = self.output, self.form
        if output is None or output == STDOUT:
            return self._checked(form, is_folder=False)
        if output.endswith("/") or os.path.isdir(output):  # noqa: PTH112
            return self._checked(form, is_folder=True)
        suffix = suffix_of(output)
        told = format_of(output, self.formats) if suffix else self.formats[0]
        if told is None and not is_stream(output):
            raise click.UsageError(f"{output}: {self._expected(several=several)}")
        if told and (message := mismatch(form, output)):
            raise click.UsageError(f"-f {message}")
        if form is None and suffix:
            form = told
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
            (style.raw and chosen != "csv", "--raw is for CSV"),
            (
                style.own_tables and chosen != "source",
                "--own-tables is for -f source: other formats have these tables",
            ),
        )
        needed = {"xlsx": "XLSX", "parquet": "Parquet"}.get(chosen)
        if needed and (message := missing(chosen, needed)):
            raise ReadError([Problem("E014", message)])
        return Destination(chosen, self.output, self.style, is_folder)

    def _expected(self, *, several: bool) -> str:
        expected = " ".join(known(self.formats))
        plain = ", or none for text" * (self.formats[0] in ("text", "listing"))
        folder = "; a directory ends with /" * several
        return f"no format has this suffix here: expected {expected}{plain}{folder}"


def each_by_itself(
    output: str, cases: Sequence[str], formats: Sequence[str], what: str, *, most: int = 1
) -> Destination:
    """Where one text or picture of each case goes: several of them need a directory.

    Parameters
    ----------
    most : int
        So many may be on one.

    Raises
    ------
    UsageError
    """
    several = len(cases) > 1
    to = OutputOptions(formats, None, output, TextStyle()).destination(cases, several=several)
    if len(cases) > most and not to.is_folder:
        folder = os.path.splitext(output)[0]  # noqa: PTH122
        number = "one case" if most == 1 else "one case or two"
        message = f"{what} is of {number}: expected a directory for several ({folder}/)"
        raise click.UsageError(message)
    return to


raw = click.option(
    "--raw", is_flag=True, help="CSV without an apostrophe before = + - @ that begin a text."
)
digits = click.option(
    "--digits",
    type=click.IntRange(1, 15),
    metavar="N",
    help="Digits after the point, in what people read; JSON and CSV have all.",
)


def options(*formats: str, says: str = "Format of the output") -> Callable[[Command], Command]:
    """The options -f, -o, --digits and --raw; the command gets `wanted`."""
    return gathered(
        "wanted",
        partial(OutputOptions, formats),
        click.option(
            "-f",
            "--format",
            "form",
            type=click.Choice(formats),
            help=f"{says}; else told by the suffix of -o, else {formats[0]}.",
        ),
        click.option(
            "-o",
            "--output",
            type=click.Path(),
            help="Write to this file, whole or not at all; several cases to this directory, "
            "or with a suffix to one file.",
        ),
        gathered("style", TextStyle, digits, raw),
    )
