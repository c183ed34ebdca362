"""Natural modes over the links of a gear.

`links` puts links and devices in a row, which `link_row` draws with a shape over it; `shares` are
bars of energy. `modes` is the picture of these.
"""
