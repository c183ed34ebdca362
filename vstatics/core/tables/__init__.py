"""From arrays to tables: what each quantity is called, its rows, its values in each unit.

>>> from vstatics.core.model.transmission import Gear, Mechanism, Transmission
>>> from vstatics.core.statics.solve import solve
>>> from vstatics.core.tables.values import tables
>>> results = solve(Transmission(2, [], [Mechanism(1, 2, 0, ratio=-2.5, name="pair")], [Gear()]))
>>> speeds = next(table for table in tables(results) if table.quantity.name == "speeds")
>>> speeds.quantity.title, list(speeds.rows), speeds.columns, speeds.values.tolist()
('Speeds of the links', ['1', '2'], ['1'], [[1.0], [-0.4]])

What is declared of a quantity stands in `quantities`; `values` fills its table, `names` writes
its rows and finds both by what a person types. `grid` holds tables of texts, that `text`,
`markdown` and `latex` lay out. `written_results` are results as they were written. By `answer`
what a command answers is one record, of whose types its JSON and its schema follow.
"""
