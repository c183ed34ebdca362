"""What commands share: input and output, options, cases, what is said and how a command ends.

`files` reads what goes in and writes what comes out, messages too; `console` and `progress` draw
on a terminal, `exit_status` has the statuses, `lazy_group` imports a command when it is called.

A command gets options that belong together as one record (`options`); `values` reads them (numbers
with limits, pairs, lists, names) and says what is none. `formats` tells where a command writes to
and in which format, `sharing` who shares the work, `estimates` beforehand what that will take.
`documents` recognises what is no case by what annexes declare, `cases` has the options of cases,
reads and calculates them, and `problems` tells which of their problems are printed and which make
the command fail.

What a command shows of a case becomes text in `texts`. `one_or_many` carries a command out for
its cases: one by itself, several by `many`, to a directory or a stream. Of a command that takes one
case only `one_case` does all but the calculation. No module here imports a command.
"""
