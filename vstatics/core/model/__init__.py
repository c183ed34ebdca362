"""The transmission as its scheme shows it: links, shift elements, mechanisms, gears.

>>> from vstatics.core.model.transmission import Gear, Mechanism, ShiftElement, Transmission
>>> brake, clutch = ShiftElement(2), ShiftElement(1, 2)  # links by their numbers; 0: the housing
>>> sets, gears = [Mechanism(1, 2, 3, ratio=-2.5)], [Gear([1]), Gear([2])]
>>> case = Transmission(3, [brake, clutch], sets, gears)
>>> case.devices, case.output, [gear.name for gear in case.gears]  # checked, defaults filled in
(['T1', 'F2', 'D1'], 3, ['1', '2'])

`parts` has its parts, `fields` what can be asked of it, the modules of checks what it must
fulfil. `keys` declares the keys of the same in YAML and JSON, in the words of `shape`;
`paths` has the grammar of paths to numbers, `declared_numbers` walks along them. What vibrates has
`springs`, `torsional_checks`, `torsional_keys`: loaded for these alone.
"""
