"""Forced vibration of a gear: what torques over the speed of an engine do to it.

`torque_table` reads a torque as orders with amplitudes and phases, `harmonic_torques` has the
response to each, `cycle` all orders together; `tables` has the tables.
"""
