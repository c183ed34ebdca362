"""`vstatics synth`: gearboxes to be found.

`group` lists the commands. Each is a module with a function of its name, in the order of a design:
`structures` lists schemes of planetary sets, `case` makes a case of one, `combinations` finds its
gears, `fit` the ratios of its mechanisms, `teeth` their integer teeth; `box` finds whole boxes for
wanted ratios. `case_file` writes what was found as a case. Of combinations `combinations_output`
says what is shown; of boxes `box_options` says what is asked for, `box_run` carries the search
out, `box_output` writes what it finds.
"""
