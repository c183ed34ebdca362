"""Record of a run: its columns, events and energies, and the motion that a simulation returns.

`record` collects a run in pieces from event to event; `segments` calculates the columns of a piece.
`drawn` chooses the instants that draw these columns, from the polynomials of `curves`. `asked`
calculates additional columns, `row_names` lists their names, `moments` differentiates speeds, and
`converters` calculates converter efficiencies, and `targets` the times of target speeds.
`picture_tables` adds columns for pictures. `account` balances the energy, and `dynamic_factors`
compares torques with static torques. `motion` declares the result. `tables`, `columns` and `answer`
write it. `state_changes` adds events to a record, and `words` names them.
"""
