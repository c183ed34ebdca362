"""Model of a transmission: the links, shift elements, mechanisms and gears of its stick diagram.

>>> from vstatics.core.model.transmission import Gear, Mechanism, ShiftElement, Transmission
>>> brake, clutch = ShiftElement(2), ShiftElement(1, 2)  # numbers of links; 0 is the housing
>>> sets, gears = [Mechanism(1, 2, 3, ratio=-2.5)], [Gear([1]), Gear([2])]
>>> case = Transmission(3, [brake, clutch], sets, gears)
>>> case.devices, case.output, [gear.name for gear in case.gears]  # checked, defaults filled in
(['T1', 'F2', 'D1'], 3, ['1', '2'])

`parts` defines the parts of a transmission, `fields` its derived quantities, and `checks` and
`part_checks` find errors. `keys` declares the keys of YAML and JSON cases, with classes from
`shape`. `paths` handles paths to numbers such as `P1.teeth.sun`, and `declared_numbers` finds the
declaration of a number. `springs`, `torsional_checks` and `torsional_keys` are imported only for
cases with torsional vibration.
"""
