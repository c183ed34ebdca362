"""Building blocks of all commands: options, cases, input and output, messages, exit status.

`files` reads inputs and writes outputs and messages. `console` and `progress` draw on a terminal.
`exit_status` lists the statuses, and `lazy_group` imports a command when it is called.

`options` combines options that belong together into one argument of a command, and `values` parses
options: numbers with limits, pairs, lists, names. `formats` determines where a command writes and
in which format, `sharing` the number of processes, and `estimates` the expected time and size.
`documents` recognises documents other than cases, which annexes declare. `cases` reads and
calculates cases, with the options for this, and `problems` selects problems to print, and problems
that make the command fail. `texts` writes the output of a case in each format. `one_or_many`
executes a command for one case directly, and for several cases through `many`, to a directory or a
stream. `one_case` reads a case and writes the answer of a command that takes a single case. No
module here imports a command.
"""
