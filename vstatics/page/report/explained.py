"""What `explain` tells of each gear, as parts of the page: its ratio first, then why."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from textwrap import dedent

from vstatics.core.errors import CaseError
from vstatics.core.explain import explain_gear
from vstatics.core.explain.explanation import Explanation
from vstatics.core.explain.text import sections
from vstatics.core.extras import missing
from vstatics.core.tables.html import Markup, scrolled, tag
from vstatics.page.report.material import Material


def explained(material: Material) -> list[Sequence[Markup]]:
    """Of each gear that is shown: its ratio as a formula, equations and signs.

    The matrix, which gears have in common, stands among the tables.

    What is the same for all gears, that there is no formula, `no_formula` says once.
    """
    return [
        list(_explained(material, gear.name))
        for gear in material.results.case.gears
        if material.asked.shows(gear.name)
    ]


def _explained(material: Material, gear: str) -> Iterator[Markup]:
    """A gear, or why no equations are written of it."""
    try:
        yield from _gear(explain_gear(material.results, gear), material.digits)
    except CaseError as error:
        yield tag("p", error.problems[0].message)


def no_formula() -> str:
    """Why no gear has a formula of its ratio, else nothing."""
    return missing("formula", "the formula of the ratio")


def _gear(one: Explanation, digits: int | None) -> Iterator[Markup]:
    """The ratio first, then the rest in its order."""
    if no_formula():
        one = one._replace(reason="")
    parts = sorted(sections(one, digits), key=lambda part: part.key != "ratio")
    for part in parts:
        if part.key == "matrix":
            continue
        shown = _lines(part.lines)
        name, colon, rest = part.heading.partition(":")
        note = [tag("span", f"{colon}{_typeset(rest)}", class_="note")] * bool(rest)
        yield tag("div", tag("h4", name, *note), scrolled(shown, name), class_="explained")


_BEFORE = re.compile(r"\S.*?\s{2,}|\s*")
"""What stands before an equation: a name, or blanks where it has that of the line above."""


def _lines(lines: Sequence[str]) -> Markup:
    """Lines that go on below their equation, not below its name, where they are too long.

    >>> print(_lines(["in  M = 1", "2 M = 2"]))
    <pre style="--before: 4ch"><span>in  M = 1
    </span><span class="whole">2 M = 2
    </span></pre>
    """
    shown = _typeset(dedent("\n".join(lines))).split("\n")
    before = [found.end() for found in map(_BEFORE.match, shown) if found]
    widest = max(before)
    spans = (
        tag("span", f"{line}\n", class_="whole" if end < widest or not end else False)
        for line, end in zip(shown, before, strict=True)
    )
    return tag("pre", *spans, style=f"--before: {widest}ch")


_MINUS, _TIMES = re.compile(r"(?<![^\s(])-(?=[a-z(])"), re.compile(r"(?<=[\d)]) x (?=[-\d(])")


def _typeset(text: str) -> str:
    """Equations with the times and the eta of print; the page does so with numbers.

    >>> _typeset("-w[sun 1-2] - (1 - u) w_in = -0.5; -2 x (-.5) = 1, u eta^x")
    '−w[sun 1-2] - (1 - u) w_in = -0.5; -2 × (-.5) = 1, u η^x'
    """
    return _MINUS.sub("\u2212", _TIMES.sub(" × ", text)).replace("eta^x", "\u03b7^x")
