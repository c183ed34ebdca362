"""A search that keeps the sets, the ports and most elements of a gearbox that there is."""

from __future__ import annotations

from collections.abc import Sequence

from vstatics.core.errors import CaseError
from vstatics.core.explain.bodies import on_own_links
from vstatics.core.model.parts import HOUSING, Mechanism
from vstatics.core.model.transmission import Transmission
from vstatics.synthesis.boxes.box import HELD, BoxSearch, KeptParts
from vstatics.synthesis.boxes.case_sets import case_mechanisms
from vstatics.synthesis.structures.scheme import SetScheme


def kept_search(case: Transmission, free: int, targets: Sequence[float]) -> BoxSearch:
    """A search for boxes with the scheme, the kinds of sets and the ports of a case.

    Parameters
    ----------
    case : Transmission
        Of planetary sets, clutches and brakes. One-way clutches are left out.
    free : int
        So many of its elements may be missing.
    targets : sequence of float
        Wanted ratios of the gears. [-]

    Raises
    ------
    CaseError
        If the case has other mechanisms, or springs.

    Examples
    --------
    >>> from vstatics import example
    >>> search = kept_search(example("simpson"), 1, (2.8, 1.5, 1.0, -2.2))
    >>> search.sets, search.elements, search.engaged, search.own_input
    (2, 4, 2, True)
    >>> search.kept.scheme.code, search.kept.input, search.kept.output, search.kept.free
    ('1-3-0-1-2-3', 4, 3, 1)
    """
    plain = on_own_links(case)
    own = plain.case.replace(mechanisms=case_mechanisms(plain))
    mechanisms = _sets(own)
    body = _bodies(own)
    sets = [_members(one, body) for one in mechanisms]
    on_sets = {link for one in sets for link in one}
    others = sorted({*body} - on_sets - {HOUSING})
    engaged = len({*body} - {HOUSING}) - len(sets) - 1
    if engaged < 1:
        message = f"{engaged + len(sets) + 1} links and {len(sets)} sets leave no element"
        raise CaseError("E922", f"{message} to be engaged: expected a gearbox that shifts")
    first, last = body[own.input], body[own.output]
    ports = [port for port in (first, last) if port in others]
    order = [*sorted(on_sets - {HOUSING}), *[HOUSING] * (HOUSING in on_sets)]
    order += [*ports, *(link for link in others if link not in ports)]
    number = {link: place for place, link in enumerate(order)}
    held = number.get(HOUSING)
    joined = [one.links for one in own.shift_elements if one.kind != "freewheel"]
    places = [[number.get(body[link], HELD) for link in links] for links in joined]
    ends = (_ends(one, other, held) for one, other in places)
    elements = tuple(sorted({one for one in ends if one[0] != one[1]}))
    return BoxSearch(
        sets=len(sets),
        elements=len(elements),
        engaged=engaged,
        targets=tuple(targets),
        meshed=sum(one.ratio > 0 for one in mechanisms),
        own_input=first in others,
        own_output=last in others,
        shafts=len(others) - len(ports),
        fixed=sum(one.count(HOUSING) for one in sets),
        kept=KeptParts(
            SetScheme(tuple((number[a], number[h], number[b]) for a, h, b in sets)),
            tuple(one.ratio > 0 for one in mechanisms),
            held,
            number[first],
            number[last],
            elements,
            free,
        ),
    )


def _sets(case: Transmission) -> list[Mechanism]:
    """The planetary sets; shafts are none, and anything else is refused.

    Raises
    ------
    CaseError
    """
    if case.springs:
        message = "the case has springs: expected a gearbox whose shafts turn as one piece"
        raise CaseError("E921", message, ("springs",))
    sets = [one for one in case.mechanisms if one.ratio != 1 or one.kind]
    if not sets:
        message = "there is no planetary set: expected a gearbox of these"
        raise CaseError("E920", message, ("mechanisms",))
    for one in sets:
        is_pair = one.third == HOUSING and not one.is_set
        if one.kind or is_pair or one.ratio == -1:
            message = f"mechanism {one.name} is no planetary set: expected a gearbox of these alone"
            raise CaseError("E920", message, ("mechanisms", one.name))
    return sets


def _bodies(case: Transmission) -> list[int]:
    """For each link, the housing first, the first of those that shafts join with it."""
    body = [*range(case.links + 1)]
    for one in case.mechanisms:
        if one.ratio == 1:
            first, last = sorted((body[one.first], body[one.second]))
            body = [first if link == last else link for link in body]
    return body


def _members(one: Mechanism, body: Sequence[int]) -> tuple[int, int, int]:
    """The links of sun, carrier and ring: the ring has more teeth."""
    sun, ring = (one.first, one.second) if abs(one.ratio) > 1 else (one.second, one.first)
    return body[sun], body[one.third], body[ring]


def _ends(first: int, second: int, held: int | None) -> tuple[int, int]:
    """The links of an element as `FoundBox` has them."""
    low, high = sorted(HELD if one == held else one for one in (first, second))
    return (high, low) if low == HELD else (low, high)
