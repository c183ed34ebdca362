"""The solver: speeds, torques, losses and power flow of every gear.

A `Transmission` goes in, `Results` come out: arrays over all gears, and the state of each
gear as an object.

>>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
>>> case = Transmission(3, [ShiftElement(1, 2), ShiftElement(2, 0)],
...                     [Mechanism(1, 2, 3, -2.5, efficiency=0.96)], [Gear([1]), Gear([2])])
>>> results = solve(case)
>>> results.ratio, results.gear(2).torques.on_first_link
(array([1. , 3.5]), [0.0, -2.5, 1.0, 3.5])

The modules follow docs/method.md: `matrix`, `speeds`, `torques` (with drag), `ideal` (a gear
without losses), `efficiency`, `losses`, `signs` (first without losses, then searched for),
`freewheels`, `state` (all of it as one object and as numbers, with `power`, `bodies` and
`status`), `variants` (arrays of it), `result_arrays`, `results`, `solve`. In the
room `points` any number varies, in SI. `diagnosis`, `idling`
and `digits` say what is to be noticed.
"""
