"""Mechanical model of a scenario as matrices, and its equations of motion between two events.

`devices` translates a scenario into bodies, constraints, contacts, springs and outside torques, and
`matrices` contains them as matrices. `curves` and `ports` calculate capacities and torques at an
instant. `structure` has the constant matrices of a set of sticking contacts. `varying_losses` and
`variators` calculate torques that depend on the torques of constraints. `equations` is what a
solver integrates, in linear form as well if all torques are linear.
"""
