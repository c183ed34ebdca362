"""Command `vstatics synth box`, which finds gearboxes for wanted ratios.

`command` defines the command. `options` reads its options, with `ratios` (wanted gears and their
tolerances), `sequence` (further gears) and `modified` (parts of a case). `run` searches, and
`output` writes the gearboxes.
"""
