"""Integration from event to event: search for events, and states after each event.

`start` and `springs_at_start` determine the start, `instants` describes the motion at an instant.
`choices` lists the possible states of contacts, mechanisms and springs; `search` orders their
combinations, and `selection` selects a combination. `split` divides redundant torques, and
`impacts` calculates speeds after an impact. Then `stretches` integrates in closed form, with
matrices of `exponential`, or `time_steps` by an explicit method. `margins` measures the distance
from each change of state, and `location` finds the time at which a margin becomes negative. `sides`
decides comparisons of formulas, `meetings` detects those that change without end, and
`formula_corners` lets the motion slide along their jumps. `sequences` finds the step of a sequence
that is due, and `sequence_commands` carries it out. `stops` and `unbounded` explain runs that
cannot go on.
"""
