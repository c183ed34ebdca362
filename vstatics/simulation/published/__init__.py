"""Tarasik's published simulation of gearboxes with two degrees of freedom, for comparison.

`two_masses` reduces a gearbox to two masses, `phase_equations` has equations (12) to (15) for one
phase of a clutch, `record_of_phases` records the motion. `tarasik` runs the method, and rejects
scenarios that the method does not cover.
"""
