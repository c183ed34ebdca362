"""The commands `vstatics synth ...`, which find gearboxes.

`group` lists the commands, each in a module of its name. In the order of a design, `structures`
lists schemes of planetary gear sets, `case` writes a scheme as a case, `combinations` finds the
gears of a case, `fit` the ratios of its gear sets, and `teeth` the tooth numbers; `box` finds whole
gearboxes. `values` parses values of their options, `case_file` writes results as a case, and
`combinations_output` the list of combinations. `found_boxes` serves other commands that read a list
of gearboxes.
"""
