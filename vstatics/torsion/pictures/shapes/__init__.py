"""Pictures of the natural modes of a gear over its links.

`links` arranges links and components in a row, `link_row` draws the row and a mode shape, `shares`
draws bars of energy, and `modes` draws the whole picture.
"""
