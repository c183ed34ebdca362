"""The command `vstatics plot`, which draws pictures of every kind.

`plot` reads the case, scenario, sweep or found gearboxes of a picture, and writes SVG, PNG or PDF.
The pictures themselves stand in `vstatics.pictures` and in the annexes that draw their results.
"""
