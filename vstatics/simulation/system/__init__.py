"""A case in motion as matrices, and its equations while the same things stick.

`devices` makes rows of a scenario: what is heavy, rigid, sticks, drags or acts from outside;
`matrices` has them as matrices. `curves` and `ports` give capacities and torques at an instant.
`structure` has the constant matrices of what sticks, `equations` what a solver integrates, as maps
too where all torques are straight.
"""
