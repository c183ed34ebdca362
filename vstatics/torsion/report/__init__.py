"""Section of a page on torsional vibration.

`vibration` calculates the modes of all gears of a case, and shows natural frequencies, shapes,
damping and the Campbell diagram.
"""
