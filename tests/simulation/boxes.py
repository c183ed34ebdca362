"""Boxes and scenarios whose motion is known: the planetary set, the box of seven links.

Source: V. P. Tarasik, Planetary gearbox simulation (in Russian), Vestnik BRU 2018:
figures 1 to 4. The inertias of the box of seven links and its programme of shifts are chosen.
"""

from collections.abc import Mapping

from vstatics import Gear, Mechanism, ShiftElement, Transmission
from vstatics.simulation import Capacity, Formula, Points, Scenario, Start, constant

K1 = -67 / 33
RPM = 0.10471975511965977
"""1 rpm in rad/s, pi/30."""


def points(*pairs: tuple[float, float]) -> Points:
    x, y = zip(*pairs, strict=True)
    return Points(tuple(map(float, x)), tuple(map(float, y)))


def capacity(*pairs: tuple[float, float]) -> Capacity:
    return Capacity(points(*pairs))


def held(value: float) -> Capacity:
    return Capacity(constant(value))


def planetary_set(efficiency: float = 1.0, **inertias: float) -> Transmission:
    """The set of figure 1: sun a in, carrier h out, ring b; brake F1, lock-up clutch F2."""
    given = {"a": 0.5, "h": 0.8, "b": 0.7} | inertias
    elements = [ShiftElement(3, 0, "F1"), ShiftElement(1, 3, "F2")]
    gears, sets = [Gear([1], name="1"), Gear([2], name="2")], [Mechanism(1, 3, 2, -1.5, efficiency)]
    own = dict(enumerate(given.values(), 1))
    return Transmission(3, elements, sets, gears, output=2, link_names=[*given], inertias=own)


def of_set(
    case: Transmission,
    speeds: Mapping[int, float],
    controls: Mapping[int, Capacity],
    torques: tuple[float, float],
    duration: float = 1.0,
) -> Scenario:
    loads = ((1, constant(torques[0])), (2, constant(-torques[1])))
    return Scenario(case, duration, Start(speeds=speeds), controls, loads)


def first_gear(case: Transmission | None = None, duration: float = 1.0) -> Scenario:
    """The brake of gear 1 stops the ring: 500 rpm in, output standing, 40 and 60 N*m."""
    speeds = {1: 500 * RPM, 2: 0.0}
    return of_set(case or planetary_set(), speeds, {1: held(120)}, (40, 60), duration)


def second_gear(case: Transmission | None = None, duration: float = 0.5) -> Scenario:
    """The lock-up clutch of gear 2: 1500 and 600 rpm, 200 and 250 N*m."""
    speeds = {1: 1500 * RPM, 2: 600 * RPM}
    return of_set(case or planetary_set(), speeds, {2: held(300)}, (200, 250), duration)


BOX_INERTIAS = (3.6, 0.5, 0.2, 0.4, 0.7, 0.5, 41.2)
BOX_GEARS = ("FH F1", "FB F1", "FH F2", "FB F2", "FH F3", "FB F3", "FH FR", "FB FR")
BOX_RATIOS = (4, 2.68, 2.010050, 1.346734, 1, 0.67, -5.12, -3.4304)


def box(efficiency: float = 1.0) -> Transmission:
    """Splitter and three sets of figure 4: seven links, six shift elements, eight gears.

    Links: in = h0, x = b0 = a1 = a2, a0, b1, h1 = b2 = a3, b3, out = h2 = h3.
    """
    names = ["FH", "FB", "F1", "F2", "F3", "FR"]
    ends = ((1, 3), (3, 0), (5, 0), (4, 0), (2, 5), (6, 0))
    elements = [ShiftElement(*two, name) for two, name in zip(ends, names, strict=True)]
    members = ((3, 2, 1, K1), (2, 4, 5, K1), (2, 5, 7, -3.0), (5, 6, 7, -2.04))
    sets = [Mechanism(*one, efficiency) for one in members]
    gears = [Gear([names.index(one) + 1 for one in gear.split()], name=gear) for gear in BOX_GEARS]
    links, inertias = ["in", "x", "a0", "b1", "h1", "b3", "out"], dict(enumerate(BOX_INERTIAS, 1))
    return Transmission(7, elements, sets, gears, link_names=links, inertias=inertias)


def run_of_box(efficiency: float = 1.0, duration: float = 6.0) -> Scenario:
    """Start in gear 1, shift of the splitter, double shift: six seconds."""
    controls = {
        1: capacity((0, 3000), (2, 3000), (2, 0), (4, 0), (4.3, 3000)),
        2: capacity((1.9, 0), (2.2, 3000), (4, 3000), (4, 0)),
        3: capacity((0, 0), (0.4, 9000), (4.05, 9000), (4.05, 0)),
        4: capacity((3.9, 0), (4.3, 6000)),
    }
    loads = (1, constant(1500)), (7, Formula("-1200*tanh(speed/0.05)"))
    start = Start(speeds={1: 60.0, 7: 0.0}, engaged=(1,))
    return Scenario(box(efficiency), duration, start, controls, loads)
