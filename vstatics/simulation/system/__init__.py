"""Mechanical model of a scenario as matrices, and its equations of motion between two events.

`devices` translates a scenario into bodies, constraints, contacts, springs and external torques,
which `matrices` declares. A port is a row of link speeds along which a torque acts; its rate is the
speed in this row. `curves` and `ports` calculate capacities and torques of ports at an instant.
`structure` contains the constant matrices for a set of sticking contacts. `varying_losses` and
`variators` calculate torques that depend on constraint torques, by `fixed_point` iterations.
`values` gives the rates of control states and temperatures, and `sight` the quantities that
formulas read. `shares` replaces jumps in formulas by means, and `sliding` calculates these means.
`equations` contains the differential equations, `affine` their matrices if all torques are linear,
and `linearised` the slopes of all other torques.
"""
