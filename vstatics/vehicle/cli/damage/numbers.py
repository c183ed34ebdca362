"""Options and output of `vstatics damage` commands without a case."""

from __future__ import annotations

import click

from vstatics.core.cli.shared import files, texts
from vstatics.core.cli.shared.exit_status import DONE
from vstatics.core.cli.shared.formats import OutputOptions
from vstatics.core.cli.shared.one_case import one_text
from vstatics.core.cli.shared.options import Option
from vstatics.core.cli.shared.values import above_0, told, value
from vstatics.core.tables.answer import Answer, as_json
from vstatics.core.tables.grid import Grid


def number(name: str, text: str, default: float | None = None) -> Option:
    """Return an option for a number above 0, which is required without a default."""
    return click.option(
        f"--{name}",
        type=float,
        required=default is None,
        default=default,
        show_default=default is not None,
        callback=value(above_0),
        metavar="X",
        help=text,
    )


def stress(name: str, text: str) -> Option:
    """Return a required option for a stress, or a distribution of it, with a unit; values in Pa."""

    def read(given: str) -> float:
        from vstatics.core.readers.named.si_units import in_any_unit
        from vstatics.vehicle.damage.scatter import read_scattered

        scattered = told(read_scattered)(given)
        if scattered is not None:
            return scattered
        return above_0(told(lambda text: in_any_unit(text, ["stress"]))(given))

    return click.option(
        f"--{name}", required=True, callback=value(read), metavar="STRESS", help=text
    )


def write(wanted: OutputOptions, answer: Answer, grid: Grid) -> int:
    """Write an answer, and return the exit status."""
    to = one_text(wanted, [])
    json = dict.fromkeys(("json", "jsonl"), lambda _: as_json(answer, to.form))
    shown = texts.CaseOutput([], json, lambda: [grid])
    files.write_pages(texts.alone("", shown, to), to.output)
    return DONE
