"""Code that all commands use: options, cases, input and output, messages, exit status.

`files` reads inputs and writes outputs and messages. `console` and `progress` write to a terminal.
`exit_status` lists the exit statuses, and `lazy_group` imports a command when it is called.

`options` combines related options in an argument of a command, and `values` parses the values of
options: numbers with limits, pairs, lists, names. `formats` determines the output file and its
format, `sharing` distributes work over processes, and `estimates` predicts time and size.
`documents` recognises documents that are declared by annexes (optional packages), such as
scenarios. `cases` reads and calculates cases and defines their options. `problems` selects the
problems that are printed or that make the command fail.

`texts` creates the output of a case in each format. `one_or_many` runs a command for its cases.
Several cases are run by `many`, with output to a directory or a stream. `one_case` is for commands
with a single case: it reads the case and writes the answer and the problems. No module of this
package imports a command.
"""
