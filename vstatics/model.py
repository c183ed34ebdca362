"""The transmission as its kinematic scheme shows it: links, devices, gears.

Numbers are as printed in the source: links, shift elements, mechanisms and
gears count from 1, link 0 is the housing. They become indices in `matrix` only.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import Literal, NamedTuple

from vstatics.errors import CaseError

HOUSING = 0

IdleConvention = Literal["published", "exact"]
"""Which sign an idle mechanism gets; see docs/method.md."""


class ShiftElement(NamedTuple):
    """A clutch joins two links; a brake joins a link to the housing (0)."""

    first: int
    second: int = HOUSING
    name: str = ""


class Mechanism(NamedTuple):
    """A three-link device of constant structure.

    Parameters
    ----------
    first, second, third : int
        Link numbers; 0 is the housing. In a planetary set: sun, ring, carrier.
    ratio : float
        ``(w_first - w_third)/(w_second - w_third)``, the internal ratio. [-]
    efficiency : float
        With the third link held still, above 0 and up to 1. [-]
    planet_ratio : float, optional
        First link to planet, third link held. Without it a plain planetary set
        (ratio below 0, not -1) has ``(ratio + 1)/2``, any other has none. [-]
    name : str
        ``D`` and the number when not given.
    """

    first: int
    second: int
    third: int
    ratio: float
    efficiency: float = 1.0
    planet_ratio: float | None = None
    name: str = ""

    @property
    def links(self) -> tuple[int, int, int]:
        """The first, second and third link."""
        return self.first, self.second, self.third

    def is_plain(self, ratio: float) -> bool:
        """Whether a set of this internal ratio can be a plain planetary set.

        Then ``z_planet = (z_ring - z_sun)/2``, so the ratio first link to planet is
        ``(ratio + 1)/2``, with the sun or with the ring as first link.
        """
        return self.third != HOUSING and ratio < 0 and ratio != -1


class Gear(NamedTuple):
    """A shift state: what is engaged, and what is given besides.

    Parameters
    ----------
    engaged : sequence of int
        Numbers of the engaged shift elements.
    speeds : mapping of int to float
        Further given link speeds, relative to the input speed. [-]
    torques : mapping of int to float
        Further external torques on links, relative to the input torque. [-]
    input, output : int, optional
        This gear's own input and output link.
    name : str
        The gear's number when not given.
    """

    engaged: Sequence[int] = ()
    speeds: Mapping[int, float] = MappingProxyType({})
    torques: Mapping[int, float] = MappingProxyType({})
    input: int | None = None
    output: int | None = None
    name: str = ""


@dataclass(frozen=True)
class Transmission:
    """A whole transmission, checked when it is made.

    Parameters
    ----------
    links : int
        Number of main links, without the housing.
    shift_elements, mechanisms, gears : sequence
        In order of their numbers.
    input, output : int
        Link numbers; the output is the last link when not given.
    idle : {"exact", "published"}
        Convention for the sign of idle mechanisms.
    coast : bool
        Power enters at the output (engine braking).
    link_names : sequence of str
        The link numbers when not given.

    Raises
    ------
    CaseError
        With every `Problem` of the model, each with the path of the value.

    Examples
    --------
    >>> differential = Transmission(
    ...     links=3,
    ...     shift_elements=[ShiftElement(1, 2), ShiftElement(2, 0)],
    ...     mechanisms=[Mechanism(1, 2, 3, ratio=-2.5)],
    ...     gears=[Gear([1]), Gear([2])],
    ... )
    >>> [element.name for element in differential.shift_elements]
    ['F1', 'T2']
    """

    links: int
    shift_elements: Sequence[ShiftElement]
    mechanisms: Sequence[Mechanism]
    gears: Sequence[Gear]
    input: int = 1
    output: int = 0
    idle: IdleConvention = "exact"
    coast: bool = False
    name: str = ""
    description: str = ""
    source: str = ""
    link_names: Sequence[str] = ()

    def __post_init__(self) -> None:
        """Check everything, then fill in the defaults."""
        from vstatics.checks import problems  # the checks know the model, not the reverse

        errors = [problem for problem in problems(self) if problem.severity == "error"]
        if errors:
            raise CaseError(errors)
        for attribute, value in _completed(self).items():
            object.__setattr__(self, attribute, value)

    def gear_input(self, gear: Gear) -> int:
        """The input link of a gear."""
        return gear.input or self.input

    def gear_output(self, gear: Gear) -> int:
        """The output link of a gear."""
        return gear.output or self.output

    def link_name(self, link: int) -> str:
        """The name of a link; the housing is ``housing``."""
        return self.link_names[link - 1] if link else "housing"

    @property
    def devices(self) -> list[str]:
        """Names of all devices in the order of the structural-distribution matrix."""
        elements = [element.name for element in self.shift_elements]
        return elements + [mechanism.name for mechanism in self.mechanisms]


def element_name(number: int, element: ShiftElement) -> str:
    """The name of an element that has none: F for a clutch, T for a brake.

    >>> element_name(3, ShiftElement(2, 0))
    'T3'
    """
    kind = "T" if HOUSING in (element.first, element.second) else "F"
    return f"{kind}{number}"


def mechanism_name(number: int) -> str:
    """The name of a mechanism that has none: D and its number."""
    return f"D{number}"


def _completed(case: Transmission) -> dict[str, object]:
    """The attributes of a checked case with names and defaults filled in."""
    return {
        "output": case.output or case.links,
        "link_names": tuple(case.link_names) or tuple(map(str, range(1, case.links + 1))),
        "shift_elements": tuple(
            element._replace(name=element.name or element_name(number, element))
            for number, element in enumerate(case.shift_elements, 1)
        ),
        "mechanisms": tuple(
            mechanism._replace(name=mechanism.name or mechanism_name(number))
            for number, mechanism in enumerate(case.mechanisms, 1)
        ),
        "gears": tuple(
            gear._replace(
                name=gear.name or str(number),
                engaged=tuple(gear.engaged),
                speeds=dict(gear.speeds),
                torques=dict(gear.torques),
            )
            for number, gear in enumerate(case.gears, 1)
        ),
    }
