"""Overview of a case: a line of main figures, and messages by severity."""

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
"""Plural of each severity, by its singular, most severe first."""


def overview(material: Material) -> Iterator[Markup]:
    """Yield the line of the main figures, with the gear of each figure.

    These are the number of gears, the ratio spread, the lowest efficiency, the largest torque of a
    shift element, the largest share of recirculating power, and the number of messages by severity.
    """
    facts = [*_gears(material), *_efficiency(material), *_torque(material)]
    facts += [*_circulation(material), (tr("alerts"), _alerts(material.messages))]
    yield line_of(facts)


def alerts(messages: Sequence[str]) -> Iterator[Markup]:
    """Yield a list of messages for each severity, most severe first."""
    for weight, name in WEIGHTS.items():
        items = [tag("li", message, class_=weight) for message in _of_weight(messages, weight)]
        if items:
            yield tag("ul", *items, class_="messages", id=name)


def _gears(material: Material) -> Iterator[tuple[str, str]]:
    design = material.summary.design
    yield tr("gears"), str(len(design.gears))
    if len(design.forward) > 1:
        first, last = (
            _link_if_shown(material, gear, gear) for gear in (design.forward[0], design.forward[-1])
        )
        spread = _number(material, design.spread)
        yield (
            tr("spread"),
            filled(tr("{spread}, gear {first} to {last}"), spread=spread, first=first, last=last),
        )


def _efficiency(material: Material) -> Iterator[tuple[str, str]]:
    known = [gear for gear in material.summary.design.gears if not math.isnan(gear.efficiency)]
    if known:
        worst = min(known, key=lambda gear: gear.efficiency)
        yield (
            tr("lowest efficiency"),
            _in_gear(material, _number(material, worst.efficiency), worst.gear),
        )


def _torque(material: Material) -> Iterator[tuple[str, str]]:
    """Yield the largest torque of a shift element, if possible in N*m and with losses."""
    largest = material.summary.largest
    for loaded in (True, False):
        for key in (LOSSY_TORQUES, TORQUES):
            shown = quantity(key, loaded=loaded)
            extreme = overall(largest.get(shown.name, ()))
            if extreme is not None and extreme.gear:
                unit = tr(UNITS[shown.unit].text) if shown.unit else tr(RELATIVE)
                value = rounded(abs(extreme.value), shown.decimals, material.digits)
                text = joined(f"{value} {unit}")
                if material.has_marks:
                    text = _in_unit(value, unit, abs(extreme.value), extreme.gear, loaded=loaded)
                text = joined(text, f", {extreme.row}")
                name = tr("largest torque of a shift element")
                yield name, _in_gear(material, text, extreme.gear)
                return


def _in_unit(text: str, unit: str, value: float, gear: str, *, loaded: bool) -> Markup:
    """Return a torque as text, marked for conversion by the choice of units."""
    marks = {"data_gear": gear, "data_value": value, "data_unit" if loaded else "data_scaled": "Nm"}
    return joined(tag("span", text, **marks), " ", tag("span", unit, class_="unit"))


def _circulation(material: Material) -> Iterator[tuple[str, str]]:
    shares = ((flow.shown.circulating_share, flow.gear) for flow in material.flows if flow.shown)
    known = [flow for flow in shares if not math.isnan(flow[0])]
    if known:
        share, gear = max(known, key=itemgetter(0))
        part = rounded(100 * share, 1, material.digits)
        text = _in_gear(material, tr("{part} % of the input power", part=part), gear)
        yield tr("largest recirculating power"), text if share > 0 else tr("none")


def _alerts(messages: Sequence[str]) -> str:
    links = []
    for weight, name in WEIGHTS.items():
        count = len(_of_weight(messages, weight))
        if count:
            text = tr(f"{{count}} {weight}|{{count}} {name}", count=count)
            links += [", ", tag("a", text, href=f"#{name}", class_=weight)]
    return joined(*links[1:]) if links else tr("none")


def _of_weight(messages: Sequence[str], weight: str) -> list[str]:
    return [message for message in messages if message.startswith(f"{weight}:")]


def _in_gear(material: Material, text: str, gear: str) -> Markup:
    return joined(text, ", ", _link_if_shown(material, gear, tr("gear {gear}", gear=gear)))


def _link_if_shown(material: Material, gear: str, text: str) -> str:
    return gear_link(gear, text) if material.asked.shows(gear) else text


def _number(material: Material, value: float) -> str:
    return rounded(value, 3, material.digits)
