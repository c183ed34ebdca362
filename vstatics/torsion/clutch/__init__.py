"""Largest torques after a clutch dump, in closed form.

A clutch is dumped when the driver releases the pedal suddenly. `clutch_dump` describes a clutch
dump of a case, and `dump_key` declares its key. `given` declares the numbers of a dump, `file`
reads them from a file, and `gear_dump` derives them from a gear of a case. `dumped` calculates the
largest torques, and `engagement` the dynamic factor of a clutch whose torque grows with time.
`tables` returns the tables.
"""
