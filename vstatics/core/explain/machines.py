"""Power balance of the electric machines of a gear with their battery."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from vstatics.core.model.parts import RAD_PER_RPM
from vstatics.core.statics.points.balance import sought_link
from vstatics.core.statics.points.machines import battery_power, efficiency_at
from vstatics.core.statics.results import Results
from vstatics.core.tables.answer import Known


class MachineShare(NamedTuple):
    """Power of an electric machine in a battery balance."""

    link: str
    power_kW: Known  # noqa: N815 - as `port_powers_kW`
    """Power from the link to the machine, in a gear with losses [kW]."""
    efficiency: Known
    battery_kW: Known  # noqa: N815
    """Power from the machine to the battery [kW]; negative if the battery supplies the machine."""


MACHINES = (
    "Machines and battery: P = -torque x speed is the power that a link gives to its "
    "machine, with losses; the battery gets P eta, or gives P/eta where P is below 0"
)
"""Rule of the balance, as a sentence for worksheets."""


class MachineBalance(NamedTuple):
    """Battery balance of a gear: powers of the machines, and the torque that balances them."""

    link: str
    """Link with the balancing torque."""
    torque: Known
    """Balancing torque, relative to the input torque [-], or in N*m if the input has no torque."""
    shares: Sequence[MachineShare]
    battery_kW: Known  # noqa: N815
    """Required charging power of the battery [kW]."""


def machine_balance(results: Results, number: int) -> MachineBalance | None:
    """Return the battery balance of a gear, by index; None if it does not exist or is not solved.

    Examples
    --------
    The generator on link 3 has an efficiency of 0.9, the motor on link 4 of 0.8.

    >>> from vstatics import Gear, Load, Mechanism, Transmission, solve
    >>> from vstatics.core.model.parts import BatteryBalance
    >>> gear = Gear(speeds={3: 2.0}, balance=BatteryBalance(((3, 0.9), (4, 0.8)), 0.0))
    >>> sets = [Mechanism(3, 2, 1, -2.0), Mechanism(4, 2, 0, 3.0)]
    >>> case = Transmission(4, [], sets, [gear], load=Load(1000.0, 100.0), input=1, output=2)
    >>> found = machine_balance(solve(case), 0)
    >>> round(sum(one.battery_kW for one in found.shares), 9), found.link
    (0.0, '4')
    """
    case = results.case
    gear = case.gears[number]
    if gear.balance is None:
        return None
    powers = -results.port_powers_kW[number]
    shares = []
    for link, law in gear.balance.efficiencies:
        power = float(powers[link - 1])
        speed = abs(float(results.speeds_rpm[number, link - 1])) * RAD_PER_RPM
        torque = -1000 * power / speed if speed else 0.0
        sizes = (np.array([size]) for size in (speed, torque, power))
        efficiency = float(np.asarray(efficiency_at(law, *sizes)).item())
        given = float(battery_power(np.array(power), efficiency))
        shares.append(MachineShare(case.link_name(link), power, efficiency, given))
    if any(math.isnan(share.power_kW) for share in shares):
        return None
    assert results.points is not None  # noqa: S101 - a case with a balance has them
    link = sought_link(gear, results.points.gears[number])
    torque = float(results.holding_torques[number, link - 1])
    return MachineBalance(case.link_name(link), torque, shares, gear.balance.battery)
