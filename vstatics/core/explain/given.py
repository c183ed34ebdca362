"""Given data of a gear as tables: all data of the case that affect the gear.

An exercise can be solved from these tables alone. `UNREAD` contains the keys that do not affect the
solution. Keys that this package does not list appear in the last table.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from vstatics.core.elements.drawing import drawing_of
from vstatics.core.explain import typeset
from vstatics.core.explain.converters import converter_points, sought_ratio
from vstatics.core.explain.given_parts import (
    UNREAD,
    cell_of,
    data_text,
    elements,
    fills_a_gap,
    in_words,
    link_text,
    losses,
    mechanisms,
    shift_elements,
    springs,
)
from vstatics.core.explain.machines import MACHINES
from vstatics.core.explain.text import engaged, rule
from vstatics.core.model.parts import HOUSING, Law
from vstatics.core.model.transmission import Gear, Transmission
from vstatics.core.numerics.traced import plain
from vstatics.core.statics.results import Results
from vstatics.core.statics.state import GearState
from vstatics.core.tables.grid import NOTHING, Grid, Value, grid_of, whole, word
from vstatics.core.texts import heading, tr
from vstatics.core.writers.named import mapping

_SHOWN = frozenset(
    (
        *("shift_elements", "elements", "mechanisms", "springs", "input", "output", "outputs"),
        *("load", "coast", "idle", "losses", "mesh_efficiency"),
        *("engaged", "speeds", "torques", "drag", "open_drag", "speed_ratios", "input_turns"),
        *("balance", "slip"),
    )
)
"""Keys of a case or a gear that have their own tables."""


def given(results: Results, place: int) -> Iterator[Grid]:
    """Yield the data of a gear for an exercise: parts, connections, loads and conventions.

    Parameters
    ----------
    place : int
        Index of the gear.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)], [Gear([1])])
    >>> [one.key for one in given(solve(case), 0) if one.rows]
    ['mechanisms', 'losses', 'shift_elements', 'ports', 'acting']
    """
    case, state = results.case, results.gear_at(place)
    gear = case.gears[place]
    names = [item.name for item in case.shift_elements]
    holding = [names[number - 1] for number in state.holding]
    slipping = [names[number - 1] for number in gear.slipping]
    engaged_text = engaged([names[number - 1] for number in gear.joining], holding, slipping)
    yield Grid(tr("Gear {gear}: {engaged}", gear=gear.name, engaged=engaged_text), (), ())
    data = mapping(case)
    tables = (
        elements(case, data.get("elements", {})),
        mechanisms(case, state.gear),
        losses(case),
        shift_elements(case, gear, state),
        springs(case),
        _ports(case, gear),
        _acting(case, gear),
        _rest({**data, **data["gears"][gear.name]}),
        _idle(state),
    )
    yield from (item for item in tables if item.rows)
    yield from (Grid(item, (), (), prose=typeset.prose(item)) for item in _conventions(gear, state))


def _conventions(gear: Gear, state: GearState) -> Iterator[str]:
    """Yield sentences about the conventions for speeds and torques of a gear."""
    case, drawing = state.case, drawing_of(state.case)
    if case.input_torque(state.gear):
        yield tr(
            "Speeds are relative to the speed of the input, torques to its torque, powers to its "
            "power."
        )
    else:
        yield tr("Speeds are relative to the speed of the input; torques are in N*m.")
    yield tr(
        "A torque on a component is the torque that its link exerts on it, positive in the "
        "direction of the input torque; for a shift element or mechanism it is the torque "
        "on its first link. Mx is the torque of the output on the load."
    )
    if state.calculable:
        yield from _rules_of_losses(state)
        for point in converter_points(state, gear):
            yield from sought_ratio(point)
        yield from _rules_of_drag(state)
    if any(item.is_plain(item.ratio) and item.planet_ratio is None for item in case.mechanisms):
        yield tr(
            "In a plain set, the ratio of the first link to a planet is (u + 1)/2, carrier held."
        )
    if any(map(fills_a_gap, drawing.elements if drawing else ())):
        yield tr("A planet between a sun and a ring has (ring - sun)/2 teeth where none are given.")
    if case.freewheels:
        yield tr("A freewheel keeps its first link from turning backward relative to the second.")
    if gear.balance:
        yield tr(MACHINES)
        yield tr(
            "The torque that balances machines and battery is calculated with losses; the "
            "torques without losses use it, too."
        )
    yield from (f"{tr(item.english)}: {tr(item.meaning)}" for item in state.statuses)
    if case.coasts(state.gear) and state.calculable:
        yield tr("Coasting: power enters at the output.")


def _rules_of_losses(state: GearState) -> Iterator[str]:
    """Yield sentences about mechanisms with losses, variators and converters."""
    case = state.case
    if any(
        mechanism.efficiency != 1 or mechanism.back_efficiency is not None
        for mechanism in case.mechanisms
    ):
        drags = bool(state.drag.links or state.drag.elements)
        yield f"{tr('Torques with losses')}: {rule(coasts=case.coasts(state.gear), drags=drags)}"
    if any(mechanism.back_efficiency is not None for mechanism in case.mechanisms):
        yield tr("With x = -1 it is u/b, where an efficiency backward b is given.")
    bypassed, unloaded = case.bypassed(state.gear), case.unloaded_converters(state.gear)
    kinds = {mechanism.kind for n, mechanism in enumerate(case.mechanisms) if n not in unloaded}
    if "variator" in kinds:
        yield tr(
            "For a variator, u is the inverse of its speed ratio w_second/w_first. At speed"
            " ratio 0 its second link is at rest and its first link carries no torque."
        )
    if "converter" in kinds:
        yield tr(
            "A converter has the torques M and -K M on its links, with and without losses. "
            "K is interpolated linearly over the speed ratio w_second/w_first and held "
            "constant outside its points. The converter loses M (w_first - K w_second)."
        )
    for text, numbers in (
        ("Bypassed by a lock-up clutch, without torque: {names}.", bypassed),
        ("Open, without torque: {names}.", unloaded - bypassed),
    ):
        if numbers:
            names = ", ".join(case.mechanisms[n].name for n in sorted(numbers))
            yield tr(text, names=names)
    efficiencies = (
        n
        for mechanism in case.mechanisms
        for n in (mechanism.efficiency, mechanism.back_efficiency)
    )
    if any(isinstance(mechanism, Law) for mechanism in efficiencies):
        yield tr(
            "An efficiency over speed depends on the speed of the first link relative to "
            "the third; an efficiency over torque depends on the torque on the first link "
            "with losses. Both use magnitudes, in a formula w in rad/s and T in N*m; values are "
            "interpolated linearly between points and held constant outside."
        )


def _rules_of_drag(state: GearState) -> Iterator[str]:
    case = state.case
    if case.has_drag:
        yield tr(
            "Drag brakes its link, or the links of a disengaged shift element relative to "
            "each other. It acts only in the torques with losses."
        )
    # The gear of the case contains laws, the gear of the state numbers.
    gear = case.gears[case.gear_number(state.gear.name) - 1]
    if gear.loss is not None:
        yield tr(
            "The loss of the gear, in W unless it has a unit, depends on the magnitudes of speed, "
            "rad/s, and torque, N*m, of the input. A power divided by the speed is the torque that "
            "brakes the input, only in the torques with losses."
        )
    by_part = case.gear_drag(gear), case.gear_open_drag(gear)
    if any(isinstance(drag, Law) for drags in by_part for drag in drags.values()):
        yield tr(
            "Drag over speed depends on the speed of its link, or on the slip of a "
            "disengaged shift element; in a formula w is the magnitude in rad/s. Values are"
            " interpolated linearly between points and held constant outside."
        )


def _ports(case: Transmission, gear: Gear) -> Grid:
    rows = [
        (case.link_name(case.gear_input(gear)), word("input")),
        (case.link_name(case.gear_output(gear)), word("output")),
        *((case.link_name(link), word("further output")) for link in case.further_outputs(gear)),
    ]
    return grid_of("Ports", ["link", "port"], rows, key="ports")


def _acting(case: Transmission, gear: Gear) -> Grid:
    entry = case.gear_input(gear)
    rows: list[tuple[int, str, Value]] = [
        (entry, "speed", cell_of(1.0)),
        (entry, "torque", cell_of(case.input_torque(gear))),
    ]
    for link, speed in gear.speeds.items():
        speed_cell = case.speed_text(speed) if not isinstance(speed, float) else cell_of(speed)
        rows.append((link, "speed", speed_cell))
    rows += [(link, "torque", cell_of(torque)) for link, torque in gear.torques.items()]
    rows += [(link, "drag", cell_of(drag)) for link, drag in case.gear_drag(gear).items()]
    load = case.gear_load(gear)
    if load.speed is not None:
        rows.append((entry, "speed, rpm", cell_of(load.speed)))
    if load.torque is not None:
        rows.append((entry, "torque, N*m", cell_of(load.torque)))
    if case.freewheels and (turns := case.input_turns(gear)):
        rows.append((entry, "sense of rotation", word(turns)))
    if gear.balance:
        rows += [
            (link, "efficiency", cell_of(efficiency))
            for link, efficiency in gear.balance.efficiencies
        ]
        rows.append((HOUSING, "charging power, kW", cell_of(gear.balance.battery)))
    named = (
        (link_text(case, link) if link else NOTHING, heading(what), value)
        for link, what, value in rows
    )
    return grid_of("Given", ["link", "quantity", "value"], named, key="acting")


def _rest(data: Mapping[str, Any]) -> Grid:
    rows = [
        (in_words(key), data_text(value))
        for key, value in data.items()
        if key not in UNREAD | _SHOWN
    ]
    return grid_of("Further data", ["quantity", "value"], rows, key="rest")


def _idle(state: GearState) -> Grid:
    """Return the table of signs that the power flow without losses does not determine."""
    signs = zip(state.case.mechanisms, state.signs, told_signs(state), strict=True)
    rows = [(mechanism.name, whole(plain(sign))) for mechanism, sign, is_given in signs if is_given]
    title = "Signs of unloaded mechanisms"
    if any(state.search.turned):
        title = "Signs not determined by the power without losses"
    return grid_of(title, ["mechanism", "sign"], rows, key="idle")


def told_signs(state: GearState) -> list[bool]:
    """Return True for each mechanism whose sign an exercise must state.

    The power flow without losses does not determine such a sign.
    """
    return [
        idle or turned is True
        for idle, turned in zip(state.search.idle, state.search.turned, strict=True)
    ]
