"""An explanation as text, at most 80 columns wide where that is possible."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator, Sequence
from textwrap import wrap
from typing import NamedTuple

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
"""What stands before an equation has a line of its own when it is longer."""


def write(explained: Iterable[Explanation], digits: int | None = None) -> str:
    """Gears explained, one after the other.

    Parameters
    ----------
    digits : int, optional
        After the point of every number that is not whole, else five significant ones.
    """
    return "\n".join("\n".join(_gear(one, digits)) + "\n" for one in explained)


def _gear(one: Explanation, digits: int | None) -> Iterator[str]:
    title = tr("Gear {gear}: {engaged}", gear=one.gear, engaged=engaged(one.engaged, one.holding))
    yield from (title, "=" * min(len(title), EQUATION_WIDTH))
    for message in one.messages:
        yield from _wrapped(message, 0)
    for section in sections(one, digits):
        yield from ("", *wrap(section.heading, EQUATION_WIDTH), *section.lines)


def _wrapped(text: str, depth: int = 1) -> list[str]:
    """A text in lines that are set in, the further ones by one step more."""
    further = INDENT * (depth + 1)
    return wrap(text, EQUATION_WIDTH, initial_indent=INDENT * depth, subsequent_indent=further)


class Chapter(NamedTuple):
    """A part of an explanation."""

    key: str
    """What it is, in English."""
    heading: str
    lines: list[str]


def sections(one: Explanation, digits: int | None = None) -> Iterator[Chapter]:
    """The parts of an explanation that it has something for: the matrix first, the ratio last.

    >>> from vstatics import Gear, Mechanism, Transmission, solve
    >>> from vstatics.core.explain import explain_gear
    >>> gear = explain_gear(solve(Transmission(2, [], [Mechanism(1, 2, 0, -4.0)], [Gear()])), 1)
    >>> [section.key for section in sections(gear)]
    ['matrix', 'speeds', 'torques', 'losses', 'ratio']
    """
    unit = "" if one.input_torque else tr(", in N*m")
    is_ratio = one.formula is None or one.formula.left == "i"
    parts = (
        ("matrix", tr(MATRIX), _matrix(one, digits)),
        ("speeds", tr("Speeds"), _system(one.speeds, digits, with_symbols=True)),
        (
            "torques",
            tr("Torques: the balance of each link") + unit,
            _system(one.torques, digits, with_symbols=True),
        ),
        (
            "losses",
            f"{tr('Torques with losses')}{unit}: {rule(coasts=one.coasts, drags=_drags(one))}",
            _losses(one, digits),
        ),
        ("balance", tr(MACHINES), _machines(one, digits)),
        ("together", tr("Turning together, whatever the ratios are"), _together(one)),
        ("ratio", tr("Ratio" if is_ratio else "Output speed"), _ratio(one, digits)),
    )
    for key, heading, lines in parts:
        if found := list(lines):
            yield Chapter(key, heading, found)


MATRIX = (
    "Structural-distribution matrix: torques on the links (rows) for 1 on the first link of each "
    "device (columns)"
)
LOSSES = (
    "u eta^x in place of u; x = +1 where power enters a mechanism by its "
    "first link, seen from the third: M (w_first - w_third) > 0"
)
COASTING = (
    "u eta^x in place of u; x = +1 where power enters a mechanism by its "
    "first link, seen from the third: M (w_first - w_third) < 0, as the unit of M is negative "
    "when coasting"
)


def rule(*, coasts: bool, drags: bool) -> str:
    """How the sign of a mechanism follows from its torque without losses, but with drag."""
    return tr(COASTING if coasts else LOSSES) + tr(", M with drag") * drags


def engaged(elements: Sequence[str], holding: Sequence[str] = ()) -> str:
    """What is engaged, and the freewheels that hold."""
    count, names = len(elements), ", ".join(elements)
    parts = [tr("engaged {names}|engaged {names}", names=names, count=count)] * bool(elements)
    if holding:
        names = ", ".join(holding)
        parts.append(tr("{names} holds|{names} hold", names=names, count=len(holding)))
    return "; ".join(parts) or tr("nothing engaged")


def _matrix(one: Explanation, digits: int | None) -> Iterator[str]:
    """The matrix, as many columns side by side as fit."""
    columns = [Column("", is_number=False), *(Column(name, is_name=True) for name in one.columns)]
    rows = [
        [name, *(fixed(value, decimals=digits or 3) for value in row)]
        for name, row in zip(one.rows, one.matrix.tolist(), strict=True)
    ]
    yield from filter(None, table_lines(Grid("", columns, rows), indent=INDENT))
    if one.not_engaged:
        names = ", ".join(one.not_engaged)
        yield from _wrapped(tr("not engaged, so without column and torque: {names}", names=names))


def _system(system: System | None, digits: int | None, *, with_symbols: bool) -> Iterator[str]:
    """Equations, in symbols where these tell more, then with numbers; then their solution."""
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
    """What the equations determine."""
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


def _losses(one: Explanation, digits: int | None) -> Iterator[str]:
    """The signs, and the torque equations with ratios that have losses in them."""
    if one.torques is None or all(map(math.isnan, one.torques.values.values())):
        return
    if not one.signs and not _drags(one):  # springs alone
        return
    for sign in one.signs:
        yield from _sign(sign, digits)
    if one.lossy is None:
        yield INDENT + tr("there is no solution with losses")
        for tried in one.tried or ():
            yield from _tried(tried, digits)
    elif any(sign.lossy_ratio != sign.ratio for sign in one.signs) or _drags(one):
        if _drags(one):
            yield INDENT + tr("drag stands on the right sides")
        yield from _system(one.lossy, digits, with_symbols=False)
        yield INDENT + _efficiency(one, digits)
    else:
        yield INDENT + tr("all u stay as they are, and so do the torques")


def _tried(one: TriedSigns, digits: int | None) -> Iterator[str]:
    """Signs of mechanisms, where they lead and what speaks against it."""
    given = (
        f"{name} x = {sign:+.0f}, u eta^x = {short(one.lossy_ratios[name], digits)}"
        for name, sign in one.signs.items()
    )
    torque = f"Mx = {short(one.output_torque, digits)}"
    places = {"signs": "; ".join(given), "torque": torque, "said": speaks_against(one)}
    yield from _wrapped(tr("with {signs}: {torque}, but {said}", **places), 2)


def speaks_against(one: TriedSigns) -> str:
    """What does not agree with signs, in the language that is spoken."""
    if not one.against:
        return tr("power enters at the output, too")
    leaves, enters = "power leaves by the first link", "power enters by the first link"
    return f"{one.against}: {tr(leaves if one.signs[one.against] > 0 else enters)}"


def _efficiency(one: Explanation, digits: int | None) -> str:
    """Its value; there is none where all torques are known, such as those of a dragged gear."""
    assert one.lossy is not None  # noqa: S101 - for mypy
    if math.isnan(one.efficiency) and not any(map(math.isnan, one.lossy.values.values())):
        return tr("there is no efficiency")
    return f"{tr('efficiency')} = {short(one.efficiency, digits)}"


def _drags(one: Explanation) -> bool:
    if one.torques is None or one.lossy is None:
        return False
    pairs = zip(one.torques.equations, one.lossy.equations, strict=True)
    return any(ideal.right != lossy.right for ideal, lossy in pairs)


def _sign(sign: PowerSign, digits: int | None) -> Iterator[str]:
    """A mechanism, its power by the first link, its sign and its ratio with losses."""
    label = f"{INDENT}{sign.mechanism}: "
    if sign.efficiency == 1 and sign.lossy_ratio == sign.ratio:
        yield f"{label}{sign.told}, u = {short(sign.ratio, digits)}"
        return
    torque, motion, power = (short(one, digits) for one in (sign.torque, sign.motion, sign.power))
    product = f"{torque} x {f'({motion})' if sign.motion < 0 else motion} = {power}: "
    known = not (math.isnan(sign.torque) or math.isnan(sign.motion))
    text = f"{label}{product * known}{sign.told}"
    yield from wrap(text, EQUATION_WIDTH, subsequent_indent=INDENT * 3)
    if math.isnan(sign.lossy_ratio):
        return
    ratio, efficiency = short(sign.ratio, digits), short(sign.efficiency, digits)
    with_loss = f"{ratio} {'x' if sign.sign > 0 else '/'} {efficiency} = " if sign.sign else ""
    exponent = f"{sign.sign:+.0f}" if sign.sign else "0"
    yield f"{INDENT * 3}x = {exponent}, u eta^x = {with_loss}{short(sign.lossy_ratio, digits)}"


def _machines(one: Explanation, digits: int | None) -> Iterator[str]:
    """What each machine gives the battery, or takes, and the torque that balances them."""
    if one.balance is None:
        return
    column = max(len(share.link) for share in one.balance.shares)
    parts: list[str] = []
    for share in one.balance.shares:
        power, efficiency, given = (short(each, digits) for each in share[1:])
        sign = "x" if share.power_kW > 0 else "/"
        label = f"{INDENT}{share.link:{column}}"
        yield f"{label}  P = {power} kW, {power} {sign} {efficiency} = {given} kW"
        size = short(abs(share.battery_kW), digits)
        parts += ["-" if share.battery_kW < 0 else "+", size]
    total = short(one.balance.battery_kW, digits)
    yield f"{INDENT}{tr('the battery gets')} {' '.join(parts).removeprefix('+ ')} = {total} kW"
    unit = "" if one.input_torque else " N*m"
    torque = f"{one.balance.link}: {short(one.balance.torque, digits)}{unit}"
    yield from _wrapped(tr("found by that, with losses: the torque on {torque}", torque=torque))
    yield from _wrapped(
        tr("the torques without losses take it as it is, so they do not balance the machines")
    )


def _together(one: Explanation) -> Iterator[str]:
    """Links that are one body."""
    lines = []
    for body in one.together:
        by = tr(" (by {names})", names=", ".join(body.elements)) if body.elements else ""
        lines.append(f"{(tr('stand still') + ': ') * body.stands}{', '.join(body.links)}{by}")
    if one.one_piece:
        lines.append(tr("as one piece: {names}", names=", ".join(one.one_piece)))
    if one.standing:
        lines.append(tr("stand still as a whole: {names}", names=", ".join(one.standing)))
    for line in lines:
        yield from _wrapped(line)


def _ratio(one: Explanation, digits: int | None) -> Iterator[str]:
    """The formula beside the value, and the values of its symbols."""
    formula, ratio = one.formula, f"{INDENT}i = {one.input}/{one.output} = "
    if formula is None:
        if not math.isnan(one.ratio):
            yield f"{ratio}{short(one.ratio, digits)}"
        yield from _wrapped(reason(one.reason))
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
    if formula.left != "i" and not math.isnan(one.ratio):
        yield f"{ratio}{short(one.ratio, digits)}"


_FOLLOWS = re.compile(re.sub(r"\\{(\w+)\\}", r"(?P<\1>.+)", re.escape(FOLLOWS)))


def reason(text: str) -> str:
    """Why there is no formula, in the language that is spoken."""
    found = _FOLLOWS.fullmatch(text)
    return tr(FOLLOWS, **found.groupdict()) if found else tr(text)


_BETWEEN_WHEELS = re.compile(r"(?P<part>.+): (?P<first>.+) to (?P<second>.+), (?P<third>.+) held")


def symbol_meaning(text: str) -> str:
    """What a symbol stands for, in the language that is spoken."""
    found = _BETWEEN_WHEELS.fullmatch(text)
    if found is None:
        return text
    part, *members = found.groups()
    first, second, third = (tr(one.replace("_", " ")) for one in members)
    said = "{part}: {first} to {second}, {third} held"
    return tr(said, part=part, first=first, second=second, third=third)


def _formula(front: str, text: str) -> Iterator[str]:
    """A formula in lines, broken before a sign if that is enough."""
    lines = list(filled(re.split(r" (?=[+-] )", text), front))
    if max(map(len, lines)) > EQUATION_WIDTH:
        lines = wrap(
            front + text, EQUATION_WIDTH, subsequent_indent=INDENT * 3, break_long_words=False
        )
    yield from lines
