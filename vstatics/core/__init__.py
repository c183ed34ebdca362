"""The transmission in its gears: model, solver, readers and writers, answers, command line.

`arguments` checks what Python functions are given, `texts` are in English and Russian. `numerics`
solves, `model` is the case, `statics` calculates its gears, `elements` are gear sets with teeth.
`jobs` runs processes and opens files. `tables` lays out answers, `readers` read cases, `writers`
write cases and results. `flow`, `summary`, `comparison` and `explain` answer questions about
results, and `cli` is the command line. The annexes beside the core build on it.
"""
