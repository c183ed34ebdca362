"""Vibration over the speed of a link, which excites by orders.

`excited` tells orders and speeds, `running` marks at which the input runs. `resonances` are where
orders meet natural frequencies: `dots` shows how much each matters, `resonance_table` their speeds,
`gear_strip` the frequencies gear by gear; `campbell` is the picture of these, of what
`campbell_sheet` has. `response_lines` are amplitudes over the speed, `response` their picture.
"""
