"""HTML page of found gearboxes.

`boxes` writes the page, and `box_parts` its tables and the part about a single gearbox.
"""
