"""Transmission in a vehicle: driving cycles, traction, duty cycles, fatigue life.

`case` contains the vehicle and fatigue strengths of a case. `damage` calculates the life of
components under varying torque. `operation` simulates the vehicle on the road and over duty cycles,
which `duty` and `duty_file` read. `pictures` draws steps and traction, `cli` has the commands
`cycle` and `damage`.
"""
