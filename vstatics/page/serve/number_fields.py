"""Numbers of a case that are changed on its page: a field and a slider for each.

Both carry in ``data-path`` the path by which a sweep varies the number, so that whoever reacts to
their event ``input`` knows what changes.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from importlib.resources import files
from itertools import groupby
from typing import NamedTuple

from vstatics.core.elements.drawing import drawing_of
from vstatics.core.model.paths import dotted, owner_and_key, owner_and_number
from vstatics.core.model.transmission import Transmission
from vstatics.core.tables.html import Markup, tag
from vstatics.core.texts import spoken, tr
from vstatics.pictures.paged.marks import digits_of
from vstatics.sweep.variants.path_numbers import case_path, known_paths, own_number_at
from vstatics.sweep.variants.targets import OF_MECHANISM

_EFFICIENCY = re.compile(r"efficiency$|(^|\.)mesh_efficiency\.\w+$")
_BY_LINK = ("speeds", "torques")
"""Numbers that have the name of a link behind them."""
_PARTS = ("load", "mesh_efficiency")
"""Of a case, in the place of a name."""
_REACH = 2.0
"""A slider goes so many times as far as its number."""
_UNITS = {"load.speed": "rpm", "load.torque": "N*m"}
"""Of numbers that a case keeps in units of their own."""
_UNSAID = {"static": 1.0, "drag": 0.0, "open_drag": 0.0}
"""What a case has without saying it; nobody changes it here."""


SCRIPT, STYLE = (
    Markup((files(__package__) / f"number_fields.{kind}").read_text(encoding="utf-8"))
    for kind in ("js", "css")
)
"""What reads the fields, and how they look."""


class PageField(NamedTuple):
    """A number that can be changed."""

    path: str
    """As a sweep names it: ``P1.teeth.sun``."""
    value: float
    unit: str = ""
    """In which the value is; nothing for a bare number."""
    whole: bool = False
    """Whether it counts teeth or something else."""
    same: tuple[str, ...] = ()
    """Paths of other numbers that are the same one in the document, by an alias of YAML."""

    @property
    def owner(self) -> str:
        """What has the number: the path without its last words.

        >>> PageField("P1.teeth.sun", 30).owner, PageField("gears.low.speeds.MG1", 0).owner
        ('P1', 'gears.low')
        """
        return dotted(owner_and_number(self.path)[0])

    @property
    def limits(self) -> tuple[float, float]:
        """Where its slider ends: teeth stay numbers of teeth, ratios can turn their sign.

        >>> PageField("P1.teeth.sun", 30, whole=True).limits, PageField("D1.ratio", -2.5).limits
        ((1.0, 60.0), (-5.0, 5.0))
        >>> PageField("D1.efficiency", 0.98).limits
        (0.0, 1.0)
        """
        reach = _REACH * abs(self.value) or 1.0
        if _EFFICIENCY.search(self.path) and 0 <= self.value <= 1:
            return 0.0, 1.0
        return (1.0, max(reach, 1.0)) if self.whole and self.value > 0 else (-reach, reach)

    @property
    def step(self) -> float:
        """By which the keys up and down change it: a power of 10, some hundredth of its slider.

        >>> PageField("P1.teeth.sun", 30, whole=True).step, PageField("D1.ratio", -2.5).step
        (1.0, 0.1)
        >>> PageField("load.speed", 3000).step
        100.0
        """
        low, high = self.limits
        return 1.0 if self.whole else 10.0 ** math.floor(math.log10((high - low) / 100))


def case_fields(case: Transmission) -> Iterator[PageField]:
    """The numbers that a case gives itself: teeth, ratios, efficiencies, loads, given values.

    Numbers that its drawing makes of others are none, neither are drags of nothing, nor what
    stands at the first point of an efficiency that follows a law.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism
    >>> gear = Gear(speeds={2: 0.5})
    >>> case = Transmission(3, [], [Mechanism(1, 2, 3, -2.5, 0.9, name="D")], [gear])
    >>> [(one.path, one.value) for one in case_fields(case)]
    [('gears.1.speeds.2', 0.5), ('D.ratio', -2.5), ('D.efficiency', 0.9)]
    """
    own, derived = _relative(case), {*_derived(case)}
    derived |= {f"{one.name}.efficiency" for one in case.mechanisms if one.points}
    for path in known_paths(case):
        number = case_path(path, case)
        assert number is not None  # noqa: S101 - it is known
        if path.startswith("gears.*") or path in derived:
            continue
        try:
            value = own[path] if path in own else own_number_at(number, case)
        except ValueError:  # the case has none there
            continue
        unsaid = _UNSAID.get(owner_and_key(path)[2], _UNSAID.get(number.quantity))
        if value is None or value == unsaid:
            continue
        unit = next((unit for end, unit in _UNITS.items() if path.endswith(end)), "")
        whole = number.part is not None and number.part.kind == "count"
        yield PageField(path, value, unit, whole)


def _derived(case: Transmission) -> Iterator[str]:
    """Numbers of mechanisms that follow from the elements of a drawing."""
    drawing = drawing_of(case)
    given = (
        {one.name for one in drawing.mechanisms}
        if drawing
        else {one.name for one in case.mechanisms}
    )
    for one in case.mechanisms:
        if one.name not in given:
            yield from (f"{one.name}.{quantity}" for quantity in OF_MECHANISM)


def _relative(case: Transmission) -> Mapping[str, float]:
    """Given speeds and torques of gears that are relative to those of the input, by paths."""
    return {
        f"gears.{gear.name}.{kind}.{case.link_name(link)}": value
        for gear in case.gears
        for kind in ("speeds", "torques")
        for link, value in getattr(gear, kind).items()
        if isinstance(value, int | float)
    }


def shown_fields(fields: Iterable[PageField], *, fixed: bool = False) -> Iterator[Markup]:
    """Fields with their sliders, in a group for each part that has numbers.

    Parameters
    ----------
    fields : iterable of PageField
        Those of a part follow each other.
    fixed : bool
        Whether none can be changed, as in a deck.

    Examples
    --------
    >>> [group] = shown_fields([PageField("P1.teeth.sun", 30, whole=True)])
    >>> group.count('data-path="P1.teeth.sun"'), group.count('step="1"')
    (2, 2)
    """
    for _, owned in groupby(fields, lambda one: one.owner):
        group = [*owned]
        rows = (_row(one, fixed=fixed) for one in group)
        yield tag("fieldset", tag("legend", _owner(group[0].path)), *rows)


def _owner(path: str) -> str:
    """Return the owner of a number: a name, or a part of the case that this program names."""
    (kind, *gear), _ = owner_and_number(path)
    return dotted([_word(kind), *gear]) if gear or kind in _PARTS else kind


def _name(words: Sequence[str]) -> str:
    """A number of something; behind given speeds and torques stands the name of a link.

    >>> _name(["teeth", "small_sun"]), _name(["speeds", "ratio"])
    ('teeth small_sun', 'speeds ratio')
    """
    kind, *others = words
    return " ".join([_word(kind), *(others if kind in _BY_LINK else map(_word, others))])


def _word(key: str) -> str:
    """A key of a case as it stands there, else in the language of the page."""
    return key if spoken() == "en" else tr(key.replace("_", " "))


def _row(field: PageField, *, fixed: bool) -> Markup:
    low, high = map(digits_of, field.limits)
    value = digits_of(field.value)
    name = _name(owner_and_number(field.path)[1])
    common = {"data_path": field.path, "value": value, "disabled": fixed}
    unit = f", {tr(field.unit)}" if field.unit else ""
    label = f"{field.path if spoken() == 'en' else f'{_owner(field.path)} {name}'}{unit}"
    typed = {"class_": "field", "autocomplete": "off", "data_step": digits_of(field.step)}
    if field.limits[0] >= 0:  # some telephones have no minus beside such digits
        typed["inputmode"] = "decimal"
    moved = {"class_": "slider", "step": "1" if field.whole else "any", "min": low, "max": high}
    return tag(
        "div",
        tag("label", f"{name}{unit}", for_=f"field-{field.path}"),
        tag("input", type="text", id=f"field-{field.path}", **typed, **common),
        tag("input", type="range", aria_label=label, **moved, **common),
        *(tag("p", tr("same number as {path}", path=path), class_="same") for path in field.same),
        class_="changed-by-hand",
    )
