"""Tarasik's published simulation of gearboxes with two degrees of freedom, for comparison.

`two_masses` reduces a gearbox to two masses, `phase_equations` contains equations (12) to (15) for
a phase of a clutch, and `record_of_phases` records the motion. `tarasik` runs the method, and
rejects scenarios that the method does not cover.
"""
