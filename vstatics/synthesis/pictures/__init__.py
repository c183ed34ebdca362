"""Pictures of found gearboxes.

`points` draws mean loss over the largest torque, `numbers` places the numbers next to the points,
`stick` draws the diagram of a box, and `picture` arranges points and diagrams on pages.
"""
