"""Pictures of a result: which there are, and how one becomes SVG, PNG or PDF.

A result, a kind of picture and a style go in; the bytes of a file come out.

>>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
>>> from vstatics.pictures.drawing.style import Style
>>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2.5)], [Gear([1])])
>>> render(solve(case), "plan", "svg", Style())[:5]
b'<?xml'
>>> picture(solve(case), "plan", Style()).texts[0].get_text()
'Generalised kinematic plan'

`drawing` is what all share. `flow`, `lever`, `schemes` and `plan` have kinds of pictures, and `cli`
the command `vstatics plot`; other annexes have the pictures of their results. A kind is a function
``draw(results, style, gears)`` in a module of its own, which is imported when its picture is
asked for: matplotlib is an extra. `pair` puts two cases on one sheet.
It gives pages, each no larger than the style says. Kinds that show a run take its motion, too.
Where gears have something in common it is ``each(results, style, shown)``, which makes this once
for the pages of several lists of gears.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from importlib import import_module
from typing import TYPE_CHECKING, Any

from vstatics.core.extras import require
from vstatics.pictures.drawing.files import Format, files_of, settings_of, written
from vstatics.pictures.drawing.style import POINTS_PER_MILLIMETRE

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from vstatics.core.statics.results import Results
    from vstatics.pictures.drawing.style import Style
    from vstatics.simulation.record.motion import Motion

PICTURES = {
    "plan": "vstatics.pictures.plan.picture",
    "lever": "vstatics.pictures.lever.picture",
    "flow": "vstatics.pictures.flow.picture",
    "structure": "vstatics.pictures.schemes.structure",
    "stick": "vstatics.pictures.schemes.stick",
    "efficiency": "vstatics.pictures.flow.efficiency",
    "modes": "vstatics.torsion.pictures.shapes.modes",
    "campbell": "vstatics.torsion.pictures.orders.campbell",
    "response": "vstatics.torsion.pictures.orders.response",
    "dump": "vstatics.torsion.pictures.dump",
    "shift": "vstatics.simulation.pictures.shift",
    "traction": "vstatics.vehicle.pictures.traction",
    "sawtooth": "vstatics.vehicle.pictures.sawtooth",
    "steps": "vstatics.vehicle.pictures.steps",
}
"""Kind of picture -> module."""
OF_RUNS = ("shift", "plan")
"""Kinds that show a run: ``draw(results, style, gears, motion)``."""
OF_VIBRATION = ("modes", "campbell", "response", "dump")
"""Kinds that show vibration: a converter may be open."""
OF_ORDERS = ("campbell", "response")
"""Kinds that are over orders of a speed: `Style.excited` tells which."""
LEAST_WIDTHS = {"campbell": 135.0, "response": 100.0, "dump": 135.0}
"""By kind: on a narrower page there is no room for its names and numbers. [mm]"""
OPTIONS: Mapping[str, tuple[Sequence[str], str]] = {
    "motion": (OF_RUNS, f"only {' and '.join(OF_RUNS)} show a run"),
    "merge": (("lever",), "only levers can be merged"),
    "wheels": (("stick",), "only stick diagrams name them"),
    "orders": (OF_ORDERS, f"only {' and '.join(OF_ORDERS)} have orders"),
    "speed": (OF_ORDERS, f"only {' and '.join(OF_ORDERS)} are over a speed"),
    "at": (("response",), "only a response is that of a link"),
    "gear": (
        [kind for kind in PICTURES if kind != "shift"],
        "a run goes through all gears of its scenario",
    ),
}
"""By option: the kinds that it is for, and what is said of others."""


def misplaced(kind: str, given: Mapping[str, object]) -> Iterator[tuple[str, str]]:
    """Options that a kind of picture has not, and why.

    >>> [*misplaced("plan", {"merge": True, "wheels": False})]
    [('merge', 'only levers can be merged')]
    """
    for name, value in given.items():
        kinds, why = OPTIONS[name]
        if kind not in kinds and value not in (None, False, "", ()):
            yield name, why


def picture(
    results: Results,
    kind: str,
    style: Style,
    gears: Sequence[int] = (),
    *,
    motion: Motion | None = None,
) -> Figure:
    """A picture of the results of one case on one page, as a figure of matplotlib.

    Parameters
    ----------
    kind : str
        One of `PICTURES`.
    gears : sequence of int, optional
        Numbers of the only gears that are to be shown, from 1.
    motion : Motion, optional
        A run of the case, for the kinds of `OF_RUNS`.

    Raises
    ------
    CaseError
        If matplotlib is not installed, or the case has nothing that could be drawn.
    """
    [[one]] = drawn_pages(results, kind, style._replace(height=math.inf), [gears], motion)
    return one


def drawn_pages(  # noqa: PLR0913, PLR0917 - what is drawn, and how
    results: Results,
    kind: str,
    style: Style,
    shown: Sequence[Sequence[int]],
    motion: Motion | None = None,
    others: Sequence[tuple[Results, Motion]] = (),
) -> list[list[Figure]]:
    """The pages of each list of gears; a run has room for others in its scales."""
    require("plot", "a picture")
    module = import_module(PICTURES[kind])
    least = LEAST_WIDTHS.get(kind, 0.0) * POINTS_PER_MILLIMETRE
    style = style._replace(width=max(style.width, least))
    with settings_of(style):
        if hasattr(module, "each"):
            return list(module.each(results, style, shown))
        return [module.draw(results, style, gears, *_run(kind, motion, others)) for gears in shown]


def render(  # noqa: PLR0913 - what is drawn, and how
    results: Results,
    kind: str,
    form: Format,
    style: Style,
    gears: Sequence[int] = (),
    *,
    motion: Motion | None = None,
) -> bytes:
    """A picture of a result on one page as a file; parameters and errors as of `picture`."""
    figure = picture(results, kind, style, gears, motion=motion)
    return written(figure, form, style, _alternative(results, kind, style, gears))


def pages(  # noqa: PLR0913 - what is drawn, and how
    results: Results,
    kind: str,
    form: Format,
    style: Style,
    gears: Sequence[int] = (),
    *,
    motion: Motion | None = None,
    others: Sequence[tuple[Results, Motion]] = (),
) -> list[bytes]:
    """A picture of a result as files: a page each, all in one PDF; as `picture` else.

    That of a run has scales with room for other runs.
    """
    [figures] = drawn_pages(results, kind, style, [gears], motion, others)
    return files_of(figures, form, style, _alternative(results, kind, style, gears))


def of_each_gear(
    results: Results, kind: str, style: Style, gears: Sequence[int]
) -> list[list[bytes]]:
    """The pages of each gear as SVG, in their order; parameters and errors as of `picture`."""
    shown = [(number,) for number in gears]
    titles = (_alternative(results, kind, style, gears) for gears in shown)
    return [
        files_of(figures, "svg", style, title)
        for title, figures in zip(titles, drawn_pages(results, kind, style, shown), strict=True)
    ]


def _run(
    kind: str, motion: Motion | None, others: Sequence[tuple[Results, Motion]]
) -> tuple[Any, ...]:
    """The run, for a picture that can show one, and others for one that has scales."""
    if kind not in OF_RUNS:
        return ()
    return (motion, others) if kind == "shift" else (motion,)


def _alternative(results: Results, kind: str, style: Style, gears: Sequence[int]) -> str:
    """What a picture shows, for those who do not see it."""
    from vstatics.pictures.drawing.words import KINDS, gear_title, title

    names = (gear_title(results.case.gears[number - 1].name, style) for number in gears)
    return title(results.case, ", ".join([style.text(KINDS[kind]), *names]))
