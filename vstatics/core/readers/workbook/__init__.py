"""Cases in workbooks: sheets with a row for each part, and a sheet of paths and values.

`parts` opens a workbook of limited size, and `cells` reads the cells of its sheets. `tree` builds
the same tree of nodes as the YAML reader, so that both formats share the checks of keys. `sheets`
declares the sheets and headings, and converts texts to cells and back, also for the writer.
"""
