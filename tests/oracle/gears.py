"""The independent oracle: a gear of a transmission in exact rational arithmetic.

Source: Algin V.B., "Schematization and calculation of mobile machine presented
as multibody system. Kinematics and quasistatics". It shares the classes of the
model with the program, and nothing else.

Inputs are read as the decimals that they show: -2.461 is exactly -2461/1000
(`oracle_linear.exact`). Every quantity is a Fraction if a consistent system
determines it, else None. The speed system and the torque system stand each for
itself. One without a solution determines nothing: all its quantities are None,
the torque of an element that is not engaged as well. Losses need both to have
a solution; else signs, losses and all lossy quantities are None.

Where the flow through a mechanism is not determined (redundancy with relative
motion) its sign is None. With an efficiency of 1 that does not matter; else a
lossy quantity is given if every guess of such signs leads to the same value,
nothing if one leads to an efficiency of 0 or less, and `consistent` is None.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction

from tests.oracle.linear import exact
from tests.oracle.losses import Flow, Signs, Trial, balance, best, every_guess, trials
from tests.oracle.systems import Speeds, Torques, Values, ratios
from vstatics.core.model.transmission import HOUSING, Gear, Mechanism, Transmission


@dataclass(frozen=True)
class OracleTorques:
    """Torques on the first links of the devices, and Mx."""

    elements: Values
    mechanisms: Values
    output: Fraction | None

    @property
    def listed(self) -> Values:
        """In the order of the printed table: elements, mechanisms, Mx."""
        return (*self.elements, *self.mechanisms, self.output)


@dataclass(frozen=True)
class OracleGear:
    """All results of one gear; see the module for what None means."""

    speeds: Values
    planet_speeds: Values
    slip_speeds: Values
    ratio: Fraction | None
    torques: OracleTorques
    holding_torques: Mapping[int, Fraction | None]
    missing: int
    free_links: tuple[int, ...]
    excess: int
    tied_up: bool
    lossy_torques: OracleTorques
    lossy_holding_torques: Mapping[int, Fraction | None]
    efficiency: Fraction | None = None
    power_sign: Signs = ()
    idle: tuple[bool | None, ...] = ()
    losses: Values = ()
    power_balance: Fraction | None = None
    consistent: bool | None = None
    locked: bool = False
    turned: bool = False
    """The signs are not those of the ideal flow."""
    several: bool = False
    """The search found more than one admissible set of signs."""
    ideal_torques_exist: bool = field(default=True)
    """The torque system without losses has a solution (not: only one)."""


def solve(case: Transmission) -> list[OracleGear]:
    """All gears of a transmission."""
    return [solve_gear(case, gear) for gear in case.gears]


def flow_of(case: Transmission, gear: Gear) -> Flow:
    """Speeds and ideal torques of one gear."""
    return Flow(case, gear, Speeds(case, gear), Torques(case, gear, ratios(case)))


def solve_gear(case: Transmission, gear: Gear) -> OracleGear:
    """One gear."""
    flow = flow_of(case, gear)
    if not (flow.speeds.system.consistent and flow.ideal.system.consistent):
        return _without_losses(flow)
    if flow.open:
        return _guessed(flow)
    return _decided(flow)


def planet_ratio(mechanism: Mechanism) -> Fraction | None:
    """First link to planet, third held: as given, or (u + 1)/2 of a plain set."""
    if mechanism.planet_ratio is not None:
        return exact(mechanism.planet_ratio)
    ratio = exact(mechanism.ratio)
    plain = mechanism.third != HOUSING and ratio < 0 and ratio != -1
    return (ratio + 1) / 2 if plain else None


def _planet_speed(mechanism: Mechanism, relative: Fraction | None) -> Fraction | None:
    ratio = planet_ratio(mechanism)
    return None if ratio is None or relative is None else relative / ratio


def _listed(torques: Torques) -> OracleTorques:
    return OracleTorques(
        tuple(torques.element(n) for n in range(1, torques.elements + 1)),
        tuple(torques.mechanism(k) for k in range(torques.mechanisms)),
        torques.mx(),
    )


def _holding(torques: Torques) -> dict[int, Fraction | None]:
    return {link: torques.system.unknown(i) for link, i in torques.holding.items()}


def _without_losses(flow: Flow, **lossy: object) -> OracleGear:
    """Speeds and ideal torques, with the lossy results of the other functions."""
    case, gear, speeds, ideal = flow.case, flow.gear, flow.speeds, flow.ideal
    out = speeds.link(case.gear_output(gear))
    entered = speeds.link(case.gear_input(gear))
    nothing: Values = (None,) * len(case.mechanisms)
    values: dict[str, object] = {
        "speeds": tuple(speeds.link(link) for link in range(1, case.links + 1)),
        "planet_speeds": tuple(map(_planet_speed, case.mechanisms, flow.relative)),
        "slip_speeds": tuple(speeds.difference(e.first, e.second) for e in case.shift_elements),
        "ratio": entered / out if out and entered is not None else None,
        "torques": _listed(ideal),
        "holding_torques": _holding(ideal),
        "missing": speeds.system.missing,
        "free_links": tuple(index + 1 for index in speeds.system.loose()),
        "excess": speeds.system.excess,
        "tied_up": not speeds.system.consistent,
        "ideal_torques_exist": ideal.system.consistent,
        "lossy_torques": OracleTorques((None,) * len(case.shift_elements), nothing, None),
        "lossy_holding_torques": dict.fromkeys(ideal.holding),
        "power_sign": nothing,
        "idle": nothing,
        "losses": nothing,
    }
    return OracleGear(**(values | lossy))  # type: ignore[arg-type]


def _idle(flow: Flow) -> tuple[bool | None, ...]:
    """Which mechanisms carry no power, None where that is not determined."""
    return tuple(None if power is None else power == 0 for power in flow.powers)


def _decided(flow: Flow) -> OracleGear:
    """Ideal signs if they are admissible, else the best of all others, else locked."""
    found = [trial for trial in trials(flow, turned=False) if trial.admissible]
    turned = not found
    if turned:
        found = [trial for trial in trials(flow, turned=True) if trial.admissible]
    idle = _idle(flow)
    if not found:
        return _without_losses(
            flow, idle=idle, power_sign=flow.closed_form, consistent=False, locked=True
        )
    trial = best(found)
    return _without_losses(
        flow,
        idle=idle,
        power_sign=trial.signs,
        consistent=True,
        turned=turned,
        several=turned and len(found) > 1,
        **_lossy(flow, trial),
    )


def _lossy(flow: Flow, trial: Trial) -> dict[str, object]:
    return {
        "lossy_torques": _listed(trial.torques),
        "lossy_holding_torques": _holding(trial.torques),
        "efficiency": flow.told_eta(trial.torques),
        "losses": trial.losses,
        "power_balance": balance(flow, trial),
    }


def _guessed(flow: Flow) -> OracleGear:
    """What all guesses of the unknown signs agree on."""
    idle = _idle(flow)
    guesses = every_guess(flow)
    if any(trial.eta is not None and trial.eta <= 0 for trial in guesses):
        return _without_losses(flow, idle=idle, power_sign=flow.closed_form)
    listed = [_listed(trial.torques) for trial in guesses]
    holding = [_holding(trial.torques) for trial in guesses]

    def same(values: Callable[[int], Fraction | None]) -> Fraction | None:
        return _agreed([values(i) for i in range(len(guesses))])

    def each(rows: Sequence[Values]) -> Values:
        return tuple(_agreed(column) for column in zip(*rows, strict=True))

    return _without_losses(
        flow,
        idle=idle,
        power_sign=flow.closed_form,
        lossy_torques=OracleTorques(
            each([torques.elements for torques in listed]),
            each([torques.mechanisms for torques in listed]),
            same(lambda i: listed[i].output),
        ),
        lossy_holding_torques={
            link: _agreed([one[link] for one in holding]) for link in flow.ideal.holding
        },
        efficiency=same(lambda i: flow.told_eta(guesses[i].torques)),
        losses=each([trial.losses for trial in guesses]),
    )


def _agreed(values: Sequence[Fraction | None]) -> Fraction | None:
    """The value that all of them are, else None."""
    return values[0] if len(set(values)) == 1 else None
