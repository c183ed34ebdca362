"""The page of found gearboxes.

`boxes` writes the page of a list of gearboxes and families, `box_parts` the tables and the part of
a single gearbox.
"""
