"""Results in rpm, N*m and kW, for a case with an input speed or torque."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from vstatics.core.errors import CaseError
from vstatics.core.model.parts import KW_OF_RPM_NM
from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.arrays import Floats, without
from vstatics.core.statics.matrix import held_links
from vstatics.core.statics.result_arrays import ResultFields
from vstatics.core.statics.torques import port_torques

_NEEDED = {
    "rpm": ("speed", "speed: 2000 rpm"),
    "Nm": ("torque", "torque: 300 N*m"),
    "kW": ("speed and torque", "speed: 2000 rpm, torque: 300 N*m"),
}
"""Key under `load` that results in a unit need, and an example in YAML."""


def scales(case: Transmission) -> dict[str, Floats]:
    """Return the factors that convert relative numbers of each gear to rpm, Nm and kW.

    The arrays have the shape (gears,), with NaN if the load lacks the quantity. Torques are
    relative to 1 N*m if the input torque is 0.

    The factors apply to arrays of `Results`, in which power enters at the input even when coasting.
    In reality the torque of a coasting input acts against its speed, so the factors of torque and
    power are negative. For powers in their real direction use `gear_scales`.

    >>> from vstatics.core.model.parts import Gear, Load, Mechanism
    >>> case = Transmission(2, [], [Mechanism(1, 2, 0, -2.5)], [Gear()], load=Load(2000, 300))
    >>> {unit: round(scale.item(), 3) for unit, scale in scales(case).items()}
    {'rpm': 2000.0, 'Nm': 300.0, 'kW': 62.832}
    """
    loads = [case.gear_load(gear) for gear in case.gears]
    rpm = np.array([math.nan if load.speed is None else float(load.speed) for load in loads])
    torque = np.array([float(case.torque_unit(gear)) or math.nan for gear in case.gears])
    with np.errstate(over="ignore"):
        return {"rpm": rpm, "Nm": torque, "kW": rpm * torque * KW_OF_RPM_NM}


def gear_scales(case: Transmission) -> list[dict[str, float]]:
    """Return the factors of `scales` for each gear, for powers in the real direction.

    The factor to kW is positive even when coasting, because `GearState.powers`, ports and flows
    already contain reversed powers.

    >>> from vstatics.core.model.parts import Gear, Load, Mechanism
    >>> pair, load = Mechanism(1, 2, 0, -2.5), Load(2000, 300)
    >>> case = Transmission(2, [], [pair], [Gear()], load=load, coast=True)
    >>> [{unit: round(scale, 3) for unit, scale in own.items()} for own in gear_scales(case)]
    [{'rpm': 2000.0, 'Nm': -300.0, 'kW': 62.832}]
    """
    by_unit = {unit: scale.tolist() for unit, scale in scales(case).items()}
    by_unit["kW"] = list(map(abs, by_unit["kW"]))
    return [dict(zip(by_unit, row, strict=True)) for row in zip(*by_unit.values(), strict=True)]


def known_units(case: Transmission) -> set[str]:
    """Return the units in which at least one gear of a case has results."""
    if case.load is None and not any(gear.load for gear in case.gears):
        return set()
    return {unit for unit, scale in scales(case).items() if not np.isnan(scale).all()}


def lacking_load(name: str, unit: str) -> str:
    """Return a message that no gear has the operating point that a unit requires."""
    what, given = _NEEDED[unit]
    return (
        f"the case gives no {what} at the input, so there is no `{name}`; give `load: {{{given}}}`"
    )


class _PhysicalArray:
    """Descriptor that converts an array to the unit in the attribute's suffix, such as ``_rpm``."""

    def __set_name__(self, owner: type, name: str) -> None:
        self.array, _, self.unit = name.rpartition("_")

    def __get__(self, results: PhysicalResults, owner: type) -> Floats:
        return results.in_unit(self.unit, results.in_own_unit(self.array), self.array)


class PhysicalResults(ResultFields):
    """Arrays of `Results` in rpm, N*m and kW, calculated on access.

    Each array has the axes of the relative array, such as `speeds` for `speeds_rpm`. Values are NaN
    in gears without an operating point. If no gear has the operating point that a unit requires,
    access raises a `CaseError`.

    Examples
    --------
    The pair turns its second link at 2000/2.5 rpm, and 4 % of the power is lost.

    >>> from vstatics import Gear, Load, Mechanism, Transmission, solve
    >>> pair = Mechanism(1, 2, 0, -2.5, 0.96)
    >>> results = solve(Transmission(2, [], [pair], [Gear()], load=Load(2000, 300)))
    >>> results.speeds_rpm
    array([[2000., -800.]])
    >>> results.lossy_output_torque_Nm, results.losses_kW.round(3)
    (array([-720.]), array([[2.513]]))
    """

    __slots__ = ()

    speeds_rpm = _PhysicalArray()
    """`speeds` [rpm]."""
    planet_speeds_rpm = _PhysicalArray()
    """`planet_speeds` [rpm]."""
    slip_speeds_rpm = _PhysicalArray()
    """`slip_speeds` [rpm]."""
    torques_Nm = _PhysicalArray()  # noqa: N815
    """`torques` [N*m]."""
    lossy_torques_Nm = _PhysicalArray()  # noqa: N815
    """`lossy_torques` [N*m]."""
    output_torque_Nm = _PhysicalArray()  # noqa: N815
    """`output_torque` [N*m]."""
    lossy_output_torque_Nm = _PhysicalArray()  # noqa: N815
    """`lossy_output_torque` [N*m]."""
    holding_torques_Nm = _PhysicalArray()  # noqa: N815
    """`holding_torques` [N*m]."""
    lossy_holding_torques_Nm = _PhysicalArray()  # noqa: N815
    """`lossy_holding_torques` [N*m]."""
    mesh_torques_Nm = _PhysicalArray()  # noqa: N815
    """`mesh_torques` [N*m]."""
    lossy_mesh_torques_Nm = _PhysicalArray()  # noqa: N815
    """`lossy_mesh_torques` [N*m]."""
    losses_kW = _PhysicalArray()  # noqa: N815
    """`losses` [kW]; above 0 when coasting, too."""
    mesh_losses_kW = _PhysicalArray()  # noqa: N815
    """`mesh_losses` [kW]."""
    drag_losses_kW = _PhysicalArray()  # noqa: N815
    """`drag_losses` [kW]."""
    gear_losses_kW = _PhysicalArray()  # noqa: N815
    """`gear_losses` [kW]."""
    slip_losses_kW = _PhysicalArray()  # noqa: N815
    """`slip_losses` [kW]; above 0 when coasting, too."""

    @property
    def input_power_kW(self) -> Floats:  # noqa: N802
        """Power that enters by all external torques, with losses, shape ``(..., gears)`` [kW]."""
        power: Floats = np.maximum(self._port_powers("input_power"), 0.0).sum(axis=-1)
        return power

    @property
    def output_power_kW(self) -> Floats:  # noqa: N802
        """Power that leaves by all external torques, with losses, shape ``(..., gears)`` [kW].

        Drag is not an external torque. The difference from the input power is lost in meshes or to
        drag.
        """
        power: Floats = np.maximum(-self._port_powers("output_power"), 0.0).sum(axis=-1)
        return power

    @property
    def port_powers_kW(self) -> Floats:  # noqa: N802
        """Power that enters at each link, with losses, shape ``(..., gears, links)`` [kW]."""
        return self._port_powers("port_powers")

    def in_unit(self, unit: str, relative: Floats, name: str) -> Floats:
        """Convert a relative array to a unit; `name` is the name of the array in an error."""
        if not self.points and unit not in known_units(self.case):
            raise CaseError("E414", lacking_load(f"{name}_{unit}", unit))
        scale = (self.points.scales if self.points else scales(self.case))[unit]
        if relative.ndim > self.ratio.ndim:
            scale = scale[..., np.newaxis]
        with np.errstate(over="ignore", invalid="ignore"):
            values = relative * scale
        return np.where(np.isfinite(values), values + 0.0, np.nan)

    def in_own_unit(self, name: str) -> Floats:
        """Return an array relative to the input torque, or to 1 N*m if the input torque is 0."""
        if name.endswith("output_torque"):
            return self.in_own_unit(name.replace("output_torque", "torques"))[..., -1]
        array: Floats = ResultFields.__dict__[name].__get__(self)
        return array

    def _port_powers(self, name: str) -> Floats:
        case = self.case
        power = np.zeros((*self.speeds.shape[:-1], case.links))
        for number, gear in enumerate(self.points.gears if self.points else case.gears):
            held: dict[int, Any] = {
                link: self.in_own_unit("lossy_holding_torques")[..., number, link - 1]
                for link in held_links(case, gear)
            }
            output: Any = self.in_own_unit("lossy_output_torque")[..., number]
            torques: Any = port_torques(case, gear, held, output)
            if self.points:
                change = self.points.loaded[..., number] - case.input_torque(gear)
                torques[case.gear_input(gear)] = torques[case.gear_input(gear)] + change
            for link, torque in torques.items():
                speed = self.speeds[..., number, link - 1]
                # No power flows at zero speed or torque, even if the other factor is unknown.
                at_rest = (torque == 0) | (speed == 0)
                with np.errstate(over="ignore", invalid="ignore"):
                    power[..., number, link - 1] = np.where(at_rest, 0.0, torque * speed)
        return self.in_unit("kW", power, name)


RELATIVE_TO_INPUT = (
    *("torques", "holding_torques", "lossy_torques", "lossy_holding_torques", "efficiency"),
    *("losses", "power_balance", "drag_losses", "gear_losses", "slip_losses"),
    *("mesh_torques", "lossy_mesh_torques", "mesh_losses"),
)
"""Arrays that are NaN in gears whose input torque is 0."""


def _relative(name: str) -> property:
    """Return a property for an array that is NaN in gears whose input torque is 0."""

    def by_input(results: PhysicalResults) -> Floats:
        array, case = results.in_own_unit(name), results.case
        if results.points:
            known = results.points.loaded
        elif case.unloaded:
            known = np.array([case.input_torque(gear) != 0 for gear in case.gears])
        else:
            return array
        if known.all():
            return array
        return without(array, np.broadcast_to(~known, results.ratio.shape))

    return property(by_input, doc=getattr(ResultFields, name).__doc__)


for _name in RELATIVE_TO_INPUT:
    setattr(PhysicalResults, _name, _relative(_name))
