"""All warnings and notes about the teeth of gear sets, with nearby tooth numbers that would fit."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from random import Random

from vstatics.core.elements.drawing import Drawing
from vstatics.core.elements.element import Element
from vstatics.core.elements.group import group_of
from vstatics.core.elements.group_checks import wheel_path
from vstatics.core.elements.kinds import Planetary
from vstatics.core.elements.teeth.assembly import assemblable, bevel_assembled
from vstatics.core.elements.teeth.conditions import UNCUT
from vstatics.core.elements.teeth.layout import Doubt, Key, Teeth
from vstatics.core.elements.teeth.meshing import hunting, interfering, undercut
from vstatics.core.elements.teeth.nearby import nearest
from vstatics.core.elements.teeth.spacing import counts, fitting_numbers, of_planets
from vstatics.core.elements.teeth.subjects import OfPlanets, OfWheels, Subject, suggested
from vstatics.core.errors import Path, Problem

HALF_A_TOOTH = "N311"
"""Note about a planet that would need half a tooth."""
TOUCHING = "N315"
"""Note about gears whose tips would touch in a common plane."""
USUAL_PLANETS = range(3, 7)
"""Usual numbers of planets. At least one of them must fit if a gear set omits the number."""
_PAIRS = ("gear_pair", "internal_pair", "idler")
_UNCHECKED: Mapping[str, Sequence[tuple[float, float]]] = {
    "chain": [(UNCUT, math.inf)] * 2,
    "bevel_pair": [(UNCUT, math.inf)] * 2,
    "worm": [(1, 4), (28, math.inf)],
}
"""Usual range of the teeth of each gear, for kinds of gear set whose teeth are not checked."""


def doubts(drawing: Drawing) -> Iterator[Problem]:
    """Yield the warnings and notes about the teeth of gear sets, in the order of the drawing.

    Parameters
    ----------
    drawing : Drawing
        Gear sets that have passed `vstatics.core.elements.checks`.

    Yields
    ------
    Problem
        Warning or note, never an error, with the path of the teeth.

    Notes
    -----
    The conditions for coaxiality, assembly, neighbouring planets and undercut are taken from the
    synthesis of planetary gears (Willis; for Ravigneaux sets Simionescu). Gear sets with fractional
    teeth are not checked, nor are belts, chains, worms and bevel pairs.

    Examples
    --------
    >>> members = {"sun": 1, "ring": 2, "carrier": 3}
    >>> given = Element("P", "planetary", members, {"sun": 47, "ring": 97}, planets=5)
    >>> (problem,) = doubts(Drawing(3, [given]))
    >>> print(problem.message.replace("; ", "\\n"))
    5 equally spaced planets cannot be assembled: (sun + ring)/planets = 144/5 is not whole
    they fit at multiples of 1/144 turn
    4 or 6 planets fit
    nearest that fit: sun 46, ring 94 (ratio -2.0435) or sun 49, ring 101 (ratio -2.0612)
    """
    for number, element in enumerate(drawing.elements, 1):
        for doubt in _doubts(element):
            path = ("elements", number, *_place(element, doubt.about))
            yield Problem(doubt.id, doubt.message, path)


def misfits(element: Element) -> Iterator[str]:
    """Yield the identifiers of the warnings and notes that prevent the assembly of a gear set.

    >>> members, teeth = {"sun": 1, "ring": 2, "carrier": 3}, {"sun": 30, "ring": 75}
    >>> list(misfits(Element("P", "planetary", members, teeth, planets=4)))
    ['N311', 'W317']
    """
    if subject := _subject(element):
        identifiers = (doubt.id for doubt in _wrong(subject))
        yield from (
            identifier
            for identifier in identifiers
            if identifier == HALF_A_TOOTH or identifier.startswith("W")
        )


def _doubts(element: Element) -> Iterator[Doubt]:
    if subject := _subject(element):
        yield from _with_cures(subject)
    elif element.kind == "chain" and _whole(element):
        for name, teeth in element.teeth.items():
            if teeth < UNCUT:
                message = (
                    f"{name} {teeth:g} runs roughly: expected {UNCUT} teeth or more for a chain"
                )
                yield Doubt("N316", message, name)


def _subject(element: Element) -> Subject | None:
    """Return the teeth of a gear set for the checks; None for kinds or teeth not checked."""
    if not _whole(element) or element.ratios:
        return None
    if isinstance(element.shape, Planetary):
        return OfPlanets(element)
    asked = element.teeth and element.shape.meshes and element.kind not in ("bevel_pair", "chain")
    return OfWheels(element) if asked else None


def _whole(element: Element) -> bool:
    return all(float(count).is_integer() for count in element.teeth.values())


def _place(element: Element, about: Key | None) -> Path:
    """Return the path, within a gear set, of the teeth to which a warning refers."""
    if about is None:
        return ("planets",)
    if isinstance(about, int) and element.rims:
        return (*wheel_path(element, element.wheels[about]), "teeth")
    if isinstance(about, int):
        return ("teeth", group_of(element).wheels[about].member)
    for planet, rims in element.rims.items():
        if about in rims:
            return ("rims", planet, about)
    return ("teeth", about) if about in element.teeth else ("teeth",)


def fitting(element: Element, random: Random) -> Iterator[Teeth]:
    """Yield teeth similar to a gear set's teeth with which it can be assembled, in random order.

    A gear set without a number of planets can have 3 to 6. The teeth of chains, worms and bevel
    pairs stay in the usual range, extended to include the present teeth. Gear sets without teeth
    yield nothing.

    >>> members, teeth = {"sun": 1, "ring": 2, "carrier": 3}, {"sun": 24, "ring": 72}
    >>> found = list(fitting(Element("P", "planetary", members, teeth, planets=5), Random(1)))
    >>> len(found), {(one[0] + one[1]) % 5 for one in found}
    (59, {0})
    """
    subject = _subject(element)
    if subject is None:
        yield from _usual_teeth(element, random)
        return
    is_right = _rule(subject)
    layout = subject.layout if element.planets is None and isinstance(subject, OfPlanets) else None
    choices = list(nearest(subject.space, wide=True))
    random.shuffle(choices)
    for teeth in assemblable(subject, choices):
        if is_right(teeth) and (layout is None or fitting_numbers(layout(teeth), USUAL_PLANETS)):
            yield teeth


def _usual_teeth(element: Element, random: Random) -> Iterator[Teeth]:
    if not element.teeth or not _whole(element) or element.kind not in _UNCHECKED:
        return
    usual = _UNCHECKED[element.kind]
    limits = [
        (min(least, given), max(most, given))
        for given, (least, most) in zip(element.teeth.values(), usual, strict=True)
    ]
    choices = list(nearest(OfWheels(element).space, wide=True))
    random.shuffle(choices)
    for teeth in choices:
        pairs = zip(teeth.values(), limits, strict=True)
        if all(least <= count <= most for count, (least, most) in pairs):
            yield teeth


def _rule(subject: Subject) -> Callable[[Teeth], bool]:
    """Return a function that accepts tooth numbers without removable causes of warnings.

    Profile shift and touching tips are accepted only if the present tooth numbers have them, too.
    """
    least = min((wheel.teeth for wheel in subject.wheels().values()), default=0)
    touching = any(doubt.id == TOUCHING for doubt in _wrong(subject))

    def is_right(teeth: Teeth) -> bool:
        return (
            min(teeth.values()) >= min(least, UNCUT)
            and 1 not in subject.ratios(teeth)  # a basic ratio of 1 would lock up the gear set
            and not any(
                doubt.has_cure or (doubt.id == TOUCHING and not touching)
                for doubt in _wrong(subject, teeth)
            )
        )

    return is_right


def _with_cures(subject: Subject) -> Iterator[Doubt]:
    """Yield the warnings and notes about a gear set.

    The first message whose cause other tooth numbers can remove suggests such numbers.
    """
    doubts_found = [*_wrong(subject)]
    is_right = _rule(subject)
    cures, has_cure = "", True
    if any(doubt.has_cure for doubt in doubts_found):
        cures = suggested(
            subject, filter(is_right, assemblable(subject, nearest(subject.space))), "that fit"
        )
        has_cure = bool(cures)
    for doubt in doubts_found:
        hint = counts(subject) if doubt.about is None else ""
        if doubt.has_cure:
            hint, cures = hint + cures, ""
        yield doubt._replace(message=doubt.message + hint)
    if subject.element.planets is None and subject.element.kind not in _PAIRS:
        return
    for doubt in hunting(subject.meshes(), subject.against):
        coprime = filter(subject.is_hunting, nearest(subject.space) if has_cure else ())
        hint = suggested(
            subject, filter(is_right, assemblable(subject, coprime)), "without a common divisor"
        )
        yield doubt._replace(message=doubt.message + hint)


def _wrong(subject: Subject, teeth: Teeth | None = None) -> Iterator[Doubt]:
    """Yield all warnings and notes except about wear, optionally for other tooth numbers."""
    if isinstance(subject, OfPlanets):
        yield from of_planets(subject.layout(teeth))
    if subject.element.kind == "bevel":
        yield from bevel_assembled(subject.element, teeth or subject.known())
    else:
        yield from undercut(subject.wheels(teeth).values())
        yield from interfering(subject.meshes(teeth))
