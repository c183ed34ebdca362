"""Tables of the results: the name of each quantity, its rows, its values in each unit.

>>> from vstatics.core.model.transmission import Gear, Mechanism, Transmission
>>> from vstatics.core.statics.solve import solve
>>> from vstatics.core.tables.values import tables
>>> results = solve(Transmission(2, [], [Mechanism(1, 2, 0, ratio=-2.5, name="pair")], [Gear()]))
>>> speeds = next(table for table in tables(results) if table.quantity.name == "speeds")
>>> speeds.quantity.title, list(speeds.rows), speeds.columns, speeds.values.tolist()
('Speeds of the links', ['1', '2'], ['1'], [[1.0], [-0.4]])

`quantities` declares all quantities, `values` fills their tables, `names` names the rows and finds
quantities and rows by the names that users type. `grid` holds tables of texts, which `text`,
`markdown`, `latex`, `html` and `terminal` format; `csv` and `xlsx` write the numbers behind them.
`written_results` describes results that were read from a file. `answer` derives the JSON and the
JSON Schema of a command's output from the types of a record.
"""
