"""Options of `vstatics synth box`, and the request that they define."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, NamedTuple

import click

from vstatics.core.cli.shared.cases import RequiredUnless
from vstatics.core.cli.shared.options import Option, RenamedOption, gathered, refuse, under
from vstatics.core.cli.shared.values import (
    FILE,
    each,
    named,
    separated,
    told,
    value,
    wrong_value,
)
from vstatics.core.errors import plural, spoken, typed_number
from vstatics.core.readers.named.scalars import number
from vstatics.synthesis.boxes.box import EFFICIENCY, BoxSearch, check_box_search
from vstatics.synthesis.boxes.figures.by_box import LIMITED, PARETO, BoxOrder, no_figure
from vstatics.synthesis.boxes.figures.by_gear import check_search_weights
from vstatics.synthesis.cli.box.modified import SPELLED, free_parts, kept_box_search
from vstatics.synthesis.cli.box.ratios import (
    WantedGears,
    wanted_gears,
    wanted_ratio,
    wanted_tolerances,
)
from vstatics.synthesis.cli.box.sequence import ends, gear_counts, wanted_sequence
from vstatics.synthesis.cli.values import pair, wrong_use

if TYPE_CHECKING:
    from vstatics.synthesis.boxes.choice import BoxFilter


class BoxAsked(NamedTuple):
    """Search for gearboxes, with filter and order of the found gearboxes."""

    search: BoxSearch
    efficiency: float
    """Basic efficiency of each gear set (carrier held). [-]"""
    wanted: BoxFilter
    order: BoxOrder
    weights: Mapping[str, float]
    """Weights of forward gears in the mean drag, by the name of the gear. [-]"""


class WantedFigures(NamedTuple):
    """Options of the filter, before the counts of brakes and clutches are checked."""

    single: bool
    planar: bool
    brakes: Sequence[str]
    clutches: Sequence[str]
    limits: Mapping[str, float]

    def of_boxes(self, elements: int) -> BoxFilter:
        """Return the filter of gearboxes with a number of shift elements.

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
    refuse((free and keep is None, "--free applies to the case of --keep: expected --keep CASE"))
    if keep is not None:
        search = kept_box_search(search, keep, free)
    names = ("ratios", "gears", "spread", "steps", *BoxSearch._fields)
    with wrong_use((*names, *BoxOrder._fields, "weights"), SPELLED):
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
    """Read upper limits of figures, and refuse unknown figures and NaN."""
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
        raise ValueError(f"expected a number from 0 to {most}, the number of shift elements")
    return count


def _check_sum(elements: int, brakes: Sequence[int], clutches: Sequence[int]) -> None:
    """Refuse numbers of brakes and clutches that cannot add up to the number of shift elements."""
    sums = {brake_count + clutch_count for brake_count in brakes for clutch_count in clutches}
    if sums and elements not in sums:
        noun = plural("brake", brakes[-1])
        there = f"{spoken(map(str, brakes), 'or')} {noun}"
        message = f"read {spoken(map(str, clutches), 'or')}, but with {there} these are not"
        raise ValueError(f"{message} {elements} shift elements together")


def _count_option(name: str, metavar: str, text: str, *former: str) -> Option:
    """Return the option of a count, which is required unless --keep gives a case."""
    return click.option(
        f"--{SPELLED.get(name, name)}",
        name,
        former=former,
        type=int,
        required=True,
        cls=RequiredUnless,
        unless="keep",
        metavar=metavar,
        help=text,
    )


def _more_option(name: str, text: str, *former: str) -> Option:
    return click.option(
        f"--{SPELLED.get(name, name)}",
        name,
        cls=RenamedOption,
        former=former,
        type=int,
        default=0,
        metavar="K",
        help=text,
    )


def _own_option(port: str) -> Option:
    text = f"Make the {port} a separate shaft that only clutches connect to the gear sets."
    return click.option(f"--own-{port}", is_flag=True, help=text)


_TOLERANCE: float = BoxSearch._field_defaults["tolerance"]

_STRUCTURE = "Structure"
_GEARS = "Gears"
_KEPT = "Existing gearbox"
_SELECTION = "Selection and order"

options = gathered(
    "asked",
    _asked,
    gathered(
        "search",
        partial(BoxSearch, targets=()),
        under(
            _STRUCTURE,
            _count_option("sets", "N", "Number of planetary gear sets."),
            _count_option("elements", "M", "Number of brakes and clutches.", "--elements"),
            _count_option("engaged", "E", "Number of shift elements engaged in every gear."),
        ),
        under(
            _GEARS,
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
                    help="Wanted ratio or range of each gear, negative for reverse: "
                    "5.8:6.2,1,-4:-2.5.",
                ),
                click.option(
                    "--tolerance",
                    multiple=True,
                    default=[str(_TOLERANCE)],
                    callback=value(wanted_tolerances(_TOLERANCE), "--tolerance"),
                    metavar="T,...",
                    help="Largest |ln(i/wanted)| of the ratios i of all gears, or of one gear: "
                    "0.01,1=0.04,R=0.2.  "
                    "[default: 0.01]",
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
                    help="Number of further forward gears with any ratio: A, or from A to B.",
                ),
                click.option(
                    "--spread",
                    callback=value(ends, "--spread"),
                    metavar="LOW:HIGH",
                    help="Range of the spread of --gears: the first ratio divided by the last.",
                ),
                click.option(
                    "--step-ratios",
                    "steps",
                    cls=RenamedOption,
                    former=["--steps"],
                    callback=value(ends, "--step-ratios"),
                    metavar="LOW:HIGH",
                    help="Range of the step ratios of --gears: each ratio divided by the next.",
                ),
                click.option(
                    "--falling",
                    is_flag=True,
                    help="Require step ratios that never grow towards the higher gears.",
                ),
            ),
        ),
        under(
            _STRUCTURE,
            click.option(
                "--bounds",
                default="1.4:5",
                show_default=True,
                callback=value(told(partial(pair, example="1.4:5")), "--bounds"),
                metavar="LOW:HIGH",
                help="Range of ring teeth divided by sun teeth of each gear set.",
            ),
            _more_option("meshed", "Number of double-pinion gear sets.", "--meshed"),
            _own_option("input"),
            _own_option("output"),
            _more_option(
                "shafts",
                "Number of further shafts without gear-set members. Each connects three or more "
                "shift elements.",
            ),
            _more_option("fixed", "Number of gear-set members that are always held."),
        ),
    ),
    under(
        _KEPT,
        click.option(
            "--keep",
            type=FILE,
            is_eager=True,
            metavar="CASE",
            help="Case with the structure, gear sets, input, output and shift elements to keep.",
        ),
        click.option(
            "--free",
            multiple=True,
            callback=value(free_parts, "--free"),
            metavar="shift-elements=N",
            help="Largest number of shift elements of the --keep case that a found gearbox may "
            "lack.",
        ),
    ),
    under(
        _STRUCTURE,
        click.option(
            "--efficiency",
            type=float,
            default=EFFICIENCY,
            show_default=True,
            callback=value(_efficiency, "--efficiency"),
            metavar="ETA",
            help="Basic efficiency of each gear set, carrier held.",
        ),
    ),
    under(
        _SELECTION,
        gathered(
            "figures",
            WantedFigures,
            click.option(
                "--single",
                is_flag=True,
                help="Require single transitions between neighbouring gears: one shift element "
                "disengages and one engages.",
            ),
            click.option(
                "--planar", is_flag=True, help="Require a stick diagram without crossing shafts."
            ),
            click.option(
                "--brakes",
                multiple=True,
                metavar="N,..",
                help="Allowed numbers of brakes, such as 2 or 2,3.",
            ),
            click.option(
                "--clutches", multiple=True, metavar="N,..", help="Allowed numbers of clutches."
            ),
            click.option(
                "--limit",
                "limits",
                multiple=True,
                callback=value(_limits, "--limit"),
                metavar="FIGURE=X,...",
                help="Upper limits, such as loss=0.05,torque=4. FIGURE is one of "
                f"{spoken(LIMITED, 'or')}.",
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
                help="Sort by these figures, the smallest values first.",
            ),
            click.option(
                "--pareto",
                multiple=True,
                default=PARETO,
                callback=value(_names, "--pareto"),
                metavar="FIGURE,...",
                help=f"Criteria of the Pareto list.  [default: {','.join(PARETO)}]",
            ),
        ),
        click.option(
            "--weights",
            multiple=True,
            callback=value(named("GEAR=WEIGHT", number), "--weights"),
            metavar="GEAR=WEIGHT,...",
            help="Weights of forward gears in the mean drag torque, such as 1=3.  [default: 1]",
        ),
    ),
)
"""Options of search, filter and order, which the command receives as argument `asked`."""
