"""From event to event: how a motion is integrated, where something changes, what follows.

`start` and `springs_at_start` determine the state at the start, `instants` where everything is.
`selection` finds what sticks: by `choices`, in the order of `search`; redundant torques are divided
by `split`, what joins at once has its speeds by `impacts`. Then `stretches` in closed form, or
`time_steps` of an explicit method, go on until one of the `margins` ends, which `location` finds;
`unbounded` tells why they can't.
"""
