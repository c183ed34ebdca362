"""Random valid transmissions, of any names and numbers; not all can be calculated."""

from typing import Any

from hypothesis import strategies as st

from vstatics.core.model.parts import Damping
from vstatics.core.model.springs import Spring, between
from vstatics.core.model.transmission import (
    HOUSING,
    Gear,
    Mechanism,
    ShiftElement,
    SpeedOf,
    Transmission,
)

ODD_NAMES = (
    *("on", "no", "true", "null", "~", "1", "2", "01", "6R", "1e3", "0x10", "1:30", ".inf", "<<"),
    *("a: b", "#x", "x #y", "- x", "?", "=", "!t", "&a", "*a", "%d", "@", "`", "{}", "[a]", "a, b"),
    *("'", '"', "\\", "|", ">", "---", "...", "2001-01-01", "передача", "задний ход", "⚙", "🚜"),
)

ANY_NUMBER = st.floats(allow_nan=False, allow_infinity=False)
MODERATE = st.one_of(st.floats(0.125, 8), st.floats(-8, -0.125))

PRINTABLE = st.characters(
    codec="utf-8", exclude_categories=("C", "Zl", "Zp", "Zs"), include_characters=" "
)
"""Those of `str.isprintable`: to filter all characters would drop nearly every long text."""
NAMES = st.one_of(
    st.sampled_from(ODD_NAMES),
    st.text(PRINTABLE, min_size=1, max_size=12).map(str.strip).filter(bool),
)
TEXTS = st.one_of(
    st.just(""),
    st.text(st.characters(codec="utf-8"), max_size=40),
    st.lists(NAMES, max_size=40).map(" ".join),
    st.lists(st.one_of(NAMES, st.just("")), max_size=4).map("\n".join),
)


@st.composite
def transmissions(
    draw: st.DrawFn,
    numbers: st.SearchStrategy[float] = MODERATE,
    *,
    follow: bool = True,
    torsional: bool = False,
) -> Transmission:
    """Valid transmissions whose ratios, speeds and torques come out of `numbers`.

    With `follow` some given speeds are those of other links; with `torsional` there may be
    springs, inertias and elastic devices, too: a deck has no place for these.
    """
    elements, mechanisms = draw(st.integers(0, 4)), draw(st.integers(0, 4))
    links = draw(st.integers(2, min(max(2 * elements + 3 * mechanisms, 2), 7)))
    link_names = [name for name in draw(_names(links)) if name not in ("0", "housing")]
    element_names, mechanism_names = draw(_names(elements)), draw(_names(mechanisms))
    gears = draw(st.integers(1, 4))
    gear_names = draw(_names(gears))
    first, output = draw(_ends(links))
    case = Transmission(
        links=links,
        link_names=link_names if len(link_names) == links else (),
        shift_elements=[
            ShiftElement(*draw(_ends(links, lowest=HOUSING)), name)
            for name in element_names or [""] * elements
        ],
        mechanisms=[
            draw(_mechanisms(links, numbers, name)) for name in mechanism_names or [""] * mechanisms
        ],
        gears=[
            draw(_gears((links, elements), (first, output), numbers, name, follow=follow))
            for name in gear_names or [""] * gears
        ],
        input=first,
        output=output,
        idle=draw(st.sampled_from(["exact", "published"])),
        coast=draw(st.booleans()),
        name=draw(st.one_of(st.just(""), NAMES)),
        description=draw(TEXTS),
        source=draw(TEXTS),
    )
    return draw(_with_torsion(case, numbers)) if torsional else case


@st.composite
def _with_torsion(
    draw: st.DrawFn, case: Transmission, numbers: st.SearchStrategy[float]
) -> Transmission:
    """The same with springs, inertias and elastic devices, where names of devices differ."""
    names = {device.casefold() for device in case.devices}
    if len(names) < len(case.devices):
        return case
    positive = st.floats(1e-300, 1e300)
    links = st.integers(1, case.links)
    shafts = links.map(between) | _ends(case.links).map(lambda e: between(*e))
    twists = shafts | st.dictionaries(links, numbers.filter(bool), min_size=1)
    dampings = st.floats(0, 1e300).map(Damping) | st.floats(0, 8).map(lambda r: Damping(0.0, r))
    bending = st.one_of(
        st.fixed_dictionaries({"stiffness": positive, "damping": dampings}),
        st.fixed_dictionaries({"compliance": positive, "damping": dampings}),
        st.fixed_dictionaries({"points": st.just([(-0.1, -2), (0.3, -2), (0.7, 5)])}),
    )
    springs = [
        Spring(draw(twists), friction=draw(st.floats(0, 1e300)), name=name, **draw(bending))
        for name in draw(st.lists(NAMES, max_size=3, unique=True))
        if name.casefold() not in names
    ]
    elastic: st.SearchStrategy[dict[str, Any]] = st.just({}) | st.fixed_dictionaries(
        {"stiffness": positive, "damping": dampings}
    )
    return case.replace(
        springs=springs,
        inertias=draw(st.dictionaries(links, st.floats(0, 1e300), max_size=3)),
        shift_elements=[one._replace(**draw(elastic)) for one in case.shift_elements],
        mechanisms=[one._replace(**draw(elastic)) for one in case.mechanisms],
    )


def _names(count: int) -> st.SearchStrategy[list[str]]:
    """Different names, or none at all."""
    return st.one_of(st.just([]), st.lists(NAMES, min_size=count, max_size=count, unique=True))


@st.composite
def _ends(draw: st.DrawFn, links: int, lowest: int = 1) -> tuple[int, int]:
    """Two different links."""
    first = draw(st.integers(lowest, links))
    second = draw(st.integers(lowest, links).filter(lambda link: link != first))
    return first, second


@st.composite
def _mechanisms(
    draw: st.DrawFn, links: int, numbers: st.SearchStrategy[float], name: str
) -> Mechanism:
    """The housing may take any place, and two of them."""
    order = draw(st.permutations(range(1, links + 1)))[:3]
    members = [*order, HOUSING][:3]
    for place in draw(st.lists(st.integers(0, 2), max_size=2)):
        members[place] = HOUSING
    if not any(members):
        members[0] = 1
    whole = HOUSING not in members
    ratio = draw(numbers.filter(lambda ratio: ratio != 0 and not (whole and ratio == 1)))
    planet_ratio = draw(st.one_of(st.none(), numbers.filter(bool)))
    efficiency = draw(st.one_of(st.just(1.0), st.floats(0.5, 1)))
    first, second, third = members
    return Mechanism(first, second, third, ratio, efficiency, planet_ratio, name)


def _by_link(
    links: list[int], numbers: st.SearchStrategy[float]
) -> st.SearchStrategy[dict[int, float]]:
    return st.dictionaries(st.sampled_from(links), numbers, max_size=2)


@st.composite
def _gears(  # noqa: PLR0913 - what a gear may have
    draw: st.DrawFn,
    sizes: tuple[int, int],
    ends: tuple[int, int],
    numbers: st.SearchStrategy[float],
    name: str,
    *,
    follow: bool,
) -> Gear:
    """Some have ends of their own, given speeds, external torques."""
    links, elements = sizes
    own: dict[str, Any] = {}
    if draw(st.booleans()):
        ends = draw(_ends(links))
        own = {"input": ends[0], "output": ends[1]}
    free = [link for link in range(1, links + 1) if link != ends[0]]
    speeds: dict[int, float | SpeedOf] = {**draw(_by_link(free, numbers))}
    following = draw(_by_link(free, numbers.filter(bool))) if follow else {}
    for link, factor in following.items():
        other = draw(st.sampled_from([one for one in range(1, links + 1) if one != link]))
        speeds[link] = SpeedOf(other, factor)
    loads = [link for link in range(1, links + 1) if link != ends[1] and link not in speeds]
    torques = st.dictionaries(st.sampled_from(loads), numbers, max_size=2)
    engaged = (
        st.lists(st.integers(1, elements), max_size=3, unique=True) if elements else st.just([])
    )
    return Gear(draw(engaged), speeds, draw(torques) if loads else {}, name=name, **own)
