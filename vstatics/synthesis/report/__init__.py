"""HTML page of found gearboxes.

`boxes` writes the page for the command `synth box`. `box_parts` writes the tables of the page and
the section about a single gearbox.
"""
