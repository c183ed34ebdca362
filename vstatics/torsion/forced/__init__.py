"""Forced vibration of a gear under periodic torques, over the speed of a link such as the engine.

`torque_table` reads a torque as orders with amplitudes and phases. `harmonic_torques` calculates
the response to each order, and `cycle` combines all orders. `tables` has the tables.
"""
