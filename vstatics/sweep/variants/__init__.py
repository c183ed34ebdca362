"""Numbered variants of a case or of a scenario.

The `subject` of a sweep is a case, or a document such as a scenario. `targets` finds a number of a
case by component and quantity, `path_numbers` a number by its path, and `scenario_numbers` a number
of a scenario. `variation` parses the values of a number, `samples` draws values between bounds, and
`table` and `table_file` read a file of variants. `numbered` returns any block of variants at any
time.
"""
