"""Stick diagrams: the half of a transmission above its axis, with gears as lines of teeth.

Components on one axis form a half-section; several axes are drawn as rows. If the case has no gear
sets, mechanisms are drawn as planetary gear sets.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace

from vstatics.core.elements.drawing import drawing_of
from vstatics.core.errors import CaseError
from vstatics.core.model.transmission import Transmission
from vstatics.core.statics.results import Results
from vstatics.pictures.drawing.canvas import Canvas
from vstatics.pictures.drawing.style import Style
from vstatics.pictures.schemes.axes.recognition import ParallelAxes, parallel_axes
from vstatics.pictures.schemes.coaxial.picture import coaxial_sheet, figures
from vstatics.pictures.schemes.planetary import as_sets, can_be_set, sections_of
from vstatics.pictures.schemes.scheme import Scheme, scheme_of


def each(results: Results, style: Style, shown: Iterable[Sequence[int]]) -> Iterator[list[Canvas]]:
    """Yield the pages of the stick diagram of a case, without a gear or for each list of gears.

    In the picture of a gear, engaged shift elements and locked-up gear sets are marked, and lines
    without torque are pale. All pictures have the same layout.

    Raises
    ------
    CaseError
        If the case only has mechanisms that cannot be planetary sets.
    """
    case = results.case
    axes, sheet = parallel_axes(scheme := scheme_of(case), case), None
    if axes is None:
        sheet = coaxial_sheet(drawn := stick_scheme(case), sections_of(drawn, case, style), style)
        axes = ParallelAxes([frozenset(range(1, len(scheme.links) + 1))], [])
    if sheet is None:
        from vstatics.pictures.schemes.axes.picture import figures as axes_figures

        yield from axes_figures(results, scheme, axes, style, shown)
        return
    subject = style.text("stick diagram")
    note = style.text(
        "mechanisms as planetary sets: simple ones where u < 0, with meshed planets where u > 0",
    )
    is_bare = any(drawn.devices[place].element is None for place in sheet.layout.coaxial.sections)
    yield from figures(results, drawn, sheet, style, shown, subject, note * is_bare)


def stick_scheme(case: Transmission) -> Scheme:
    """Return the scheme of a stick diagram, with mechanisms as planetary sets if possible.

    Raises
    ------
    CaseError
        If the case only has mechanisms that cannot be planetary sets.
    """
    drawing, scheme = drawing_of(case), scheme_of(case)
    if drawing is not None and drawing.elements:
        return scheme
    if not any(map(can_be_set, scheme.devices)):
        message = (
            "a stick diagram needs gear sets under `elements:`, as `vstatics new` writes them; "
            "this case has mechanisms only, and none of them can be a gear set: "
            "choose the picture `structure`, or find tooth numbers "
            "(vstatics synth teeth CASE --write FILE)"
        )
        raise CaseError("E411", message)
    return replace(scheme, devices=as_sets(scheme.devices, case.mechanisms))
