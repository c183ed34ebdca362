"""Typical elements: gear wheels, planetary sets, differentials, from their teeth.

>>> from vstatics.core.model.transmission import Gear, ShiftElement
>>> links = {"sun": 1, "ring": 2, "carrier": 3}
>>> sets = Element("P", "planetary", links, teeth={"sun": 30, "ring": 75})
>>> case = transmission(Drawing(3, [sets]), shift_elements=[ShiftElement(2)], gears=[Gear([1])])
>>> [(mechanism.name, mechanism.ratio) for mechanism in case.mechanisms]
[('P', -2.5)]

The room for cases that are drawn rather than prepared. `kinds` declares what there is,
`element` holds a case's elements, `keys` their keys in YAML and JSON, `group` has exact
ratios of planets on a carrier, `lower` makes three-link mechanisms of them, `drawing` a
transmission; `checks` and `teeth` say what cannot be. `planet_inertia` tells how masses of planets
move, `bodies` which inertias stand for them, for vibration and motion.
"""

from vstatics.core.elements.drawing import Drawing, transmission
from vstatics.core.elements.element import CentralWheel, Element, MeshEfficiency, PlanetMass

__all__ = ["CentralWheel", "Drawing", "Element", "MeshEfficiency", "PlanetMass", "transmission"]
