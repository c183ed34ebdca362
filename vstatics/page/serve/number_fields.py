"""Fields and sliders for the numbers of a case on its page.

Field and slider have the attribute ``data-path``, the path of the number as in a sweep. A script
uses it to handle their ``input`` events.
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
"""Keys whose paths end with the name of a link, as in ``gears.1.speeds.2``."""
_PARTS = ("load", "mesh_efficiency")
"""Keys of a case with which a path can begin. Other paths begin with the name of a component."""
_REACH = 2.0
"""Upper end of a slider, divided by the number. [-]"""
_UNITS = {"load.speed": "rpm", "load.torque": "N*m"}
"""Units of numbers that a case does not store in SI units, by the end of the path."""
_UNSAID = {"static": 1.0, "drag": 0.0, "open_drag": 0.0}
"""Default values by key. A number with its default value has no field."""


SCRIPT, STYLE = (
    Markup((files(__package__) / f"number_fields.{kind}").read_text(encoding="utf-8"))
    for kind in ("js", "css")
)
"""Script and style sheet of the fields and sliders."""


class PageField(NamedTuple):
    """Number that a field and a slider on the page change."""

    path: str
    """Path of the number as in a sweep, such as ``P1.teeth.sun``."""
    value: float
    unit: str = ""
    """Unit of the value; empty for a number without a unit."""
    whole: bool = False
    """True if the number is an integer, such as a tooth number."""
    same: tuple[str, ...] = ()
    """Paths of numbers that change together with this number, because of aliases in YAML."""

    @property
    def owner(self) -> str:
        """Path of the component or gear that has the number: the path without the quantity.

        >>> PageField("P1.teeth.sun", 30).owner, PageField("gears.low.speeds.MG1", 0).owner
        ('P1', 'gears.low')
        """
        return dotted(owner_and_number(self.path)[0])

    @property
    def limits(self) -> tuple[float, float]:
        """Ends of the slider. Tooth numbers remain positive, ratios can change sign.

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
        """Step of the arrow keys in the field: a power of 10, about a hundredth of the range.

        >>> PageField("P1.teeth.sun", 30, whole=True).step, PageField("D1.ratio", -2.5).step
        (1.0, 0.1)
        >>> PageField("load.speed", 3000).step
        100.0
        """
        low, high = self.limits
        return 1.0 if self.whole else 10.0 ** math.floor(math.log10((high - low) / 100))


def case_fields(case: Transmission) -> Iterator[PageField]:
    """Yield fields for the numbers in a case: teeth, ratios, efficiencies, loads, speeds.

    Numbers that follow from gear sets with teeth, zero drag, and the first point of an efficiency
    curve have no field.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism
    >>> gear = Gear(speeds={2: 0.5})
    >>> case = Transmission(3, [], [Mechanism(1, 2, 3, -2.5, 0.9, name="D")], [gear])
    >>> [(field.path, field.value) for field in case_fields(case)]
    [('gears.1.speeds.2', 0.5), ('D.ratio', -2.5), ('D.efficiency', 0.9)]
    """
    relative, derived = _relative(case), {*_derived(case)}
    derived |= {f"{mechanism.name}.efficiency" for mechanism in case.mechanisms if mechanism.points}
    for path in known_paths(case):
        number = case_path(path, case)
        assert number is not None  # noqa: S101 - `known_paths` yields only paths of numbers
        if path.startswith("gears.*") or path in derived:
            continue
        try:
            value = relative[path] if path in relative else own_number_at(number, case)
        except ValueError:  # the case lacks this number
            continue
        default = _UNSAID.get(owner_and_key(path)[2], _UNSAID.get(number.quantity))
        if value is None or value == default:
            continue
        unit = next((unit for end, unit in _UNITS.items() if path.endswith(end)), "")
        whole = number.part is not None and number.part.kind == "count"
        yield PageField(path, value, unit, whole)


def _derived(case: Transmission) -> Iterator[str]:
    """Yield the paths of mechanism numbers that follow from gear sets with teeth."""
    given = {mechanism.name for mechanism in (drawing_of(case) or case).mechanisms}
    for mechanism in case.mechanisms:
        if mechanism.name not in given:
            yield from (f"{mechanism.name}.{quantity}" for quantity in OF_MECHANISM)


def _relative(case: Transmission) -> Mapping[str, float]:
    """Return speeds and torques of gears relative to the input, by path."""
    return {
        f"gears.{gear.name}.{kind}.{case.link_name(link)}": value
        for gear in case.gears
        for kind in ("speeds", "torques")
        for link, value in getattr(gear, kind).items()
        if isinstance(value, int | float)
    }


def shown_fields(fields: Iterable[PageField], *, fixed: bool = False) -> Iterator[Markup]:
    """Yield fields with sliders, grouped by the component or gear that has the number.

    Parameters
    ----------
    fields : iterable of PageField
        Fields, ordered by component or gear.
    fixed : bool
        True to disable the fields, as for a deck, which cannot be changed.

    Examples
    --------
    >>> [group] = shown_fields([PageField("P1.teeth.sun", 30, whole=True)])
    >>> group.count('data-path="P1.teeth.sun"'), group.count('step="1"')
    (2, 2)
    """
    for _, owned in groupby(fields, lambda field: field.owner):
        group = [*owned]
        rows = (_row(field, fixed=fixed) for field in group)
        yield tag("fieldset", tag("legend", _owner(group[0].path)), *rows)


def _owner(path: str) -> str:
    """Return the words for the owner of a number: its name, or a translated key of the case."""
    (kind, *gear), _ = owner_and_number(path)
    return dotted([_translated(kind), *gear]) if gear or kind in _PARTS else kind


def _name(words: Sequence[str]) -> str:
    """Return the words for a number without its owner; names of links are not translated.

    >>> _name(["teeth", "small_sun"]), _name(["speeds", "ratio"])
    ('teeth small_sun', 'speeds ratio')
    """
    kind, *others = words
    return " ".join(
        [_translated(kind), *(others if kind in _BY_LINK else map(_translated, others))]
    )


def _translated(key: str) -> str:
    return key if spoken() == "en" else tr(key.replace("_", " "))


def _row(field: PageField, *, fixed: bool) -> Markup:
    low, high = map(digits_of, field.limits)
    value = digits_of(field.value)
    name = _name(owner_and_number(field.path)[1])
    common = {"data_path": field.path, "value": value, "disabled": fixed}
    unit = f", {tr(field.unit)}" if field.unit else ""
    label = f"{field.path if spoken() == 'en' else f'{_owner(field.path)} {name}'}{unit}"
    typed = {"class_": "field", "autocomplete": "off", "data_step": digits_of(field.step)}
    # In this input mode some telephones show a keyboard without a minus sign.
    if field.limits[0] >= 0:
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
