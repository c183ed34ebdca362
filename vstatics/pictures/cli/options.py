"""Options of `vstatics plot`, limited to the kinds of pictures that are installed."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import NamedTuple

import click

from vstatics.core.annexes import picture_kinds
from vstatics.core.cli.shared import cases as arguments
from vstatics.core.cli.shared.options import Option, RenamedOption, gathered, under
from vstatics.core.cli.shared.values import numbers, shown_speeds, told, value
from vstatics.core.texts import Language
from vstatics.pictures.drawing.lengths import page_width
from vstatics.pictures.drawing.style import PAGE_WIDTH, Excitation, PictureFiles, Style

_PLAIN = (
    *("merge", "wheels", "orders", "at", "speed", "torque"),
    *("levels", "duty", "classes", "limits", "best_gear"),
)
"""Names of options that only some kinds of pictures have, equal to the names of the arguments."""


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
    levels: int | list[float] | None = None
    duty: str = ""
    classes: str | None = None
    torque: str = ""
    limits: str = ""
    best_gear: bool = False
    out: str = ""
    orders: list[float] | None = None
    speed: tuple[float, float] | None = None
    at: str = ""
    width: float = PAGE_WIDTH
    dark: bool = False

    @property
    def of_kinds(self) -> dict[str, object]:
        """Values of options that only some kinds of pictures have, by the name of the option."""
        return {
            **{name: getattr(self, name) for name in _PLAIN},
            "order": self.order != "free",
            "ratios": self.ratios,
            "out": self.out,
            "gear": self.gears,
        }

    @property
    def columns(self) -> tuple[str, tuple[str, ...], str, str] | None:
        """Columns of a sweep file for the axes, if the user names any column."""
        named = (self.x, self.y, self.z, self.by)
        return named if any(named) else None

    @property
    def files(self) -> PictureFiles:
        """Files that the picture needs in addition to the case."""
        return PictureFiles(self.duty, self.classes or PictureFiles().classes, self.torque)

    def style(self, lang: Language, height: float) -> Style:
        """Return the style of the picture for pages of a given height [pt]."""
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


def _levels(text: str) -> int | list[float]:
    """Parse the number of contour levels, or a list of levels.

    Raises
    ------
    ValueError
    """
    if text.strip().isdecimal():
        return int(text[:9])
    return numbers("a number of levels, or a list such as 0.9,0.95", -math.inf)(text)


def _of_kinds(name: str, *options: Option) -> Iterator[Option]:
    """Yield options if any installed kind of picture has the option."""
    if any(name in kind.options for kind in picture_kinds().values()):
        yield from options


_PICTURE = "Picture"
_KINDS = "Options of some kinds"
_COLUMNS = "Columns of a sweep"

options = gathered(
    "asked",
    AskedPicture,
    under(
        _PICTURE,
        click.option(
            "-k",
            "--kind",
            type=click.Choice([*picture_kinds()]),
            metavar="KIND",
            required=True,
            help="Kind of picture, from the list above.",
        ),
        arguments.some_gears,
        click.option(
            "--width",
            metavar="LENGTH",
            default="170mm",
            show_default=True,
            callback=value(told(page_width)),
            help="Width of a page from 80mm to 1200mm, in mm, cm, in or pt.",
        ),
        click.option("--dark", is_flag=True, help="Draw light lines on a dark background."),
    ),
    arguments.required_output(
        "Picture of one case, or of two cases to compare: SVG, PNG or PDF by the suffix. `-` "
        "writes one SVG page of any height to standard output. For several cases, a directory."
    ),
    under(
        _KINDS,
        click.option(
            "--teeth",
            "wheels",
            cls=RenamedOption,
            former=["--wheels"],
            is_flag=True,
            help="Label stick diagrams with names and tooth numbers of the toothed gears.",
        ),
        click.option(
            "--order",
            type=click.Choice(["free", "as-given"]),
            default="free",
            help="Order of the gear sets in stick diagrams: with few crossings (free), or as in "
            "the case (as-given). The title reports if no layout in this order is found.",
        ),
        click.option(
            "--merge",
            is_flag=True,
            help="For --kind lever: draw two gear sets with two common links as one lever.",
        ),
        click.option(
            "--ratios",
            metavar="U,...",
            callback=value(numbers("ratios of gears such as 2.6,1.7,-4", -math.inf)),
            help="Gear ratios for a kinematic plan (--kind plan) that is drawn without a case.",
        ),
        *_of_kinds(
            "out",
            click.option(
                "--out",
                metavar="LIST",
                default="",
                help="For --kind shift: additional panels, such as heat; see --out of `vstatics "
                "simulate --help`.",
            ),
        ),
        *_of_kinds(
            "orders",
            click.option(
                "--orders",
                metavar="N,...",
                callback=value(numbers("an order above 0", math.ulp(0.0)), "--orders"),
                help="For --kind campbell or response: excitation orders, as multiples of the "
                "speed of the input, or in a response of the --at link.  "
                "[default: orders of the engine]",
            ),
        ),
        *_of_kinds(
            "duty",
            click.option(
                "--duty",
                metavar="FILE",
                default="",
                help="CSV file of a duty cycle, or of the time steps of a driving cycle: for "
                "--kind spectrum, or as points in a --kind map over load.speed and load.torque.",
            ),
        ),
        *_of_kinds(
            "classes",
            click.option(
                "--spectrum",
                "classes",
                metavar="CLASSES",
                help="For --kind spectrum: classes of torque, as in `vstatics summary`.  "
                "[default: 10]",
            ),
        ),
        *_of_kinds(
            "torque",
            click.option(
                "--torque",
                metavar="FILE",
                default="",
                help="For --kind response: CSV file with the exciting torque of each order, as in "
                "`vstatics torsion response`.  [default: 1 N*m for each order]",
            ),
        ),
        *_of_kinds(
            "levels",
            click.option(
                "--levels",
                metavar="LEVELS",
                callback=value(_levels),
                help="For --kind map: approximate number of contour levels, such as 10, or a "
                "list such as 0.9,0.95,0.97.",
            ),
            click.option(
                "--limits",
                metavar="CASE",
                default="",
                help="For --kind map over load.speed and load.torque: draw the full-load curve of "
                "the vehicle in this case.",
            ),
            click.option(
                "--best-gear",
                is_flag=True,
                help="For --kind map of a sweep --by gear: mark the region in which each gear has "
                "the largest efficiency, or the largest value of --z.",
            ),
        ),
        *_of_kinds(
            "speed",
            click.option(
                "--speed",
                metavar="A:B",
                callback=value(told(shown_speeds), "--speed"),
                help="For --kind campbell or response: range of speeds, in rpm or with units.",
            ),
        ),
        *_of_kinds(
            "at",
            click.option(
                "--at",
                metavar="LINK",
                default="",
                help="For --kind response: link on which the torque acts, and whose amplitude is "
                "drawn.  [default: input]",
            ),
        ),
    ),
    under(
        _COLUMNS,
        *_of_kinds(
            "columns",
            click.option(
                "--x", metavar="COLUMN", default="", help="Column of the horizontal axis."
            ),
            click.option(
                "--y",
                metavar="COLUMN",
                multiple=True,
                help="For --kind map: column of the vertical axis. For --kind curves or histogram: "
                "columns to draw. Repeatable.",
            ),
            click.option(
                "--z", metavar="COLUMN", default="", help="For --kind map: column of the contours."
            ),
            click.option(
                "--by",
                metavar="COLUMN",
                default="",
                help="Column, or `gear`: each of its values gets a line, a map or a histogram.",
            ),
        ),
    ),
)
"""Decorator with all options of the command, which receives the arguments `asked` and `output`."""
