"""What a designer asks first, in one line, and what there is to watch, by weight."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from operator import itemgetter

from vstatics.core.summary.extremes import LOSSY_TORQUES, TORQUES, overall, quantity
from vstatics.core.tables.html import Markup, filled, joined, tag
from vstatics.core.tables.numbers import rounded
from vstatics.core.tables.quantities import UNITS
from vstatics.core.texts import tr
from vstatics.page.report.material import Material
from vstatics.page.report.tools.marks import RELATIVE
from vstatics.pictures.paged.parts import gear_link, line_of

WEIGHTS = {"error": "errors", "warning": "warnings", "note": "notes"}
"""Severities from the heaviest, and several of them."""


def overview(material: Material) -> Iterator[Markup]:
    """The line of the page's figures, each with the gear that it is of.

    Gears and spread, the worst efficiency, the largest torque of a shift element, the
    largest part of the power that circulates, and how many alerts of each weight.
    """
    facts = [*_gears(material), *_efficiency(material), *_torque(material)]
    facts += [*_circulation(material), (tr("alerts"), _alerts(material.messages))]
    yield line_of(facts)


def alerts(messages: Sequence[str]) -> Iterator[Markup]:
    """The messages, the heaviest first, in a list for each weight, which the line links to."""
    for weight, name in WEIGHTS.items():
        said = [tag("li", one, class_=weight) for one in _of_weight(messages, weight)]
        if said:
            yield tag("ul", *said, class_="messages", id=name)


def _gears(material: Material) -> Iterator[tuple[str, str]]:
    made = material.summary.design
    yield tr("gears"), str(len(made.gears))
    if len(made.forward) > 1:
        first, last = (_link(material, one, one) for one in (made.forward[0], made.forward[-1]))
        spread = _number(material, made.spread)
        yield (
            tr("spread"),
            filled(tr("{spread}, gear {first} to {last}"), spread=spread, first=first, last=last),
        )


def _efficiency(material: Material) -> Iterator[tuple[str, str]]:
    """The least that a gear has."""
    known = [one for one in material.summary.design.gears if not math.isnan(one.efficiency)]
    if known:
        worst = min(known, key=lambda one: one.efficiency)
        yield (
            tr("lowest efficiency"),
            _in_gear(material, _number(material, worst.efficiency), worst.gear),
        )


def _torque(material: Material) -> Iterator[tuple[str, str]]:
    """Of a shift element, with losses where they are known; in N*m where a load tells it."""
    largest = material.summary.largest
    for loaded in (True, False):
        for key in (LOSSY_TORQUES, TORQUES):
            shown = quantity(key, loaded=loaded)
            found = overall(largest.get(shown.key, ()))
            if found is not None and found.gear:
                unit = tr(UNITS[shown.unit].text) if shown.unit else tr(RELATIVE)
                value = rounded(abs(found.value), shown.decimals, material.digits)
                said = joined(f"{value} {unit}")
                if material.has_marks:
                    said = _in_unit(value, unit, abs(found.value), found.gear, loaded=loaded)
                said = joined(said, f", {found.row}")
                yield tr("largest element torque"), _in_gear(material, said, found.gear)
                return


def _in_unit(text: str, unit: str, value: float, gear: str, *, loaded: bool) -> Markup:
    """A torque whose unit can be chosen."""
    marks = {"data_gear": gear, "data_value": value, "data_unit" if loaded else "data_scaled": "Nm"}
    return joined(tag("span", text, **marks), " ", tag("span", unit, class_="unit"))


def _circulation(material: Material) -> Iterator[tuple[str, str]]:
    """The largest part of the power that enters a gear."""
    shares = ((one.shown.circulating_share, one.gear) for one in material.flows if one.shown)
    known = [one for one in shares if not math.isnan(one[0])]
    if known:
        share, gear = max(known, key=itemgetter(0))
        part = rounded(100 * share, 1, material.digits)
        said = _in_gear(material, tr("{part} % of the input power", part=part), gear)
        yield tr("largest circulation"), said if share > 0 else tr("none")


def _alerts(messages: Sequence[str]) -> str:
    """How many of each weight, each a link to them."""
    links = []
    for weight, name in WEIGHTS.items():
        count = len(_of_weight(messages, weight))
        if count:
            said = tr(f"{{count}} {weight}|{{count}} {name}", count=count)
            links += [", ", tag("a", said, href=f"#{name}", class_=weight)]
    return joined(*links[1:]) if links else tr("none")


def _of_weight(messages: Sequence[str], weight: str) -> list[str]:
    return [one for one in messages if one.startswith(f"{weight}:")]


def _in_gear(material: Material, said: str, gear: str) -> Markup:
    return joined(said, ", ", _link(material, gear, tr("gear {gear}", gear=gear)))


def _link(material: Material, gear: str, text: str) -> str:
    """A link to a gear that the page shows, else its name alone."""
    return gear_link(gear, text) if material.asked.shows(gear) else text


def _number(material: Material, value: float) -> str:
    return rounded(value, 3, material.digits)
