"""Tables of the results: quantities with names, rows, and values in each unit.

>>> from vstatics.core.model.transmission import Gear, Mechanism, Transmission
>>> from vstatics.core.statics.solve import solve
>>> from vstatics.core.tables.values import tables
>>> results = solve(Transmission(2, [], [Mechanism(1, 2, 0, ratio=-2.5, name="pair")], [Gear()]))
>>> speeds = next(table for table in tables(results) if table.quantity.name == "speeds")
>>> speeds.quantity.title, list(speeds.rows), speeds.columns, speeds.values.tolist()
('Speeds of the links', ['1', '2'], ['1'], [[1.0], [-0.4]])

`quantities` declares all quantities, `values` creates their tables, and `names` finds quantities
and rows by the names that users type. `grid` defines tables of cells, each with a text and a value.
`text`, `markdown`, `latex`, `html` and `terminal` write the texts. `csv` and `xlsx` write the
values. `written_results` represents results that were read from a file. `answer` derives JSON and
JSON Schema from records, the outputs of commands.
"""
