"""`vstatics simulate`: what a scenario does to a case over time.

`documents` recognises scenarios among the files of all commands, reads them with their cases and
checks them. `options` says what the command takes; `command` runs the scenario once and shows the
motion.
`samples` is for ``--samples``: many runs with drawn numbers, carried out as a sweep is, and their
statistics.
"""
