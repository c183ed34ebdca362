"""Section on torsional vibration in an HTML report.

`vibration` calculates the modes of all gears of a case, and shows natural frequencies, shapes,
damping and the Campbell diagram.
"""
