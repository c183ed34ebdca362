"""The parts of a transmission: links, elements, mechanisms, gears, and its own devices.

Numbers are as printed in the source: links, shift elements, mechanisms and gears
count from 1, link 0 is the housing. They become indices in `matrix` only.

The solver knows three-link mechanisms, and planets as links. Results are given for what
the case names: here stands how the one follows from the other.
"""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import Any, Literal, NamedTuple, Self, get_args


class Damping(NamedTuple):
    """What resists the rate of a twist.

    Parameters
    ----------
    viscous : float
        Torque by rate of twist. [N*m*s/rad]
    loss_factor : float
        Of the material: at any frequency the damping torque is this part of the elastic one,
        so that a mode of this device alone has half of it as its damping ratio. [-]

    Examples
    --------
    >>> Damping(loss_factor=0.1)
    Damping(viscous=0.0, loss_factor=0.1)
    """

    viscous: float = 0.0
    loss_factor: float = 0.0

    def __bool__(self) -> bool:
        """Whether it resists anything."""
        return self.viscous != 0 or self.loss_factor != 0


NO_DAMPING = Damping()


def damping(given: Damping | float) -> Damping:
    """A damping that may be a number, which is viscous.

    >>> damping(3)
    Damping(viscous=3.0, loss_factor=0.0)
    """
    return Damping(*map(float, given)) if isinstance(given, Damping) else Damping(float(given))


def damping_of(
    viscous: float = 0.0, ratio: float | None = None, loss_factor: float = 0.0
) -> Damping:
    """The damping that one of the three gives; a damping ratio is half of a loss factor.

    >>> damping_of(ratio=0.02)
    Damping(viscous=0.0, loss_factor=0.04)
    """
    return Damping(viscous, loss_factor if ratio is None else 2 * ratio)


def damping_fault(
    viscous: float = 0.0, ratio: float | None = None, loss_factor: float = 0.0
) -> str:
    """Why these do not tell a damping.

    >>> damping_fault(ratio=0.02, loss_factor=0.1)
    'read several of `viscous`, `ratio` and `loss_factor`, expected one of them'
    """
    if ratio is not None and ratio < 0:
        return f"read a ratio of {ratio:g}, expected one of 0 or more"
    if bool(viscous) + (ratio is not None) + bool(loss_factor) < 2:
        return ""
    return "read several of `viscous`, `ratio` and `loss_factor`, expected one of them"


HOUSING = 0
RAD_PER_RPM = math.pi / 30
"""1 rpm. [rad/s]"""
KW_OF_RPM_NM = RAD_PER_RPM / 1000
"""1 N*m at 1 rpm, in kW."""

ElementKind = Literal["clutch", "brake", "dog_clutch", "freewheel"]
"""What a shift element is, where it says so."""
Direction = Literal["forward", "backward"]
"""The way in which an input turns."""
DIRECTIONS: tuple[Direction, ...] = get_args(Direction)
GearKind = Literal["gear", "point"]
"""A gear of the shift pattern, or an operating point, as of a variable drive."""
GEAR_KINDS: tuple[GearKind, ...] = get_args(GearKind)
ELEMENT_KINDS: tuple[ElementKind, ...] = get_args(ElementKind)
MechanismKind = Literal["variator", "converter"]
"""What a mechanism is whose speed ratio may be any number, and is given."""
MECHANISM_KINDS: tuple[MechanismKind, ...] = get_args(MechanismKind)


class CoefficientTable(NamedTuple):
    """Coefficients of friction by slip and temperature: straight between, constant outside."""

    columns: tuple[float, ...]
    """Temperatures in ascending order. [degC]"""
    rows: tuple[tuple[float, ...], ...]
    """Slip [rad/s] in ascending order, each with its coefficient at every temperature [-]."""

    def at(self, temperature: float) -> tuple[tuple[float, float], ...]:
        """Slips with their coefficients at a temperature.

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

    def completed(self) -> CoefficientTable:
        """A checked one with its numbers as floats."""
        rows = tuple(tuple(map(float, row)) for row in self.rows)
        return CoefficientTable(tuple(map(float, self.columns)), rows)


class Friction(NamedTuple):
    """The friction pack of a shift element: its capacity is by pressure, its heat warms it.

    ``capacity = pressure area radius surfaces mu(|slip|)``, and with the power P of its friction
    ``heat_capacity dT/dt = P - cooling (T - ambient)``.
    """

    radius: float = 0.0
    """Mean radius of friction. [m]"""
    area: float = 0.0
    """Of the piston. [m^2]"""
    surfaces: int = 0
    """Pairs of friction surfaces."""
    coefficient: tuple[tuple[float, float], ...] | CoefficientTable = ()
    """Slip [rad/s] in ascending order, each with its coefficient of friction [-]; none: only its
    heat is known. In a scenario it may depend on temperature."""
    heat_capacity: float | None = None
    """[J/K]"""
    cooling: float = 0.0
    """[W/K]"""
    ambient: float = 0.0
    """Temperature at which it begins, and to which it is cooled. [degC]"""

    @property
    def per_pressure(self) -> float:
        """``area radius surfaces``: the capacity by the pressure, for a coefficient of 1 [m^3]."""
        return self.area * self.radius * self.surfaces

    @property
    def table(self) -> CoefficientTable | None:
        """The coefficient, if it depends on temperature."""
        return self.coefficient if isinstance(self.coefficient, CoefficientTable) else None

    @property
    def points(self) -> tuple[tuple[float, float], ...]:
        """Slips with their coefficients, where it is as warm as at the beginning."""
        if isinstance(self.coefficient, CoefficientTable):
            return self.coefficient.at(self.ambient)
        return self.coefficient

    def completed(self) -> Friction:
        """A checked one with its numbers as floats."""
        table = self.table
        points = tuple((float(slip), float(coefficient)) for slip, coefficient in self.points)
        heat = None if self.heat_capacity is None else float(self.heat_capacity)
        return Friction(
            float(self.radius),
            float(self.area),
            int(self.surfaces),
            table.completed() if table else points,
            heat,
            float(self.cooling),
            float(self.ambient),
        )


class ShiftElement(NamedTuple):
    """A clutch joins two links; a brake joins a link to the housing (0).

    Parameters
    ----------
    first, second : int
        Link numbers; 0 is the housing.
    name : str
        A letter and the number when not given; see `element_name`.
    kind : {"clutch", "brake", "dog_clutch", "freewheel"}, optional
        A brake if the housing is one of its links, else a clutch, when not given. A
        freewheel keeps its first link from turning backward against the second; it is
        never engaged, but finds by itself whether it holds.
    drag : float
        Torque with which it drags when open, relative to the input torque. [-]
    capacity : float, optional
        Torque that it can carry, relative to the input torque of the case's load. Nothing
        is calculated with it but margins. [-]
    stiffness : float, optional
        When it is engaged, for vibration; rigid when not given. [N*m/rad]
    damping : Damping or float
        Beside the stiffness; a number is viscous. [N*m*s/rad]
    static : float
        Up to which part of its kinetic capacity it sticks, 1 or more. [-]
    friction : Friction, optional
        In a scenario its controls are then pressures.

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
        """The first and second link."""
        return self.first, self.second

    @property
    def is_freewheel(self) -> bool:
        """Whether it finds by itself whether it holds."""
        return self.kind == "freewheel"

    @property
    def pack(self) -> Friction | None:
        """Its friction, if that tells its capacity by the pressure."""
        return self.friction if self.friction and self.friction.coefficient else None

    @property
    def heat_store(self) -> Friction | None:
        """Its friction, if that tells its temperature."""
        friction = self.friction
        return friction if friction and friction.heat_capacity is not None else None


class Mechanism(NamedTuple):
    """A three-link device of constant structure; a variator or converter between two links.

    Parameters
    ----------
    first, second, third : int
        Link numbers; 0 is the housing. In a planetary set: sun, ring, carrier.
    ratio : float
        ``(w_first - w_third)/(w_second - w_third)``, the internal ratio. Of a variator or
        converter the speed ratio ``w_second/w_first``, of any sign, 0 too; NaN where gears give
        it. [-]
    efficiency : float
        With the third link held still, above 0 and up to 1. [-]
    back_efficiency : float, optional
        The same where power flows from the second link to the first (seen from the
        third); `efficiency` when not given. 0: self-locking. [-]
    planet_ratio : float, optional
        First link to planet, third link held. Without it a plain planetary set
        (ratio below 0, not -1) has ``(ratio + 1)/2``, any other has none. [-]
    name : str
        ``D`` and the number when not given.
    stiffness : float, optional
        Torque on its first link by the twist of its row (1, -u, u - 1), for vibration; rigid
        when not given. [N*m/rad]
    damping : Damping or float
        Beside the stiffness; a number is viscous. [N*m*s/rad]
    is_set : bool
        With the housing as third link: whether it is a planetary set with its carrier held, not
        a pair of wheels.
    kind : {"variator", "converter"}, optional
        A variator divides power as a pair of wheels of the ratio ``1/x`` would; one with the
        speed ratio x = 0 holds its second link. A converter is hydrodynamic.
    points : sequence of (float, float) or (float, float, float)
        Of a converter: speed ratio, torque ratio ``M_second/M_first`` [-], and perhaps lambda, by
        which a `Converter` has its torque [N*m*s^2].

    Examples
    --------
    A set with its ring held has the ratio 1 - u:

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
        """The first, second and third link."""
        return self.first, self.second, self.third

    def is_plain(self, ratio: Any) -> Any:
        """Whether a set of this internal ratio, or of each in an array, can be a plain one.

        Then ``z_planet = (z_ring - z_sun)/2``, so the ratio first link to planet is
        ``(ratio + 1)/2``, with the sun or with the ring as first link.
        """
        return (self.third != HOUSING) & (ratio < 0) & (ratio != -1)

    @property
    def can_be_open(self) -> bool:
        """Whether it is a converter whose torque at the pump is known: its points have lambda."""
        return self.kind == "converter" and bool(self.points) and len(self.points[0]) == 3

    def is_outside(self, ratio: Any) -> Any:
        """Whether a speed ratio, or each of an array, lies outside the points of a converter."""
        return (ratio < self.points[0][0]) | (ratio > self.points[-1][0])


def mechanism_of(
    third: int | None = None, speed_ratio: float | None = None, **others: Any
) -> Mechanism:
    """The mechanism of what a case gives: the housing as third link is the carrier of a set.

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
    """Why the numbers of a mechanism are not those of its kind.

    >>> mechanism_fault("variator", ratio=2.0)
    'read `ratio` of a variator, expected `speed_ratio`'
    """
    if kind and ratio is not None:
        return f"read `ratio` of a {kind}, expected `speed_ratio`"
    if not kind and speed_ratio is not None:
        return "read `speed_ratio`, expected `kind: variator` or `kind: converter` beside it"
    if others.get("points") and kind != "converter":
        return "read `points`, expected `kind: converter` beside them"
    return ""


def mechanism_record(mechanism: Mechanism) -> dict[str, Any]:
    """What `mechanism_of` takes."""
    has_third = mechanism.third != HOUSING or mechanism.is_set
    record = {**mechanism._asdict(), "third": mechanism.third if has_third else None}
    if mechanism.kind:
        ratio = record.pop("ratio")
        record["speed_ratio"] = None if math.isnan(ratio) else ratio
    return record


class Load(NamedTuple):
    """What enters at the input link: with it there are results in rpm, N*m and kW.

    Where it varies, arrays of ``load.speed`` are in rad/s: 2000 rpm are ``2000 * math.pi / 30``.

    Parameters
    ----------
    speed : float, optional
        [rpm]
    torque : float, optional
        [N*m]
    power : float, optional
        That which gave the torque, beside it: it stays where the speed is another. [kW]

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
        """What drag is related to: the torque without sign, 1 N*m beside none, 0 if not told.

        >>> Load(torque=-300).torque_size, Load(torque=0).torque_size, Load().torque_size
        (300, 1.0, 0.0)
        """
        return 0.0 if self.torque is None else abs(self.torque) or 1.0

    def or_else(self, other: Load) -> Load:
        """The load with what it leaves open as in another.

        >>> Load(speed=1000).or_else(load_of(speed=2000, power=50)).torque
        477.4648292756861
        """
        if self.torque is not None:
            return self if self.speed is not None else Load(other.speed, self.torque)
        if self.speed is None:
            return other
        if other.power is not None and self.speed:  # at a speed of 0, which is refused, is none
            return load_of(self.speed, power=other.power)
        return Load(self.speed, other.torque)


def load_of(
    speed: float | None = None, torque: float | None = None, power: float | None = None
) -> Load:
    """The load of two of the three: speed [rpm], torque [N*m], power [kW].

    Raises
    ------
    ValueError
        With what `load_fault` says.

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
        assert torque is not None  # noqa: S101 - for mypy: no fault
        return Load(power / torque / KW_OF_RPM_NM, torque)
    return Load(speed, power / speed / KW_OF_RPM_NM, power)


def load_fault(
    speed: float | None = None, torque: float | None = None, power: float | None = None
) -> str:
    """Why a load cannot be told by these: power alone, beside both others, 0, or beside 0.

    >>> load_fault(power=90)
    'read `power` alone, expected a speed or a torque beside it'
    """
    if power is None:
        return ""
    if speed is not None and torque is not None:
        told = f"{torque:g} N*m at {speed:g} rpm are {speed * torque * KW_OF_RPM_NM:.5g} kW"
        return f"read speed, torque and power, expected two of them: {told}"
    other = torque if speed is None else speed
    if other is None:
        return "read `power` alone, expected a speed or a torque beside it"
    if power == 0 or other == 0:
        return "read a power, speed or torque of 0, expected another one"
    return ""


class OfLoad(float):
    """A speed or torque relative to that of a load, which was given with a unit and keeps it.

    A case with another load, or that coasts, has another number for the same speed or torque.

    Parameters
    ----------
    given : float
        [rpm] or [N*m]
    whole : float
        Of the load, in the same unit; other than 0, which stands for 1 N*m.

    Examples
    --------
    >>> torque = OfLoad(10.0, 100.0)
    >>> torque, torque.by(-200.0), torque.by(None)
    (0.1, -0.05, 0.1)
    """

    given: float
    whole: float

    def __new__(cls, given: float, whole: float) -> Self:
        """Keep what the number was made from."""
        made = super().__new__(cls, given / whole)
        made.given, made.whole = given, whole
        return made

    def __getnewargs__(self) -> tuple[float, float]:  # type: ignore[override] # as __new__ asks
        """For another process."""
        return self.given, self.whole

    def by(self, whole: float | None) -> OfLoad:
        """The same by another load; as it is where there is none."""
        return OfLoad(self.given, whole) if whole else self


def related(number: float, whole: float | None) -> float:
    """A number by a load [rpm, N*m] if it was given with a unit; any other is left as it is.

    >>> related(OfLoad(10.0, 100.0), 200.0), related(0.1, 200.0)
    (0.05, 0.1)
    """
    return number.by(whole) if isinstance(number, OfLoad) else number


class Law(float):
    """A drag over a speed [N*m, rad/s], or an efficiency over a speed or torque [-, N*m].

    It is asked with magnitudes, and needs a load. As a number it is its value at 0, for all that
    knows no load. As a truth value it is true: its value at 0 says nothing of its other values.
    """

    over: Literal["speed", "torque"] = "speed"
    points: tuple[tuple[float, float], ...] = ()
    """If it is made of points."""
    text: str = ""
    """If it is a formula."""
    file: str = ""
    """From which its points were read; two that have the same points are equal."""

    def at(self, size: Any) -> Any:
        """Its value at a speed or torque, or at each of an array."""
        raise NotImplementedError

    def __bool__(self) -> bool:
        """Whether it can be other than 0."""
        return True

    @property
    def _told(self) -> tuple[Any, ...]:
        return type(self), self.over, self.points, self.text

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Law) and self._told == other._told

    def __ne__(self, other: object) -> bool:
        """As `__eq__` says; a float has its own."""
        return not self == other

    def __repr__(self) -> str:
        """All that it is: what is known by its text must not take it for a number."""
        return f"{type(self).__name__}({self.text or self.points!r}, over={self.over!r})"

    def __hash__(self) -> int:
        return hash(self._told)


def as_float(number: float) -> float:
    """A number as a float; a law, or a number with a unit, as it is."""
    return number if isinstance(number, Law | OfLoad) else float(number)


class SpeedOf(NamedTuple):
    """A speed that is given by that of another link, as on a curve or by a differential.

    Parameters
    ----------
    link : int
        The other link.
    factor : float
        By which its speed is multiplied, other than 0. [-]
    """

    link: int
    factor: float = 1.0


class BatteryBalance(NamedTuple):
    """What machines on links give to a battery, which tells the torque of one of them.

    Parameters
    ----------
    efficiencies : sequence of pairs
        Link, and the efficiency of its machine, above 0 and up to 1. [-]
    battery : float
        Power that charges it. [kW]
    """

    efficiencies: Sequence[tuple[int, float]]
    battery: float = 0.0


class Gear(NamedTuple):
    """A shift state: what is engaged, and what is given besides.

    Parameters
    ----------
    engaged : sequence of int
        Numbers of the engaged shift elements.
    speeds : mapping of int to float or SpeedOf
        Further given link speeds, relative to the input speed, or to that of another link. [-]
    torques : mapping of int to float
        Further external torques on links, relative to the input torque. [-]
    input, output : int, optional
        This gear's own input and output link.
    name : str
        The gear's number when not given.
    drag : mapping of int to float
        Torque of bearings and oil on links, against their rotation, relative to the
        input torque, instead of the drag of these links in the case. [-]
    open_drag : mapping of int to float
        Number of a shift element -> torque with which it drags in this gear when it is
        open, in place of its own `drag`. [-]
    load : Load, optional
        This gear's own; what it leaves open is as in the case.
    input_turns : {"forward", "backward"}, optional
        The way in which the input turns, for freewheels: all speeds are relative to it. As
        the load says when not given, and forward if that says nothing either.
    kind : {"gear", "point"}
        An operating point has no step to another, and no part in the spread.
    coast : bool, optional
        Power enters at the output; as the case or the sign of its load says when not given.
    balance : BatteryBalance, optional
        The torque of one of its links is found; those of the others follow from equilibrium.
    speed_ratios : mapping of int to float
        Number of a variator or converter among the mechanisms that the case gives, behind which
        its `converters` stand -> its speed ratio in this gear, in place of its own. [-]
    holding : tuple of int, optional
        Links whose external torque follows from equilibrium; those with a given speed when not
        given. The search for the torque of a `balance` sets it.

    Examples
    --------
    The ring of a set turns at half the input speed:

    >>> from vstatics import Mechanism, Transmission, solve
    >>> gear = Gear(speeds={2: 0.5}, name="split")
    >>> solve(Transmission(3, [], [Mechanism(1, 2, 3, -2.0)], [gear])).speeds.round(3)
    array([[1.   , 0.5  , 0.667]])
    """

    engaged: Sequence[int] = ()
    speeds: Mapping[int, float | SpeedOf] = MappingProxyType({})
    torques: Mapping[int, float] = MappingProxyType({})
    input: int | None = None
    output: int | None = None
    name: str = ""
    drag: Mapping[int, float] = MappingProxyType({})
    open_drag: Mapping[int, float] = MappingProxyType({})
    load: Load | None = None
    input_turns: Direction | Literal[""] = ""
    kind: GearKind = "gear"
    coast: bool | None = None
    balance: BatteryBalance | None = None
    speed_ratios: Mapping[int, float] = MappingProxyType({})
    holding: tuple[int, ...] | None = None

    def open_links(self, ends: Sequence[int]) -> list[int]:
        """Links of its balance that have neither speed nor torque, and are none of its ends."""
        links = [link for link, _ in self.balance.efficiencies] if self.balance else []
        return [one for one in links if one not in (*ends, *self.speeds, *self.torques)]


def element_name(number: int, element: ShiftElement) -> str:
    """The name of an element that has none: F for a clutch, T for a brake, L for a freewheel.

    >>> element_name(3, ShiftElement(2, 0))
    'T3'
    """
    if element.is_freewheel:
        return f"L{number}"
    kind = "T" if HOUSING in (element.first, element.second) else "F"
    return f"{kind}{number}"


def element_names(elements: Sequence[ShiftElement]) -> list[str]:
    """Their names, as they will be filled in."""
    return [one.name or element_name(number, one) for number, one in enumerate(elements, 1)]


def mechanism_name(number: int) -> str:
    """The name of a mechanism that has none: D and its number."""
    return f"D{number}"


def mechanism_names(mechanisms: Sequence[Mechanism]) -> list[str]:
    """Their names, as they will be filled in."""
    return [one.name or mechanism_name(number) for number, one in enumerate(mechanisms, 1)]


class Member(NamedTuple):
    """A member of a device: its link, and what the torque on it adds up from."""

    name: str
    link: int
    places: tuple[tuple[int, int], ...]
    """Index of a mechanism, and which of its links this is: 0 first, 1 second, 2 third."""


class WheelOfPlanet(NamedTuple):
    """A wheel that turns a train of planets."""

    link: int
    mechanism: int
    """Index of one that it belongs to: there it is seen whether wheel and carrier are one piece."""
    ratio: float
    """Speed of the wheel by that of the train, both against the carrier. [-]"""


class Planet(NamedTuple):
    """A planet, and what its speed against its carrier follows from."""

    name: str
    mechanism: int = -1
    """Index of the mechanism whose ratio it follows; -1: of none."""
    ratio: float = 0.0
    """That of the mechanism by the teeth; with another, as in a sweep, the wheels do not count."""
    wheels: tuple[WheelOfPlanet, ...] = ()
    """None: the mechanism has the planet's ratio."""
    carrier: int = 0
    speed: float = 1.0
    """By that of its train; NaN if its teeth are not known. [-]"""


class OwnDevice(NamedTuple):
    """A mechanism or a drawn element, as the case names it."""

    name: str
    mechanisms: tuple[int, ...]
    """Indices of those that it became."""
    members: tuple[Member, ...]
    planets: tuple[Planet, ...]
    meshes: tuple[bool, ...] = ()
    """Where its mechanisms are meshes with planets as links: whether the teeth of the first
    wheel of each are known, so that its torque is."""

    @property
    def meshes_by_index(self) -> list[tuple[int, bool]]:
        """Index of each mesh among the mechanisms, and whether its torque is known."""
        return list(zip(self.mechanisms, self.meshes, strict=False))
