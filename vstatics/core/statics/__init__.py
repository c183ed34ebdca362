"""The solver: speeds, torques, losses and power flow of every gear.

`solve` takes a `Transmission` and returns `Results`: arrays over all gears, and a `GearState`
object for each gear.

>>> from vstatics import Gear, Mechanism, ShiftElement, Transmission, solve
>>> case = Transmission(3, [ShiftElement(1, 2), ShiftElement(2, 0)],
...                     [Mechanism(1, 2, 3, -2.5, efficiency=0.96)], [Gear([1]), Gear([2])])
>>> results = solve(case)
>>> results.ratio, results.gear(2).torques.on_first_link
(array([1. , 3.5]), [0.0, -2.5, 1.0, 3.5])

The modules follow docs/method.md: `matrix`, `speeds`, `torques` (with drag), `ideal` (a gear
without losses), `efficiency`, `losses`, `signs` (directions of power), `freewheels`, `state` (all
results of a gear, with `power`, `bodies` and `status`), `variants` (arrays over many variants),
`result_arrays`, `results`, `solution`. The package `diagnosis`, `idle_by_coincidence` and `digits`
detect irregular gears and write the messages about them. The package `points` varies numbers of a
case in SI units. `solve` contains the public functions.
"""
