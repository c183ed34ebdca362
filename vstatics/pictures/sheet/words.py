"""Words of pictures that do not come from the case, in two languages."""

from __future__ import annotations

from vstatics.model.transmission import Transmission
from vstatics.pictures.sheet.style import Style, number
from vstatics.statics.status import Status

KINDS = {
    "stick": ("Stick diagram", "Кинематическая схема"),
    "structure": ("Structure", "Структурная схема"),
    "flow": ("Power flow", "Потоки мощности"),
    "lever": ("Lever diagram", "Рычажная схема"),
    "efficiency": ("Efficiency", "КПД"),
    "plan": ("Kinematic plan", "Кинематический план"),
    "modes": ("Natural modes", "Собственные формы"),
    "campbell": ("Campbell diagram", "Диаграмма Кэмпбелла"),
    "response": ("Response", "Отклик"),
    "dump": ("Dumped clutch", "Резкое включение сцепления"),
    "shift": ("Run over time", "Ход во времени"),
    "traction": ("Wheel force", "Сила тяги"),
    "sawtooth": ("Engine speed over road speed", "Частота вращения двигателя по скорости"),
    "steps": ("Steps between gears", "Шаги между передачами"),
}
"""What a kind of picture is called, where it stands by itself."""
ELEMENTS = {
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
    "first": "первое",
    "second": "второе",
    "third": "третье",
    "mechanism": "механизм",
    "variator": "вариатор",
    "converter": "гидротрансф.",
    "clutch": "фрикцион",
    "brake": "тормоз",
    "dog_clutch": "зубчатая муфта",
    "freewheel": "муфта своб. хода",
    "held": "опора",
    "link": "звено",
    "planet": "сателлит",
    "idler": "паразитное к.",
    "planetary": "план. ряд",
    "double_planet": "парные сателлиты",
    "stepped": "двухвенц. сателлит",
    "ravigneaux": "ряд Равиньо",
    "planet_group": "группа сателлитов",
    "bevel": "конич. дифф.",
    "bevel_pair": "конич. пара",
    "gear_pair": "пара колёс",
    "internal_pair": "внутр. пара",
    "chain": "цепь",
    "belt": "ремень",
    "shaft": "вал",
    "spring": "пружина",
}
"""Members of elements and their kinds."""
TERMS = {
    "speed": "скорость",
    "torque": "момент",
    "power": "мощность",
    "lost": "потери",
    "efficiency": "КПД",
    "housing": "корпус",
    "family": "семейство",
    "gear": "передача",
}
"""What several pictures tell of."""

TURN_TOGETHER = "striped: links turn together", "полосы: звенья вращаются вместе"
"""What stripes of a line mean."""


def word(name: str, style: Style) -> str:
    """A member or kind as it is written in a picture; names of a case stay as they are.

    >>> word("small_sun", Style("en")), word("small_sun", Style("ru"))
    ('small sun', 'солнце м.')
    """
    return style.text(name.replace("_", " "), ELEMENTS.get(name, name))


def term(name: str, style: Style) -> str:
    """One of `TERMS` in the language of a picture."""
    return style.text(name, TERMS[name])


def quantity(name: str, value: float, style: Style) -> str:
    """What a number is, and the number.

    >>> quantity("speed", 0.5, Style("ru"))
    'скорость 0.500'
    """
    return f"{term(name, style)} {number(value)}"


def fault(status: Status, style: Style) -> str:
    """What keeps a gear from being calculated."""
    return style.text(status.english, status.russian)


def gear_title(gear: str, style: Style) -> str:
    """How a gear is called."""
    return f"{term('gear', style)} {gear}"


def title(case: Transmission, subject: str) -> str:
    """What is shown of a case, with its name."""
    return f"{case.name}: {subject}" if case.name else f"{subject[0].upper()}{subject[1:]}"
