"""Load spectra, and life of members and bearings, over a duty cycle of operating points.

`member_rows` contains torque and revolutions of each member at each point. `classes` counts
revolutions and time in classes of torque. `strength` adds up the damage of members, and
`bearing_life` that of bearings.
"""
