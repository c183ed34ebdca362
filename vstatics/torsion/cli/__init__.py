"""Commands of `vstatics torsion`.

`group` lists the commands. The modules `modes`, `reduce`, `simplify`, `response`, `random` and
`dump` have a command each; `measured` has ``identify`` and ``damping``, with options from
`observed`. `case` has common options, and messages about gears.
"""
