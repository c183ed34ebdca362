"""Typical elements: gear wheels, planetary sets, differentials, from their teeth.

The room for cases that are drawn rather than prepared. `kinds` declares what there is,
`element` holds a case's elements, `group` has exact ratios of planets on a carrier,
`lower` makes three-link mechanisms of them, `build` a transmission; `checks` and `teeth`
say what cannot be, and `view` shows results for the elements again.
"""

from vstatics.elements.build import transmission
from vstatics.elements.drawing import Drawing
from vstatics.elements.element import CentralWheel, Element, MeshEfficiency

__all__ = ["CentralWheel", "Drawing", "Element", "MeshEfficiency", "transmission"]
