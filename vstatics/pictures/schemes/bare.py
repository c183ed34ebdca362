"""Stick diagrams of planetary gear sets without tooth numbers, as in gearboxes of a synthesis."""

from __future__ import annotations

from typing import NamedTuple

from vstatics.core.model.transmission import Transmission
from vstatics.core.summary.contrast import letters
from vstatics.pictures.drawing.canvas import Point
from vstatics.pictures.drawing.pen import Pen
from vstatics.pictures.drawing.style import Style
from vstatics.pictures.schemes.coaxial.drawn.lines import wires_of
from vstatics.pictures.schemes.coaxial.fitting import laid_out
from vstatics.pictures.schemes.coaxial.half_section import CoaxialLayout
from vstatics.pictures.schemes.coaxial.picture import CoaxialSheet, draw_half_section, painted
from vstatics.pictures.schemes.coaxial.rooms import extent
from vstatics.pictures.schemes.coaxial.search.order import QUICK
from vstatics.pictures.schemes.coaxial.section import coaxial_scheme
from vstatics.pictures.schemes.ink import SchemeInk
from vstatics.pictures.schemes.planetary import as_sets, sections_of
from vstatics.pictures.schemes.scheme import Scheme, SchemeState, scheme_of
from vstatics.pictures.schemes.titles import Titles


class BareStick(NamedTuple):
    """Stick diagram with positions, before drawing."""

    layout: CoaxialLayout
    style: Style

    @property
    def size(self) -> Point:
        """Width and height, in points."""
        low, high = extent(self.layout)
        return high[0] - low[0], high[1] - low[1]

    def drawn(self, title: str = "") -> Pen:
        """Return a pen for a new canvas with only the diagram."""
        return painted(CoaxialSheet(self.layout), self.style, SchemeState(), Titles(), title)

    def draw(self, within: Pen) -> None:
        """Draw the diagram in the rectangle of a pen."""
        pen, scheme = within.fitted(*extent(self.layout)), self.layout.coaxial.scheme
        draw_half_section(
            SchemeInk(pen, scheme, SchemeState(), Titles()), self.layout, wires_of(self.layout)
        )


def bare_stick(case: Transmission, style: Style, *, is_small: bool = False) -> BareStick:
    """Return the stick diagram of a case with mechanisms as planetary gear sets.

    Parameters
    ----------
    is_small : bool
        True for a small diagram in a list: shift elements are named A, B, C in the order of the
        case, and only input and output links are named.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2)], [Gear([1])])
    >>> pen = bare_stick(case, Style(), is_small=True).drawn()
    >>> sorted(pen.canvas.texts)
    ['1', '3', 'A', 'D1']
    """
    drawn = scheme_of(case)
    devices = as_sets(drawn.devices, case.mechanisms)
    names = iter(letters(len(devices)))
    if is_small:
        devices = [
            device._replace(name=next(names)) if device.is_shift_element else device
            for device in devices
        ]
    scheme = Scheme(drawn.links, devices, drawn.ports)
    coaxial = coaxial_scheme(scheme, sections_of(scheme, case, style))
    if coaxial is None:
        raise TypeError(case)
    return BareStick(laid_out(coaxial, is_small=is_small, effort=QUICK), style)
