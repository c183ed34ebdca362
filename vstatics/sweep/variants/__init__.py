"""Numbered variants of a case or of a scenario.

The `subject` is a case or a document, such as a scenario. `targets` identifies the varied number of
a case, `path_numbers` a number by its path, `scenario_numbers` a number of a scenario; `variation`
parses the values of a number, `samples` draws points between bounds, `table` and `table_file` read
a file of variants. `numbered` gives any block of variants at any time.
"""
