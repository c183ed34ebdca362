"""The solver: speeds, torques, losses and power flow of every gear.

A `Transmission` goes in, `Results` come out: arrays over all gears, and the state of each
gear as an object.

>>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
>>> case = Transmission(3, [ShiftElement(1, 2), ShiftElement(2, 0)],
...                     [Mechanism(1, 2, 3, -2.5, efficiency=0.96)], [Gear([1]), Gear([2])])
>>> results = solve(case)
>>> results.ratio, results.gear(2).torques.on_first_link
(array([1. , 3.5]), [0.0, -2.5, 1.0, 3.5])

The modules follow docs/method.md: `matrix`, `speeds`, `drag`, `torques`, `ideal` (a gear
without losses), `efficiency`, `losses`, `signs` and `sign_search`, `freewheels`, `state`
(all of it as one object, with `power`, `bodies` and `status`), `gear` and `variants`
(arrays of it), `results`, `solve`. `diagnosis`, `idling` and `digits` say what is to be noticed.
"""
