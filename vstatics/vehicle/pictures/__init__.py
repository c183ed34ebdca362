"""Pictures of a transmission in a vehicle: wheel force, engine speed, steps between gears.

`driven` lists the gears that drive a vehicle, and draws their panel; `traction` draws wheel force
and resistance over road speed, `sawtooth` engine speed over road speed, `steps` the forward gears
on a logarithmic line, compared with `laws`.
"""
