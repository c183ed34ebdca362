"""Options of `vstatics synth box`, and the request that they define."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, NamedTuple

import click

from vstatics.core.cli.shared.cases import RequiredUnless
from vstatics.core.cli.shared.options import Option, gathered, refuse
from vstatics.core.cli.shared.values import (
    each,
    named,
    pair,
    separated,
    told,
    value,
    wrong_use,
    wrong_value,
)
from vstatics.core.errors import plural, spoken, typed_number
from vstatics.core.readers.named.scalars import number
from vstatics.synthesis.boxes.box import EFFICIENCY, BoxSearch, check_box_search
from vstatics.synthesis.boxes.figures.by_box import LIMITED, PARETO, BoxOrder, no_figure
from vstatics.synthesis.boxes.figures.by_gear import check_search_weights
from vstatics.synthesis.cli.box.modified import free_parts, kept_box_search
from vstatics.synthesis.cli.box.ratios import (
    WantedGears,
    wanted_gears,
    wanted_ratio,
    wanted_tolerances,
)
from vstatics.synthesis.cli.box.sequence import ends, gear_counts, wanted_sequence

if TYPE_CHECKING:
    from vstatics.synthesis.boxes.choice import BoxFilter


class BoxAsked(NamedTuple):
    """Search for boxes, with filter and order of the found boxes."""

    search: BoxSearch
    efficiency: float
    """Basic efficiency of each set, carrier held. [-]"""
    wanted: BoxFilter
    order: BoxOrder
    weights: Mapping[str, float]
    """Weights of forward gears in the mean drag. [-]"""


class WantedFigures(NamedTuple):
    """Options of the filter, whose counts of elements are not yet checked."""

    single: bool
    planar: bool
    brakes: Sequence[str]
    clutches: Sequence[str]
    limits: Mapping[str, float]

    def of_boxes(self, elements: int) -> BoxFilter:
        """Return the filter of boxes with a number of elements.

        Raises
        ------
        BadParameter
        """
        from vstatics.synthesis.boxes.choice import BoxFilter

        read = each(lambda text: _count(text, elements))
        with wrong_value("--brakes"):
            brakes = tuple(sorted({*read(self.brakes)}))
        with wrong_value("--clutches"):
            clutches = tuple(sorted({*read(self.clutches)}))
            _check_sum(elements, brakes, clutches)
        return BoxFilter(self.single, self.planar, brakes, clutches, self.limits)


def _asked(
    search: BoxSearch,
    gears: WantedGears,
    efficiency: float,
    figures: WantedFigures,
    order: BoxOrder,
    weights: Mapping[str, float],
    keep: str | None,
    free: Mapping[str, int],
) -> BoxAsked:
    search = search._replace(**gears._asdict())
    refuse((free and keep is None, "--free says what of --keep CASE may be missing: expected it"))
    if keep is not None:
        search = kept_box_search(search, keep, free)
    names = ("ratios", "gears", "spread", "steps", *BoxSearch._fields)
    with wrong_use((*names, *BoxOrder._fields, "weights")):
        check_box_search(search)
        order.check()
        check_search_weights(search, weights)
    wanted = figures.of_boxes(search.elements)
    return BoxAsked(wanted.narrowed(search), efficiency, wanted, order, weights)


def _names(texts: Sequence[str]) -> tuple[str, ...]:
    return tuple(dict.fromkeys(separated(texts)))


def _efficiency(given: float) -> float:
    if not 0 < given <= 1:
        raise ValueError(f"read {given:g}, expected a number above 0, up to 1")
    return given


def _limits(texts: Sequence[str]) -> dict[str, float]:
    """Read the largest values of figures, and refuse unknown figures and NaN."""
    limits = named("FIGURE=X", number)(texts)
    for name, most in limits.items():
        if name not in LIMITED:
            raise ValueError(no_figure(name, LIMITED))
        if math.isnan(most):
            raise ValueError(f"{name}: read {most}, expected a number")
    return limits


def _count(text: str, most: int) -> int:
    if text.strip("0") == "" and text:
        return 0
    count = typed_number(text, most)
    if count is None:
        raise ValueError(f"expected a number from 0 to {most}, as there are so many elements")
    return count


def _check_sum(elements: int, brakes: Sequence[int], clutches: Sequence[int]) -> None:
    """Refuse numbers of brakes and clutches whose sum cannot be the number of elements."""
    sums = {brake_count + clutch_count for brake_count in brakes for clutch_count in clutches}
    if sums and elements not in sums:
        noun = plural("brake", brakes[-1])
        there = f"{spoken(map(str, brakes), 'or')} {noun}"
        message = f"read {spoken(map(str, clutches), 'or')}, but with {there} these are not"
        raise ValueError(f"{message} {elements} elements together")


def _count_option(name: str, metavar: str, text: str) -> Option:
    """Return the option of a count, required unless --keep gives the case."""
    return click.option(
        name,
        type=int,
        required=True,
        cls=RequiredUnless,
        unless="keep",
        metavar=metavar,
        help=text,
    )


def _more_option(name: str, text: str) -> Option:
    return click.option(name, type=int, default=0, metavar="K", help=text)


def _own_option(port: str) -> Option:
    text = f"The {port} is a shaft that only clutches join to the sets."
    return click.option(f"--own-{port}", is_flag=True, help=text)


_TOLERANCE: float = BoxSearch._field_defaults["tolerance"]

options = gathered(
    "asked",
    _asked,
    gathered(
        "search",
        partial(BoxSearch, targets=()),
        _count_option("--sets", "N", "Planetary sets."),
        _count_option("--elements", "M", "Brakes and clutches in all."),
        _count_option("--engaged", "E", "So many of them are engaged in every gear."),
        gathered(
            "gears",
            wanted_gears,
            click.option(
                "--ratios",
                "targets",
                multiple=True,
                required=True,
                cls=RequiredUnless,
                unless="gears_wanted",
                callback=value(each(wanted_ratio), "--ratios"),
                metavar="I,...",
                help="Of each gear a ratio or a range, below 0 backward: 5.8:6.2,1,-4:-2.5.",
            ),
            click.option(
                "--tolerance",
                multiple=True,
                default=[str(_TOLERANCE)],
                callback=value(wanted_tolerances(_TOLERANCE), "--tolerance"),
                metavar="T,...",
                help="A box is found where all |ln(i/wanted)| can be no more: .01,1=.04,R=.2. "
                " [default: .01]",
            ),
        ),
        gathered(
            "sequence",
            wanted_sequence,
            click.option(
                "--gears",
                "gears_wanted",
                is_eager=True,
                callback=value(gear_counts, "--gears"),
                metavar="A:B",
                help="So many forward gears besides --ratios, whatever their ratios are.",
            ),
            click.option(
                "--spread",
                callback=value(ends, "--spread"),
                metavar="LOW:HIGH",
                help="Of --gears the first ratio over the last.",
            ),
            click.option(
                "--steps",
                callback=value(ends, "--steps"),
                metavar="LOW:HIGH",
                help="Of --gears each ratio over the next one.",
            ),
            click.option("--falling", is_flag=True, help="No step is larger than that below it."),
        ),
        click.option(
            "--bounds",
            default="1.4:5",
            show_default=True,
            callback=value(told(partial(pair, example="1.4:5")), "--bounds"),
            metavar="LOW:HIGH",
            help="Ring teeth/sun teeth of each set.",
        ),
        _more_option("--meshed", "So many sets have planets that mesh with each other."),
        _own_option("input"),
        _own_option("output"),
        _more_option(
            "--shafts",
            "So many further shafts no set has a member on; three elements or more join each.",
        ),
        _more_option("--fixed", "So many members of sets are held for good."),
    ),
    click.option(
        "--keep",
        type=click.Path(),
        is_eager=True,
        metavar="CASE",
        help="Boxes with the scheme, kinds of sets, ports and elements of a case.",
    ),
    click.option(
        "--free",
        multiple=True,
        callback=value(free_parts, "--free"),
        metavar="elements=N",
        help="So many of its elements may be missing.",
    ),
    click.option(
        "--efficiency",
        type=float,
        default=EFFICIENCY,
        show_default=True,
        callback=value(_efficiency, "--efficiency"),
        metavar="ETA",
        help="Of each set with its carrier held.",
    ),
    gathered(
        "figures",
        WantedFigures,
        click.option("--single", is_flag=True, help="One element changes between neighbours."),
        click.option("--planar", is_flag=True, help="No shafts need cross."),
        click.option("--brakes", multiple=True, metavar="N,..", help="So many brakes: 2, or 2,3."),
        click.option("--clutches", multiple=True, metavar="N,..", help="So many clutches."),
        click.option(
            "--limit",
            "limits",
            multiple=True,
            callback=value(_limits, "--limit"),
            metavar="FIGURE=X,...",
            help=f"No larger {spoken(LIMITED, 'or')}, such as loss=.05,torque=4.",
        ),
    ),
    gathered(
        "order",
        BoxOrder,
        click.option(
            "--sort",
            multiple=True,
            callback=value(_names, "--sort"),
            metavar="FIGURE,...",
            help="Those with less of it stand first.",
        ),
        click.option(
            "--pareto",
            multiple=True,
            default=PARETO,
            callback=value(_names, "--pareto"),
            metavar="FIGURE,...",
            help=f"The figures of the Pareto list: {spoken(PARETO, 'and')} when not given.",
        ),
    ),
    click.option(
        "--weights",
        multiple=True,
        callback=value(named("GEAR=WEIGHT", number), "--weights"),
        metavar="GEAR=WEIGHT,...",
        help="Of forward gears in the mean of the drag, such as 1=3; else 1.",
    ),
)
"""Options of search, filter and order, combined into the argument `asked` of the command."""
