"""What the transmission does in a vehicle: driving cycles, traction, duty cycles, life.

`case` is what a case says of it: the vehicle, the fatigue strengths of components. `damage` is the
life of components under varying torque. `operation` is the vehicle on the road and over a duty
cycle, which `duty` and `duty_file` read. `pictures` draws steps and traction, `cli` has the
commands `cycle` and `damage`.
"""
