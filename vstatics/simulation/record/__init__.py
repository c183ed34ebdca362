"""Record of a run: its columns, events and energies, and the motion that a simulation returns.

`record` collects a run in the pieces of `segments`, which calculates their columns. `drawn` chooses
the instants that draw these columns from the curves of `curves`. `asked` calculates additional
columns, `row_names` lists their names, `changes` differentiates speeds. `account` balances the
energy.
`motion` declares the result; `tables`, `columns` and `answer` write it.
"""
