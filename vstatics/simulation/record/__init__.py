"""What is kept of a run, and how it is told.

`record` collects a run while it goes on, in `segments`; `drawn` makes columns of them, some steps
at a time, at the instants that `curves` tells; `asked` has columns that somebody asks for, `rows`
their names, `changes` accelerations and jerks. `account` tells where its work goes. `motion` is
what a simulation gives: `tables` has its tables, `columns` its course, `answer` its JSON.
"""
