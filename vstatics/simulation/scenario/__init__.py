"""Scenario of a simulation: the inputs of a case over time, read from YAML or JSON and checked.

`parts` is the data model of a scenario. `file` reads a document: `keys` declares its keys, `given`
holds values before their units are known, and `values` converts them to `parts`, with the units of
the case. `laws` are torques over time, speed or angle; `formula` reads formulas, `formula_code`
compiles them, `corners` finds their bends and jumps, and `jumps` splits a law at its jumps.
`programme` is the capacity of each shift element over time, `distribution` the distribution of a
random number. `checks` rejects impossible scenarios before a calculation, `sizes` numbers of
impossible size.
"""
