"""The solver: speeds, torques, losses and power flow of every gear.

`solve` takes a `Transmission` and returns `Results`: arrays over all gears, and the state of each
gear as an object.

>>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
>>> case = Transmission(3, [ShiftElement(1, 2), ShiftElement(2, 0)],
...                     [Mechanism(1, 2, 3, -2.5, efficiency=0.96)], [Gear([1]), Gear([2])])
>>> results = solve(case)
>>> results.ratio, results.gear(2).torques.on_first_link
(array([1. , 3.5]), [0.0, -2.5, 1.0, 3.5])

The modules follow docs/method.md: `matrix`, `speeds`, `torques` (also of drag), `ideal`
(a gear without losses), `efficiency`, `losses`, `signs` (first without losses, then by a search),
`freewheels`, `state` (a gear as one object and as numbers, with `power`, `bodies` and `status`),
`variants` (arrays of states), `result_arrays`, `results`, `solution`. The room `points` lets any
number vary, in SI units. `diagnosis`, `idle_by_coincidence` and `digits` find what a message should
report. `solve` contains the public functions, which check the types of their arguments.
"""
