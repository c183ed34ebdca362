"""The universal multi-flow differential mechanism as cases, at its meshes and in three links.

Source: Voloshko V.V., Galimyanov I.D., Salakhov I.I., Mavleev I.R., Kinematic and force
analysis of the universal multi-flow differential mechanism of automatic gearboxes (in
Russian), figures 2 and 4. The paper has no teeth; `GOLDEN` is invented so that three pairs of
planets can be put in on one axis with equal modules.

One carrier 5 (H) has pairs of planets A = (2, 2') and B = (3, 3'), which mesh 2' with 3.
Suns 1 on 2 and 4 on 3', rings 6 on 2, 7 on 3 and 8 on 3'.

i_ab = n_a/n_b with the carrier stopped, i_ab^q = n_a/n_b with link q stopped.
"""

from collections.abc import Mapping
from fractions import Fraction
from itertools import combinations, permutations
from typing import Any

Teeth = Mapping[str, int]

GOLDEN: Teeth = {
    "1": 36,
    "2": 18,
    "6": 72,
    "2'": 21,
    "3": 30,
    "7": 84,
    "3'": 20,
    "4": 34,
    "8": 74,
}
LINKS = ("1", "4", "5", "6", "7", "8")
CARRIER = "5"
WHEELS = tuple(link for link in LINKS if link != CARRIER)
DIRECTIONS = list(permutations(LINKS, 2))
"""Every input with every output: twice the 15 pairs."""
PAIRS = list(combinations(LINKS, 2))
EXTERNAL, INTERNAL = Fraction(98, 100), Fraction(99, 100)


def gear(first: str, last: str, brake: str) -> str:
    """The name of the gear from one link to another with a third one stopped."""
    return f"{first}-{last} T{brake}"


def lock(first: str, second: str) -> str:
    """The name of the gear from 1 to 8 with two links locked together."""
    return f"lock {first}-{second}"


def internal_ratio(z: Teeth, a: str, b: str) -> Fraction:
    """i_ab from teeth: n_a/n_b with the carrier stopped."""
    if CARRIER in (a, b):
        raise ValueError("an internal ratio is that of two wheels")
    from_1 = {
        "1": Fraction(1),
        "6": -Fraction(z["6"], z["1"]),
        "7": Fraction(z["2"] * z["7"], z["1"] * z["2'"]),
        "8": Fraction(z["2"] * z["3"] * z["8"], z["1"] * z["2'"] * z["3'"]),
        "4": -Fraction(z["2"] * z["3"] * z["4"], z["1"] * z["2'"] * z["3'"]),
    }
    return from_1[b] / from_1[a]


def ratio(z: Teeth, a: str, b: str, q: str) -> Fraction:
    """i_ab^q from teeth, the general form of (5) to (8): (1 - i_aq)/(1 - i_bq)."""

    def against_stopped(link: str) -> Fraction:
        """Speed of a link for a speed 1 of the carrier, the wheel q stopped."""
        return Fraction(1) if link == CARRIER else 1 - internal_ratio(z, link, q)

    if q == CARRIER:
        return internal_ratio(z, a, b)
    return against_stopped(a) / against_stopped(b)


def element(z: Teeth, planets: int = 3) -> dict[str, Any]:
    """The mechanism as a group of planets."""
    return {
        "kind": "planet_group",
        "carrier": CARRIER,
        "planets": planets,
        "rims": {"A": {"A1": z["2"], "A2": z["2'"]}, "B": {"B1": z["3"], "B2": z["3'"]}},
        "suns": [
            {"link": "1", "teeth": z["1"], "rim": "A1"},
            {"link": "4", "teeth": z["4"], "rim": "B2"},
        ],
        "rings": [
            {"link": "6", "teeth": z["6"], "rim": "A1"},
            {"link": "7", "teeth": z["7"], "rim": "B1"},
            {"link": "8", "teeth": z["8"], "rim": "B2"},
        ],
        "meshes": [["A2", "B1"]],
    }


def controls() -> dict[str, Any]:
    """A brake on every link, a clutch between any two, and every gear that they give."""
    gears: dict[str, Any] = {
        gear(a, b, q): {"engaged": [f"T{q}"], "input": a, "output": b}
        for a, b in DIRECTIONS
        for q in LINKS
        if q not in (a, b)
    }
    gears |= {lock(a, b): {"engaged": [f"F{a}-{b}"], "input": "1", "output": "8"} for a, b in PAIRS}
    brakes = {f"T{link}": [link, "housing"] for link in LINKS}
    clutches = {f"F{a}-{b}": [a, b] for a, b in PAIRS}
    return {
        "links": list(LINKS),
        "input": "1",
        "output": "8",
        "shift_elements": brakes | clutches,
        "gears": gears,
    }


def group_case(z: Teeth = GOLDEN, **more: Any) -> dict[str, Any]:
    """The mechanism as an element `P`."""
    return {"name": "UMDM", "elements": {"P": element(z)}, **controls(), **more}


ON_RIM = {"1": ("2", EXTERNAL), "6": ("2", INTERNAL), "7": ("3", INTERNAL)} | {
    "4": ("3'", EXTERNAL),
    "8": ("3'", INTERNAL),
}
"""The rim of each wheel, and the efficiency of their mesh."""


def mesh_efficiency(a: str, b: str) -> Fraction:
    """Of a pair of wheels with the carrier stopped: of all meshes on the way."""
    (rim_a, at_a), (rim_b, at_b) = ON_RIM[a], ON_RIM[b]
    between = EXTERNAL if (rim_a == "2") != (rim_b == "2") else 1
    return at_a * at_b * between


def star_case(center: str, z: Teeth = GOLDEN) -> dict[str, Any]:
    """Four three-link mechanisms on the carrier that have a wheel in common."""
    return {
        "name": f"UMDM, star on {center}",
        "mechanisms": {
            f"{center}{other}": {
                "first": center,
                "second": other,
                "third": CARRIER,
                "ratio": str(internal_ratio(z, center, other)),
                "efficiency": float(mesh_efficiency(center, other)),
            }
            for other in WHEELS
            if other != center
        },
        **controls(),
    }
