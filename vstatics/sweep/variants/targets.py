"""Which number of the case is varied, "D1.ratio", "shaft.stiffness", and what it is there."""

from __future__ import annotations

import math
from collections.abc import Hashable, Mapping, Sequence
from typing import Literal, NamedTuple, Protocol, get_args

import numpy as np

from vstatics.core.errors import Place, Problem, ReadError, listed, quoted, spoken, typed_number
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
"""What has a number: devices are shift elements, mechanisms and springs."""

OF_MECHANISM: tuple[OfMechanism, ...] = get_args(OfMechanism)
OF_DEVICE: tuple[OfDevice, ...] = get_args(OfDevice)
OWNERS: Mapping[Quantity, Owner] = {
    **dict.fromkeys(OF_MECHANISM, "mechanisms"),
    **dict.fromkeys(OF_DEVICE, "devices"),
    "inertia": "links",
}
ALIASES: Mapping[str, Quantity] = {LISTS["mechanisms", one]: one for one in OF_MECHANISM}
"""What the deck calls them, IAB and ETAI."""
NAMES: Mapping[str, Quantity] = {**{one: one for one in OWNERS}, **ALIASES}


class Varied(Protocol):
    """A number that is varied, of a case or of a scenario."""

    @property
    def name(self) -> str:
        """As it is written."""

    @property
    def numbers(self) -> frozenset[Hashable]:
        """All that it varies; two that have one in common vary the same."""


class Target(NamedTuple):
    """A number of the case that is varied."""

    name: str
    """With the case's own name of what has it: `D1.ratio`."""
    owner: int
    """Index, from 0: of a mechanism; for what is elastic in `Transmission.devices`; of a link."""
    quantity: Quantity

    @property
    def numbers(self) -> frozenset[Hashable]:
        """What it varies: a compliance is a stiffness, too."""
        quantity = "stiffness" if self.quantity == "compliance" else self.quantity
        return frozenset([(self.owner, quantity)])


def target(text: str, case: Transmission, place: Place | None = None) -> Target:
    """The number that a text such as `D1.ratio` or `#1.ratio` speaks of.

    Parameters
    ----------
    text : str
        The name of a mechanism, or `#` and its number, then `.ratio` or `.efficiency`, in a
        deck `.IAB` or `.ETAI`; an elastic device, then `.stiffness`, `.compliance` or
        `.damping`; a link, then `.inertia`. The name may stand in quotes; a bare number is taken
        as a name first. A drawn element alone is its only mechanism.
    case : Transmission
    place : Place, optional
        Where the text begins, for messages.

    Raises
    ------
    ReadError
        If there is no such number; it names the nearest.

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
        expected = [one for one, owner in known.items() if len(_found(name, owner, case)) == 1]
        if not expected:
            raise refusal(_not_one(name, next(iter(known)), case), place, begin)
        message = f"read {shown(read)}, expected {spoken(map(quoted, expected), 'or')}"
        raise refusal(message + nearest(read, [*expected, *ALIASES]), place, at)
    quantity = NAMES[read]
    found = _found(name, OWNERS[quantity], case)
    if quantity not in known or len(found) != 1:
        raise refusal(_not_one(name, quantity, case), place, begin)
    if quantity == "damping" and damping(devices_of(case)[found[0]].damping).loss_factor:
        message = f"{quoted(name)} is damped by a ratio or loss factor: give N*m*s/rad to vary it"
        raise refusal(message, place, begin)
    return Target(f"{_names(OWNERS[quantity], case)[found[0]]}.{quantity}", found[0], quantity)


def _usable(owner: Owner, case: Transmission) -> Sequence[str]:
    """The names of what a case has that can be varied: of devices those that are elastic."""
    names = _names(owner, case)
    pairs = zip(case.devices, devices_of(case), strict=True)
    elastic = [name for name, device in pairs if stiffness_of(device) is not None]
    if owner == "devices":
        return elastic
    return names if owner == "mechanisms" or elastic or case.heavy else []


def _names(owner: Owner, case: Transmission) -> Sequence[str]:
    """The names of all mechanisms, devices, or links."""
    if owner == "mechanisms":
        return [mechanism.name for mechanism in case.mechanisms]
    return case.devices if owner == "devices" else case.link_names[: case.own_links]


def _found(name: str, owner: Owner, case: Transmission) -> list[int]:
    """Indices of what a name means, or else a number; only elastic ones of the devices."""
    found = _called(name, owner, case)
    if not found and len(name) > 2 and name[0] == name[-1] and name[0] in "\"'":
        found = _called(name[1:-1], owner, case)
    number = typed_number(name.removeprefix("#"), len(_names(owner, case)))
    found = found or ([] if number is None else [number - 1])
    if owner == "devices":
        devices = devices_of(case)
        found = [index for index in found if stiffness_of(devices[index]) is not None]
    return found


def _called(name: str, owner: Owner, case: Transmission) -> list[int]:
    """Indices of what has a name; a drawn element is its mechanisms."""
    if owner != "devices":
        return rows_called(name, owner, case)
    first = case.among_devices.start
    of_elements = [first + index for index in rows_called(name, "mechanisms", case)]
    others = [index for index, device in enumerate(case.devices) if device == name]
    return sorted({*of_elements, *others})


def _no_number(text: str, known: Mapping[Quantity, Owner], case: Transmission) -> str:
    """What to say of a text without a point."""
    expected = "; or ".join(
        f"{words}, then {spoken([f'`.{one}`' for one, of in known.items() if of == owner], 'or')}"
        for owner, words in _WORDS_OF_OWNERS.items()
        if owner in known.values()
    )
    names = [f"{name}.{one}" for one, owner in known.items() for name in _usable(owner, case)]
    own = [name for name in names if name.startswith(f"{text.strip()}.")]
    hint = nearest(own[0] if own else text.strip(), names) or f"; such as `{names[0]}`"
    return f"read {shown(text)}, expected {expected}{hint}"


_WORDS_OF_OWNERS: Mapping[Owner, str] = {
    "mechanisms": "a mechanism",
    "devices": "an elastic device",
    "links": "a link",
}


def _not_one(name: str, quantity: Quantity, case: Transmission) -> str:
    """What to say of a name that nothing has that can be varied, or several parts of a device."""
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
        return f"{quoted(name)} has no `stiffness` in the case: give it one, so that it can vary"
    if called:
        return several(name, called, names, owner)
    if owner == "devices":
        hint = nearest(name, usable)
        return f"there is no elastic device {quoted(name)}, expected one of {listed(usable)}{hint}"
    return no_row(name, owner, names)


def refusal(message: str, place: Place | None, offset: int = 0) -> ReadError:
    """An error so many letters behind a place."""
    return ReadError([Problem("E717", message, place=behind(place, offset))])


def behind(place: Place | None, offset: int) -> Place | None:
    """The place so many letters further."""
    return place and place._replace(column=place.column + offset)


def shown(text: str) -> str:
    """What was read, in quotes and not too long; "nothing" if it is nothing.

    >>> shown(" .9x "), shown("")
    ('`.9x`', 'nothing')
    """
    text = text.strip()
    return quoted(text) if text else "nothing"


Device = ShiftElement | Mechanism | Spring


def devices_of(case: Transmission) -> list[Device]:
    """All devices, in the order of `Transmission.devices`."""
    return [*case.shift_elements, *case.mechanisms, *case.springs]


def stiffness_of(device: Device) -> float | None:
    """The stiffness of a device, None if it is rigid, or has points or a strut [N*m/rad]."""
    if isinstance(device, Spring):
        return None if device.points or device.strut else device.rate
    return device.stiffness


def own_number(case: Transmission, index: int, quantity: str) -> float:
    """What a varied number is in the case itself.

    Parameters
    ----------
    index : int
        From 0: of a mechanism, a device or a link, as the quantity says.
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
    """Which numbers can't be those of any case, as its checks say.

    Parameters
    ----------
    quantity : str
    numbers : ndarray, shape (variants,)
    between : (float, float)
        Of ratios, as `Transmission.ratio_range` has them.

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
