"""What happens to a case over time, as it is written down.

`parts` is a scenario. `file` reads one: `keys` declares what may stand there, `given` what it is
before the case says what numbers measure, `values` the parts after. `laws` are torques over time,
speed or angle, `formula` those that are formulas, `formula_code` their functions of floats,
`corners` where these bend or jump; `jumps` splits a law that does. `programme` is the capacity of
each shift element over time, `distribution` what samples are drawn from. `checks` tells what is
wrong before anything is calculated, `sizes` which numbers nothing has.
"""
