"""Keys of gear sets in YAML and JSON, derived from the declaration of their kinds.

Some keys differ from the attributes of `Element`. `record_of` and `element_of` convert between an
`Element` and a record, which is a mapping with the keys.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, get_args

from vstatics.core.elements.element import CentralWheel, Element, Losses, MeshEfficiency, PlanetMass
from vstatics.core.elements.kinds import GROUP, KINDS, RAVIGNEAUX, Kind, Simple
from vstatics.core.model.keys import EFFICIENCY
from vstatics.core.model.parts import HOUSING, NO_DAMPING
from vstatics.core.model.shape import (
    COUNT,
    LINK,
    NUMBER,
    TEXT,
    ByKey,
    ByKind,
    ByName,
    KeyShape,
    Leaf,
    ListOf,
    Pair,
    Shape,
)
from vstatics.core.model.torsional_keys import ELASTIC

_WHEELS = (("suns", False), ("rings", True))
_EFFICIENCY = {"exclusiveMinimum": 0, "maximum": 1}
_NOT_NEGATIVE = {"minimum": 0}
_MESHES = {
    "external": "Mesh of two external gears.",
    "internal": "Mesh of an external gear in a ring gear.",
    "bevel": "Mesh of two bevel gears.",
}

MESH_EFFICIENCY = ByKey(
    "Efficiencies of meshes",
    "Efficiency of a single mesh with both axes held.",
    (
        *(
            KeyShape(mesh, NUMBER, text, limits={**_EFFICIENCY, "default": default})
            for (mesh, text), default in zip(_MESHES.items(), MeshEfficiency(), strict=True)
        ),
        KeyShape(
            "friction",
            NUMBER,
            "Coefficient of friction of the teeth, from which efficiencies that are not given "
            "follow, except for bevel gears.",
            limits={"exclusiveMinimum": 0, "exclusiveMaximum": 1},
            examples=(0.06,),
        ),
    ),
)

_KIND = KeyShape("kind", TEXT, "Kind of the gear set.")
_COMMON = (
    KeyShape(
        "efficiency",
        EFFICIENCY,
        "Efficiency of the gear set as a single mechanism with its third member held.",
        limits=_EFFICIENCY,
    ),
    KeyShape(
        "back_efficiency",
        EFFICIENCY,
        "Efficiency if power flows from the second member to the first; by default `efficiency`, "
        "without which it has no meaning.",
        limits={"minimum": 0, "maximum": 1},
    ),
    KeyShape("mesh_efficiency", MESH_EFFICIENCY, "Efficiencies of the meshes of this gear set."),
    *ELASTIC,
)
_PLANET_MASS = ByKey(
    "Planet",
    "Inertia and mass of a single planet, for vibration.",
    (
        KeyShape(
            "inertia",
            Leaf("inertia"),
            "Moment of inertia about the axis of the planet, in kg*m^2.",
            default=0,
            limits=_NOT_NEGATIVE,
        ),
        KeyShape(
            "mass", Leaf("mass"), "Mass of the planet, in kg.", default=0, limits=_NOT_NEGATIVE
        ),
        KeyShape(
            "radius",
            Leaf("length"),
            "Distance of the pin from the axis of the gear set, in m; required with a mass.",
            default=0,
            limits=_NOT_NEGATIVE,
        ),
    ),
    PlanetMass,
)
_RATIOS = KeyShape(
    "ratios",
    ByKey(
        "Ratios of suns",
        "Basic ratios of each sun to the ring, with the carrier held.",
        (
            KeyShape("small_sun", NUMBER, "Ratio of the small sun, above 1.", required=True),
            KeyShape("large_sun", NUMBER, "Ratio of the large sun, below -1.", required=True),
        ),
    ),
    "Ratios instead of `teeth`, while the tooth numbers are unknown.",
)
_PLANETS = KeyShape(
    "planets", COUNT, "Number of planets, or of groups of meshed planets, around the axis."
)


def _record(name: str, kind: Kind) -> ByKey:
    if name == GROUP:
        return _GROUP
    members = tuple(
        KeyShape(
            member, LINK, f"Link of the member `{member}`.", required=member not in kind.optional
        )
        for member in kind.members
    )
    if not kind.toothed:
        return ByKey(name, kind.description, (_KIND, *members, *_COMMON))
    if isinstance(kind, Simple):
        leaf = COUNT if kind.size == "teeth" else NUMBER
        size = KeyShape(
            kind.size,
            _toothed(kind, leaf),
            "Tooth numbers, or diameters, of the gears or pulleys.",
            not kind.optional_teeth,
        )
        common = (_WORM, *ELASTIC) if name == "worm" else _COMMON
        common = (_PLANETS, *common, _planet(("planet",))) if name == "bevel" else common
        return ByKey(name, kind.description, (_KIND, *members, size, *common))
    has_ratios = name == RAVIGNEAUX
    size = KeyShape(
        "teeth",
        _toothed(kind, COUNT),
        "Tooth numbers of central gears and planets.",
        not has_ratios,
    )
    ratios = (_RATIOS,) * has_ratios
    last = _planet(tuple(kind.planets))
    return ByKey(name, kind.description, (_KIND, *members, size, *ratios, _PLANETS, *_COMMON, last))


def _planet(names: Sequence[str] = ()) -> KeyShape:
    """Return the declaration of the key `planet`, with a mass for each of several planets."""
    shape: Shape = ByName("planet", _PLANET_MASS)
    if len(names) == 1:
        shape = _PLANET_MASS
    elif names:
        keys = tuple(
            KeyShape(name, _PLANET_MASS, f"A single planet of the kind `{name}`.") for name in names
        )
        shape = ByKey("Planets", "Masses of planets, by name.", keys)
    return KeyShape("planet", shape, "Inertia and mass of one of the `planets`.")


def _toothed(kind: Kind, leaf: Leaf) -> ByKey:
    keys = tuple(KeyShape(name, leaf, f"Size of `{name}`.") for name in kind.toothed)
    return ByKey("Sizes of wheels", "Tooth numbers or diameters, by member.", keys)


_WORM = KeyShape(
    "efficiency",
    ByKey(
        "Efficiencies of a worm pair",
        "Efficiency for each of the two gears as the driving gear.",
        (
            KeyShape(
                "worm",
                EFFICIENCY,
                "Efficiency if the worm drives.",
                required=True,
                limits=_EFFICIENCY,
            ),
            KeyShape(
                "wheel",
                EFFICIENCY,
                "Efficiency if the wheel drives; 0 if the pair is self-locking.",
                required=True,
                limits={"minimum": 0, "maximum": 1},
            ),
        ),
    ),
    "Efficiencies with the worm and with the wheel driving.",
    required=True,
)
_WHEEL = ByKey(
    "Central wheel",
    "Sun or ring gear of a group of planets.",
    (
        KeyShape("link", LINK, "Link to which the gear belongs.", required=True),
        KeyShape("teeth", COUNT, "Number of teeth.", required=True),
        KeyShape("rim", TEXT, "Planet gear with which the gear meshes.", required=True),
    ),
)
_GROUP = ByKey(
    GROUP,
    KINDS[GROUP].description,
    (
        _KIND,
        KeyShape("carrier", LINK, "Link that bears the planets.", required=True),
        KeyShape(
            "rims",
            ByName("planet", ByName("rim", COUNT)),
            "Planets, each with the tooth numbers of its planet gears.",
            required=True,
            examples=({"A": {"A1": 18, "A2": 21}},),
        ),
        KeyShape("suns", ListOf(_WHEEL), "Sun gears, inside the planets."),
        KeyShape("rings", ListOf(_WHEEL), "Ring gears, around the planets."),
        KeyShape("meshes", ListOf(Pair("rim")), "Pairs of meshing planet gears."),
        _PLANETS,
        *_COMMON,
        _planet(),
    ),
)

ELEMENT = ByKind({name: _record(name, kind) for name, kind in KINDS.items()})
LOSSES = Leaf("choice", get_args(Losses))


DRAWN = (
    KeyShape(
        "losses",
        LOSSES,
        "Place of the losses; by default `meshes` in gear sets with shared planets.",
    ),
    KeyShape(
        "mesh_efficiency",
        MESH_EFFICIENCY,
        "Efficiencies of meshes in all gear sets that do not give their own.",
    ),
    KeyShape("elements", ByName("element", ELEMENT), "Gear sets in order, each under its name."),
)


def with_elements(case: ByKey, *, required: bool = False) -> ByKey:
    """Return the declaration of the keys of a case, extended by the keys of gear sets.

    `links` and `mechanisms` become optional. `elements` is required only if `required` is true.
    """
    needed = {key.name for key in case.keys if key.required} - {"links", "mechanisms"}
    needed |= {"elements"} if required else set()
    at = [key.name for key in case.keys].index("mechanisms")
    keys = (*case.keys[:at], *DRAWN, *case.keys[at:])
    return case._replace(keys=tuple(key._replace(required=key.name in needed) for key in keys))


def record_of(element: Element) -> dict[str, Any]:
    """Return a gear set as a record, with link numbers instead of names."""
    record: dict[str, Any] = {
        "kind": element.kind,
        **element.members,
        getattr(element.shape, "size", "teeth"): element.teeth,
        "ratios": element.ratios,
        "planets": element.planets,
        "efficiency": element.efficiency,
        "back_efficiency": element.back_efficiency,
        "mesh_efficiency": element.mesh_efficiency,
        "rims": element.rims,
        "meshes": element.meshes,
        "stiffness": element.stiffness,
        "damping": element.damping,
        "planet": _masses(element),
    }
    for key, internal in _WHEELS:
        record[key] = [wheel for wheel in element.wheels if wheel.internal == internal]
    if element.kind == "worm":
        record["efficiency"] = {"worm": element.efficiency, "wheel": record.pop("back_efficiency")}
    return record


def _masses(element: Element) -> Mapping[str, PlanetMass] | PlanetMass | None:
    masses = element.planet_masses
    if element.kind == GROUP or len(element.planet_names) > 1:
        return dict(masses)
    return next(iter(masses.values()), None)


def element_of(name: str, record: Mapping[str, Any], link_names: Sequence[str]) -> Element:
    """Return the gear set of a record. Gears of a planet group get the names of their links."""
    kind = record["kind"]
    efficiency, back = record.get("efficiency"), record.get("back_efficiency")
    if isinstance(efficiency, dict):
        efficiency, back = efficiency["worm"], efficiency["wheel"]
    masses = record.get("planet", {})
    return Element(
        name,
        kind,
        {member: record[member] for member in KINDS[kind].members if member in record},
        record.get("teeth", record.get("diameters", {})),
        record.get("planets"),
        efficiency,
        back,
        record.get("mesh_efficiency", {}),
        record.get("rims", {}),
        tuple(_wheels(record, link_names)),
        tuple(map(tuple, record.get("meshes", ()))),
        record.get("stiffness"),
        record.get("damping", NO_DAMPING),
        {"planet": masses} if isinstance(masses, PlanetMass) else masses,
        record.get("ratios", {}),
    )


def _wheels(record: Mapping[str, Any], link_names: Sequence[str]) -> Iterator[CentralWheel]:
    """Yield suns, then rings, named after their links. Suffixes make the names unique."""
    gears = [(wheel, internal) for key, internal in _WHEELS for wheel in record.get(key, ())]
    links = Counter(wheel["link"] for wheel, _ in gears)
    taken = {"carrier", *record.get("rims", ())}
    for wheel, internal in gears:
        link, rim = wheel["link"], wheel["rim"]
        member = link_names[link - 1] if link > HOUSING else "housing"
        if links[link] > 1 or member in taken:
            member += f"/{rim}"
        if member in taken:
            member += " (ring)" if internal else " (sun)"
        taken.add(member)
        yield CentralWheel(member, link, wheel["teeth"], internal, rim)
