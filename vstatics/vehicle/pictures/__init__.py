"""Pictures of a transmission in a vehicle: wheel force, engine speed, gear steps, load spectra.

`driven` lists the gears that drive a vehicle, and draws the axes over road speed. `traction` draws
wheel force and resistance, `sawtooth` engine speed, both over road speed. `steps` draws the forward
gears on a logarithmic line, compared with `laws`, and `spectrum` load spectra over a duty cycle.
"""
