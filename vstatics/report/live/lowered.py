"""What a page that calculates knows of a case: three-link mechanisms, gears, formulas, rows.

Links count from 1, 0 is the housing; all else counts from 0. Numbers are formulas as of
`vstatics.elements.quotients`: what a page changes stands in them by its path.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from vstatics.elements.formulas import Formulas, MechanismFormulas
from vstatics.elements.quotients import Formula
from vstatics.model.parts import Law, Mechanism, OfLoad, OwnDevice, Planet, SpeedOf
from vstatics.model.transmission import Transmission
from vstatics.statics.freewheels import input_direction
from vstatics.statics.physical import scales
from vstatics.statics.result_arrays import all_row_names
from vstatics.sweep.variants.part_numbers import part_numbers
from vstatics.tables.quantities import QUANTITIES

RESULTS = tuple(one for one in QUANTITIES if one.columns == "gears")
"""The quantities that a page calculates."""


def lowered(case: Transmission) -> dict[str, Any]:
    """A case as plain data for the script of a page.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism
    >>> pair = Mechanism(1, 2, 0, -2.5, 0.98, name="pair")
    >>> told = lowered(Transmission(2, [], [pair], [Gear(torques={1: 0.5})]))
    >>> told["numbers"]
    {'pair.ratio': -2.5, 'pair.efficiency': 0.98, 'gears.1.torques.1': 0.5}
    >>> told["mechanisms"]
    [{'links': (1, 2, 0), 'ratio': 'pair.ratio', 'efficiency': 'pair.efficiency'}]
    """
    formulas = Formulas(case)
    names = all_row_names(case)
    return {
        "links": case.links,
        "names": case.link_names,
        "elements": [(one.first, one.second, one.is_freewheel) for one in case.shift_elements],
        "mechanisms": [
            _mechanism(*pair) for pair in zip(case.mechanisms, formulas.mechanisms, strict=True)
        ],
        "springs": [[*one.form.items()] for one in case.springs],
        "dampers": [n for n, spring in enumerate(case.springs) if spring.is_damper],
        "devices": [_device(one, formulas, n) for n, one in enumerate(case.own_devices)],
        "drawn": case.drawing is not None,
        "idle": case.idle,
        "depends": case.depends,  # losses on the load, torques on a battery
        "gears": [*_gears(case, formulas)],
        "numbers": formulas.numbers,
        "conditions": formulas.conditions,
        "counts": [
            path
            for path, one in part_numbers(case).items()
            if one.kind == "count" and path in formulas.numbers
        ],
        "results": {
            one.key: {
                "rows": names[one.rows],
                "of": one.of or one.name,
                "unit": one.unit if one.of else "",
                "decimals": one.decimals if one.kind is float else 0,
                "isMark": one.kind is bool,
            }
            for one in RESULTS
        },
    }


def _mechanism(one: Mechanism, formulas: MechanismFormulas) -> dict[str, Any]:
    found: dict[str, Any] = {
        "links": one.links,
        "ratio": None if formulas.ratio != formulas.ratio else formulas.ratio,
        "efficiency": formulas.efficiency,
        "back": formulas.back_efficiency,
        "planet": formulas.planet_ratio,
        "kind": one.kind,
        "points": [point[:2] for point in one.points],
    }
    return {key: value for key, value in found.items() if value not in (None, "", [])}


def _device(device: OwnDevice, formulas: Formulas, place: int) -> dict[str, Any]:
    """What results a drawn element or mechanism has, and from what."""
    return {
        "mechanisms": device.mechanisms,
        "members": [(one.name, one.link, one.places) for one in device.members],
        "planets": [*_planets(device.planets, formulas, place)],
        "meshes": device.meshes_by_index,
    }


def _planets(planets: Sequence[Planet], formulas: Formulas, place: int) -> Iterator[dict[str, Any]]:
    """Planets by their wheels: of each its link, mechanism and speed; others by a mechanism."""
    group = formulas.groups[place]
    speeds: dict[str, Any] = {}
    wheels: dict[str, list[Any]] = {}
    for train in group.trains if group else ():
        by_wheel = [_formula(group.relative(one, train)) for one in group.wheels_of(train)]  # type: ignore[union-attr] # there is one
        for planet, speed in train.items():
            speeds[planet], wheels[planet] = _formula(speed), by_wheel
    for one in planets:
        name = one.name.rpartition(".")[2]
        if one.wheels:
            own = zip(one.wheels, wheels[name], strict=True)
            yield {
                "carrier": one.carrier,
                "speed": None if math.isnan(one.speed) else speeds[name],
                "wheels": [(wheel.link, wheel.mechanism, formula) for wheel, formula in own],
            }
        else:
            yield {"mechanism": one.mechanism}


def _formula(number: Any) -> Formula:
    """The formula of a quotient; a whole number is itself."""
    return number.formula if hasattr(number, "formula") else float(number)


def _gears(case: Transmission, formulas: Formulas) -> Iterator[dict[str, Any]]:
    by_unit = {unit: array.tolist() for unit, array in scales(case).items()}
    own = case.own_mechanisms.start
    for place, gear in enumerate(case.gears):
        unit = case.input_torque(gear)
        where = f"gears.{gear.name}"

        def of_link(kind: str, link: int, value: Any, where: str = where) -> Formula:
            path = f"{where}.{kind}.{case.link_name(link)}"
            if isinstance(value, OfLoad):
                return ["/", formulas.number(path, value.given), value.whole]
            return formulas.number(path, float(value))

        torques = [
            (link, of_link("torques", link, torque) if unit or isinstance(torque, OfLoad) else 0)
            for link, torque in gear.torques.items()
        ]
        of_elements = case.gear_open_drag(gear).items()
        open_drag = _torques({number - 1: torque for number, torque in of_elements}, unit)
        yield {
            "name": gear.name,
            "kind": gear.kind,
            "engaged": [number - 1 for number in gear.engaged],
            "input": case.gear_input(gear),
            "output": case.gear_output(gear),
            "torque": unit,
            "speeds": [
                (link, speed.factor, speed.link)
                if isinstance(speed, SpeedOf)
                else (link, of_link("speeds", link, speed))
                for link, speed in gear.speeds.items()
            ],
            "torques": torques,
            "drag": _torques(case.gear_drag(gear), unit),
            "open": [pair for pair in open_drag if pair[1]],
            "direction": -1 if case.coasts(gear) else 1,
            "turns": input_direction(case, gear),
            "ratios": [
                *((own + number - 1, one) for number, one in gear.speed_ratios.items()),
                *((place, 1.0) for place in sorted(case.bypassed(gear))),
            ],
            "scales": {
                one: values[place]
                for one, values in by_unit.items()
                if not math.isnan(values[place])
            },
        }


def _torques(given: Mapping[int, Any], unit: float) -> list[tuple[int, float]]:
    """Torques that stay as they are [-]."""
    return [
        (owner, float(one) if isinstance(one, OfLoad) else float(one) * unit)
        for owner, one in given.items()
        if not isinstance(one, Law)
    ]
