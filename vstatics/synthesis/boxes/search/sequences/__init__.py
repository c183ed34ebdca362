"""Gears that a set of elements has with ratios nobody knows beforehand, compiled.

What is told of them is in one place, `search`: `room` has what is wanted and the room for it,
`bounds` between which steps are in a cell, `choosing` the choices that are possible by these
bounds or at a point, `fitting` the ratios of the sets nearest to the middles of what is wanted.
"""
