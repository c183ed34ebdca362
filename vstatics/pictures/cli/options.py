"""Options of `vstatics plot`, limited to the kinds of pictures that are installed."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

import click

from vstatics.core.annexes import picture_kinds
from vstatics.core.cli.shared import cases as arguments
from vstatics.core.cli.shared.options import Option, gathered
from vstatics.core.cli.shared.values import numbers, shown_speeds, told, value
from vstatics.core.texts import Language
from vstatics.pictures.drawing.lengths import page_width
from vstatics.pictures.drawing.style import PAGE_WIDTH, Excitation, Style


class AskedPicture(NamedTuple):
    """Options of a picture on the command line."""

    kind: str
    gears: tuple[str, ...] = ()
    wheels: bool = False
    merge: bool = False
    order: str = "free"
    ratios: list[float] | None = None
    x: str = ""
    y: tuple[str, ...] = ()
    z: str = ""
    by: str = ""
    out: str = ""
    orders: list[float] | None = None
    speed: tuple[float, float] | None = None
    at: str = ""
    width: float = PAGE_WIDTH
    dark: bool = False

    @property
    def of_kinds(self) -> dict[str, object]:
        """Values, by name, of the options that only some kinds of pictures have."""
        return {
            **{name: getattr(self, name) for name in ("merge", "wheels", "orders", "at", "speed")},
            "order": self.order != "free",
            "ratios": self.ratios,
            "out": self.out,
            "gear": self.gears,
        }

    @property
    def columns(self) -> tuple[str, tuple[str, ...], str, str] | None:
        """Columns of a written sweep that the user names; None if no column is named."""
        named = (self.x, self.y, self.z, self.by)
        return named if any(named) else None

    def style(self, lang: Language, height: float) -> Style:
        """Return the style of the picture on pages of a height [pt]."""
        return Style(
            lang,
            self.dark,
            wheels=self.wheels,
            merged=self.merge,
            width=self.width,
            height=height,
            ordered=self.order == "as-given",
            excited=Excitation(tuple(self.orders or ()), self.at, shown=self.speed),
        )


def _of_kinds(name: str, option: Option) -> Iterator[Option]:
    """Yield an option if a kind of picture has the option."""
    if any(name in kind.options for kind in picture_kinds().values()):
        yield option


options = gathered(
    "asked",
    AskedPicture,
    click.option(
        "-k",
        "--kind",
        type=click.Choice([*picture_kinds()]),
        metavar="KIND",
        required=True,
        help="What is drawn, one of the above.",
    ),
    arguments.required_output(
        "SVG, PNG or PDF by the suffix; - is standard output, for SVG; two cases go to one sheet, "
        "several to a directory, as SVG. Further pages are FILE-2.svg, FILE-3.svg, or in the same "
        "PDF; - is one page of any height."
    ),
    arguments.some_gears,
    click.option("--wheels", is_flag=True, help="Stick diagrams: names and teeth of wheels."),
    click.option("--merge", is_flag=True, help="Levers: two sets with two common links are one."),
    click.option(
        "--order",
        type=click.Choice(["free", "as-given"]),
        default="free",
        help="Order of the sets in stick diagrams. as-given keeps that of the case, also at the "
        "cost of crossings; if no such layout is found, the title says so.",
    ),
    click.option(
        "--ratios",
        metavar="U,...",
        callback=value(numbers("ratios of gears such as 2.6,1.7,-4", -math.inf)),
        help="Of a plan: of these ratios alone, without a case.",
    ),
    *_of_kinds(
        "columns",
        click.option("--x", metavar="COLUMN", default="", help="Of a sweep: what is across."),
    ),
    *_of_kinds(
        "columns",
        click.option(
            "--y",
            metavar="COLUMN",
            multiple=True,
            help="Of a map what is upward; of curves and histograms the columns that are drawn.",
        ),
    ),
    *_of_kinds(
        "columns",
        click.option(
            "--z", metavar="COLUMN", default="", help="Of a map: the column that has contours."
        ),
    ),
    *_of_kinds(
        "columns",
        click.option(
            "--by",
            metavar="COLUMN",
            default="",
            help="Of a sweep: a map, line or histogram for each value, or gear.",
        ),
    ),
    *_of_kinds(
        "out",
        click.option(
            "--out", metavar="LIST", default="", help="Of a shift: more columns, as of simulate."
        ),
    ),
    *_of_kinds(
        "orders",
        click.option(
            "--orders",
            metavar="N,...",
            callback=value(numbers("an order above 0", math.ulp(0.0)), "--orders"),
            help="Of campbell and response: orders of the speed; else those of the engine.",
        ),
    ),
    *_of_kinds(
        "speed",
        click.option(
            "--speed",
            metavar="A:B",
            callback=value(told(shown_speeds), "--speed"),
            help="Of campbell and response: range of speeds in rpm, or with a unit behind each.",
        ),
    ),
    *_of_kinds(
        "at",
        click.option(
            "--at", metavar="LINK", default="", help="Of a response: the link; else the input."
        ),
    ),
    click.option(
        "--width",
        metavar="LENGTH",
        default="170mm",
        show_default=True,
        callback=value(told(page_width)),
        help="Of a page: 80mm to 1200mm, in mm, cm, in or pt.",
    ),
    click.option("--dark", is_flag=True, help="Light on dark, for a screen."),
)
"""Decorator for all options; a command gets the arguments `asked` and `output`."""
