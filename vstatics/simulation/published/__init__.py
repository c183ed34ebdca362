"""The published method of Tarasik, for boxes of two degrees of freedom, for comparison.

`two_masses` is a box as that method sees it, `phase_equations` has its equations (12) to (15) in
one phase of a clutch, `record_of_phases` keeps the course. `tarasik` carries it out, and says what
the method does not know.
"""
