"""Checks that a deck, or the published listing, has fields for all parts of a case."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import numpy as np

from vstatics.core.elements.drawing import drawing_of
from vstatics.core.errors import CaseError, Path, Problem, listed, plural
from vstatics.core.model.parts import Law
from vstatics.core.model.transmission import Gear, Mechanism, ShiftElement, Transmission
from vstatics.core.statics.results import Results

SHOWN = 20
"""Largest number of names of each kind of part in a message."""


def check_deck(case: Transmission) -> None:
    """Raise an error for a case with parts that a deck cannot contain.

    Raises
    ------
    CaseError
        If a deck has no field for some parts; the message lists them.

    Examples
    --------
    >>> from vstatics.core.model.transmission import Gear, Mechanism
    >>> pair = Mechanism(1, 2, 0, -2.5, stiffness=9e4, name="pair")
    >>> check_deck(Transmission(2, [], [pair], [Gear()], inertias={1: 0.1}))
    Traceback (most recent call last):
        ...
    vstatics.core.errors.CaseError: a deck cannot hold the inertia of 1, the stiffness of pair; ...
    """
    problems = [f"the {what} of {listed(names, SHOWN)}" for what, names in _unheld(case) if names]
    springs = [spring.name for spring in case.springs]
    if springs:
        problems.insert(0, f"the {plural('spring', len(springs))} {listed(springs, SHOWN)}")
    if problems:
        message = (
            f"a deck cannot hold {', '.join(problems)}; expected YAML or JSON, which hold them"
        )
        raise CaseError("E116", message)


def _unheld(case: Transmission) -> Iterator[tuple[str, list[str]]]:
    """Yield each key that has no field in a deck but is in use, with the names of parts."""
    parts: list[ShiftElement | Mechanism] = [*case.shift_elements, *case.mechanisms]
    drawing = drawing_of(case)
    elements = drawing.elements if drawing else ()
    yield "converter", [converter.name for converter in case.converters]
    yield "speed ratio", [part.name for part in case.mechanisms if part.kind]
    yield "inertia", [case.link_name(link) for link, inertia in case.heavy.items() if inertia]
    yield "stiffness", [part.name for part in parts if part.stiffness is not None]
    yield "damping", [part.name for part in parts if part.damping]
    yield "static friction", [part.name for part in case.shift_elements if part.static != 1]
    yield "friction", [part.name for part in case.shift_elements if part.friction is not None]
    laws = [part.name for part in case.mechanisms if isinstance(part.efficiency, Law)]
    laws += [part.name for part in case.mechanisms if isinstance(part.back_efficiency, Law)]
    yield "efficiency over speed or torque", [*dict.fromkeys(laws)]
    yield "slip", [f"gear {gear.name}" for gear in case.gears if gear.slip]
    yield "loss", [f"gear {gear.name}" for gear in case.gears if gear.loss is not None]
    yield "fatigue strength", [*case.fatigue]
    yield "bearing", [*case.bearings]
    yield "balance", [f"gear {gear.name}" for gear in case.gears if gear.balance]
    yield "planet masses", [element.name for element in elements if element.planet_masses]


def check_published_listing(results: Results) -> None:
    """Raise an error for a case whose results depend on keys without a field in the listing.

    Raises
    ------
    CaseError
        The error contains a problem for each kind of part, located at the first such part.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, Transmission, solve
    >>> gears = [Gear(name="ahead"), Gear(name="back", input=2, output=1)]
    >>> check_published_listing(solve(Transmission(2, [], [Mechanism(1, 2, 0, -2.5)], gears)))
    Traceback (most recent call last):
        ...
    vstatics.core.errors.CaseError: gears[2].input: the published listing has no field for ...
    """
    problems = []
    for what, parts in (*_unprinted_parts(results.case), *_unprinted_gears(results)):
        if parts:
            message = f"the published listing has no field for {what}: {listed([*parts], SHOWN)}"
            expected = "expected another format, such as `-f listing`"
            path = next(iter(parts.values()))
            problems.append(Problem("E870", f"{message}; {expected}", path))
    if problems:
        raise CaseError(problems)


def _unprinted_parts(case: Transmission) -> Iterator[tuple[str, dict[str, Path]]]:
    """Yield each kind of part without a field in the listing, with paths by name."""
    yield "springs", {spring.name: ("springs", n) for n, spring in enumerate(case.springs, 1)}
    yield "speed ratios", _mechanisms(case, "kind", lambda part: bool(part.kind))
    yield (
        "efficiencies over speed or torque",
        _mechanisms(case, "efficiency", lambda part: isinstance(part.efficiency, Law)),
    )
    yield (
        "second efficiencies",
        _mechanisms(
            case,
            "back_efficiency",
            lambda part: part.back_efficiency not in (None, part.efficiency),
        ),
    )
    yield (
        "the drag of shift elements",
        {
            part.name: ("shift_elements", n, "drag")
            for n, part in enumerate(case.shift_elements, 1)
            if _acts(part.drag)
        },
    )


def _unprinted_gears(results: Results) -> Iterator[tuple[str, dict[str, Path]]]:
    """Yield each key of gears without a field in the listing, with paths by gear name."""
    case = results.case
    yield "slip in gears", _gears(case, "slip", lambda gear: bool(gear.slip))
    yield "losses of gears as a whole", _gears(case, "loss", lambda gear: gear.loss is not None)
    yield "drag in gears", _gears(case, "drag", lambda gear: any(map(_acts, gear.drag.values())))
    yield (
        "the drag of disengaged shift elements in gears",
        _gears(case, "open_drag", lambda gear: any(map(_acts, gear.open_drag.values()))),
    )
    yield "balances of gears", _gears(case, "balance", lambda gear: gear.balance is not None)
    yield "inputs of single gears", _gears(case, "input", _differs(case, case.gear_input))
    yield "outputs of single gears", _gears(case, "output", _differs(case, case.gear_output))
    yield (
        "coasting in gears",
        {
            gear.name: _load_path(index, "coast", gear.coast)
            if case.gear_coast(gear)
            else _load_path(index, "load", gear.load)
            for index, gear in enumerate(case.gears)
            if case.coasts(gear)
        },
    )
    yield (
        "an input torque of 0 in gears",
        {
            case.gears[index].name: _load_path(index, "load", case.gears[index].load)
            for index in case.unloaded
        },
    )
    yield (
        "freewheels in conflict in gears",
        {
            case.gears[index].name: ("gears", index + 1, "engaged")
            for index in np.flatnonzero(results.conflict).tolist()
        },
    )


def _mechanisms(
    case: Transmission, key: str, applies: Callable[[Mechanism], bool]
) -> dict[str, Path]:
    numbered = enumerate(case.mechanisms, 1)
    return {part.name: ("mechanisms", n, key) for n, part in numbered if applies(part)}


def _gears(case: Transmission, key: str, applies: Callable[[Gear], bool]) -> dict[str, Path]:
    return {gear.name: ("gears", n, key) for n, gear in enumerate(case.gears, 1) if applies(gear)}


def _differs(case: Transmission, port: Callable[[Gear], int]) -> Callable[[Gear], bool]:
    """Return a test whether a gear has another port (input or output) than the first gear."""
    return lambda gear: port(gear) != port(case.gears[0])


def _load_path(index: int, key: str, of_gear: object) -> Path:
    """Return the path of a key of the gear, or of the case if the gear omits the key."""
    return (key,) if of_gear is None else ("gears", index + 1, key)


def _acts(drag: float) -> bool:
    return isinstance(drag, Law) or drag != 0
