"""The stick diagram of planetary sets whose teeth are not known, as of boxes that were found."""

from __future__ import annotations

from functools import partial
from typing import NamedTuple

from vstatics.elements.element import CentralWheel
from vstatics.elements.group import PlanetGroup
from vstatics.model.parts import Mechanism
from vstatics.model.transmission import Transmission
from vstatics.pictures.labels import Point
from vstatics.pictures.schemes.glyphs import Glyph
from vstatics.pictures.schemes.pen import Window
from vstatics.pictures.schemes.scheme import Device, Scheme, scheme_of
from vstatics.pictures.schemes.sets import set_glyphs
from vstatics.pictures.schemes.sheet import Sheet, draw_devices, extent, wired
from vstatics.pictures.schemes.stick import StickLayout, axis, draw_mechanism, glyphs_of, place
from vstatics.pictures.style import Style
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

    def drawn(self, title: str = "", within: Window | None = None) -> Sheet:
        """The diagram by itself, or at a place of another figure."""
        placement = self.layout.placement
        sheet = wired(self.scheme, placement, self.style, title=title, within=within)
        axis(sheet)
        draw_devices(sheet, partial(draw_mechanism, self.layout))
        return sheet


def bare_stick(case: Transmission, style: Style, *, is_small: bool = False) -> BareStick:
    """The stick diagram of a case whose mechanisms are planetary sets: sun, ring, carrier.

    Below 0 a ratio is that of a simple set, above 0 one of meshed planets; where its size is
    below 1 the first link has the ring.

    Parameters
    ----------
    is_small : bool
        It stands beside others: shift elements are called A, B, C in the order of the case, and
        links have no names but those of input and output.

    Examples
    --------
    >>> from vstatics import Gear, ShiftElement
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2)], [Gear([1])])
    >>> sheet = bare_stick(case, Style(), is_small=True).drawn()
    >>> sorted(text.get_text() for text in sheet.pen.axes.texts if text.get_text())
    ['1', '3', 'A', 'D1']
    """
    drawn = scheme_of(case)
    names = iter(letters(len(drawn.devices)))
    devices: list[Device] = []
    glyphs: dict[int, list[Glyph]] = {}
    for index, device in enumerate(drawn.devices):
        if device.kind == "mechanism":
            group = bare_group(case.mechanisms[device.numbers[0]])
            glyphs[index] = set_glyphs(group)
            members = {wheel.member: wheel.link for wheel in group.wheels}
            devices.append(device._replace(members={**members, "carrier": group.carrier}))
        elif device.element is not None and not device.is_on_housing:
            glyphs[index] = glyphs_of(device)
            devices.append(device)
        else:
            is_lettered = is_small and device.is_shift_element
            devices.append(device._replace(name=next(names)) if is_lettered else device)
    scheme = Scheme(drawn.links, devices, drawn.ports)
    layout = place(scheme, style, glyphs, is_small=is_small, is_quick=True)
    return BareStick(scheme, layout, style)


def bare_group(mechanism: Mechanism) -> PlanetGroup:
    """Wheels and planets of a set, with teeth that stand for any.

    >>> [wheel.link for wheel in bare_group(Mechanism(1, 2, 3, -0.4)).wheels]
    [2, 1]
    """
    first, second, carrier = mechanism.links
    sun, ring = (first, second) if abs(mechanism.ratio) >= 1 else (second, first)
    is_simple = mechanism.ratio < 0
    rims = ("planet",) if is_simple else ("inner", "outer")
    wheels = [
        CentralWheel("sun", sun, 1, internal=False, rim=rims[0]),
        CentralWheel("ring", ring, 1, internal=True, rim=rims[-1]),
    ]
    meshes = [] if is_simple else [("inner", "outer")]
    return PlanetGroup(carrier, wheels, {rim: {rim: None} for rim in rims}, meshes)
