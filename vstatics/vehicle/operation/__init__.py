"""What a box does in operation: over points of load, in a vehicle, over a driving cycle.

`load_spectrum` has energies and what members carry over points of speed and torque, by
`point_loads`; `traction` the force, top speeds and acceleration of a vehicle. `drive_cycle` goes
through a `trace` in `cycle_steps`, whose gears `shifting` picks where it has none, with the
`fuel_map` of its engine.

>>> from vstatics import Gear, Mechanism, Transmission
>>> from vstatics.vehicle.case.vehicle import Vehicle
>>> from vstatics.vehicle.operation.traction import performance
>>> car = Vehicle(1000, 0.3, engine=[(0.0, 100.0), (500.0, 100.0)])
>>> case = Transmission(2, [], [Mechanism(1, 2, 0, 4.0)], [Gear()], vehicle=car)
>>> round(performance(case).gears["1"].top_speed, 3)
135.0
"""
