"""`vstatics synth`: gearboxes to be found.

`group` lists the commands. Each is a module with a function of its name, in the order of a design:
`structures` lists schemes of planetary sets, `case` makes a case of one, `combinations` finds its
gears, `fit` the ratios of its mechanisms, `teeth` their integer teeth; the room `box` finds whole
gearboxes. `case_file` writes what was found as a case, `combinations_output` says what is shown of
combinations.
"""
