"""Varied numbers such as "D1.ratio" or "shaft.stiffness", and their values in the case."""

from __future__ import annotations

import math
from collections.abc import Hashable, Mapping, Sequence
from typing import Literal, NamedTuple, Protocol, get_args

import numpy as np

from vstatics.core.errors import Place, ReadError, listed, quoted, spoken, typed_number
from vstatics.core.model.parts import Mechanism, ShiftElement, damping
from vstatics.core.model.paths import owner_and_key
from vstatics.core.model.springs import Spring
from vstatics.core.model.transmission import Transmission
from vstatics.core.numerics.arrays import Booleans, Floats
from vstatics.core.readers.deck.places import LISTS
from vstatics.core.statics.matrix import impossible as impossible_of_mechanism
from vstatics.core.suggestions import nearest
from vstatics.core.tables.names import no_row, rows_called, several

OfMechanism = Literal["ratio", "efficiency"]
OfDevice = Literal["stiffness", "compliance", "damping"]
Quantity = OfMechanism | OfDevice | Literal["inertia"]
Owner = Literal["mechanisms", "devices", "links"]
"""List that contains the owner of a number. `devices` are shift elements, mechanisms and springs.
"""

OF_MECHANISM: tuple[OfMechanism, ...] = get_args(OfMechanism)
OF_DEVICE: tuple[OfDevice, ...] = get_args(OfDevice)
OWNERS: Mapping[Quantity, Owner] = {
    **dict.fromkeys(OF_MECHANISM, "mechanisms"),
    **dict.fromkeys(OF_DEVICE, "devices"),
    "inertia": "links",
}
ALIASES: Mapping[str, Quantity] = {
    LISTS["mechanisms", quantity]: quantity for quantity in OF_MECHANISM
}
"""Quantities of mechanisms, by name in a deck (IAB and ETAI)."""
NAMES: Mapping[str, Quantity] = {**{quantity: quantity for quantity in OWNERS}, **ALIASES}


class Varied(Protocol):
    """Varied number of a case or of a scenario."""

    @property
    def name(self) -> str:
        """Name of the number as written by the user."""

    @property
    def numbers(self) -> frozenset[Hashable]:
        """Keys that identify the number. Varied numbers must not share a key."""


class Target(NamedTuple):
    """Varied number of a case, given by component or link and quantity."""

    name: str
    """Name of the number, with the name of the component in the case, such as `D1.ratio`."""
    owner: int
    """Index, from 0, of the mechanism, of the link, or of the component in `Transmission.devices`.
    """
    quantity: Quantity

    @property
    def numbers(self) -> frozenset[Hashable]:
        """Key that identifies the number. A compliance has the key of the stiffness."""
        quantity = "stiffness" if self.quantity == "compliance" else self.quantity
        return frozenset([(self.owner, quantity)])


def target(text: str, case: Transmission, place: Place | None = None) -> Target:
    """Return the number of a case named by a text such as `D1.ratio` or `#1.ratio`.

    Parameters
    ----------
    text : str
        Name of a mechanism, or `#` and its number, followed by `.ratio` or `.efficiency` (deck
        names: `.IAB`, `.ETAI`); an elastic component, followed by `.stiffness`, `.compliance` or
        `.damping`; or a link, followed by `.inertia`. The name can be in quotes; a bare number is
        tried as a name first. A gear set with a single mechanism can be named instead of the
        mechanism.
    case : Transmission
    place : Place, optional
        Place of the text, for messages.

    Raises
    ------
    ReadError
        If the number does not exist; the message names the nearest.

    Examples
    --------
    >>> from vstatics.core.model.transmission import Gear, Mechanism, Transmission
    >>> case = Transmission(3, [], [Mechanism(1, 2, 3, -2.5, name="front")], [Gear()])
    >>> target("front.efficiency", case)
    Target(name='front.efficiency', owner=0, quantity='efficiency')
    >>> target("#1.ratio", case).name
    'front.ratio'
    """
    begin = len(text) - len(text.lstrip())
    name, dot, read = owner_and_key(text)
    known = {quantity: owner for quantity, owner in OWNERS.items() if _usable(owner, case)}
    if not known:
        raise refusal("the case has no mechanisms, so there is nothing to vary", place, begin)
    if not dot or not name:
        raise refusal(_no_number(text, known, case), place, begin)
    at = begin + len(name) + 1
    name = name.rstrip()
    if read not in NAMES:
        expected = [
            quantity for quantity, owner in known.items() if len(_indices(name, owner, case)) == 1
        ]
        if not expected:
            of_part = [quantity for quantity, owner in known.items() if _called(name, owner, case)]
            raise refusal(_not_one(name, (of_part or [*known])[0], case), place, begin)
        message = f"read {shown(read)}, expected {spoken(map(quoted, expected), 'or')}"
        message += " in SI units" * ("[" in read)
        raise refusal(message + nearest(read, [*expected, *ALIASES]), place, at)
    quantity = NAMES[read]
    rows = _indices(name, OWNERS[quantity], case)
    if quantity not in known or len(rows) != 1:
        raise refusal(_not_one(name, quantity, case), place, begin)
    if quantity == "damping" and damping(devices_of(case)[rows[0]].damping).loss_factor:
        message = f"{quoted(name)} is damped by a ratio or loss factor: give N*m*s/rad to vary it"
        raise refusal(message, place, begin)
    return Target(f"{_names(OWNERS[quantity], case)[rows[0]]}.{quantity}", rows[0], quantity)


def _usable(owner: Owner, case: Transmission) -> Sequence[str]:
    """Return the names of components or links with numbers that can vary in the case."""
    names = _names(owner, case)
    pairs = zip(case.devices, devices_of(case), strict=True)
    elastic = [name for name, device in pairs if stiffness_of(device) is not None]
    if owner == "devices":
        return elastic
    return names if owner == "mechanisms" or elastic or case.heavy else []


def _names(owner: Owner, case: Transmission) -> Sequence[str]:
    if owner == "mechanisms":
        return [mechanism.name for mechanism in case.mechanisms]
    return case.devices if owner == "devices" else case.link_names[: case.own_links]


def _indices(name: str, owner: Owner, case: Transmission) -> list[int]:
    """Return the indices of the components or links called `name` or, failing that, of a number."""
    rows = _called(name, owner, case)
    if not rows and len(name) > 2 and name[0] == name[-1] and name[0] in "\"'":
        rows = _called(name[1:-1], owner, case)
    number = typed_number(name.removeprefix("#"), len(_names(owner, case)))
    rows = rows or ([] if number is None else [number - 1])
    if owner == "devices":
        devices = devices_of(case)
        rows = [index for index in rows if stiffness_of(devices[index]) is not None]
    return rows


def _called(name: str, owner: Owner, case: Transmission) -> list[int]:
    if owner != "devices":
        return rows_called(name, owner, case)
    first = case.among_devices.start
    of_elements = [first + index for index in rows_called(name, "mechanisms", case)]
    others = [index for index, device in enumerate(case.devices) if device == name]
    return sorted({*of_elements, *others})


def _no_number(text: str, known: Mapping[Quantity, Owner], case: Transmission) -> str:
    expected = "; or ".join(
        f"{words}, then {spoken([f'`.{key}`' for key, of in known.items() if of == owner], 'or')}"
        for owner, words in _WORDS_OF_OWNERS.items()
        if owner in known.values()
    )
    names = [
        f"{name}.{quantity}" for quantity, owner in known.items() for name in _usable(owner, case)
    ]
    of_part = [name for name in names if name.startswith(f"{text.strip()}.")]
    hint = nearest(of_part[0] if of_part else text.strip(), names) or f"; such as `{names[0]}`"
    return f"read {shown(text)}, expected {expected}{hint}"


_WORDS_OF_OWNERS: Mapping[Owner, str] = {
    "mechanisms": "a mechanism",
    "devices": "an elastic component",
    "links": "a link",
}


def _not_one(name: str, quantity: Quantity, case: Transmission) -> str:
    owner = OWNERS[quantity]
    names, usable, called = _names(owner, case), _usable(owner, case), _called(name, owner, case)
    if not usable:
        without = {"mechanisms": "has no mechanisms", "devices": "has nothing that is elastic"}
        what = without.get(owner, "has no inertias, and nothing that is elastic")
        return f"the case {what}, so there is no {quantity} to vary"
    numbered = typed_number(name.removeprefix("#"), len(names))
    if name.startswith("#") and numbered is None:
        what = _WORDS_OF_OWNERS[owner].replace("an elastic", "a")
        return f"read {shown(name)}, expected the number of {what}, #1 to #{len(names)}"
    if owner == "devices" and (called or numbered):
        lacks = "`stiffness` in the case: give it one, so that it can vary"
        if name in [spring.name for spring in case.springs]:
            lacks = "constant `stiffness`, so its numbers cannot vary"
        return f"{quoted(name)} has no {lacks}"
    if called:
        return several(name, called, names, owner)
    if owner == "devices":
        hint = nearest(name, usable)
        return (
            f"there is no elastic component {quoted(name)}, expected one of {listed(usable)}{hint}"
        )
    return no_row(name, owner, names)


def refusal(message: str, place: Place | None, offset: int = 0) -> ReadError:
    """Return an error whose place is `offset` letters after a given place."""
    return ReadError("E717", message, place=behind(place, offset))


def behind(place: Place | None, offset: int) -> Place | None:
    """Return the place that is `offset` letters after a place."""
    return place and place._replace(column=place.column + offset)


def shown(text: str) -> str:
    """Return a text in quotes, shortened if long; "nothing" for an empty text.

    >>> shown(" .9x "), shown("")
    ('`.9x`', 'nothing')
    """
    text = text.strip()
    return quoted(text) if text else "nothing"


Device = ShiftElement | Mechanism | Spring


def devices_of(case: Transmission) -> list[Device]:
    """Return shift elements, mechanisms and springs, in the order of `Transmission.devices`."""
    return [*case.shift_elements, *case.mechanisms, *case.springs]


def stiffness_of(device: Device) -> float | None:
    """Return the stiffness of a component [N*m/rad].

    Return None for a rigid or nonlinear component.
    """
    if isinstance(device, Spring):
        return None if device.points or device.strut else device.rate
    return device.stiffness


def own_number(case: Transmission, index: int, quantity: str) -> float:
    """Return the value that the case gives for a varied number.

    Parameters
    ----------
    index : int
        Index, from 0, of the mechanism, component (`Transmission.devices`) or link with this
        quantity.
    quantity : str

    Examples
    --------
    >>> from vstatics import Spring
    >>> shaft = Spring({1: 1, 2: -1}, stiffness=500.0)
    >>> case = Transmission(2, [], [], [], springs=[shaft], inertias={1: 0.1})
    >>> own_number(case, 0, "compliance"), own_number(case, 1, "inertia")
    (0.002, 0.0)
    """
    if quantity == "inertia":
        return case.heavy.get(index + 1, 0.0)
    if quantity in ("ratio", "efficiency"):
        number: float = getattr(case.mechanisms[index], quantity)
        return number
    device = devices_of(case)[index]
    if quantity == "damping":
        return damping(device.damping).viscous
    if isinstance(device, Spring) and quantity == "compliance" and device.compliance is not None:
        return device.compliance
    stiffness = stiffness_of(device) or 0.0
    return stiffness if quantity == "stiffness" else 1 / stiffness


def impossible(
    quantity: str, numbers: Floats, between: tuple[float, float] = (-math.inf, math.inf)
) -> Booleans:
    """Return a mask of numbers that the checks of a case would refuse.

    Parameters
    ----------
    quantity : str
    numbers : ndarray, shape (variants,)
    between : (float, float)
        Range of impossible ratios; see `Transmission.ratio_range`.

    Examples
    --------
    >>> impossible("stiffness", np.array([1e3, 0.0, np.inf])).tolist()
    [False, True, True]
    >>> impossible("inertia", np.array([0.0, -1.0, np.nan])).tolist()
    [False, True, True]
    """
    if quantity in ("stiffness", "compliance"):
        with np.errstate(all="ignore"):
            return ~((numbers > 0) & np.isfinite(numbers) & np.isfinite(1 / numbers))
    if quantity in ("damping", "inertia"):
        return ~((numbers >= 0) & np.isfinite(numbers))
    return impossible_of_mechanism(quantity, numbers, between)  # type: ignore[arg-type] # one of the two
