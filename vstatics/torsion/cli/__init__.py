"""Commands of `vstatics torsion`.

`group` lists the commands. The modules `modes`, `reduce`, `simplify`, `response`, `random` and
`dump` contain a command each; `measured` contains ``identify`` and ``damping``, with options from
`observed`. `case` contains options and messages about gears that several commands share.
"""
