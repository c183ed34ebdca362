"""Command `vstatics simulate`: simulation of a case over time under a scenario.

`documents` recognises scenarios among the files of all commands, reads them with their cases and
checks them. `options` declares the options of the command, and `command` runs the scenario once and
shows the motion. `samples` is for ``--samples``: many runs with drawn numbers, carried out like a
sweep, and their statistics.
"""
