"""Pictures of vibration over the speed of a link that excites the gear by orders.

`orders_and_speeds` determines them, and `running` marks the speeds at which the input runs.
`resonances` finds the speeds at which orders meet natural frequencies. `campbell` draws the content
of a `campbell_sheet`, with `dots` for the size of resonances, a `resonance_table` and a
`gear_strip`. `response` draws the amplitudes of `response_lines`.
"""
