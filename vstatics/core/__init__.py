"""Statics of a transmission: model, solver, readers, writers, evaluations and command line.

`messages` explains all errors, warnings and notes. `arguments` checks the arguments of Python
functions, `texts` translates into Russian, and `groups` groups items. `numerics` solves equations,
`model` defines the case, `statics` calculates the gears, and `elements` adds gear sets with teeth.
`jobs` runs processes and opens files. `tables` formats results as tables, `readers` reads cases,
and `writers` writes cases and results. `flow`, `summary`, `comparison` and `explain` evaluate
results, and `cli` is the command line. The annexes are optional packages that use the core, such as
`vstatics.torsion`.
"""
