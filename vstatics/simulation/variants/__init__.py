"""Many runs of a scenario with varied numbers, for sweeps and samples.

`numbers` replaces numbers in the documents of scenario and case, and `subject` runs the variants of
a sweep. `motion_names` resolves names in expressions, `motion_tables` provides the values of a run,
and `asked` reads additional columns of a single run. `samples` draws random numbers from the
distributions of a scenario, and `statistics` summarises the runs with these numbers.
"""
