"""Kinds of gear sets: their members, their gears, and the meshes between them.

The structure of each kind is declared only here. Readers, the schema of cases, the conversion and
the checks are derived from this declaration.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple


class WheelKind(NamedTuple):
    """Declaration of a central gear: internal or external, and the planet rim in mesh."""

    internal: bool
    rim: str


def sun(rim: str) -> WheelKind:
    """Return the declaration of a sun gear in mesh with a planet rim."""
    return WheelKind(internal=False, rim=rim)


def ring(rim: str) -> WheelKind:
    """Return the declaration of a ring gear in mesh with a planet rim."""
    return WheelKind(internal=True, rim=rim)


class Planetary(NamedTuple):
    """Kind of gear set with planets on a carrier.

    Attributes
    ----------
    wheels : mapping of member to WheelKind
        Central gears, in the order of the links of the derived mechanism.
    planets : mapping of planet to its rims
        Rims (gears) of each planet, which rotate together.
    meshes : pairs of rims
        Rims of different planets that mesh with each other.
    optional : set of members
        Central gears that a transmission can leave out.
    """

    description: str
    wheels: Mapping[str, WheelKind]
    planets: Mapping[str, tuple[str, ...]]
    meshes: tuple[tuple[str, str], ...] = ()
    optional: frozenset[str] = frozenset()

    @property
    def members(self) -> tuple[str, ...]:
        """Names of the members that are on links: central gears and the carrier."""
        return (*self.wheels, "carrier")

    @property
    def toothed(self) -> tuple[str, ...]:
        """Names of toothed gears: central gears, then rims of planets."""
        return (*self.wheels, *(rim for rims in self.planets.values() for rim in rims))


class Simple(NamedTuple):
    """Kind of gear set without a group of planets, such as a gear pair, a shaft or a support.

    Attributes
    ----------
    members : names
        Members on the first, second and third link of the mechanism; a missing link is the housing.
    toothed : names
        Names of toothed gears; the first and the last gear determine the ratio.
    sign : int
        Sign of ``w_first/w_second`` with the third link held.
    meshes : sequence of str
        Meshes through which the power flows, as fields of `MeshEfficiency`.
    size : str
        Sizes that determine the ratio: ``teeth`` or ``diameters``; empty without a ratio.
    """

    description: str
    members: tuple[str, ...]
    toothed: tuple[str, ...] = ()
    sign: int = 1
    meshes: tuple[str, ...] = ()
    size: str = "teeth"
    optional_teeth: bool = False
    optional: frozenset[str] = frozenset()


Kind = Planetary | Simple

PAIR = ("first", "second")

KINDS: Mapping[str, Kind] = {
    "planetary": Planetary(
        "Planetary set: sun, planets, ring.",
        {"sun": sun("planet"), "ring": ring("planet")},
        {"planet": ("planet",)},
    ),
    "double_planet": Planetary(
        "Planetary set with meshed planets: sun, inner planets, outer planets, ring.",
        {"sun": sun("inner"), "ring": ring("outer")},
        {"inner": ("inner",), "outer": ("outer",)},
        (("inner", "outer"),),
    ),
    "stepped": Planetary(
        "Stepped planets: sun and ring mesh with the rim `planet`, sun2 and ring2 with `planet2`.",
        {
            "sun": sun("planet"),
            "ring": ring("planet"),
            "sun2": sun("planet2"),
            "ring2": ring("planet2"),
        },
        {"planet": ("planet", "planet2")},
        optional=frozenset({"sun", "ring", "sun2", "ring2"}),
    ),
    "ravigneaux": Planetary(
        "Ravigneaux set: the small sun meshes with the short planets, the large sun and the ring "
        "with the long ones.",
        {
            "small_sun": sun("short"),
            "large_sun": sun("long"),
            "ring": ring("long"),
        },
        {"short": ("short",), "long": ("long",)},
        (("short", "long"),),
        optional=frozenset({"small_sun", "large_sun", "ring"}),
    ),
    "planet_group": Planetary(
        "Planets with any rims on one carrier, and any central wheels.", {}, {}
    ),
    "bevel": Simple(
        "Bevel differential: two side wheels, planets on a carrier; equal wheels without teeth.",
        ("left", "right", "carrier"),
        ("left", "planet", "right"),
        sign=-1,
        meshes=("bevel", "bevel"),
        optional_teeth=True,
    ),
    "bevel_pair": Simple(
        "Bevel or hypoid pair, such as a final drive: a positive ratio, as axes that cross have "
        "no common direction.",
        PAIR,
        PAIR,
        meshes=("bevel",),
    ),
    "gear_pair": Simple(
        "External gear pair: the wheels turn in opposite directions.",
        PAIR,
        PAIR,
        sign=-1,
        meshes=("external",),
    ),
    "internal_pair": Simple(
        "Internal gear pair: the wheels turn in the same direction.",
        PAIR,
        PAIR,
        meshes=("internal",),
    ),
    "idler": Simple(
        "Two wheels with an idler between them: they turn in the same direction.",
        PAIR,
        ("first", "idler", "second"),
        meshes=("external", "external"),
    ),
    "chain": Simple("Chain drive; without `efficiency` it has no loss.", PAIR, PAIR),
    "belt": Simple(
        "Belt drive; without `efficiency` it has no loss.", PAIR, PAIR, size="diameters"
    ),
    "shaft": Simple("Shaft or bearing with a loss: the ratio is 1.", PAIR),
    "worm": Simple(
        "Worm pair: `teeth` of the worm are its starts.",
        ("worm", "wheel"),
        ("worm", "wheel"),
    ),
    "held": Simple("A link that is held for good.", ("link",)),
}
"""All kinds of gear sets, by the name that a case uses."""

GROUP, RAVIGNEAUX = "planet_group", "ravigneaux"
