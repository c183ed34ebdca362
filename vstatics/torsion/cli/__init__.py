"""`vstatics torsion`: the transmission as a torsional system.

`group` lists the commands. Each is a module with a function of its name: `modes`, `reduce`,
`simplify`, `response`, `random`, `dump`; both commands of what was measured, ``identify`` and
``damping``, are in `measured`. `case` has what they share: gears, links and messages of their case.
"""
