"""Stick diagram of a found gearbox as a file."""

from __future__ import annotations

from vstatics.core.model.transmission import Transmission
from vstatics.pictures.drawing.style import Style
from vstatics.pictures.drawing.svg import written_as_svg
from vstatics.pictures.schemes.bare import bare_stick


def stick_diagram(case: Transmission, title: str | None = None) -> bytes:
    """Draw the stick diagram of a found gearbox as SVG. Mechanisms are drawn as planetary sets.

    Parameters
    ----------
    title : str, optional
        Title; by default the name of the case.

    Examples
    --------
    >>> from vstatics import Gear, Mechanism, ShiftElement
    >>> case = Transmission(3, [ShiftElement(2)], [Mechanism(1, 2, 3, -2)], [Gear([1])])
    >>> stick_diagram(case)[:5]
    b'<?xml'
    """
    style = Style()
    shown = case.name if title is None else title
    return written_as_svg(bare_stick(case, style).drawn(shown).canvas, shown)
