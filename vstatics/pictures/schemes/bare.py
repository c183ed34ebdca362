"""The stick diagram of planetary sets whose teeth are not known, as of boxes that were found."""

from __future__ import annotations

from functools import partial
from typing import NamedTuple

from vstatics.model.transmission import Transmission
from vstatics.pictures.schemes.scheme import Scheme, SchemeState, scheme_of
from vstatics.pictures.schemes.sheet import Sheet, extent, wired
from vstatics.pictures.schemes.stick import StickLayout, as_sets, draw_mechanism, place
from vstatics.pictures.schemes.titles import Titles
from vstatics.pictures.sheet.labels import Point
from vstatics.pictures.sheet.pen import Pen
from vstatics.pictures.sheet.style import Style
from vstatics.summary.contrast import letters


class BareStick(NamedTuple):
    """A stick diagram whose parts have their places, but which is not drawn yet."""

    scheme: Scheme
    layout: StickLayout
    style: Style

    @property
    def size(self) -> Point:
        """Width and height, in points."""
        low, high = extent(self.scheme, self.layout.placement)
        return high[0] - low[0], high[1] - low[1]

    def drawn(self, title: str = "", within: Pen | None = None) -> Sheet:
        """The diagram by itself, or at a place of another figure."""
        draw = partial(draw_mechanism, self.layout)
        drawn = self.scheme, self.layout.placement, self.style, draw, SchemeState()
        return wired(*drawn, titles=Titles(), name=title, within=within, is_coaxial=True)


def bare_stick(case: Transmission, style: Style, *, is_small: bool = False) -> BareStick:
    """The stick diagram of a case whose mechanisms are planetary sets: sun, ring, carrier.

    Parameters
    ----------
    is_small : bool
        It stands beside others: shift elements are called A, B, C in the order of the case, and
        links have no names but those of input and output.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2)], [Gear([1])])
    >>> sheet = bare_stick(case, Style(), is_small=True).drawn()
    >>> sorted(text.get_text() for text in sheet.pen.figure.texts)
    ['1', '3', 'A', 'D1']
    """
    drawn = scheme_of(case)
    devices, glyphs = as_sets(drawn.devices, case.mechanisms)
    names = iter(letters(len(devices)))
    if is_small:
        devices = [
            device._replace(name=next(names)) if device.is_shift_element else device
            for device in devices
        ]
    scheme = Scheme(drawn.links, devices, drawn.ports)
    layout = place(scheme, style, glyphs, is_small=is_small, is_quick=True)
    return BareStick(scheme, layout, style)
