"""What a box gives a vehicle, gear by gear: wheel force, engine speed, steps.

`driven` has the gears that drive a vehicle, and the panel that they are drawn in; `traction` is
force over road speed against resistance, `sawtooth` engine speed over road speed, `steps` the
forward gears on a logarithmic line, which `laws` compares.
"""
