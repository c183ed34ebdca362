"""Many runs of a scenario, whose numbers vary: what a sweep of it, and samples, calculate.

`numbers` has the two documents and the numbers in them, `subject` is what a sweep takes: each
variant is a run. `motion_names` knows the names in its expressions, `motion_tables` has the values
of a run, `asked` reads columns of one run. `samples` draws from the distributions of a scenario,
`statistics` has what the drawn runs have in common.
"""
