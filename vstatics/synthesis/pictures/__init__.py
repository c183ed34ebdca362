"""Found boxes at a glance.

`points` has mean loss over the largest torque, `numbers` beside the points; `stick` is the diagram
of one box; `picture` puts them on a page.
"""
