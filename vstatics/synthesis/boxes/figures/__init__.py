"""Figures (characteristic numbers) of found gearboxes and of the gears.

`by_box` defines the figures of a gearbox, `by_gear` the figures of a gear, and `measured`
calculates both with the solver. `shifting` counts skip shifts, and finds shift elements with torque
of both signs and brakes that one-way clutches could replace; `planar` tests for crossing shafts.
`case` converts a found gearbox to a case, `built` converts a case to a found gearbox, and `known`
names gearboxes that are shipped as cases, from a table that `shipped` writes.
"""
