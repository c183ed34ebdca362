"""Gear sets with teeth: gear pairs, planetary gear sets, differentials.

>>> from vstatics.core.model.transmission import Gear, ShiftElement
>>> links = {"sun": 1, "ring": 2, "carrier": 3}
>>> sets = Element("P", "planetary", links, teeth={"sun": 30, "ring": 75})
>>> case = transmission(Drawing(3, [sets]), shift_elements=[ShiftElement(2)], gears=[Gear([1])])
>>> [(mechanism.name, mechanism.ratio) for mechanism in case.mechanisms]
[('P', -2.5)]

This package supports cases that are drawn as gear sets instead of three-link mechanisms. `kinds`
declares the kinds of gear sets, `element` defines the gear sets of a case, `keys` their keys in
YAML and JSON. `group` calculates exact ratios of planets on a carrier, `lower` converts gear sets
to three-link mechanisms, and `drawing` creates a transmission from the mechanisms. `checks` reports
gear sets that cannot be calculated, `teeth` doubtful tooth numbers. For vibration, `planet_inertia`
calculates the speeds of planet masses, and `planet_bodies` the inertias on links that replace these
masses. `part_numbers` lists the numbers of gear sets and other parts by path, such as
`P1.teeth.sun`.
"""

from vstatics.core.elements.drawing import Drawing, transmission
from vstatics.core.elements.element import CentralWheel, Element, MeshEfficiency, PlanetMass

__all__ = ["CentralWheel", "Drawing", "Element", "MeshEfficiency", "PlanetMass", "transmission"]
