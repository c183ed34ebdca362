"""Command `vstatics simulate`: simulation of a case over time under a scenario.

`documents` recognises scenarios among the files of all commands, reads them with their cases and
checks them. `options` declares the options of the command. `command` runs the scenario once and
shows the motion, while `watched` limits the time and prints progress. `samples` implements
``--samples``: many runs with random numbers, carried out like a sweep, and their statistics.
`scenario_run` runs a scenario for the pictures and reports of other commands.
"""
