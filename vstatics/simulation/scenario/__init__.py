"""Scenario of a simulation: the inputs of a case over time, read from YAML or JSON and checked.

`parts` is the data model of a scenario. `file` reads a document: `keys` declares its keys, `given`
its values while their units are open, and `values` the parts once the case has settled the units.
`laws` are torques over time, speed or angle; `formula` reads formulas, `formula_code` compiles
them, `corners` finds their bends and jumps, and `jumps` splits a law at its jumps. `programme` is
the capacity of each shift element over time, `distribution` the distribution of a sampled number.
`checks` refuses impossible scenarios before the calculation, `sizes` numbers of impossible size.
"""
