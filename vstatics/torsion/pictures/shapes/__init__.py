"""Pictures of the natural modes of a gear over its links.

`links` arranges links and devices in a row, and `link_row` draws the row and a shape. `shares`
draws bars of energy. `modes` is the whole picture.
"""
