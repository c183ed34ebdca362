"""Fatigue of components under varying torque: load cycles, damage, life, resized shafts.

>>> import numpy as np
>>> from vstatics.vehicle.damage.devices import damages
>>> from vstatics.vehicle.case.fatigue import Fatigue
>>> from vstatics.core.model.springs import Spring
>>> from vstatics.core.model.transmission import Transmission
>>> shaft = Spring({1: 1, 2: -1}, stiffness=9000.0, name="shaft")
>>> strength = Fatigue(100e6, 3, 4e6, section_modulus=4e-6)
>>> case = Transmission(2, [], [], [], springs=[shaft], fatigue={"shaft": strength})
>>> damage = damages(case, {"shaft": np.array([0.0, 500.0, -300.0, 0.0])})["shaft"]
>>> round(damage.largest_stress / 1e6), [cycle.range for cycle in damage.cycles]
(100, [300.0, 500.0, 800.0])

`rainflow` counts the cycles of a record, `devices` adds up their damage, and `recorded` reads a
record in CSV. `rayleigh` calculates the life under random stresses in closed form, with `scatter`
of strength and stress. `resize` calculates a shaft for other torques, `tables` returns the tables.
"""
