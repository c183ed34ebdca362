"""Load spectra and life of members and bearings over a duty cycle of points.

`member_rows` holds torque and speed of each member at each point. `classes` counts them by torque,
`strength` and `bearing_life` sum up the damage of members and of bearings.
"""
