"""Pictures of vibration over the speed of a link, which excites the gear by orders.

An order is the number of periods of an excitation per revolution. `orders_and_speeds` determines
the orders and the range of speeds, and `running` marks the speeds at which the input runs.
`resonances` finds the speeds at which orders meet natural frequencies. `campbell` draws a
`campbell_sheet`, with `dots` at resonances, a `resonance_table` and a `gear_strip`. `response`
draws the amplitudes of `response_lines`.
"""
