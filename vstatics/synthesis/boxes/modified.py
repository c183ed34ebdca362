"""Search for variants of an existing gearbox with the same gear sets, input and output."""

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
    """Return a search that retains the scheme, kinds of gear sets, input and output of a case.

    Parameters
    ----------
    case : Transmission
        Gearbox of planetary gear sets, clutches and brakes. Freewheels are ignored.
    free : int
        Largest number of the case's shift elements that may be missing in a found gearbox.
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
    gearbox = plain.case.replace(mechanisms=case_mechanisms(plain))
    mechanisms = _planetary_sets(gearbox)
    body = _joined_links(gearbox)
    sets = [_members(mechanism, body) for mechanism in mechanisms]
    on_sets = {link for members in sets for link in members}
    others = sorted({*body} - on_sets - {HOUSING})
    engaged = len({*body} - {HOUSING}) - len(sets) - 1
    if engaged < 1:
        raise CaseError(
            "E922",
            f"{engaged + len(sets) + 1} links and {len(sets)} gear sets leave no shift element"
            " to be engaged: expected a gearbox that shifts",
        )
    first, last = body[gearbox.input], body[gearbox.output]
    ports = [port for port in (first, last) if port in others]
    order = [*sorted(on_sets - {HOUSING}), *[HOUSING] * (HOUSING in on_sets)]
    order += [*ports, *(link for link in others if link not in ports)]
    number = {link: place for place, link in enumerate(order)}
    held = number.get(HOUSING)
    joined = [element.links for element in gearbox.shift_elements if element.kind != "freewheel"]
    places = [[number.get(body[link], HELD) for link in links] for links in joined]
    ends = (_ends(start, end, held) for start, end in places)
    elements = tuple(sorted({pair for pair in ends if pair[0] != pair[1]}))
    return BoxSearch(
        sets=len(sets),
        elements=len(elements),
        engaged=engaged,
        targets=tuple(targets),
        meshed=sum(mechanism.ratio > 0 for mechanism in mechanisms),
        own_input=first in others,
        own_output=last in others,
        shafts=len(others) - len(ports),
        fixed=sum(members.count(HOUSING) for members in sets),
        kept=KeptParts(
            SetScheme(tuple((number[a], number[h], number[b]) for a, h, b in sets)),
            tuple(mechanism.ratio > 0 for mechanism in mechanisms),
            held,
            number[first],
            number[last],
            elements,
            free,
        ),
    )


def _planetary_sets(case: Transmission) -> list[Mechanism]:
    """Return the planetary gear sets of a case, without shafts (mechanisms of ratio 1).

    Raises
    ------
    CaseError
        If the case has springs, other mechanisms, or no planetary set.
    """
    if case.springs:
        message = "the case has springs: expected a gearbox with rigid shafts"
        raise CaseError("E921", message, ("springs",))
    sets = [mechanism for mechanism in case.mechanisms if mechanism.ratio != 1 or mechanism.kind]
    if not sets:
        message = "the case has no planetary gear set, expected a gearbox of planetary gear sets"
        raise CaseError("E920", message, ("mechanisms",))
    for mechanism in sets:
        is_pair = mechanism.third == HOUSING and not mechanism.is_set
        if mechanism.kind or is_pair or mechanism.ratio == -1:
            message = (
                f"mechanism {mechanism.name} is not a planetary gear set, expected only such sets"
            )
            raise CaseError("E920", message, ("mechanisms", mechanism.name))
    return sets


def _joined_links(case: Transmission) -> list[int]:
    """Return for each link the lowest link that is connected by shafts (mechanisms of ratio 1)."""
    body = [*range(case.links + 1)]
    for mechanism in case.mechanisms:
        if mechanism.ratio == 1:
            low, high = sorted((body[mechanism.first], body[mechanism.second]))
            body = [low if link == high else link for link in body]
    return body


def _members(mechanism: Mechanism, body: Sequence[int]) -> tuple[int, int, int]:
    """Return the links of sun, carrier and ring. The central gear with more teeth is the ring."""
    sun, ring = (
        (mechanism.first, mechanism.second)
        if abs(mechanism.ratio) > 1
        else (mechanism.second, mechanism.first)
    )
    return body[sun], body[mechanism.third], body[ring]


def _ends(first: int, second: int, held: int | None) -> tuple[int, int]:
    """Return the two links of a shift element in the order that `FoundBox` uses."""
    low, high = sorted(HELD if link == held else link for link in (first, second))
    return (high, low) if low == HELD else (low, high)
