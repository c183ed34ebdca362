"""Parts of a transmission: shift elements, mechanisms, gears, operating points and their numbers.

Links, shift elements, mechanisms and gears are numbered from 1, as in the source of the method;
link 0 is the housing. An index, by contrast, counts from 0.

The solver divides a gear set into three-link mechanisms, with planets as links if needed.
`OwnDevice` lists the mechanisms of a gear set, for results.
"""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Literal, Self, TypeVar, get_args

from vstatics.core.model.empty import EMPTY
from vstatics.core.start import NamedTuple

if TYPE_CHECKING:
    from vstatics.core.numerics.arrays import Booleans, Floats  # costs start-up time


class Damping(NamedTuple):
    """Damping of an elastic component.

    Parameters
    ----------
    viscous : float
        Torque per rate of twist. [N*m*s/rad]
    loss_factor : float
        Ratio of damping torque to elastic torque at any frequency, as for a material. If only this
        component is twisted in a mode, the damping ratio of the mode is half the loss factor. [-]

    Examples
    --------
    >>> Damping(loss_factor=0.1)
    Damping(viscous=0.0, loss_factor=0.1)
    """

    viscous: float = 0.0
    loss_factor: float = 0.0

    def __bool__(self) -> bool:
        """Return whether the damping is not 0."""
        return self.viscous != 0 or self.loss_factor != 0


NO_DAMPING = Damping()


def damping(given: Damping | float) -> Damping:
    """Return a `Damping` with floats; a number is taken as viscous damping.

    Parameters
    ----------
    given : Damping or float
        Damping, or viscous damping as a number. [N*m*s/rad]

    Returns
    -------
    Damping

    Examples
    --------
    >>> damping(3)
    Damping(viscous=3.0, loss_factor=0.0)
    """
    return Damping(*map(float, given)) if isinstance(given, Damping) else Damping(float(given))


def damping_of(
    viscous: float = 0.0, ratio: float | None = None, loss_factor: float = 0.0
) -> Damping:
    """Return a damping from one of three numbers; the damping ratio is half the loss factor.

    >>> damping_of(ratio=0.02)
    Damping(viscous=0.0, loss_factor=0.04)
    """
    return Damping(viscous, loss_factor if ratio is None else 2 * ratio)


def damping_fault(
    viscous: float = 0.0, ratio: float | None = None, loss_factor: float = 0.0
) -> str:
    """Return a message if the numbers do not define a damping, else an empty text.

    >>> damping_fault(ratio=0.02, loss_factor=0.1)
    'read several of `viscous`, `ratio` and `loss_factor`, expected one of them'
    """
    if ratio is not None and ratio < 0:
        return f"read a ratio of {ratio:g}, expected a ratio of 0 or more"
    if bool(viscous) + (ratio is not None) + bool(loss_factor) < 2:
        return ""
    return "read several of `viscous`, `ratio` and `loss_factor`, expected one of them"


HOUSING = 0
RAD_PER_RPM = math.pi / 30
"""Speed of 1 rpm. [rad/s]"""
KW_OF_RPM_NM = RAD_PER_RPM / 1000
"""Power of 1 N*m at 1 rpm. [kW]"""

ElementKind = Literal["clutch", "brake", "dog_clutch", "freewheel"]
"""Kind of a shift element."""
Direction = Literal["forward", "backward"]
"""Direction of rotation of an input."""
DIRECTIONS: tuple[Direction, ...] = get_args(Direction)
GearKind = Literal["gear", "neutral", "point"]
"""Kind of a gear: normal gear, intended neutral, or operating point of a variable drive."""
GEAR_KINDS: tuple[GearKind, ...] = get_args(GearKind)
ELEMENT_KINDS: tuple[ElementKind, ...] = get_args(ElementKind)
MechanismKind = Literal["variator", "converter"]
"""Kind of a mechanism that has a speed ratio instead of a basic ratio."""
MECHANISM_KINDS: tuple[MechanismKind, ...] = get_args(MechanismKind)


class CoefficientTable(NamedTuple):
    """Coefficients of friction, interpolated linearly over slip and temperature."""

    columns: tuple[float, ...]
    """Temperatures in ascending order. [degC]"""
    rows: tuple[tuple[float, ...], ...]
    """Rows with a slip [rad/s], in ascending order, and the coefficient at each temperature [-]."""

    def at(self, temperature: float) -> tuple[tuple[float, float], ...]:
        """Return pairs of slip [rad/s] and coefficient of friction [-] at a temperature [degC].

        >>> table = CoefficientTable((20, 120), ((0, 0.12, 0.10),))
        >>> table.at(70), table.at(0)
        (((0, 0.11),), ((0, 0.12),))
        """
        right = min(max(bisect_right(self.columns, temperature), 1), len(self.columns) - 1)
        left = max(right - 1, 0)
        width = self.columns[right] - self.columns[left] if right else 1.0
        part = min(max((temperature - self.columns[left]) / width, 0.0), 1.0)
        return tuple(
            (row[0], row[1 + left] + part * (row[1 + right] - row[1 + left])) for row in self.rows
        )


class Friction(NamedTuple):
    """Friction pack of a shift element, for torque capacity and temperature.

    The torque capacity is ``pressure area radius surfaces mu(|slip|)``, where mu is the coefficient
    of friction. The temperature T of the pack follows from the friction power P: ``heat_capacity
    dT/dt = P - cooling (T - ambient)``.
    """

    radius: float = 0.0
    """Mean radius of friction. [m]"""
    area: float = 0.0
    """Area of the piston. [m^2]"""
    surfaces: int = 0
    """Number of pairs of friction surfaces."""
    coefficient: tuple[tuple[float, float], ...] | CoefficientTable = ()
    """Coefficient of friction [-] over ascending slip [rad/s], or also over temperature; empty if
    only the heat is known."""
    heat_capacity: float | None = None
    """Heat capacity of the pack. [J/K]"""
    cooling: float = 0.0
    """Heat flow to the surroundings per temperature difference. [W/K]"""
    ambient: float = 0.0
    """Temperature of the surroundings, and of the pack at the start. [degC]"""

    @property
    def per_pressure(self) -> float:
        """Product ``area radius surfaces``: torque capacity divided by pressure and by mu [m^3]."""
        return self.area * self.radius * self.surfaces

    @property
    def table(self) -> CoefficientTable | None:
        """Table of the coefficient of friction, if the coefficient depends on temperature."""
        return self.coefficient if isinstance(self.coefficient, CoefficientTable) else None

    @property
    def points(self) -> tuple[tuple[float, float], ...]:
        """Pairs of slip [rad/s] and coefficient of friction [-] at the ambient temperature."""
        if isinstance(self.coefficient, CoefficientTable):
            return self.coefficient.at(self.ambient)
        return self.coefficient

    def completed(self) -> Friction:
        """Return the friction pack with all numbers as floats; it must have passed the checks."""
        return with_floats(self)._replace(surfaces=int(self.surfaces))


class ShiftElement(NamedTuple):
    """Shift element: a clutch connects two links, a brake connects a link to the housing (0).

    Parameters
    ----------
    first, second : int
        Link numbers; 0 is the housing.
    name : str
        By default a letter and the number; see `element_name`.
    kind : {"clutch", "brake", "dog_clutch", "freewheel"}, optional
        By default a brake if the housing is one of the links, else a clutch. A freewheel prevents
        its first link from turning backward relative to the second; it is never listed as engaged,
        because torque and speed decide whether it holds.
    drag : float
        Drag torque when disengaged, relative to the input torque. [-]
    capacity : float, optional
        Torque capacity relative to the input torque of the case. Statics uses it only for margins
        and warnings. [-]
    stiffness : float, optional
        Stiffness when engaged, for vibration and simulation; rigid by default. [N*m/rad]
    damping : Damping or float
        Damping parallel to the stiffness; a number is viscous. [N*m*s/rad]
    static : float
        Static-to-dynamic friction ratio, 1 or more. [-]
    friction : Friction, optional
        Friction pack; the controls of the element are then pressures in a scenario.

    Examples
    --------
    >>> clutch, brake = ShiftElement(1, 2, name="C"), ShiftElement(2, name="B")
    >>> brake.second
    0
    """

    first: int
    second: int = HOUSING
    name: str = ""
    kind: ElementKind | Literal[""] = ""
    drag: float = 0.0
    capacity: float | None = None
    stiffness: float | None = None
    damping: Damping | float = NO_DAMPING
    static: float = 1.0
    friction: Friction | None = None

    @property
    def links(self) -> tuple[int, int]:
        """First and second link."""
        return self.first, self.second

    @property
    def is_freewheel(self) -> bool:
        """True for a freewheel, which holds or overruns without control."""
        return self.kind == "freewheel"

    @property
    def pack(self) -> Friction | None:
        """Friction pack, if it determines the torque capacity from the pressure."""
        return self.friction if self.friction and self.friction.coefficient else None

    @property
    def heat_store(self) -> Friction | None:
        """Friction pack, if its heat capacity is known."""
        friction = self.friction
        return friction if friction and friction.heat_capacity is not None else None


class Mechanism(NamedTuple):
    """Three-link mechanism with a constant basic ratio, or a variator or converter.

    Parameters
    ----------
    first, second, third : int
        Link numbers; 0 is the housing. In a planetary gear set: sun, ring, carrier.
    ratio : float
        Basic ratio ``(w_first - w_third)/(w_second - w_third)``. For a variator or converter, the
        speed ratio ``w_second/w_first``, of any sign or 0; NaN if each gear gives it. [-]
    efficiency : float
        Basic efficiency, third link held, above 0 and up to 1. [-]
    back_efficiency : float, optional
        Efficiency of power flow from the second link to the first, third link held; by default
        `efficiency`, and 0 if self-locking. [-]
    planet_ratio : float, optional
        Speed ratio of first link to planet, third link held. The default of a plain planetary
        gear set (ratio below 0, not -1) is ``(ratio + 1)/2``; others have no default. [-]
    name : str
        By default ``D`` and the number.
    stiffness : float, optional
        Stiffness for vibration and simulation: torque on the first link divided by the twist, which
        is the sum of (1, -u, u - 1) times the angles of the links. Default: rigid. [N*m/rad]
    damping : Damping or float
        Damping parallel to the stiffness; a number is viscous. [N*m*s/rad]
    is_set : bool
        Whether a mechanism with the housing as third link is a planetary gear set with its
        carrier held, not a gear pair.
    kind : {"variator", "converter"}, optional
        A variator of speed ratio x has the torques of a gear pair of ratio ``1/x``; at x = 0 it
        holds its second link. A converter is a hydrodynamic torque converter.
    points : sequence of (float, float) or (float, float, float)
        Speed ratio and torque ratio ``M_second/M_first`` of a converter [-]. With the pump factor
        lambda [N*m*s^2] as a third number, the load can determine its speed ratio.

    Examples
    --------
    A planetary gear set with its ring held has the ratio 1 - u:

    >>> from vstatics import Gear, ShiftElement, Transmission, solve
    >>> sets = Mechanism(1, 2, 3, ratio=-2.5, name="set")
    >>> solve(Transmission(3, [ShiftElement(2)], [sets], [Gear([1])])).ratio
    array([3.5])
    """

    first: int
    second: int
    third: int
    ratio: float
    efficiency: float = 1.0
    planet_ratio: float | None = None
    name: str = ""
    back_efficiency: float | None = None
    stiffness: float | None = None
    damping: Damping | float = NO_DAMPING
    is_set: bool = False
    kind: MechanismKind | Literal[""] = ""
    points: tuple[tuple[float, ...], ...] = ()

    @property
    def links(self) -> tuple[int, int, int]:
        """First, second and third link."""
        return self.first, self.second, self.third

    def is_plain(self, ratio: Any) -> Any:
        """Return whether a plain planetary gear set can have a basic ratio (a number or an array).

        A plain set has a sun, a ring and single planets. There ``z_planet = (z_ring - z_sun)/2``,
        so the speed ratio of first link to planet is ``(ratio + 1)/2`` with either the sun or the
        ring as first link.
        """
        return (self.third != HOUSING) & (ratio < 0) & (ratio != -1)

    @property
    def can_be_open(self) -> bool:
        """True for a converter with known lambda, whose speed ratio the load can determine."""
        return self.kind == "converter" and bool(self.points) and len(self.points[0]) == 3

    def is_outside(self, ratio: Any) -> Any:
        """Return whether a speed ratio, or each in an array, is outside the converter's points."""
        return (ratio < self.points[0][0]) | (ratio > self.points[-1][0])


def mechanism_of(
    third: int | None = None, speed_ratio: float | None = None, **others: Any
) -> Mechanism:
    """Return the mechanism from the values of its keys in a document.

    A third link of 0 marks a planetary gear set with its carrier held; a gear pair has None.

    Examples
    --------
    >>> mechanism_of(0, first=1, second=2, ratio=1.5).is_set
    True
    >>> mechanism_of(first=1, second=2, ratio=1.5).is_set
    False
    """
    if others.get("kind"):
        others["ratio"] = math.nan if speed_ratio is None else speed_ratio
    return Mechanism(third=third or HOUSING, is_set=third == HOUSING, **others)


def mechanism_fault(
    kind: str = "", ratio: float | None = None, speed_ratio: float | None = None, **others: Any
) -> str:
    """Return a message if values do not suit the kind of a mechanism, else an empty text.

    >>> mechanism_fault("variator", ratio=2.0)
    'read `ratio` of a variator, expected `speed_ratio`'
    """
    if kind and ratio is not None:
        return f"read `ratio` of a {kind}, expected `speed_ratio`"
    if not kind and speed_ratio is not None:
        return "read `speed_ratio`, expected `kind: variator` or `kind: converter` as well"
    if others.get("points") and kind != "converter":
        return "read `points`, expected `kind: converter` as well"
    return ""


def mechanism_record(mechanism: Mechanism) -> dict[str, Any]:
    """Return a mechanism as the arguments of `mechanism_of`."""
    has_third = mechanism.third != HOUSING or mechanism.is_set
    record = {**mechanism._asdict(), "third": mechanism.third if has_third else None}
    if mechanism.kind:
        ratio = record.pop("ratio")
        record["speed_ratio"] = None if math.isnan(ratio) else ratio
    return record


class Load(NamedTuple):
    """Operating point at the input link, for results in rpm, N*m and kW.

    When ``load.speed`` is varied as an array, the array is in rad/s, not in rpm.

    Parameters
    ----------
    speed : float, optional
        Input speed. [rpm]
    torque : float, optional
        Input torque. [N*m]
    power : float, optional
        Power, if the case prescribes it. When the speed changes, the power stays constant and the
        torque is recalculated. [kW]

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, Transmission, solve
    >>> pair = Transmission(2, [], [Mechanism(1, 2, 0, -2.0)], [Gear()], load=Load(3000, 100))
    >>> solve(pair).speeds_rpm, solve(pair).output_torque_Nm
    (array([[ 3000., -1500.]]), array([-200.]))
    """

    speed: float | None = None
    torque: float | None = None
    power: float | None = None

    @property
    def torque_size(self) -> float:
        """Magnitude of the input torque [N*m], or 1 if that is 0; 0 if unknown.

        >>> Load(torque=-300).torque_size, Load(torque=0).torque_size, Load().torque_size
        (300, 1.0, 0.0)
        """
        return 0.0 if self.torque is None else abs(self.torque) or 1.0

    def or_else(self, other: Load) -> Load:
        """Return the operating point with missing values replaced by values of `other`.

        >>> Load(speed=1000).or_else(load_of(speed=2000, power=50)).torque
        477.4648292756861
        """
        if self.torque is not None:
            return self if self.speed is not None else Load(other.speed, self.torque)
        if self.speed is None:
            return other
        if other.power is not None and self.speed:  # a speed of 0 is an error reported elsewhere
            return load_of(self.speed, power=other.power)
        return Load(self.speed, other.torque)


NOMINAL_LOAD = Load(1000.0, 1.0)
"""Arbitrary operating point (1000 rpm, 1 N*m), for results that do not depend on the point."""


NO_LOAD = Load()
"""Operating point of a case that gives neither speed nor torque."""


def load_of(
    speed: float | None = None, torque: float | None = None, power: float | None = None
) -> Load:
    """Return the operating point from up to two of speed [rpm], torque [N*m] and power [kW].

    Raises
    ------
    ValueError
        The message is the result of `load_fault`.

    Examples
    --------
    >>> load_of(speed=3000, power=94.24777960769379).torque
    300.0
    """
    if fault := load_fault(speed, torque, power):
        raise ValueError(fault)
    if power is None:
        return Load(speed, torque)
    if speed is None:
        assert torque is not None  # noqa: S101 - by load_fault; for mypy
        return Load(power / torque / KW_OF_RPM_NM, torque)
    return Load(speed, power / speed / KW_OF_RPM_NM, power)


def load_fault(
    speed: float | None = None, torque: float | None = None, power: float | None = None
) -> str:
    """Return a message if `power` does not define an operating point, else an empty text.

    >>> load_fault(power=90)
    'read `power` alone, expected a speed or a torque as well'
    """
    if power is None:
        return ""
    if speed is not None and torque is not None:
        given = f"{torque:g} N*m at {speed:g} rpm are {speed * torque * KW_OF_RPM_NM:.5g} kW"
        return f"read speed, torque and power, expected two of them: {given}"
    other = torque if speed is None else speed
    if other is None:
        return "read `power` alone, expected a speed or a torque as well"
    if power == 0 or other == 0:
        return "read a power, speed or torque of 0, expected another value"
    return ""


class OfLoad(float):
    """Relative speed or torque that the user wrote with a unit, in rpm or N*m.

    The relative number is recalculated if the operating point of the case changes.

    Parameters
    ----------
    given : float
        Speed [rpm] or torque [N*m] that the user wrote.
    whole : float
        Input speed [rpm] or input torque [N*m] of the operating point, not 0. An input torque of 0
        is replaced by 1 N*m.

    Examples
    --------
    >>> torque = OfLoad(10.0, 100.0)
    >>> torque, torque.by(-200.0), torque.by(None)
    (0.1, -0.05, 0.1)
    """

    given: float
    whole: float

    def __new__(cls, given: float, whole: float) -> Self:
        """Create the number ``given / whole``."""
        number = super().__new__(cls, given / whole)
        number.given, number.whole = given, whole
        return number

    def __getnewargs__(self) -> tuple[float, float]:  # type: ignore[override] # as __new__ asks
        """Return the arguments of the constructor, for pickling."""
        return self.given, self.whole

    def by(self, whole: float | None) -> OfLoad:
        """Return the number relative to another speed or torque, unless that is missing or 0."""
        return OfLoad(self.given, whole) if whole else self


def related(number: float, whole: float | None) -> float:
    """Return an `OfLoad` relative to another input speed or torque; other numbers are unchanged.

    >>> related(OfLoad(10.0, 100.0), 200.0), related(0.1, 200.0)
    (0.05, 0.1)
    """
    return number.by(whole) if isinstance(number, OfLoad) else number


Size = TypeVar("Size", float, "Floats")
"""A number, or an array of numbers."""


class Law(float):
    """Drag torque [N*m], efficiency [-] or loss over speed [rad/s], torque [N*m] or both.

    A law needs an operating point. The float itself is the value at speed or torque 0, for
    calculations without an operating point. A law is always true as a boolean, because it can be
    nonzero elsewhere even if its value at 0 is 0.
    """

    over: Literal["speed", "torque", "both"] = "speed"
    points: tuple[tuple[float, float], ...] = ()
    """Speed [rad/s] or torque [N*m], and the value; only for a `PointLaw`."""
    text: str = ""
    """Text of a law given by a formula; empty for other laws."""
    file: str = ""
    """Name of the file with the points. Laws that differ only in the file name are equal."""

    def at(self, *sizes: Size) -> Size:
        """Return the value at the arguments from `sizes_of`, which are numbers or arrays."""
        raise NotImplementedError

    def is_outside(self, *sizes: Floats) -> Booleans:
        """Return whether the arguments from `sizes_of` are outside the points of the law."""
        raise NotImplementedError

    def domain(self) -> str:
        """Return the range of the points as text for messages."""
        raise NotImplementedError

    def sizes_of(self, speed: Size, torque: Size) -> tuple[Size, ...]:
        """Return the arguments on which the law depends: speed [rad/s], torque [N*m] or both."""
        if self.over == "both":
            return speed, torque
        return (speed,) if self.over == "speed" else (torque,)

    def __bool__(self) -> bool:
        """Return True, because a law whose value at 0 is 0 can be nonzero elsewhere."""
        return True

    @property
    def _definition(self) -> tuple[object, ...]:
        return type(self), self.over, self.points, self.text

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Law) and self._definition == other._definition

    def __ne__(self, other: object) -> bool:
        """Negate `__eq__`; the `__ne__` inherited from float would compare only the value at 0."""
        return not self == other

    def __repr__(self) -> str:
        """Return the full definition, so that cases with different laws have different texts."""
        return f"{type(self).__name__}({self.text or self.points!r}, over={self.over!r})"

    def __hash__(self) -> int:
        return hash(self._definition)


Data = TypeVar("Data")


def with_floats(data: Data) -> Data:
    """Return data with all numbers as floats, and sequences as tuples.

    Texts, None, `Law` and `OfLoad` are unchanged.

    >>> with_floats(Load(1000, power=7)), with_floats([(1, 2), "a", None])
    (Load(speed=1000.0, torque=None, power=7.0), ((1.0, 2.0), 'a', None))
    """
    given: Any = data
    if given is None or isinstance(given, str | Law | OfLoad):
        return data
    if isinstance(given, Sequence) or getattr(given, "ndim", False):
        parts: Any = map(with_floats, given)
        return given._make(parts) if hasattr(given, "_make") else tuple(parts)  # type: ignore[return-value]
    return float(given)  # type: ignore[return-value]


class SpeedOf(NamedTuple):
    """Speed prescribed as a multiple of another link's speed, as for road wheels in a turn.

    Parameters
    ----------
    link : int
        Number of the other link.
    factor : float
        Multiple of the other link's speed, not 0. [-]
    """

    link: int
    factor: float = 1.0


class BatteryBalance(NamedTuple):
    """Power balance of a battery and electric machines, which fixes the torque of one machine.

    Parameters
    ----------
    efficiencies : sequence of pairs
        Link of each machine, and the efficiency of the machine: above 0 and up to 1, or a law over
        the speed of the link and the torque of the machine. [-]
    battery : float
        Power that charges the battery. [kW]
    """

    efficiencies: Sequence[tuple[int, float]]
    battery: float = 0.0


class Gear(NamedTuple):
    """Shift state: the engaged shift elements, and speeds and torques that are prescribed.

    Parameters
    ----------
    engaged : sequence of int
        Numbers of the engaged shift elements.
    speeds : mapping of int to float or SpeedOf
        Prescribed speeds of links other than the input, relative to the input speed or (`SpeedOf`)
        to another link. [-]
    torques : mapping of int to float
        Prescribed external torques on links other than the output, relative to the input torque.
        [-]
    input, output : int, optional
        Input and output link of this gear, by default those of the case.
    name : str
        By default the number of the gear.
    drag : mapping of int to float
        Torque of bearings and oil on links, against their rotation, relative to the
        input torque, instead of the drag of these links in the case. [-]
    open_drag : mapping of int to float
        Drag torque of disengaged shift elements in this gear, by their numbers, instead of
        their `drag`. [-]
    load : Load, optional
        Operating point of this gear, which inherits omitted values from the case.
    input_turns : {"forward", "backward"}, optional
        Direction of rotation of the input, on which freewheels depend, because all speeds are
        relative. By default the sign of the operating point, or forward without it.
    kind : {"gear", "neutral", "point"}
        ``neutral`` marks an intended neutral, for which no warning is given; ``point`` marks an
        operating point of a variable drive. Neither has a step ratio or counts for the ratio
        spread.
    coast : bool, optional
        Whether power enters at the output; by default as in the case, or by the sign of its
        operating point.
    balance : BatteryBalance, optional
        Power balance that determines the torque on one of its links; the torques on its other links
        follow from equilibrium.
    speed_ratios : mapping of int to float
        Speed ratios of variators and converters in this gear, by number. The mechanisms given by
        the case are numbered first, then its `converters`. [-]
    slip : mapping of int to float
        Slip speed (first link minus second) of clutches and brakes that slip under torque, by
        number, relative to the input speed. Their torque follows from equilibrium. [-]
    loss : Law, optional
        Loss measured for the whole gear, over the speed [rad/s] and torque [N*m] of the input link,
        which it brakes.
    holding : tuple of int, optional
        Links whose external torque follows from equilibrium; by default the links with a prescribed
        speed. Only the search for the torque of a `balance` sets this field.
    loss_torques : mapping of int to float
        Torque by which `loss` brakes the input link, relative to the input torque, by link number.
        Only the solver sets this field. [-]
    pump_torques : mapping of int to float
        Torques on the pumps of converters with slipping lock-up clutches, relative to the input
        torque, numbered as in `speed_ratios`. Only the solver sets this field. [-]
    open : sequence of int
        Disengaged converters, which transmit no torque in this gear, numbered as in `speed_ratios`.
    slip_drives : bool
        True if slipping shift elements are allowed to produce power. Only searches set this field,
        on the way to a state in which slipping shift elements absorb power.

    Examples
    --------
    The ring of a planetary gear set turns at half the input speed:

    >>> from vstatics import Mechanism, Transmission, solve
    >>> gear = Gear(speeds={2: 0.5}, name="split")
    >>> solve(Transmission(3, [], [Mechanism(1, 2, 3, -2.0)], [gear])).speeds.round(3)
    array([[1.   , 0.5  , 0.667]])
    """

    engaged: Sequence[int] = ()
    speeds: Mapping[int, float | SpeedOf] = EMPTY
    torques: Mapping[int, float] = EMPTY
    input: int | None = None
    output: int | None = None
    name: str = ""
    drag: Mapping[int, float] = EMPTY
    open_drag: Mapping[int, float] = EMPTY
    load: Load | None = None
    input_turns: Direction | Literal[""] = ""
    kind: GearKind = "gear"
    coast: bool | None = None
    balance: BatteryBalance | None = None
    speed_ratios: Mapping[int, float] = EMPTY
    slip: Mapping[int, float] = EMPTY
    loss: Law | None = None
    holding: tuple[int, ...] | None = None
    loss_torques: Mapping[int, float] = EMPTY
    pump_torques: Mapping[int, float] = EMPTY
    open: Sequence[int] = ()
    slip_drives: bool = False

    @property
    def carrying(self) -> tuple[int, ...]:
        """Numbers of the shift elements that carry torque: engaged, then slipping elements."""
        return (*self.engaged, *self.slip)

    @property
    def joining(self) -> tuple[int, ...]:
        """Numbers of shift elements whose links rotate together: engaged elements, or slip 0."""
        return (*self.engaged, *(number for number, slip in self.slip.items() if slip == 0))

    @property
    def slipping(self) -> tuple[int, ...]:
        """Numbers of the shift elements that slip under torque."""
        return tuple(number for number, slip in self.slip.items() if slip != 0)

    def open_links(self, ends: Sequence[int]) -> list[int]:
        """Return links of the battery balance whose speed and torque are unknown, except `ends`."""
        links = [link for link, _ in self.balance.efficiencies] if self.balance else []
        return [link for link in links if link not in (*ends, *self.speeds, *self.torques)]

    def renumbered(self, numbers: Mapping[int, int]) -> Gear:
        """Return the gear with other numbers of variators and converters, mapped from old to new.

        Variators and converters without a new number are removed from the gear.

        >>> Gear(speed_ratios={1: 0.8, 2: 0.5}, open=[3]).renumbered({2: 4, 3: 5}).open
        (5,)
        """
        ratios = {numbers[n]: i for n, i in self.speed_ratios.items() if n in numbers}
        return self._replace(
            speed_ratios=ratios, open=tuple(numbers[n] for n in self.open if n in numbers)
        )


def element_name(number: int, element: ShiftElement) -> str:
    """Return the default name of a shift element: F for a clutch, T for a brake, L for a freewheel.

    >>> element_name(3, ShiftElement(2, 0))
    'T3'
    """
    if element.is_freewheel:
        return f"L{number}"
    kind = "T" if HOUSING in (element.first, element.second) else "F"
    return f"{kind}{number}"


def element_names(elements: Sequence[ShiftElement]) -> list[str]:
    """Return the names of shift elements, by default from `element_name`."""
    return [
        element.name or element_name(number, element) for number, element in enumerate(elements, 1)
    ]


def mechanism_name(number: int) -> str:
    """Return the default name of a mechanism: D and the number of the mechanism."""
    return f"D{number}"


def mechanism_names(mechanisms: Sequence[Mechanism]) -> list[str]:
    """Return the names of mechanisms, by default from `mechanism_name`."""
    return [
        mechanism.name or mechanism_name(number) for number, mechanism in enumerate(mechanisms, 1)
    ]


class Member(NamedTuple):
    """Member of a gear set, with the mechanism torques whose sum is the torque on the member."""

    name: str
    link: int
    places: tuple[tuple[int, int], ...]
    """For each of the mechanism torques: mechanism index, and index of the link (0 first to 2
    third).
    """


class WheelOfPlanet(NamedTuple):
    """Central gear that meshes with a train of planets."""

    link: int
    mechanism: int
    """Index of a mechanism that contains the gear, to check whether gear and carrier are locked up.
    """
    ratio: float
    """Speed of the gear divided by the speed of the planet train, relative to the carrier. [-]"""


class Planet(NamedTuple):
    """Planet gear, with the data to calculate its speed relative to the carrier."""

    name: str
    mechanism: int = -1
    """Index of the mechanism that determines the speed of the planet; -1 without a mechanism."""
    ratio: float = 0.0
    """Ratio of the mechanism from the tooth numbers. If its ratio is changed, `wheels` do not
    apply. [-]
    """
    wheels: tuple[WheelOfPlanet, ...] = ()
    """Central gears that mesh with the planet; empty if the mechanism's `planet_ratio` applies."""
    carrier: int = 0
    speed: float = 1.0
    """Speed of the planet divided by the speed of its planet train; NaN if teeth are unknown.

    [-]
    """


class OwnDevice(NamedTuple):
    """Gear set or mechanism named in the case; the solver can use several mechanisms for it."""

    name: str
    mechanisms: tuple[int, ...]
    """Indices of the mechanisms that represent the gear set."""
    members: tuple[Member, ...]
    planets: tuple[Planet, ...]
    meshes: tuple[bool, ...] = ()
    """For each mechanism that is a mesh of planets: True if the tooth numbers of its first gear,
    and so the mesh torque, are known.
    """

    @property
    def meshes_by_index(self) -> list[tuple[int, bool]]:
        """Mechanism index of each mesh, and whether the mesh torque is known."""
        return list(zip(self.mechanisms, self.meshes, strict=False))
