"""Checks of links, shift elements, mechanisms, gears and operating points of a case.

Each check yields a `Problem` for every fault, with the path of the value.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import pairwise

from vstatics.core.arguments import type_and_value
from vstatics.core.errors import Path, Problem, count_of, percent
from vstatics.core.model.fields import TransmissionFields
from vstatics.core.model.parts import (
    DIRECTIONS,
    ELEMENT_KINDS,
    GEAR_KINDS,
    HOUSING,
    KW_OF_RPM_NM,
    MECHANISM_KINDS,
    NO_LOAD,
    CoefficientTable,
    Friction,
    Gear,
    Law,
    Load,
    Mechanism,
    OfLoad,
    ShiftElement,
    SpeedOf,
    mechanism_names,
)
from vstatics.core.numerics.tolerances import SAME_POWER


def called(case: TransmissionFields, link: int) -> str:
    """Return the name of a link in messages, or its number if it has no name."""
    if link == HOUSING:
        return "0 (the housing)"
    return case.link_names[link - 1] if 0 < link <= len(case.link_names) else str(link)


def is_number(number: object, last: int, first: int = HOUSING) -> bool:
    """Return whether an object is an integer from `first` to `last`, such as a link number."""
    return hasattr(number, "__index__") and first <= number <= last  # type: ignore[operator]


def of_number(identity: str, number: object, noun: str, last: int, path: Path) -> list[Problem]:
    """Return a problem if an object is not the number of a part, from 1 to `last`."""
    if is_number(number, last, 1):
        return []
    return [
        Problem(identity, f"read {number!r}, expected the number of {noun}, from 1 to {last}", path)
    ]


def expect(number: float, what: str, path: Path, *, right: bool) -> Iterator[Problem]:
    """Yield a problem unless `right` is true; `what` states the expected number."""
    if not right:
        read = f"{number:g}"
        if float(read) != number and float(read).is_integer():  # 1.0000001 is not 1
            read = repr(float(number))
        yield Problem("E216", f"read {read}, expected {what}", path)


def of_link(link: int, path: Path, links: int, lowest: int = HOUSING) -> Iterator[Problem]:
    """Check the number of a link."""
    if not is_number(link, links, lowest):
        expected = f"a link number from 1 to {links}"
        if lowest == HOUSING:
            expected += " (0 is the housing)"
        housing = " (the housing)" if link == HOUSING else ""
        yield Problem("E217", f"read {link!r}{housing}, expected {expected}", path)


def of_element(case: TransmissionFields, element: ShiftElement, path: Path) -> Iterator[Problem]:
    """Check the links, kind, drag torque, capacity and friction of a shift element."""
    first, second, links = element.first, element.second, case.own_links
    yield from of_link(first, (*path, "first"), links)
    yield from of_link(second, (*path, "second"), links)
    if first == second:
        message = f"connects link {called(case, first)} to itself, expected two different links"
        yield Problem("E218", message, (*path, "second"))
    elif element.kind:
        yield from _kind(element, (*path, "kind"))
    yield from of_drag(element.drag, element, (*path, "drag"))
    if (capacity := element.capacity) is not None:
        given = capacity.given if isinstance(capacity, OfLoad) else capacity
        place = (*path, "capacity")
        yield from expect(capacity, "a torque above 0", place, right=0 < given < math.inf)
    static = element.static
    yield from expect(static, "1 or more", (*path, "static"), right=1 <= static < math.inf)
    if element.friction is not None:
        yield from of_friction(element.friction, (*path, "friction"))


def of_friction(friction: Friction, path: Path) -> Iterator[Problem]:
    """Check the dimensions, coefficients and heat capacity of a friction pack.

    Examples
    --------
    >>> [problem] = of_friction(Friction(0.1, 0.006, 8, ((3, 0.12), (1, 0.1))), ())
    >>> print(problem.message)
    read 1, expected a slip of 3 rad/s or more: slips must ascend
    """
    if friction.heat_capacity is not None:
        yield from _of_heat(friction, path)
        if not any(friction[:4]):
            return
    for name, noun in (("radius", "a radius"), ("area", "an area")):
        size = getattr(friction, name)
        yield from expect(size, f"{noun} above 0", (*path, name), right=0 < size < math.inf)
    surfaces = friction.surfaces
    right = surfaces >= 1 and surfaces == int(surfaces)
    yield from expect(
        surfaces, "a whole number of surfaces from 1", (*path, "surfaces"), right=right
    )
    here = (*path, "coefficient")
    table = friction.table
    rows: Sequence[tuple[float, ...]] = table.rows if table else friction.points
    if table:
        yield from _of_temperatures(table, friction.heat_capacity, here)
        here = (*here, "rows")
    if not rows:
        yield Problem("E219", "read no points, expected at least one", here)
    least = 0.0
    for number, row in enumerate(rows, 1):
        slip, *coefficients = row or (least,)
        if not 0 <= slip < math.inf:
            yield Problem(
                "E220", f"read {slip:g}, expected a slip of 0 or more", (*here, number, 1)
            )
        elif slip < least:
            message = f"read {slip:g}, expected a slip of {least:g} rad/s or more"
            yield Problem("E221", f"{message}: slips must ascend", (*here, number, 1))
        for column, coefficient in enumerate(coefficients, 2):
            place, right = (*here, number, column), 0 < coefficient < math.inf
            yield from expect(coefficient, "a coefficient above 0", place, right=right)
        least = max(least, slip)


def _of_temperatures(
    table: CoefficientTable, heat_capacity: float | None, path: Path
) -> Iterator[Problem]:
    if heat_capacity is None:
        message = "the coefficient depends on temperature, expected a `heat_capacity` as well"
        yield Problem("E261", message, path)
    here = (*path, "columns")
    if not table.columns:
        yield Problem("E219", "read no temperatures, expected at least one", here)
    for number, temperature in enumerate(table.columns, 1):
        right = math.isfinite(temperature)
        yield from expect(temperature, "a finite number", (*here, number), right=right)
    for number, (temperature, other) in enumerate(pairwise(table.columns), 2):
        if not other > temperature:
            message = f"read {other:g} after {temperature:g}, expected ascending temperatures"
            yield Problem("E262", message, (*here, number))
    for number, row in enumerate(table.rows, 1):
        if len(row) != len(table.columns) + 1:
            message = f"read {count_of('number', len(row))}, expected {len(table.columns) + 1}"
            more = "the slip, and a coefficient for each temperature"
            yield Problem("E263", f"{message}: {more}", (*path, "rows", number))


def _of_heat(friction: Friction, path: Path) -> Iterator[Problem]:
    for key, what, right in (
        ("heat_capacity", "a heat capacity above 0", 0 < (friction.heat_capacity or 0) < math.inf),
        ("cooling", "a cooling of 0 or more", 0 <= friction.cooling < math.inf),
        ("ambient", "a temperature", math.isfinite(friction.ambient)),
    ):
        yield from expect(getattr(friction, key), what, (*path, key), right=right)


def of_drag(torque: float, element: ShiftElement | None, path: Path) -> Iterator[Problem]:
    """Check the drag torque of a link, or of a shift element."""
    size = torque.given if isinstance(torque, OfLoad) else torque
    if isinstance(torque, Law):
        from vstatics.core.model.laws import of_law  # costs start-up time

        yield from of_law(torque, path, low=0, high=math.inf, what="a torque of 0 or more")
    elif not 0 <= size < math.inf:
        unit = " N*m" if isinstance(torque, OfLoad) else ""
        message = f"read {size:g}{unit}, expected a torque of 0 or more: drag opposes any motion"
        yield Problem("E222", message, path)
    elif size and element is not None and element.kind == "dog_clutch":
        yield Problem("E223", "a disengaged dog clutch has no drag; remove its drag", path)


def _kind(element: ShiftElement, path: Path) -> Iterator[Problem]:
    to_housing = HOUSING in (element.first, element.second)
    if element.kind not in ELEMENT_KINDS:
        kinds = ", ".join(f"`{kind}`" for kind in ELEMENT_KINDS)
        yield Problem("E224", f"read {element.kind!r}, expected one of {kinds}", path)
    elif element.kind == "brake" and not to_housing:
        message = "a brake holds a link against the housing, expected `clutch` for two links"
        yield Problem("E225", message, path)
    elif element.kind == "clutch" and to_housing:
        yield Problem(
            "E226", "a clutch connects two links, expected `brake` for a link and the housing", path
        )


def of_mechanism(mechanism: Mechanism, path: Path, links: int) -> Iterator[Problem]:
    """Check the links, ratios and efficiencies of a mechanism."""
    members = [link for link in mechanism.links if link != HOUSING]
    for member, link in zip(("first", "second", "third"), mechanism.links, strict=True):
        yield from of_link(link, (*path, member), links)
    if not members:
        yield Problem("E227", "all three links are the housing, expected at least one link", path)
    if len(set(members)) < len(members):
        yield Problem(
            "E228",
            "two members are on the same link, expected different links",
            path,
        )
    yield from of_mechanism_numbers(mechanism, path)


def of_mechanism_numbers(mechanism: Mechanism, path: Path) -> Iterator[Problem]:
    """Check the ratios and efficiencies of a mechanism, and the points of a converter."""
    ratio = mechanism.ratio
    if mechanism.kind:
        yield from _of_kind(mechanism, path)
    elif not math.isfinite(ratio):
        yield Problem("E229", f"read {ratio}, expected a finite number", (*path, "ratio"))
    elif ratio == 0:
        yield Problem("E230", "read 0, expected a ratio other than 0", (*path, "ratio"))
    yield from of_efficiency(mechanism.efficiency, (*path, "efficiency"))
    yield from of_back_efficiency(mechanism.back_efficiency, (*path, "back_efficiency"))
    if (planet := mechanism.planet_ratio) is not None:
        right = planet != 0 and math.isfinite(planet)
        what = "a finite ratio other than 0"
        yield from expect(planet, what, (*path, "planet_ratio"), right=right)


def _of_kind(mechanism: Mechanism, path: Path) -> Iterator[Problem]:
    if mechanism.kind not in MECHANISM_KINDS:
        kinds = ", ".join(f"`{kind}`" for kind in MECHANISM_KINDS)
        yield Problem("E224", f"read {mechanism.kind!r}, expected one of {kinds}", (*path, "kind"))
        return
    for member in ("first", "second"):
        if getattr(mechanism, member) == HOUSING:
            message = f"a {mechanism.kind} connects two links, expected a link, not the housing"
            yield Problem("E272", message, (*path, member))
    if mechanism.third != HOUSING or mechanism.is_set:
        yield Problem(
            "E273", f"a {mechanism.kind} connects only two links; remove `third`", (*path, "third")
        )
    if math.isinf(mechanism.ratio):
        yield Problem(
            "E229", f"read {mechanism.ratio}, expected a finite number", (*path, "speed_ratio")
        )
    if mechanism.kind == "converter":
        yield from of_characteristic(mechanism.points, (*path, "points"))


def of_characteristic(
    points: Sequence[tuple[float, ...]], path: Path, numbers: int = 2
) -> Iterator[Problem]:
    """Check the points of a converter: speed ratio, torque ratio and optionally lambda."""
    if not points:
        yield Problem("E219", "read no points, expected at least one", path)
    before = -math.inf
    for number, (speed_ratio, torque_ratio, *factors) in enumerate(points, 1):
        if not before < speed_ratio < math.inf:
            message = f"read {speed_ratio:g}, expected a speed ratio above {before:g}"
            yield Problem("E274", f"{message}: points must ascend", (*path, number, 1))
        what, right = "a torque ratio of 0 or more", 0 <= torque_ratio < math.inf
        yield from expect(torque_ratio, what, (*path, number, 2), right=right)
        for factor in factors:
            what = "a lambda of 0 or more up to i = 1"
            right = math.isfinite(factor) and (factor >= 0 or speed_ratio >= 1)
            yield from expect(factor, what, (*path, number, 3), right=right)
        if 2 + len(factors) != max(len(points[0]), numbers):
            message = f"read {2 + len(factors)} numbers, expected lambda in all points or in none"
            yield Problem("E522", message, (*path, number))
        before = speed_ratio


def _speed_ratios(case: TransmissionFields, gear: Gear, path: Path) -> Iterator[Problem]:
    mechanisms = case.mechanisms[case.own_mechanisms]
    last = len(mechanisms) + len(case.converters)
    for number, ratio in gear.speed_ratios.items():
        inner = (*path, "speed_ratios", number)
        if wrong := of_number("E275", number, "a mechanism", last, inner):
            yield from wrong
        elif number <= len(mechanisms) and not mechanisms[number - 1].kind:
            name = mechanisms[number - 1].name or number
            message = (
                f"mechanism {name} is neither a variator nor a converter, so its "
                "ratio is fixed; remove the speed ratio"
            )
            yield Problem("E276", message, inner)
        elif not math.isfinite(ratio):
            yield Problem("E229", f"read {ratio}, expected a finite number", inner)
        elif ratio != 1 and _is_bypassed(case, gear, number):
            name = mechanisms[number - 1].name or number
            yield Problem(
                "E455",
                f"read {ratio:g}, but the engaged shift elements lock the links of converter "
                f"{name} together, so its speed ratio is 1: release its lock-up clutch, or remove "
                "the speed ratio",
                inner,
            )


def _open(case: TransmissionFields, gear: Gear, path: Path) -> Iterator[Problem]:
    mechanisms = case.mechanisms[case.own_mechanisms]
    names = [*mechanism_names(mechanisms), *(converter.name for converter in case.converters)]
    for place, number in enumerate(gear.open, 1):
        inner = (*path, "open", place)
        if wrong := of_number("E275", number, "a converter", len(names), inner):
            yield from wrong
            continue
        name = names[number - 1]
        if number <= len(mechanisms) and mechanisms[number - 1].kind != "converter":
            yield Problem("E278", f"{name} is not a converter; remove it from `open`", inner)
        elif number in gear.open[: place - 1]:
            yield Problem("E278", f"{name} is listed twice, expected it once", inner)
        elif number in gear.speed_ratios:
            message = f"{name} also has a speed ratio in this gear; remove one of the two"
            yield Problem("E278", message, inner)


def _is_bypassed(case: TransmissionFields, gear: Gear, number: int) -> bool:
    """Return whether a gear bypasses a converter, given by its number in `mechanisms` of the case.

    The result is False if links or engaged elements are faulty, which other checks report.
    """
    elements = case.shift_elements
    if not all(is_number(element, len(elements), 1) for element in gear.carrying):
        return False
    parts: list[ShiftElement | Mechanism] = [elements[element - 1] for element in gear.joining]
    parts += case.mechanisms
    links = [link for part in parts for link in (part.first, part.second)]
    links += [link for spring in case.springs for link in spring.form]
    if not all(is_number(link, case.links) for link in links):
        return False
    return case.own_mechanisms.start + number - 1 in case.bypassed(gear)


def of_missing_ratios(case: TransmissionFields, *, open_too: bool) -> Iterator[Problem]:
    """Yield errors for variators and converters that have no speed ratio in some gear.

    Parameters
    ----------
    open_too : bool
        True to include converters with lambda, whose speed ratio the load can determine.
    """
    for number, mechanism in enumerate(case.mechanisms[case.own_mechanisms], 1):
        if (
            mechanism.kind
            and math.isnan(mechanism.ratio)
            and (open_too or not mechanism.can_be_open)
        ):
            message = (
                f"`speed_ratio` of {mechanism.kind} {mechanism.name or number} is missing: "
                "give it in this gear under `speed_ratios`, or in the mechanism for all gears"
            )
            message += ", or lambda in its points" * (mechanism.kind == "converter")
            lacking = (
                (place, message)
                for place, gear in enumerate(case.gears, 1)
                if not (
                    number in gear.speed_ratios
                    or number in gear.open
                    or _is_bypassed(case, gear, number)
                )
            )
            yield from case.problems_of_gears("E277", lacking)


def of_efficiency(value: float, path: Path) -> Iterator[Problem]:
    """Check the efficiency of a mechanism, gear set or mesh."""
    if isinstance(value, Law):
        return _efficiencies(value, path)
    expected = f"an efficiency above 0 and up to 1{percent(value)}"
    return expect(value, expected, path, right=0 < value <= 1)


def of_back_efficiency(value: float | None, path: Path) -> Iterator[Problem]:
    """Check the efficiency of power flow from the second link to the first."""
    if isinstance(value, Law):
        yield from _efficiencies(value, path)
    elif value is not None:
        yield from expect(
            value, "an efficiency from 0 (self-locking) to 1", path, right=0 <= value <= 1
        )


def _efficiencies(law: Law, path: Path) -> Iterator[Problem]:
    from vstatics.core.model.laws import of_law  # costs start-up time

    what = "an efficiency above 0 and up to 1"
    return of_law(law, path, low=math.ulp(0.0), high=1, what=what)


def sets_side_by_side(
    sets: Iterable[tuple[int, str, int, Iterable[int]]],
) -> Iterator[tuple[int, str]]:
    """Yield each gear set that shares its carrier and a central gear with an earlier gear set.

    Each item is the number of the gear set and the name of the earlier gear set. `sets` contains
    the number, name, carrier and central gears of each gear set.
    """
    seen: dict[tuple[int, int], str] = {}
    for number, name, carrier, wheels in sets:
        pairs = [(carrier, wheel) for wheel in wheels if HOUSING not in (carrier, wheel)]
        yield from [(number, seen[pair]) for pair in pairs if pair in seen][:1]
        for pair in pairs:
            seen.setdefault(pair, name)


def doubtful(mechanism: Mechanism, path: Path) -> Iterator[Problem]:
    """Warn about a ratio that is allowed but unusual for a planetary gear set.

    >>> [warning] = doubtful(Mechanism(1, 2, 3, 2.5), ())
    >>> warning.message
    'ratio 2.5 is not the basic ratio of a simple planetary gear set, which is negative, so ...'
    """
    ratio = mechanism.ratio
    if mechanism.third == HOUSING:  # a gear pair, shaft, variator or converter
        return
    if ratio == 1:
        yield Problem(
            "N203",
            "with ratio 1 the first and second link always turn at the same speed, and the third "
            "receives torque only through losses",
            (*path, "ratio"),
        )
    if mechanism.planet_ratio is None and not mechanism.is_plain(ratio):
        yield Problem(
            "N204" if ratio == -1 else "W201",  # -1 is usual for bevel differentials
            f"ratio {ratio:g} is not the basic ratio of a simple planetary gear set"
            f"{', which is negative' * (ratio > 0)}, so there is no planet speed without "
            "`planet_ratio`",
            path,
        )


def of_gear(case: TransmissionFields, gear: Gear, path: Path) -> Iterator[Problem]:
    """Check the shift elements, speeds, torques and other values of a gear."""
    yield from _engaged(case.shift_elements, gear.engaged, (*path, "engaged"))
    yield from _slipping(case.shift_elements, gear, (*path, "slip"))
    ends = gear.input or case.input, gear.output or case.main_output
    for end, link in (("input", gear.input), ("output", gear.output)):
        if link is not None:
            yield from of_link(link, (*path, end), case.own_links, lowest=1)
    if ends[0] == ends[1] and (gear.input is not None or gear.output is not None):
        yield Problem(
            "E214",
            f"input and output are both link {called(case, ends[0])}, expected two links",
            path,
        )
    yield from _turning(case, gear, (*path, "input_turns"))
    yield from of_link_drag(case, gear.drag, path)
    elements = case.shift_elements
    for number, torque in gear.open_drag.items():
        inner = (*path, "open_drag", number)
        wrong = of_number("E243", number, "a shift element", len(elements), inner)
        yield from wrong or of_drag(torque, elements[number - 1], inner)
    if gear.loss is not None:
        from vstatics.core.model.laws import of_law  # costs start-up time

        what = "a loss of 0 or more"
        yield from of_law(gear.loss, (*path, "loss"), low=0, high=math.inf, what=what)
    yield from _speed_ratios(case, gear, path)
    yield from _open(case, gear, path)
    if gear.kind not in GEAR_KINDS:
        expected = "`gear`, `neutral` or `point`"
        yield Problem("E232", f"read {gear.kind!r}, expected {expected}", (*path, "kind"))
    if gear.speeds or gear.torques:
        yield from _sides_given(case, gear, ends, path)


def _sides_given(
    case: TransmissionFields, gear: Gear, ends: tuple[int, int], path: Path
) -> Iterator[Problem]:
    """Check the speeds and torques that a gear prescribes on links other than input and output."""
    yield from _speeds(case, gear.speeds, (*path, "speeds"))
    yield from _finite(gear.torques, (*path, "torques"), case.own_links)
    if ends[0] in gear.speeds:
        message = (
            f"link {called(case, ends[0])} is the input, whose speed is 1; expected another link"
        )
        yield Problem("E233", message, (*path, "speeds", ends[0]))
    for link in gear.torques:
        if link == ends[1]:
            message = f"link {called(case, link)} is the output, whose torque is calculated"
            yield Problem("E234", f"{message}; expected another link", (*path, "torques", link))
        elif link in gear.speeds and gear.holding is None:
            message = f"link {called(case, link)} has a given speed, so its torque is calculated"
            yield Problem("E235", f"{message}; give one of the two", (*path, "torques", link))


def _turning(case: TransmissionFields, gear: Gear, path: Path) -> Iterator[Problem]:
    """Check that the direction `input_turns` agrees with the operating point."""
    turns = gear.input_turns
    if not turns:
        return
    by_load = case.input_turns(gear._replace(input_turns=""))
    if turns not in DIRECTIONS:
        expected = " or ".join(f"`{direction}`" for direction in DIRECTIONS)
        yield Problem("E236", f"read {turns!r}, expected {expected}", path)
    elif by_load and turns != by_load:
        yield Problem(
            "E237",
            f"read `{turns}`, but with the operating point of this gear the input turns "
            f"{by_load}; expected an operating point with other signs, or no `input_turns`",
            path,
        )


def of_load(load: Load | None, path: Path) -> Iterator[Problem]:
    """Check the speed, torque and power of an operating point."""
    load = load or NO_LOAD
    if not isinstance(load, Load):
        yield Problem(
            "E238", f"read {type_and_value(load)}, expected a Load, in rpm and N*m", (*path, "load")
        )
        return
    for quantity, value in load._asdict().items():
        if isinstance(value, str):
            message = f"read {value!r}, expected a number, in rpm and N*m"
            yield Problem("E239", message, (*path, "load", quantity))
            return
        if value is not None and not math.isfinite(value):
            yield Problem(
                "E229", f"read {value:g}, expected a finite number", (*path, "load", quantity)
            )
        elif value == 0 and quantity == "speed":
            message = "read 0, expected the speed of an input that turns"
            yield Problem("E241", message, (*path, "load", quantity))
    if load.power is not None and math.isfinite(load.power):
        yield from _of_power(load, load.power, (*path, "load", "power"))


def _of_power(load: Load, power: float, path: Path) -> Iterator[Problem]:
    if load.speed is None:
        yield Problem(
            "E238", f"read {power:g} kW without a speed, expected `speed` and `torque`", path
        )
        return
    product = load.speed * (load.torque or 0.0) * KW_OF_RPM_NM
    if load.speed and not (product and math.isclose(power, product, rel_tol=SAME_POWER)):
        torque = power / load.speed / KW_OF_RPM_NM
        yield Problem(
            "E238",
            f"read {power:g} kW, which at {load.speed:g} rpm are {torque:.6g} N*m: expected these "
            "as `torque`, or no `power`",
            path,
        )


def of_link_drag(
    case: TransmissionFields, drag: Mapping[int, float], path: Path
) -> Iterator[Problem]:
    """Check the drag torques on links, given by a gear or by the case."""
    for link, torque in drag.items():
        if link == HOUSING:
            yield Problem(
                "E217", "the housing does not turn, expected a link", (*path, "drag", link)
            )
        else:
            yield from of_link(link, (*path, "drag", link), case.own_links, lowest=1)
        yield from of_drag(torque, None, (*path, "drag", link))


def _engaged(
    elements: Sequence[ShiftElement], engaged: Sequence[int], path: Path
) -> Iterator[Problem]:
    seen = set()
    for position, element in enumerate(engaged, 1):
        inner = (*path, position)
        if wrong := of_number("E243", element, "a shift element", len(elements), inner):
            yield from wrong
            continue
        message = f"shift element {elements[element - 1].name or element} is"
        if element in seen:
            message += " engaged twice, expected each shift element once"
            yield Problem("E245", message, inner)
        elif elements[element - 1].is_freewheel:
            message += (
                " a freewheel, and the program finds out whether it holds; remove it from the gear"
            )
            yield Problem("E246", message, inner)
        seen.add(element)


def _slipping(elements: Sequence[ShiftElement], gear: Gear, path: Path) -> Iterator[Problem]:
    for number, slip in gear.slip.items():
        inner = (*path, number)
        if wrong := of_number("E243", number, "a shift element", len(elements), inner):
            yield from wrong
            continue
        element = elements[number - 1]
        name = element.name or number
        if element.kind in ("dog_clutch", "freewheel"):
            kind = element.kind.replace("_", " ")
            message = f"{name} is a {kind}, which cannot slip under torque; remove its slip"
            yield Problem("E249", f"{message}, or make it a clutch or a brake", inner)
        elif number in gear.engaged:
            message = f"{name} is engaged and has a slip in this gear"
            yield Problem("E250", f"{message}: remove one of the two", inner)
        if not math.isfinite(slip):
            yield Problem("E229", f"read {slip}, expected a finite number", inner)


def _speeds(
    case: TransmissionFields, speeds: Mapping[int, float | SpeedOf], path: Path
) -> Iterator[Problem]:
    numbers = {link: speed for link, speed in speeds.items() if not isinstance(speed, SpeedOf)}
    yield from _finite(numbers, path, case.own_links)
    for link, speed in speeds.items():
        if not isinstance(speed, SpeedOf):
            continue
        inner = (*path, link)
        yield from of_link(link, inner, case.own_links, lowest=1)
        yield from of_link(speed.link, inner, case.own_links, lowest=1)
        if speed.factor == 0 or not math.isfinite(speed.factor):
            message = f"read a factor of {speed.factor:g}, expected a finite factor other than 0"
            yield Problem("E247", f"{message}; a link at rest has the speed 0", inner)
        if speed.link == link:
            message = f"the speed of link {called(case, link)} is a multiple of itself"
            yield Problem("E248", f"{message}, expected another link", inner)


def _finite(values: Mapping[int, float], path: Path, links: int) -> Iterator[Problem]:
    for link, value in values.items():
        yield from of_link(link, (*path, link), links, lowest=1)
        if not math.isfinite(value):
            yield Problem("E229", f"read {value}, expected a finite number", (*path, link))


def no_unit(value: float, unit: str, what: str, path: Path) -> Problem:
    """Return a note that a number is implausible in its unit and probably lacks another unit."""
    other = {"m": "mm", "rad": "deg", "N": "kN", "Pa": "MPa"}.get(unit, "rpm")
    than = "less" if unit in ("N", "Pa") else "more"
    hint = f"a number without a unit is in {unit}, so write `{value:g} {other}` if this is meant"
    return Problem("N205", f"read {value:g} {unit}, {than} than {what} can have: {hint}", path)
