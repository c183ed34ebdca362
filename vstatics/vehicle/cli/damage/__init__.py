"""`vstatics damage`: what torques that vary do to devices.

`group` lists the commands. Each is a module with a function of its name: `record`, which needs not
be named, `rayleigh`, `resize`.
"""
