"""What commands share: input and output, options, cases, what is said and how a command ends.

`files` reads what goes in and writes what comes out, messages too; `console` and `progress` draw
on a terminal, `exit_status` has the statuses, `lazy_group` imports a command when it is called.

A command reads its options by `values` (numbers, pairs, lists of names) and `formats` (where it
writes to and in which format); `estimates` says beforehand what that will take. `documents` takes
scenarios, `cases` has the options of cases, reads and calculates them, and `problems` tells which
of their problems are printed and which make the command fail.

What a command shows of a case becomes text in `texts`. `one_or_many` carries a command out for
its cases: one by itself, several by `many`, to a directory or a stream. `one_case` is for commands
that take one case only. `scenario_run` and `found_boxes` stand in for a case: the run of a
scenario, the boxes of a search. No module here imports a command.
"""
