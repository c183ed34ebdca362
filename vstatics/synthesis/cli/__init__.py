"""The commands `vstatics synth ...`, which find gearboxes.

`group` lists the commands, each in a module of its name. In the order of a design, `structures`
lists schemes of planetary sets, `case` writes a scheme as a case, `combinations` finds the gears
of a case, `fit` the ratios of mechanisms, and `teeth` the tooth numbers; the room `box` finds whole
gearboxes. `case_file` writes results as a case, `combinations_output` the list of combinations.
"""
