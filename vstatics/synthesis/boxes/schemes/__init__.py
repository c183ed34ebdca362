"""Schemes of gearboxes in the order of the search, generated when needed.

A scheme is the connection of the members of gear sets by links. `choices` adds to a scheme the
double-pinion sets, a held link, input and output. Connected schemes grow from `stems`; others
consist of `parts` without a common link. `speeds` calculates the link speeds that the gear sets of
a scheme permit.
"""
