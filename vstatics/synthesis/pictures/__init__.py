"""Pictures of found gearboxes.

`points` draws a point for each gearbox in a diagram of mean loss versus largest torque, `numbers`
places numbers next to the points, `stick` draws the stick diagram of a gearbox, and `picture`
arranges points and diagrams on pages.
"""
