"""Explanation of a gear as text, 80 columns wide where possible."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator, Sequence
from textwrap import wrap
from typing import NamedTuple

from vstatics.core.explain.converters import CONVERTERS, sought_ratio
from vstatics.core.explain.explanation import Explanation
from vstatics.core.explain.formula import FOLLOWS
from vstatics.core.explain.machines import MACHINES
from vstatics.core.explain.signs import PowerSign, TriedSigns
from vstatics.core.explain.sums import (
    EQUATION_WIDTH,
    INDENT,
    System,
    filled,
    in_numbers,
    in_symbols,
    listed,
)
from vstatics.core.tables.grid import Column, Grid
from vstatics.core.tables.numbers import fixed, short
from vstatics.core.tables.text import lines as table_lines
from vstatics.core.texts import tr

LABEL = 20
"""Width of labels before equations, in characters. A longer label has its own line."""


def write(explained: Iterable[Explanation], digits: int | None = None) -> str:
    """Return the explanations of gears as text.

    Parameters
    ----------
    digits : int, optional
        Number of decimals of numbers that are not whole. Default: five significant digits.
    """
    return "\n".join("\n".join(_gear(explanation, digits)) + "\n" for explanation in explained)


def _gear(explanation: Explanation, digits: int | None) -> Iterator[str]:
    title = tr(
        "Gear {gear}: {engaged}",
        gear=explanation.gear,
        engaged=engaged(explanation.engaged, explanation.holding, explanation.slipping or ()),
    )
    yield from (title, "=" * min(len(title), EQUATION_WIDTH))
    for message in explanation.messages:
        yield from _wrapped(message, 0)
    for section in sections(explanation, digits):
        yield from ("", *wrap(section.heading, EQUATION_WIDTH), *section.lines)


def _wrapped(text: str, depth: int = 1) -> list[str]:
    further = INDENT * (depth + 1)
    return wrap(text, EQUATION_WIDTH, initial_indent=INDENT * depth, subsequent_indent=further)


class Chapter(NamedTuple):
    """Section of an explanation."""

    key: str
    """Key of the section, in English."""
    heading: str
    lines: list[str]


def sections(explanation: Explanation, digits: int | None = None) -> Iterator[Chapter]:
    """Yield the non-empty sections of an explanation, from the matrix to the ratio.

    >>> from vstatics import Gear, Mechanism, Transmission, solve
    >>> from vstatics.core.explain import explain_gear
    >>> gear = explain_gear(solve(Transmission(2, [], [Mechanism(1, 2, 0, -4.0)], [Gear()])), 1)
    >>> [section.key for section in sections(gear)]
    ['matrix', 'speeds', 'torques', 'losses', 'ratio']
    """
    unit = "" if explanation.input_torque else tr(", in N*m")
    is_ratio = explanation.formula is None or explanation.formula.left == "i"
    parts = (
        ("matrix", tr(MATRIX), _matrix(explanation, digits)),
        ("speeds", tr("Speeds"), _system(explanation.speeds, digits, with_symbols=True)),
        (
            "torques",
            tr("Torques: the balance of each link") + unit,
            _system(explanation.torques, digits, with_symbols=True),
        ),
        (
            "losses",
            f"{tr('Torques with losses')}{unit}: "
            + rule(coasts=explanation.coasts, drags=_drags(explanation)),
            _losses(explanation, digits),
        ),
        ("converters", tr(CONVERTERS), _converters(explanation, digits)),
        ("balance", tr(MACHINES), _machines(explanation, digits)),
        ("together", tr("Links that turn together at any ratios"), _together(explanation)),
        ("ratio", tr("Ratio" if is_ratio else "Output speed"), _ratio(explanation, digits)),
    )
    for key, heading, lines in parts:
        if text_lines := list(lines):
            yield Chapter(key, heading, text_lines)


MATRIX = (
    "Structural-distribution matrix: torques on the links (rows) for 1 on the first link of each "
    "component (columns)"
)
"""Heading of the matrix."""
LOSSES = (
    "u eta^x instead of u; x = +1 where power enters a mechanism by its "
    "first link, seen from the third: M (w_first - w_third) > 0"
)
"""Rule for the sign when driving, part of the heading of torques with losses."""
COASTING = (
    "u eta^x instead of u; x = +1 where power enters a mechanism by its "
    "first link, seen from the third: M (w_first - w_third) < 0, as the unit of M is negative "
    "when coasting"
)
"""Rule for the sign when coasting."""


def rule(*, coasts: bool, drags: bool) -> str:
    """Return the rule that determines the sign of a mechanism from the torque."""
    return tr(COASTING if coasts else LOSSES) + tr(", M with drag") * drags


def engaged(
    elements: Sequence[str], holding: Sequence[str] = (), slipping: Sequence[str] = ()
) -> str:
    """Return words for the shift elements that are engaged, hold or slip under torque."""
    count, names = len(elements), ", ".join(elements)
    parts = [tr("engaged {names}|engaged {names}", names=names, count=count)] * bool(elements)
    if holding:
        names = ", ".join(holding)
        parts.append(tr("{names} holds|{names} hold", names=names, count=len(holding)))
    if slipping:
        names = ", ".join(slipping)
        parts.append(tr("{names} slips|{names} slip", names=names, count=len(slipping)))
    return "; ".join(parts) or tr("nothing engaged")


def _matrix(explanation: Explanation, digits: int | None) -> Iterator[str]:
    columns = [
        Column("", is_number=False),
        *(Column(name, is_name=True) for name in explanation.columns),
    ]
    rows = [
        [name, *(fixed(value, decimals=digits or 3) for value in row)]
        for name, row in zip(explanation.rows, explanation.matrix.tolist(), strict=True)
    ]
    yield from filter(None, table_lines(Grid("", columns, rows), indent=INDENT))
    if explanation.not_engaged:
        names = ", ".join(explanation.not_engaged)
        yield from _wrapped(tr("not engaged, so without column and torque: {names}", names=names))


def _system(system: System | None, digits: int | None, *, with_symbols: bool) -> Iterator[str]:
    """Yield lines with equations in symbols (if they differ) and in numbers, and the solution."""
    if system is None:
        return
    labels = [equation.label for equation in system.equations]
    column = max((len(label) for label in labels if len(label) <= LABEL), default=0)
    for equation, label in zip(system.equations, labels, strict=True):
        written = [in_numbers(equation, digits)]
        if with_symbols and in_symbols(equation) != written[0]:
            written.insert(0, in_symbols(equation))
        front = label
        if len(label) > column:
            yield INDENT + label
            front = ""
        for parts in written:
            yield from filled(parts, f"{INDENT}{front:{column}}  ")
            front = ""
    yield from _solution(system, digits)


def _solution(system: System, digits: int | None) -> Iterator[str]:
    values = system.values
    unknown = [name for name, value in values.items() if math.isnan(value)]
    known = [f"{name} = {short(values[name], digits)}" for name in values if name not in unknown]
    if not known:
        yield INDENT + tr("solution: there is none")
        return
    yield f"{INDENT}{tr('solution')}:"
    yield from listed(known, INDENT * 2)
    if unknown:
        yield from _wrapped(f"{tr('not determined')}: {', '.join(unknown)}", 2)


def _losses(explanation: Explanation, digits: int | None) -> Iterator[str]:
    if explanation.torques is None or all(map(math.isnan, explanation.torques.values.values())):
        return
    if not explanation.signs and not _drags(explanation):  # the gear has only springs
        return
    for sign in explanation.signs:
        yield from _sign(sign, digits)
    if explanation.lossy is None:
        yield INDENT + tr("there is no solution with losses")
        for tried in explanation.tried or ():
            yield from _tried(tried, digits)
    elif any(sign.lossy_ratio != sign.ratio for sign in explanation.signs) or _drags(explanation):
        if _drags(explanation):
            yield INDENT + tr(
                "torques of drag, and of the loss of the gear, are on the right-hand sides"
            )
        yield from _system(explanation.lossy, digits, with_symbols=False)
        yield INDENT + _efficiency(explanation, digits)
    else:
        yield INDENT + tr("all u stay as they are, and so do the torques")


def _tried(signs_tried: TriedSigns, digits: int | None) -> Iterator[str]:
    given = (
        f"{name} x = {sign:+.0f}, u eta^x = {short(signs_tried.lossy_ratios[name], digits)}"
        for name, sign in signs_tried.signs.items()
    )
    torque = f"Mx = {short(signs_tried.output_torque, digits)}"
    places = {"signs": "; ".join(given), "torque": torque, "said": speaks_against(signs_tried)}
    yield from _wrapped(tr("with {signs}: {torque}, but {said}", **places), 2)


def speaks_against(tried: TriedSigns) -> str:
    """Return the contradiction in a combination of signs, in the language of the output."""
    if not tried.against:
        return tr("power enters at the output, too")
    leaves, enters = "power leaves by the first link", "power enters by the first link"
    return f"{tried.against}: {tr(leaves if tried.signs[tried.against] > 0 else enters)}"


def _efficiency(explanation: Explanation, digits: int | None) -> str:
    """Return words for the efficiency, which a back-driven gear does not have."""
    assert explanation.lossy is not None  # noqa: S101 - for mypy
    if math.isnan(explanation.efficiency) and not any(
        map(math.isnan, explanation.lossy.values.values())
    ):
        return tr("there is no efficiency")
    return f"{tr('efficiency')} = {short(explanation.efficiency, digits)}"


def _drags(explanation: Explanation) -> bool:
    if explanation.torques is None or explanation.lossy is None:
        return False
    pairs = zip(explanation.torques.equations, explanation.lossy.equations, strict=True)
    return any(ideal.right != lossy.right for ideal, lossy in pairs)


def _sign(sign: PowerSign, digits: int | None) -> Iterator[str]:
    """Yield lines about a mechanism: power at the first link, sign, and ratio with losses."""
    label = f"{INDENT}{sign.mechanism}: "
    if sign.efficiency == 1 and sign.lossy_ratio == sign.ratio:
        yield f"{label}{sign.told}, u = {short(sign.ratio, digits)}"
        return
    torque, motion, power = (
        short(number, digits) for number in (sign.torque, sign.motion, sign.power)
    )
    product = f"{torque} x {f'({motion})' if sign.motion < 0 else motion} = {power}: "
    known = not (math.isnan(sign.torque) or math.isnan(sign.motion))
    yield from wrap(
        f"{label}{product * known}{sign.told}", EQUATION_WIDTH, subsequent_indent=INDENT * 3
    )
    if math.isnan(sign.lossy_ratio):
        return
    ratio, efficiency = short(sign.ratio, digits), short(sign.efficiency, digits)
    with_loss = f"{ratio} {'x' if sign.sign > 0 else '/'} {efficiency} = " if sign.sign else ""
    exponent = f"{sign.sign:+.0f}" if sign.sign else "0"
    yield f"{INDENT * 3}x = {exponent}, u eta^x = {with_loss}{short(sign.lossy_ratio, digits)}"


def _converters(explanation: Explanation, digits: int | None) -> Iterator[str]:
    for point in explanation.converters or ():
        ratio, torque_ratio = (short(each, digits) for each in point[1:3])
        yield f"{INDENT}{point.converter}: i = {ratio}, K = {torque_ratio}"
        for text in sought_ratio(point):
            yield from _wrapped(text)


def _machines(explanation: Explanation, digits: int | None) -> Iterator[str]:
    if explanation.balance is None:
        return
    column = max(len(share.link) for share in explanation.balance.shares)
    parts = []
    for share in explanation.balance.shares:
        power, efficiency, given = (short(each, digits) for each in share[1:])
        sign = "x" if share.power_kW > 0 else "/"
        label = f"{INDENT}{share.link:{column}}"
        yield f"{label}  P = {power} kW, {power} {sign} {efficiency} = {given} kW"
        size = short(abs(share.battery_kW), digits)
        parts += ["-" if share.battery_kW < 0 else "+", size]
    total = short(explanation.balance.battery_kW, digits)
    yield f"{INDENT}{tr('the battery gets')} {' '.join(parts).removeprefix('+ ')} = {total} kW"
    unit = "" if explanation.input_torque else " N*m"
    torque = f"{explanation.balance.link}: {short(explanation.balance.torque, digits)}{unit}"
    yield from _wrapped(tr("found by that, with losses: the torque on {torque}", torque=torque))
    yield from _wrapped(
        tr("the torques without losses take it as it is, so they do not balance the machines")
    )


def _together(explanation: Explanation) -> Iterator[str]:
    lines = []
    for body in explanation.together:
        by = tr(" (by {names})", names=", ".join(body.elements)) if body.elements else ""
        lines.append(f"{(tr('stand still') + ': ') * body.stands}{', '.join(body.links)}{by}")
    if explanation.one_piece:
        lines.append(tr("locked up: {names}", names=", ".join(explanation.one_piece)))
    if explanation.standing:
        lines.append(tr("stand still as a whole: {names}", names=", ".join(explanation.standing)))
    for line in lines:
        yield from _wrapped(line)


def _ratio(explanation: Explanation, digits: int | None) -> Iterator[str]:
    formula, ratio = explanation.formula, f"{INDENT}i = {explanation.input}/{explanation.output} = "
    if formula is None:
        if not math.isnan(explanation.ratio):
            yield f"{ratio}{short(explanation.ratio, digits)}"
        yield from _wrapped(reason(explanation.reason))
        return
    yield from _formula(
        ratio if formula.left == "i" else f"{INDENT}{formula.left} = ", formula.text
    )
    if formula.shared_text:
        equal = "; ".join(f"{new} = {' = '.join(old)}" for new, old in formula.shared.items())
        yield from _formula(f"{INDENT}{tr('with {equal}', equal=equal)}: i = ", formula.shared_text)
    for symbol in formula.symbols:
        meaning = (
            "" if f"u_{symbol.meaning}" == symbol.name else f"  ({symbol_meaning(symbol.meaning)})"
        )
        yield f"{INDENT}{symbol.name} = {short(symbol.value, digits)}{meaning}"
    for name, speed in formula.speeds.items():
        yield f"{INDENT}{name} = {short(speed, digits)}"
    yield f"{INDENT}{formula.left} = {short(formula.value, digits)}{tr(', as calculated')}"
    if formula.left != "i" and not math.isnan(explanation.ratio):
        yield f"{ratio}{short(explanation.ratio, digits)}"


_FOLLOWS = re.compile(re.sub(r"\\{(\w+)\\}", r"(?P<\1>.+)", re.escape(FOLLOWS)))


def reason(text: str) -> str:
    """Return the reason for a missing formula, in the language of the output."""
    match = _FOLLOWS.fullmatch(text)
    return tr(FOLLOWS, **match.groupdict()) if match else tr(text)


_BETWEEN_WHEELS = re.compile(r"(?P<part>.+): (?P<first>.+) to (?P<second>.+), (?P<third>.+) held")


def symbol_meaning(text: str) -> str:
    """Return the meaning of a symbol, in the language of the output."""
    match = _BETWEEN_WHEELS.fullmatch(text)
    if match is None:
        return text
    part, *members = match.groups()
    first, second, third = (tr(member.replace("_", " ")) for member in members)
    pattern = "{part}: {first} to {second}, {third} held"
    return tr(pattern, part=part, first=first, second=second, third=third)


def _formula(front: str, text: str) -> Iterator[str]:
    """Yield a formula in lines, broken before a sign if possible."""
    lines = list(filled(re.split(r" (?=[+-] )", text), front))
    if max(map(len, lines)) > EQUATION_WIDTH:
        lines = wrap(
            front + text, EQUATION_WIDTH, subsequent_indent=INDENT * 3, break_long_words=False
        )
    yield from lines
