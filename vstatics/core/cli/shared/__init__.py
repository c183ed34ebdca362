"""Building blocks of all commands: options, cases, input and output, messages, exit status.

`files` reads inputs and writes outputs and messages. `console` and `progress` draw on a terminal.
`exit_status` lists the statuses, and `lazy_group` imports a command when it is called.

`options` combines options that belong together into one argument of a command, and `values` parses
options: numbers with limits, pairs, lists, names. `formats` decides where a command writes and in
which format, `sharing` which processes share the work, `estimates` predicts time and size.
`documents` recognises documents other than cases, which annexes declare. `cases` has the options of
cases, reads and calculates them, and `problems` decides which problems are printed and which make
the command fail.

`texts` writes the output of a case in each format. `one_or_many` carries out a command for its
cases: a single case directly, several through `many`, to a directory or a stream. `one_case` reads
the case, and writes the answer and the problems, of a command that takes one case. No module here
imports a command.
"""
