"""What is kept of a run, and how it is told.

`record` collects a run while it goes on, in `pieces`; which instants its columns need is told by
`curves`. `account` tells where its work goes. `motion` is what a simulation gives: `grids` has its
tables, `columns` its course, `answer` its JSON.
"""
