"""Explanation of each gear on the page: its ratio, and the equations behind it."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from textwrap import dedent

from vstatics.core.errors import CaseError
from vstatics.core.explain import explain_gear
from vstatics.core.explain.explanation import Explanation
from vstatics.core.explain.text import sections
from vstatics.core.extras import missing
from vstatics.core.tables.html import Markup, tag
from vstatics.page.report.material import Material


def explained(material: Material) -> list[Sequence[Markup]]:
    """Return the explanation of each gear on the page: ratio, equations and signs.

    The matrix is common to all gears, so it is among the tables. If ratios have no formula,
    `no_formula` returns the reason, which is the same for all gears.
    """
    return [
        list(_explained(material, gear.name))
        for gear in material.results.case.gears
        if material.asked.shows(gear.name)
    ]


def _explained(material: Material, gear: str) -> Iterator[Markup]:
    try:
        yield from _gear(explain_gear(material.results, gear), material.digits)
    except CaseError as error:
        yield tag("p", error.problems[0].message)


def no_formula() -> str:
    """Return the reason why ratios have no formula, such as a missing package, or an empty text."""
    return missing("formula", "the formula of the ratio")


def _gear(explanation: Explanation, digits: int | None) -> Iterator[Markup]:
    """Yield the HTML elements of an explanation, beginning with the ratio."""
    if no_formula():
        explanation = explanation._replace(reason="")
    parts = sorted(sections(explanation, digits), key=lambda part: part.key != "ratio")
    for part in parts:
        if part.key == "matrix":
            continue
        shown = _lines(part.lines)
        name, _, comment = part.heading.partition(":")
        note = [tag("p", _typeset(comment.strip()), class_="note")] * bool(comment)
        heading = tag("h4", name)
        yield tag("div", heading, *note, shown, class_="explained")


_BEFORE = re.compile(r"\S.*?\s{2,}|\s*")
"""Pattern of the text before an equation: a name with blanks, or an indentation."""


def _lines(lines: Sequence[str]) -> Markup:
    """Return equations as HTML. A long line continues below its equation, after the name.

    >>> print(_lines(["in  M = 1", "2 M = 2"]))
    <pre style="--before: 4ch"><span>in  M = 1
    </span><span class="whole">2 M = 2
    </span></pre>
    """
    shown = _typeset(dedent("\n".join(lines))).split("\n")
    before = [match.end() for match in map(_BEFORE.match, shown) if match]
    widest = max(before)
    spans = (
        tag("span", f"{line}\n", class_="whole" if end < widest or not end else False)
        for line, end in zip(shown, before, strict=True)
    )
    return tag("pre", *spans, style=f"--before: {widest}ch")


_MINUS, _TIMES = re.compile(r"(?<![^\s(])-(?=[a-z(])"), re.compile(r"(?<=[\d)]) x (?=[-\d(])")


def _typeset(text: str) -> str:
    """Replace minus signs, multiplication signs and `eta` by typographic characters.

    >>> _typeset("-w[sun 1-2] - (1 - u) w_in = -0.5; -2 x (-0.5) = 1, u eta^x")
    '−w[sun 1-2] - (1 - u) w_in = -0.5; -2 × (-0.5) = 1, u η^x'
    """
    return _MINUS.sub("\u2212", _TIMES.sub(" × ", text)).replace("eta^x", "\u03b7^x")
