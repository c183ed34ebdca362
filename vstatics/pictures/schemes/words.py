"""Words of a picture that do not come from the case, in two languages."""

from __future__ import annotations

from vstatics.pictures.style import Style
from vstatics.statics.results import Language, Results

RUSSIAN = {
    "sun": "солнце",
    "ring": "эпицикл",
    "carrier": "водило",
    "small_sun": "солнце м.",
    "large_sun": "солнце б.",
    "sun2": "солнце 2",
    "ring2": "эпицикл 2",
    "left": "левое",
    "right": "правое",
    "worm": "червяк",
    "wheel": "колесо",
    "first": "1",
    "second": "2",
    "planetary": "план. ряд",
    "double_planet": "парные сателлиты",
    "stepped": "двухвенц. сателлит",
    "ravigneaux": "ряд Равиньо",
    "planet_group": "группа сателлитов",
    "bevel": "конич. дифф.",
    "bevel_pair": "конич. пара",
    "gear_pair": "пара колёс",
    "internal_pair": "внутр. пара",
    "idler": "паразитное к.",
    "chain": "цепь",
    "belt": "ремень",
    "shaft": "вал",
}
"""Members and kinds of elements."""


def word(name: str, lang: Language) -> str:
    """A member or kind as it is written in a picture; names of a case stay as they are.

    >>> word("small_sun", "en"), word("small_sun", "ru")
    ('small sun', 'солнце м.')
    """
    return RUSSIAN.get(name, name) if lang == "ru" else name.replace("_", " ")


def title_of(results: Results, style: Style, gear: int | None) -> str:
    """The name of the case and of the gear, and what keeps the gear from being calculated."""
    case = results.case
    if gear is None:
        return case.name
    index = gear - 1
    ru = style.language == "ru"
    name = f"{'передача' if ru else 'gear'} {case.gears[index].name}"
    marks = (
        (results.tied_up, "tied up", "заперта"),
        (results.conflict, "conflict of freewheels", "конфликт обгонных муфт"),
        (results.locked, "locked by friction", "заклинена трением"),
        (results.missing, "not determined", "не определена"),
    )
    state = [russian if ru else english for mark, english, russian in marks if mark[index]]
    return ", ".join([*([case.name] if case.name else []), name, *state])
