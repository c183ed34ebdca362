"""What is heavy in a torsional system."""

from __future__ import annotations

from typing import NamedTuple

from vstatics.numerics.motions import Form


class Body(NamedTuple):
    """What is heavy: a link, or the planets of a set."""

    name: str
    form: Form
    """Its speed by those of links (indices from 0). [-]"""
    inertia: float
    """[kg*m^2]"""
