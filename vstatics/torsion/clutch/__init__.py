"""The largest torques when a clutch is dumped, in closed form.

`given` is what is known of a dump, `file` reads and writes it, `gear_dump` makes it of a gear
of a case. `engagement` has the dynamic factor while the torque grows, `dumped` the largest
torques; `tables` tells of them.
"""
