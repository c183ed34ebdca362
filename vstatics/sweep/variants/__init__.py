"""What is varied: numbered variants of a case or of a scenario.

`subject` is a case or a document, such as a scenario. `targets` tells which number of a case is
meant, `path_numbers` which by a path, `scenario_numbers` which of a scenario; `variation` reads
over which values it goes, `samples` points between bounds, `table` a file of variants. `numbered`
gives any block of them at any time.
"""
