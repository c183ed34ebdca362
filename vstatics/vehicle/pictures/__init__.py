"""Pictures of a transmission in a vehicle: wheel force, engine speed, gear steps, load spectra.

`driven` lists the gears that drive a vehicle, and draws axes over road speed. `traction` draws
wheel force and resistance, and `sawtooth` engine speed, both over road speed. `steps` draws the
forward gears on a logarithmic line, compared with `laws`. `spectrum` draws load spectra over a duty
cycle.
"""
