"""Writer of decks, with the headings and fields of the published example."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from math import nan
from typing import TYPE_CHECKING, Any

from vstatics.core.model.parts import Law, element_name, mechanism_name
from vstatics.core.model.transmission import SpeedOf, Transmission
from vstatics.core.readers.deck.table import FIELDS
from vstatics.core.readers.deck.text import SPRING
from vstatics.core.readers.deck.text import SPRINGS as KSPR
from vstatics.core.tables.numbers import exponent
from vstatics.core.texts import Language, translated

if TYPE_CHECKING:
    from vstatics.core.model.shape import ByKey

SPRINGS = "Springs, their twists by links (no deck has them: take the YAML or JSON of the case):"
NAME = "NAME "
"""Beginning of a line with a name."""
KINDS = {
    "dog_clutch": "that {} is a dog clutch",
    "freewheel": "that {} is a freewheel; it is engaged where it holds",
}
"""Messages about kinds of shift elements for which a deck has no field."""

DECK_KEYS = {
    *("name", "links", "input", "output", "idle", "coast", "shift_elements", "mechanisms", "gears"),
    *("kind", "engaged", "speeds", "torques"),
    *("first", "second", "third", "ratio", "efficiency", "planet_ratio"),
}
"""Keys of YAML and JSON that have fields in a deck. Some values of `kind` have no field."""


def write(case: Transmission, lang: Language = "en") -> str:
    """Return a case as a deck. Reading the deck gives an equal case, except for parts from `lost`.

    Speeds that are multiples of other links' speeds must first be converted by
    `Results.with_numbers_only`. Springs are written under a heading that marks them as unreadable.
    `check_deck` raises an error for springs.

    Parameters
    ----------
    case : Transmission
    lang : {"en", "ru"}
        Language of the headings.
    """
    lines = [*template(case), *case.derived(_further_lines)]
    if lang != "en":
        lines = [line if line.startswith(NAME) else translated(line, lang) for line in lines]
    return "\n".join(lines) + "\n"


def template(case: Transmission) -> Iterator[str]:
    """Yield the fields of a deck with English headings."""
    elements, mechanisms = case.shift_elements, case.mechanisms
    planets = {
        number: mechanism.planet_ratio
        for number, mechanism in enumerate(mechanisms, 1)
        if mechanism.planet_ratio is not None
    }
    yield "STRUCTURE"
    yield f"KJG= {case.links} KL= {len(elements)} KG= {len(mechanisms)} KNM= {len(planets)}"
    yield from case.derived(_links_of_devices)
    yield from _lists("mechanisms", mechanisms, float)
    if planets:
        yield "Mechanisms with a planet ratio of their own:"
        yield _row("NNM(K),K=1,KNM:", planets)
        yield "Ratios from the first link to the planet:"
        yield "UAQ(K),K=1,KNM:"
        yield _row("", map(exponent, planets.values()))
    if case.springs:
        yield SPRINGS
        yield f"{KSPR}= {len(case.springs)}"
        for spring in case.springs:  # `SPRING .1000E+01*1 -.1000E+01*2: S`
            form = (f"{exponent(part)}*{link}" for link, part in spring.form.items())
            yield f"{SPRING}{' '.join(form)}: {spring.name}"
    yield from case.derived(_gears)


def lost(case: Transmission) -> list[str]:
    """Return the parts of a case that a deck cannot contain, such as the description."""
    from vstatics.core.model.checks import carried_keys
    from vstatics.core.model.keys import (  # costs start-up time
        CASE,
        ELEMENT,
        GEAR,
        MECHANISM,
        with_carried,
    )

    elements = case.shift_elements
    named = (
        ("shift element", ELEMENT, elements),
        ("gear", GEAR, case.gears),
        ("mechanism", MECHANISM, case.mechanisms),
    )
    return [
        *_unkept(case, with_carried(CASE, carried_keys(case))),
        *(KINDS[part.kind].format(part.name) for part in elements if part.kind in KINDS),
        *(
            f"{key} of {what} {part.name}"
            for what, shape, parts in named
            for part in parts
            for key in _unkept(part, shape)
        ),
        *(f"third: housing of mechanism {part.name}" for part in case.mechanisms if part.is_set),
        *(
            f"speed of link {case.link_name(link)} in gear {gear.name} as that of another link"
            for gear in case.gears
            for link, speed in gear.speeds.items()
            if isinstance(speed, SpeedOf)
        ),
        *(f"kind of gear {gear.name}" for gear in case.gears if gear.kind != "gear"),
        *(f"coast of gear {gear.name}" for gear in case.gears if gear.coast is not None),
    ]


def _unkept(part: object, shape: ByKey) -> Iterator[str]:
    """Yield the keys of a part that have no field in a deck and a value other than the default."""
    for key in shape.keys:
        if key.name not in DECK_KEYS and not key.leaves_out(getattr(part, key.name, None)):
            yield key.name


def _links_of_devices(case: Transmission) -> list[str]:
    elements = case.shift_elements
    of_elements = _lists("shift_elements", elements, int) if elements else ()
    return [*of_elements, *_lists("mechanisms", case.mechanisms, int)]


def _lists(part: str, parts: Sequence[object], kind: type[float]) -> Iterator[str]:
    """Yield the lists of numbers of a type. Lists for gears with only defaults are omitted."""
    for key, field in FIELDS.items():
        if field.part != part or field.kind is not kind:
            continue
        values = [getattr(item, field.member) or 0 for item in parts]
        if part != "gears" or any(values):
            yield field.heading
            heading = f"{key}{'' if '(' in key else '(I)'},I=1,{field.size}:"
            if kind is float:
                yield heading
                # A law, which depends on the operating point, has no number.
                numbers = (nan if isinstance(value, Law) else value for value in values)
                heading, values = "", [*map(exponent, numbers)]
            yield _row(heading, values)


def _gears(case: Transmission) -> list[str]:
    gears = case.gears
    engaged = [gear.engaged for gear in gears]
    numbers = [_row("", row) for row in engaged if row]
    if numbers:
        heads = ["Their numbers, a line for each gear:", "(NFRI(K,I),K=1,KFRI(I)),I=1,NP:"]
        numbers = [*heads, *numbers]
    return [
        "GEARS",
        f"NP= {len(gears)}",
        "Engaged elements in each gear:",
        _row("KFRI(I),I=1,NP:", map(len, engaged)),
        *numbers,
        "Further given speeds in each gear:",
        _row("KWZ(I),I=1,NP:", (len(gear.speeds) for gear in gears)),
        *_given([gear.speeds for gear in gears], "KWZ", "NWZ", "WZ"),
        "Further external torques in each gear:",
        _row("KMZ(I),I=1,NP:", (len(gear.torques) for gear in gears)),
        *_given([gear.torques for gear in gears], "KMZ", "NMZ", "AMZ"),
    ]


def _given(
    gears: Sequence[Mapping[int, Any]], count: str, links: str, values: str
) -> Iterator[str]:
    """Yield links and values of prescribed speeds or torques, with a line for each gear."""
    if any(gears):
        yield "Their links:"
        yield f"({links}(K,I),K=1,{count}(I)),I=1,NP:"
        yield from (_row("", row) for row in gears if row)
        yield "Their values:"
        yield f"({values}(K,I),K=1,{count}(I)),I=1,NP:"
        yield from (_row("", map(exponent, row.values())) for row in gears if row)


def _further_lines(case: Transmission) -> list[str]:
    return [*_conditions(case), *_names(case)]


def _conditions(case: Transmission) -> Iterator[str]:
    """Yield the fields of input, output and conventions that do not have the default value."""
    conditions = {
        f"INP= {case.input}": case.input != 1,
        f"IOUT= {case.output}": case.output != case.links,
        "IDLE= 1": case.idle == "exact",
        f"COAST= {int(case.coast or False)}": case.coast is not None,
    }
    if any(conditions.values()):
        yield "Further conditions:"
        yield from (line for line, holds in conditions.items() if holds)
    yield from _lists("gears", case.gears, int)


def _names(case: Transmission) -> Iterator[str]:
    elements = [part._replace(kind="") if part.kind else part for part in case.shift_elements]
    names = [
        ("T", case.name, ""),
        *((f"J{n}", name, str(n)) for n, name in enumerate(case.link_names, 1)),
        *((f"F{n}", part.name, element_name(n, part)) for n, part in enumerate(elements, 1)),
        *((f"D{n}", part.name, mechanism_name(n)) for n, part in enumerate(case.mechanisms, 1)),
        *((f"P{n}", gear.name, str(n)) for n, gear in enumerate(case.gears, 1)),
    ]
    named = [f"{NAME}{part}: {name}" for part, name, default in names if name != default]
    if named:
        yield "Given names:"
        yield from named


def _row(heading: str, values: Iterable[object]) -> str:
    return " ".join([*([heading] if heading else []), *map(str, values)])
