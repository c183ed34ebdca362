"""The shapes of typical elements in YAML and JSON, made from the declaration of their kinds."""

from __future__ import annotations

from dataclasses import replace
from typing import get_args

from vstatics.elements.element import Losses, MeshEfficiency
from vstatics.elements.kinds import GROUP, KINDS, Kind, Planetary, Simple
from vstatics.readers.named.shape import (
    COUNT,
    LINK,
    NUMBER,
    TEXT,
    ByKind,
    Key,
    Leaf,
    ListOf,
    Named,
    Pair,
    Record,
)

_EFFICIENCY = {"exclusiveMinimum": 0, "maximum": 1}
_MESHES = {
    "external": "Two external wheels.",
    "internal": "A wheel in a ring.",
    "bevel": "Two bevel wheels.",
}

MESH_EFFICIENCY = Record(
    "Efficiencies of meshes",
    "Efficiency of a single mesh, both axes held.",
    tuple(
        Key(mesh, NUMBER, text, limits={**_EFFICIENCY, "default": default})
        for (mesh, text), default in zip(_MESHES.items(), MeshEfficiency(), strict=True)
    ),
)

_KIND = Key("kind", TEXT, "What the element is.")
_COMMON = (
    Key("efficiency", NUMBER, "As one mechanism, its third member held.", limits=_EFFICIENCY),
    Key("mesh_efficiency", MESH_EFFICIENCY, "Of this element's meshes."),
)
_PLANETS = Key("planets", COUNT, "Planets, or sets of meshed planets, around the axis.")


def _record(name: str, kind: Kind) -> Record:
    """The keys of a kind."""
    if name == GROUP:
        return _GROUP
    optional = kind.optional if isinstance(kind, Planetary) else frozenset()
    members = tuple(
        Key(member, LINK, f"Link of the member {member}.", required=member not in optional)
        for member in kind.members
    )
    if not kind.toothed:
        return Record(name, kind.description, (_KIND, *members, *_COMMON))
    if isinstance(kind, Simple):
        leaf = COUNT if kind.size == "teeth" else NUMBER
        size = Key(kind.size, _toothed(kind, leaf), "Of the wheels.", not kind.optional_teeth)
        common = (_WORM,) if name == "worm" else _COMMON
        common = (_PLANETS, *common) if name == "bevel" else common
        return Record(name, kind.description, (_KIND, *members, size, *common))
    size = Key("teeth", _toothed(kind, COUNT), "Of wheels and planets.", required=True)
    return Record(name, kind.description, (_KIND, *members, size, _PLANETS, *_COMMON))


def _toothed(kind: Kind, leaf: Leaf) -> Record:
    keys = tuple(Key(name, leaf, f"Of {name}.") for name in kind.toothed)
    return Record("Sizes of wheels", "Teeth, or diameters, by wheel.", keys)


_WORM = Key(
    "efficiency",
    Record(
        "Efficiencies of a worm pair",
        "Which of the two drives.",
        (
            Key("worm", NUMBER, "The worm drives.", required=True, limits=_EFFICIENCY),
            Key(
                "wheel",
                NUMBER,
                "The wheel drives; 0 if the pair is self-locking.",
                required=True,
                limits={"minimum": 0, "maximum": 1},
            ),
        ),
    ),
    "With the worm driving, and with the wheel.",
    required=True,
)
_WHEEL = Record(
    "Central wheel",
    "A sun or a ring of a group of planets.",
    (
        Key("link", LINK, "The link that it belongs to.", required=True),
        Key("teeth", COUNT, "Its teeth.", required=True),
        Key("rim", TEXT, "The rim that it meshes with.", required=True),
    ),
)
_GROUP = Record(
    GROUP,
    KINDS[GROUP].description,
    (
        _KIND,
        Key("carrier", LINK, "Link that bears the planets.", required=True),
        Key(
            "rims",
            Named("planet", Named("rim", COUNT)),
            "Planets, each with its rims and their teeth.",
            required=True,
            examples=({"A": {"A1": 18, "A2": 21}},),
        ),
        Key("suns", ListOf(_WHEEL), "Central wheels inside the planets."),
        Key("rings", ListOf(_WHEEL), "Central wheels around the planets."),
        Key("meshes", ListOf(Pair("rim")), "Pairs of rims of planets that mesh."),
        _PLANETS,
        *_COMMON,
    ),
)

ELEMENT = ByKind({name: _record(name, kind) for name, kind in KINDS.items()})
LOSSES = Leaf("choice", get_args(Losses))


DRAWN = (
    Key("losses", LOSSES, "Where losses are calculated; `meshes` where planets are shared."),
    Key("mesh_efficiency", MESH_EFFICIENCY, "Of all elements that give none themselves."),
    Key("elements", Named("element", ELEMENT), "Typical elements in order, each under its name."),
)


def drawn(case: Record) -> Record:
    """The shape of a case that does list elements."""
    keys = [replace(key, required=key.required or key.name == "elements") for key in case.keys]
    return replace(case, keys=tuple(keys))


def with_elements(case: Record) -> Record:
    """The shape of a case that may list elements in place of links and mechanisms."""
    keys = [
        replace(key, required=False) if key.name in ("links", "mechanisms") else key
        for key in case.keys
    ]
    at = [key.name for key in keys].index("mechanisms")
    return replace(case, keys=(*keys[:at], *DRAWN, *keys[at:]))
