"""A gear as a torsional system: what is heavy, what is elastic, what is rigid.

`state` tells which gears can vibrate, `slopes` what springs with points are under the load.
`gear_system` is the system, each device with its row; `coordinates` splits its motions into free,
massless and rigid ones.
"""
