"""Power flow of a gear: losses, split power and recirculating power.

`power` calculates the flow of each gear from results, `power_flow` holds the flow. `tables` chooses
the lines of the tables, `text` writes them as text, `answer` as JSON.

>>> from vstatics import Gear, Mechanism, Transmission, solve
>>> from vstatics.core.flow.power import flows
>>> from vstatics.core.flow.text import text
>>> [gear] = flows(solve(Transmission(2, [], [Mechanism(1, 2, 0, -4.0, 0.98)], [Gear()])))
>>> round(gear.lossy.lost, 3), text(gear).splitlines()[-2]
(0.02, 'in 1.000 - out 0.980 - lost 0.020 = 0.000')

`circulation` finds loops of any graph, `graph_cycles` the edges on cycles.
"""
