"""`vstatics synth box`: whole gearboxes for wanted ratios.

`command` is the function of the command. `options` says what may be asked for, with `ratios`
(wanted gears and their tolerances), `sequence` (gears besides) and `kept` (parts of a case). `run`
carries the search out, `output` writes what it finds.
"""
