"""Placeholders for pictures and slow sections, which are drawn when they become visible."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import partial

from vstatics.core.annexes import picture_kinds, report_parts
from vstatics.core.errors import CaseError
from vstatics.core.statics.results import Results
from vstatics.core.tables.html import Markup, joined, tag
from vstatics.core.texts import tr
from vstatics.page.report.asked import SECTIONS, AskedPage
from vstatics.page.report.material import Material, module_of_part, part_of
from vstatics.page.report.page_pictures import Pictures, of_all_gears
from vstatics.page.report.sections import sections
from vstatics.pictures.paged.drawn import Drawn, bare_stick, picture_of
from vstatics.pictures.paged.parts import Part, PartRequest
from vstatics.pictures.runs import PicturedRun

OF_GEARS = ("stick", "flow", "lever", "modes")
"""Kinds of pictures of a single gear."""
OF_ALL_GEARS = ("campbell",)
"""Kinds of pictures in annex sections that show all gears together."""
OF_RUN = ("shift", "plan", "stick")
SOON, LATER = tuple(report_parts()), ("equations",)
"""Keys of sections that are requested right after loading, and when they become visible."""
QUICK = [key for key in SECTIONS if key not in (*SOON, *LATER)]


def awaited(name: str, *, soon: bool = False) -> Markup:
    """Return a placeholder that the script replaces once it is visible, or at once if `soon`.

    >>> print(awaited("flow:2"))
    <div class="awaited" data-awaited="flow:2"></div>
    """
    return tag("div", class_="awaited", data_awaited=name, data_soon=soon)


def awaited_pictures(results: Results) -> Pictures:
    """Return placeholders for all pictures of a case."""
    gears = range(1, len(results.case.gears) + 1)
    return Pictures(
        {kind: [_drawn(f"{kind}:{gear}") for gear in gears] for kind in ("stick", "flow", "lever")},
        {kind: _drawn(kind) for kind in of_all_gears(results.case)},
    )


def _drawn(name: str, *, soon: bool = False) -> Drawn:
    return Drawn(name.partition(":")[0], [awaited(name, soon=soon)])


def awaited_sections(material: Material, *, runs: bool) -> Iterator[Part]:
    """Yield the sections in order, with placeholders instead of slow sections."""
    quick = {part.name: part for part in sections(material)}
    case = material.results.case
    has_section = {key: module_of_part(key).has_part(case, runs=runs) for key in report_parts()}
    has_section["equations"] = True
    for key, name in SECTIONS.items():
        if name in quick:
            yield quick[name]
        elif has_section.get(key):
            yield Part(name, [awaited(key, soon=key in SOON)])


def awaited_part(
    name: str, material: Material, run: Callable[[], PicturedRun | None]
) -> Markup | None:
    """Return the HTML that replaces a placeholder, None if it does not exist.

    Parameters
    ----------
    name : str
        Name of the placeholder.
    material : Material
        Contents of the page.
    run : callable
        Function that returns the simulated run of a scenario, None for a case; it can raise a
        `CaseError`.
    """
    try:
        return _section(name, material, run) or _picture(name, material.results, run)
    except CaseError as error:
        return tag("p", tr("Not made: {why}", why=" ".join(str(error).split())), class_="error")


def _section(name: str, material: Material, run: Callable[[], PicturedRun | None]) -> Markup | None:
    """Return a section with placeholders for its pictures."""
    shown: Iterable[Markup] = ()
    if name in report_parts():
        motion = run() if name == "run" else None
        request = PartRequest(material.results, _awaited_picture, motion=motion, has_marks=True)
        if part := part_of(name, request):
            shown = part.shown(material.digits)
    elif name == "equations":
        parts = sections(material._replace(asked=AskedPage([name])))
        shown = (markup for part in parts for markup in part.shown)
    return joined(*shown) or None


def _awaited_picture(
    kind: str, gears: Sequence[int] = (), motion: PicturedRun | None = None
) -> Drawn:
    if motion is not None:
        return Drawn(kind, [awaited(f"run-picture:{kind}", soon=kind == "shift")])
    return _drawn(":".join([kind, *map(str, gears)]))


def _picture(name: str, results: Results, run: Callable[[], PicturedRun | None]) -> Markup | None:
    kind, _, of = name.partition(":")
    drawn = None
    if kind == "run-picture" and of in OF_RUN and (motion := run()):
        draw = partial(picture_of, results)
        drawn = bare_stick(draw, motion) if of == "stick" else draw(of, motion=motion)
    elif name in (*of_all_gears(results.case), *OF_ALL_GEARS) and name in picture_kinds():
        drawn = picture_of(results, name)
    elif kind in OF_GEARS and of in map(str, range(1, len(results.case.gears) + 1)):
        drawn = picture_of(results, kind, [int(of)])
        if kind == "stick" and not drawn.sheets:
            drawn = picture_of(results, "structure", [int(of)])
    if drawn is None:
        return None
    return tag("p", tr("Not drawn. {why}", why=drawn.why)) if drawn.why else joined(*drawn.sheets)
