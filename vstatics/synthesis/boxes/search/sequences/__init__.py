"""Sequences of gears, for which only number, ratio spread and step ratios are wanted.

`search` finds the sequence to report. `room` contains the requirements and work arrays, and
`bounds` the ranges of step ratios in a cell of gear-set ratios. `choosing` finds the choices of
gears that are possible in a cell or at a `point`. `fitting` finds the gear-set ratios at which
steps and spread are nearest to the middles of their ranges, and `nearest` the best of several
choices. All modules are compiled.
"""
