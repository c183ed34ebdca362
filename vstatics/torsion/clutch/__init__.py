"""The largest torques when a clutch is dumped, in closed form.

`clutch_dump` is the clutch of a case, `dump_key` declares its key for the core. `given` is what is
known of a dump, `file` reads and writes it, `gear_dump` makes it of a gear of a case. `engagement`
has the dynamic factor while the torque grows, `dumped` the largest torques; `tables` tells of them.
"""
