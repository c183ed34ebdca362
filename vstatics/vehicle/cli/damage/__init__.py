"""Commands of `vstatics damage`.

`group` lists the commands. Each command is a module with a function of its name: `record`, which is
the default, `rayleigh`, `resize`.
"""
