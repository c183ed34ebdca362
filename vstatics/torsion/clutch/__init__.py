"""Largest torques after a clutch is dumped, in closed form.

`clutch_dump` is the clutch dump of a case, and `dump_key` declares its key for the core. `given`
has the numbers of a dump, `file` reads them from a file, and `gear_dump` derives them from a gear
of a case. `dumped` calculates the largest torques, and `engagement` the dynamic factor of a clutch
whose torque grows with time. `tables` has the tables.
"""
