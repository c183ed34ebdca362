"""Sequences of gears whose ratios are not given but only bounded; compiled.

`search` decides which sequence is reported. `room` contains the requirements and the work arrays,
`bounds` the ranges of steps in a cell, `choosing` the choices of gears that are possible within
these ranges or at a point, and `fitting` the gear-set ratios nearest to the middles of the ranges.
"""
