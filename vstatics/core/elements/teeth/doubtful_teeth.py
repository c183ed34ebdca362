"""All doubts about the teeth of elements, with what nearby teeth would do."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from random import Random

from vstatics.core.elements.drawing import Drawing
from vstatics.core.elements.element import Element
from vstatics.core.elements.group import group_of
from vstatics.core.elements.group_checks import wheel_path
from vstatics.core.elements.kinds import Planetary
from vstatics.core.elements.teeth.assembly import bevel_assembled, that_go_in
from vstatics.core.elements.teeth.conditions import UNCUT
from vstatics.core.elements.teeth.layout import Doubt, Key, Teeth
from vstatics.core.elements.teeth.meshing import hunting, interfering, undercut
from vstatics.core.elements.teeth.nearby import nearest
from vstatics.core.elements.teeth.spacing import counts, of_planets, those_that_go_in
from vstatics.core.elements.teeth.subjects import OfPlanets, OfWheels, Subject, suggested
from vstatics.core.errors import Path, Problem

HALF_A_TOOTH = "N311"
"""What is told of a planet that would need one."""
TOUCHING = "N315"
"""What is told of tips that touch where they stand side by side, as they need not."""
USUAL_PLANETS = range(3, 7)
"""Numbers of planets, one of which must go in where the element tells none."""
_PAIRS = ("gear_pair", "internal_pair", "idler")
_UNCHECKED: Mapping[str, Sequence[tuple[float, float]]] = {
    "chain": [(UNCUT, math.inf)] * 2,
    "bevel_pair": [(UNCUT, math.inf)] * 2,
    "worm": [(1, 4), (28, math.inf)],
}
"""Teeth that are usual where none are checked: of each wheel the least and the most."""


def doubts(drawing: Drawing) -> Iterator[Problem]:
    """What is doubtful about the teeth of a drawing's elements, in their order.

    Parameters
    ----------
    drawing : Drawing
        Elements without errors (`vstatics.core.elements.checks`).

    Yields
    ------
    Problem
        Warnings and notes, never errors, with the path of what they are about.

    Notes
    -----
    Conditions of coaxiality, assembly, neighbouring planets and undercut as the synthesis
    of planetary gears has them (after Willis; Ravigneaux sets after Simionescu). What has
    no whole number of teeth is left out; so are belts, worms, bevel pairs.

    Examples
    --------
    >>> members = {"sun": 1, "ring": 2, "carrier": 3}
    >>> given = Element("P", "planetary", members, {"sun": 47, "ring": 97}, planets=5)
    >>> (problem,) = doubts(Drawing(3, [given]))
    >>> print(problem.message.replace("; ", "\\n"))
    5 equally spaced planets can't be assembled: (sun + ring)/planets = 144/5 is not whole
    they fit at multiples of 1/144 turn
    4 or 6 planets fit
    nearest that fit: sun 46, ring 94 (ratio -2.0435) or sun 49, ring 101 (ratio -2.0612)
    """
    for number, element in enumerate(drawing.elements, 1):
        for doubt in _doubts(element):
            path = ("elements", number, *_place(element, doubt.about))
            yield Problem(doubt.id, doubt.message, path)


def misfits(element: Element) -> Iterator[str]:
    """Identities of the doubts that keep an element from being put together.

    >>> members, teeth = {"sun": 1, "ring": 2, "carrier": 3}, {"sun": 30, "ring": 75}
    >>> list(misfits(Element("P", "planetary", members, teeth, planets=4)))
    ['N311', 'W317']
    """
    if subject := _subject(element):
        found = (doubt.id for doubt in _wrong(subject))
        yield from (one for one in found if one == HALF_A_TOOTH or one.startswith("W"))


def _doubts(element: Element) -> Iterator[Doubt]:
    if subject := _subject(element):
        yield from _with_cures(subject)
    elif element.kind == "chain" and _whole(element):
        for name, teeth in element.teeth.items():
            if teeth < UNCUT:
                message = f"{name} {teeth:g} runs roughly: a chain wants {UNCUT} teeth or more"
                yield Doubt("N316", message, name)


def _subject(element: Element) -> Subject | None:
    """What there is to ask about the teeth of an element; nothing of belts, worms, bevel pairs."""
    if not _whole(element) or element.ratios:
        return None
    if isinstance(element.shape, Planetary):
        return OfPlanets(element)
    asked = element.teeth and element.shape.meshes and element.kind not in ("bevel_pair", "chain")
    return OfWheels(element) if asked else None


def _whole(element: Element) -> bool:
    return all(float(count).is_integer() for count in element.teeth.values())


def _place(element: Element, about: Key | None) -> Path:
    """Where the teeth that a doubt is about stand in an element."""
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
    """Teeth around those of an element with which it can be put together, in random order.

    With its number of planets, or, where it tells none, with 3 to 6 of them. Of chains, worms and
    bevel pairs no wheel has less than is usual, or than its own; nothing for what has no teeth.

    >>> members, teeth = {"sun": 1, "ring": 2, "carrier": 3}, {"sun": 24, "ring": 72}
    >>> found = list(fitting(Element("P", "planetary", members, teeth, planets=5), Random(1)))
    >>> len(found), {(one[0] + one[1]) % 5 for one in found}
    (59, {0})
    """
    subject = _subject(element)
    if subject is None:
        yield from _usual(element, random)
        return
    is_right = _rule(subject)
    layout = subject.layout if element.planets is None and isinstance(subject, OfPlanets) else None
    choices = list(nearest(subject.space, wide=True))
    random.shuffle(choices)
    for teeth in that_go_in(subject, choices):
        if is_right(teeth) and (layout is None or those_that_go_in(layout(teeth), USUAL_PLANETS)):
            yield teeth


def _usual(element: Element, random: Random) -> Iterator[Teeth]:
    """Teeth around those of a chain, a worm or a bevel pair, in random order."""
    if not element.teeth or not _whole(element) or element.kind not in _UNCHECKED:
        return
    usual = _UNCHECKED[element.kind]
    limits = [
        (min(least, own), max(most, own))
        for own, (least, most) in zip(element.teeth.values(), usual, strict=True)
    ]
    choices = list(nearest(OfWheels(element).space, wide=True))
    random.shuffle(choices)
    for teeth in choices:
        pairs = zip(teeth.values(), limits, strict=True)
        if all(least <= count <= most for count, (least, most) in pairs):
            yield teeth


def _rule(subject: Subject) -> Callable[[Teeth], bool]:
    """Whether teeth leave nothing to cure, and nothing to note that was not there before.

    No wheel newly needs a shifted profile, nor do tips touch that did not.
    """
    least = min((wheel.teeth for wheel in subject.wheels().values()), default=0)
    touching = any(doubt.id == TOUCHING for doubt in _wrong(subject))

    def is_right(teeth: Teeth) -> bool:
        return (
            min(teeth.values()) >= min(least, UNCUT)
            and 1 not in subject.ratios(teeth)  # one piece
            and not any(
                doubt.has_cure or (doubt.id == TOUCHING and not touching)
                for doubt in _wrong(subject, teeth)
            )
        )

    return is_right


def _with_cures(subject: Subject) -> Iterator[Doubt]:
    """The doubts about an element; the first that teeth cure has the nearest that leave none."""
    found = [*_wrong(subject)]
    is_right = _rule(subject)
    cures, has_cure = "", True
    if any(doubt.has_cure for doubt in found):
        cures = suggested(
            subject, filter(is_right, that_go_in(subject, nearest(subject.space))), "that fit"
        )
        has_cure = bool(cures)
    for doubt in found:
        hint = counts(subject) if doubt.about is None else ""
        if doubt.has_cure:
            hint, cures = hint + cures, ""
        yield doubt._replace(message=doubt.message + hint)
    if subject.element.planets is None and subject.element.kind not in _PAIRS:
        return
    for doubt in hunting(subject.meshes(), subject.against):
        coprime = filter(subject.is_hunting, nearest(subject.space) if has_cure else ())
        hint = suggested(
            subject, filter(is_right, that_go_in(subject, coprime)), "without a common divisor"
        )
        yield doubt._replace(message=doubt.message + hint)


def _wrong(subject: Subject, teeth: Teeth | None = None) -> Iterator[Doubt]:
    """What is wrong with the teeth of an element, or with others in their place; wear apart."""
    if isinstance(subject, OfPlanets):
        yield from of_planets(subject.layout(teeth))
    if subject.element.kind == "bevel":
        yield from bevel_assembled(subject.element, teeth or subject.known())
    else:
        yield from undercut(subject.wheels(teeth).values())
        yield from interfering(subject.meshes(teeth))
