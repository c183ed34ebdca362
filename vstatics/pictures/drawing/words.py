"""Words of pictures that do not come from the case."""

from __future__ import annotations

from vstatics.core.model.transmission import Transmission
from vstatics.core.statics.status import Status
from vstatics.pictures.drawing.style import Style, number

ELEMENTS = (
    *("sun", "ring", "carrier", "small_sun", "large_sun", "sun2", "ring2", "left", "right"),
    *("worm", "wheel", "first", "second", "third", "mechanism", "variator", "converter"),
    *("clutch", "brake", "dog_clutch", "freewheel", "held", "link"),
    *("planet", "planet2", "idler", "short", "long"),
    *("planetary", "double_planet", "stepped", "ravigneaux", "planet_group", "bevel"),
    *("bevel_pair", "gear_pair", "internal_pair", "chain", "belt", "shaft", "spring"),
)
"""Members of elements and their kinds; other names are those of a case."""

TURN_TOGETHER = "striped: links turn together"
"""What stripes of a line mean."""


def word(name: str, style: Style) -> str:
    """A member or kind as it is written in a picture; names of a case stay as they are.

    >>> word("small_sun", Style("en")), word("small_sun", Style("ru"))
    ('small sun', 'малая солнечная шестерня')
    """
    said = name.replace("_", " ")
    return style.text(said) if name in ELEMENTS else said


SUNS = {
    "sun": "sun: {teeth}",
    "sun2": "sun2: {teeth}",
    "small_sun": "small sun: {teeth}",
    "large_sun": "large sun: {teeth}",
}
"""What is written at suns: their name is long in some language."""


def wheel(name: str, teeth: float, style: Style) -> str:
    """A wheel with its teeth, in as few letters as there is room for beside it.

    >>> wheel("sun", 48, Style("ru")), wheel("ring", 96, Style("en"))
    ('солн. шест.: 48', 'ring: 96')
    """
    if name in SUNS:
        return style.text(SUNS[name], teeth=f"{teeth:g}")
    return f"{word(name, style)}: {teeth:g}"


def teeth_alone(named: str) -> str:
    """The teeth of a wheel that is told with its name.

    >>> teeth_alone(wheel("sun", 48, Style("ru")))
    '48'
    """
    return named.rpartition(" ")[2]


def quantity(name: str, value: float, style: Style) -> str:
    """What a number is, and the number.

    >>> quantity("speed", 0.5, Style("ru"))
    'скорость 0.500'
    """
    return f"{style.text(name)} {number(value)}"


def fault(status: Status, style: Style) -> str:
    """What keeps a gear from being calculated."""
    return style.text(status.english)


def gear_title(gear: str, style: Style) -> str:
    """How a gear is called."""
    return f"{style.text('gear')} {gear}"


def title(case: Transmission, subject: str) -> str:
    """What is shown of a case, with its name."""
    return f"{case.name}: {subject}" if case.name else f"{subject[0].upper()}{subject[1:]}"
