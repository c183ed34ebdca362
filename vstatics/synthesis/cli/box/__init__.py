"""`vstatics synth box`: whole gearboxes for wanted ratios.

`command` is the function of the command. `options` are its options, with `ratios` (wanted gears and
their tolerances), `sequence` (further gears) and `modified` (parts of a case). `run` searches,
`output` writes the gearboxes.
"""
