"""The page of found gearboxes.

`boxes` shows a list of found gearboxes with their families, `box_parts` the rows and pictures of
one of them.
"""
