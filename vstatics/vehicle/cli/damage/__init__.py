"""Commands of the group `vstatics damage`.

`group` declares the command group. The modules `record` (the default), `rayleigh` and `resize` each
contain a command.
"""
