"""The command `vstatics plot`, which draws all kinds of pictures.

`plot` reads a case, scenario, sweep or list of gearboxes and writes SVG, PNG or PDF. The functions
that draw are in `vstatics.pictures` and in the annexes of the results.
"""
