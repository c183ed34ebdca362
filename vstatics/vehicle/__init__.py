"""Transmission in a vehicle: driving cycles, traction, duty cycles and fatigue life.

`case` declares the vehicle, fatigue strengths and bearings of a case. `damage` calculates the life
of components under varying torque. `life` calculates load spectra, and the life of members and
bearings over a duty cycle. `operation` drives the vehicle on the road and over duty cycles, which
`duty` and `duty_file` read. `pictures` draws gear steps and traction, and `cli` contains the
commands `cycle` and `damage`.
"""
