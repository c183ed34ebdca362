"""Readers of single values, and the stand-ins for unreadable values."""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import partial
from typing import Any, NamedTuple, get_args

from vstatics.core.model.shape import (
    Balances,
    ByForm,
    ByKey,
    ByLaw,
    ByPoints,
    Either,
    Ends,
    Leaf,
    LeafKind,
    Links,
    ListOf,
    Measure,
    OneOrMany,
    Pair,
    Parsed,
    RowOf,
    Shape,
)
from vstatics.core.readers.named import scalars, units
from vstatics.core.readers.named.references import NO_ELEMENT, NO_LINK

_MANY_LINKS = 10**9  # permits any link number, because problems of the model about it are hidden
_NO_LINKS = (NO_LINK, NO_LINK)
_MAY_BE_0 = frozenset(("damping", "pressure", "time", "angle", "velocity", "cooling"))
"""Measures with the stand-in 0, which is a valid value."""


class LeafReading(NamedTuple):
    """Description and parser for a kind of value."""

    expected: str
    """Words for a message, such as `a number`."""
    stand_in: Any
    """Value that replaces an unreadable value, so that reading can continue."""
    parse: Callable[[str], Any] = str
    """Function that converts the text. It is not used for names, flags and choices."""


def _in_si(text: str, measure: Measure) -> float:
    from vstatics.core.readers.named.si_units import measured as in_si

    return in_si(text, measure)


def either_way(text: str, measure: Any) -> float:
    """Read a quantity of rotation or of motion along a line, according to the unit."""
    from vstatics.core.readers.named.si_units import of_either  # costs start-up time

    return of_either(text, measure)


_FORMULA = re.compile(
    r"\b(w|speed)\b|^(?![-+]?[\d./]+(e[-+]?\d+)?\s*[^\W\d_]).*\d.*[*/+(^-]|\(", re.IGNORECASE
)
"""Pattern of a formula: the name of the speed, or operators not followed by a unit."""


def _refuse_file(text: str, before: str = "") -> None:
    if text.lower().endswith(".csv"):
        raise ValueError(f"expected a file as `{{{before}file: {text}}}`")


def _drag(text: str) -> float:
    """Read a drag torque, or a formula of drag over speed."""
    _refuse_file(text)
    try:
        return units.relative(text, "torque")
    except ValueError as error:
        if not _FORMULA.search(text):
            raise type(error)(
                f"{error}; a formula of the speed `w` is allowed too, such as `1 + 0.01*w`"
            ) from None
    from vstatics.core.readers.named.law_formulas import (  # costs start-up time
        DragFormula,
        read_formula,
    )

    return read_formula(text, DragFormula)


_OF_BOTH = re.compile(r"\b(w|speed|T|torque)\b|\d.*[*+(^-].*[^\W\d_]")
"""Pattern of a formula: the name of speed or torque, or operators before a name."""


def _efficiency(text: str) -> float:
    """Read an efficiency, or a formula of efficiency over speed and torque."""
    _refuse_file(text, "over: [speed, torque], ")
    try:
        return scalars.number(text)
    except ValueError:
        if not _OF_BOTH.search(text):
            raise
    from vstatics.core.readers.named.law_formulas import (  # costs start-up time
        EfficiencyFormula,
        read_formula,
    )

    return read_formula(text, EfficiencyFormula)


LEAVES: dict[LeafKind, LeafReading] = {
    "text": LeafReading("text", ""),
    "number": LeafReading("a number", 1.0, scalars.number),
    "count": LeafReading("a whole number", 1, scalars.count),
    "share": LeafReading("a share of 0 or more", 0.0, scalars.share),
    **{
        kind: LeafReading(f"a {kind} with its unit", 1.0, partial(units.quantity, kind=kind))
        for kind in get_args(units.Quantity)
    },
    "relative_speed": LeafReading("a speed", 0.0, partial(units.relative, kind="speed")),
    "slip": LeafReading("a slip", 0.0, partial(units.relative, kind="speed")),
    "efficiency": LeafReading("a number, or a formula of w and T", 1.0, _efficiency),
    "drag": LeafReading("a torque, or a formula of w", 0.0, _drag),
    "relative_torque": LeafReading("a torque", 0.0, partial(units.relative, kind="torque")),
    **{
        measure: LeafReading(
            units.with_article(measure),
            0.0 if measure in _MAY_BE_0 else 1.0,
            partial(_in_si, measure=measure),
        )
        for measure in get_args(Measure)
    },
    "link": LeafReading("a link", NO_LINK),
    "element": LeafReading("the name of a shift element", NO_ELEMENT),
    "converter": LeafReading("the name of a converter", NO_ELEMENT),
    "flag": LeafReading("`true` or `false`", stand_in=False),
    "choice": LeafReading("text", None),
}


def stand_in(shape: Shape) -> Any:  # noqa: PLR0911, C901 - a table
    """Return the stand-in for an unreadable value."""
    match shape:
        case Leaf():
            return shape.choices[0] if shape.choices else LEAVES[shape.kind].stand_in
        case ByKey():
            return shape.make(**values_before(shape))
        case Either():
            return shape.record.make(**{shape.key: stand_in(shape.short)})
        case Ends():
            return _NO_LINKS
        case Links():
            return _MANY_LINKS
        case ListOf() | OneOrMany() | ByForm(scalar=None):
            return ()
        case Pair():
            return ("", "")
        case RowOf():
            return tuple(map(stand_in, shape.items))
        case ByPoints():
            return (stand_in(shape.row),)
        case Balances():
            return None
        case Parsed():
            return shape.stand_in
        case ByLaw() | ByForm():
            return None if shape.scalar is None else stand_in(shape.scalar)
    return {}


def values_before(shape: ByKey) -> dict[str, Any]:
    """Return defaults for the optional keys of a mapping, and stand-ins for required keys."""
    defaults = {key.name: key.default for key in shape.keys if key.default is not None}
    return {key.name: stand_in(key.shape) for key in shape.keys if key.required} | defaults
