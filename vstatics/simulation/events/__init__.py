"""Integration from event to event: search for events, and states after each event.

`start` and `springs_at_start` determine the start, `instants` describes the motion at an instant.
`selection` selects the sticking and slipping states among `choices`, in the order of `search`.
`split` divides redundant torques, and `impacts` calculates speeds after links join at once. Then
`stretches` integrates in closed form, with matrices of `exponential`, or `time_steps` by an
explicit method, until one of the `margins` ends, whose time `location` finds. `meetings` and
`sides` watch comparisons of formulas. `sequences` says which step of a sequence is due,
`sequence_commands` carries it out. `unbounded` explains runs that cannot go on.
"""
