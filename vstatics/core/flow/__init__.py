"""Power flow of a gear: losses, split power and recirculating power.

`power` calculates the flow of each gear from results, and `power_flow` defines its data. `tables`
converts a flow to tables, `text` writes them as text, and `answer` as JSON.

>>> from vstatics import Gear, Mechanism, Transmission, solve
>>> from vstatics.core.flow.power import flows
>>> from vstatics.core.flow.text import text
>>> [gear] = flows(solve(Transmission(2, [], [Mechanism(1, 2, 0, -4.0, 0.98)], [Gear()])))
>>> round(gear.lossy.lost, 3), text(gear).splitlines()[-2]
(0.02, 'in 1.000 - out 0.980 - lost 0.020 = 0.000')

`circulation` finds cycles of power (loops) in a directed graph, `graph_cycles` the edges on cycles
of an undirected graph.
"""
