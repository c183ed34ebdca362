"""Natural modes and frequencies.

`shown_modes` takes the modes of a gear or tells why there are none. `links` puts links and devices
in a row, which `link_row` draws with a shape over it; `modes` is the picture of these with bars of
energy, `campbell` that of frequencies over the speed of the input.
"""
