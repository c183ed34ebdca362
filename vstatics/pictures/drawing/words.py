"""Words that pictures use in addition to the names in the case."""

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
"""Names of members and kinds of gear sets, which pictures translate."""

TURN_TOGETHER = "striped: links turn together"
"""Explanation of striped lines in the key."""


def word(name: str, style: Style) -> str:
    """Return the picture's word for a member or kind; names from the case are unchanged.

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
"""Texts with the name and tooth number of a sun gear. Translations can abbreviate the name."""


def wheel(name: str, teeth: float, style: Style) -> str:
    """Return the name of a toothed gear with the tooth number, abbreviated if long.

    >>> wheel("sun", 48, Style("ru")), wheel("ring", 96, Style("en"))
    ('солн. шест.: 48', 'ring: 96')
    """
    if name in SUNS:
        return style.text(SUNS[name], teeth=f"{teeth:g}")
    return f"{word(name, style)}: {teeth:g}"


def quantity(name: str, value: float, style: Style) -> str:
    """Return the name of a quantity followed by the value.

    >>> quantity("speed", 0.5, Style("ru"))
    'скорость 0.500'
    """
    return f"{style.text(name)} {number(value)}"


def fault(status: Status, style: Style) -> str:
    """Return the reason why a gear cannot be calculated."""
    return style.text(status.english)


def gear_title(gear: str, style: Style) -> str:
    """Return the title of a gear."""
    return f"{style.text('gear')} {gear}"


def title(case: Transmission, subject: str) -> str:
    """Return the title of a picture of a case."""
    return f"{case.name}: {subject}" if case.name else f"{subject[0].upper()}{subject[1:]}"
