"""Speed and torque equations of a gear, written out with names.

Source: figures 3 and 4 of Algin, Schematization and calculation of mobile machine presented as
multibody system. The equations correspond to `vstatics.core.statics.matrix`, with names, and with
coefficients in symbols.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from vstatics.core.explain.names import Names
from vstatics.core.explain.sums import Equation, System, Term
from vstatics.core.model.transmission import HOUSING, Gear, SpeedOf, Transmission
from vstatics.core.numerics.arrays import Floats
from vstatics.core.numerics.traced import plain
from vstatics.core.statics.matrix import (
    always_coupled,
    external_torques,
    held_links,
    loaded_devices,
    pump_torques,
    speed_row_names,
)
from vstatics.core.statics.torques import Torques


def speed_system(
    case: Transmission, gear: Gear, names: Names, matrix: Floats, speeds: Sequence[float]
) -> System:
    """Return the speed equations of a gear (figure 3).

    Parameters
    ----------
    gear : Gear
        Gear in which holding freewheels are listed as engaged.
    matrix : ndarray, shape (links, devices)
        Structural-distribution matrix. [-]
    speeds : sequence of float
        Speed of each link. [-]
    """
    always = always_coupled(case, gear)
    slips = {number - 1: float(slip) for number, slip in gear.slip.items()}
    devices = [*always, *(number - 1 for number in gear.carrying)]
    rows: list[tuple[list[Term], float]] = [
        (
            [
                Term(names.speeds[link], symbol, float(matrix[link - 1, device]))
                for link, symbol in _column(case, device, names)
            ],
            slips.get(device, 0.0),
        )
        for device in devices
    ]
    for link, speed in {case.gear_input(gear): 1.0, **gear.speeds}.items():
        row = [Term(names.speeds[link], "1", 1.0)]
        if isinstance(speed, SpeedOf):
            row.append(Term(names.speeds[speed.link], f"-{speed.factor:g}", -speed.factor))
        rows.append((row, 0.0 if isinstance(speed, SpeedOf) else speed))
    labels = speed_row_names(case, gear)
    equations = [Equation(of, *row) for of, row in zip(labels, rows, strict=True)]
    return System(equations, dict(zip(names.speeds[1:], speeds, strict=True)))


def torque_system(  # noqa: PLR0913 - all parameters are parts of the equations
    case: Transmission,
    gear: Gear,
    names: Names,
    matrix: Floats,
    torques: Torques,
    *,
    drag: Mapping[int, float],
) -> System:
    """Return the equilibrium equations of the links of a gear (figure 4).

    See `speed_system` for the parameters. `matrix` and `torques` must both include losses, or both
    exclude losses. `drag` is the external torque of drag on each link [-].
    """
    rows: list[list[Term]] = [[] for _ in range(case.links + 1)]
    values = {}
    for device in loaded_devices(case, gear):
        unknown = names.torques[device]
        values[unknown] = plain(torques.on_first_link[device])
        for link, symbol in _column(case, device, names):
            rows[link].append(Term(unknown, symbol, float(matrix[link - 1, device])))
    rows[case.gear_output(gear)].append(Term(names.torques[-1], "1", 1.0))
    values[names.torques[-1]] = plain(torques.on_first_link[-1])
    for link in held_links(case, gear):
        rows[link].append(Term(names.holding[link], "-1", -1.0))
        values[names.holding[link]] = plain(torques.holding[link])
    right = external_torques(case, gear)
    equations = [
        Equation(case.link_name(link), row, right.get(link, 0.0) + drag.get(link, 0.0))
        for link, row in enumerate(rows)
        if link != HOUSING
    ]
    for device, torque in pump_torques(case, gear).items():
        row = [Term(names.torques[device], "1", 1.0)]
        equations.append(Equation(case.devices[device], row, torque))
    return System(equations, values)


def _column(case: Transmission, device: int, names: Names) -> Iterator[tuple[int, str]]:
    """Yield the links of a device except the housing, with coefficients in symbols."""
    elements = case.shift_elements
    number = device - len(elements)
    if number < 0:
        element = elements[device]
        column = [(element.first, "1"), (element.second, "-1")]
    elif number < len(case.mechanisms):
        ratio = names.ratios[number]
        links = case.mechanisms[number].links
        column = list(zip(links, ("1", f"-{ratio}", f"{ratio} - 1"), strict=True))
    else:
        form = case.springs[number - len(case.mechanisms)].form
        column = [(link, f"{part:g}") for link, part in form.items()]
    return ((link, symbol) for link, symbol in column if link != HOUSING)
