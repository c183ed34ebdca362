"""A found gearbox as a case, and the figures of the gearbox and of each gear.

`by_box` defines the figures of a box, `by_gear` the figures of a gear; `measured` calculates both
with the solver. `shifting` counts skip shifts and finds elements with torque of both signs and
brakes that one-way clutches could replace, `planar` tests for crossings. `case` writes a box as a
case, `built` reads a case as a box, and `known` names boxes that exist, by a table that `shipped`
writes.
"""
