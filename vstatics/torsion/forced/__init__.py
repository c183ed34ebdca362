"""Forced vibration of a gear under periodic torques, over the speed of a link such as the engine.

An order is the number of periods per revolution of the excited link. `torque_table` reads a torque
as orders with amplitudes and phases. `harmonic_torques` calculates the response to each order, with
`dry_friction`, and `cycle` sums all orders. `tables` returns the tables.
"""
