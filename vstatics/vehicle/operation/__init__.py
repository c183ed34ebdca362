"""Transmission in operation: duty cycles, traction of a vehicle, driving cycles.

`load_spectrum` calculates energies and loads of members over points of speed and torque, which
`point_loads` solves. `traction` calculates the force, top speeds and acceleration of a vehicle.
`converter` determines the speed ratio of a converter in a gear from the torque on its pump, and
`converter_steps` uses it in a driving cycle. `drive_cycle` drives a `trace` in `cycle_steps`, with
the `fuel_map` of the engine. `cycle_case` adapts the case to a cycle, `gear_choice` returns the
gears of a trace, and `shifting` chooses gears by speeds. `driving` is the Python interface.

>>> from vstatics import Gear, Mechanism, Transmission
>>> from vstatics.vehicle.case.vehicle import Vehicle
>>> from vstatics.vehicle.operation.traction import performance
>>> car = Vehicle(1000, 0.3, engine=[(0.0, 100.0), (500.0, 100.0)])
>>> case = Transmission(2, [], [Mechanism(1, 2, 0, 4.0)], [Gear()], vehicle=car)
>>> round(performance(case).gears["1"].top_speed, 3)
135.0
"""
